"""The record of a build with 100 runs: its content, whether it still holds, and folds that explain their verdicts."""

import json
import re

import pytest
import record
from hypothesis import given
from hypothesis import strategies as st
from companion.page import report
from companion.page.marks import DECIDED

from companion.thesis.statements import AGENTS, STATEMENTS
from neorl.statistics import Estimate
from companion.thesis.verdict import VERDICTS, judged, outcome
from neorl.experiments.condition import source_digest

CLAIM = {"here": [1.0, 0.5, 1.5], "runs": 100, "verdict": "undecided", "numbers": {}}
FINDINGS = {"claims": dict.fromkeys(STATEMENTS, CLAIM), "letter": {}, "shares": {"A2": {"readings": 4}}}
recorded = pytest.mark.skipif(not record.RECORD.exists(), reason="nothing is recorded")


def explained(found):
    """The verdict that follows from the marks in the fold of a claim."""
    truths = {mark: true for true, mark in DECIDED.items()}
    return outcome({what: (truths.get(mark), role) for what, (*_, mark, role) in found["numbers"].items()})


def unexplained(found):
    """The claims of a record whose folds show another verdict than theirs, {name: (verdict, as shown)}.

    A verdict that does not come from intervals, such as *not testable*, has nothing to agree with.
    """
    return {name: (each["verdict"], explained(each))
            for part in ("claims", "letter") for name, each in found[part].items()
            if each["verdict"] in VERDICTS[:4] and each["verdict"] != explained(each)}


@recorded
def test_the_record_holds():
    moved = record.moved(record.of_book(None))
    assert not moved, f"{'; '.join(moved)}: runs are not as recorded: {record.REMEDY}"


@recorded
def test_the_record_is_of_all_claims_and_its_folds_explain_its_verdicts():
    found = record.of_book(None)
    assert record.unfit(found, {source_digest()}) == "" and unexplained(found) == {}
    assert record.RECORD.stat().st_size < 100_000


numbers = st.lists(st.integers(-8, 8), min_size=3, max_size=3).map(lambda each: Estimate(*sorted(each)))


some = st.dictionaries(st.sampled_from("abc"), numbers)


@given(st.sampled_from(AGENTS), numbers, some, some, numbers)
def test_a_fold_explains_the_verdict_on_any_numbers(name, here, asked, part, shown):
    found = report.kept([judged(name, here, 100, asked, {"shown": shown}, part)])
    assert unexplained({"claims": found, "letter": {}}) == {}


def test_a_fold_that_contradicts_its_verdict_is_noticed():
    fold = {"B over A": [[1, 0, 2], "more than 0", "?", "asked"], "C": [[1, 0, 2], "partly if 0", "?", "part"]}
    found = {"claims": {"C2": CLAIM | {"numbers": fold}, "C3": CLAIM | {"verdict": "reproduced", "numbers": fold}},
             "letter": {"C2": CLAIM | {"verdict": "not testable"}}}
    assert unexplained(found) == {"C3": ("reproduced", "undecided")}


@pytest.mark.parametrize("change, reason", [
    ({}, ""),
    ({"claims": {name: CLAIM for name in STATEMENTS if name not in ("B3", "T5")}}, "not B3, T5"),
    ({"claims": FINDINGS["claims"] | {"A4": CLAIM | {"runs": 99}, "T5": CLAIM | {"runs": 1}}}, "100 runs .* not A4$"),
    ({"shares": {}}, "not under other readings")])
def test_a_build_with_few_runs_or_without_some_claim_is_refused(change, reason):
    said = record.unfit(FINDINGS | change, {source_digest()})
    assert (bool(said), bool(re.search(reason, said))) == (bool(reason), True)
    assert "present source" in record.unfit(FINDINGS, {source_digest(), "an earlier one"})


@pytest.fixture
def made(tmp_path, monkeypatch):
    """`made(changed="")` runs the script on complete findings, and returns what it has written."""
    page = tmp_path / "page.json"
    page.write_text(json.dumps(FINDINGS | {"source": source_digest()}))
    monkeypatch.setattr(record, "RECORD", tmp_path / "record.json")
    monkeypatch.setattr(record, "SAMPLED", (("single", 10), "layers"))
    monkeypatch.setattr(record, "records", lambda: {"page": page})
    monkeypatch.setattr(record, "ROOT", tmp_path)

    def made(changed=""):
        monkeypatch.setattr(record, "output", lambda *command: changed if "status" in command else "abc1234")
        record.main()
        return record.RECORD.read_text()

    return made


def test_a_record_is_stable_and_its_sample_notices_other_bits(made, monkeypatch):
    text = made()
    found = json.loads(text)
    assert made() == text and found["commit"] == "abc1234" and found["claims"] == FINDINGS["claims"]
    assert record.moved(found) == [] and {*found["sample"]} == {"to the letter", "calibrated"}
    monkeypatch.setattr(record, "SEED", 1)
    assert record.moved(found) == [f"{reading}, {key}" for reading in ("calibrated", "to the letter")
                                   for key in ("single 10", "layers")]


def test_a_build_to_the_letter_replaces_its_claims_alone(made, tmp_path):
    calibrated = json.loads(made())
    other = CLAIM | {"verdict": "partly"}
    findings = {"claims": {}, "letter": dict.fromkeys(record.READ, other), "shares": {}}
    (tmp_path / "page.json").write_text(json.dumps(findings | {"source": source_digest()}))
    assert json.loads(made()) == calibrated | {"letter": findings["letter"]}
    (tmp_path / "page.json").write_text(json.dumps(FINDINGS | {"source": source_digest()}))
    assert json.loads(made()) == calibrated | {"letter": findings["letter"]}


def test_a_work_tree_with_changes_is_refused(made):
    with pytest.raises(SystemExit, match="the work tree must be clean, .*\n M neorl/checks.py"):
        made(" M neorl/checks.py")
    assert not record.RECORD.exists()


def test_without_a_record_a_build_shows_its_own(monkeypatch, tmp_path):
    monkeypatch.setattr(record, "RECORD", tmp_path / "record.json")
    assert record.of_book(FINDINGS) is FINDINGS


def test_numbers_are_recorded_to_six_digits():
    assert record.rounded({"here": [0.123456789, None, -1e-9, 7]}) == {"here": [0.123457, None, -1e-9, 7]}
