"""Sentences and tables on newborns, veterans and a rule."""

import numpy as np
import pytest

from lib.chapter_1.navigation_report import (describe_gain, describe_leads, describe_rule, in_short,
                                                       rewards_table)
from neorl.evidence.statistics import Estimate


@pytest.mark.parametrize("low, said", [(0.1, "Experience in the tank pays"),
                                       (0.0, "do not show a gain from experience"),
                                       (-0.1, "do not show a gain from experience"),
                                       (np.nan, "do not show a gain from experience")])
def test_experience_pays_if_the_whole_interval_lies_above_0(low, said):
    assert describe_gain(Estimate(0.4, low, 0.7)).endswith(said)


def test_the_rule_does_better_only_if_it_earns_more_on_average():
    veterans = np.array([0.0, 2.0])
    assert describe_rule(np.array([3.0, -0.5]), veterans).startswith("scores higher than both, but it is not "
                                                                     "autonomous")
    assert describe_rule(np.array([1.5, 0.5]), veterans).startswith("scores no higher here")


def test_each_life_has_a_line_with_its_minutes():
    leads = {600: Estimate(-0.01, -0.07, 0.05), 60_000: Estimate(0.43, 0.34, 0.52)}
    assert describe_leads(leads, minute=3_000).splitlines() == [
        "  0.20 minutes lived: −0.01 [−0.07, 0.05] more per second",
        " 20.00 minutes lived: 0.43 [0.34, 0.52] more per second"]


def test_the_box_and_the_table_have_what_each_earns():
    newborns, veterans, by_rule = np.array([0.0, 0.1, 0.2]), np.array([0.5, 0.6, 0.7]), np.array([1.0, 1.0, 1.0])
    text = in_short(newborns, veterans, by_rule, 20.0)
    assert text.startswith("Experience in the tank pays: ") and "lived 20 minutes" in text and "earns 0.50 [" in text
    assert "with probability 1.00" in text and "earns 1.00 [1.00, 1.00], whatever" in text
    table = rewards_table(newborns, veterans, by_rule, 20.0)
    assert "| newborn | 0.10 [" in table and "| veteran of 20 minutes | 0.60 [" in table
