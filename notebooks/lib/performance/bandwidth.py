"""How many bytes per second the machine moves, by the size of the *working set*.

Bytes are moved in two ways: from one array to another in order (as in STREAM's copy), or one value in each line of
memory, in random order. Memory moves in lines of 64 bytes, and bytes read and bytes written both count.
"""

from typing import NamedTuple

import numpy as np

from lib.performance.timing import always, in_turns
from neorl.core.kernel import array, execute, kernel

LINE = 64  # bytes
SMALLEST, LARGEST = 2**14, 2**28  # bytes
A_TIME = 2**25  # bytes moved in one measurement, at least


class Bandwidths(NamedTuple):
    """Bytes per second by working set."""

    working_sets: np.ndarray  # bytes: float64 (sizes,)
    copied: np.ndarray  # in order: float64 (sizes,)
    scattered: np.ndarray  # one value in each line, in random order; whole lines count

    def at(self, working_set):
        """Bytes per second of copying a working set, interpolated over the logarithm of its size."""
        return np.interp(np.log(working_set), np.log(self.working_sets), self.copied)


def measure(rounds, largest=LARGEST, seed=0):
    """Measure the `Bandwidths` of this machine. largest: working set in bytes, at least `SMALLEST`."""
    working_sets = SMALLEST * 2.0 ** np.arange(1 + int(np.log2(largest / SMALLEST)))
    rng, found = np.random.default_rng(seed), {"copied": [], "scattered": []}
    for working_set in working_sets:
        values = np.ones(int(working_set) // 4, np.float32)
        source, target = np.split(values, 2)
        order = rng.permutation(int(working_set) // LINE)
        times = max(1, round(A_TIME / working_set))
        seconds = in_turns({"copied": always(execute, copy, source, target, times),
                            "scattered": always(execute, scatter, values, order, times)}, rounds)
        found["copied"].append(times * working_set / seconds["copied"].min())
        found["scattered"].append(times * 2 * working_set / seconds["scattered"].min())
    return Bandwidths(working_sets, *map(np.array, found.values()))


@kernel
def copy(source: array("float32", "values"), target: array("float32", "values"), times: int) -> None:
    """Copy an array ``times`` times."""
    for _ in range(times):
        for i in range(source.shape[0]):
            target[i] = source[i]


@kernel
def scatter(values: array("float32", "values"), order: array("int64", "lines"), times: int) -> None:
    """Change one value in each line of memory, ``times`` times."""
    for _ in range(times):
        for i in range(order.shape[0]):
            values[np.uint64(LINE // 4 * order[i])] += np.float32(1.0)
