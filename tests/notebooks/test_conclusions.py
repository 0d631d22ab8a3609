"""The two conclusions, for made-up verdicts."""

import re

import pytest

from lib.chapter_5 import conclusions
from lib.chapter_5.conclusions import BEYOND, GROUND, SEPARATION, SUPERPOSITION
from neorl.evidence.report import CALIBRATED, LETTER
from neorl.evidence.statements import CLAIMS



def record(calibrated, letter=None, shares=None):
    """A record of claims from {name: verdict}; claims that are left out have no verdict."""
    of_readings = {part: {name: {"here": [0.5, 0.4, 0.6], "runs": 20, "verdict": verdict, "detail": f"So {name} is."}
                          for name, verdict in found.items()}
                   for part, found in (("claims", calibrated), ("letter", letter or {}))}
    return {**of_readings, "shares": shares or {}}


def verdicts(*found):
    return conclusions.verdicts_by_reading(record(*found))


def what_did_not_hold(*found):
    made = record(*found)
    return conclusions.what_did_not_hold(made, conclusions.verdicts_by_reading(made)).split("\n\n")


def all_claims(verdict):
    return dict.fromkeys(CLAIMS, verdict)


def test_every_claim_belongs_to_one_conclusion_or_to_the_ground():
    assert sorted([*SUPERPOSITION, *SEPARATION, *GROUND, *BEYOND]) == sorted(CLAIMS)


def test_each_reading_has_verdicts_of_its_own():
    found = verdicts({"A2": "reproduced"}, {"A2": "partly"})
    assert list(found) == [LETTER, CALIBRATED]
    assert (found[LETTER]["A2"], found[CALIBRATED]["A2"]) == ("partly", "reproduced")
    assert found[CALIBRATED]["A3"] == "not computed in this build"
    assert conclusions.both_verdicts(found)["A2"] == "*reproduced* in the calibrated reading, *partly* to the letter"
    assert conclusions.both_verdicts(verdicts({"A2": "partly"}, {"A2": "partly"}))["A2"] == "*partly* in both readings"


def test_the_box_counts_verdicts():
    text = conclusions.in_short(verdicts(all_claims("reproduced") | {"A1": "partly", "C5": "partly"}, {"A2": "partly"}))
    text = re.sub("<[^>]+>", "", text).replace("\u00a0", " ")
    assert (f"results: to the letter, ◐ 1 partly, {len(CLAIMS) - 1} judged only in the calibrated reading; calibrated, "
            f"● {len(CLAIMS) - 2} reproduced, ◐ 2 partly. In the calibrated reading the two conclusions hold as "
            "follows. **Superposition**: *in full* (reproduced: A2, ") in text


def test_the_box_counts_claims_that_neither_reading_has():
    text = conclusions.in_short(verdicts({"A1": "partly"}, {"A2": "partly"}))
    missing = f"{len(CLAIMS) - 1} not computed in this build"
    assert f"1 judged only in the calibrated reading, {len(CLAIMS) - 2} not computed in this build; " in text
    assert f"partly, {missing}. In the calibrated reading" in text


@pytest.mark.parametrize("found, held", [
    ({}, "*without a verdict*"), (dict.fromkeys(SEPARATION, "no verdict"), "*without a verdict*"),
    (dict.fromkeys(SEPARATION, "reproduced"), "*in full* (reproduced: T1, T7, C1, C2, C3, C4, of 6 claims judged)"),
    ({"T1": "reproduced", "C1": "not reproduced", "C2": "no verdict"},
     "*in part* (reproduced: T1, of 2 claims judged)"),
    ({"T1": "partly", "C1": "not testable"}, "*undecided* (1 partly, 1 not testable)"),
    ({"T1": "partly", "C1": "not reproduced"}, "*not at all* (1 partly, 1 not reproduced)"),
])
def test_a_conclusion_holds_as_far_as_its_claims_do(found, held):
    lines = conclusions.overview(verdicts(found, {"C4": "reproduced"})).splitlines()
    assert ("- **Learning apart from behaviour**: to the letter, *in part* (reproduced: C4, of 1 claims judged); "
            f"calibrated, {held}.") in lines
    assert "- **Superposition**: to the letter, *without a verdict*; calibrated, *without a verdict*." in lines


def test_what_was_not_reproduced_stands_beside_the_thesis():
    first, *_ = what_did_not_hold({"A2": "not reproduced", "A3": "reproduced"})
    assert first == "Not reproduced in the calibrated reading:"
    _, line, *_ = what_did_not_hold({"A2": "not reproduced", "A3": "reproduced"})
    assert line == ("- **A2** Every single resolution beats Brownian motion. *Smallest lead over the control in "
                    "reward per second.* Thesis: > 0; here: 0.50 [0.40, 0.60]. So A2 is.")


def test_without_a_failure_there_is_none_to_list():
    first, *_ = what_did_not_hold({"A2": "partly"}, {"A2": "not reproduced"})
    assert first.startswith("No claim was judged not reproduced in the calibrated reading")


def test_readings_differ_in_claims_that_both_have_judged():
    _, second, *_ = what_did_not_hold(
        {"A2": "reproduced", "A3": "reproduced", "A4": "partly", "A5": "reproduced", "A6": "partly"},
        {"A2": "reproduced", "A3": "partly", "A4": "reproduced", "A6": "not testable"})
    assert second == ("Reproduced in the calibrated reading but not to the letter: A3; to the letter but not in the "
                      "calibrated reading: A4.")
    _, second, *_ = what_did_not_hold({"A2": "reproduced"})
    assert second == ("Reproduced in the calibrated reading but not to the letter: none; to the letter but not in the "
                      "calibrated reading: none.")


def test_other_verdicts_are_listed_where_there_are_any():
    some = all_claims("reproduced") | {"A2": "partly", "A3": "not testable", "A4": "not testable"}
    del some["T8"]
    assert what_did_not_hold(some)[2:] == [
        "Partly: A2; the page of claims gives the details.",
        "Not testable, because the agents have not learned: A3, A4.",
        "Not computed when this page was built: T8."]
    assert len(what_did_not_hold(all_claims("reproduced"))) == 2


def test_claims_that_hold_in_no_short_run_or_are_undecided_in_most_are_named():
    shares = {"A2": {"holds": 0, "undecided": 2, "readings": 4}, "A3": {"holds": 1, "undecided": 3, "readings": 4},
              "H1": {"holds": 0, "undecided": 8, "readings": 8}}
    assert what_did_not_hold(all_claims("reproduced"), {}, shares)[-1] == (
        "In short runs under 4 readings within the text, A2 held under none that could be decided; A3 was undecided "
        "under more than half of them.")
    shares["A3"]["readings"] = 5
    assert "In short runs under 4 to 5 readings within" in what_did_not_hold(all_claims("reproduced"), {}, shares)[-1]
    del shares["A2"], shares["A3"]
    assert len(what_did_not_hold(all_claims("reproduced"), {}, shares)) == 2  # H1 is a demonstration
