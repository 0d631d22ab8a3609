"""Finished runs on disk, so that nothing is computed twice, and a killed process loses only seconds of work.

1. A result is a file under the key of its condition (`neorl.experiments.condition`), which `neorl.Result.load` reads,
   too. It is complete or absent, even if the process is killed, and carries digests of its content: a file that is
   damaged, or was not written by this version, counts as absent.
2. The runs of a long condition are written every few seconds, and the whole condition once it is complete; then the
   single runs are removed. A short condition is written only once, so it has no overhead.
3. If the disk cannot be written to, results stay in memory, with a warning; so they do where there is no cache folder,
   and where neorl has no source that could tell its versions apart (`neorl.core.identity.can_cache`).
4. Files in the cache folder (`neorl.files`) whose folder and name follow neorl's scheme are listed and removed, and no
   others; a file of claims must also describe itself.
"""

import contextlib
import json
import re
import time
from pathlib import Path
from typing import NamedTuple

import numpy as np

from neorl import files
from neorl.agents.memory import usable_bytes
from neorl.experiments.result import Result, about, fitting
from neorl.warn import warn

SECONDS = 5  # between two writes of a condition's runs; a write takes a hundredth of that
DIGEST = "[0-9a-f]{64}"
KINDS = {"conditions": ("finished conditions", DIGEST),
         "runs": ("single runs of conditions that are not finished", DIGEST + r"-\d+"),
         "compiled": ("compiled kernels", DIGEST), "wasm": ("WebAssembly modules", DIGEST),
         "claims": ("claims of pages of the book", r"[a-z0-9_]+\.json")}
MARK = b'"claims":'  # in files of claims, whose names are not neorl's alone


def load(condition, path=None):
    """The `Result` of a condition if it is on disk, else None. path: where it was kept."""
    try:
        _, arrays = files.read_arrays(path or condition.path, "Result")
        return Result(condition, *fitting(arrays, condition, condition.runs))
    except (OSError, ValueError):  # absent, damaged, or of another version
        return None


def save(result):
    """Write a `Result` to disk. Raises OSError if there is no room or no permission."""
    condition = result.condition
    try:
        known = about(condition)
    except ValueError:  # its agent or world cannot be imported by name, but it was run, and is cached
        known = json.loads(json.dumps(condition.choices, default=repr))
    files.write_arrays(condition.path, "Result", known, {"rewards": result.rewards, "hits": result.hits},
                       np.savez_compressed)


def load_runs(condition):
    """The runs of an unfinished condition that are on disk: {run: (rewards, hits)}."""
    found = {}
    for path in _parts(condition):
        try:
            _, arrays = files.read_arrays(path, "runs")
            numbers = arrays["runs"].tolist()
            found |= zip(numbers, zip(*fitting(arrays, condition, len(numbers))))
        except (OSError, ValueError):
            continue
    return found


def save_runs(condition, runs):
    """Write some runs of a condition to a file of their own. Raises OSError if there is no room or no permission."""
    rewards, hits = map(np.stack, zip(*runs.values()))
    files.write_arrays(_part_folder() / f"{condition.key}-{min(runs)}", "runs", {},
                       {"runs": np.array(list(runs)), "rewards": rewards, "hits": hits})


def remove_runs(condition):
    """Remove the single runs of a condition from disk, once the whole condition is there."""
    for path in _parts(condition):
        path.unlink(missing_ok=True)


def _part_folder():
    return files.cache_folder() / "runs"


def _parts(condition):
    return list(_part_folder().glob(f"{condition.key}-*"))


def _taken(write, *what):
    """Whether the cache folder could take what a function writes; otherwise it warns."""
    try:
        write(*what)
    except OSError as error:
        warn(f"{files.cache_folder()} takes no results ({error.strerror}): they stay in memory, and are lost when this "
             "process ends")
        return False
    return True


class Keeper:
    """The runs of a condition as they finish: on disk if `cache`, or in memory, also if the disk takes no more.

    missing: the numbers of the runs that it lacked at first, a list, empty if it was complete.
    """

    def __init__(self, condition, cache):
        self.condition, self._cache, self._runs, self._whole = condition, cache, {}, None
        self._path = condition.path if cache else None  # of the constants and rules as they are now
        self._unwritten, self._written_at = [], None  # numbers of runs that are only in memory; seconds
        if cache and load(condition) is not None:
            _taken(remove_runs, condition)  # left by a process killed before it could do so
            self.missing = []
            return
        self._runs = load_runs(condition) if cache else {}
        self.missing = [k for k in range(condition.runs) if k not in self._runs]
        self._finish_if_complete()

    def add(self, numbers, rewards, hits):
        """Add missing runs by number: rewards float32 (runs, bins), hits int16 (runs, bins, kinds).

        Raises MemoryError if a complete condition fits neither on the disk nor into memory.
        """
        self._runs |= zip(numbers, zip(rewards, hits))
        self._unwritten += numbers
        now = time.monotonic()
        self._written_at = self._written_at or now
        if not self._finish_if_complete() and now - self._written_at > SECONDS:
            self.write_runs()

    def write_runs(self):
        """Write the runs of an incomplete condition."""
        if self._cache and self._unwritten and _taken(save_runs, self.condition,
                                                      {k: self._runs[k] for k in self._unwritten}):
            self._unwritten = []
        self._written_at = time.monotonic()

    def result(self):
        """The `Result` of a complete condition, or None if its file was removed in the meantime."""
        return self._whole or load(self.condition, self._path)

    def _finish_if_complete(self):
        if len(self._runs) < self.condition.runs:
            return False
        whole = Result(self.condition, *(np.stack([self._runs[k][part] for k in range(self.condition.runs)])
                                         for part in (0, 1)))
        if self._cache and _taken(save, whole):
            _taken(remove_runs, self.condition)
        else:
            if self._cache:
                usable_bytes(whole.rewards.nbytes + whole.hits.nbytes,
                             f"{files.cache_folder()} takes no results, and these need",
                             "name another folder in NEORL_CACHE")
            self._whole = whole
        self._runs, self._unwritten = {}, []
        return True


class Kept(NamedTuple):
    """A file of neorl's."""

    kind: str
    path: Path
    size: int  # bytes


def kept():
    """All files that neorl keeps: a list of `Kept`."""
    found = []
    for kind, (_, pattern) in KINDS.items():
        for path in sorted((files.cache_folder() / kind).glob("*")):
            with contextlib.suppress(FileNotFoundError):  # removed by another process in the meantime
                if (re.fullmatch(pattern, path.name) and path.is_file()
                        and (kind != "claims" or MARK in path.read_bytes())):
                    found.append(Kept(kind, path, path.stat().st_size))
    return found


def clear():
    """Remove all files that neorl keeps, and return the list of `Kept`. Raises OSError without permission."""
    removed = kept()
    for each in removed:
        each.path.unlink(missing_ok=True)
    return removed
