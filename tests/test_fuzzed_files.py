"""Altered files of runs, learners and results bring an error or a run, and never a crash: `fuzzed_files`.

`make fuzz` loads all of some 16,000, `make test` every hundredth, in processes of their own, since one may crash.
"""

import subprocess
import sys
from pathlib import Path

import pytest

ALL = 16  # processes


@pytest.mark.parametrize("first, step", [(3, 101), *(
    pytest.param(first, ALL, marks=pytest.mark.fuzz) for first in range(ALL))])
def test_an_altered_file_brings_an_error_or_a_run(first, step):
    program = Path(__file__).with_name("fuzzed_files.py")
    done = subprocess.run([sys.executable, program, str(first), str(step)], capture_output=True, text=True)
    assert done.returncode == 0, done.stdout[-3_000:] + done.stderr[-3_000:]
    counts = done.stdout.splitlines()[-1]
    assert "'result': 0" not in counts and "'error': 0" not in counts
