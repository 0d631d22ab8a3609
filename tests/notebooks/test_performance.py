"""The page on performance: rivals compute the same, bytes are counted as described, programs take turns.

No test judges a measured time.
"""

from dataclasses import replace

import numpy as np
import pytest

from companion.page import beginning
from companion.performance import bound, rivals, timing
from neorl import CALIBRATED, Run, WaterWorld, place_cells

STEPS, WARM_UP = 1_000, 3_000


@pytest.fixture(scope="module")
def stretch():
    return rivals.record(5, STEPS, WARM_UP)


def test_a_recorded_stretch_is_the_run_of_the_agent_to_the_last_bit(stretch):
    q, alone = stretch.q.copy(), Run(place_cells([5], learning=rivals.PLAIN), WaterWorld())
    alone.advance(WARM_UP)
    assert np.array_equal(q, alone.q())
    alone.advance(STEPS)
    rivals.by_kernel(stretch, q, stretch.goal_range.copy())
    assert np.array_equal(q, alone.q()) and not np.array_equal(q, stretch.q) and stretch.learns.sum() > 30


def test_all_rivals_compute_the_same(stretch):
    q, by_numpy, heads = stretch.q.copy(), stretch.q.copy(), rivals.heads_of(stretch.q)
    best = rivals.by_kernel(stretch, q, stretch.goal_range.copy())
    assert np.array_equal(rivals.by_numpy(stretch, by_numpy), best)
    assert np.array_equal(rivals.by_heads(stretch, heads), best)
    assert np.unique(best).size == 4
    np.testing.assert_allclose(by_numpy, q, rtol=1e-6, atol=1e-29)
    np.testing.assert_allclose(np.stack([head.q for head in heads], axis=-1), q, rtol=1e-6, atol=1e-29)


def test_all_goals_move_the_rows_of_two_cells_and_one_of_them_twice():
    rule = replace(CALIBRATED, bootstrap=True, memory=0.0)
    run = Run(place_cells([2], 0.0, 0.0, learning=rule), WaterWorld())  # indifferent, it moves all the same
    run.advance(10_000)
    found = bound.moved(run, 500)
    assert found.ordered / found.changes == pytest.approx(4 * 4 * 4 * 3)  # 4 bytes, 4 goals, 4 actions
    assert found.scattered == found.remembered == 0 and found.working_set == 4 * 4 * 4 * 4
    assert found.standing == 3 * 4 * 4 + 8 + 2 * 8  # values of three creeps, one track


def test_exponents():
    xs = np.array([1.0, 2.0, 4.0, 8.0])
    assert timing.exponent(xs, 5 * xs**3) == pytest.approx((3, 3, 3))
    assert timing.exponent(xs, np.array([-1.0, 2.0, 4.0, 8.0])).value == pytest.approx(1)
    assert np.isnan(timing.exponent(xs, np.array([-1.0, 2.0, 0.0, 8.0]))).all()
    low, high = timing.exponent(xs, xs * [1, 1.5, 1, 1])[1:]
    assert low < 1 < high


def test_copies_of_the_largest_map_fit_into_memory():
    beginning.begin(resolution=50)
    with pytest.raises(ValueError, match="resolution must be an integer from 1 to 50, but is 51"):
        beginning.begin(resolution=51)
