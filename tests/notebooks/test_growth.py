"""Growth factors and doubling times of known growth."""

import numpy as np
import pytest
from scipy import stats

from lib.chapter_3.growth import doubling_time, draws_of_all, fit_trend, growth_factor


def test_the_factor_of_a_power_is_its_base_and_the_first_point_does_not_count():
    xs = np.arange(1, 5)
    needed = np.array([7.0 * 3.0**xs, 2.0 * 3.0**xs])
    needed[:, 0] = 1e6
    assert growth_factor(xs, needed) == pytest.approx((3, 3, 3))


def test_the_factor_is_the_mean_over_runs():
    xs = np.arange(1, 4)
    assert growth_factor(xs, np.array([2.0**xs, 4.0**xs])).value == pytest.approx(3)


def test_of_two_points_both_count():
    assert growth_factor(np.array([1, 2]), np.array([[5.0, 20.0]])).value == pytest.approx(4)


def test_a_doubling_time_of_two_years_is_found_and_noise_widens_its_interval():
    years = np.arange(10)
    assert doubling_time(stats.linregress(years, years / 2), 10) == pytest.approx((2, 2, 2))
    value, low, high = doubling_time(stats.linregress(years, years / 2 + [0.3, -0.3] * 5), 10)
    assert low < value < high


def test_the_interval_of_a_doubling_time_is_that_of_students_t():
    class Trend:
        slope, stderr = 0.5, 0.1

    half = 0.1 * 12.706  # one degree of freedom
    assert doubling_time(Trend, 3) == pytest.approx((2, 1 / (0.5 + half), 1 / (0.5 - half)), rel=1e-4)


def test_all_of_n_things_are_drawn_after_about_n_ln_n_draws():
    assert draws_of_all(1) == 0 and draws_of_all(1000) == pytest.approx(6907.755)


def test_a_trend_goes_through_numbers_that_double_every_two_years():
    years = np.array([2000, 2002, 2004, 2006])
    trend, fitted = fit_trend(years, np.array([1.0, 2.0, 4.0, 8.0]))
    assert trend.slope == pytest.approx(0.5) and fitted == pytest.approx([1.0, 2.0, 4.0, 8.0])
