"""What ``make verify`` compares, and that it notices a run that differs from the cached one."""

import os
import subprocess
import sys
from dataclasses import replace

import edited
import pytest
from computing import verify

from neorl import Condition, WaterWorld, multimodal, place_cells, simulate
from neorl.experiments import store

KEPT = [Condition(place_cells([3]), WaterWorld(), 505, 3, 1),
        Condition(place_cells([4]), WaterWorld(n_creeps=2), 400, 2, changes=[(100, multimodal([4]))])]
pytestmark = pytest.mark.usefixtures("cache_folder")


def in_a_process(*arguments):
    return subprocess.run([sys.executable, verify.__file__, *arguments], capture_output=True, text=True)


@pytest.fixture
def verified(monkeypatch, capsys):
    """`verified(*arguments)` is what the script prints, and what it ends with."""
    def verified(*arguments):
        monkeypatch.setattr(sys, "argv", ["verify.py", *arguments])
        try:
            ended = verify.main()
        except SystemExit as end:
            ended = end.code
        printed = capsys.readouterr()
        return printed.out, f"{ended} {printed.err}"

    return verified


@pytest.fixture
def kept():
    return [simulate(**condition.choices, cache=True, progress=False) for condition in KEPT]


def test_runs_equal_to_the_cached_ones_pass(kept, verified):
    done = in_a_process("--sample", "100")
    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith("5 of 5 runs of 2 conditions in ")
    assert "2,315 steps in all: the rewards and hits of 233 bins of 0.2 s are the same to the last bit" in done.stdout
    assert verified("--sample", "2", "--seed", "4")[0].startswith("2 of 5 runs of 2 conditions")


@pytest.mark.parametrize("name", ["rewards", "hits"])
def test_a_run_that_differs_from_the_cached_one_is_named(kept, verified, name):
    values = getattr(kept[1], name).copy()
    values[1, 7] += 1
    changed = replace(kept[1], **{name: values})
    store.save_runs(KEPT[1], dict(enumerate(zip(changed.rewards, changed.hits))))
    printed, ended = verified("--sample", "5", "--seed", "2")
    assert f"run 1 of {KEPT[1]}, {KEPT[1].key}: 1 of 40 bins differ, the first from 1.4 s on" in printed
    assert "1 of 5 runs are not as kept; make verify SAMPLE=5 SEED=2" in ended


def test_conditions_of_a_world_that_has_changed_are_counted_and_skipped(tmp_path, monkeypatch):
    first, work = dict.fromkeys(edited.PARTS, 1), "\n".join([
        "import program", "from neorl import *",
        "for life in ((program.agent(), program.Mine()), (place_cells([2]), WaterWorld())):",
        "    simulate(*life, steps=2, runs=1, cache=True, progress=False)"])
    (folder := tmp_path / "program").mkdir()
    edited.write(folder, first)
    monkeypatch.setenv("NUMBA_DISABLE_JIT", "1")
    monkeypatch.setenv("PYTHONPATH", str(folder), os.pathsep)
    subprocess.run([sys.executable, "-c", work], check=True)
    assert in_a_process("--seed", "4").stdout.startswith("2 of 2 runs of 2 conditions in ")
    edited.write(folder, first | {"rule": 10})
    done = in_a_process("--seed", "4")
    assert done.returncode == 0 and done.stdout.startswith("1 of 1 runs of 1 conditions in ")
    assert "seed 4\n1 more are left out: their kernels or worlds have changed since" in done.stdout


def test_an_empty_cache_and_an_empty_sample_are_refused(verified):
    assert "holds no condition that was computed with the present source: make book first" in verified()[1]
    assert "--sample must be an integer of at least 1, but is 0" in verified("--sample", "0")[1]
