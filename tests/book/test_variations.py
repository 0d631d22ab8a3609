"""The programs that pages suggest under *Variations to try* run below the page, with few and short runs.

`make pages` runs them at the end of the whole page, and the lines of papermill beside them.
"""

import copy
import re
import sys

import pytest
from computing.cells import of_page
from nbformat.v4 import new_code_cell
from page_cells import ALSO_SMALL, computed_below, suggested
from computing.programs import SAVE, program
from test_notebooks import NOTEBOOKS

SMALL = {"runs": 1, "steps": 1_000}
SUGGESTED = {f"{page}-{number}": (page, text) for page in NOTEBOOKS
             for number, text in enumerate(suggested(page, "Variations to try")[0], 1)}
# Programs that only the matrix runs, `make pages`.
LONG = {"beyond_agents-3": "the search's own runs have 150,000 steps"}


def cut_down(text):
    return re.sub(r"\bruns=\d+", "runs=2", re.sub(r"\bsteps=[\d_]+", "steps=1_000", text))


def shared_functions():
    """The functions and classes of modules that other tests use too: {(module, name): function}."""
    return {(module, name): value for module in [*sys.modules] if re.match(r"(companion|neorl)\b", module)
            for name, value in vars(sys.modules[module]).items() if callable(value)}


@pytest.mark.filterwarnings("ignore:invalid escape sequence")  # of RatInABox, where it is first compiled
@pytest.mark.parametrize("name", [name for name in SUGGESTED if name not in LONG])
def test_a_suggested_program_runs_with_what_it_needs_of_its_page(name):
    page, text = SUGGESTED[name]
    cells = of_page(copy.deepcopy(NOTEBOOKS[page].cells), SMALL | ALSO_SMALL.get(page, {}))
    cells.append(new_code_cell(cut_down(text), metadata={"mystnb": {"figure": {"name": name}}}))
    before = shared_functions()
    exec(compile(program(cells, name).removesuffix(SAVE.format(name=name)), name, "exec"), {"__name__": f"of_{page}"})
    after = shared_functions()
    assert [key for key, function in before.items() if after[key] is not function] == []


def test_the_programs_that_are_too_long_are_those_of_pages():
    assert {*LONG} <= {*SUGGESTED}


def test_cells_that_compute_below_the_experiment_are_told_from_those_that_show_it():
    sources = {"parameters": "runs: int = 2", "experiment": "def live(): return [runs]\nfound = live()",
               "again": "later = live()", "shown": "Markdown(len(found), runs)", "mixed": "Markdown(later)",
               "derived": "few = found[:1]", "longer": "found = runs * [1]", "rebound": "Markdown(found)"}
    cells = [new_code_cell(source, id=name) for name, source in sources.items()]
    assert computed_below(cells, 1, {"runs"}) == {"again", "mixed", "longer", "rebound"}
