"""Statistics, tested on cases worked out by hand and on simulated data."""

import math

import numpy as np
import pytest
from companion.study.calibration_targets import time_to_final_level
from scipy import stats

from neorl import Condition, Result, WaterWorld, place_cells
from neorl.statistics import (estimate, mean_band, points, probability_of_improvement, ratio, resets, tolerance_band,
                              tolerated_share)


def test_the_probability_of_improvement_counts_pairs():
    high, low = np.arange(3.0, 13.0), np.arange(-10.0, 0.0)
    assert probability_of_improvement(high, low) == (1.0, 1.0, 1.0)
    assert probability_of_improvement(low, high) == (0.0, 0.0, 0.0)
    assert probability_of_improvement([1, 3], [2, 3]).value == pytest.approx(1.5 / 4)  # 3 > 2; 3 = 3 counts half


def test_the_interval_of_a_constant_has_no_width():
    assert estimate(np.mean, np.full(10, 2.5)) == (2.5, 2.5, 2.5)


def test_fewer_than_ten_runs_have_no_interval():
    for runs, expected in ((9, True), (10, False)):
        sample = np.random.default_rng(0).normal(size=runs)
        assert np.isnan(estimate(np.mean, sample)[1:]).all() == np.isnan(mean_band(sample[:, None])).all() == expected
    assert np.isnan(estimate(ratio, np.arange(1.0, 21.0), np.ones(9)).low)


@pytest.mark.parametrize("statistic, sample", [
    (np.mean, np.full(10, 3.3834586466165413)), (np.mean, np.full(11, 3.3834586466165413)),
    (lambda x, axis: -x.mean(axis) ** 2, np.arange(-10.0, 11.0))])
def test_an_interval_contains_its_value_though_resamples_are_rounded_otherwise_or_biased(statistic, sample):
    value, low, high = estimate(statistic, sample)
    assert low <= value <= high


def test_a_single_run_has_no_interval():
    single = estimate(np.mean, np.array([1.0]))
    assert single.value == 1.0 and math.isnan(single.low) and math.isnan(single.high)


def difference(a, b):
    return estimate(lambda x, y, axis: x.mean(axis) - y.mean(axis), a, b)


@pytest.mark.parametrize("estimated, by, spread, truth", [
    (difference, 0.7, 2.0, 0.7), (probability_of_improvement, 1.0, 1.0, 0.7602)])  # for normal samples, Φ(1/√2)
def test_an_interval_covers_the_truth_as_often_as_it_says(estimated, by, spread, truth):
    rng, covered, trials = np.random.default_rng(3), 0, 150
    for _ in range(trials):
        low, high = estimated(rng.normal(by, 1.0, 30), rng.normal(0.0, spread, 30))[1:]
        covered += low <= truth <= high
    assert 0.88 <= covered / trials <= 0.99


def test_the_tolerated_share_is_wilks():
    """The share between the extremes of 93 and of 46 runs, from tables of Wilks's formula."""
    assert tolerated_share(93) == pytest.approx(0.95, abs=5e-4)  # two-sided 95 % / 95 %
    assert tolerated_share(46) == pytest.approx(0.90, abs=2e-3)
    n, p = 20, tolerated_share(20)  # by Wilks's formula, 1 − n pⁿ⁻¹ + (n − 1) pⁿ = 0.95
    assert 1 - n * p ** (n - 1) + (n - 1) * p**n == pytest.approx(0.95)
    assert tolerated_share(1) == 0.0


def test_a_tolerance_band_lies_between_order_statistics():
    runs = np.random.default_rng(0).permutation(np.arange(1.0, 101.0))
    low, high = tolerance_band(runs[:, None] * [1, 10])
    beyond = int(low[0])
    np.testing.assert_array_equal([low, high], [[beyond, 10 * beyond], [101 - beyond, 10 * (101 - beyond)]])
    assert tolerated_share(100, beyond) >= 0.75 > tolerated_share(100, beyond + 1)


@pytest.mark.parametrize("runs", [1, 2, 17])
def test_with_few_runs_a_tolerance_band_is_their_range(runs):
    assert tolerated_share(runs) < 0.75 <= tolerated_share(18)
    curves = np.arange(float(runs))[:, None]
    np.testing.assert_array_equal(tolerance_band(curves), [[0], [runs - 1]])


@pytest.mark.parametrize("runs", [20, 100])
@pytest.mark.parametrize("law", ["normal", "exponential", "cauchy"])
def test_a_tolerance_band_holds_its_share_as_often_as_it_says_whatever_the_law(law, runs):
    law = {"normal": stats.norm, "exponential": stats.expon, "cauchy": stats.cauchy}[law]
    low, high = tolerance_band(law.rvs(size=(runs, 2_000), random_state=1))
    enough = (law.cdf(high) - law.cdf(low) >= 0.75).mean()
    assert 0.94 <= enough <= 1.0


def test_the_band_of_a_mean_narrows_with_the_root_of_the_runs():
    curves = np.random.default_rng(2).normal(size=(400, 3))
    low, high = mean_band(curves)
    np.testing.assert_allclose(high - low, 2 * 1.96 / 20, rtol=0.15)
    assert np.isnan(mean_band(curves[:1])).all()


def test_the_time_to_the_final_level_is_that_of_each_run():
    """There are 400 bins of 0.2 s, and the moving mean is over the last 10 bins: 2 s."""
    rewards = np.zeros((4, 400), np.float32)
    rewards[0] = 1  # there from the start, reached once there is a mean
    rewards[1, 100:] = 1  # a step after 20 s reaches nine tenths 9 bins later
    rewards[2] = np.arange(400) / 400  # final level 359.5 / 400; the mean of bins 320 to 329 reaches nine tenths of it
    rewards[3] = -1  # never
    result = Result(Condition(place_cells([1]), WaterWorld(), 4_000, 4), rewards, np.zeros((4, 400, 2), np.int16))
    np.testing.assert_allclose(time_to_final_level(result), [2.0, 21.8, 66.0, 80.0])


def test_resets_and_points_follow_from_rewards_and_creeps():
    hits = np.zeros((2, 3, 2), np.int16)
    hits[0], hits[1] = [[3, 1], [2, 0], [0, 4]], [[1, 0], [0, 0], [0, 0]]
    rewards = np.array([[2 + 5, 2 + 5, -4], [1, 0, 0]], np.float32)
    result = Result(Condition(place_cells([1]), WaterWorld(win_reward=5.0), 30, 2), rewards, hits)
    assert list(points(result)) == [0, 1] and list(resets(result)) == [2, 0]
    with pytest.raises(ValueError, match="win_reward of the world must differ from 0"):
        resets(Result(Condition(place_cells([1]), WaterWorld(), 30, 2), rewards, hits))


def test_ratios_are_those_of_means():
    a, b = np.array([4.0, 6.0]), np.array([1.0, 3.0])
    assert (ratio(a, b, axis=-1), ratio(a, 0 * b, axis=-1)) == (2.5, 0)
