"""Times of programs that take turns, and what follows from them: ratios, and exponents of growth.

Disturbances only lengthen a measurement, so the least of several repetitions counts. Processor time leaves out what
other processes take of a core; it counts all threads, so programs that may use several are timed by the wall clock.
"""

from time import process_time

import numpy as np
from scipy import stats

from neorl.evidence.statistics import Estimate, estimate


def in_turns(preparations, rounds, clock=process_time):
    """Time several functions in turns, in seconds: {name: float64 (rounds,)}.

    preparations: {name: function without arguments}, which returns the function to time; all take a first round that
    does not count. clock: a function that returns seconds.
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
    """A preparation for `in_turns`, to time the coming steps of a `Run`, the same ones each time."""
    def prepare():
        copy = run.copy()
        return lambda: copy.advance(steps)

    return prepare


def always(function, *arguments):
    """A preparation for `in_turns`, to time a call that needs none."""
    return lambda: lambda: function(*arguments)


def times_as_long(one, other):
    """The least of one's times as a multiple of the least of the other's: an `Estimate` over repetitions."""
    return estimate(lambda a, b, axis: a.min(axis) / b.min(axis), one, other)


def exponent(xs, costs):
    """Exponent p of costs ∝ x^p by least squares on logarithms: an `Estimate`, with the interval of the line's slope.

    xs: (points,), > 0. costs: (points,); those that disturbances have made 0 or less are left out. With fewer than
    three, value and bounds are NaN.
    """
    known = np.greater(costs, 0)
    if known.sum() < 3:
        return Estimate(np.nan, np.nan, np.nan)
    line = stats.linregress(np.log(xs[known]), np.log(costs[known]))
    half = stats.t.ppf(0.975, known.sum() - 2) * line.stderr
    return Estimate(line.slope, line.slope - half, line.slope + half)
