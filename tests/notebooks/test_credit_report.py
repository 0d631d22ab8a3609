"""Sentences and tables of chapter 4 on learning rules, for known values."""

import numpy as np

from lib.chapter_4 import credit_report
from neorl.agents.rules import Learning
from neorl.evidence.statistics import Estimate


def values(*leads, light=0.0, visits=100):
    """Values of one run per lead: the light is worth `light`, the cause its lead more, and everything else 0."""
    found = np.zeros((len(leads), visits, 4, 2), np.float32)
    found[..., 0, 0] = found[..., 1, 1] = light + np.array(leads)[:, None]
    found[..., 2, :] = light
    return found


def test_leads_are_reported_for_each_rule_after_some_visits():
    rising = values(0.5, 0.5)
    rising[:, :50] *= -1
    text = credit_report.leads({"book": values(0.2, -0.2), "inversion": rising, "difference": values(0.1, 0.1)})
    table = [line for line in text.splitlines() if line.startswith("|")]
    assert table[2:] == ["| book | 0.00 [−0.20, 0.20] | 0.00 [−0.20, 0.20] | 50, 50, 50 % |",
                         "| inversion | −0.50 [−0.50, −0.50] | 0.50 [0.50, 0.50] | 0, 0, 100 % |",
                         "| difference | 0.10 [0.10, 0.10] | 0.10 [0.10, 0.10] | 100, 100, 100 % |"]
    assert ("is −0.600 [−0.600, −0.600] after 1 visit, −0.600 [−0.600, −0.600] after 10 and 0.400 [0.400, 0.400] after "
            "100; by then a run of the former beats a run of the latter with probability 1.00") in text
    assert text.endswith("The lead of the book's rule after 100 visits, less that of plain inversion, is −0.500 "
                         "[−0.700, −0.300], and less that of temporal difference −0.100 [−0.300, 0.100].")


def leads(inversion, difference):
    """The sentences on these leads, one for each run, beside the book's rule."""
    own = np.full(len(inversion), 0.1)
    return credit_report.leads({"book": values(*own), "inversion": values(*inversion),
                                "difference": values(*difference)})


def test_a_lead_that_is_clearly_larger_in_the_end_is_reported_with_its_size():
    text = leads((0.6, 0.6), (0.2, 0.2))
    assert "So in the end inversion has the larger lead, 3 times as large: for temporal difference" in text
    text = leads((0.6, 0.1), (0.2, 0.2))
    assert "So in the end" not in text


def test_rules_that_put_the_cause_first_equally_often_are_said_to():
    text = leads((0.6, 0.6), (0.2, 0.2))
    assert "But *both* put the cause first about equally often" in text
    text = leads((0.6, 0.6), (0.2, -0.1))
    assert "But *both*" not in text


def test_leads_of_single_runs_have_no_interval():
    text = leads((0.5,), (0.25,))
    assert "is 0.250 after 1 visit, 0.250 after 10" in text


def longer_stays(inversion, difference):
    """The sentences on leads that go from 0.4 to these."""
    names = ("inversion", "difference", "same horizon")
    sampled = {name: [np.full((2, 4), size) for size in (0.8, 0.5)] for name in names}
    lead = {name: [Estimate(each, each, each) for each in (0.4, last)]
            for name, last in zip(names, (inversion, difference, 0.05))}
    return credit_report.longer_stays([1, 50], sampled, lead)


def test_the_effect_of_finer_steps_on_values_and_leads_is_reported():
    text = longer_stays(0.3, 0.004)
    assert text.startswith("From 1 step to 50, the value of the cause goes from 0.80 to 0.50 [0.50, 0.50] with "
                           "inversion, and to 0.50 [0.50, 0.50] with temporal difference, or 0.50 [0.50, 0.50] with "
                           "the same horizon. The lead ends at 0.30, 0.004 and 0.050. Inversion is thus nearly "
                           "independent")


def test_inversion_depends_on_the_length_of_steps_if_its_lead_falls_or_is_not_much_larger():
    assert longer_stays(0.15, 0.004).endswith("The lead ends at 0.15, 0.004 and 0.050.")
    assert longer_stays(0.3, 0.2).endswith("The lead ends at 0.30, 0.200 and 0.050.")


def late_effects(shortest, usual):
    """The sentences for leads of inversion of `shortest` with bouts of 2 steps and `usual` with bouts of 20."""
    first = {name: [Estimate(1, 1, 1), Estimate(share, 0, 1)]
             for name, share in (("inversion", 0.75), ("last event", 0.5), ("book's rule", 1), ("difference", 0.25))}
    brief = {hold: {"book": values(0.2, 0.2), "inversion": values(lead, lead), "difference": values(0.1, 0.1)}
             for hold, lead in ((2, shortest), (20, usual))}
    quick = {"inversion": values(0.6), "difference": values(0.3)}
    return credit_report.late_effects([0, 50], first, brief, quick)


def test_late_effects_are_reported_by_rule():
    text = late_effects(0.1, 0.5)
    assert text.startswith("With a delay of 50 steps the cause comes first in 75 % of the runs with credit by share, "
                           "in 50 % with credit for the last event, in 100 % with the book's rule and in 25 % with "
                           "temporal difference.")
    assert "open at once, after 10 presses in all.\n\n| Events last |" in text
    assert ("| 2 steps | 0.20 [0.20, 0.20] | 0.10 [0.10, 0.10] | 0.10 [0.10, 0.10] |\n"
            "| 20 steps | 0.20 [0.20, 0.20] | 0.50 [0.50, 0.50] |") in text
    assert text.endswith("All this is with α = 0.03. With α = 0.3, ten times as much, the lead after 100 visits is "
                         "0.60 with inversion and 0.30 with temporal difference.")


def test_credit_by_share_is_weak_if_brief_events_leave_it_a_smaller_lead():
    assert "Credit by share has its own weakness" in late_effects(0.1, 0.5)
    assert "Credit by share has its own weakness" not in late_effects(0.5, 0.5)


def test_a_bright_light_is_reported_beside_the_cause():
    text = credit_report.bright_light({"one": values(0.25, -0.25, light=0.5), "other": values(0.5, 0.5)})
    assert text.splitlines()[2:] == ["| one | 50, 50 % | 0.50 | 0.50 |", "| other | 100, 100 % | 0.50 | 0.00 |"]


def test_the_default_rule_is_described_by_its_fields():
    text = credit_report.rule_in_words(Learning(credit="happened", absent_decay=0.25, absent_form="away", memory=2.0,
                                                bootstrap=False))
    assert text == ("By default the agents of this book credit an event that occurred with 1, however often it "
                    "occurred; values of absent events move away from the target, by ψ(0) = −0.25. At a change of cell "
                    "only the goal that has been entered learns, from the cell just left and those left before, which "
                    "a memory holds.")
    text = credit_report.rule_in_words(Learning(credit="share", absent_decay=0.0, memory=0.0, bootstrap=True))
    assert "values of absent events stay" in text and text.endswith("all goals learn, from the cell just left alone.")
    assert "towards zero, by ψ(0) = −0.5" in credit_report.rule_in_words(Learning(absent_decay=0.5,
                                                                                 absent_form="decay"))
