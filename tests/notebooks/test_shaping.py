"""A race with a buoy, small enough to be solved by hand."""

import numpy as np
import pytest

from lib.chapter_3 import decision, shaping
from lib.shared.grid import Grid

COURSE = Grid(("BS.F",))
RACE = decision.reaching(COURSE.next_state, {3: 1.0})
ON_BUOY = RACE.successors == 0


def test_the_least_bonus_that_tempts_is_where_the_buoy_pays_more_than_the_finish():
    """At a discount of 0.5 the finish is worth 0.5 at the start, and bonuses b, b, … for steps into the border 2 b."""
    assert shaping.least_tempting(RACE, ON_BUOY, start=1, discount=0.5) == pytest.approx(0.26)


def test_no_bonus_tempts_from_a_start_next_to_the_finish():
    assert shaping.least_tempting(RACE, ON_BUOY, start=2, discount=0.2) is None


def solved(buoy, potential):
    values = {"true": [0.5, 0.6, 0.0], "buoy pays": buoy, "potential": potential}
    return {name: (np.array(each), None) for name, each in values.items()}


def test_harmful_and_harmless_help_are_reported():
    text = shaping.in_words(solved([0.0, 0.6, 0.0], [0.5, 0.6, 0.0]), finish=2, least=0.12)
    assert "50 % of the places" in text  # the finish itself is not counted
    assert "From the start S this happens from a bonus of 0.12 on." in text
    assert text.endswith("With the potential the policy earns exactly the best true return everywhere.")


def test_without_a_bonus_that_tempts_none_is_reported():
    text = shaping.in_words(solved([0.1, 0.6, 0.0], [0.5, 0.4, 0.0]), finish=2, least=None)
    assert "With the buoy, 0 %" in text and "at the buoy. With the potential" in text
    assert text.endswith("earns less than the best true return somewhere.")
