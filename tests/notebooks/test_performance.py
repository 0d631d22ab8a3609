"""The page on performance: rivals compute the same, bytes are counted as described, programs take turns.

No test judges a measured time.
"""

from dataclasses import replace

import numpy as np
import pytest

from lib.performance import bound, rivals, timing
from neorl import CALIBRATED, Run, WaterWorld, place_cells
from neorl.core.learning import MapValues

STEPS, LIVED = 1_000, 3_000


@pytest.fixture(scope="module")
def stretch():
    return rivals.record(5, STEPS, LIVED)


def test_a_recorded_stretch_is_the_life_of_the_agent_to_the_last_bit(stretch):
    q, lived = stretch.q.copy(), Run(place_cells([5], learning=rivals.PLAIN), WaterWorld())
    lived.advance(LIVED)
    assert np.array_equal(q, lived.q())
    lived.advance(STEPS)
    rivals.by_kernel(stretch, q, stretch.goal_range.copy())
    assert np.array_equal(q, lived.q()) and not np.array_equal(q, stretch.q) and stretch.learns.sum() > 30


def test_all_rivals_compute_the_same(stretch):
    q, by_numpy, heads = stretch.q.copy(), stretch.q.copy(), rivals.heads_of(stretch.q)
    best = rivals.by_kernel(stretch, q, stretch.goal_range.copy())
    assert np.array_equal(rivals.by_numpy(stretch, by_numpy), best)
    assert np.array_equal(rivals.by_heads(stretch, heads), best)
    assert np.unique(best).size == 4
    np.testing.assert_allclose(by_numpy, q, rtol=1e-6, atol=1e-29)
    np.testing.assert_allclose(np.stack([head.q for head in heads], axis=-1), q, rtol=1e-6, atol=1e-29)


@pytest.mark.filterwarnings("ignore")
def test_jax_computes_the_same_where_it_is_installed(stretch):
    jax = pytest.importorskip("jax")
    q = stretch.q.copy()
    best = rivals.by_kernel(stretch, q, stretch.goal_range.copy())
    by_jax, values = rivals.by_jax(stretch)(jax.numpy.array(stretch.q))
    np.testing.assert_allclose(values, q, rtol=1e-5, atol=1e-6)
    assert (np.asarray(by_jax) == best).mean() > 0.99


def test_what_is_not_installed_is_left_out(stretch, monkeypatch):
    monkeypatch.setattr(rivals.importlib.util, "find_spec", lambda module: None)
    assert [*rivals.ways(stretch)] == ["neoRL", "NumPy", "an object for each goal"]
    assert all(prepare()() is not None for prepare in rivals.ways(stretch).values())


def lived(resolution, **rule):
    indifferent = place_cells([resolution], 0.0, 0.0, learning=replace(CALIBRATED, **rule))  # it moves all the same
    run = Run(indifferent, WaterWorld())
    run.advance(10_000)
    return run


def test_all_goals_move_the_rows_of_two_cells_and_one_of_them_twice():
    run = lived(2, bootstrap=True, memory=0.0)
    found = bound.moved(run, 500)
    assert found.ordered / found.changes == pytest.approx(4 * 4 * 4 * 3)  # 4 bytes, 4 goals, 4 actions
    assert found.scattered == found.remembered == 0 and found.working_set == 4 * 4 * 4 * 4
    assert found.standing == 3 * 4 * 4 + 8 + 2 * 8  # values of three creeps, one track


def test_events_without_a_rate_are_not_moved():
    found = bound.moved(lived(2, bootstrap=True, memory=0.0, credit="last", absent_decay=0.0), 500)
    assert found.ordered / found.changes == pytest.approx(4 * 4 * (4 + 2))


def test_lone_values_move_lines_in_a_map_that_is_larger_than_the_nearest_cache():
    small, large = (bound.moved(lived(n, memory=1.0), 500) for n in (3, 11))
    assert small.scattered == 0 and small.ordered > 0
    far = large.scattered / (2 * 64)  # values of a cell's actions, which share a line
    near = (large.ordered - large.changes * large.remembered * (4 * 2 * 17 + 8 + 32)) / (4 * 2 * 4)
    assert far + near == pytest.approx(large.changes * large.remembered) and min(far, near) > 0
    assert large.working_set <= large.scattered * 500


def test_the_values_of_a_cell_move_a_line_each_if_goals_lie_together():
    found = bound.moved(lived(11, memory=1.0, bootstrap=True), 500)
    assert 2 * 64 * found.changes * found.remembered < found.scattered < 4 * 2 * 64 * found.changes * found.remembered


def test_counting_bytes_takes_the_same_steps():
    counted, run = lived(5), lived(5)
    bound.moved(counted, 300)
    run.advance(300)
    assert np.array_equal(counted.q(), run.q())


def test_a_bandwidth_lies_between_those_measured():
    speeds = timing.Bandwidths(np.array([1e4, 1e6]), np.array([8e9, 2e9]), np.array([4e9, 1e9]))
    assert speeds.at(1e5) == pytest.approx(5e9) and speeds.at(1e9) == 2e9
    measured = timing.bandwidths(1, largest=2**15)
    assert list(measured.working_sets) == [2**14, 2**15] and measured.copied.min() > 0 < measured.scattered.min()


def test_things_take_turns_and_the_least_counts():
    called, ticks = [], iter(range(100))
    preparations = {name: timing.always(called.append, name) for name in "ab"}
    seconds = timing.in_turns(preparations, 2, lambda: next(ticks))
    assert "".join(called) == "ababab" and all((each == 1).all() and len(each) == 2 for each in seconds.values())
    assert timing.times_as_long(np.array([6.0, 8.0]), np.array([2.0, 9.0])).value == 3


def test_the_same_steps_are_timed_each_time():
    run = lived(3)
    before = run.q().copy()
    timing.again(run, 100)()()
    assert np.array_equal(run.q(), before) and run.step == 10_000


def test_exponents():
    xs = np.array([1.0, 2.0, 4.0, 8.0])
    assert timing.exponent(xs, 5 * xs**3) == pytest.approx((3, 3, 3))
    assert timing.exponent(xs, np.array([-1.0, 2.0, 4.0, 8.0])).value == pytest.approx(1)
    assert np.isnan(timing.exponent(xs, np.array([-1.0, 2.0, 0.0, 8.0]))).all()
    low, high = timing.exponent(xs, xs * [1, 1.5, 1, 1])[1:]
    assert low < 1 < high


def test_a_random_walk_learns_all_goals(monkeypatch):
    """Values of 0.1 everywhere rise in the cells left where the goal is entered, and fall elsewhere."""
    made = []
    monkeypatch.setattr(bound, "MapValues", lambda *fields: made.append(MapValues(*fields)) or made[0])
    bound.learning_all_goals(4, 50)()()
    q = made[0].q.reshape(16, 4, 16)
    left = np.flatnonzero((q != np.float32(0.1)).any(axis=(1, 2)))
    assert 2 < len(left) < 16 and q.max() > 0.1 and np.all(q[left].min(axis=(1, 2)) < 0.1)
