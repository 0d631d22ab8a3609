"""Times of things that take turns, and what they make: ratios, and exponents of growth.

What disturbs a measurement makes it longer, so the least of several repetitions is what a thing takes. Processor time
leaves out what other processes take of a core; it counts all threads, so what may use several is timed by the clock.
"""

from time import process_time

import numpy as np
from scipy import stats

from neorl.evidence.statistics import Estimate, estimate


def in_turns(preparations, rounds, clock=process_time):
    """How long each of several things takes, in seconds: {name: float64 (rounds,)}.

    preparations: {name: function without arguments}, whose result is the function that is timed; all in turn, once
    before the first round. clock: a function that returns seconds.
    """
    seconds = {name: np.empty(rounds) for name in preparations}
    for turn in range(-1, rounds):
        for name, prepare in preparations.items():
            timed = prepare()
            begin = clock()
            timed()
            if turn >= 0:
                seconds[name][turn] = clock() - begin
    return seconds


def again(run, steps):
    """What `in_turns` takes to time the coming steps of a `Run`, the same ones each time."""
    def prepare():
        copy = run.copy()
        return lambda: copy.advance(steps)

    return prepare


def always(function, *arguments):
    """What `in_turns` takes to time a call that needs no preparation."""
    return lambda: lambda: function(*arguments)


def times_as_long(one, other):
    """The least of some times as a multiple of the least of others, as an `Estimate` over repetitions."""
    return estimate(lambda a, b, axis: a.min(axis) / b.min(axis), one, other)


def exponent(xs, costs):
    """The p of costs ∝ x^p by least squares of the logarithms: an `Estimate`, with the interval of a straight line.

    xs: (points,), > 0. costs: (points,); those that disturbances have made 0 or less are left out, and of less than
    three there is no exponent: its value and bounds are NaN.
    """
    known = np.greater(costs, 0)
    if known.sum() < 3:
        return Estimate(np.nan, np.nan, np.nan)
    line = stats.linregress(np.log(xs[known]), np.log(costs[known]))
    half = stats.t.ppf(0.975, known.sum() - 2) * line.stderr
    return Estimate(line.slope, line.slope - half, line.slope + half)
