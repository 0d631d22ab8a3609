"""Trials in the water maze: the page's agent, the same agent swimming at random, and Q-learning on the same cells.

The state of Q-learning (Watkins 1989) is the animal's cell in the finer map. It learns at every step, and its reward is
1 on the platform, the only information on where that is.
"""

import functools

import numpy as np

from lib.other_spaces import minds
from lib.shared.tabular import Rates, exploring_action, learn_q
from neorl import Run, WaterMaze
from neorl.core.geometry import TAU
from neorl.core.kernel import array, execute, fields, kernel
from neorl.core.stream import new_stream

DAYS, TRIALS_A_DAY = 8, 4
SIDE = 9  # cells along each side of the table of Q-learning
RATES = Rates(0.3, 0.99, 0.05)
STRETCH = 500  # steps between two checks of whether all trials are over
ANGLES = TAU * np.arange(DAYS) * 3 / 8
MOVED = WaterMaze([(0.5 + 0.25 * np.cos(angle), 0.5 + 0.25 * np.sin(angle)) for angle in ANGLES], TRIALS_A_DAY)
FIXED = WaterMaze(MOVED.places[:1] * DAYS, TRIALS_A_DAY)
PLATFORMS = {"moved": MOVED, "fixed": FIXED}


def swim(runs, seed):
    """Seconds to the platform: {platform: {swimmer: float64 (runs, days, trials a day)}}.

    platform: "moved" every day, or "fixed". swimmer: "neoRL", "Q-learning" or "random".
    """
    agent = minds.swimmer()
    return {name: {swimmer: np.array([each(run) for run in range(runs)]).reshape(runs, DAYS, TRIALS_A_DAY)
                   for swimmer, each in (
                       ("neoRL", functools.partial(_latencies, agent, maze, seed)),
                       ("Q-learning", functools.partial(_latencies_of_table, maze, seed)),
                       ("random", functools.partial(_latencies, minds.aimless(agent), maze, seed)))}
            for name, maze in PLATFORMS.items()}


def experienced(seed):
    """A swimmer before the last day with a moved platform: a `Run` at the start of that day's first trial."""
    run = Run(minds.swimmer(), MOVED, seed)
    while run.world_state.trial[0] <= MOVED.trials - TRIALS_A_DAY:
        run.advance(1)
    return run


def last_path(run, trials=1):
    """Paths of a swimmer in its next trials: a list of float64 (steps, 2)."""
    paths = []
    while len(paths) < trials:
        path, trial = [], run.world_state.trial[0]
        while run.world_state.trial[0] == trial:
            path.append(run.world_state.scene.position.copy())
            run.advance(1)
        paths.append(np.array(path))
    return paths


def _latencies(agent, maze, seed, run):
    return _swum(agent, maze, seed, run).world_state.latency.copy()


def _swum(agent, maze, seed, run):
    life = Run(agent, maze, seed, run)
    while life.world_state.trial[0] <= maze.trials:
        life.advance(STRETCH)
    return life


def _latencies_of_table(maze, seed, run):
    sequence = np.random.SeedSequence(seed, spawn_key=(run,))
    state, q = maze.reset(sequence), np.zeros((SIDE * SIDE, len(maze.actions.names)))
    stream = new_stream(sequence.spawn(1)[0])
    while state.trial[0] <= maze.trials:
        execute(_table_in(maze.dynamics), state, maze.rules, RATES, SIDE, STRETCH, q, stream)
    return state.latency


@functools.cache
def _table_in(dynamics):
    """The kernel `live` of Q-learning in the unit square of a world with two axes."""
    reset, step = dynamics
    world_type, rules_type = fields(reset)["state"], fields(reset)["rules"]

    @kernel
    def live(state: world_type, rules: rules_type, rates: Rates, side: int, steps: int,
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

    return live


@kernel
def cell_at(position, side):
    """The cell of a position in a grid of side × side."""
    column, row = min(max(int(position[0] * side), 0), side - 1), min(max(int(position[1] * side), 0), side - 1)
    return row * side + column
