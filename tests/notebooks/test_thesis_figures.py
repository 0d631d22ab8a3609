"""Figures place the thesis's numbers beside what was found."""

import numpy as np
import pytest
from matplotlib import pyplot as plt

from lib.shared.thesis_figures import draw_against_thesis, mark_levels
from neorl import drawing
from neorl.evidence.statistics import Estimate

THESIS = {"place cells": 0.29, "both": 0.55}
FOUND = {"to the letter": {"both": Estimate(0.1, 0.05, 0.15), "place cells": Estimate(0.2, 0.1, 0.3)},
         "calibrated": {"place cells": Estimate(0.3, 0.25, 0.35), "both": Estimate(0.5, np.nan, np.nan)}}


def test_a_row_has_the_number_of_the_thesis_and_what_was_found():
    axes = draw_against_thesis(THESIS, FOUND, "reward per second")
    assert [label.get_text() for label in axes.get_yticklabels()] == ["place cells", "both"]
    assert [text.get_text() for text in axes.texts] == ["thesis 0.29", "thesis 0.55"]
    numbers, to_the_letter, calibrated = (lines.get_segments() for lines in axes.collections)
    np.testing.assert_allclose(np.array(numbers)[:, :, 0], [[0.29, 0.29], [0.55, 0.55]])
    assert [list(line.get_xdata()) for line in axes.lines] == [[0.2, 0.1], [0.3, 0.5]]
    np.testing.assert_allclose(np.array(to_the_letter)[:, :, 0], [[0.1, 0.3], [0.05, 0.15]])
    np.testing.assert_allclose(calibrated[0][:, 0], [0.25, 0.35])
    assert [text.get_text() for text in axes.get_legend().get_texts()] == ["to the letter", "calibrated"]
    assert axes.get_xlabel() == "reward per second"


def test_an_interval_without_end_does_not_push_the_numbers_together():
    wild = {"calibrated": {"place cells": Estimate(0.3, -90, 90), "both": Estimate(0.5, 0.4, 0.6)}}
    assert draw_against_thesis(THESIS, wild).get_xlim() == pytest.approx((0.16, 0.68))
    assert draw_against_thesis({"resets": 1.0}, {"here": {"resets": Estimate(1.0, 0.5, 2.0)}}).get_xlim()[1] > 2


@pytest.mark.parametrize("thesis, readings, message", [
    ({}, {}, "thesis must be .*, but is {}"),
    (THESIS, {"calibrated": {"both": Estimate(1, 1, 1)}}, r"readings\['calibrated'\] must have the labels of thesis, "),
    (THESIS, {str(n): FOUND["calibrated"] for n in range(8)}, "readings must be at most 7, but are 8"),
])
def test_what_cannot_be_compared_is_refused(thesis, readings, message):
    with pytest.raises(ValueError, match=message):
        draw_against_thesis(thesis, readings)


def test_levels_are_marked_and_within_the_picture():
    drawing.draw_curves(np.arange(20.0), {"one": np.ones((3, 20)), "two": np.full((3, 20), 1.01)}, "x", "y")
    axes = plt.gca()
    mark_levels(axes, {"thesis 5": 5, "thesis −2": -2})
    *_, five, minus_two = axes.lines
    assert (set(five.get_ydata()), set(minus_two.get_ydata())) == ({5}, {-2})
    low, high = axes.get_ylim()
    assert low < -2 and high > 5
    heights = {text.get_text(): text.xy[1] for text in axes.texts}
    assert (heights["thesis 5"], heights["thesis −2"]) == (5, -2)
    assert heights["two"] - heights["one"] >= 0.0749 * (high - low)  # names stay apart after the axes have grown
    assert len(axes.texts) == 4


def test_a_level_that_is_no_number_is_refused():
    with pytest.raises(ValueError, match=r"levels\['thesis'\] must be .*, but is nan"):
        mark_levels(plt.figure().add_subplot(), {"thesis": np.nan})
