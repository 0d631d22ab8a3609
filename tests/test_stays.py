"""How long agents stay in cells, on paths that can be counted by hand."""

import numpy as np
import pytest

import neorl
from neorl.classics.stays import follow, mean_stays


def test_a_stay_is_the_time_between_two_changes_of_cell():
    path = np.column_stack([np.linspace(0.001, 0.999, 100), np.full(100, 0.5)])
    np.testing.assert_allclose(mean_stays(path, [1, 2, 5], fps=50), [2.0, 2.0, 0.5])


def test_to_and_fro_over_a_border_is_a_change_each_time():
    path = np.array([[0.4, 0.3], [0.6, 0.3]] * 5)
    assert mean_stays(path, [2], fps=10) == pytest.approx(1 / 9)


def test_a_path_is_where_the_run_was_after_each_step():
    world = neorl.WaterWorld()
    path = follow(neorl.Run(neorl.papers.brownian(), world), 30)
    run = neorl.Run(neorl.papers.brownian(), world)
    run.advance(30)
    np.testing.assert_array_equal(path[-1], run.state.agent_position / world.width)
    assert len(path) == 30 and (np.abs(np.diff(path, axis=0)).sum(axis=1) > 0).any()


def test_no_steps_are_no_path():
    with pytest.raises(ValueError, match="steps is 0"):
        follow(neorl.Run(neorl.papers.brownian(), neorl.WaterWorld()), 0)
