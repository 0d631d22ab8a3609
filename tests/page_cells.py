"""Pages for tests: what their cells are, what they define when they run, and what they suggest."""

import ast
import json
import re
from contextlib import contextmanager, redirect_stdout
from functools import cache
from pathlib import Path
from symtable import symtable
from types import SimpleNamespace
from unittest.mock import patch

from computing.cells import tags, with_values
import numpy as np
from markdown_it import MarkdownIt
from matplotlib import pyplot as plt
from matplotlib.text import Annotation, Text
from computing.programs import changed_names, figure_of, read_names, statements

NOTEBOOKS = Path(__file__).parents[1] / "notebooks"
SMALL = {"runs": 2, "steps": 1_000, "seed": 0}
ALSO_SMALL = {"alternatives": {"steps": 3_000}, "calibration": {"sample": 1, "steps": 2_000},
              "chapter_3": {"steps": 3_000},
              "other_spaces": {"decisions": 200}, "your_research": {"steps": 2_000}}
WORDS = {"dashed": r"[Dd]ashed", "thesis": r"the (thesis|paper)('s number| reports)"}  # what speaks of a part
LAST = {"calibrated": None, "letter": "judging"}  # of the cells of a page under its readings, one of which is run whole
NUMBER_SHOWN = re.compile(r"(-?\d+(?:\.\d+)?)(?: \[[^]]*\])?(?=,| and |\.$)")  # in what a figure says it shows
HIDDEN = {"remove-input", "hide-input", "hide-cell"}
PART = "part-of-experiment"  # the tag of folded cells below the experiment that run more


def notebook(page):
    """A page as committed."""
    return json.loads((NOTEBOOKS / f"{page}.ipynb").read_text(encoding="utf-8"))


def small(page, **parameters):
    """A page as committed, but with parameters of a small size and these."""
    made = notebook(page)
    (first,) = [each for each in made["cells"] if "parameters" in each["metadata"].get("tags", ())]
    source = "".join(first["source"])
    named = set(re.findall(r"^(\w+): ", source, re.MULTILINE))
    values = {name: value for name, value in (SMALL | ALSO_SMALL.get(page, {})).items() if name in named}
    first["source"] = with_values(source, values | parameters)
    return made


def code(made):
    """The code in the cells of a page as made, in their order: {cell: source}."""
    return {each["id"]: "".join(each["source"]) for each in made["cells"] if each["cell_type"] == "code"}


def suggested(page, section):
    """What a section of a page suggests: programs to paste below the page, and arguments of papermill, two lists."""
    cells = notebook(page)["cells"]
    text = "\n\n".join("".join(each["source"]) for each in cells if each["cell_type"] == "markdown")
    _, _, text = text.partition(f"## {section}\n")
    blocks = [each for each in MarkdownIt().parse(re.split(r"^## ", text, flags=re.MULTILINE)[0])
              if each.type in ("fence", "code_block")]
    return ([each.content for each in blocks if each.info in ("", "python")],
            re.findall(r"\.ipynb out\.ipynb (.*)", "\n".join(each.content for each in blocks)))


@contextmanager
def few_resamples():
    """Bootstraps of as many resamples as the verdicts in tests need."""
    with patch("neorl.statistics.RESAMPLES", 100), patch("companion.thesis.measures.RESAMPLES", 100):
        yield


@cache
def executed(page, changes=(), until=None, **parameters):
    """The names that a page defines, run at a small size, as attributes, and what it draws, by cell.

    That is `parts_drawn`, and `numbers_shown`: what a figure says that it shows, and its numbers, (words, numbers).

    changes: pairs (text, other text) of its code, each of which must be there. until: the last cell to run, of which
    there must be one, or None for the whole page. parameters: its own.
    """
    cells = code(small(page, **parameters))
    assert until in (None, *cells), until
    for text, other in changes:
        assert any(text in cell for cell in cells.values()), text
        cells = {name: cell.replace(text, other) for name, cell in cells.items()}
    names, drawn, shown = {"__name__": f"cells_of_{page}"}, {}, {}
    with few_resamples(), plt.rc_context(), redirect_stdout(None):
        for name, cell in cells.items():
            last = run_cell(cell, f"{page}.ipynb, {name}", names)
            drawn[name] = parts()
            if words := getattr(last, "metadata", None) and last.metadata.get("found"):
                shown[name] = words, numbers_drawn()
            plt.close("all")
            if name == until:
                break
    return SimpleNamespace(**names, parts_drawn=drawn, numbers_shown=shown)


def run_cell(cell, title, names):
    """Run a cell, and return the value of its last expression, or None."""
    tree = ast.parse(cell)
    last = tree.body.pop() if tree.body and isinstance(tree.body[-1], ast.Expr) else None
    exec(compile(tree, title, "exec"), names)
    return eval(compile(ast.Expression(last.value), title, "eval"), names) if last else None


def numbers_drawn():
    """The numbers that lines of the open figures show: their coordinates, and of curves the mean of the last fifth."""
    lines = [line for number in plt.get_fignums() for axes in plt.figure(number).axes for line in axes.lines]
    data = [np.asarray(each, float) for line in lines for each in line.get_data(orig=False) if np.ndim(each)]
    return np.concatenate([*data, [each[-(-4 * len(each) // 5):].mean() for each in data if len(each) > 5]])


def assert_captions_end_with_numbers_of_their_figures(page, apart=()):
    """Assert that each number that a figure says it shows is in the figure. page: as `executed`.

    apart: cells whose numbers are of what their figures show, such as a difference of curves or a count of marks.
    """
    numbers_shown = {name: page.numbers_shown[name] for name in page.numbers_shown.keys() - {*apart}}
    assert numbers_shown and {*apart} <= page.numbers_shown.keys()
    for name, (words, drawn) in numbers_shown.items():
        numbers = NUMBER_SHOWN.findall(words.replace("−", "-"))
        assert numbers, words
        for number in numbers:
            near = 0.006 if abs(float(number)) < 10 else 0.51
            assert np.abs(drawn - float(number)).min() <= near, (name, words, number)


def parts():
    """The parts of `WORDS` that the open figures have."""
    found = [each for number in plt.get_fignums() for each in plt.figure(number).findobj()]
    arrows = [each.arrow_patch for each in found if isinstance(each, Annotation) and each.arrow_patch]
    return {"dashed"} & {"dashed" for each in (*found, *arrows) if getattr(each, "get_linestyle", str)() == "--"} | {
        "thesis" for each in found if isinstance(each, Text) and "thesis" in each.get_text()}


def assert_captions_and_prose_speak_of_what_is_drawn(page, drawn):
    """Assert that a page speaks of no part of a figure that its parameters leave out, such as the thesis's own levels.

    drawn: the `parts_drawn` of `executed`.
    """
    for cell in notebook(page)["cells"]:
        text = " ".join("".join(cell["source"]).split())
        if cell["cell_type"] == "code":
            shown = drawn[cell["id"]]
        elif "caption" in cell["metadata"].get("tags", ()):
            assert {part for part, words in WORDS.items() if re.search(words, text)} <= shown, text
        else:
            assert "dashed line" not in text


def computed_below(cells, experiment, parameters):
    """The cells below the experiment that open ones compute with parameters, and those that show what these have."""
    changing, found = set(), set()
    for place, cell in enumerate(cells):
        writes = PART not in tags(cell) and (figure_of(cell) or tags(cell) & HIDDEN or "Markdown(" in cell.source)
        for node, text in statements(cell.source):
            table = symtable(text, cell.id, "exec")
            bound = {each.get_name() for each in table.get_symbols() if each.is_assigned()} | changed_names(node)
            read = read_names(table)
            if place <= experiment:
                changes = isinstance(node, ast.FunctionDef | ast.ClassDef) and read & (changing | parameters)
            else:
                changes = read & changing or not writes and read & parameters
            if changes:
                changing |= bound
                found |= {cell.id} if place > experiment else set()
            elif isinstance(node, ast.Assign):
                changing -= bound
    return found
