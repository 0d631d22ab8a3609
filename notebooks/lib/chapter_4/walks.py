"""Random walks in three dimensions, and the bias that turns them into behaviour (thesis section 4.1.1, figure 4.1).

1. At each step a walker moves one unit in one of the six directions of the axes.
2. With probability 1 − β it draws the direction. With probability β, the *strength* of its bias, it moves towards its
   goal, along the axis on which the goal is furthest; at its goal it always draws.
3. The walker is an ε-greedy agent with ε = 1 − β. β = 0 is a random walk, whose position after many steps is a Wiener
   process.
4. A goal may be infinitely far away. Its direction then never changes, and the bias is a constant drift.
"""

import numpy as np

from neorl import checks

NEAR = 5  # units within which a walk has reached a goal
DIRECTIONS = np.concatenate([np.eye(3, dtype=np.int32), -np.eye(3, dtype=np.int32)])


def walk(strength, goal, steps, runs, seed=0):
    """Walks from the origin: int32 (runs, steps + 1, 3).

    strength: β, from 0 to 1. goal: three numbers, infinite ones allowed, but not NaN. steps, runs: integers ≥ 1. seed:
    integer ≥ 0; walk k is the same for any number of runs, and draws the same numbers for any strength and goal.
    Raises ValueError for anything else.
    """
    checks.real("strength", strength, 0, 1)
    goal = np.asarray(goal, float)
    if goal.shape != (3,) or np.isnan(goal).any():
        raise ValueError(f"goal is {goal}, allowed are three numbers")
    checks.integer("steps", steps, at_least=1)
    checks.integer("runs", runs, at_least=1)
    sequences = [np.random.SeedSequence(checks.integer("seed", seed, at_least=0), spawn_key=(run,))
                 for run in range(runs)]
    biased, drawn = np.empty((steps, runs), bool), np.empty((steps, runs), np.int8)
    for run, rng in enumerate(map(np.random.default_rng, sequences)):
        biased[:, run], drawn[:, run] = rng.random(steps) < strength, rng.integers(6, size=steps)
    if np.isinf(goal).any():
        drawn[biased] = _towards(goal[None])[0]
        biased[:] = False
    paths = np.zeros((steps + 1, runs, 3), np.int32)
    if biased.any():
        for step in range(steps):
            to_goal = goal - paths[step]
            greedy = biased[step] & to_goal.any(axis=1)
            paths[step + 1] = paths[step] + DIRECTIONS[np.where(greedy, _towards(to_goal), drawn[step])]
    else:
        np.cumsum(DIRECTIONS[drawn], axis=0, out=paths[1:])
    return paths.transpose(1, 0, 2)


def _towards(to_goal):
    """Index of the direction towards a goal, along the axis on which it is furthest: int64 (walkers,).

    Of several such axes, the first is taken.

    to_goal: (walkers, 3), from the walker to its goal.
    """
    axis = np.abs(to_goal).argmax(axis=1)
    behind = np.take_along_axis(to_goal, axis[:, None], axis=1)[:, 0] < 0
    return axis + 3 * behind


def first_arrivals(paths, goal):
    """First step at which each walk is within `NEAR` units of a goal: float64 (runs,), infinite if it never is.

    paths: (runs, steps + 1, 3). goal: three numbers.
    """
    near = np.linalg.norm(paths - np.array(goal), axis=2) < NEAR
    return np.where(near.any(axis=1), near.argmax(axis=1), np.inf)


def mean_squared_displacement(paths, lags):
    """Mean squared displacement of walks over lags, averaged over all starting steps: float64 (runs, lags).

    paths: (runs, steps + 1, 3). lags: integers from 1 to steps.
    """
    paths = paths.astype(float)  # squares of 32-bit integers would soon be too large
    moved = (paths[:, lag:] - paths[:, :-lag] for lag in lags)
    return np.stack([np.einsum("rtx,rtx->r", each, each) / each.shape[1] for each in moved], axis=1)


def expected_squared_displacement(strength, lags):
    """Expected squared displacement under a constant drift β: (1 − β²) lag + β² lag².

    Up to about (1 − β²) / β² steps a walk diffuses, and its distance grows with the square root of time; then it
    drifts.
    """
    return (1 - strength**2) * lags + (strength * lags) ** 2


def powers_of_time(squared, lags):
    """Power of time with which distance grows, at the shortest lags and at the longest: float64 (2, runs).

    squared: as `mean_squared_displacement` returns it, for at least four lags.
    """
    return np.array([np.log(squared[:, j] / squared[:, i]) / np.log(lags[j] / lags[i]) / 2
                     for i, j in ((0, 2), (-4, -1))])
