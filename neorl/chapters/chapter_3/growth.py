"""How fast things grow that grow exponentially: by fits to their logarithms (thesis sections 3.2 and 3.4)."""

import numpy as np
from scipy import stats

from neorl.evidence.statistics import Estimate, estimate


def growth_factor(xs, needed):
    """By what factor runs need more with each step of x, from the second on: the mean over runs as an `Estimate`.

    xs: int64 (points,), two or more from 1 on. needed: (runs, points), each > 0. If there are two points, both count.
    """
    late = xs >= min(2, xs[-1] - 1)
    slopes, _ = np.polyfit(xs[late], np.log(needed[:, late]).T, 1)
    return estimate(np.mean, np.exp(slopes))


def fit_trend(years, counts):
    """The exponential trend of counts: a `scipy.stats.linregress` of their base 2 logarithms, and the fitted counts.

    years, counts: (n,) each, n ≥ 3.
    """
    trend = stats.linregress(years, np.log2(counts))
    return trend, 2 ** (trend.intercept + trend.slope * years)


def doubling_time(trend, points):
    """In how much of x something doubles: an `Estimate`, with the interval of a straight line through logarithms.

    trend: of `scipy.stats.linregress`, from x to logarithms of base 2. points: how many it was fitted to, ≥ 3.
    """
    half = stats.t.ppf(0.975, points - 2) * trend.stderr
    return Estimate(1 / trend.slope, 1 / (trend.slope + half), 1 / (trend.slope - half))


def draws_of_all(n):
    """About how many draws it takes to draw each of n things at least once, if all are equally likely: n ln n."""
    return n * np.log(n)
