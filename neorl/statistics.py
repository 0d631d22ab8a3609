"""Statistics over runs: a run (a seed) is the unit, an interval is 95 % unless told otherwise.

Intervals are percentile bootstraps of `scipy.stats`, tolerance bands are pairs of order statistics. `rng` is what a
bootstrap draws from, a `numpy.random.Generator` or the seed of one; by default it draws the same each time.
"""

from typing import NamedTuple

import numpy as np
from scipy import stats

from neorl import checks

RESAMPLES = 1_000


class Estimate(NamedTuple):
    """A value with the bounds of its 95 % interval."""

    value: float
    low: float
    high: float

    def __str__(self):
        bounds = "" if np.isnan(self.low) else f" [{self.low:z.2f}, {self.high:z.2f}]"
        return f"{self.value:z.2f}{bounds}".replace("-", "−")


def estimate(statistic, *samples, rng=0):
    """A statistic of one or several independent samples (each (runs,)), with its bootstrap interval.

    statistic: takes the samples, and `axis`, along which the runs lie. A sample of a single run has no interval: its
    bounds are NaN.
    """
    value = float(statistic(*map(np.asarray, samples), axis=-1))
    if min(len(sample) for sample in samples) < 2:
        return Estimate(value, np.nan, np.nan)
    low, high = _bootstrapped(samples, statistic, rng)
    return Estimate(value, float(low), float(high))


def difference(a, b, axis):
    """The mean of a less that of b, for `estimate`."""
    return a.mean(axis) - b.mean(axis)


def probability_of_improvement(better, worse, rng=0):
    """How probably a run of `better` beats one of `worse`, a tie counting half, as an `Estimate`.

    Mann-Whitney's U a pair of runs (Agarwal et al. 2021, Deep reinforcement learning at the edge of the statistical
    precipice).
    """
    return estimate(_share_of_pairs, better, worse, rng=rng)


def _share_of_pairs(better, worse, axis):
    pairs = better.shape[axis] * worse.shape[axis]
    return stats.mannwhitneyu(better, worse, axis=axis, method="asymptotic").statistic / pairs


def tolerance_band(curves, share=0.75, confidence=0.95):
    """The band between two order statistics that holds a share of all runs there could be, at each point: (low, high).

    curves: (runs, points). It is the narrowest such band, with as many runs above as below, that holds `share` of them
    with `confidence`, whatever their distribution (Wilks 1941). Where there are too few runs, fewer than 18 by default,
    it is their whole range, and holds less: `tolerated_share` tells how much.
    Raises ValueError unless both are numbers from 0 to 1.
    """
    checks.real("share", share, 0, 1)
    checks.real("confidence", confidence, 0, 1)
    runs = len(curves)
    beyond = 1
    while 2 * (beyond + 1) <= runs and tolerated_share(runs, beyond + 1, confidence) >= share:
        beyond += 1
    ordered = np.sort(curves, axis=0)
    return ordered[[beyond - 1, -beyond]]


def tolerated_share(runs, beyond=1, confidence=0.95):
    """The share of all runs there could be that, with `confidence`, lies between the `beyond`-th runs from the ends."""
    return float(stats.beta.ppf(1 - confidence, runs + 1 - 2 * beyond, 2 * beyond)) if runs >= 2 * beyond else 0.0


def time_to_level(result, level):
    """When each run first makes a level of reward per second: float64 (runs,), in simulated seconds.

    level: a number, or one for each run. It is made when the mean over the fortieth of the run just past reaches it; a
    run that never makes it counts as the whole run.
    """
    bins = result.rewards.shape[1]
    width = max(1, bins // 40)
    sums = np.pad(result.rewards.cumsum(axis=1, dtype=float), ((0, 0), (1, 0)))
    edges = result.edges
    made = (sums[:, width:] - sums[:, :-width]) / (edges[width:] - edges[:-width]) >= np.reshape(level, (-1, 1))
    return edges[np.where(made.any(axis=1), made.argmax(axis=1) + width, bins)]


def time_to_final_level(result, share=0.9):
    """When each run first makes `share` of its final level: float64 (runs,), in simulated seconds, see `time_to_level`.

    The final level is a run's own reward per second in its last fifth. A run whose final level is not positive never
    makes it.
    """
    final = result.rate(0.8, 1.0)
    return time_to_level(result, np.where(final > 0, share * final, np.inf))


def mean_band(curves, rng=0):
    """The interval of the mean over runs at each point of curves (runs, points): (low, high), as `estimate` has it."""
    if len(curves) < 2:
        return np.full((2, curves.shape[1]), np.nan)
    return _bootstrapped((curves,), np.mean, rng, axis=0)


def _bootstrapped(samples, statistic, rng, axis=-1):
    return stats.bootstrap(samples, statistic, n_resamples=RESAMPLES, confidence_level=0.95, method="percentile",
                           vectorized=True, axis=axis, rng=np.random.default_rng(rng)).confidence_interval
