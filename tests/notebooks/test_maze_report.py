"""Sentences and tables on the animals in the maze."""

from types import SimpleNamespace

import numpy as np
import pytest

from lib.chapter_2.latent_learning import DAYS, LEARNERS, Finding, Record
from lib.chapter_2.maze_report import (describe_errors, describe_first_meals, describe_findings,
                                                 describe_known, describe_settings, describe_verdict, findings_table,
                                                 in_short)
from neorl.evidence.statistics import Estimate
from neorl.evidence.verdict import Claim

BELOW, AROUND, ABOVE = Estimate(-2, -3, -1), Estimate(0.5, -1, 2), Estimate(2, 1, 3)


def record(errors=0.0, known=0.0, runs=2):
    return Record(np.tile(np.broadcast_to(errors, DAYS), (runs, 1)), np.tile(np.broadcast_to(known, DAYS), (runs, 1)))


def claim(outcome, runs=20):
    return Claim("H1", AROUND, "", runs, outcome, False)


def test_errors_are_reported_around_the_first_meals_of_both_groups_and_on_the_first_day():
    days = np.arange(1.0, DAYS + 1)
    by_learner = {name: {"throughout": record(days + 0.1 * place), "never": record(20 + days + 0.1 * place),
                         "delayed": record(40 + days + 0.1 * place)} for place, name in enumerate(LEARNERS)}
    words = describe_errors(by_learner)
    assert "to day 12 the errors" in words
    assert "go from 51.0 to 52.0 (neoRL), from 51.1 to 52.1 (Q-learning), from 51.2 to 52.2 (Sarsa(λ))." in words
    assert "On day 2, after as much food, the group fed throughout makes 2.0 (neoRL) and 2.2 (Sarsa(λ))." in words
    assert "Sarsa(λ) makes 21.2 errors where a random walk makes 21.0" in words


def findings_of(held):
    """The same numbers for every kind of animal; those named show a finding. held: {finding: names}."""
    return {name: {key: Finding(f"Of {key}", BELOW, name in held.get(key, ()))
                   for key in ("level", "one meal", "below", "never")} for name in LEARNERS}


def test_the_table_of_findings_has_a_row_for_each_and_a_column_for_each_kind_of_animal():
    rows = findings_table(findings_of({"level": ["Q-learning"]})).splitlines()
    assert rows[0] == "|  | neoRL | Q-learning | Sarsa(λ) |" and len(rows) == 6
    number = "−2.00 [−3.00, −1.00]"
    assert rows[2] == f"| Of level | **no** {number} | **yes** {number} | **no** {number} |"


def test_findings_name_all_animals_that_show_them():
    words = describe_findings(findings_of({"level": ["neoRL", "Sarsa(λ)"], "never": ["Q-learning"]}))
    assert "right after its first food with neoRL and Sarsa(λ). With" in words
    assert ("With none of the three this is due to latent learning, not to quick learning. It overtakes with none of "
            "the three. The unrewarded") in words
    assert words.endswith("improves without food with Q-learning.")


@pytest.mark.parametrize("fed, said", [
    (0.5, "draws level and does not overtake: in a maze"),
    (0.6, "With neoRL the group fed throughout does not know quite the same: in a maze")])
def test_knowledge_before_food_is_reported_and_compared_with_the_fed_group(fed, said):
    known = np.full(DAYS, 0.9)
    known[9] = 0.5  # on the evening before day 11
    by_learner = {name: {"delayed": record(known=known * share), "throughout": record(known=known * fed / 0.5)}
                  for name, share in zip(LEARNERS, (1, 0.2, 0))}
    words = describe_known(by_learner, units=14)
    assert "at 7.0 of 14 choice points with neoRL, at 1.4 with Q-learning and at 0.0 with Sarsa(λ). " in words
    assert said in words


def test_settings_are_reported_by_their_numbers_and_verdicts():
    rows = {setting: {"neoRL": [lead, saved], "Q-learning": [AROUND, rival], "Sarsa(λ)": [AROUND, ABOVE]}
            for setting, lead, saved, rival in (("a", AROUND, BELOW, ABOVE), ("b", BELOW, BELOW, BELOW),
                                                ("c", ABOVE, AROUND, ABOVE))}
    judged = {"a": claim("partly"), "b": claim("reproduced"), "c": claim("partly")}
    words = describe_settings(rows, judged, worth=11.25)
    assert "lie between −2.00 and 2.00 per day; never being fed costs 11.2 errors per day. In 1 of 3 settings" in words
    assert "It is *partly* in 2; *reproduced* in 1 (b). Even between equal groups, about one interval in" in words
    assert words.endswith("are ahead in 2 settings. Other learners are ahead in these cases: Q-learning with b.")


def test_settings_without_a_rival_ahead_or_an_interval_below_0_are_reported_as_such():
    rows = {"a": {"neoRL": [AROUND, BELOW], "Q-learning": [AROUND, ABOVE], "Sarsa(λ)": [AROUND, AROUND]}}
    words = describe_settings(rows, {"a": claim("partly", runs=4)}, worth=11.0)
    assert "It is *no verdict* in 1. After one meal each" in words
    assert words.endswith("are ahead in 1 settings. Other learners are ahead in none.")


@pytest.mark.parametrize("outcome, said", [("reproduced", "Here the interval lies below 0. Yet both"),
                                           ("partly", "level with the group fed throughout, and no further. "),
                                           ("not reproduced", "level cannot be distinguished from slightly behind. ")])
def test_each_verdict_has_its_own_words(outcome, said):
    assert said in describe_verdict(claim(outcome)) and describe_verdict(claim(outcome)).endswith(". ")
    assert describe_verdict(claim(outcome, runs=9)) == describe_verdict(claim("not testable")) == ""


def test_first_meals_have_a_line_each():
    assert describe_first_meals({3: (13.75, 11.5), 15: (15.25, 0.0)}).splitlines() == [
        "first meal on day 3: 13.8 errors that day, 11.5 on the next",
        "first meal on day 15: 15.2 errors that day, 0.0 on the next"]


@pytest.mark.parametrize("outcome, said", [
    ("reproduced", "they overtake, since it lies below 0."),
    ("partly", "they draw level but do not overtake, which takes an interval below 0."),
    ("no verdict", "they overtake if the whole interval lies below 0.")])
def test_the_box_has_each_learner_and_the_demonstration(outcome, said):
    errors = np.zeros((2, 17))
    errors[:, 10], errors[:, 11] = 5.0, 1.5
    record = SimpleNamespace(errors=errors)
    by_learner = {name: {"delayed": record} for name in ("neoRL", "Q-learning", "Sarsa(λ)")}
    text = in_short(by_learner, SimpleNamespace(here="−0.13 [−0.29, 0.02]", verdict=outcome))
    assert "from 5.0 errors on that day to 1.5 on the next if they learn as the thesis proposes (neoRL)" in text
    assert "learner go from 5.0 to 1.5 with Q-learning and from 5.0 to 1.5 with Sarsa(λ)." in text
    assert "less those of animals fed throughout, are −0.13 [−0.29, 0.02], with" in text and text.endswith(said)
