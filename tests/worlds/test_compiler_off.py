"""Runs in worlds other than the tank are the same with the compiler switched off; `make exact` adds a user's worlds.

The other process is this file run as a program, with NUMBA_DISABLE_JIT.
"""

import json
import sys

import numpy as np
import pytest
from golden import plain_rule
from same import digest, newborn
from subprograms import printed
from test_world import DRIVER, SEEKER, Dive, Roundabout

from neorl import Agent, Desire, Node, Run
from neorl.worlds import Arena, Arm, Vessel, WaterMaze
from neorl.core.modality import CARTESIAN_OBJECT_VECTOR_CELL, PLACE_CELL

STEPS = 250


def wanting(world):
    """A world, and an agent that wants some of its things."""
    return Agent((Node("PC", PLACE_CELL, [5]), Node("OVC", CARTESIAN_OBJECT_VECTOR_CELL, [4])),
                 [Desire(world.kinds[0], "PC", 1.0), Desire(world.kinds[-1], "OVC", -0.2)], plain_rule()), world


LIVES = {
    "maze": wanting(Arena((("food", 0.2, 0.2), ("trap", 0.8, 0.8), ("food", 0.8, 0.2)), (1.0, -1.0),
                          ((0.4, 0.3, 0.6, 0.7),), "square", "steps", radius=0.1, ends=False, start=(0.2, 0.8),
                          trial_seconds=0.8)),
    "arm": wanting(Arm((3, 2, 1), radius=0.2)), "vessel": wanting(Vessel(traffic=9, radius=0.1)),
    "water maze": wanting(WaterMaze(((0.5, 0.3), (0.6, 0.7)), 2, 0.25, 5.0)),
    "cube": (SEEKER, Dive()), "road": (DRIVER, Roundabout())}


def digests(names):
    return {name: digest(Run(*LIVES[name], seed=5), STEPS) for name in names}


def by_a_learner():
    """Whether a learner in a loop equals a run, in a world of one axis and one action."""
    agent, world = LIVES["road"]
    run, (learner, state) = Run(agent, world, seed=3), newborn(agent, world, seed=3)
    for _ in range(STEPS):
        world.step(state, learner.act())
        learner.observe(state.scene)
    run.advance(STEPS)
    return bool(run.q().any() and np.array_equal(learner.q(), run.q()))


# For the numbers of axes and actions of a user's worlds, all kernels of the agent are compiled once more.
@pytest.mark.parametrize("names", [("maze", "arm", "vessel", "water maze"),
                                   pytest.param((*LIVES,), marks=pytest.mark.exact)], ids=["package", "all"])
def test_runs_are_the_same_and_a_learner_equals_one(names):
    assert printed(__file__, *names) == {"learner": True, **digests(names)}


if __name__ == "__main__":
    print(json.dumps({"learner": by_a_learner(), **digests(sys.argv[1:])}))
