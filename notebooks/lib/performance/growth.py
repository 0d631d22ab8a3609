"""How cost grows with the size of maps and memory, and with the number of maps, creeps and runs, beside predictions.

The agents of a series see and evaluate everything, but their desires have valence 0, so they draw their actions and all
move identically. Predictions follow from the code, for terms large enough to outweigh the rest:

- values: N⁴, since a map has N² cells, and a value for each cell, action and goal;
- learning all goals once: N², since it goes through the rows of two cells, which have a value for each goal;
- learning all goals in a run: N³ at most, since changes of cell grow with N, until every step is one;
- maps: exponent 1, since each map costs the same again;
- creeps: exponent 1 at most, since each is moved, seen and evaluated, beside what does not depend on them;
- runs: exponent 1, since they share nothing;
- memory: exponent 1 at most, since each remembered cell learns, and a path that crosses itself leaves fewer.
"""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from lib.performance.bound import ALL_GOALS, LIVED, STRETCH
from lib.performance.timing import again, always, exponent, in_turns
from neorl.agents.papers import place_cells
from neorl.agents.rules import CALIBRATED
from neorl.core.kernel import array, execute, kernel
from neorl.core.learning import ZERO, MapValues, Rule, learn_all_goals
from neorl.experiments.run import Run
from neorl.experiments.simulation import simulate
from neorl.worlds.waterworld import WaterWorld

INDIFFERENT = {"valence_green": 0.0, "valence_red": 0.0}
LEARNS_NOTHING = replace(CALIBRATED, learning_rate=0.0, memory=0.0)
WITHOUT_A_MAP = place_cells([1], learning=LEARNS_NOTHING, **INDIFFERENT)
RESOLUTIONS = (21, 26, 32, 39, 48)
MAPS = (1, 2, 3, 4, 6, 8, 12)
CREEPS = (16, 32, 64, 128, 256)
RUNS = (1, 2, 4, 8)
MEMORIES = (1.0, 2.0, 4.0, 8.0, 16.0, 32.0)  # cells
UPDATES = 300
RATES = np.full(4, 0.01, np.float32)


class Series(NamedTuple):
    """How a cost grows with one quantity."""

    of: str  # the quantity
    cost: str
    unit: str
    xs: np.ndarray  # (points,)
    costs: np.ndarray  # (points,)
    predicted: int  # the exponent
    at_most: bool  # whether it is an upper bound

    @property
    def exponent(self):
        """The fitted exponent: an `Estimate`."""
        return exponent(self.xs, self.costs)


def measure(steps, rounds, seed=0):
    """Measure every `Series`. steps: timed in each run after its first `LIVED`, at most `STRETCH`."""
    steps = min(steps, STRETCH)
    return [values(), update(rounds, seed), learning(steps, rounds, seed), maps(steps, rounds, seed),
            creeps(steps, rounds, seed), runs(LIVED, rounds, seed), memory(steps, rounds, seed)]


def values():
    """Memory that the values of a map take, counted rather than timed."""
    sizes = [Run(place_cells([n]), WaterWorld()).q().nbytes for n in RESOLUTIONS]
    return _series("N", "values of a map", "bytes", RESOLUTIONS, sizes, 4)


def update(rounds, seed=0):
    """Time of learning all goals once, along a random walk through cells that know all of them."""
    preparations, rule = {}, Rule(np.float32(0.9), True, ZERO, False)
    for n in RESOLUTIONS:
        cells, rng = n**2, np.random.default_rng(seed)
        path = np.clip(np.cumsum(rng.choice([-1, 1, -n, n], UPDATES + 1)) + cells // 2, 0, cells - 1)
        every_goal = np.tile([0, cells], (cells, 1))
        map_values = MapValues(np.full(4 * cells**2, 0.1, np.float32), 0, cells, 4, every_goal,
                               np.empty(cells, np.float32))
        preparations[n] = always(execute, learn_along, map_values, rule, path, RATES)
    seconds = in_turns(preparations, rounds)
    return _series("N", "learning all goals once", "seconds", RESOLUTIONS,
                   [seconds[n].min() / UPDATES for n in RESOLUTIONS], 2)


@kernel
def learn_along(values: MapValues, rule: Rule, path: array("int64", "cells"), rates: array("float32", 4)) -> None:
    """Learn all goals from each change of cell along a path."""
    for change in range(path.shape[0] - 1):
        learn_all_goals(values, rule, path[change], path[change + 1], rates)


def learning(steps, rounds, seed=0):
    """Time that learning all goals adds to a step, by N."""
    agents = {n: place_cells([n], learning=ALL_GOALS, **INDIFFERENT) for n in RESOLUTIONS}
    idle = {-n: place_cells([n], learning=LEARNS_NOTHING, **INDIFFERENT) for n in RESOLUTIONS}
    found = _a_step({**agents, **idle}, steps, rounds, seed)
    return _series("N", "learning all goals, per step", "seconds", RESOLUTIONS,
                   [found[n] - found[-n] for n in RESOLUTIONS], 3, at_most=True)


def maps(steps, rounds, seed=0):
    """Time that maps of N11 add to a step, by their number."""
    agents = {count: place_cells([11] * count, **INDIFFERENT) for count in MAPS}
    found = _a_step({**agents, 0: WITHOUT_A_MAP}, steps, rounds, seed)
    return _series("maps", "maps of N11, per step", "seconds", MAPS, [found[count] - found[0] for count in MAPS], 1)


def creeps(steps, rounds, seed=0):
    """Time of a step of the world and an agent with a map of N7, by the number of creeps."""
    found = _a_step({count: place_cells([7], **INDIFFERENT) for count in CREEPS}, steps, rounds, seed,
                    {count: WaterWorld(n_creeps=count) for count in CREEPS})
    return _series("creeps", "a step of world and agent", "seconds", CREEPS, [*found.values()], 1, at_most=True)


def runs(steps, rounds, seed=0):
    """Time of all runs of a condition, one after the other, by their number."""
    preparations = {count: always(_simulate, steps, count, seed) for count in RUNS}
    return _series("runs", "a condition", "seconds", RUNS,
                   [each.min() for each in in_turns(preparations, rounds).values()], 1)


def memory(steps, rounds, seed=0):
    """Time that learning adds to a step of an agent with a map of N23, by the length of its memory."""
    agents = {cells: place_cells([23], learning=replace(CALIBRATED, memory=cells, bootstrap=False), **INDIFFERENT)
              for cells in MEMORIES}
    idle = place_cells([23], learning=LEARNS_NOTHING, **INDIFFERENT)
    found = _a_step({**agents, 0: idle}, steps, rounds, seed)
    return _series("cells remembered", "learning from memory, per step", "seconds", MEMORIES,
                   [found[each] - found[0] for each in MEMORIES], 1, at_most=True)


def _series(of, cost, unit, xs, costs, predicted, at_most=False):
    return Series(of, cost, unit, np.array(xs, float), np.array(costs, float), predicted, at_most)


def _a_step(agents, steps, rounds, seed, worlds=None):
    """The least seconds per step of agents {name: `Agent`} after their first `LIVED` steps: {name: float}."""
    lives = {name: Run(agent, worlds[name] if worlds else WaterWorld(), seed) for name, agent in agents.items()}
    for run in lives.values():
        run.advance(LIVED)
    seconds = in_turns({name: again(run, steps) for name, run in lives.items()}, rounds)
    return {name: each.min() / steps for name, each in seconds.items()}


def _simulate(steps, count, seed):
    simulate(place_cells([7], **INDIFFERENT), WaterWorld(), steps=steps, runs=count, seed=seed, threads=1,
             progress=False)
