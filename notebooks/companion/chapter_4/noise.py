"""Noise, and what is in it besides: walks with a bias, and series with a predictable part (thesis section 4.1.1).

1. At each step of a *walk* in three dimensions a walker moves one unit along an axis: with probability β, the
   *strength* of its bias, towards its goal, along the axis on which that is furthest, and else at random, as at its
   goal. A goal may be infinitely far away: the bias is then a constant drift.
2. A *series* is x_t = z_t + u_t (Wold; eq. 4.1), with z_t = y_t + b_1 y_{t−1} + b_2 y_{t−2} + … of white noise y_t, and
   one oscillation u_t, with a phase drawn for each run. `decompose` sees only the series: it takes the oscillation with
   the least squared error for u_t, predicts the rest from its past, and takes the errors, *innovations*, for y_t.
"""

from typing import NamedTuple

import numpy as np
from scipy import linalg, optimize, signal

DIRECTIONS = np.concatenate([np.eye(3, dtype=np.int32), -np.eye(3, dtype=np.int32)])
PAST = 20  # values of the past that predict the next one


def walk(strength, goal, steps, runs, seed=0):
    """Walks from the origin: int32 (runs, steps + 1, 3).

    strength: β. goal: three numbers, which may be infinite. Walk k is the same for any number of runs.
    """
    goal = np.array(goal, float)
    sequences = (np.random.SeedSequence(seed, spawn_key=(run,)) for run in range(runs))
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
    """Index of the direction towards a goal, on the axis where it is furthest: int64 (walkers,)."""
    axis = np.abs(to_goal).argmax(axis=1)
    behind = np.take_along_axis(to_goal, axis[:, None], axis=1)[:, 0] < 0
    return axis + 3 * behind


def mean_squared_displacement(paths, lags):
    """Mean squared displacement of walks over lags, averaged over all starting steps: float64 (runs, lags)."""
    paths = paths.astype(float)  # squares of 32-bit integers would soon be too large
    moved = (paths[:, lag:] - paths[:, :-lag] for lag in lags)
    return np.stack([np.einsum("rtx,rtx->r", each, each) / each.shape[1] for each in moved], axis=1)


def expected_squared_displacement(strength, lags):
    """Expected squared displacement under a constant drift β: (1 − β²) lag + β² lag².

    Up to about (1 − β²) / β² steps a walk diffuses, and its distance grows with the square root of time; then it
    drifts.
    """
    return (1 - strength**2) * lags + (strength * lags) ** 2


class Parts(NamedTuple):
    """A decomposed series, without its first `PAST` values, whose past is too short to predict them."""

    deterministic: np.ndarray  # u_t: float64 (steps − PAST,)
    stochastic: np.ndarray  # z_t: float64 (steps − PAST,)
    innovations: np.ndarray  # y_t: float64 (steps − PAST,)


def generate(coefficients, amplitude, period, steps, run=0, seed=0):
    """A series and its parts, the parts without the first `PAST` values: (float64 (steps,), `Parts`).

    coefficients: b_1, b_2, … of noise with a standard deviation of 1. steps: more than twice `PAST`.
    """
    rng = np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(run,)))
    oscillation = amplitude * np.cos(2 * np.pi * (np.arange(steps) / period + rng.random()))
    noise = rng.normal(size=steps + len(coefficients))
    filtered = signal.lfilter([1, *coefficients], 1, noise)[len(coefficients):]
    return filtered + oscillation, Parts(*(each[PAST:] for each in (oscillation, filtered, noise[len(coefficients):])))


def decompose(series):
    """Decompose a series into `Parts`. series: float64 (steps,), more than twice `PAST`."""
    spectrum = np.abs(np.fft.rfft(series))
    peak = 1 + spectrum[1:-1].argmax()
    frequency = optimize.minimize_scalar(lambda each: np.square(series - _oscillation(each, series)).sum(),
                                         bounds=(peak - 1, peak + 1), method="bounded", options={"xatol": 1e-6}).x
    deterministic = _oscillation(frequency, series)
    rest = series - deterministic
    past = linalg.toeplitz(rest[PAST - 1 : -1], rest[PAST - 1 :: -1])
    innovations = rest[PAST:] - past @ _least_squares(past, rest[PAST:])
    return Parts(deterministic[PAST:], rest[PAST:], innovations)


def _oscillation(frequency, series):
    """The best-fitting oscillation of a frequency, in periods per series."""
    angle = 2 * np.pi * frequency * np.arange(len(series)) / len(series)
    basis = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    return basis @ _least_squares(basis, series)


def _least_squares(basis, series):
    return np.linalg.solve(basis.T @ basis, basis.T @ series)  # many times faster than lstsq, and well conditioned here
