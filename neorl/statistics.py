"""Statistics over runs: a run (a seed) is the unit, an interval is 95 % unless stated otherwise.

Intervals are percentile bootstraps of `scipy.stats`, whose draws are always the same; tolerance bands are pairs of
order statistics. Fewer than `FEWEST_RUNS` runs have no interval: of normal samples, percentile intervals of 2, 3 and 4
runs contain the mean in 49, 74 and 79 % of cases, and of 10 runs in 90 %.
"""

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
import scipy
from numpy.typing import ArrayLike, NDArray

from neorl.common import checks
from neorl.experiments.result import Result
from neorl.worlds.waterworld import WaterWorld

RESAMPLES = 1_000
FEWEST_RUNS = 10  # that an interval is given for
MOST_RUNS = 2**31
TOLERATED = 0.75  # the share of all possible runs that a tolerance band contains


class Estimate(NamedTuple):
    """A value with the bounds of its 95 % interval, which contains it.

    A number without uncertainty is both bounds of its interval. As text it has two decimals below 10, and none from
    there on.
    """

    value: float
    low: float
    high: float

    def __str__(self):
        digits = 2 if abs(self.value) < 10 else 0
        certain = np.isnan(self.low) or self.low == self.high
        bounds = "" if certain else f" [{self.low:z.{digits}f}, {self.high:z.{digits}f}]"
        return f"{self.value:z.{digits}f}{bounds}".replace("-", "−")


def estimate(statistic: Callable, *samples: ArrayLike) -> Estimate:
    """A statistic of one or several independent samples (each (runs,)), with its bootstrap interval.

    The interval is extended to the value where it would not contain it, as resamples may be biased, or rounded
    otherwise. Where a sample has fewer than `FEWEST_RUNS` runs there is no interval: its bounds are NaN.

    statistic: takes the samples, and `axis`, the axis of the runs. Raises ValueError for a sample that is empty or not
    finite.
    """
    if not callable(statistic) or not samples:
        raise ValueError(f"statistic must be a function of one sample or more, but is {checks.shown(statistic)} of "
                         f"{len(samples)}")
    checked = [_sample("samples", each) for each in samples]
    value = float(statistic(*checked, axis=-1))
    if min(map(len, checked)) < FEWEST_RUNS:
        return Estimate(value, np.nan, np.nan)
    low, high = _bootstrapped(checked, statistic)
    return Estimate(value, min(float(low), value), max(float(high), value))


def difference(a, b, axis):
    """The mean of a less that of b, for `estimate`."""
    return a.mean(axis) - b.mean(axis)


def ratio(a, b, axis):
    """The mean of a divided by that of b, for `estimate`; 0 where b is 0, since no claim of a ratio holds there."""
    return quotient(a.mean(axis), b.mean(axis))


def quotient(above, below):
    """above / below, and 0 where below is 0."""
    above, below = np.asarray(above), np.asarray(below)
    return np.divide(above, below, out=np.zeros(above.shape), where=below != 0)


def probability_of_improvement(better: ArrayLike, worse: ArrayLike) -> Estimate:
    """The probability that a run of `better` beats one of `worse`, a tie counting half, as an `Estimate`.

    Mann-Whitney's U per pair of runs (Agarwal et al. 2021, Deep reinforcement learning at the edge of the statistical
    precipice). better, worse: (runs,). Raises ValueError for a sample that is empty or not finite.
    """
    return estimate(_share_of_pairs, _sample("better", better), _sample("worse", worse))


def _share_of_pairs(better, worse, axis):
    pairs = better.shape[axis] * worse.shape[axis]
    return scipy.stats.mannwhitneyu(better, worse, axis=axis, method="asymptotic").statistic / pairs


def points(result: Result) -> NDArray[np.float64]:
    """The green creeps that each run took, less the red ones: float64 (runs,).

    result: a `Result` in `WaterWorld`. Raises ValueError for anything else.
    """
    _in_waterworld(result)
    return (result.hits[..., 0].sum(axis=1) - result.hits[..., 1].sum(axis=1)).astype(float)


def resets(result: Result) -> NDArray[np.float64]:
    """The number of times that each run reset the board by taking the last green creep: float64 (runs,).

    result: a `Result` in `WaterWorld`, from whose rewards it follows. Raises ValueError if that creep brings no extra
    reward.
    """
    win_reward = _in_waterworld(result).win_reward
    if win_reward == 0:
        raise ValueError("win_reward of the world must differ from 0, so that a reset shows in the reward, but is 0.0")
    return np.rint((result.totals - points(result)) / win_reward)


def tolerance_band(curves: ArrayLike) -> NDArray[np.float64]:
    """The band between two order statistics that contains 75 % of all possible runs, at each point: (low, high).

    It is the narrowest band, with as many runs above as below, that contains them with a confidence of 95 %, whatever
    their distribution (Wilks 1941). With fewer than 18 runs, it is their whole range and contains less, by as much as
    `tolerated_share` says.

    curves: (runs, points). Returns float64 (2, points). Raises ValueError unless they are finite, of one run or more.
    """
    ordered, beyond = np.sort(_curves(curves), axis=0), 1
    while tolerated_share(len(ordered), beyond + 1) >= TOLERATED:
        beyond += 1
    return ordered[[beyond - 1, -beyond]]


def tolerated_share(runs: int, beyond: int = 1) -> float:
    """The share of all possible runs that, with a confidence of 95 %, lies between the `beyond`-th runs from the ends.

    runs: integer ≥ 0. beyond: integer ≥ 1. Raises ValueError for anything else.
    """
    runs, beyond = checks.integer("runs", runs, 0, MOST_RUNS), checks.integer("beyond", beyond, 1, MOST_RUNS)
    return float(scipy.stats.beta.ppf(0.05, runs + 1 - 2 * beyond, 2 * beyond)) if runs >= 2 * beyond else 0.0


def mean_band(curves: ArrayLike) -> Any:
    """The interval of the mean over runs at each point of curves (runs, points): (low, high), as in `estimate`.

    Raises ValueError for curves that are not finite or have no runs.
    """
    checked = _curves(curves)
    if len(checked) < FEWEST_RUNS:
        return np.full((2, checked.shape[1]), np.nan)
    return _bootstrapped((checked,), np.mean, axis=0)


def binned_rate(result: Result, points: int) -> NDArray[np.float64]:
    """Reward per second over equal intervals of the run: float64 (runs, points).

    result: a `Result`. points: integer, from 1 to the number of its bins. Raises ValueError for anything else.
    """
    bins = checks.instance("result", result, Result).rewards.shape[1]
    points = checks.integer("points", points, at_least=1, at_most=bins)
    edges = np.linspace(0, bins, points + 1).astype(int)
    sums = np.add.reduceat(result.rewards, edges[:-1], axis=1)
    return sums / np.diff(result.edges[edges])


def _sample(name, values):
    sample = checks.doubles(name, values)
    if sample.ndim != 1 or not len(sample):
        raise checks.error(name, "a number for each run, of one run or more", values)
    return np.asarray(values) if np.asarray(values).dtype.kind == "i" else sample  # indices of runs stay integers


def _curves(values):
    curves = checks.doubles("curves", values)
    if curves.ndim != 2 or not curves.size:
        raise ValueError(f"curves must have the shape (runs, points), at least one of each, but has {curves.shape}")
    return curves


def _in_waterworld(result):
    return checks.instance("world of result", checks.instance("result", result, Result).world, WaterWorld)


def _bootstrapped(samples, statistic, axis=-1):
    return scipy.stats.bootstrap(samples, statistic, n_resamples=RESAMPLES, confidence_level=0.95, method="percentile",
                                 vectorized=True, axis=axis, rng=np.random.default_rng(0)).confidence_interval
