"""Known properties of a perceptron, in cases that can be worked out by hand."""

import numpy as np
import pytest

from lib.chapter_3.perceptron import agreeing_intervals, mistake_bound, numerical_slope


def test_intervals_agree_where_the_slope_is_zero_below_the_threshold_and_one_above():
    inputs = np.array([-2.0, -1.0, 1.5, 2.0])
    assert agreeing_intervals(inputs, np.array([0.0, 1.0, 1.0])) == 3
    assert agreeing_intervals(inputs, np.array([1.0, 0.5, 1.0])) == 1


def test_the_bound_is_the_square_of_the_largest_input_over_the_margin():
    inputs = np.array([[3.0, 4.0], [0.0, -2.0], [4.0, 1.0]])
    assert mistake_bound(inputs, np.array([0.0, 7.0])) == pytest.approx(5**2)  # the margin is 1, that of the last input
    assert mistake_bound(inputs, np.array([0.0, 0.1])) == pytest.approx(5**2)


def test_rosenblatts_rule_makes_no_more_mistakes_than_the_bound():
    inputs = np.random.default_rng(0).uniform(-1, 1, (50, 2))
    truth = np.array([1.0, 0.5])
    inputs = inputs[np.abs(inputs @ truth) > 0.1]
    labels, weights, mistakes = np.sign(inputs @ truth), np.zeros(2), 0
    while np.any(np.sign(inputs @ weights) != labels):
        for given, label in zip(inputs, labels):
            if label * (weights @ given) <= 0:
                weights += label * given
                mistakes += 1
    assert 0 < mistakes <= mistake_bound(inputs, truth)


def test_the_slope_is_that_between_neighbours():
    assert numerical_slope(np.array([-2.0, 0.0, 4.0]), np.array([0.0, 0.0, 2.0])).tolist() == [0.0, 0.5]
