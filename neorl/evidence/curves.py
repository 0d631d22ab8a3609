"""Curves of reward per second over a run, in equal intervals, and smoothed as in the thesis."""

import numpy as np
import scipy
from numpy.typing import ArrayLike, NDArray

from neorl import checks
from neorl.experiments.result import Result

# Paper B smooths its curves "by a Butterworth low-pass filter" (section 3). The thesis states neither of these.
FILTER_ORDER = 4
CUTOFF_PERIODS = 20  # per run: the filter removes higher frequencies


def binned_rate(result: Result, points: int) -> NDArray[np.float64]:
    """Reward per second over equal intervals of the run: float64 (runs, points).

    result: a `Result`. points: integer, from 1 to the number of its bins. Raises ValueError for anything else.
    """
    bins = checks.instance("result", result, Result).rewards.shape[1]
    points = checks.integer("points", points, at_least=1, at_most=bins)
    edges = np.linspace(0, bins, points + 1).astype(int)
    sums = np.add.reduceat(result.rewards, edges[:-1], axis=1)
    return sums / np.diff(result.edges[edges])


def low_passed(rates: ArrayLike) -> NDArray[np.float64]:
    """Low-pass filter curves (runs, points) forwards and backwards, so that nothing shifts in time.

    At either end a curve is extended by its point reflection, in the end point of a straight line fitted to its first
    or last cutoff period: its own end point is as noisy as an unfiltered curve.
    rates: (runs, points). Raises ValueError for anything but finite numbers, or if there are no more points than
    twice `CUTOFF_PERIODS`.
    """
    rates = checks.doubles("rates", rates)
    if rates.ndim != 2 or rates.shape[1] <= 2 * CUTOFF_PERIODS or not len(rates):
        raise ValueError(f"rates must have the shape (runs, points), with more than {2 * CUTOFF_PERIODS} points, but "
                         f"has {rates.shape}")
    points = rates.shape[1]
    sections = scipy.signal.butter(FILTER_ORDER, 2 * CUTOFF_PERIODS / points, output="sos")
    near = points // CUTOFF_PERIODS
    first, last = (np.polynomial.polynomial.polyfit(np.arange(near) + 0.5, end.T, 1)[0][:, None]
                   for end in (rates[:, :near], rates[:, : -near - 1 : -1]))
    mirrored = rates[:, ::-1]
    longer = np.concatenate([2 * first - mirrored, rates, 2 * last - mirrored], axis=1)
    return scipy.signal.sosfiltfilt(sections, longer, axis=1)[:, points : 2 * points]
