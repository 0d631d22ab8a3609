"""No result is stale, whatever is edited in a user's program, between processes or within one."""

import importlib
import json
import os
import random
import sys
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from types import SimpleNamespace

import edited
import pytest
from subprograms import printed

from neorl import Condition, Policy, WaterWorld, kernel, place_cells, simulate, sweep
from neorl.browser import wasm
from neorl.experiments import simulation
from neorl.kernels.kernel import jit_is_off

QUICK = ("Learner", "World", "environment", "Modality")  # to compile
WAYS = ("cached", "sweep", "simulate", "Run", *QUICK)
FIRST = dict.fromkeys(edited.PARTS, 1)
pytestmark = pytest.mark.usefixtures("cache_folder")


def process(folder, numbers, *arguments, jit=False):
    """What a process finds that runs the program, edits it, and runs it again: the wrong results, the last numbers."""
    folder.mkdir(exist_ok=True)
    edited.write(folder, numbers)
    (folder / "numbers.json").write_text(json.dumps(numbers))
    return printed(edited.__file__, folder, *arguments, jit=jit)


def test_random_edits_between_processes_and_within_them_are_never_missed(tmp_path):
    rng, numbers = random.Random(int(os.environ.get("SEED", 0))), FIRST
    for _ in range(3):
        found = process(tmp_path / "program", numbers, str(rng.random()), "25", "all", *WAYS)
        assert found["wrong"] == []
        _, numbers = edited.redrawn(rng, rng.choice([numbers, found["numbers"]]))


@pytest.mark.skipif(jit_is_off(), reason="the compiler is off")
def test_random_edits_of_compiled_kernels_are_never_missed(tmp_path):
    assert process(tmp_path / "program", FIRST, "1", "8", "all", *QUICK[1:], jit=True)["wrong"] == []


@pytest.mark.skipif(jit_is_off(), reason="the compiler is off")
def test_a_constant_that_a_notebook_changes_changes_the_result_and_its_place_on_disk(tmp_path):
    found = process(tmp_path / "program", FIRST, "1", "1", "action", "cached", jit=True)
    again = process(tmp_path / "program", found["numbers"], "1", "0", "action", "cached")
    assert found["wrong"] == again["wrong"] == [] and found["numbers"]["action"] == 0


@pytest.mark.skipif(jit_is_off(), reason="without the compiler, kernels with parameters cannot be sent to a process")
def test_a_worker_process_with_the_same_program_is_accepted(tmp_path):
    assert process(tmp_path / "program", FIRST, "1", "0", "all", "pool", jit=True)["wrong"] == []


def test_a_worker_process_that_imports_an_edited_program_is_refused(tmp_path, monkeypatch):
    edited.write(tmp_path, FIRST)
    monkeypatch.syspath_prepend(tmp_path)
    program = importlib.import_module("program")
    try:
        edited.write(tmp_path, FIRST | {"helper": 10})
        with (ProcessPoolExecutor(1, get_context("spawn")) as pool,
              pytest.raises(RuntimeError, match="program:Mine must have the code that it was pickled with, but")):
            sweep([Condition(program.agent(), program.Mine(), 2, 1)], pool, progress=False)
    finally:
        del sys.modules["program"], sys.modules["helpers"]


def test_a_kernel_that_changes_while_it_runs_leaves_nothing_on_disk(cache_folder, monkeypatch):
    agent = place_cells([2], policy=Policy(choose=biased))
    monkeypatch.setattr(simulation, "finished_run", lambda *run: monkeypatch.setattr(sys.modules[__name__], "BIAS", 1))
    with pytest.raises(RuntimeError, match="change nothing while it runs"):
        simulate(agent, WaterWorld(), steps=1, runs=1, cache=True, progress=False)
    assert not (cache_folder / "runs").exists()


BIAS = 0


@kernel
def biased(value, stream):
    return BIAS


def test_a_module_of_webassembly_built_from_other_source_is_refused(monkeypatch):
    outcome = SimpleNamespace(returncode=0, stdout=wasm._digest("plane") + b"module")
    monkeypatch.setattr("subprocess.run", lambda *_, **__: outcome)
    assert wasm._built(["plane"], 1) == {"plane": b"module"}
    outcome.stdout = wasm._digest("helm") + b"module"
    with pytest.raises(RuntimeError, match="its source has changed"):
        wasm._built(["plane"], 1)
