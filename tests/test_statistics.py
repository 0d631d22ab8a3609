"""Statistics against cases counted by hand and against simulated data."""

import math

import numpy as np
import pytest

from neorl import Result, WaterWorld, place_cells
from neorl.statistics import (Estimate, band, estimate, mean_band, probability_of_improvement,
                              time_to_final_level)


def test_the_probability_of_improvement_counts_pairs():
    assert probability_of_improvement([3, 4], [1, 2]) == 1.0
    assert probability_of_improvement([1, 2], [3, 4]) == 0.0
    assert probability_of_improvement([1, 3], [2, 3]) == pytest.approx(1.5 / 4)  # 3 > 2, and 3 = 3 counts half


def test_the_interval_of_a_constant_has_no_width():
    assert estimate(np.mean, np.full(10, 2.5)) == (2.5, 2.5, 2.5)


def test_a_single_run_has_no_interval():
    single = estimate(np.mean, np.array([1.0]))
    assert single.value == 1.0 and math.isnan(single.low) and math.isnan(single.high)


def test_the_interval_is_the_same_each_time():
    sample = np.random.default_rng(0).normal(size=20)
    assert estimate(np.mean, sample) == estimate(np.mean, sample)


def test_the_interval_of_a_difference_covers_the_truth_as_often_as_it_says():
    rng, covered, trials = np.random.default_rng(1), 0, 150
    for _ in range(trials):
        a, b = rng.normal(1.0, 1.0, 30), rng.normal(0.3, 2.0, 30)
        low, high = estimate(lambda x, y: x.mean() - y.mean(), a, b)[1:]
        covered += low <= 0.7 <= high
    assert 0.88 <= covered / trials <= 0.99


def test_a_band_holds_the_middle_of_the_runs():
    curves = np.arange(101.0)[:, None] * [1, 10]
    low, high = band(curves)
    np.testing.assert_allclose([low, high], [[2.5, 25], [97.5, 975]])


def test_the_band_of_a_mean_narrows_with_the_root_of_the_runs():
    curves = np.random.default_rng(2).normal(size=(400, 3))
    low, high = mean_band(curves)
    np.testing.assert_allclose(high - low, 2 * 1.96 / 20, rtol=0.15)
    assert np.isnan(mean_band(curves[:1])).all()


def test_an_estimate_is_written_with_its_interval():
    assert str(Estimate(0.5, -0.001, 1.25)) == "0.50 [0.00, 1.25]"
    assert str(Estimate(-0.5, -1.0, 0.1)) == "−0.50 [−1.00, 0.10]"


def test_the_time_to_the_final_level_is_that_of_each_run():
    """400 bins of 0.2 s, so that the mean is over the 10 bins past: 2 s."""
    rewards = np.zeros((4, 400), np.float32)
    rewards[0] = 1  # from the start: as soon as there is a mean
    rewards[1, 100:] = 1  # a step after 20 s is there to nine tenths 9 bins later
    rewards[2] = np.arange(400) / 400  # the last fifth is at 359.5 / 400; nine tenths of it lie 5.5 before bin 330
    rewards[3] = -1  # never
    result = Result(place_cells([1]), WaterWorld(), 4_000, 4, 0, rewards, np.zeros((4, 400, 2), np.int16))
    np.testing.assert_allclose(time_to_final_level(result), [2.0, 21.8, 66.0, 80.0])
