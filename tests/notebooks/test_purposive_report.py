"""Sentences and tables of chapter 4 on walks, series and sums, for known numbers."""

import numpy as np
import pytest

from lib.chapter_4 import purposive_report
from lib.chapter_4.superposition import DEGREE, Ridges


def straight(*directions, steps=60):
    """A walk along each of the directions, (walks, steps + 1, 3)."""
    return np.arange(steps + 1)[None, :, None] * np.array(directions)[:, None]


def test_walks_that_arrive_are_counted_and_their_time_is_reported():
    unbiased, biased = straight((-1, 0, 0), (0, 1, 0)), straight((1, 0, 0), (0, -1, 0))
    assert purposive_report.arrivals(unbiased, biased, goal=(30, 0, 0)).startswith(
        "Within 60 steps, 0 of 2 unbiased walks come within 5 units of the goal, 30 units away, and 1 of the biased "
        "ones, after 26 steps on average. The draws")


def test_where_no_walk_arrives_no_time_is_reported():
    walks = straight((1, 0, 0))
    assert "and 0 of the biased ones. The draws" in purposive_report.arrivals(walks, walks, goal=(0, 99, 0))


def test_walks_spread_by_a_power_of_time_that_drift_raises():
    lags = np.array([1, 10, 100, 1_000, 10_000])
    text = purposive_report.displacements(lags, {0.0: np.array([lags] * 2), 0.1: np.array([lags**2.0] * 2)})
    assert text.startswith("Without a bias, the mean squared distance grows by 1.00 [1.00, 1.00] per step")
    assert text.splitlines()[-2:] == ["| 0 | never | 0.50 [0.50, 0.50] | 0.50 [0.50, 0.50] |",
                                      "| 0.1 | 99 steps | 1.00 [1.00, 1.00] | 1.00 [1.00, 1.00] |"]


def test_errors_of_a_decomposition_are_reported_by_length():
    errors = {300: np.array([[0.1, 0.3], [0.2, 0.2], [0.5, 0.5]]), 1_000: np.zeros((3, 2))}
    text = purposive_report.decomposition(errors)
    assert "means over 2 series, with 95 % intervals" in text
    assert text.splitlines()[-2:] == [
        "| 300 | 0.20 [0.10, 0.30] | 0.20 [0.20, 0.20] | 0.50 [0.50, 0.50] |",
        "| 1,000 | 0.00 [0.00, 0.00] | 0.00 [0.00, 0.00] | 0.00 [0.00, 0.00] |"]


def test_functions_stand_beside_their_sums(monkeypatch):
    sums = {"twice x": (np.array([2.0, 4.0]), "x + x", np.array([2.0, 4.25]))}
    monkeypatch.setattr(purposive_report, "exact_sums", lambda x, y: sums)
    assert purposive_report.sums_at_a_glance(0, 0).splitlines() == [
        "| Function | As a sum | Largest difference |", "|---|---|---|", "| twice x | x + x | 2 × 10<sup>−1</sup> |"]


@pytest.mark.parametrize("angles", [(1, 3), (3, 1)])
def test_the_residual_of_ridges_is_reported_except_for_the_product(angles):
    left = np.linspace(1, 0, 11)
    fits = {"product": Ridges(np.pi / 4 * np.array([*angles, 0]), np.zeros(11)), "distance": Ridges(np.zeros(10), left),
            "two hills": Ridges(np.zeros(10), left / 2)}
    text = purposive_report.ridges(fits, Ridges(np.zeros(2), np.array([1, 0.9, 0.98])))
    assert "found at 45° and 135°, as in its formula" in text and "they leave 98 % of its spread" in text
    assert "leave 50.0 % of the distance, 25.0 % of the two hills; ten leave 0.0 %, 0.0 %." in text
    assert f"of degree {DEGREE}," in text


def test_the_box_has_the_school_the_sum_and_the_clock():
    text = purposive_report.in_short("It keeps 0.75.", 0.613, np.array([0.02, 0.04]))
    assert " It keeps 0.75. " in text and "in 61 % of cells" in text and text.endswith("takes 3.0 % of a core.")
