"""The rules of the verdicts, on results made up so that the answer is known."""

from dataclasses import replace

import numpy as np
import pytest

from neorl import Result, WaterWorld, claims, place_cells
from neorl.statements import STATEMENTS


def made_up(early, final=None, runs=20):
    """A result whose runs make `early` a second in the first tenth and `final` after it, with a little noise."""
    final = early if final is None else final
    world, bins = WaterWorld(), 1_000
    rate = np.where(np.arange(bins) < bins // 10, early, final)
    noise = np.random.default_rng(0).normal(0, 0.02, (runs, 1))
    rewards = ((rate + noise) * 0.2).astype(np.float32)
    return Result(place_cells([1]), world, bins * 10, runs, 0, rewards, np.zeros((runs, bins, 2), np.int16))


def as_the_paper_says(runs=20):
    single = {10: made_up(0.50, 0.6, runs), 30: made_up(0.40, 0.7, runs), 50: made_up(0.30, 1.0, runs),
              70: made_up(0.20, 0.95, runs), 90: made_up(0.10, 0.90, runs)}
    layers = {3: made_up(0.1, 0.05, runs), 7: made_up(0.1, 0.2, runs), 23: made_up(0.05, 0.3, runs)}
    return single, made_up(0.0, runs=runs), layers, made_up(0.2, 0.7, runs)


def verdicts(single, brownian, layers, together):
    judged = claims.judge_single_layer(single, brownian) + claims.judge_multiple_layers(layers, together)
    return {claim.name: claim.verdict for claim in judged}


def test_results_like_the_papers_are_judged_reproduced():
    assert set(verdicts(*as_the_paper_says()).values()) == {"reproduced"}


@pytest.mark.parametrize("name, change, expected", [
    ("A1", lambda single, brownian, *rest: (single, made_up(0.05), *rest), "partly"),
    ("A1", lambda single, brownian, *rest: (single, made_up(0.4), *rest), "not reproduced"),
    ("A2", lambda single, *rest: ({**single, 90: made_up(-0.1)}, *rest), "partly"),
    ("A2", lambda single, *rest: ({n: made_up(-0.1) for n in single}, *rest), "not reproduced"),
    ("A3", lambda single, *rest: ({n: made_up(0.5 - n / 300) for n in single}, *rest), "partly"),
    ("A3", lambda single, *rest: ({n: made_up(n / 300, 0.9 - n / 150) for n in single}, *rest), "not reproduced"),
    ("A4", lambda single, *rest: ({**single, 10: made_up(0.94)}, *rest), "partly"),
    ("A4", lambda single, *rest: ({**single, 10: made_up(2.0)}, *rest), "not reproduced"),
    ("A5", lambda single, *rest: ({**single, 70: made_up(0.295)}, *rest), "partly"),
    ("A5", lambda single, *rest: ({**single, 70: made_up(0.1)}, *rest), "not reproduced"),
    ("A6", lambda *given: (*given[:3], made_up(0.2, 0.5)), "partly"),
    ("A6", lambda *given: (*given[:3], made_up(0.2, 0.25)), "not reproduced"),
    ("A7", lambda *given: (*given[:3], made_up(0.2, 0.4)), "partly"),
    ("A7", lambda *given: (*given[:3], made_up(0.0, 0.7)), "partly"),
    ("A7", lambda *given: (*given[:3], made_up(0.2, 0.1)), "not reproduced"),
    ("A3", lambda single, *rest: ({n: made_up(-0.1 + n / 1000) for n in single}, *rest), "not testable"),
    ("A4", lambda single, *rest: ({n: made_up(-0.1) for n in single}, *rest), "not testable"),
    ("A5", lambda single, *rest: ({n: made_up(0.0) for n in single}, *rest), "not testable"),
    ("A6", lambda *given: (*given[:2], {n: made_up(0.0) for n in (3, 7, 23)}, given[3]), "not testable"),
    ("A7", lambda *given: (*given[:2], {**given[2], 7: made_up(0.0)}, given[3]), "not testable"),
])
def test_results_unlike_the_papers_are_judged_otherwise(name, change, expected):
    assert verdicts(*change(*as_the_paper_says()))[name] == expected


def paper_b(runs=20):
    """A tenth of the run is 20 minutes."""
    place = {2: made_up(0.05, 0.1, runs), 13: made_up(0.1, 0.2, runs), "all": climbing(0.29, 180, runs)}
    objects = {2: made_up(0.05, 0.1, runs), 13: made_up(0.1, 0.2, runs), "all": climbing(0.3, 100, runs)}
    return place, objects, climbing(0.56, 10, runs)


def paper_b_judged(place, objects, both):
    return [*claims.judge_modalities(place, objects, both), claims.judge_pace(place["all"], both)]


def climbing(final, minutes, runs=20):
    """A result of 200 simulated minutes whose runs climb to `final` a second in so many of them."""
    result = made_up(1.0, runs=runs)
    bins = 60_000
    rate = np.minimum(np.arange(bins) / 300 / minutes, 1) * final
    noise = np.random.default_rng(0).uniform(0.95, 1.05, (runs, 1))
    hits = np.zeros((runs, bins, 2), np.int16)
    return replace(result, steps=600_000, rewards=(rate * noise * 0.2).astype(np.float32), hits=hits)


def paper_c(runs=20):
    return [made_up(early, final, runs) for early, final in [(0.0, 0.05), (0.1, 0.15), (0.1, 0.3), (0.2, 0.6)]]


def test_results_like_those_of_papers_b_and_c_are_judged_reproduced():
    judged = paper_b_judged(*paper_b()) + claims.judge_networks(*paper_c())
    assert {claim.name: claim.verdict for claim in judged} == dict.fromkeys(
        ["B1", "B2", "B3", "B4", "C1", "C2", "C3", "C4"], "reproduced")


@pytest.mark.parametrize("name, change, expected", [
    ("B1", lambda pc, ovc, both: (pc, {**ovc, "all": climbing(0.15, 100)}, both), "partly"),
    ("B1", lambda pc, ovc, both: ({**pc, "all": climbing(0.29, 1)}, ovc, both), "partly"),
    ("B1", lambda pc, ovc, both: (pc, {**ovc, "all": climbing(0.1, 100)}, both), "not reproduced"),
    ("B2", lambda pc, ovc, both: (pc, {**ovc, 13: made_up(0.4)}, both), "partly"),
    ("B2", lambda pc, ovc, both: ({**pc, 2: made_up(0.4)}, {**ovc, 13: made_up(0.4)}, both), "not reproduced"),
    ("B3", lambda pc, ovc, both: (pc, ovc, climbing(0.5, 10)), "partly"),
    ("B3", lambda pc, ovc, both: (pc, {**ovc, "all": climbing(0.7, 100)}, both), "partly"),
    ("B3", lambda pc, ovc, both: (pc, ovc, climbing(0.25, 10)), "not reproduced"),
    ("B4", lambda pc, ovc, both: (pc, ovc, climbing(0.56, 60)), "partly"),
    ("B4", lambda pc, ovc, both: ({**pc, "all": climbing(0.29, 50)}, ovc, both), "partly"),
    ("B4", lambda pc, ovc, both: ({**pc, "all": climbing(0.29, 5)}, ovc, both), "not reproduced"),
    ("B4", lambda pc, ovc, both: (pc, ovc, made_up(0.5)), "not testable"),
    ("B3", lambda pc, ovc, both: (pc, {**ovc, "all": made_up(0.0)}, both), "not testable"),
])
def test_modalities_unlike_the_papers_are_judged_otherwise(name, change, expected):
    judged = {claim.name: claim.verdict for claim in paper_b_judged(*change(*paper_b()))}
    assert judged[name] == expected


@pytest.mark.parametrize("name, agent, early, final, expected", [
    ("C1", 0, 0.05, 0.05, "partly"), ("C1", 0, 0.0, 0.2, "partly"), ("C1", 0, 0.2, 0.2, "not reproduced"),
    ("C2", 1, 0.1, 0.05, "partly"), ("C2", 1, 0.1, 0.02, "not reproduced"), ("C2", 1, 0.1, 0.0, "not testable"),
    ("C3", 2, 0.1, 0.15, "partly"), ("C3", 2, 0.1, 0.1, "not reproduced"),
    ("C4", 3, 0.1, 0.4, "partly"), ("C4", 3, 0.1, 0.3, "not reproduced"), ("C4", 2, 0.0, 0.0, "not testable"),
])
def test_networks_unlike_the_papers_are_judged_otherwise(name, agent, early, final, expected):
    results = paper_c()
    results[agent] = made_up(early, final)
    assert {claim.name: claim.verdict for claim in claims.judge_networks(*results)}[name] == expected


def taking(red_before, red_after, runs=20):
    """A result whose runs take so many red creeps in each bin before half-time and after it."""
    result = made_up(0.1, runs=runs)
    hits = np.zeros((runs, 1_000, 2), np.int16)
    hits[:, :500, 1], hits[:, 500:, 1] = red_before, red_after
    return replace(result, hits=hits)


@pytest.mark.parametrize("revalued, throughout, expected", [
    (taking(1, 3), taking(2, 2), "reproduced"), (taking(1, 3), taking(4, 4), "partly"),
    (taking(1, 1), taking(1, 1), "not reproduced"), (taking(1, 3, runs=9), taking(2, 2), "no verdict"),
])
def test_a_turn_of_wishes_is_judged_by_what_follows_at_once(revalued, throughout, expected):
    assert claims.judge_revaluing(revalued, throughout).verdict == expected


def test_red_creeps_are_counted_a_minute():
    claim = claims.judge_revaluing(taking(1, 3), taking(2, 2))
    assert claim.here == pytest.approx((300, 300, 300))  # one more in each 0.2 s
    assert "Before the turn it is 300.00" in claim.detail


@pytest.mark.parametrize("together, expected", [(7.0, "reproduced"), (8.5, "not reproduced")])
def test_the_cost_of_maps_is_judged_by_the_sum_of_what_each_costs(together, expected):
    alone = [np.full(10, 3.0), np.full(10, 5.0)]  # of which 1 is the world's
    claim = claims.judge_cost(np.full(10, together), alone, np.full(10, 1.0))
    assert (claim.verdict, claim.here.value) == (expected, pytest.approx((together - 1) / 6))
    assert claims.judge_cost(np.full(9, 7.0), alone, np.full(10, 1.0)).verdict == "no verdict"


@pytest.mark.parametrize("runs", [1, 2, 9])
def test_a_look_gives_no_verdicts(runs):
    assert set(verdicts(*as_the_paper_says(runs)).values()) == {"no verdict"}
    judged = paper_b_judged(*paper_b(runs)) + claims.judge_networks(*paper_c(runs))
    assert {claim.verdict for claim in judged} == {"no verdict"}


@pytest.mark.parametrize("name, change, expected", [
    ("A4", lambda single, *rest: ({**single, 10: made_up(0.93)}, *rest), True),  # within the noise of N50
    ("A4", lambda single, *rest: ({**single, 10: made_up(2.0)}, *rest), False),
    ("A4", lambda *given: given, False),  # holds
    ("A2", lambda single, *rest: ({**single, 90: made_up(0.0)}, *rest), True),
    ("A2", lambda single, *rest: ({**single, 90: made_up(-0.1)}, *rest), False),
    ("A7", lambda *given: (*given[:3], made_up(0.0, 0.7)), False),  # slower early
    ("A4", lambda single, *rest: ({n: made_up(-0.1) for n in single}, *rest), False),  # nothing learned
])
def test_a_claim_is_open_while_its_intervals_leave_room_for_it(name, change, expected):
    single, brownian, layers, together = change(*as_the_paper_says())
    judged = claims.judge_single_layer(single, brownian) + claims.judge_multiple_layers(layers, together)
    assert {claim.name: claim.open for claim in judged}[name] is expected


def test_a_few_runs_have_an_outcome_but_no_verdict():
    claim = claims.judge_networks(*paper_c(runs=4))[1]
    assert (claim.outcome, claim.verdict) == ("reproduced", "no verdict")


@pytest.mark.filterwarnings("error")
def test_agents_that_have_earned_nothing_are_no_reason_to_divide_by_zero():
    nothing = made_up(0.0, runs=4)
    nothing = replace(nothing, rewards=np.zeros_like(nothing.rewards))
    judged = claims.judge_single_layer(dict.fromkeys((10, 30, 50, 70, 90), nothing), nothing)
    judged += claims.judge_networks(nothing, nothing, nothing, nothing)
    assert {claim.outcome for claim in judged} <= {"reproduced", "not reproduced", "not testable"}


def test_every_rule_is_named_in_the_statements():
    rules = {name for name in vars(claims) if name.startswith("judge_")}
    assert {statement.rule for statement in STATEMENTS.values()} - {""} == rules
