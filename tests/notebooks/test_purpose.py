"""An animal that goes where it wants to be."""

import numpy as np
import pytest

from lib.chapter_2.purpose import LONGEST_WAY, steps_to
from lib.shared.grid import Grid

WEST, EAST = np.eye(4)[[3, 2]]


def test_a_path_is_as_long_as_the_best_actions_make_it():
    corridor = Grid(("....",))
    assert steps_to(3, corridor, np.tile(EAST, (4, 1)), start=0) == 3
    assert steps_to(0, corridor, np.tile(EAST, (4, 1)), start=0) == 0
    assert steps_to(3, corridor, np.array([WEST, EAST, WEST, WEST]), start=1) is None


@pytest.mark.parametrize("goal, steps", [(LONGEST_WAY, LONGEST_WAY), (LONGEST_WAY + 1, None)])
def test_a_path_beyond_the_limit_of_steps_is_none(goal, steps):
    corridor = Grid((".." * LONGEST_WAY,))
    assert steps_to(goal, corridor, np.tile(EAST, (corridor.states, 1)), start=0) == steps
