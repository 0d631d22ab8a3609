"""Wold's decomposition by example: a series is filtered white noise plus a predictable part (thesis eq. 4.1).

1. The series is x_t = z_t + u_t. The noise y_t is white, and z_t = y_t + b_1 y_{t−1} + b_2 y_{t−2} + …
2. The deterministic part u_t is one oscillation, with a phase drawn for each run.
3. `decompose` sees only the series. It takes the oscillation with the least squared error for u_t, predicts the rest
   from its past by least squares, and takes the prediction errors, called *innovations*, for y_t.
4. The coefficients b_k are those of the regression of the rest on the innovations, as Wold defines them.
"""

from typing import NamedTuple

import numpy as np
from scipy import linalg, optimize, signal

from neorl import checks

PAST = 20  # values of the past that predict the next one
LENGTHS = (300, 1_000, 3_000, 10_000, 30_000)  # of the series that `errors` decomposes, in steps


class Parts(NamedTuple):
    """A decomposed series, without its first `PAST` values, whose past is too short to predict them."""

    deterministic: np.ndarray  # u_t: float64 (steps − PAST,)
    stochastic: np.ndarray  # z_t: float64 (steps − PAST,)
    innovations: np.ndarray  # y_t: float64 (steps − PAST,)
    coefficients: np.ndarray  # b_1, b_2, …: float64 (order,)


def generate(coefficients, amplitude, period, steps, run=0, seed=0):
    """A series and its parts, the parts without the first `PAST` values: (float64 (steps,), `Parts`).

    coefficients: b_1, b_2, … of noise with a standard deviation of 1. amplitude: of the oscillation, ≥ 0. period: of
    the oscillation, in steps, ≥ 2. steps: integer, more than twice `PAST`. run, seed: integers ≥ 0.
    Raises ValueError for anything else.
    """
    coefficients = checks.finite("coefficients", np.asarray(coefficients, float))
    checks.real("amplitude", amplitude, 0)
    checks.real("period", period, 2)
    checks.integer("steps", steps, at_least=2 * PAST + 1)
    sequence = np.random.SeedSequence(checks.integer("seed", seed, at_least=0),
                                      spawn_key=(checks.integer("run", run, at_least=0),))
    rng = np.random.default_rng(sequence)
    oscillation = amplitude * np.cos(2 * np.pi * (np.arange(steps) / period + rng.random()))
    noise = rng.normal(size=steps + len(coefficients))
    filtered = signal.lfilter([1, *coefficients], 1, noise)[len(coefficients):]
    parts = (each[PAST:] for each in (oscillation, filtered, noise[len(coefficients):]))
    return filtered + oscillation, Parts(*parts, coefficients)


def decompose(series, order):
    """Decompose a series into `Parts`, with b_1 … b_order. series: float64 (steps,), more than twice `PAST`.

    Raises ValueError for anything else.
    """
    series = checks.finite("series", np.asarray(series, float))
    if series.ndim != 1 or len(series) <= 2 * PAST:
        raise ValueError(f"series has the shape {series.shape}, allowed are (steps,) with more than {2 * PAST} steps")
    checks.integer("order", order, at_least=1, at_most=PAST)
    spectrum = np.abs(np.fft.rfft(series))
    peak = 1 + spectrum[1:-1].argmax()
    frequency = optimize.minimize_scalar(_left_over, args=(series,), bounds=(peak - 1, peak + 1), method="bounded",
                                         options={"xatol": 1e-6}).x
    deterministic = _oscillation(frequency, series)
    rest = series - deterministic
    past = linalg.toeplitz(rest[PAST - 1 : -1], rest[PAST - 1 :: -1])
    innovations = rest[PAST:] - past @ _least_squares(past, rest[PAST:])
    earlier = np.stack([innovations[order - k : -k] for k in range(1, order + 1)], axis=1)
    coefficients = _least_squares(earlier, rest[PAST + order :])
    return Parts(deterministic[PAST:], rest[PAST:], innovations, coefficients)


def errors(coefficients, period, longest, runs, seed=0):
    """Errors of `decompose` on series of `generate`, by length: {steps: float64 (3, runs)}.

    They are the root mean square errors of u_t and of y_t, and the largest error of b_1, b_2, …; the oscillation has an
    amplitude of 1.
    longest: steps of the longest series; greater `LENGTHS` are left out. runs: of each length. Other arguments as in
    `generate`.
    """
    return {steps: np.transpose([_error(coefficients, period, steps, run, seed) for run in range(runs)])
            for steps in LENGTHS if steps <= longest}


def _error(coefficients, period, steps, run, seed):
    series, true = generate(coefficients, 1.0, period, steps, run, seed)
    found = decompose(series, order=len(coefficients))
    return [np.sqrt(np.mean((found.deterministic - true.deterministic) ** 2)),
            np.sqrt(np.mean((found.innovations - true.innovations) ** 2)),
            np.abs(found.coefficients - true.coefficients).max()]


def _left_over(frequency, series):
    return np.square(series - _oscillation(frequency, series)).sum()


def _oscillation(frequency, series):
    """The best-fitting oscillation of a frequency, in periods per series."""
    angle = 2 * np.pi * frequency * np.arange(len(series)) / len(series)
    basis = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    return basis @ _least_squares(basis, series)


def _least_squares(basis, series):
    return np.linalg.solve(basis.T @ basis, basis.T @ series)  # many times faster than lstsq, and well conditioned here
