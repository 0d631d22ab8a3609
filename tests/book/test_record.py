"""The record: its content, whether it still holds, and folds that explain their verdicts."""

import json
from dataclasses import replace

import numpy as np
import pytest
from computing import record
from hypothesis import given
from hypothesis import strategies as st
from companion.page import report
from companion.page.marks import DECIDED

from companion.thesis.statements import AGENTS, STATEMENTS
from companion.thesis.verdict import VERDICTS, judged, outcome
from neorl.experiments.condition import source_digest
from neorl.statistics import Estimate

CLAIM = {"here": [1.0, 0.5, 1.5], "runs": 100, "verdict": "undecided", "numbers": {}, "parts": [], "together": 1}
FINDINGS = {"claims": dict.fromkeys(STATEMENTS, CLAIM), "letter": {}, "shares": {"A2": {"readings": 4}}}


def explained(found):
    """The verdict that follows from the marks in the fold of a claim."""
    truths = {mark: true for true, mark in DECIDED.items()}
    decided = {what: truths[mark] for what, (*_, mark, _) in found["numbers"].items() if mark}
    return outcome(decided, [what for what in decided if found["numbers"][what][3] == "asked"], found["parts"])


def unexplained(found):
    """The claims of a record whose folds show another verdict than theirs, {name: (verdict, as shown)}.

    A verdict that does not come from intervals, such as *not testable*, has nothing to agree with.
    """
    return {name: (each["verdict"], explained(each))
            for part in ("claims", "letter") for name, each in found[part].items()
            if each["verdict"] in VERDICTS[:5] and each["verdict"] != explained(each)}


@pytest.mark.parametrize("sampled", [("layers", "both", ("network", "D"), "revalued"),
                                     pytest.param(record.SAMPLED, marks=pytest.mark.exact)], ids=["some", "all"])
def test_the_record_holds(sampled, monkeypatch):
    monkeypatch.setattr(record, "SAMPLED", sampled)
    moved = record.moved(report.record())
    assert not moved, f"{'; '.join(moved)}: runs are not as recorded: {record.REMEDY}"


def test_the_record_is_of_all_claims_and_its_folds_explain_its_verdicts():
    found = report.record()
    assert {*found["claims"]} == {*STATEMENTS} and unexplained(found) == {}
    assert {name for name, each in found["claims"].items() if each["runs"] < record.OF_PAGES} <= {
        "A10", "C5", "T1", "T2", "T3", "T5", "T10", "T11"}  # stored runs, times, and agents with other pasts
    assert record.RECORD.stat().st_size < 150_000


numbers = st.lists(st.integers(-8, 8), min_size=3, max_size=3).map(lambda each: Estimate(*sorted(each)))


some = st.dictionaries(st.sampled_from("abc"), numbers)


@given(st.sampled_from(AGENTS), numbers, some, some, numbers, st.sets(st.sampled_from("abc"), min_size=1))
def test_a_fold_explains_the_verdict_on_any_numbers(name, here, asked, also, shown, of_part):
    for parts in (None, [of_part]):
        found = report.kept([judged(name, here, 100, asked, also, {"shown": shown}, parts)])
        assert unexplained({"claims": found, "letter": {}}) == {}


def test_a_fold_that_contradicts_its_verdict_is_noticed():
    fold = {"B over A": [[1, 0, 2], "more than 0", "?", "asked"], "C": [[1, 0, 2], "partly if 0", "?", "part"]}
    found = {"claims": {"C2": CLAIM | {"numbers": fold}, "C3": CLAIM | {"verdict": "reproduced", "numbers": fold}},
             "letter": {"C2": CLAIM | {"verdict": "not testable"}}}
    assert unexplained(found) == {"C3": ("reproduced", "undecided")}


@pytest.fixture
def made(tmp_path, monkeypatch):
    """`made(changed="", **findings)` runs the script beside a build with these findings, and returns what it wrote.

    The record has paper A's groups alone, with a few runs of a few steps each.
    """
    page, few = tmp_path / "page.json", {"layers": 2}
    foragers = {name: replace(each, steps=600, runs=2) for name, each in record.FORAGERS.items()}
    for name, value in {"RECORD": tmp_path / "record.json", "SAMPLED": (("single", 10), "layers"), "ROOT": tmp_path,
                        "RUNS": {"claims": few, "letter": few},
                        "FORAGERS": foragers, "AT_50": {"layers": 2},
                        "CONTROLS": 2, "OF_PAGES": 2, "LENGTHS": {"A": 3_000, "B": 3_000},
                        "records": lambda: {"page": page}}.items():
        monkeypatch.setattr(record, name, value)
    monkeypatch.setattr(record, "of_reading", lambda results, runs: record.judge(results))
    monkeypatch.setattr(record.behind, "CURVES", tmp_path / "curves.json")

    def made(changed="", **findings):
        page.write_text(json.dumps(FINDINGS | {"source": source_digest()} | findings))
        monkeypatch.setattr(record, "output", lambda *command: changed if "status" in command else "abc1234")
        record.main()
        return record.RECORD.read_text()

    return made


OF_RUNS = {"A6", "A7"}  # that the groups suffice for


def test_a_record_has_claims_of_its_own_runs_and_those_of_pages_is_stable_and_notices_other_bits(made, monkeypatch):
    text = made()
    found = json.loads(text)
    assert made() == text and found["commit"] == "abc1234"
    assert {name for name in STATEMENTS if found["claims"][name] != CLAIM} == OF_RUNS == {*found["letter"]}
    curves = json.loads(record.behind.CURVES.read_text())["calibrated"]
    assert {*curves} == {"brownian 8", "layer 3", "layer 7", "layer 23", "layers", "forager", "forager of after-states"}
    assert curves["layer 7"]["runs"] == 2
    assert np.shape(curves["layer 7"]["curve"]) == (3, 50)
    assert np.mean(curves["layer 7"]["curve"][0]) == pytest.approx(curves["layer 7"]["whole"][0], abs=0.01)
    assert {*found["paper A at 50"]} == OF_RUNS and found["claims"]["A7"]["runs"] == 2
    assert record.moved(found) == [] and {*found["sample"]} == {"to the letter", "calibrated"}
    monkeypatch.setattr(record, "SEED", 1)
    assert record.moved(found) == [f"{reading}, {key}" for reading in ("calibrated", "to the letter")
                                   for key in ("single 10", "layers")]


def test_a_build_replaces_the_claims_of_pages_that_have_enough_runs_and_the_present_source(made):
    before = json.loads(made())["claims"]
    now = {"B5": CLAIM | {"verdict": "refuted by proof"}, "T7": CLAIM | {"runs": 1, "verdict": "partly"}}
    assert json.loads(made(claims=now))["claims"] == before | {"B5": now["B5"]}
    assert json.loads(made(claims={"B5": CLAIM}, source="another"))["claims"] == before | {"B5": now["B5"]}


def test_a_record_without_some_claim_is_refused(made):
    with pytest.raises(SystemExit, match="every claim must be judged, but not B3, T5: make book RUNS=2, then make rec"):
        made(claims={name: CLAIM for name in STATEMENTS if name not in ("B3", "T5")})
    assert not record.RECORD.exists()


def test_a_group_that_asks_for_more_runs_decides_and_brownian_motion_has_its_own(made):
    found = record.results_of(record.READINGS["calibrated"], {"layers": 1, "single": 2})
    assert {key if isinstance(key, str) else key[0]: each.runs for key, each in found.items()} == {
        "brownian": 2, "single": 2, "layer": 1, "layers": 1}
    assert {each.seed for each in found.values()} == {record.SEED}


def test_a_work_tree_with_changes_is_refused(made):
    with pytest.raises(SystemExit, match="the work tree must be clean, .*\n M neorl/common/checks.py"):
        made(" M neorl/common/checks.py")
    assert not record.RECORD.exists()
