"""Every page, run in a real kernel in the ways in which its readers run it: `make pages`.

1. A page runs at a small size, with a cache of its own that shares only compiled kernels; again in the same kernel,
   where it must say the same, but for measured times; then below its experiment alone, with other parameters. It runs
   anew with the least and with other values, by its lines of papermill, and for the programs that it suggests.
2. Below the experiment, cells that draw or write must say what they did before, whatever the parameters are now, unless
   they show what open cells compute there.

`test_variations.py` runs the suggested programs alone, and other tests many more bad parameters.
"""

import json
import os
import re
import shlex
from copy import deepcopy

from computing import excerpts
import nbformat
import pytest
import yaml
from computing.cells import tags, with_values
from nbclient import NotebookClient
from nbclient.exceptions import CellExecutionError
from nbformat.v4 import new_code_cell, new_notebook
from page_cells import ALSO_SMALL, NOTEBOOKS, SMALL, computed_below, suggested
from saved_files import share_compiled
from traitlets.config import Config

LEAST = {"runs": 1, "n": 1, "resolution": 1, "resolutions": [1], "layers": [1], "counts": [1], "stays": [1],
         "n_creeps": 1, "place_gain": 0.0, "recursion": 0.0, "learning_rate": 0.001, "exploration": 0.0, "memory": 1,
         "bonus": 0.0, "begin": 0.1, "traffic": 0, "sample": 0}
# Other values of each page's parameters, which change what it shows. A line of papermill on each page has more.
OTHERS = {
    "agent_in_one_file": {"n": 4, "n_creeps": 8}, "alternatives": {"n_creeps": 3},
    "assumptions": {"steps": 2_000}, "beyond_agents": {"resolutions": [3, 7, 12], "n_creeps": 5},
    "calibration": {"sample": 3}, "chapter_1": {"n_creeps": 20},
    "chapter_2": {"learning_rate": 0.01, "exploration": 1.0}, "chapter_3": {"memory": 8, "bonus": 10.0},
    "chapter_4": {"resolutions": [2, 4, 6, 8], "stays": [5, 1_000]}, "chapter_5": {"counts": [2, 6], "begin": 0.9},
    "other_spaces": {"traffic": 20, "decisions": 333}, "own_world": {"resolution": 30},
    "paper_a": {"resolutions": [4, 12], "layers": [2, 3, 5, 7], "n_creeps": 20},
    "paper_b": {"resolutions": [3, 4], "n_creeps": 8, "place_gain": 100.0},
    "paper_c": {"n_creeps": 8, "recursion": 2.5, "resolutions": [3, 4]},
    "performance": {"steps": 3_000}, "recordings": {"resolutions": [11, 23]}, "wanted": {"reading": "letter"},
    "your_research": {"resolutions": [2, 20]}}
WAYS = "defaults", "twice", "below", "least", "others", "papermill", "suggested", "refused"
MEASURED = {  # the cells that show measured times
    "agent_in_one_file": {"comparison"}, "alternatives": {"costs-table"}, "beyond_agents": {"e65b2d27"},
    "chapter_4": {"cell-45", "cell-46", "pace"}, "own_world": {"cell-13"},
    "chapter_5": {"cell-35", "claims-of-all"},
    "performance": {"first", "learning", "fig"}}
BAD = None, {}, float("nan")
RESET = "get_ipython().reset(new_session=True)\n__spec__ = None"  # processes that are spawned look up the latter


class Failure(Exception):
    """A cell that raises, or whose output is not what it must be."""


class Page:
    """A page in a kernel. Its public methods are the ways of running it; each raises `Failure`."""

    def __init__(self, name, client):
        self.name, self.client, self.shown = name, client, {}
        cells = nbformat.read(NOTEBOOKS / f"{name}.ipynb", 4).cells
        code = [cell for cell in cells if cell.cell_type == "code"]
        (first,) = [place for place, cell in enumerate(code) if "parameters" in tags(cell)]
        self.parameters, *self.cells = code[first:]  # not the recorded answer
        self.names = set(re.findall(r"^(\w+): ", self.parameters.source, re.MULTILINE))
        self.small = SMALL | ALSO_SMALL.get(name, {})

    def defaults(self):
        self.shown = self._run(self._cells())

    def twice(self):
        self._same(self._run(self._cells()), "says something else the second time")

    def below(self):
        cells = self._cells(OTHERS[self.name] | {"runs": 3, "steps": self.small["steps"] + 1_000})
        (at,) = [place for place, cell in enumerate(cells) if "experiment" in tags(cell)]
        self._run(cells[:2])
        self._same(self._run(cells[at + 1:]), "is about the parameters, not about what was run",
                   computed_below(cells, at, self.names))

    def least(self):
        self._anew(self._cells({name: LEAST[name] for name in self.names & {*LEAST}}))

    def others(self):
        self._anew(self._cells(OTHERS[self.name]))

    def papermill(self):
        for section in ("Run it yourself", "Variations to try"):
            for line in suggested(self.name, section)[1]:
                self._anew(self._injected(line))

    def suggested(self):
        self._anew(self._cells())
        for number, program in enumerate(suggested(self.name, "Variations to try")[0], 1):
            self._run([new_code_cell(program, id=f"suggestion-{number}")])

    def refused(self):
        self._anew([])
        for name in sorted(self.names):
            for value in BAD:
                bad = new_code_cell(f"nan = float('nan')\n{name} = {value!r}", id="bad")
                try:
                    self._run([self.parameters, bad, self.cells[0]])
                except Failure as failure:
                    if not re.search(rf"ValueError: {name} must be .*, but is ", str(failure)):
                        raise
                else:
                    raise Failure(f"{name} may be {value!r}")

    def _cells(self, values=()):
        """The cells of code, at a small size but for these values of the parameters."""
        first = deepcopy(self.parameters)
        first.source = with_values(first.source, self.small | dict(values))
        return [first, *self.cells]

    def _injected(self, line):
        """The cells of code as papermill makes them of its arguments, at a small size where these name none."""
        from papermill.cli import _resolve_type as value_of  # which takes long to import

        given, words = {}, iter(shlex.split(line))
        for option in words:
            given |= {next(words): value_of(next(words))} if option == "-p" else yaml.safe_load(next(words))
        given = self.small | given | {"runs": self.small["runs"]}
        injected = "\n".join(["# Parameters", *(f"{name} = {value!r}" for name, value in given.items())])
        return [self.parameters, new_code_cell(injected, id="injected"), *self.cells]

    def _anew(self, cells):
        self._run([new_code_cell(RESET, id="reset"), *cells])

    def _run(self, cells):
        """What cells put out, {cell: text}."""
        self.client.nb = new_notebook(cells=deepcopy(cells))
        for place, cell in enumerate(self.client.nb.cells):
            try:
                self.client.execute_cell(cell, place)
            except CellExecutionError as error:
                raise Failure(f"{cell.id}: {error.ename}: {error.evalue.splitlines()[0]}") from None
        return {cell.id: text_of(cell.outputs) for cell in self.client.nb.cells}

    def _same(self, again, otherwise, free=frozenset()):
        """Raise `Failure` unless cells, but for some that are free to, put out what they did at first."""
        free = free | MEASURED.get(self.name, set())
        if changed := [cell for cell in again if cell not in free and again[cell] != self.shown.get(cell, again[cell])]:
            raise Failure(f"{', '.join(changed)}: {otherwise}")


def text_of(outputs):
    """What outputs show, as a text, but for widgets, which have numbers, and the dates of figures."""
    shown = [each.data for each in outputs if excerpts.WIDGET_VIEW not in each.get("data", {excerpts.WIDGET_VIEW})]
    return re.sub(r"<dc:date>.*?</dc:date>", "", json.dumps(shown))


@pytest.fixture
def page(request, tmp_path):
    """A page in a kernel of its own."""
    share_compiled(tmp_path)
    quiet = {"transport": "ipc", "ip": f"{tmp_path}/kernel"}  # over TCP the kernel warns that it is not encrypted
    client = NotebookClient(new_notebook(), kernel_name="python3", config=Config(KernelManager=quiet))
    with client.setup_kernel(cwd=str(NOTEBOOKS), env=os.environ | {"NEORL_CACHE": str(tmp_path)}):
        yield Page(request.param, client)


@pytest.mark.pages
@pytest.mark.filterwarnings("ignore")  # of the client
@pytest.mark.parametrize("page", os.environ.get("PAGES", "").split() or OTHERS, indirect=True)
def test_a_page_runs_in_the_ways_of_its_readers(page):
    failures = {}
    for way in WAYS:
        try:
            getattr(page, way)()
        except Failure as failure:
            failures[way] = str(failure)
    assert failures == {}


def test_every_page_is_run_with_other_values():
    assert {*OTHERS} == {path.stem for path in NOTEBOOKS.glob("*.ipynb")}
