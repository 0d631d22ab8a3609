"""The rules that judge claims of the thesis itself, on made-up measurements with a known answer."""

from dataclasses import replace

import numpy as np
import pytest
from test_claims import brownian, result_of, made_up

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
    claim = claims.judge_exploration(final(together), {str(each): final(each) for each in alone}, final(chance))
    assert claim.verdict == expected
    assert claim.here.value == pytest.approx(together / max(alone), abs=0.01)
    assert claims.judge_exploration(final(2)[:9], {"N3": final(1)}, final(1)).verdict == "no verdict"


def catching(before, after, final, runs=20):
    """Runs that catch creeps, this many a second before half-time, in the first tenth after it, and finally."""
    result = result_of(np.full(6_000, 0.1), runs, steps=60_000)
    hits = np.zeros((runs, 6_000, 2), np.int16)
    hits[:, ::5, 0] = before
    hits[:, 3_000:3_600:5, 0], hits[:, 3_600::5, 0] = after, final
    hits[0, 3_000:3_100] = hits[0, 3_000:3_100, ::-1]  # some are red
    return replace(result, hits=hits)


def moves(first, later, ignorant=0.5):
    noise = np.random.default_rng(0).normal(0, 0.01, (20, 6))
    return {"experienced": np.where(np.arange(6) < 2, first, later) + noise, "ignorant": ignorant + noise}


@pytest.mark.parametrize("after, frozen, moved, expected", [
    (catching(1, 5, 5), catching(1, 5, 5), moves(0.1, 0.1), "reproduced"),
    # Forgets again, and catches no more finally than before: the rise was divided by almost nothing, or less.
    (catching(1, 5, 0), catching(1, 5, 5), moves(0.1, 0.1), "reproduced"),
    (catching(1, 2, 5), catching(1, 5, 5), moves(0.1, 0.1), "partly"),  # has to learn
    (catching(1, 1, 1), catching(1, 1, 1), moves(0.1, 0.1), "partly"),  # no better than chance
    (catching(1, 5, 5), catching(1, 5, 5), moves(0.3, 0.1), "partly"),  # nearer at later visits
    (catching(1, 5, 5), catching(1, 5, 5), moves(0.6, 0.6), "partly"),  # ignorant agents are nearer
    # The ratio of distances was inverted: 0.34 and 0.30, then 0.10 passed.
    (catching(1, 2, 5), catching(1, 5, 5), moves(0.30, 0.10, 0.34), "contradicted"),
    (catching(1, 5, 5, runs=9), catching(1, 5, 5), moves(0.1, 0.1), "no verdict")])
def test_new_desires_are_served_at_once_or_need_learning(after, frozen, moved, expected):
    turned = {"revalued": after, "frozen": frozen, "wanting": catching(5, 0, 0)}
    distances = {"both": moved, "place cells": moves(0.9, 0.9)}  # which do not decide
    claim = claims.judge_changes(turned, catching(1, 1, 1), distances)
    assert claim.verdict == expected
    assert claim.numbers["caught a minute, first minute"][0].value == pytest.approx(
        60 * after.hits[:, 3_000:3_030].sum(axis=(1, 2)).mean() / 6)
    assert claim.numbers["distance at later visits, ignorant with place cells"][0].value == pytest.approx(0.5, abs=0.01)


def test_the_window_after_a_change_of_desires_is_shown_beside_agents_that_moved_at_random():
    turned = {"revalued": catching(1, 5, 3), "frozen": catching(1, 5, 5), "wanting": catching(5, 0, 0)}
    turned["random"] = catching(1, 9, 9)
    numbers = claims.judge_changes(turned, catching(1, 1, 1), dict.fromkeys(("both", "place cells"),
                                                                           moves(0.1, 0.1))).numbers
    assert numbers["share in the second minute"][0].value == pytest.approx(1)
    assert numbers["share in the first minute, of those that had moved at random"][0].value == pytest.approx(0.5)


@pytest.mark.parametrize("changed, removed, expected", [
    (5, 5, "reproduced"), (1, 5, "partly"), (5, 1, "partly"), (1, 1, "contradicted")])
def test_what_agents_know_is_what_they_catch_of_what_they_come_to_desire(changed, removed, expected):
    turned = {"changed": (catching(1, 5, changed), catching(1, 5, 5)), "removed": (catching(1, 5, removed),
                                                                                  catching(1, 5, 5))}
    claim = claims.judge_knowledge(turned, catching(1, 1, 1))
    assert claim.verdict == expected
    assert claim.here.value == pytest.approx((min(changed, removed) - 1) / 4, abs=0.02)
    assert claims.judge_knowledge(turned, catching(6, 6, 6)).verdict == "not testable"


@pytest.mark.parametrize("both, points, expected", [
    ((5, 5), (0.6, 0.6), "reproduced"), ((1, 5), (0.6, 0.6), "partly"), ((5, 5), (0.6, 0.2), "partly"),
    ((1, 5), (0.2, 0.6), "contradicted")])
def test_pasts_are_compared_by_how_well_they_serve_each_desire(both, points, expected):
    pasts = {"both": {was: catching(1, each, each) for was, each in zip(("none", "green"), both)},
             "papers": {was: made_up(each) for was, each in zip(("none", "green"), points)}}
    chance = catching(1, 1, 1)
    chance.rewards[:] = 0
    assert claims.judge_pasts(pasts, chance).verdict == expected


@pytest.mark.parametrize("levels, expected", [
    ((0.1, 0.2, 0.3), "reproduced"), ((0.3, 0.2, 0.1), "partly"), ((0.0, 0.0, 0.0), "partly")])
def test_scaling_is_a_strong_correlation_of_reward_with_the_number_of_maps(levels, expected):
    grown = {"place cells": [made_up(0.1 * k) for k in (1, 2, 3)], "object-vector cells": [*map(made_up, levels)]}
    claim = claims.judge_scaling(grown, brownian())
    assert claim.verdict == expected and claim.numbers["final reward per second, place cells, 2 maps"]
    assert claims.judge_scaling(grown, brownian(0.5)).verdict == "not testable"


@pytest.mark.parametrize("together, expected", [(7.0, "reproduced"), (8.5, "contradicted")])
def test_the_cost_of_maps_is_judged_by_the_sum_of_what_each_costs(together, expected):
    alone = [np.full(10, 3.0), np.full(10, 5.0)]  # 1 of each is the world's
    claim = claims.judge_cost(np.full(10, together), alone, np.full(10, 1.0))
    assert (claim.verdict, claim.here.value) == (expected, pytest.approx((together - 1) / 6))
    assert claims.judge_cost(np.full(9, 7.0), alone, np.full(10, 1.0)).verdict == "no verdict"


@pytest.mark.parametrize("more, expected", [
    ((made_up(0.2, 0.6), made_up(0.0, 0.4)), "reproduced"),
    ((made_up(0.2, 0.6), made_up(0.0, 0.28)), "partly"),  # as quick, and no better: this was reproduced
    ((made_up(0.2, 0.6), made_up(0.0, 0.4, learned_by=0.5)), "partly"),
    ((made_up(0.0, 0.6, learned_by=0.4), made_up(0.2, 0.28)), "contradicted"),  # each half in one setting alone
    ((made_up(0.0, 0.6, learned_by=0.4), made_up(0.0, 0.28, learned_by=0.5)), "contradicted")])
def test_more_maps_are_compared_with_the_quickest_of_those_with_fewer(more, expected):
    fewer = {"slow": made_up(0.0, 0.3, learned_by=0.6), "quick": made_up(0.0, 0.3)}
    additions = {name: (each, fewer, brownian()) for name, each in zip(("maps", "a modality"), more)}
    claim = claims.judge_more_maps(additions)
    assert claim.verdict == expected and "minutes sooner, a modality, over slow" in claim.numbers
    assert claim.together == 8
    nothing = {name: (each, fewer, brownian(0.5)) for name, (each, fewer, _) in additions.items()}
    assert claims.judge_more_maps(nothing).verdict == "not testable"


@pytest.mark.parametrize("steps, expected", [
    ({"γ 0.8": 0.1, "γ 0.99": 0.11}, "reproduced"), ({"γ 0.8": 0.1, "γ 0.99": 0.3}, "partly"),
    ({"γ 0.8": 0.1, "γ 0.99": 0.7}, "contradicted")])
def test_persistence_is_needed_where_the_best_of_temporal_difference_fails(steps, expected):
    per_step = {name: made_up(final) for name, final in steps.items()}
    agents = {"place cells": (made_up(0.6), per_step, brownian(0.1))}
    claim = claims.judge_persistence(agents)
    assert claim.verdict == expected
    unlearned = {"both": (made_up(0.6), per_step, brownian(0.7))}
    assert claims.judge_persistence(unlearned).verdict == "not testable"
    assert claims.judge_persistence(agents | unlearned).here == claim.here


@pytest.mark.parametrize("stays, expected", [
    ([3.0, 1.0, 0.3], "reproduced"), ([3.0, 1.0, 1.2], "contradicted"), ([1.2, 1.1, 1.0], "contradicted"),
    ([2.0, 1.0, 0.5], "reproduced"),  # as motion alone has it: this was partly
    ([0.3, 1.0, 3.0], "contradicted")])
def test_the_time_scale_is_judged_by_the_stay_in_a_cell_and_shown_beside_that_of_motion_alone(stays, expected):
    noise = np.random.default_rng(0).uniform(0.99, 1.01, (20, 3))
    alone = {"Brownian motion": [2.2, 1.0, 0.45] * noise}
    claim = claims.judge_time_scale([3, 7, 23], stays * noise, alone)
    assert claim.verdict == expected and claim.numbers["exponent, Brownian motion"][0].value > 0.5
    order = [2, 0, 1]
    assert claim == claims.judge_time_scale([23, 3, 7], (stays * noise)[:, order],
                                            {name: each[:, order] for name, each in alone.items()})
