"""The rules of the verdicts, on results made up so that the answer is known."""

import json
from dataclasses import replace

import numpy as np
import pytest

from neorl import Result, WaterWorld, claims, place_cells


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
    judged = claims.judge_modalities(*paper_b()) + claims.judge_networks(*paper_c())
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
    judged = {claim.name: claim.verdict for claim in claims.judge_modalities(*change(*paper_b()))}
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
    judged = claims.judge_modalities(*paper_b(runs)) + claims.judge_networks(*paper_c(runs))
    assert {claim.verdict for claim in judged} == {"no verdict"}


def test_claims_are_kept_as_data(tmp_path, monkeypatch):
    monkeypatch.setenv("NEORL_CACHE", str(tmp_path))
    single, brownian, layers, together = as_the_paper_says()
    judged = claims.judge_single_layer(single, brownian)
    claims.store("paper_a", judged)
    kept = json.loads((tmp_path / "claims" / "paper_a.json").read_text())
    assert [claim["name"] for claim in kept["claims"]] == ["A1", "A2", "A3", "A4", "A5"]
    assert kept["claims"][3]["here"] == list(judged[3].here)
    assert kept["claims"][3]["runs"] == 20


def test_a_bound_that_does_not_exist_is_kept_as_null(tmp_path, monkeypatch):
    monkeypatch.setenv("NEORL_CACHE", str(tmp_path))
    claims.store("look", claims.judge_multiple_layers(*as_the_paper_says(runs=1)[2:]))
    text = (tmp_path / "claims" / "look.json").read_text()
    assert "NaN" not in text
    assert json.loads(text)["claims"][0]["here"][1:] == [None, None]


def test_tables_hold_every_claim_and_reading():
    single, brownian, layers, together = as_the_paper_says()
    layered = claims.judge_multiple_layers(layers, together)
    table = claims.table(layered)
    assert "**A6**" in table and "**A7**" in table and table.count("**reproduced**") == 2
    compared = claims.comparison({"one": claims.judge_single_layer(single, brownian) + layered, "other": layered})
    assert compared.splitlines()[0] == "| Reading | A1 | A2 | A3 | A4 | A5 | A6 | A7 |"
    assert compared.splitlines()[3].startswith("| other |  |  |  |  |  | ●\u00a00.16 |")


def test_a_summary_names_where_claims_hold_and_what_comes_closest():
    good, bad = (claims.judge_networks(*(made_up(0.0, final) for final in finals))
                 for finals in [(0.05, 0.15, 0.3, 0.6), (0.05, 0.02, 0.3, 0.1)])
    text = claims.summary({"default": bad, "other": good})
    assert "- **C1** Network A improves over time but stays weak: *default; other*." in text
    assert "- **C4** Recursion (D) improves on C drastically: *other*." in text
    assert "Closest to the paper comes *other*: 4 of its claims are reproduced and 0 partly." in text
    assert text.endswith("In the default reading they are 2 and 0.")
    assert "none of these readings" in claims.summary({"default": bad})
    assert claims.summary({"default": claims.judge_networks(*paper_c(runs=2))}) == (
        "With so few runs there is nothing to sum up.")
