"""Rivals, yardsticks and recordings for the worlds of the page.

1. The rival in the water maze and in the mountain car is Q-learning (Watkins 1989) on the cells of the page's agent,
   which learns at every step. Its reward on the platform is 1, the only information on where that is. For each step of
   the car it receives −1, so its values begin above all later ones and make it try everything.
2. A way between two birds is measured in multiples of the fewest steps.
"""

import functools
import math

import numpy as np

from companion.shared.tabular import Rates, exploring_action, learn_q
from neorl.core.stream import new_stream
from neorl import Run, kernel
from neorl.custom import execute
from neorl.kernels.annotations import array, fields, mapped

SIDE = 9  # cells along each side of the pool, as in the finer of the swimmer's maps
STRETCH = 500  # steps between two checks of whether all trials are over
POINTS = 8  # of a curve over the car's decisions


def swim_by_table(maze, rates, runs, seed):
    """Seconds that Q-learning takes to the platform: float64 (runs, trials). rates: a `Rates`."""
    loop, latencies = _table_in(maze.dynamics), []
    for run in range(runs):
        sequence = np.random.SeedSequence(seed, spawn_key=(run,))
        state, q = maze.reset(sequence), np.zeros((SIDE * SIDE, len(maze.actions.names)))
        stream = new_stream(sequence.spawn(1)[0])
        while state.trial[0] <= maze.trials:
            execute(loop, state, maze.rules, rates, SIDE, STRETCH, q, stream)
        latencies.append(state.latency)
    return np.array(latencies)


@functools.cache
def _table_in(dynamics):
    """The loop of Q-learning in the unit square of a world with two axes."""
    reset, step = dynamics
    world_type, rules_type = fields(reset)["state"], fields(reset)["rules"]

    @kernel
    def loop(state: world_type, rules: rules_type, rates: Rates, side: int, steps: int,
             q: array("float64", "cells", "actions"), stream: array("uint64", 4)) -> None:
        """Take `steps` steps, one episode after another."""
        for _ in range(steps):
            cell_tm1 = cell_at(state.scene.position, side)
            action = exploring_action(q[cell_tm1], rates.exploration, stream)
            reward, done = step(state, rules, action)
            learn_q(q, cell_tm1, action, reward, cell_at(state.scene.position, side), reward > 0.0,
                    rates.learning_rate, rates.discount)
            if done:
                reset(state, rules)

    return loop


@kernel
def cell_at(position, side):
    """The cell of a position in a grid of side × side."""
    column, row = min(max(int(position[0] * side), 0), side - 1), min(max(int(position[1] * side), 0), side - 1)
    return row * side + column


def drive_by_table(env, nres_map, rates, decisions, seed):
    """Steps per episode of Q-learning on the cells of a map, as `lengths` returns them: (POINTS,)."""
    stream, q = new_stream(np.random.SeedSequence(seed)), np.zeros((nres_map.cells, 3))
    rewards, ends = np.zeros(decisions), np.zeros(decisions, bool)
    cell = int(nres_map.encode(env.reset(seed=seed)[0]))
    for now in range(decisions):
        cell_tm1, action = cell, execute(exploring_action, q[cell], rates.exploration, stream)
        observation, rewards[now], reached, truncated, _ = env.step(action)
        cell, ends[now] = int(nres_map.encode(observation)), reached or truncated
        execute(learn_q, q, cell_tm1, action, rewards[now], cell, reached, rates.learning_rate, rates.discount)
        if ends[now]:
            cell = int(nres_map.encode(env.reset()[0]))
    return lengths(rewards, ends)


def lengths(rewards, ends):
    """Mean steps of the episodes that end in each stretch of decisions: (POINTS,)."""
    last = np.flatnonzero(ends)
    steps = -np.diff(np.cumsum(rewards)[last], prepend=0.0)
    stretch = last * POINTS // len(ends)
    return np.bincount(stretch, steps, POINTS) / np.bincount(stretch, minlength=POINTS)


def fewest(space, here, there):
    """The fewest steps from one point of an `Arena` to within its radius of another."""
    step, gap = space.step_length, [abs(a - b) for a, b in zip(here, there)]
    columns, rows = (np.arange(math.floor(each / step) + 2) for each in gap)
    left, up = np.meshgrid(gap[0] - step * columns, gap[1] - step * rows, indexing="ij")
    return int(np.add.outer(columns, rows)[left**2 + up**2 < space.radius**2].min())


def watch(result, steps):
    """Record `steps` steps after the end of the first run of a `Result` without changes.

    Returns a list of (a copy of the state after the step; whether a thing of the first kind was met in the step). In
    that state a new thing has replaced the one that was met.
    """
    run = Run(result.agent, result.world, result.seed)
    run.advance(result.steps)
    seen = []
    for _ in range(steps):
        run.advance(1)
        scene = run.world_state.scene
        seen.append((mapped(np.copy, run.world_state), bool((scene.met == 1).any())))
    return seen
