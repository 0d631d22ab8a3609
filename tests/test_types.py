"""The annotations of the package: mypy finds nothing wrong in the public modules, or in typical uses of them.

Nor does ruff in any file.
"""

import subprocess
import sys
from pathlib import Path

import neorl

PROJECT = Path(__file__).parents[1]


def test_mypy_finds_no_error():
    done = subprocess.run([sys.executable, "-m", "mypy", "--warn-unused-ignores"], cwd=PROJECT, capture_output=True,
                          text=True)
    assert done.returncode == 0, done.stdout + done.stderr


def test_ruff_finds_no_error():
    done = subprocess.run([sys.executable, "-m", "ruff", "check"], cwd=PROJECT, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr


def test_the_package_says_that_it_is_annotated():
    assert (Path(neorl.__file__).parent / "py.typed").exists()
