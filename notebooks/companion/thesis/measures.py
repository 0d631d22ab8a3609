"""What the rules measure, beside `neorl.statistics`: leads, times, and several intervals in one verdict.

1. Where a verdict rests on k intervals, each is *widened*, so that it holds with 1 − 0.05/k, and all with 95 %: its
   ends move away from the value as those of a normal distribution would; those of a time are percentiles. The greatest
   or the smallest of several means has the widened intervals of all, since a bootstrapped maximum does not hold with
   95 %.
2. A *time* is when the mean over runs crosses a level, once it is made monotone by isotonic regression. The first
   window in which a noisy mean reaches a level comes too early. A level that is never reached within the run has an
   infinite time, which enters no mean; of two that are not reached, neither is the sooner.
3. Rewards are per simulated second, *final* is the last fifth of a run.
"""

import numpy as np
import scipy

from neorl.statistics import FEWEST_RUNS, RESAMPLES, Estimate, binned_rate, estimate, quotient

POINTS = 400  # of the curve whose crossing counts
EARLY, FINAL = (0.0, 0.1), (0.8, 1.0)


def exact(value):
    """A number without uncertainty, as an `Estimate`."""
    return Estimate(value, value, value)


class Time(Estimate):
    """An `Estimate` of minutes that knows its resamples, since these may be of two kinds: a level reached, or never."""

    def __new__(cls, value, resamples, together=1):
        method = "linear" if np.isfinite(resamples).all() else "inverted_cdf"  # which has no mean of two resamples
        low, high = np.quantile(resamples, [0.025 / together, 1 - 0.025 / together], method=method)
        self = super().__new__(cls, float(value), min(low, value), max(high, value))
        self.resamples = resamples
        return self

    def __truediv__(self, by):
        return Time(self.value / by, self.resamples / by)


def widened(found, together):
    """An `Estimate` of 95 %, as one of some intervals that hold together with 95 %."""
    if isinstance(found, Time):
        return Time(found.value, found.resamples, together)
    by = scipy.stats.norm.ppf(1 - 0.025 / together) / scipy.stats.norm.ppf(0.975)
    value, low, high = found
    return Estimate(value, value - by * (value - low), value + by * (high - value))


def least(estimates):
    """The smallest of several `Estimate`s, with the smallest bounds: that all are above a number."""
    return Estimate(*map(min, zip(*estimates)))


def most(estimates):
    """The greatest of several `Estimate`s, with the greatest bounds: that all are below a number."""
    return Estimate(*map(max, zip(*estimates)))


def evenness(quotient_of_two):
    """An `Estimate` of a positive quotient, turned so that it is 1 at most: the smaller one divided by the greater."""
    value, low, high = quotient_of_two
    ends = [min(each, 1 / each) if each > 0 else 0.0 for each in (low, high)]
    return Estimate(min(value, 1 / value) if value > 0 else 0.0, min(ends), 1.0 if low <= 1 <= high else max(ends))


def lead_over_sum(a, *others, axis):
    """The mean of a less the sum of the means of the others, for `estimate`."""
    return a.mean(axis) - sum(other.mean(axis) for other in others)


def share_over_sum(a, *others, axis):
    """`lead_over_sum`, as a share of the mean of a."""
    return quotient(lead_over_sum(a, *others, axis=axis), a.mean(axis))


def share_of_lead(reached, chance, whole, axis):
    """The lead of a mean over chance, divided by that of another mean; 0 unless both lead, for `estimate`."""
    base = chance.mean(axis)
    return quotient(np.maximum(reached.mean(axis) - base, 0), np.maximum(whole.mean(axis) - base, 0))


def rank_correlation(*samples, axis):
    """Spearman's correlation of the samples' order with their values, for `estimate`; scipy's takes one pair at a time.
    """
    group = np.repeat(np.arange(len(samples)), [sample.shape[axis] for sample in samples])
    ranks = scipy.stats.rankdata(np.concatenate(samples, axis), axis=axis)
    place = scipy.stats.rankdata(group) - (len(group) + 1) / 2
    off = ranks - (len(group) + 1) / 2
    spread = np.sqrt((off**2).sum(axis) * (place**2).sum())
    return quotient((off * place).sum(axis), spread)


def minutes_sooner(quick, slow, share, *others):
    """The simulated minutes by which the mean of a `Result` reaches a level sooner than that of another: `Estimate`.

    The level is `share` of the greatest final level among slow and the others, as uncertain as these.
    """
    rivals = (slow, *others)

    def statistic(of_quick, *of_rivals, axis):
        level = share * np.max([_mean_of_runs(each.rate(*FINAL)[:, None], runs)
                                for each, runs in zip(rivals, of_rivals)], axis=0)
        return later(_minutes(slow, of_rivals[0], level), _minutes(quick, of_quick, level))

    return _resampled(statistic, quick, *rivals)


def later(slow, quick):
    """How much later one time is than another; 0 if neither is within the run."""
    neither = np.isinf(slow) & np.isinf(quick)
    return np.where(neither, 0.0, slow - np.where(neither, 0.0, quick))


def minutes_to_own_level(*results, share=0.9, of=lambda minutes: minutes):
    """The simulated minutes until the means of `Result`s reach `share` of their own final levels, as an `Estimate`.

    of: a function of the minutes of each, arrays of one shape, such as `later`. A level that is not positive is never
    reached.
    """
    def statistic(*chosen, axis):
        return of(*(_minutes(result, runs, share * _mean_of_runs(result.rate(*FINAL)[:, None], runs))
                    for result, runs in zip(results, chosen)))

    return _resampled(statistic, *results)


def _resampled(statistic, *results):
    """The `Time` of a statistic of the runs chosen from results, by bootstrap."""
    runs = [np.arange(result.runs) for result in results]
    value = statistic(*runs, axis=-1)
    if min(map(len, runs)) < FEWEST_RUNS:
        return Time(value, np.array([np.nan]))
    with np.errstate(invalid="ignore"):  # scipy's own interval, which is not used, has no room for infinite times
        found = scipy.stats.bootstrap(runs, statistic, n_resamples=RESAMPLES, vectorized=True, axis=-1,
                                      method="percentile", rng=np.random.default_rng(0))
    return Time(value, found.bootstrap_distribution)


def _minutes(result, chosen, level):
    """When the mean over the runs of each resample, chosen: int (…, runs), crosses a level: (…)."""
    rates = binned_rate(result, min(POINTS, result.rewards.shape[1]))
    means = _mean_of_runs(rates, chosen)
    curves = means.reshape(-1, means.shape[-1])
    monotone = np.array([scipy.optimize.isotonic_regression(curve).x for curve in curves]).reshape(means.shape)
    reached = (monotone >= level) & (np.asarray(level) > 0)
    middle = (reached.argmax(axis=-1) + 0.5) / means.shape[-1]
    return np.where(reached.any(axis=-1), middle, np.inf) * result.seconds / 60


def _mean_of_runs(rates, chosen):
    """The mean of rates (runs, points) over the runs of each resample, chosen: int (…, runs)."""
    runs = len(rates)
    counts = np.array([np.bincount(each, minlength=runs) for each in chosen.reshape(-1, runs)])
    return (counts @ rates / runs).reshape(*chosen.shape[:-1], -1)


def learning_minutes(*results, chance, of=lambda minutes: minutes):
    """The learning times of `Result`s, T · (1 − mean lead / final lead), in simulated minutes, as an `Estimate`.

    T: the length of the run. Leads are over the mean of chance, rewards per second (runs,). A mean that leads by more
    over the whole run than finally takes no time. of: as in `minutes_to_own_level`.
    """
    def statistic(*chosen, axis):
        base = _mean_of_runs(chance[:, None], chosen[-1])
        return of(*(minutes(result, runs, base)[..., 0] for result, runs in zip(results, chosen)))

    def minutes(result, runs, base):
        whole, final = (_mean_of_runs(result.rate(*share)[:, None], runs) - base for share in ((0.0, 1.0), FINAL))
        return np.maximum(1 - quotient(whole, final), 0) * result.seconds / 60

    return estimate(statistic, *(np.arange(result.runs) for result in results), np.arange(len(chance)))
