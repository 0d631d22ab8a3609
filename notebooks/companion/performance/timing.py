"""Times of programs that take turns, what follows from them, and how many bytes per second the machine moves.

1. Disturbances only lengthen a measurement, so the least of several repetitions counts. Processor time leaves out what
   other processes take of a core; it counts all threads, so programs that may use several are timed by the wall clock.
2. Bytes are moved from one array to another, as in STREAM's copy; bytes read and bytes written both count.
"""

from time import process_time
from typing import NamedTuple

import numpy as np
from scipy import stats

from neorl import kernel
from neorl.custom import array, execute
from neorl.statistics import Estimate

SMALLEST, LARGEST = 2**14, 2**28  # bytes
A_TIME = 2**25  # bytes moved in one measurement, at least


def in_turns(preparations, rounds, clock=process_time):
    """Time several functions in turns, in seconds: {name: float64 (rounds,)}.

    preparations: {name: function that returns the one to time}. A first round does not count.
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


def always(function, *arguments, **options):
    """A preparation for `in_turns`, to time a call that needs none."""
    return lambda: lambda: function(*arguments, **options)


def exponent(xs, costs):
    """Exponent p of costs ∝ x^p by least squares on logarithms: an `Estimate`, with the interval of the line's slope.

    Costs that disturbances have made 0 or less are left out; with fewer than three others, all is NaN.
    """
    known = np.greater(costs, 0)
    if known.sum() < 3:
        return Estimate(np.nan, np.nan, np.nan)
    line = stats.linregress(np.log(xs[known]), np.log(costs[known]))
    half = stats.t.ppf(0.975, known.sum() - 2) * line.stderr
    return Estimate(line.slope, line.slope - half, line.slope + half)


class Bandwidths(NamedTuple):
    """Bytes per second by working set."""

    working_sets: np.ndarray  # bytes: float64 (sizes,)
    copied: np.ndarray  # float64 (sizes,)

    def at(self, working_set):
        """Bytes per second of copying a working set, interpolated over the logarithm of its size."""
        return np.interp(np.log(working_set), np.log(self.working_sets), self.copied)


def bandwidths(rounds):
    """Measure the `Bandwidths` of this machine."""
    working_sets = SMALLEST * 2.0 ** np.arange(1 + int(np.log2(LARGEST / SMALLEST)))
    copied = []
    for working_set in working_sets:
        source, target = np.split(np.ones(int(working_set) // 4, np.float32), 2)
        times = max(1, round(A_TIME / working_set))
        (seconds,) = in_turns({"copy": always(execute, copy, source, target, times)}, rounds).values()
        copied.append(times * working_set / seconds.min())
    return Bandwidths(working_sets, np.array(copied))


@kernel
def copy(source: array("float32", "values"), target: array("float32", "values"), times: int) -> None:
    """Copy an array ``times`` times."""
    for _ in range(times):
        for i in range(source.shape[0]):
            target[i] = source[i]
