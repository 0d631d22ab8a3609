"""Storage of runs as they finish, so that a killed process loses only seconds of work.

1. The runs of a long condition are written to disk every few seconds, and the whole condition once it is complete; then
   the single runs are removed. A short condition is written only once, so it has no overhead.
2. If the disk cannot be written to, results stay in memory, with a warning.
"""

import time
import warnings

import numpy as np

from neorl import files
from neorl.experiments import cache
from neorl.experiments.simulation import Result

SECONDS = 5  # between two writes of a condition's runs; a write takes a hundredth of that


class Keeper:
    """The finished runs of conditions: on disk, or in memory if the disk cannot be written to."""

    def __init__(self):
        self._lived = {}  # {condition: {run: (rewards, hits)}}, of incomplete conditions
        self._unwritten = {}  # {condition: [run, ...]}, the runs that are only in memory
        self._written_at = {}  # {condition: seconds}
        self._whole = {}  # {condition: `Result`}, complete but not written to disk
        self._warned = False

    def missing(self, condition):
        """The numbers of the runs that a condition lacks: a list, empty if it is complete."""
        if cache.load(condition) is not None:
            self._written(cache.remove_runs, condition)  # left by a process killed before it could do so
            return []
        lived = self._lived[condition] = cache.load_runs(condition)
        if len(lived) == condition.runs:
            self._finish(condition)
        return [k for k in range(condition.runs) if k not in lived]

    def add(self, condition, runs, rewards, hits):
        """Add missing runs of a condition, by number: rewards float32 (runs, bins), hits int16 (runs, bins, kinds).

        Raises MemoryError if a complete condition fits neither on the disk nor into memory.
        """
        lived, now = self._lived[condition], time.monotonic()
        lived |= zip(runs, zip(rewards, hits))
        self._unwritten.setdefault(condition, []).extend(runs)
        if len(lived) == condition.runs:
            self._finish(condition)
        elif now - self._written_at.setdefault(condition, now) > SECONDS:
            self._write_runs(condition)

    def write_runs(self):
        """Write the runs of all incomplete conditions."""
        for condition in list(self._unwritten):
            self._write_runs(condition)

    def result(self, condition):
        """The `Result` of a complete condition, or None."""
        return self._whole.get(condition) or cache.load(condition)

    def _finish(self, condition):
        lived = self._lived[condition]
        rewards, hits = (np.stack([lived[k][part] for k in range(condition.runs)]) for part in (0, 1))
        result = Result(**condition.choices, rewards=rewards, hits=hits)
        if self._written(cache.save, condition, result):
            self._written(cache.remove_runs, condition)
        else:
            _check_memory(rewards.nbytes + hits.nbytes)
            self._whole[condition] = result
        for each in (self._lived, self._unwritten, self._written_at):
            each.pop(condition, None)

    def _write_runs(self, condition):
        lived = self._lived[condition]
        if self._written(cache.save_runs, condition, {k: lived[k] for k in self._unwritten[condition]}):
            del self._unwritten[condition]
        self._written_at[condition] = time.monotonic()

    def _written(self, write, *what):
        try:
            write(*what)
        except OSError as error:
            if not self._warned:
                warnings.warn(f"{files.cache_folder()} takes no results ({error.strerror}): they stay in memory, and "
                              "are lost when this process ends", RuntimeWarning, stacklevel=2)
            self._warned = True
            return False
        return True


def _check_memory(size):
    """Raise MemoryError unless so many bytes of memory are free."""
    import psutil

    if psutil.virtual_memory().available < size:
        raise MemoryError(f"{files.cache_folder()} takes no results, and no more of them fit into the free memory; "
                          "name another folder in NEORL_CACHE")
