"""Finished runs are found again under keys of all that determines them, whole, despite kills, damage and full disks."""

import functools
import json
import os
import signal
import subprocess
import sys
import time
from dataclasses import replace

import numpy as np
import pytest
from computing import verify
from same import alone

from neorl import Condition, Learning, Policy, WaterWorld, kernel, place_cells, simulate, sweep
from neorl.custom import softmax
from neorl.common import files
from neorl.common.array_files import open_arrays, write_arrays
from neorl.experiments import condition as conditions
from neorl.experiments import simulation, store
from neorl.experiments.bins import new_bins

LONG = Condition(place_cells([3]), WaterWorld(), simulation.TASK_STEPS, 6)
SHORT = Condition(place_cells([3]), WaterWorld(), 500, 3)
pytestmark = pytest.mark.usefixtures("cache_folder")


@pytest.fixture
def at_once(monkeypatch):
    """Write runs as soon as they are finished."""
    monkeypatch.setattr(store, "SECONDS", -1)


@pytest.fixture
def lived(monkeypatch):
    """The numbers of the runs that were computed."""
    runs, original = [], simulation._computed
    monkeypatch.setattr(simulation, "_computed", lambda *task: runs.extend(task[1]) or original(*task))
    return runs


def once(condition):
    return simulate(**condition.choices, cache=True, progress=False)


def assert_whole(result, condition):
    assert result == alone(condition) and result.rewards.any()


def found(cache_folder, folder):
    return sorted(path.name for path in (cache_folder / folder).glob("[!.]*"))


def test_the_key_depends_on_everything_that_determines_a_result(monkeypatch):
    keys = [SHORT.key]
    keys.append(replace(SHORT, agent=place_cells([3], learning=Learning(discount=0.81))).key)
    keys += [replace(SHORT, agent=place_cells([3], policy=Policy(choose=choose))).key
             for choose in (softmax(0.1), softmax(1.0))]
    keys += [replace(SHORT, world=world).key for world in (WaterWorld(fps=30), WaterWorld(contact="truncated"))]
    keys += [replace(SHORT, **size).key for size in ({"steps": 501}, {"runs": 4}, {"seed": 1})]
    keys.append(replace(SHORT, changes=[(100, place_cells([3]))]).key)
    monkeypatch.setattr(conditions, "source_digest", lambda: "another source")
    keys.append(SHORT.key)
    assert len(set(keys)) == len(keys)


def test_the_source_digest_covers_every_module_that_a_run_imports():
    grimp = pytest.importorskip("grimp")
    imported = grimp.build_graph("neorl", cache_dir=None).find_upstream_modules("neorl.experiments.simulation")
    assert {"neorl.core.horde", "neorl.worlds.world"} < imported
    assert {name.split(".")[1] for name in imported} == set(conditions.PARTS)


@pytest.mark.parametrize("change, message", [
    ({"steps": 0}, "steps must be an integer of at least 1, but is 0"),
    ({"changes": 5}, "changes must be .*, but is 5"), ({"changes": [(5,)]}, r"changes must be pairs \(step, agent\)"),
    ({"changes": [(501, place_cells())]}, "step of a change must be an integer from 0 to 500, but is 501"),
    ({"changes": [(50, place_cells()), (49, place_cells())]}, "step of a change must")])
def test_a_condition_that_could_not_run_is_refused(change, message):
    with pytest.raises(ValueError, match=message):
        Condition(**SHORT.choices | change)
    with pytest.raises(ValueError, match=message):
        simulate(**SHORT.choices | change)


@pytest.mark.parametrize("damage", [
    lambda content: content[:-1], lambda content: content[:40],
    lambda content: bytes([*content[:900], content[900] ^ 1, *content[901:]])])
def test_a_damaged_file_is_noticed_and_computed_again(cache_folder, lived, damage):
    once(SHORT)
    (path,) = paths_of(SHORT)
    path.write_bytes(damage(path.read_bytes()))
    assert_whole(once(SHORT), SHORT)
    once(SHORT)
    assert lived == [0, 1, 2, 0, 1, 2]


def test_a_folder_in_the_place_of_a_file_is_named(cache_folder):
    once(SHORT)
    (path,) = paths_of(SHORT)
    path.unlink()
    path.mkdir()
    with pytest.warns(RuntimeWarning, match=rf"takes no results \({path} must be a file, but is a folder: .*\): they"):
        assert_whole(once(SHORT), SHORT)


@pytest.mark.parametrize("arrays", [
    {"rewards": np.zeros((3, 50), np.float32)}, {"rewards": np.zeros((3, 50)), "hits": np.zeros((3, 50, 2), np.int16)},
    {"rewards": np.zeros((2, 50), np.float32), "hits": np.zeros((2, 50, 2), np.int16)}],
    ids=["fields", "numbers", "runs"])
def test_a_whole_file_of_another_version_is_no_result(cache_folder, lived, arrays):
    write_arrays(cache_folder / "runs" / f"{SHORT.key}-{16 * 'f'}", "runs", {}, {"runs": np.arange(3)} | arrays)
    assert_whole(once(SHORT), SHORT)
    assert lived == [0, 1, 2]


def paths_of(condition):
    """The files of a condition, in the order of their names."""
    return sorted((files.cache_folder() / "runs").glob(f"{condition.key}-*"))


def interrupt_after(monkeypatch, count):
    """Simulate Ctrl-C once `count` tasks are finished."""
    original, calls = store.Keeper.add, []

    def add(keeper, *brought):
        if len(calls) == count:
            raise KeyboardInterrupt
        calls.append(brought)
        original(keeper, *brought)

    monkeypatch.setattr(store.Keeper, "add", add)


def test_the_runs_of_an_interrupted_condition_are_not_computed_again(monkeypatch, cache_folder, lived):
    with monkeypatch.context() as patch, pytest.raises(KeyboardInterrupt):
        interrupt_after(patch, 4)
        once(LONG)
    assert len(found(cache_folder, "runs")) == 1 and len(store.load_runs(LONG)) == 4 and store.load(LONG) is None
    lived.clear()
    assert_whole(once(LONG), LONG)
    assert len(lived) == 2 and len(found(cache_folder, "runs")) == 2


@pytest.mark.parametrize("damage", [lambda content: content[:-1], lambda content: b""])
def test_damaged_runs_are_computed_again(cache_folder, lived, damage):
    alone = simulate(**LONG.choices, progress=False)
    lived.clear()
    for runs in ((1, 2), (0, 5)):
        store.save_runs(LONG, {k: (alone.rewards[k], alone.hits[k]) for k in runs})
    path = paths_of(LONG)[-1]
    path.write_bytes(damage(path.read_bytes()))
    lost = {1, 2, 0, 5} - {*store.load_runs(LONG)}
    assert lost in ({0, 5}, {1, 2})
    assert once(LONG) == alone
    assert sorted(lived) == sorted({3, 4} | lost)


@pytest.mark.parametrize("options, reason", [("size=8k", "No space left"), ("ro", "Read-only")])
def test_a_full_or_read_only_disk_causes_one_warning(at_once, cache_folder, mount, monkeypatch, options, reason):
    compiled, disk = (cache_folder / "compiled").resolve(), mount(cache_folder / "disk", options)
    if options != "ro":
        (disk / "compiled").symlink_to(compiled)
    monkeypatch.setenv("NEORL_CACHE", str(disk))
    conditions = [LONG, replace(SHORT, steps=20_000)]
    with pytest.warns(RuntimeWarning, match=f"{disk} takes no results .{reason}") as warned:
        results = list(sweep(conditions, progress=False))
    assert len({str(each.message) for each in warned if "results" in str(each.message)}) == 1
    for result, condition in zip(results, conditions):
        assert_whole(result, condition)
    assert damaged(disk) == []


def test_what_fits_neither_on_the_disk_nor_into_memory_is_an_error(tmp_path, monkeypatch):
    (tmp_path / "file").write_text("")
    monkeypatch.setenv("NEORL_CACHE", str(tmp_path / "file"))
    with pytest.warns(RuntimeWarning, match="file takes no results"):
        assert_whole(once(SHORT), SHORT)
    monkeypatch.setattr("neorl.experiments.simulation._check_fits", lambda condition: None)  # it was free at first
    monkeypatch.setattr("psutil.virtual_memory", lambda: type("Memory", (), {"available": 10_000}))  # bytes
    with pytest.warns(RuntimeWarning, match="takes no"), pytest.raises(MemoryError, match="file takes no results, and"):
        once(replace(SHORT, steps=20_000))


WORK = """
from neorl import *
import neorl.experiments.store
neorl.experiments.store.SECONDS = 0
conditions = [Condition(place_cells([3]), WaterWorld(), 50_000, 20, seed) for seed in range(3)]
print("begins", flush=True)
results = sweep(conditions, threads=2, progress=False)
print([float(result.totals.sum()) for result in results])
"""
WORKED_ON = [Condition(place_cells([3]), WaterWorld(), 50_000, 20, seed) for seed in range(3)]


def started():
    process = subprocess.Popen([sys.executable, "-c", WORK], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                               preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler))
    assert process.stdout.readline() == "begins\n"
    return process


def damaged(cache_folder):
    """Files under their final names that are not whole."""
    found = []
    for path in (cache_folder / "runs").glob("[!.]*"):
        try:
            with open_arrays(path, "runs") as file:
                file.read(file.shapes)
        except ValueError:
            found.append(path)
    return found


def lived_so_far():
    return sum(len(store.load_runs(each)) for each in WORKED_ON)


@functools.cache
def of_all():
    return f"{[float(simulate(**each.choices, progress=False).totals.sum()) for each in WORKED_ON]}\n"


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
    assert started().communicate() == (of_all(), "")


def test_two_sweeps_of_the_same_conditions_at_once_do_not_disturb_each_other(cache_folder):
    processes = [started(), started()]
    assert [process.communicate() for process in processes] == [(of_all(), "")] * 2
    assert damaged(cache_folder) == [] and all(map(store.load, WORKED_ON))


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


def test_a_file_that_cannot_be_written_leaves_nothing(tmp_path, monkeypatch):
    monkeypatch.setattr(os, "fsync", lambda _: (_ for _ in ()).throw(OSError(28, "No space left on device")))
    with pytest.raises(OSError, match="No space left"):
        files.write_whole(tmp_path / "folder" / "new", b"whole")
    assert list((tmp_path / "folder").iterdir()) == []


DIGEST = "0f" * 32


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """An empty cache folder, for compiled kernels too, since the tests remove them."""
    monkeypatch.setenv("NEORL_CACHE", str(tmp_path / "kept"))
    return tmp_path / "kept"


def keep(condition):
    store.save_runs(condition, dict(enumerate(zip(*new_bins(condition.world, condition.runs, condition.steps)))))
    (path,) = paths_of(condition)
    return path


@pytest.fixture
def full(folder):
    """A cache with a file of each kind among foreign files: {name: path}."""
    paths = {"condition": keep(SHORT), "another condition": folder / "runs" / f"{DIGEST}-{DIGEST[:16]}"}
    paths["another condition"].write_bytes(b"of another version")
    for kind, name in (("compiled", f"begin_self-{DIGEST[:32]}"), ("wasm", DIGEST)):
        paths[kind] = folder / kind / name
        files.write_checked(paths[kind], b"content")
    paths["claims"] = folder / "claims" / "chapter_1.json"
    files.write_whole(paths["claims"], json.dumps({"page": "chapter_1", "claims": {}}).encode())
    for name in ("letter.txt", "runs/letter.txt", "claims/letter.json", "claims/list.json", "compiled/letter",
                 f"letters/{DIGEST}", f"wasm/{DIGEST}.wasm"):
        path = paths[f"other {name}"] = folder / name
        path.parent.mkdir(exist_ok=True)
        path.write_text("[]" if name.endswith("list.json") else "dear friend")
    return paths


OURS = {"condition", "another condition", "compiled", "wasm", "claims"}


def test_what_is_neorls_is_removed_and_nothing_of_others(full):
    others = {path: path.read_bytes() for name, path in full.items() if name not in OURS}
    removed = store.clear()
    assert {full[name] for name in OURS} == {each.path for each in removed}
    assert not any(each.path.exists() for each in removed)
    assert all(path.read_bytes() == content for path, content in others.items())
    assert store.clear() == []


def test_conditions_of_other_sources_are_not_restored(full, monkeypatch):
    assert verify.conditions_kept() == [SHORT]
    monkeypatch.setattr(conditions, "source_digest", lambda: "another")
    assert verify.conditions_kept() == []


def test_a_condition_with_a_local_kernel_is_kept(folder):
    @kernel
    def of_no_module(value, stream):
        return 0

    condition = replace(SHORT, agent=place_cells([2], policy=Policy(choose=of_no_module)))
    keep(condition)
    assert store.load(condition).agent == condition.agent and verify.conditions_kept() == []


@pytest.mark.parametrize("about", [
    "[]", json.dumps({"agent": {}, "world": {}, "steps": "x"})])
def test_an_invalid_note_is_ignored(folder, about):
    path = folder / "runs" / f"{DIGEST}-{DIGEST[:16]}"
    path.parent.mkdir(parents=True)
    with path.open("wb") as file:
        np.savez(file, about=np.array(about))
    assert len(store.kept()) == 1 and verify.conditions_kept() == []
