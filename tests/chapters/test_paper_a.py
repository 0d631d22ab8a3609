"""What the page of paper A computes: runs of both experiments, and the numbers beside the thesis's."""

from dataclasses import replace

import numpy as np
import pytest

from neorl import Result, WaterWorld, brownian, place_cells
from neorl.chapters.paper_a import CONTROL, REWARD, STATES, THESIS, beside_thesis, choices, in_words, live
from neorl.evidence.priors import TO_THE_LETTER
from neorl.evidence.reading import GROUPS, LAYERS, SINGLE, Reading, judge

WORLD = WaterWorld(n_creeps=8, win_reward=5.0)


def made_up(agent, rate, runs=12, steps=150_000):
    """A result in which every run earns `rate` a second, give or take some luck, all of it by green creeps."""
    bins = steps // 10
    hits = np.zeros((runs, bins, 2), np.int16)
    hits[..., 0] = np.random.default_rng(0).random((runs, bins)) < 0.2 * rate
    return Result(agent, WORLD, steps, runs, 0, hits[..., 0].astype(np.float32), hits)


@pytest.fixture(scope="module")
def results():
    rates = {("single", n): rate for n, rate in zip(SINGLE, (0.2, 0.3, 0.4, 0.25, 0.1))}
    rates |= {("layer", 3): 0.1, ("layer", 7): 0.2, ("layer", 23): 0.3}
    made = {key: made_up(place_cells([key[1]]), rate) for key, rate in rates.items()}
    return made | {"layers": made_up(place_cells(LAYERS), 0.7), ("brownian", 8): made_up(brownian(), 0.03)}


def test_both_experiments_are_run_under_each_reading(cache_folder):
    readings = {"to the letter": TO_THE_LETTER, "book": Reading()}
    found = live(readings, steps=300, runs=11, groups=("layers",))
    assert list(found) == list(readings)
    assert all(set(each) == set(GROUPS["layers"]) for each in found.values())
    assert found["book"]["layers"].runs == 11 and found["book"]["layers"].steps == 300
    assert found["to the letter"]["layers"].agent == place_cells(LAYERS, **TO_THE_LETTER.place_agents)


def test_single_maps_have_as_many_runs_as_a_verdict_needs_and_a_control(cache_folder, monkeypatch):
    monkeypatch.setattr("neorl.chapters.paper_a.sweep", lambda conditions: conditions)
    (found,) = live({"book": Reading()}, steps=150_000, runs=30).values()
    assert set(found) == {*GROUPS["layers"], *GROUPS["single"], CONTROL}
    assert (found["single", 90].runs, found["layer", 7].runs) == (10, 30)
    assert found[CONTROL] == replace(found["single", 90], agent=brownian())


def test_numbers_stand_beside_those_of_the_thesis(results):
    found = beside_thesis(results)
    assert set(found) == set(THESIS)
    assert found[REWARD].value == pytest.approx(3.5, rel=0.05) and found[REWARD].low < 3.5 < found[REWARD].high
    assert found[STATES].value == pytest.approx(587 / 49)


def test_what_was_found_is_put_in_words(results):
    claims = [*judge(results).values()]
    words = in_words(results, claims)
    assert "the order of single maps is N50 (0.40), N30 (0.30), N70 (0.25), N10 (0.20), N90 (0.10);" in words
    assert "Brownian motion earns 0.03 and resets the board 0.00 times in 150,000 steps" in words
    assert "together finally earn 0.70 per second, 3." in words and "(thesis: 3.5)" in words
    assert all(claim.name in words.split(". ")[0] for claim in claims)
    assert "● reproduced: A1" in words and "no verdict" not in words


def test_few_runs_are_no_verdict(results):
    few = {key: Result(each.agent, WORLD, each.steps, 2, 0, each.rewards[:2], each.hits[:2])
           for key, each in results.items()}
    assert in_words(few, [*judge(few).values()]).startswith("– no verdict: A1, A2, A3, A4, A5, A6, A7, A8. By")


def test_choices_are_listed_with_what_the_text_makes_of_them():
    table = choices({"to the letter": TO_THE_LETTER, "explores": replace(TO_THE_LETTER, exploration=0.1)})
    assert "| learning rate, α | open | 0.0122 | 0.0122 |" in table
    assert "| exploration, ε | pinned | 0 | 0.1 |" in table
    assert "| *all in all* | | within the text | breaks: policy |" in table
    assert "gain of place" not in table
