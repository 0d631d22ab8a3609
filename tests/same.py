"""Runs that are the same to the last bit."""

import numpy as np

from neorl.core.kernel import arrays


def assert_equal(one, other):
    """Assert that the arrays of two named tuples are equal."""
    theirs = arrays(other)
    for name, mine in arrays(one).items():
        np.testing.assert_array_equal(mine, theirs[name], name)


def assert_same(one, other):
    """Assert that two runs are at the same step of the same life."""
    assert one.step == other.step
    assert_equal(one.state, other.state)
    assert_equal(one.world_state, other.world_state)
