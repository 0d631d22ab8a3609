"""Statistics over runs: a run (a seed) is the unit, an interval is 95 % unless told otherwise.

Intervals are percentile bootstraps of `scipy.stats`, tolerance bands are pairs of order statistics. `rng` is what a
bootstrap draws from, a `numpy.random.Generator` or the seed of one; by default it draws the same each time.
"""

from typing import NamedTuple

import numpy as np
from scipy import stats

from neorl import checks

RESAMPLES = 1_000
RECENT = 1 / 40  # of a run: the window in which reward per second is said to have come to a level


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


def ratio(a, b, axis):
    """The mean of a divided by that of b, for `estimate`; 0 where b is 0, since no claim of a ratio holds there."""
    return quotient(a.mean(axis), b.mean(axis))


def quotient(above, below):
    """above / below, and 0 where below is 0."""
    above, below = np.asarray(above), np.asarray(below)
    return np.divide(above, below, out=np.zeros(above.shape), where=below != 0)


def lead_over_best(a, *others, axis):
    """The mean of a less the greatest of the means of the others, for `estimate`."""
    return a.mean(axis) - np.max([other.mean(axis) for other in others], axis=0)


def lead_over_sum(a, *others, axis):
    """The mean of a less the sum of the means of the others, for `estimate`."""
    return a.mean(axis) - sum(other.mean(axis) for other in others)


def least_of_most(*samples, axis):
    """The least of the means divided by the greatest, for `estimate`."""
    means = np.array([sample.mean(axis) for sample in samples])
    return quotient(means.min(axis=0), means.max(axis=0))


def rank_correlation(*samples, axis):
    """Spearman's, of the samples' places with their values, for `estimate`; scipy's own takes one pair at a time."""
    group = np.repeat(np.arange(len(samples)), [sample.shape[axis] for sample in samples])
    ranks = stats.rankdata(np.concatenate(samples, axis), axis=axis)
    place = stats.rankdata(group) - (len(group) + 1) / 2
    off = ranks - (len(group) + 1) / 2
    spread = np.sqrt((off**2).sum(axis) * (place**2).sum())
    return quotient((off * place).sum(axis), spread)


def probability_of_improvement(better, worse, rng=0):
    """How probably a run of `better` beats one of `worse`, a tie counting half, as an `Estimate`.

    Mann-Whitney's U a pair of runs (Agarwal et al. 2021, Deep reinforcement learning at the edge of the statistical
    precipice).
    """
    return estimate(_share_of_pairs, better, worse, rng=rng)


def _share_of_pairs(better, worse, axis):
    pairs = better.shape[axis] * worse.shape[axis]
    return stats.mannwhitneyu(better, worse, axis=axis, method="asymptotic").statistic / pairs


def points(result):
    """float64 (runs,): the green creeps that each run took, less the red ones."""
    return (result.hits[..., 0].sum(axis=1) - result.hits[..., 1].sum(axis=1)).astype(float)


def resets(result):
    """float64 (runs,): how often each run reset the board, by taking the last green creep.

    It follows from the rewards. Raises ValueError where that creep brings no reward of its own.
    """
    if result.world.win_reward == 0:
        raise ValueError("win_reward of the world is 0.0, allowed are worlds where a reset shows in the reward")
    return np.rint((result.totals - points(result)) / result.world.win_reward)


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
    """When each run first earns a level of reward per second: float64 (runs,), in simulated seconds.

    level: a number, or one for each run. It is earned when the mean over the fortieth of the run just past reaches it;
    a run that never earns it counts as the whole run.
    """
    rates, ends = _recent_rates(result)
    return _first(rates >= np.reshape(level, (-1, 1)), ends, result.seconds)


def _recent_rates(result):
    """Reward per second in the fortieth of the run just past, (runs, windows), and when each such window ends."""
    bins = result.rewards.shape[1]
    width = max(1, bins // round(1 / RECENT))
    sums = np.pad(result.rewards.cumsum(axis=1, dtype=float), ((0, 0), (1, 0)))
    edges = result.edges
    return (sums[:, width:] - sums[:, :-width]) / (edges[width:] - edges[:-width]), edges[width:]


def _first(made, ends, never):
    return np.where(made.any(axis=-1), ends[made.argmax(axis=-1)], never)


def minutes_sooner(quick, slow, level):
    """By how many simulated minutes the runs of `quick` earn a level sooner than those of `slow`, as an `Estimate`.

    quick, slow: a `Result` each, or a sequence of them, of runs of one length, whose rewards add up. level: reward per
    second. It is earned when the mean over runs in the fortieth of the run just past first reaches it, to about a
    two-hundredth of the run; where it is never earned, that counts as the whole run.
    """
    groups = [group if isinstance(group, list | tuple) else [group] for group in (quick, slow)]
    thinned = [[_thinned(*_recent_rates(result)) for result in group] for group in groups]

    def lead(*chosen, axis):
        chosen, times = iter(chosen), []
        for group, of_group in zip(groups, thinned):
            mean = sum(_mean_of_runs(rates, next(chosen)) for rates, _ in of_group)
            times.append(_first(mean >= level, of_group[0][1], group[0].seconds))
        return (times[1] - times[0]) / 60

    return estimate(lead, *(np.arange(result.runs) for group in groups for result in group))


def _thinned(rates, ends, points=200):
    step = max(1, rates.shape[1] // points)
    return rates[:, ::step], ends[::step]


def _mean_of_runs(rates, chosen):
    """The mean of rates (runs, windows) over the runs of each resample, chosen: int (…, runs)."""
    runs = len(rates)
    counts = np.array([np.bincount(each, minlength=runs) for each in chosen.reshape(-1, runs)])
    return (counts @ rates / runs).reshape(*chosen.shape[:-1], -1)


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
