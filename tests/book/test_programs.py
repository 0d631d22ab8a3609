"""The program in the fold of a figure, the text that a reader would copy, runs as it stands and draws it."""

import copy
import subprocess
import sys
from pathlib import Path

from computing import cells
import nbformat
from computing import programs
import pytest

ROOT = Path(__file__).parents[2]
NOTEBOOKS = {path.stem: nbformat.read(path, 4).cells for path in sorted((ROOT / "notebooks").glob("*.ipynb"))}
QUICK = {"runs": 2, "steps": 3_000}


def is_drawn(path):
    return path.read_text(encoding="utf-8").count("<path") > 20


def shown(page, values):
    """The code that a page shows in the fold of each figure: {name: text}."""
    made = programs.with_programs(cells.of_page(copy.deepcopy(NOTEBOOKS[page]), values))
    return {programs.figure_of(cell): cell.source for cell in made
            if {"hide-input", "hide-cell"} & cells.tags(cell) and programs.figure_of(cell)}


def test_the_program_of_a_figure_draws_it(tmp_path):
    subprocess.run([sys.executable, "-c", shown("paper_a", QUICK)["fig-explored"]], cwd=tmp_path, check=True)
    assert is_drawn(tmp_path / "fig-explored.svg")


def test_the_line_at_the_top_of_a_program_draws_the_figure_with_other_parameters(tmp_path):
    line = shown("chapter_3", {})["fig-3-alternation"].splitlines()[1]
    _, script, *arguments = line.removeprefix("#").replace("-p runs 4", "-p runs 2 -p steps 3000").split()
    subprocess.run([sys.executable, ROOT / script, *arguments], cwd=tmp_path, check=True)
    assert is_drawn(tmp_path / "fig-3-alternation.svg")


@pytest.mark.parametrize("arguments, message", [
    (["fig-none"], "the figure must be one of a notebook's, such as fig-proficiency, but is 'fig-none'"),
    (["fig-own-pond", "-p", "runz", "4"], "a parameter must be one of the notebook's, but is runz")])
def test_a_figure_or_a_parameter_that_is_not_there_is_refused(arguments, message, monkeypatch, capsys):
    monkeypatch.setattr(sys, "path", [*sys.path])
    monkeypatch.setattr(sys, "argv", ["programs.py", *arguments])
    with pytest.raises((SystemExit, ValueError)) as refused:
        programs.main()
    assert message in f"{refused.value} {capsys.readouterr().err}"


@pytest.mark.parametrize("page", NOTEBOOKS)
def test_every_figure_has_a_program_that_compiles(page):
    made = shown(page, {})
    assert [*made] == [name for name in map(programs.figure_of, NOTEBOOKS[page]) if name]
    for name, text in made.items():
        compile(text, name, "exec")
        compile(programs.program(NOTEBOOKS[page], name), name, "exec")  # of a folded figure too, which does not show it


def test_a_program_has_what_the_figure_depends_on_and_nothing_else():
    sources = ["import numpy as np, sys\nfrom companion import page\npage.begin(runs)",
               "# Two seconds.\nruns: int = 2", "few = [runs]\nmany = 3  # not needed\n# needed\nfew.append(1)",
               "draw(many)", "def total(x):\n    return np.sum(x + few)", "drawn = many", "drawn = total(1)",
               "draw(drawn)"]
    made = [nbformat.v4.new_code_cell(each) for each in sources]
    made[-1].metadata["mystnb"] = {"figure": {"name": "fig-a"}}
    assert programs.program(made, "fig-a") == """import numpy as np
from companion import page
page.begin(runs)
runs: int = 2

few = [runs]
# needed
few.append(1)

def total(x):
    return np.sum(x + few)

drawn = total(1)

draw(drawn)
""" + programs.SAVE.format(name="fig-a")
