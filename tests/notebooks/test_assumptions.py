"""Sentences and tables of the page on assumptions, for made-up claims whose answers are known."""

from dataclasses import replace

import pytest

from lib import assumptions
from lib.study import multiverse
from lib.study.calibration import design
from lib.study.calibration_table import Row
from lib.study.calibration_targets import GROUPS, Measure
from lib.study.multiverse import Support
from neorl.evidence.priors import BEYOND, TO_THE_LETTER, WITHIN
from neorl.evidence.reading import Reading, conditions
from neorl.evidence.statistics import Estimate
from neorl.evidence.verdict import Claim


def claim(name, holds=False, value=0.0, undecided=False):
    return Claim(name, Estimate(value, value, value), "", 4, "reproduced" if holds else "not reproduced", undecided)


def claims(held, others=()):
    """Claims under one reading, {name: Claim}: some hold, the others fail."""
    return {name: claim(name, name in held) for name in (*held, *others)}


def plain(text):
    return text.replace("\u00a0", " ")


@pytest.fixture
def shares():
    """Shares of three claims, of which B1 has also been run at the papers' lengths."""
    return {"A2": {"holds": 3, "undecided": 1, "untestable": 0, "readings": 4},
            "B1": {"holds": 0, "undecided": 0, "untestable": 2, "readings": 4, "agrees": 1, "measured": 5},
            "C1": {"holds": 2, "undecided": 1, "untestable": 1, "readings": 4}}


def test_readings_are_judged_by_the_results_of_their_own_conditions(monkeypatch):
    monkeypatch.setattr(assumptions, "sweep", iter)
    monkeypatch.setattr(assumptions, "judge", lambda results: results)
    readings = [TO_THE_LETTER, Reading()]
    found = assumptions.judge_readings(readings, ["layers", "revaluing"], 3_000, 2, 7)
    assert found == [conditions(reading, 3_000, 2, 7, ["layers", "revaluing"]) for reading in readings]


def test_every_claim_that_readings_matter_for_comes_from_cheap_or_expensive_conditions():
    groups = (*assumptions.CHEAP, *assumptions.EXPENSIVE)
    assert set(conditions(Reading(), 3_000, 2)) == set(conditions(Reading(), 3_000, 2, groups=groups))


def test_shares_are_in_the_order_of_the_claims_and_include_those_at_the_papers_lengths():
    rows = [Row(0, i, 2, 600_000, reading, {name: Measure(value, 0.0) for name in GROUPS["layers"].targets})
            for i, (reading, value) in enumerate(zip(design(4), (3.0, 3.0, 3.0, -9.0)))]
    found = assumptions.shares([claims(["C1", "A6"]), claims(["A6"], ["C1"])], [claims([], ["A2"])], rows)
    assert list(found) == ["A2", "A6", "C1"]
    assert found["A6"] == {"holds": 2, "undecided": 0, "untestable": 0, "readings": 2, "agrees": 3, "measured": 4}
    assert found["C1"]["holds"] == 1 and found["C1"]["measured"] == 0 and found["A2"]["readings"] == 1


def test_importances_are_learned_from_enough_readings():
    readings = multiverse.design(32)
    judged = [{"C2": claim("C2", value=WITHIN["discount"].place(reading.discount))} for reading in readings]
    part = [claims([], ["A2"])] * 4
    importance, explained = assumptions.importances((readings, judged), (readings[:4], part))
    assert list(importance) == ["A2", "C2"] and importance["A2"] == {} and list(explained) == ["C2"]
    assert max(importance["C2"], key=importance["C2"].get) == "discount"
    too_few = assumptions.importances((readings[:31], judged[:31]))
    assert too_few == ({"C2": {}}, {})


def test_a_claim_is_predicted_if_choices_explain_a_tenth_of_it():
    assert assumptions.predicted({"A1": 0.1, "A2": 0.09, "A3": -1.0, "A4": 0.9}) == ["A1", "A4"]


def test_the_agreement_at_length_is_of_the_claims_that_were_measured(shares):
    shares["C1"] |= {"agrees": 3, "measured": 4}
    text = plain(assumptions.agreement_at_length(shares))
    assert text.endswith("agree with the thesis in: **B1** 20 %, **C1** 75 %. The average is 48 %.")


def test_claims_that_hold_in_short_runs_are_counted(shares):
    judged = [claims(["B1", "C1"]), claims(["B1"], ["C1"]), claims([], ["B1", "C1"])]
    part = [claims([], ["A2"])] * 2
    text = plain(assumptions.holding_in_short_runs(shares, judged, part, 30_000, 2))
    assert "behaviour (10 minutes of simulated time at 50 steps per second, 2 runs per condition), 3 claims" in text
    assert "3 claims were judged under 3 readings within the text, the expensive ones (A2) under 2" in text
    assert ("a claim holds in **42 %** of the readings. In more than half of them: A2; in none of them: B1."
            in text)
    assert text.endswith("Of the 2 claims that were judged under every reading, 2 hold under the best reading, and "
                         "1.0 on average.")
    shares |= {"A2": shares["C1"], "B1": shares["C1"]}
    text = assumptions.holding_in_short_runs(shares, judged, part, 30_000, 2)
    assert "In more than half of them: none; in none of them: none." in text


def test_claims_are_listed_by_the_choice_that_matters_most():
    importance = {"A1": {"credit": 0.2, "discount": 0.5}, "A2": {"credit": 0.3}, "A3": {"discount": 0.1}, "A4": {},
                  "A5": {}, "A6": {"discount": 0.0}}
    text = assumptions.foremost_choices(importance, ["A1", "A2", "A3"], 64)
    assert text.startswith("The choice that matters most for each claim: *discount, γ* (A1, A3); *credit, ψ(N)* (A2).")
    assert text.endswith(" There are too few readings for A4, A5. For the others no choice predicts the number.")
    all_known = assumptions.foremost_choices({"A1": {"credit": 0.2}}, ["A1"], 64)
    assert "too few" not in all_known
    assert assumptions.foremost_choices(importance, [], 16) == (
        "With 16 readings, no choice predicts the number of any claim.")


def test_verdicts_are_shares_of_readings(shares):
    *_, a2, b1, c1 = plain(assumptions.verdicts(shares)).splitlines()
    assert a2 == "| **A2** Every single resolution beats Brownian motion | 75 % | 25 % | 0 % | 0 % | 4 |  |"
    assert b1.endswith(" | 0 % | 0 % | 100 % | 50 % | 4 | 20 % of 5 |")
    assert c1.endswith(" | 50 % | 25 % | 25 % | 25 % | 4 |  |")


def test_undecided_verdicts_are_counted(shares):
    text = plain(assumptions.undecided(shares, 3))
    assert text.startswith("Of 12 verdicts in all, 2 (17 %) are undecided. An interval from 3 runs is rough;")


def test_choices_are_listed_with_the_value_under_each_reading():
    table = assumptions.choices({"to the letter": TO_THE_LETTER, "calibrated": Reading()})
    header, _, *rows = table.splitlines()
    assert header == "| Choice | Prior | To the letter | Calibrated | Papers |" and len(rows) == len(BEYOND)
    of_book = "yes" if Reading().bootstrap else "no"
    assert f"| bootstrapping | yes, no | yes | {of_book} | A, B, C |" in rows
    assert "| exploration, ε | pinned | 0 | 0 | A, B, C |" in rows
    assert f"| gain of place, B | 1, 2, 3, 4, 5, 7, 10, 14, 20 | 1 | {Reading().place_gain:g} | B |" in rows


def test_a_reading_that_breaks_the_text_is_listed_with_the_sentence():
    inside, outside = assumptions.agreements({"plain": Reading(), "odd": Reading(exploration=0.1)}).splitlines()
    assert inside == "- The reading *plain* is within the text."
    assert outside == ("- The reading *odd* is not within the text: policy: “my epsilon-free exploration” "
                       "(Acknowledgements).")


def test_dependence_is_reported_where_the_choices_predict_a_claim(shares):
    many = {"credit": 0.06, "discount": 0.5, "memory": 0.055, "object_beyond": 0.1}
    rows = assumptions.dependence({"A2": {}, "B1": many, "C1": many}, {"B1": 0.4, "C1": -0.2}, shares).splitlines()
    assert rows[2:] == ["| A2 |  | 4 readings are too few |",
                        "| B1 | 0.40 | discount, γ (0.50), cell beyond the range (0.10), credit, ψ(N) (0.06) |",
                        "| C1 | 0.00 | no choice predicts it |"]
    few = assumptions.dependence({"B1": {"memory": 0.04, "object_beyond": 0.1}}, {"B1": 0.4}, shares)
    assert few.endswith("| cell beyond the range (0.10) |")
    assert assumptions.dependence({"A2": {}, "B1": {}}, {}, shares).startswith("The page has too few readings")


def test_128_readings_are_enough():
    assert assumptions.whether_enough(128) == "128 readings are enough to show the large effects."
    assert assumptions.whether_enough(64) == "64 readings are too few to show much."


def test_levels_are_listed_if_they_clearly_lead_the_letter_or_trail_it():
    leads = [Estimate(0, -1, 1), Estimate(2, 1, 3), Estimate(-2, -3, -1), Estimate(0.5, -1, 2)]
    supports = [Support("credit", f"level {i}", i, i == 0, 4.0, lead) for i, lead in enumerate(leads)]
    table, text = assumptions.clear_leads(supports * 10).split("\n\n")
    assert table.splitlines()[2:4] == ["| credit, ψ(N) | level 1 | 4.00 | 2.00 [1.00, 3.00] |",
                                       "| credit, ψ(N) | level 2 | 4.00 | −2.00 [−3.00, −1.00] |"]
    assert text == "Of 30 levels, 20 are listed; chance alone would list about 2."
    assert "Of 1 levels, 1 is listed" in assumptions.clear_leads(supports[1:2])
    assert assumptions.clear_leads(supports[:1]) == (
        "Of 0 levels, 0 are listed; chance alone would list about 0.")


def test_priors_that_differ_beyond_the_text_stand_beside_those_within():
    table = assumptions.priors_beyond()
    assert "| exploration, ε | 0, 0.02, 0.1 | 0 |" in table
    assert "| map weights | resolution, cells, equal | resolution, cells |" in table
    assert "bootstrapping" not in table


def test_claims_beyond_the_text_stand_beside_the_shares_within(shares):
    judged = [claims(["C1"], ["B1"]), {"C1": claim("C1", undecided=True), "B1": claim("B1")},
              *[claims([], ["C1", "B1"])] * 2, claims(["C1"], ["B1"])]
    rows = plain(assumptions.verdicts_beyond(shares, judged)).splitlines()[2:]
    assert [row.split(" | ", 1)[1] for row in rows] == ["0 % | 0 % | 0 % |", "40 % | 20 % | 50 % |"]
    assert rows[0].startswith("| **B1** Object-vector agents match") and rows[1].startswith("| **C1** ")


def test_readings_beyond_the_text_break_it_and_their_claims_are_counted():
    outside = [Reading(), replace(Reading(), exploration=0.1), replace(Reading(), exploration=0.1, network_gain=5.0)]
    judged_outside = [claims([], ["B1", "C1"]), claims(["B1"], ["C1"]), claims([], ["B1", "C1"])]
    text = assumptions.counts_beyond(outside, judged_outside, [claims(["B1", "C1"])] * 4)
    assert text == ("3 readings, of which 2 break the text, in 1.0 choices on average. Beyond the text 0.3 of 2 claims "
                    "hold on average; within it, 2.0; the difference is −1.67 [−2.00, −1.00].")
    text = assumptions.counts_beyond(outside[1:], judged_outside[1:], [claims(["B1", "C1"])] * 4)
    assert text.startswith("2 readings, all of which break the text, in 1.5 choices on average.")


def test_the_box_has_the_shares_at_length_and_in_short_runs(shares):
    text = plain(assumptions.in_short(shares, [claims(["B1"])] * 3, "Credit matters most."))
    assert "agree with the thesis in 20 % of the readings that the text allows, on average over 1 claims" in text
    assert "of 3 readings, with an interval required, a claim holds in 42 % of them. Credit matters most." in text


def test_only_predicted_claims_have_importances():
    assert assumptions.of_predicted({"A1": {"credit": 0.2}, "A2": {"credit": 0.3}}, ["A2"]) == {
        "A1": {}, "A2": {"credit": 0.3}}
