"""Rates of exponential growth, from fits to logarithms (thesis sections 3.2 and 3.4)."""

import numpy as np
from scipy import stats

from neorl.evidence.statistics import Estimate, estimate


def growth_factor(xs, needed):
    """The factor by which ``needed`` grows with each step of x, from the second on: the mean over runs, an `Estimate`.

    xs: int64 (points,), two or more, from 1 on. needed: (runs, points), each > 0. If there are two points, both count.
    """
    late = xs >= min(2, xs[-1] - 1)
    slopes, _ = np.polyfit(xs[late], np.log(needed[:, late]).T, 1)
    return estimate(np.mean, np.exp(slopes))


def fit_trend(years, counts):
    """The exponential trend of counts: a `scipy.stats.linregress` of their base-2 logarithms, and the fitted counts.

    years, counts: (n,) each, n ≥ 3.
    """
    trend = stats.linregress(years, np.log2(counts))
    return trend, 2 ** (trend.intercept + trend.slope * years)


def doubling_time(trend, points):
    """The increase of x over which counts double: an `Estimate`, with the interval of a line through logarithms.

    trend: of `scipy.stats.linregress`, from x to base-2 logarithms. points: the number fitted, ≥ 3.
    """
    half = stats.t.ppf(0.975, points - 2) * trend.stderr
    return Estimate(1 / trend.slope, 1 / (trend.slope + half), 1 / (trend.slope - half))


def draws_of_all(n):
    """The approximate number of draws until each of n equally likely things has been drawn: n ln n."""
    return n * np.log(n)
