"""The runs on record are the same to the last bit: natively, interpreted, and in WebAssembly."""

import json
import os
import subprocess
import sys
from pathlib import Path

import golden
import pytest
from webassembly import copied

from neorl import simulate
from neorl.core.kernel import is_tuple

RECORD = json.loads(golden.RECORD.read_text())
INTERPRETED = ["place N3", "place, long trace alone", "both, absence", "network D, signed", "every modality",
               "network D, calibrated", "both, silent captures"]
IN_WEBASSEMBLY = ["place N10, calibrated", "network D, calibrated", "every modality", "both, memory of seconds"]
SIDE_BY_SIDE = ["place N23", "network D, calibrated"]


def test_every_run_is_on_record():
    assert list(RECORD) == [*golden.RUNS, *golden.CHANGES] and len(RECORD) >= 40


@pytest.mark.parametrize("name", RECORD)
def test_a_run_is_as_on_record(name):
    assert golden.digest(name, golden.LONG) == RECORD[name][str(golden.LONG)]


@pytest.mark.parametrize("threads", [1, 2])
@pytest.mark.parametrize("name", SIDE_BY_SIDE)
def test_a_run_among_others_is_as_on_record(name, threads):
    agent, creeps = golden.RUNS[name]
    result = simulate(agent, golden.tank(creeps), steps=golden.LONG, runs=golden.RUN + 1, seed=7, threads=threads,
                      progress=False)
    assert f"{result.totals[golden.RUN]}" == RECORD[name][str(golden.LONG)].split()[0]


@pytest.mark.parametrize("name", IN_WEBASSEMBLY)
def test_a_run_in_webassembly_is_as_on_record(name):
    machine, sizes, arguments = copied(golden.born(name))
    reward = machine.call("rollout", sizes, last_step=golden.LONG, bin_steps=golden.LONG, **arguments)
    recorded = golden.recorded(reward, arguments["state"].values.q[1], views(arguments["world_state"]))
    assert recorded == RECORD[name][str(golden.LONG)]


def views(values):
    """The arrays in a named tuple of (address, view) pairs."""
    return type(values)(*(views(each) if is_tuple(each) else each[1] for each in values))


def test_interpreted_runs_are_as_on_record():
    printed = subprocess.run([sys.executable, str(Path(golden.__file__)), str(golden.SHORT), *INTERPRETED], check=True,
                             capture_output=True, env={**os.environ, "NUMBA_DISABLE_JIT": "1"}).stdout
    assert json.loads(printed) == {name: RECORD[name][str(golden.SHORT)] for name in INTERPRETED}
