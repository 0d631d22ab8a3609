"""The free memory and the cores of this process: those of its container or its pool, where the machine has more.

A container limits its processes by Linux's control groups, of version 1 or 2; groups are nested, and the tightest limit
counts. `psutil`, the affinity and Python's own counts are those of the machine. Memory in use does not count while it
is a cache of files that the kernel would give up first (`inactive_file`).
"""

import math
import os
import re
from collections.abc import Iterator
from pathlib import Path, PurePosixPath

GROUPS, OWN = "/sys/fs/cgroup", "/proc/self/cgroup"  # where Linux describes its control groups


def free_memory(groups: str | Path = GROUPS, own: str | Path = OWN) -> int:
    """Bytes of memory that this process may still use. groups, own: where Linux describes its control groups."""
    import psutil

    free = [psutil.virtual_memory().available]
    for group in _groups("memory", Path(groups), Path(own)):
        cached = dict(re.findall(r"^(\w+) (\d+)$", _read(group / "memory.stat"), re.MULTILINE))
        for limits, usage, cache in ((("memory.max", "memory.high"), "memory.current", "inactive_file"),
                                     (("memory.limit_in_bytes",), "memory.usage_in_bytes", "total_inactive_file")):
            used = (_number(_read(group / usage)) or 0) - int(cached.get(cache, 0))
            free += [limit - used for name in limits if (limit := _number(_read(group / name))) is not None]
    return max(0, min(free))


def usable_bytes(needed: int, what: str, remedy: str) -> float:
    """Nine tenths of the free memory, in bytes. Raises MemoryError if what needs `needed` bytes does not fit."""
    free = free_memory()
    if needed > 0.9 * free:
        raise MemoryError(f"{what} {min(needed, 10**30) / 2**30:.1f} GiB of memory, but {free / 2**30:.1f} are free; "
                          f"{remedy}")
    return 0.9 * free


def cores(groups: str | Path = GROUPS, own: str | Path = OWN) -> int:
    """The number of cores on which this process may run, ≥ 1; a part of a core counts as one. groups, own: as above.

    ``NUMBA_NUM_THREADS`` in the environment limits them, too: so joblib and Dask share a machine among their workers.
    """
    usable = [len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1]
    for group in _groups("cpu", Path(groups), Path(own)):
        limit = _read(group / "cpu.max") or f"{_read(group / 'cpu.cfs_quota_us')} {_read(group / 'cpu.cfs_period_us')}"
        quota, period = map(_number, limit.partition(" ")[::2])
        if quota and period:
            usable.append(math.ceil(quota / period))
    return min(usable + [threads for threads in [_number(os.environ.get("NUMBA_NUM_THREADS", ""))] if threads])


def _groups(controller: str, groups: Path, own: Path) -> Iterator[Path]:
    """The folders of the groups of this process that may limit what a controller is for.

    A container may see its own group as the root, under another path than `own` says: folders may be absent.
    """
    for controllers, path in re.findall(r"^\d+:(.*?):(/.*)$", _read(own), re.MULTILINE):
        if not controllers or controller in controllers.split(","):
            group = PurePosixPath(path).relative_to("/")
            yield from (groups / controller / each if controllers else groups / each
                        for each in (group, *group.parents))


def _read(path: Path) -> str:
    try:
        return path.read_text().strip()
    except (OSError, ValueError):
        return ""


def _number(text: str) -> int | None:
    """A number ≥ 0, or None for what stands for no limit: "max", −1, or no file."""
    return int(text) if text.isdigit() else None
