"""Finished runs are kept, despite kills, interruptions, full disks, unwritable folders, and foreign files."""

import os
import signal
import stat
import subprocess
import sys
import time

import numpy as np
import pytest

from neorl import Condition, WaterWorld, files, place_cells, simulate, simulate_once, sweep
from neorl.experiments import cache, keeping, sweeping

LONG = Condition(place_cells([3]), WaterWorld(), sweeping.TASK_STEPS, 6)
SHORT = Condition(place_cells([3]), WaterWorld(), 500, 3)
pytestmark = pytest.mark.usefixtures("cache_folder")


@pytest.fixture
def at_once(monkeypatch):
    """Write runs as soon as they are finished."""
    monkeypatch.setattr(keeping, "SECONDS", -1)


@pytest.fixture
def lived(monkeypatch):
    """The numbers of the runs that were computed."""
    runs, original = [], sweeping._live
    monkeypatch.setattr(sweeping, "_live", lambda *task: runs.extend(task[1]) or original(*task))
    return runs


def once(condition):
    return simulate_once(**condition.choices, progress=False)


def assert_whole(result, condition):
    alone = simulate(**condition.choices, progress=False)
    np.testing.assert_array_equal(result.rewards, alone.rewards)
    np.testing.assert_array_equal(result.hits, alone.hits)
    assert result.rewards.any()


def kept(cache_folder, folder):
    return sorted(path.name for path in (cache_folder / folder).glob("[!.]*"))


def interrupt_after(monkeypatch, count):
    """Simulate Ctrl-C once `count` tasks are finished."""
    original, calls = keeping.Keeper.add, []

    def add(keeper, *brought):
        if len(calls) == count:
            raise KeyboardInterrupt
        calls.append(brought)
        original(keeper, *brought)

    monkeypatch.setattr(keeping.Keeper, "add", add)


def test_the_runs_of_an_interrupted_condition_are_not_computed_again(monkeypatch, cache_folder, lived):
    with monkeypatch.context() as patch, pytest.raises(KeyboardInterrupt):
        interrupt_after(patch, 4)
        once(LONG)
    assert len(kept(cache_folder, "runs")) == 1 and len(cache.load_runs(LONG)) == 4
    lived.clear()
    assert_whole(once(LONG), LONG)
    assert len(lived) == 2
    assert kept(cache_folder, "runs") == [] and kept(cache_folder, "conditions") == [LONG.key]


def test_runs_are_written_while_others_are_computed(at_once, monkeypatch, cache_folder):
    written, original = [], cache.save_runs
    monkeypatch.setattr(cache, "save_runs", lambda *task: written.extend(task[1]) or original(*task))
    assert_whole(once(LONG), LONG)
    assert len(written) == len(set(written)) == 5  # the sixth completes the condition
    assert kept(cache_folder, "runs") == []


def test_a_short_condition_is_written_once(at_once, monkeypatch, cache_folder):
    monkeypatch.setattr(cache, "save_runs", None)
    assert_whole(once(SHORT), SHORT)


def test_runs_of_a_condition_that_fails_are_kept(monkeypatch, cache_folder):
    original = sweeping._live

    def live(condition, runs, *others):
        if 2 in runs:
            raise MemoryError("never")
        return original(condition, runs, *others)

    with monkeypatch.context() as patch, pytest.raises(MemoryError, match="never"):
        patch.setattr(sweeping, "_live", live)
        once(LONG)
    assert sorted(cache.load_runs(LONG)) == [0, 1, 3, 4, 5]


@pytest.mark.parametrize("damage", [lambda content: content[:-1], lambda content: b""])
def test_damaged_runs_are_computed_again(monkeypatch, cache_folder, lived, damage):
    alone = simulate(**LONG.choices, progress=False)
    cache.save_runs(LONG, {k: (alone.rewards[k], alone.hits[k]) for k in (1, 2)})
    cache.save_runs(LONG, {k: (alone.rewards[k], alone.hits[k]) for k in (0, 5)})
    (path,) = (cache_folder / "runs").glob("*-0")
    path.write_bytes(damage(path.read_bytes()))
    assert_whole(once(LONG), LONG)
    assert sorted(lived) == [0, 3, 4, 5]


@pytest.mark.parametrize("arrays", [
    {"rewards": np.zeros((3, 50), np.float32)}, {"rewards": np.zeros((3, 50)), "hits": np.zeros((3, 50, 2), np.int16)},
    {"rewards": np.zeros((2, 50), np.float32), "hits": np.zeros((2, 50, 2), np.int16)},
    {"rewards": np.array([None]), "hits": 1}], ids=["fields", "numbers", "runs", "objects"])
def test_a_whole_file_of_another_version_is_no_result(tmp_path, lived, arrays):
    np.savez(tmp_path / "foreign.npz", **arrays)
    files.write_checked(SHORT.path, (tmp_path / "foreign.npz").read_bytes())
    assert_whole(once(SHORT), SHORT)
    assert lived == [0, 1, 2]


@pytest.mark.parametrize("content", [b"", b"\x93NUMPY", b"PK\x03\x04", b"a kernel"])
def test_a_whole_file_of_another_kind_is_no_result(lived, content):
    files.write_checked(SHORT.path, content)
    assert_whole(once(SHORT), SHORT)
    assert cache.load(SHORT) is not None


def test_an_additional_field_does_no_harm(tmp_path, lived):
    result = once(SHORT)
    np.savez(tmp_path / "later.npz", rewards=result.rewards, hits=result.hits, title=np.array("later"))
    files.write_checked(SHORT.path, (tmp_path / "later.npz").read_bytes())
    lived.clear()
    assert_whole(once(SHORT), SHORT)
    assert not lived


@pytest.mark.parametrize("options, reason", [("size=8k", "No space left"), ("ro", "Read-only")])
def test_a_full_or_read_only_disk_causes_one_warning(at_once, cache_folder, mount, monkeypatch, options, reason):
    compiled, disk = (cache_folder / "compiled").resolve(), mount(cache_folder / "disk", options)
    if options != "ro":
        (disk / "compiled").symlink_to(compiled)
    monkeypatch.setenv("NEORL_CACHE", str(disk))
    conditions = [LONG, Condition(place_cells([3]), WaterWorld(), 20_000, 4)]
    with pytest.warns(RuntimeWarning, match=f"{disk} takes no results .{reason}") as warned:
        results = list(sweep(conditions, progress=False))
    assert len(warned) == 1
    for result, condition in zip(results, conditions):
        assert_whole(result, condition)
    assert all(files.read_checked(path) is not None for path in disk.rglob("*") if path.is_file())


def test_single_runs_that_a_killed_process_left_beside_their_condition_are_removed(cache_folder):
    result = once(SHORT)
    cache.save_runs(SHORT, {0: (result.rewards[0], result.hits[0])})
    assert len(kept(cache_folder, "runs")) == 1
    assert_whole(once(SHORT), SHORT)
    assert kept(cache_folder, "runs") == []


def test_a_cache_folder_that_is_a_file_causes_one_warning(tmp_path, monkeypatch):
    (tmp_path / "file").write_text("")
    monkeypatch.setenv("NEORL_CACHE", str(tmp_path / "file"))
    with pytest.warns(RuntimeWarning, match="file takes no results") as warned:
        assert_whole(once(SHORT), SHORT)
    assert len(warned) == 1


def test_what_fits_neither_on_the_disk_nor_into_memory_is_an_error(tmp_path, monkeypatch):
    (tmp_path / "file").write_text("")
    monkeypatch.setenv("NEORL_CACHE", str(tmp_path / "file"))
    monkeypatch.setattr("psutil.virtual_memory", lambda: type("Memory", (), {"available": 10_000}))  # bytes
    with pytest.warns(RuntimeWarning, match="takes no"), pytest.raises(MemoryError, match="file takes no results, and"):
        once(Condition(place_cells([3]), WaterWorld(), 20_000, 3))


WORK = """
from neorl import *
import neorl.experiments.keeping
neorl.experiments.keeping.SECONDS = 0
conditions = [Condition(place_cells([3]), WaterWorld(), 100_000, 20, seed) for seed in range(3)]
print("begins", flush=True)
results = sweep(conditions, workers=2, progress=False)
print([float(result.totals.sum()) for result in results])
"""


def started():
    process = subprocess.Popen([sys.executable, "-c", WORK], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                               preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler))
    assert process.stdout.readline() == "begins\n"
    return process


def damaged(cache_folder):
    """Files under their final names that are not whole."""
    return [path for folder in ("runs", "conditions") for path in (cache_folder / folder).glob("[!.]*")
            if files.read_checked(path) is None]


def test_a_sweep_that_is_killed_again_and_again_ends_with_equal_results(cache_folder):
    random = np.random.default_rng(5)
    for _ in range(2):
        had, process = lived_so_far(), started()
        while lived_so_far() == had and process.poll() is None:
            time.sleep(0.01)
        time.sleep(random.uniform(0, 0.2))
        process.kill()
        process.communicate()
        assert damaged(cache_folder) == [] and lived_so_far() > had
    printed, complaints = started().communicate()
    assert complaints == "" and kept(cache_folder, "runs") == []
    alone = [simulate(place_cells([3]), WaterWorld(), steps=100_000, runs=20, seed=seed, progress=False)
             for seed in range(3)]
    assert printed == f"{[float(result.totals.sum()) for result in alone]}\n"


def lived_so_far():
    conditions = [Condition(place_cells([3]), WaterWorld(), 100_000, 20, seed) for seed in range(3)]
    return sum(20 if cache.load(each) else len(cache.load_runs(each)) for each in conditions)


def test_an_interrupted_process_ends_and_says_what_it_was_at(cache_folder):
    process = started()
    while not lived_so_far():
        time.sleep(0.01)
    process.send_signal(signal.SIGINT)
    _, complaints = process.communicate()
    assert process.returncode in (1, -signal.SIGINT, 130) and "\nKeyboardInterrupt" in complaints
    assert "tasks were left, such as runs " in complaints and "finished runs are kept" in complaints
    assert 0 < lived_so_far() < 60 and damaged(cache_folder) == []


def test_what_a_killed_process_was_writing_is_removed_when_it_is_old(tmp_path):
    folder = tmp_path / "folder"
    folder.mkdir()
    old, young, other = (folder / name for name in (".neorl-old.tmp", ".neorl-young.tmp", ".profile"))
    for path in (old, young, other):
        path.write_text("half")
    for path in (old, other):
        os.utime(path, (0, 0))
    files.write_whole(folder / "new", b"whole")
    assert sorted(path.name for path in folder.iterdir()) == [young.name, other.name, "new"]


@pytest.mark.skipif(os.name == "nt", reason="Windows has no file modes")
@pytest.mark.parametrize("mask, mode", [(0o022, 0o644), (0o027, 0o640), (0o077, 0o600)])
def test_a_kept_file_is_as_open_to_others_as_any_other_new_file(tmp_path, mask, mode):
    before = os.umask(mask)
    try:
        files.write_whole(tmp_path / "new", b"whole")
    finally:
        os.umask(before)
    assert stat.S_IMODE((tmp_path / "new").stat().st_mode) == mode


def test_a_file_that_cannot_be_written_leaves_nothing(tmp_path, monkeypatch):
    monkeypatch.setattr(os, "fsync", lambda _: (_ for _ in ()).throw(OSError(28, "No space left on device")))
    with pytest.raises(OSError, match="No space left"):
        files.write_whole(tmp_path / "folder" / "new", b"whole")
    assert list((tmp_path / "folder").iterdir()) == []


def test_two_sweeps_of_the_same_conditions_at_once_do_not_disturb_each_other(cache_folder):
    processes = [started(), started()]
    printed = [process.communicate() for process in processes]
    alone = [simulate(place_cells([3]), WaterWorld(), steps=100_000, runs=20, seed=seed, progress=False)
             for seed in range(3)]
    assert printed == [(f"{[float(result.totals.sum()) for result in alone]}\n", "")] * 2
    assert damaged(cache_folder) == [] and kept(cache_folder, "runs") == []
    assert len(kept(cache_folder, "conditions")) == 3
