"""Statistics over runs: a run (a seed) is the unit, an interval is 95 % unless told otherwise.

Intervals are percentile bootstraps of `scipy.stats` with a generator of their own, so that they are the same each time.
"""

from typing import NamedTuple

import numpy as np
from scipy import stats

RESAMPLES = 1_000


class Estimate(NamedTuple):
    """A value with the bounds of its 95 % interval."""

    value: float
    low: float
    high: float

    def __str__(self):
        return f"{self.value:z.2f} [{self.low:z.2f}, {self.high:z.2f}]".replace("-", "−")


def estimate(statistic, *samples):
    """A statistic of one or several independent samples (each (runs,)), with its bootstrap interval.

    A sample of a single run has no interval: its bounds are NaN.
    """
    value = float(statistic(*samples))
    if min(len(sample) for sample in samples) < 2:
        return Estimate(value, np.nan, np.nan)
    low, high = _bootstrapped(samples, statistic, vectorized=False)
    return Estimate(value, float(low), float(high))


def probability_of_improvement(better, worse):
    """How probably a run of `better` beats one of `worse`, a tie counting half: Mann-Whitney's U a pair."""
    return float(stats.mannwhitneyu(better, worse).statistic) / (len(better) * len(worse))


def time_to_final_level(result, share=0.9):
    """When each run first makes `share` of its final level: float64 (runs,), in simulated seconds.

    The final level is a run's own reward per second in its last fifth. It is made when the mean over the fortieth of
    the run just past reaches it. A run whose final level is not positive never makes it, and counts as the whole run.
    """
    width = max(1, result.rewards.shape[1] // 40)
    final = result.rate(0.8, 1.0)
    sums = np.pad(result.rewards.cumsum(axis=1, dtype=float), ((0, 0), (1, 0)))
    edges = result.edges
    made = (sums[:, width:] - sums[:, :-width]) / (edges[width:] - edges[:-width]) >= share * final[:, None]
    first = np.where(made.any(axis=1) & (final > 0), made.argmax(axis=1) + width, result.rewards.shape[1])
    return edges[first]


def band(curves):
    """The band that holds the middle 95 % of the runs at each point of curves (runs, points): (low, high)."""
    return np.quantile(curves, [0.025, 0.975], axis=0)


def mean_band(curves):
    """The interval of the mean over runs at each point of curves (runs, points): (low, high), as `estimate` has it."""
    if len(curves) < 2:
        return np.full((2, curves.shape[1]), np.nan)
    return _bootstrapped((curves,), np.mean, axis=0)


def _bootstrapped(samples, statistic, **how):
    return stats.bootstrap(samples, statistic, n_resamples=RESAMPLES, confidence_level=0.95, method="percentile",
                           rng=np.random.default_rng(0), **how).confidence_interval
