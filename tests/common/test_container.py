"""The memory and the cores of a container count, where the machine has more."""

import subprocess
import sys
from pathlib import Path

import psutil
import pytest

from neorl.common.container import cores, free_memory

MOST = psutil.virtual_memory().total
MEMORY = Path("/sys/fs/cgroup/memory")
V1 = {"memory/memory.limit_in_bytes": "9223372036854771712", "memory/box/memory.limit_in_bytes": "5000000",
      "memory/box/memory.usage_in_bytes": "3000000", "memory/box/memory.stat": "cache 9\ntotal_inactive_file 1000000"}
CASES = {  # the files of control groups, those of this process, free bytes, cores
    "none": ({}, "", None, None),
    "no limits": ({"memory.max": "max", "cpu.max": "max 100000", "memory.current": "7"}, "0::/\n", None, None),
    "version 2": ({"memory.max": "5000000", "memory.current": "3000000", "memory.stat": "anon 5\ninactive_file 500000",
                   "cpu.max": "50000 100000"}, "0::/\n", 2_500_000, 1),
    "a slower limit": ({"memory.max": "5000000", "memory.high": "4000000", "memory.current": "3000000"}, "0::/\n",
                       1_000_000, None),
    "nested groups": ({"a/memory.max": "5000000", "a/memory.current": "4000000", "a/b/memory.max": "9000000",
                       "a/b/memory.current": "1000000", "a/cpu.max": "100000 100000", "a/b/cpu.max": "max 100000"},
                      "0::/a/b\n", 1_000_000, 1),
    "more used than allowed": ({"memory.max": "5000000", "memory.current": "6000000"}, "0::/\n", 0, None),
    "version 1": (V1, "4:memory:/box\n1:cpu:/\n", 3_000_000, None),
    "version 1, a container's own view": ({each.replace("/box", ""): content for each, content in V1.items()},
                                          "4:memory:/docker/0f\n", 3_000_000, None),
    "version 1, a quota": ({"cpu/box/cpu.cfs_quota_us": "90000", "cpu/box/cpu.cfs_period_us": "100000",
                            "cpu/cpu.cfs_quota_us": "-1", "cpu/cpu.cfs_period_us": "100000"},
                           "1:cpu,cpuacct:/box\n", None, 1),
    "a root beyond its view": ({"memory.max": "5000000"}, "0::/../..\n", 5_000_000, None),
    "nonsense": ({"memory.max": "?", "cpu.max": "0 0", "memory.stat": "a\nb c d"}, "what\n0::/\n", None, None)}


@pytest.mark.parametrize("contents, own, free, usable", CASES.values(), ids=CASES)
def test_limits_of_control_groups_are_limits(tmp_path, monkeypatch, contents, own, free, usable):
    monkeypatch.delenv("NUMBA_NUM_THREADS", raising=False)
    monkeypatch.setattr("psutil.virtual_memory", lambda: type("Memory", (), {"available": 10**8}))
    monkeypatch.setattr("os.sched_getaffinity", lambda _: {0, 1, 2}, raising=False)
    for name, content in contents.items():
        path = tmp_path / "groups" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(content)
    (tmp_path / "own").write_text(own)
    where = tmp_path / "groups", tmp_path / "own"
    assert (free_memory(*where), cores(*where)) == (10**8 if free is None else free, usable or 3)


@pytest.mark.parametrize("threads, usable", [("1", 1), ("2", 2), ("64", 3), ("0", 3), ("many", 3)])
def test_the_threads_that_a_pool_leaves_to_its_worker_are_a_limit(tmp_path, monkeypatch, threads, usable):
    monkeypatch.setattr("os.sched_getaffinity", lambda _: {0, 1, 2}, raising=False)
    monkeypatch.setenv("NUMBA_NUM_THREADS", threads)
    assert cores(tmp_path, tmp_path / "own") == usable


@pytest.fixture
def group():
    """A real control group of 500 MiB."""
    folder = MEMORY / "neorl-test"
    try:
        folder.mkdir()
        (folder / "memory.limit_in_bytes").write_text(str(500 * 2**20))
    except OSError:
        pytest.skip("no permission to make a control group of memory, version 1")
    yield folder
    folder.rmdir()


def test_runs_that_do_not_fit_into_a_container_together_run_in_turn(group):
    """Side by side, they were killed."""
    work = ("import os, sys\nopen(sys.argv[1], 'w').write(str(os.getpid()))\n"
            "from neorl import WaterWorld, place_cells, simulate\nfrom neorl.common.container import free_memory\n"
            "assert free_memory() < 500 * 2**20\n"
            "simulate(place_cells([60]), WaterWorld(), steps=50_000, runs=2, progress=False)\n")
    assert subprocess.run([sys.executable, "-c", work, group / "cgroup.procs"]).returncode == 0
