"""The rules of the verdicts, on results made up so that the answer is known."""

import json

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


@pytest.mark.parametrize("runs", [1, 2, 9])
def test_a_look_gives_no_verdicts(runs):
    assert set(verdicts(*as_the_paper_says(runs)).values()) == {"no verdict"}


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
