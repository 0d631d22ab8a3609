"""Rival implementations of one agent: the same recorded stretch of a run, computed by other means.

The learner has one map of place cells. In each step it evaluates every action by superposition of the goals where
creeps are, takes the best, and learns all goals if it has changed cells (thesis eq. 4.3, 4.4 and 4.8). Its cells,
perceptions and learning rates are recorded first, so that all implementations compute the same numbers:

- `by_kernel`: the agents' learning kernel, in a loop;
- `by_numpy`: array operations, a few for each step;
- `by_heads`: an object for each goal with a table of its own, as in published code of hybrid reward architectures.

Each returns the actions that it found best, int64 (steps,), and updates the values that it is given.
"""

from typing import NamedTuple

import numpy as np

from neorl import Learning, Run, kernel, place_cells
from neorl.custom import array, execute
from neorl.core.learning import ZERO, MapValues, Rule, learn_all_goals
from neorl.worlds.waterworld import GREEN, WaterWorld

PLAIN = Learning(learning_rate=0.03, discount=0.8, credit="share")


class Stretch(NamedTuple):
    """The recorded experience of a learner, and its values before it."""

    cells: array("int64", "steps + 1")  # the active cell before each step, and at the end
    learns: array("bool", "steps")  # whether it learns after the step
    rates: array("float32", "steps", 4)  # α ψ of each event
    goals: array("int64", "steps", "things")  # the cells of the creeps before the step
    valences: array("float64", "steps", "things")
    q: array("float32", "cells", 4, "cells")  # q[state, action, goal] before the first step
    goal_range: array("int64", "cells", 2)  # see `neorl.core.learning.MapValues`


def record(resolution, steps, warm_up, seed=0):
    """Record the `Stretch` of ``steps`` steps of a learner, after its first ``warm_up`` steps."""
    world = WaterWorld()
    run = Run(place_cells([resolution], learning=PLAIN), world, seed)
    run.advance(warm_up)
    (nres_map,), tracks, scene = run.agent.maps, run.memory.tracks, run.world_state.scene
    found = Stretch(np.empty(steps + 1, int), np.zeros(steps, bool), np.zeros((steps, 4), np.float32),
                    np.empty((steps, world.things), int), np.empty((steps, world.things)), run.q().copy(),
                    run.memory.goal_range.copy())
    for step in range(steps):
        found.cells[step] = left = tracks.cell[0]
        before = run.q()[left].copy()
        found.goals[step] = nres_map.encode(scene.things / world.size)
        found.valences[step] = np.where(scene.kinds == GREEN, 1.0, -1.0)
        run.advance(1)
        if not np.array_equal(run.q()[left], before):
            found.learns[step], found.rates[step] = True, run.state.rates
    found.cells[steps] = tracks.cell[0]
    return found


def by_kernel(stretch, q, goal_range):
    """The package's own implementation. q, goal_range: as in a `Stretch`, both updated."""
    cells, best = len(q), np.empty(len(stretch.learns), int)
    values = MapValues(q.reshape(-1), 0, cells, 4, goal_range, np.empty(cells, np.float32))
    rule = Rule(np.float32(PLAIN.discount), PLAIN.terminal, ZERO, False)
    execute(replay, values, rule, stretch.cells, stretch.learns, stretch.rates, stretch.goals, stretch.valences, best)
    return best


@kernel
def replay(values, rule, cells, learns, rates, goals, valences, best):
    for step in range(learns.shape[0]):
        highest = -np.inf
        for action in range(4):
            value, row = 0.0, (cells[step] * 4 + action) * values.goals
            for thing in range(goals.shape[1]):
                value += valences[step, thing] * values.q[row + goals[step, thing]]
            if value > highest:
                best[step], highest = action, value
        if learns[step]:
            learn_all_goals(values, rule, cells[step], cells[step + 1], rates[step])


def by_numpy(stretch, q):
    """Array operations on q (cells, 4, cells)."""
    best, discount = np.empty(len(stretch.learns), int), np.float32(PLAIN.discount)
    for step, (left, entered) in enumerate(zip(stretch.cells[:-1], stretch.cells[1:])):
        best[step] = np.argmax(q[left][:, stretch.goals[step]] @ stretch.valences[step])
        if stretch.learns[step]:
            target = discount * q[entered].max(axis=0)
            target[entered] = 1
            q[left] += stretch.rates[step][:, None] * (target - q[left])
    return best


class Head:
    """The learner of one goal."""

    def __init__(self, goal, q):
        self.goal, self.q, self.discount = goal, q, np.float32(PLAIN.discount)

    def values(self, cell):
        """The value of each action in a cell."""
        return self.q[cell]

    def learn(self, left, entered, rates):
        """Move the values of the cell left towards the target that the cell entered gives."""
        target = 1 if entered == self.goal else self.discount * self.q[entered].max()
        self.q[left] += rates * (target - self.q[left])


def heads_of(q):
    """A `Head` for each goal of q (cells, 4, cells), with a copy of its values."""
    return [Head(goal, q[:, :, goal].copy()) for goal in range(len(q))]


def by_heads(stretch, heads):
    """One object for each goal."""
    best = np.empty(len(stretch.learns), int)
    for step, (left, entered) in enumerate(zip(stretch.cells[:-1], stretch.cells[1:])):
        value = np.zeros(4)
        for goal, valence in zip(stretch.goals[step], stretch.valences[step]):
            value += valence * heads[goal].values(left)
        best[step] = np.argmax(value)
        if stretch.learns[step]:
            for head in heads:
                head.learn(left, entered, stretch.rates[step])
    return best


def ways(stretch):
    """Preparations for `in_turns` of all implementations: {name: function}, the package first."""
    heads = heads_of(stretch.q)
    return {"neoRL": lambda: _of_copies(by_kernel, stretch, stretch.q, stretch.goal_range),
            "NumPy": lambda: _of_copies(by_numpy, stretch, stretch.q),
            "an object for each goal": lambda: lambda: by_heads(stretch, heads)}


def _of_copies(function, stretch, *arrays):
    """A call with copies of arrays that are made before the timing."""
    copies = [array.copy() for array in arrays]
    return lambda: function(stretch, *copies)
