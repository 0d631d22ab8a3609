"""The rules that judge claims of the thesis itself, on made-up measurements with a known answer."""

import numpy as np
import pytest
from test_claims import brownian, made_up

from companion.chapter_2.maze import Record
from companion.thesis import claims


def final(level, runs=20):
    return level + np.random.default_rng(0).normal(0, 0.01, runs)


@pytest.mark.parametrize("levels, seconds, expected", [
    ((0.1, 0.2), 0.001, "reproduced"), ((0.1, 0.6), 0.001, "counter-example found"),
    ((0.5, 0.6), 0.1, "reproduced"),  # not in real time
])
def test_alternatives_fail_that_earn_less_or_compute_too_long(levels, seconds, expected):
    others = {name: (final(level), seconds, "all") for name, level in zip(("Q-learning", "DQN"), levels)}
    claim = claims.judge_alternatives(others, {"weak": final(0.2), "best": final(0.4)}, final(0.1), 0.02)
    assert claim.verdict == expected
    assert claim.here.value == pytest.approx(levels[1] / 0.4 if seconds < 0.02 else 0, abs=0.02)
    best = "final reward per second of the thesis's best, best"
    assert claim.numbers[best][0].value == pytest.approx(0.4, abs=0.01)


def test_alternatives_are_compared_with_an_agent_that_has_learned():
    claim = claims.judge_alternatives({"DQN": (final(0.5), 0.0, "all")}, {"best": final(0.1)}, final(0.1), 0.02)
    assert claim.verdict == "not testable"


def test_an_alternative_that_earns_as_much_within_the_noise_leaves_room_for_the_claim():
    others = {"DQN": (final(0.4)[::-1], 0.0, "all")}
    claim = claims.judge_alternatives(others, {"best": final(0.4)}, final(0.1), 0.02)
    assert claim.verdict == "undecided"


@pytest.mark.parametrize("load, latest, expected", [
    (0.02, 0.1, "reproduced"), (0.02, 1.5, "reproduced"), (0.9, 2.1, "partly"), (1.1, 0.5, "partly"),
    (1.1, 2.1, "contradicted"),
])
def test_real_time_is_judged_by_the_share_of_a_core_and_by_the_latest_step(load, latest, expected):
    delay = np.full((12, 30), 0.1)
    delay[3, 4] = latest
    claim = claims.judge_real_time(np.full(12, load), delay)
    assert (claim.verdict, claim.here.value) == (expected, pytest.approx(load))
    assert [claim.numbers[name][0].value for name in ("steps late", "share of steps done late")] == pytest.approx(
        [latest, (latest > 1) / 360])
    assert claims.judge_real_time(np.full(9, load), delay[:9]).verdict == "no verdict"


@pytest.mark.parametrize("whole, short, expected", [
    ((0.5, 0.5), (0.0, 0.3), "reproduced"), ((0.5, 0.5), (0.0, 0.5), "partly"),
    ((0.5, 0.5), (0.5, 0.6), "contradicted"), ((0.5, -0.1), (0.0, 0.0), "not testable"),
])
def test_states_are_needed_where_an_agent_loses_that_remembers_a_step_less(whole, short, expected):
    kept, lost = ({name: final(level) for name, level in zip(("sum", "table"), levels)}
                  for levels in (whole, short))
    claim = claims.judge_temporality(kept, lost)
    assert claim.verdict == expected
    if expected == "reproduced":
        assert claim.here.value == pytest.approx(0.4, abs=0.01)


@pytest.mark.parametrize("value_power, entry_power, expected", [
    (1, 2, "reproduced"), (1.05, 1.95, "reproduced"), (1, 1.5, "partly"), (1.5, 2, "partly"),
    (2, 1, "contradicted"),
])
def test_tables_are_judged_by_the_powers_by_which_they_grow(value_power, entry_power, expected):
    states = np.array([4, 16, 64])
    tables = [np.tile(3.0 * states**power, (20, 1)) for power in (value_power, entry_power, 1.25)]
    claim = claims.judge_tables(states, *tables)
    assert claim.verdict == expected
    assert claim.here == pytest.approx([entry_power] * 3)
    assert claim.numbers["values"][0] == pytest.approx([value_power] * 3)
    assert claim.numbers["entries that differ from 0"][0] == pytest.approx([1.25] * 3)


def in_the_maze(day_12, later, runs=20, never=14.0):
    """Errors of the three groups, with a little noise; rats fed throughout make 2 per day from day 12 on."""
    noise = np.random.default_rng(0).normal(0, 0.1, (3, runs, 17))
    means = {"throughout": [14.0] * 11 + [2.0] * 6, "never": [14.0] * 11 + [never] * 6,
             "delayed": [14.0] * 11 + [day_12] + [later] * 5}
    return {group: Record(mean + each, known=None, ran=None) for (group, mean), each in zip(means.items(), noise)}


@pytest.mark.parametrize("rats, expected", [
    (in_the_maze(1.0, 1.0), "reproduced"), (in_the_maze(3.0, 1.0), "reproduced"),  # within a day or two
    (in_the_maze(2.1, 2.1), "partly"), (in_the_maze(6.0, 2.1), "contradicted"),  # level, but not at once
    (in_the_maze(2.1, 4.0), "contradicted"), (in_the_maze(14.0, 9.0), "contradicted"),
    (in_the_maze(1.0, 1.0, never=1.0), "not testable"), (in_the_maze(1.0, 1.0, runs=9), "no verdict"),
])
def test_latent_learning_is_judged_by_errors_after_the_first_reward(rats, expected):
    assert claims.judge_latent_learning(rats, {}).verdict == expected


def test_the_rivals_of_latent_learning_are_reported_and_not_judged():
    claim = claims.judge_latent_learning(in_the_maze(1.0, 1.0), {"another": in_the_maze(14.0, 8.0)})
    assert claim.here.value == pytest.approx(-1, abs=0.1)
    assert claim.numbers["with another"][0].value == pytest.approx(7, abs=0.1)
    assert claim.numbers["effect of reward"][0].value == pytest.approx(12, abs=0.1)


@pytest.mark.parametrize("single, chance, expected", [
    ((0.2, 0.4), 0.2, "reproduced"), ((0.3, 0.9), 0.1, "partly"), ((0.0, 0.1), 0.1, "contradicted"),
    ((0.3, 0.4), 0.1, "partly"),  # 2.5 times as much again is not marginal, however much several maps earn
    ((0.1, 0.105), 0.1, "contradicted")])  # a lead that no figure shows
def test_single_maps_gain_little_over_brownian_motion(single, chance, expected):
    assert claims.judge_margin(dict(enumerate(map(made_up, single))), brownian(chance)).verdict == expected


@pytest.mark.parametrize("together, alone, chance, expected", [
    (500, (300, 400), 300, "reproduced"), (500, (300, 400), 600, "partly"), (500, (300, 600), 300, "partly"),
    (500, (300, 600), 700, "contradicted")])
def test_exploration_is_compared_with_the_best_single_map_and_with_chance(together, alone, chance, expected):
    claim = claims.judge_exploration(final(together), [final(each) for each in alone], final(chance))
    assert claim.verdict == expected
    assert claim.here.value == pytest.approx(together / max(alone), abs=0.01)
    assert claims.judge_exploration(final(2)[:9], [final(1)], final(1)).verdict == "no verdict"
