"""Runs as they come in, kept so that a process that is killed loses seconds.

1. The runs of a condition that takes long are written to disk every few seconds, and all of it when it is whole; then
   the single runs are removed. A condition that takes less time is written once, so that it costs no more.
2. A disk that takes nothing costs a warning: what could not be written stays in memory.
"""

import time
import warnings

import numpy as np

from neorl import files
from neorl.experiments import cache
from neorl.experiments.simulation import Result

SECONDS = 5  # between two writes of a condition's runs, which take a hundredth of that


class Keeper:
    """What has been lived of conditions: on disk, or in memory if the disk takes nothing."""

    def __init__(self):
        self._lived = {}  # {condition: {run: (rewards, hits)}}, of conditions that are not whole
        self._unwritten = {}  # {condition: [run, ...]}, those of these that are only in memory
        self._written_at = {}  # {condition: seconds}
        self._whole = {}  # {condition: `Result`}, what could not be written
        self._warned = False

    def missing(self, condition):
        """The numbers of the runs that a condition lacks: a list, empty if it is whole."""
        if cache.load(condition) is not None:
            self._written(cache.remove_runs, condition)  # of a process that was killed before it could
            return []
        lived = self._lived[condition] = cache.load_runs(condition)
        if len(lived) == condition.runs:
            self._finish(condition)
        return [k for k in range(condition.runs) if k not in lived]

    def add(self, condition, runs, rewards, hits):
        """Take the runs of these numbers, which the condition lacked: float32 (runs, bins), int16 (runs, bins, kinds).

        Raises MemoryError if a whole condition fits neither on the disk nor into memory.
        """
        lived, now = self._lived[condition], time.monotonic()
        lived |= zip(runs, zip(rewards, hits))
        self._unwritten.setdefault(condition, []).extend(runs)
        if len(lived) == condition.runs:
            self._finish(condition)
        elif now - self._written_at.setdefault(condition, now) > SECONDS:
            self._write_runs(condition)

    def write_runs(self):
        """Write what there is of conditions that are not whole."""
        for condition in list(self._unwritten):
            self._write_runs(condition)

    def result(self, condition):
        """The `Result` of a whole condition, or None."""
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
    """Raise MemoryError unless as much is free as what cannot be written takes."""
    import psutil

    if psutil.virtual_memory().available < size:
        raise MemoryError(f"{files.cache_folder()} takes no results, and no more of them fit into the free memory")
