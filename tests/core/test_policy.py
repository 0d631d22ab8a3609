"""Action selection: greedy, or softmax with the package's own exponential function."""

import math

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from neorl.custom import greedy, softmax
from neorl.core.policy import exponential
from neorl.core.stream import new_stream
from neorl.kernels.execution import execute

DRAWS = 20_000


def drawn(choose, value, draws=DRAWS, seed=0):
    """The share of draws in which each action is chosen."""
    stream, value = new_stream(np.random.SeedSequence(seed)), np.array(value, float)
    return np.bincount([execute(choose, value, stream) for _ in range(draws)], minlength=len(value)) / draws


def assert_shares(found, expected):
    assert np.all(np.abs(found - expected) <= 5 * np.sqrt(np.array(expected) / DRAWS) + 1e-12)


@given(st.floats(-699.9, 0))
@example(0.0)
@example(-0.0)
@example(-5e-324)
@example(-math.log(2))
@example(-699.9)
def test_the_exponential_function_equals_that_of_the_library(x):
    assert abs(execute(exponential, x) - math.exp(x)) <= 4 * math.ulp(math.exp(x))


@pytest.mark.parametrize("x", [-700.0, -1e300, -math.inf, math.nan])
def test_what_is_next_to_nothing_is_nothing(x):
    assert execute(exponential, x) == 0.0


def test_softmax_draws_in_proportion_to_the_exponential_of_the_values():
    value = 0.2 * np.array([0.0, 1.0, -2.0, 0.5, 1.0])
    expected = np.exp(value / 0.2)
    assert_shares(drawn(softmax(0.2), value), expected / expected.sum())
    assert drawn(softmax(0.2), [3.0], draws=10).tolist() == [1.0]


@pytest.mark.parametrize("value", [[1e308, -1e308, 1e308], [-1e308, -1.7e308, -1e308], [1e300, 1e299, 1e300]])
def test_softmax_of_huge_values_draws_from_the_highest(value):
    assert_shares(drawn(softmax(0.2), value), [0.5, 0.0, 0.5])


def test_a_cold_softmax_is_greedy_and_a_hot_one_is_random():
    assert drawn(softmax(1e-30), [0.1, 0.3, 0.2], draws=100).tolist() == [0, 1, 0]
    assert_shares(drawn(softmax(1e30), [0.1, 0.3, 0.2]), [1 / 3] * 3)


def test_greedy_takes_the_highest_and_draws_among_equals():
    assert drawn(greedy, [0.1, 0.3, -0.2], draws=50).tolist() == [0, 1, 0]
    assert_shares(drawn(greedy, [2.0, 1.0, 2.0, 2.0]), [1 / 3, 0, 1 / 3, 1 / 3])
    assert_shares(drawn(greedy, [0.0, -0.0]), [0.5, 0.5])


def test_greedy_draws_no_number_without_need():
    stream = new_stream(np.random.SeedSequence(0))
    before = stream.copy()
    execute(greedy, np.array([0.5, 0.25]), stream)
    np.testing.assert_array_equal(stream, before)
