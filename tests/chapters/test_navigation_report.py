"""What is said of newborns, veterans and a rule."""

import numpy as np
import pytest

from neorl.chapters.chapter_1.navigation_report import describe_gain, describe_leads, describe_rule
from neorl.evidence.statistics import Estimate


@pytest.mark.parametrize("low, said", [(0.1, "Experience in the tank pays"), (0.0, "do not show a gain by experience"),
                                       (-0.1, "do not show a gain by experience"),
                                       (np.nan, "do not show a gain by experience")])
def test_a_life_pays_if_the_whole_interval_lies_above_0(low, said):
    assert describe_gain(Estimate(0.4, low, 0.7)).endswith(said)


def test_the_rule_does_better_only_if_it_earns_more_in_the_mean():
    veterans = np.array([0.0, 2.0])
    assert describe_rule(np.array([3.0, -0.5]), veterans).startswith("scores higher than both, and it is not "
                                                                     "autonomous")
    assert describe_rule(np.array([1.5, 0.5]), veterans).startswith("scores no higher here")


def test_each_life_has_a_line_with_its_minutes():
    leads = {600: Estimate(-0.01, -0.07, 0.05), 60_000: Estimate(0.43, 0.34, 0.52)}
    assert describe_leads(leads, minute=3_000).splitlines() == [
        "  0.20 minutes lived: −0.01 [−0.07, 0.05] ahead", " 20.00 minutes lived: 0.43 [0.34, 0.52] ahead"]
