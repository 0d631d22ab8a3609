"""Finished runs on disk, so that nothing is computed twice, and a killed process loses only seconds of work.

1. A result is a file under the key of its condition (`neorl.experiments.condition`), which `neorl.Result.load` reads,
   too. It is complete or absent, even if the process is killed, and carries digests of its content: a file that is
   damaged, or was not written by this version, counts as absent.
2. The runs of a long condition are written every few seconds, and the whole condition once it is complete; then the
   single runs are removed. A short condition is written only once, so it has no overhead.
3. If the disk cannot be written to, results stay in memory, with a warning.
4. The files are in the folder that the environment variable ``NEORL_CACHE`` names, or in the user's cache folder; all
   of them may be deleted at any time (`neorl.files`). Those whose folder and name follow neorl's scheme are listed and
   removed, and no others; a file of claims must also describe itself.
5. A file is *older* if it was not made by the present sources of neorl: conditions and claims record the digest of
   theirs, and any other file is older if it was written before the sources were.
"""

import json
import re
import time
import warnings
from pathlib import Path
from typing import NamedTuple

import numpy as np

from neorl import checks, files
from neorl.agents.agent import Agent
from neorl.agents.rules import CALIBRATED, GREEDY
from neorl.description import described
from neorl.experiments.condition import PARTS, source_digest
from neorl.experiments.result import Result, about, condition_of, fitting
from neorl.worlds.arena import Arena
from neorl.worlds.waterworld import WaterWorld

SECONDS = 5  # between two writes of a condition's runs; a write takes a hundredth of that
DIGEST = "[0-9a-f]{64}"
KINDS = {"conditions": ("finished conditions", DIGEST),
         "runs": ("single runs of conditions that are not finished", DIGEST + r"-\d+"),
         "compiled": ("compiled kernels", DIGEST), "wasm": ("WebAssembly modules", DIGEST),
         "claims": ("claims of pages of the book", r"[a-z0-9_]+\.json")}
WHICH = ("all", "compiled", "older")


def load(condition):
    """The `Result` of a condition if it is on disk, else None."""
    try:
        _, arrays = files.read_arrays(condition.path, "Result")
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
    files.write_arrays(condition.path, "Result", {"source": source_digest(), **known},
                       {"rewards": result.rewards, "hits": result.hits}, np.savez_compressed)


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


class Disk:
    """The cache folder, which may take no more; then it warns once."""

    def __init__(self):
        self._warned = False

    def takes(self, write, *what):
        """Whether a function could write to it."""
        try:
            write(*what)
        except OSError as error:
            if not self._warned:
                warnings.warn(f"{files.cache_folder()} takes no results ({error.strerror}): they stay in memory, and "
                              "are lost when this process ends", RuntimeWarning, stacklevel=2)
            self._warned = True
            return False
        return True


class Keeper:
    """The runs of a condition as they finish: on a `Disk`, or in memory if that takes no more or there is None.

    missing: the numbers of the runs that it lacked at first, a list, empty if it was complete.
    """

    def __init__(self, condition, disk):
        self.condition, self._disk, self._runs, self._whole = condition, disk, {}, None
        self._unwritten, self._written_at = [], None  # numbers of runs that are only in memory; seconds
        if disk and load(condition) is not None:
            disk.takes(remove_runs, condition)  # left by a process killed before it could do so
            self.missing = []
            return
        self._runs = load_runs(condition) if disk else {}
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
        if self._disk and self._unwritten and self._disk.takes(save_runs, self.condition,
                                                               {k: self._runs[k] for k in self._unwritten}):
            self._unwritten = []
        self._written_at = time.monotonic()

    def result(self):
        """The `Result` of a complete condition, or None if its file was removed in the meantime."""
        return self._whole or load(self.condition)

    def _finish_if_complete(self):
        if len(self._runs) < self.condition.runs:
            return False
        whole = Result(self.condition, *(np.stack([self._runs[k][part] for k in range(self.condition.runs)])
                                         for part in (0, 1)))
        if self._disk and self._disk.takes(save, whole):
            self._disk.takes(remove_runs, self.condition)
        else:
            if self._disk:
                _check_memory(whole.rewards.nbytes + whole.hits.nbytes)
            self._whole = whole
        self._runs, self._unwritten = {}, []
        return True


def _check_memory(size):
    """Raise MemoryError unless so many bytes of memory are free."""
    import psutil

    if psutil.virtual_memory().available < size:
        raise MemoryError(f"{files.cache_folder()} takes no results, and no more of them fit into the free memory; "
                          "name another folder in NEORL_CACHE")


class Kept(NamedTuple):
    """A file of neorl's. about: its record of a condition or of claims, or None."""

    kind: str
    path: Path
    size: int  # bytes
    about: dict | None
    is_older: bool


def kept():
    """All files that neorl keeps: a list of `Kept`."""
    found, sources = [], _sources_changed()
    for kind, (_, pattern) in KINDS.items():
        for path in sorted((files.cache_folder() / kind).glob("*")):
            if not re.fullmatch(pattern, path.name) or not path.is_file():
                continue
            try:
                about, status = NOTES[kind](path) if kind in NOTES else None, path.stat()
            except FileNotFoundError:  # removed by another process in the meantime
                continue
            if kind == "claims" and not about:
                continue
            is_older = (about or {}).get("source") != source_digest() if kind in NOTES else status.st_mtime < sources
            found.append(Kept(kind, path, status.st_size, about, is_older))
    return found


def conditions():
    """Every complete `Condition` on disk that was computed with the present source and can be restored: a list."""
    found = []
    for each in kept():
        if each.kind == "conditions" and each.about and not each.is_older:
            try:
                condition = condition_of(each.about)
                found += [condition] if condition.path == each.path else []  # else a kernel or a constant has changed
            except ValueError:  # a kernel that is not defined in a module
                continue
    return found


def clear(which="all"):
    """Remove files that neorl keeps: "all", "compiled" code (kernels and WebAssembly), or "older" files.

    which: one of these three. Raises ValueError for anything else, OSError without permission.
    Returns the list of `Kept` that were removed.
    """
    checks.one_of("which", which, WHICH)
    removed = [each for each in kept() if which == "all" or which == "older" and each.is_older
               or which == "compiled" and each.kind in ("compiled", "wasm")]
    for each in removed:
        each.path.unlink(missing_ok=True)
    return removed


def in_words(about):
    """A condition described in a line, from its plain data (`neorl.experiments.result.about`)."""
    changes = "".join(f", from step {step:,} on {_agent(agent)}" for step, agent in about["changes"])
    return (f"{_agent(about['agent'])} in {_world(about['world'])}{changes}, {about['steps']:,} steps, "
            f"{about['runs']} run{'s' * (about['runs'] != 1)}, seed {about['seed']}")


def _agent(data):
    if not isinstance(data, dict):
        return data
    nodes = " and ".join(f"{node['name']} {'+'.join(f'N{n}' for n in node['resolutions'])}" for node in data["nodes"])
    usual = {**described(CALIBRATED), **described(GREEDY), "own_cell": Agent.own_cell}
    return _departing(nodes, {**data["learning"], **data["policy"], "own_cell": data["own_cell"]}, usual)


def _world(data):
    if not isinstance(data, dict):
        return data
    chosen = {name: value for name, value in data.items() if name != "is"}
    usual = next((described(kind()) for kind in (WaterWorld, Arena) if kind.__name__ == data["is"]), {})
    return _departing(data["is"].rpartition(":")[2], chosen, usual)


def _departing(name, chosen, usual):
    """A name with its departures from the defaults, where these are known."""
    unusual = [f"{each} {_value(value)}" for each, value in chosen.items() if value != usual.get(each)]
    return f"{name} ({', '.join(unusual)})" if unusual else name


def _value(value):
    if isinstance(value, dict) and "kernel" in value:
        name = value["kernel"].rpartition(":")[2]
        return f"{name}({', '.join(map(str, value['of']))})" if "of" in value else name
    return str(value)


def _about_condition(path):
    """The record of a condition beside its arrays, or None if it is damaged."""
    try:
        with np.load(path) as file:
            about = json.loads(str(file["about"]))
        in_words(about)
        return about
    except FileNotFoundError:
        raise
    except Exception:  # whatever zip, NumPy and JSON raise
        return None


def _about_claims(path):
    try:
        about = json.loads(path.read_text(encoding="utf-8"))
    except ValueError:
        return None
    return about if isinstance(about, dict) and {"page", "source", "claims"} <= about.keys() else None


NOTES = {"conditions": _about_condition, "claims": _about_claims}


def _sources_changed():
    """When the sources that take part in a run were last written."""
    package = Path(files.__file__).parent
    return max(path.stat().st_mtime for part in PARTS
               for path in [*package.glob(f"{part}.py"), *(package / part).rglob("*.py")])
