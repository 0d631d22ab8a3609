"""Static checks: mypy finds no error in the public modules or in typical uses of them, and ruff none in any file."""

import subprocess
import sys
from pathlib import Path

import pytest

import neorl

PROJECT = Path(__file__).parents[1]


@pytest.mark.parametrize("command", [("mypy", "--warn-unused-ignores"), ("ruff", "check")])
def test_a_checker_finds_no_error(command):
    done = subprocess.run([sys.executable, "-m", *command], cwd=PROJECT, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr


def test_the_package_says_that_it_is_annotated():
    assert (Path(neorl.__file__).parent / "py.typed").exists()
