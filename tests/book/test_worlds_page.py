"""The page on writing worlds: its examples take one import, print what they say, and can be debugged."""

import doctest
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from neorl import Run
from neorl.worlds import walls

PAGE = Path(__file__).parents[2] / "book" / "api_worlds.md"
EXAMPLES = re.findall(r"```python\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL)
MAZE, *CIRCLE = EXAMPLES
WITHOUT_COMPILER = {"NUMBA_DISABLE_JIT": "1"}
SHORT = """
path = Run(agent, Maze(), seed=0).record(1_000)
print(path.rewards.sum(), path.returns.tolist(), *path.positions[-1])"""


def run(folder, code, typed="", **environment):
    """What a file with this code prints, and the process."""
    (folder / "example.py").write_text(code, encoding="utf-8")
    return subprocess.run([sys.executable, "example.py"], cwd=folder, input=typed, capture_output=True, text=True,
                          env=os.environ | environment)


def promised(code):
    return re.findall(r"print\(.*# → (.*)", code)


def test_the_world_prints_what_stands_behind_its_arrow_and_runs_alike_without_the_compiler(tmp_path):
    done = run(tmp_path, MAZE + SHORT)
    *printed, short = done.stdout.splitlines() or pytest.fail(done.stderr)
    assert printed == promised(MAZE) != []
    until, again, _ = MAZE.partition("paths = ")
    interpreted = run(tmp_path, until + SHORT, **WITHOUT_COMPILER)
    assert again and interpreted.stdout.splitlines() == [short], interpreted.stderr


def test_the_circle_prints_what_stands_behind_its_arrows(tmp_path):
    code = "\n".join(CIRCLE)
    done = run(tmp_path, code, **WITHOUT_COMPILER)
    assert done.stdout.splitlines() == promised(code) and len(promised(code)) == code.count("print("), done.stderr


def test_a_world_takes_one_import_from_neorl_custom_beside_that_of_agents():
    modules = re.findall(r"^(?:from|import) (neorl\S*)", MAZE, re.MULTILINE)
    assert modules == ["neorl", "neorl.custom"]


def test_without_the_compiler_a_breakpoint_stops_in_a_kernel(tmp_path):
    stopping = MAZE.replace("    dx, dy =", "    breakpoint()\n    dx, dy =", 1)
    assert stopping != MAZE
    done = run(tmp_path, stopping, "print('action', action, 'at', scene.position.shape)\nquit\n", **WITHOUT_COMPILER)
    assert re.search(r"\(Pdb\) action [0-4] at \(2,\)", done.stdout), done.stdout + done.stderr


def test_without_the_compiler_an_index_out_of_range_is_an_error_in_its_line(tmp_path):
    wrong = MAZE.replace("rules.push[action, axis]", "rules.push[action + 5, axis]")
    done = run(tmp_path, wrong, **WITHOUT_COMPILER)
    assert "IndexError" in done.stderr and "after = scene.position[axis] + 0.1 * rules.push[action + 5" in done.stderr


def test_the_examples_of_docstrings_run(tmp_path):
    examples = [doctest.DocTestParser().get_examples(function.__doc__)
                for function in (walls.distance, walls.distance_along, Run.record, Run.advance)]
    imports = "import neorl\nfrom neorl.custom import Axis, Modality, walls\n"
    code = "".join([imports, *(each.source for those in examples for each in those)])
    done = run(tmp_path, code, **WITHOUT_COMPILER)
    assert all(examples) and done.returncode == 0, done.stderr
