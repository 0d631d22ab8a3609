"""The maze under other settings."""

import numpy as np
import pytest

from lib.chapter_2 import latent_settings
from lib.chapter_2.latent_learning import DAYS, GROUPS, LEARNERS, Animal, Record
from lib.chapter_2.latent_settings import first_meals, settings, vary
from lib.chapter_2.maze import Maze


@pytest.fixture
def asked(monkeypatch):
    """Record the arguments of `simulate_groups`, which returns made-up errors by group and trace: [arguments, …]."""
    calls = []

    def simulate_groups(animal, maze, runs, seed, first_reward=11):
        calls.append((animal, maze, runs, seed, first_reward))
        each = np.random.default_rng(0).normal(size=(runs, DAYS))
        level = dict(zip(GROUPS, (5.0, 15.0, 5.0 - 40 * (animal.trace == 0.0))))
        return {group: Record(level[group] + each + np.arange(DAYS), each) for group in GROUPS}

    monkeypatch.setattr(latent_settings, "simulate_groups", simulate_groups)
    return calls


def test_a_setting_changes_one_thing():
    found = settings(Maze("RLL"))
    assert [*found] == ["as above", "α 0.01", "α 1", "γ 0.5", "γ 0.99", "ε 0", "ε 0.3", "λ 0", "λ 0.5", "turns A",
                        "turns B", "2 places per unit", "3 places per unit"]
    assert found["as above"] == ({}, Maze("RLL")) and found["γ 0.99"] == ({"discount": 0.99}, Maze("RLL"))
    changes, (a, b) = zip(*(found[f"turns {name}"] for name in "AB"))
    assert changes == ({}, {}) and a != b and len(a.turns) == len(b.turns) == 14
    assert found["3 places per unit"] == ({}, Maze(alley=2))


def test_every_setting_has_all_kinds_of_animal_with_streams_of_its_own(asked):
    rows, judged = vary(Maze(), runs=12, seed=5)
    assert [*rows] == [*judged] == [*settings(Maze())] and [*rows["λ 0"]] == list(LEARNERS)
    assert asked[:3] == [(Animal(name), Maze(), 12, 5, 11) for name in LEARNERS]
    assert asked[-1] == (Animal("Sarsa(λ)"), Maze(alley=2), 12, 5 + 12, 11)
    assert {animal for animal, *_ in asked[21:24]} == {Animal(name, trace=0.0) for name in LEARNERS}


def test_a_setting_keeps_its_two_findings_and_its_verdict(asked):
    rows, judged = vary(Maze(), runs=12)
    below, one_meal = rows["λ 0"]["neoRL"]
    assert below.value == pytest.approx(-40)
    assert one_meal.value == pytest.approx(-40 + 10, abs=2)  # day 12 against day 2: ten days on, up to noise
    assert judged["λ 0"].verdict == "reproduced" and judged["as above"].verdict != "reproduced"


def test_first_meals_are_on_the_days_that_are_asked_for(asked):
    errors = first_meals([3, 15], Maze(), runs=4, seed=2)
    assert asked == [(Animal(), Maze(), 4, 2, day) for day in (3, 15)]
    each = 5.0 + np.random.default_rng(0).normal(size=(4, DAYS)).mean(axis=0) + np.arange(DAYS)
    assert errors == {3: (pytest.approx(each[2]), pytest.approx(each[3])),
                      15: (pytest.approx(each[14]), pytest.approx(each[15]))}
