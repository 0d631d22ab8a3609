"""The runs on record are the same to the last bit: natively, interpreted, and in WebAssembly."""

import json
import os
import subprocess
import sys
from pathlib import Path

import golden
import pytest

RECORD = json.loads(golden.RECORD.read_text())
INTERPRETED = ["place N3", "place, long trace alone", "both, absence", "network D, signed", "every modality"]


def test_every_run_is_on_record():
    assert list(RECORD) == [*golden.RUNS, *golden.CHANGES] and len(RECORD) >= 40


@pytest.mark.parametrize("name", RECORD)
def test_a_run_is_as_on_record(name):
    assert golden.digest(name, golden.LONG) == RECORD[name][str(golden.LONG)]


def test_interpreted_runs_are_as_on_record():
    printed = subprocess.run([sys.executable, str(Path(golden.__file__)), str(golden.SHORT), *INTERPRETED], check=True,
                             capture_output=True, env={**os.environ, "NUMBA_DISABLE_JIT": "1"}).stdout
    assert json.loads(printed) == {name: RECORD[name][str(golden.SHORT)] for name in INTERPRETED}
