"""Finished runs on disk, so that nothing is computed twice, and a killed process loses only seconds of work.

1. A file has some runs of a condition, under its key (`neorl.experiments.condition`). It is complete or absent, even if
   the process is killed, and carries digests of its content: a file that is damaged, or was not written by this
   version, counts as absent.
2. The runs of a long condition are written every few seconds, those of a short one once, so it has no overhead.
3. If the disk cannot be written to, results stay in memory, with a warning; so they do where there is no cache folder,
   and where neorl has no source that could tell its versions apart (`neorl.kernels.identity.can_cache`).
4. Files in the cache folder (`neorl.common.files`) whose folder and name follow neorl's scheme are listed and removed,
   and no others; a file of claims must also describe itself.
"""

import contextlib
import hashlib
import json
import re
import time
from pathlib import Path
from typing import NamedTuple

import numpy as np

from neorl.common import files
from neorl.common.array_files import open_arrays, write_arrays
from neorl.common.container import usable_bytes
from neorl.common.warn import warn
from neorl.experiments.bins import bin_shapes
from neorl.experiments.result import Result, about

SECONDS = 5  # between two writes of a condition's runs; a write takes a hundredth of that
DIGEST = "[0-9a-f]{64}"
KINDS = {"runs": ("finished runs of conditions", DIGEST + "-[0-9a-f]{16}"),
         "compiled": ("compiled kernels", r"\w+-[0-9a-f]{32}"), "wasm": ("WebAssembly modules", DIGEST),
         "claims": ("claims of pages of the book", r"[a-z0-9_]+\.json")}
MARK = b'"claims":'  # in files of claims, whose names are not neorl's alone


def load(condition, key=None):
    """The `Result` of a condition if all its runs are on disk, else None. key: of the condition when it was kept."""
    runs = load_runs(condition, key)
    return _whole(condition, runs) if len(runs) == condition.runs else None


def load_runs(condition, key=None):
    """The runs of a condition that are on disk: {run: (rewards, hits)}. key: of the condition when it was kept."""
    found = {}
    for path in _folder().glob(f"{key or condition.key}-*"):
        try:
            with open_arrays(path, "runs") as file:
                numbers = file.shapes["runs"]
                arrays = file.read({"runs": numbers} | bin_shapes(condition.world, *numbers[1], condition.steps))
            found |= zip(arrays["runs"].tolist(), zip(arrays["rewards"], arrays["hits"]))
        except (OSError, ValueError, LookupError, TypeError):  # absent, damaged, or of another version
            continue
    return found


def save_runs(condition, runs, key=None):
    """Write runs of a condition, as `load_runs` returns them. Raises OSError if there is no space or no permission."""
    try:
        known = about(condition)
    except ValueError:  # its agent or world cannot be imported by name, but it was run, and is cached
        known = json.loads(json.dumps(condition.choices, default=repr))
    numbers, (rewards, hits) = np.array(list(runs)), map(np.stack, zip(*runs.values()))
    name = f"{key or condition.key}-{hashlib.sha256(numbers.tobytes()).hexdigest()[:16]}"
    write_arrays(_folder() / name, "runs", known, {"runs": numbers, "rewards": rewards, "hits": hits},
                 np.savez_compressed)


def _folder():
    return files.cache_folder() / "runs"


def _whole(condition, runs):
    return Result(condition, *(np.stack([runs[k][part] for k in range(condition.runs)]) for part in (0, 1)))


def _taken(write, *what):
    """Whether the cache folder could take what a function writes; otherwise it warns."""
    try:
        write(*what)
    except OSError as error:
        warn(f"{files.cache_folder()} takes no results ({error.strerror or error}): they stay in memory, and are lost "
             "when this process ends")
        return False
    return True


class Keeper:
    """The runs of a condition as they finish: on disk if `cache`, or in memory, also if the disk takes no more.

    missing: the numbers of the runs that it lacked at first, a list, empty if it was complete.
    """

    def __init__(self, condition, cache):
        self.condition, self._runs, self._written_at = condition, {}, None  # runs in memory alone; seconds
        self._key = condition.key if cache else None  # with the constants and rules as they are now
        known = load_runs(condition, self._key) if cache else ()
        self.missing = [k for k in range(condition.runs) if k not in known]
        self._left = len(self.missing)

    def add(self, numbers, rewards, hits):
        """Add missing runs by number: rewards float32 (runs, bins), hits int16 (runs, bins, kinds).

        Raises MemoryError if a complete condition fits neither on the disk nor into memory.
        """
        self._runs |= zip(numbers, zip(rewards, hits))
        self._left -= len(numbers)
        now = time.monotonic()
        self._written_at = self._written_at or now
        if self._left == 0 or now - self._written_at > SECONDS:
            self.write_runs()

    def write_runs(self):
        """Write the runs that are in memory alone."""
        if self._key and self._runs:
            if _taken(save_runs, self.condition, self._runs, self._key):
                self._runs = {}
            elif self._left == 0:
                usable_bytes(sum(rewards.nbytes + hits.nbytes for rewards, hits in self._runs.values()),
                             f"{files.cache_folder()} takes no results, and these need",
                             "name another folder in NEORL_CACHE")
        self._written_at = time.monotonic()

    def result(self):
        """The `Result` of a complete condition, or None if files of it were removed in the meantime."""
        runs = (load_runs(self.condition, self._key) if self._key else {}) | self._runs
        return _whole(self.condition, runs) if len(runs) == self.condition.runs else None


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
