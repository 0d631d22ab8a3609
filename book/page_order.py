"""The order of a built page.

A page that holds its experiment keeps its notebook's order: its parameters show the values used for the page, and the
cell that papermill injects is left out.

A notebook whose cells are tagged ``found``, a box and its figure, is turned round: these move up below the title, and
the parameters move to the end, folded below the heading *Run it yourself*.
"""

import re

from nbformat.v4 import new_markdown_cell

FOUND, PARAMETERS, INJECTED = "found", "parameters", "injected-parameters"


def results_first(cells, name, values, seconds):
    """The cells of a computed notebook, in the order of its page.

    name: of the notebook, without its extension. values: of its parameters, {name: value}. seconds: that it took.
    """
    if not any(FOUND in tags(each) for each in cells):
        return in_its_order(cells, values)
    title, *others = cells
    last = [each for each in others if PARAMETERS in tags(each)]
    for cell in last:
        cell.source = with_values(cell.source, values)
        cell.metadata.tags = [PARAMETERS, "hide-input"]
        cell.metadata.mystnb = {"code_prompt_show": "Show the parameters", "code_prompt_hide": "Hide the parameters"}
    first = sorted((each for each in others if FOUND in tags(each)), key=has_figure)  # the box before its figure
    rest = [each for each in others if not {FOUND, PARAMETERS, INJECTED} & tags(each)]
    heading = new_markdown_cell(run_it_yourself(name, seconds), id="run-it-yourself")  # not an id at random
    return [title, *first, *rest, heading, *last]


def in_its_order(cells, values):
    """The cells of a computed notebook that holds its experiment, in their own order."""
    kept = [each for each in cells if INJECTED not in tags(each)]
    for cell in kept:
        if PARAMETERS in tags(cell):
            cell.source = with_values(cell.source, values)
    return kept


def tags(cell):
    """The tags of a cell, a set."""
    return set(cell.metadata.get("tags", ()))


def has_figure(cell):
    """Whether a cell outputs a figure with a caption."""
    return "figure" in cell.metadata.get("mystnb", {})


def with_values(source, values):
    """The source of a cell of parameters, ``name: type = default  # comment``, with other values for the defaults."""
    for name, value in values.items():
        shown = f"{value:_}" if isinstance(value, int) else repr(value)
        source = re.sub(rf"^({name}: \w+ = )[^\s#]+", rf"\g<1>{shown}", source, flags=re.MULTILINE)
    return source


def run_it_yourself(name, seconds):
    """The text above the parameters of a page."""
    took = f"{seconds:.0f} seconds" if seconds < 90 else f"{seconds / 60:.0f} minutes"
    return (f"## Run it yourself\n\nThis page took {took} to compute, apart from what earlier builds had cached. `make "
            f"lab` opens its notebook, `notebooks/{name}.ipynb`, in JupyterLab: change the parameters below, and run "
            f"it again. Papermill runs it with other values in one line:\n\n```bash\n.venv/bin/papermill "
            f"notebooks/{name}.ipynb out.ipynb -p runs 4\n```\n\n[Running it](../running.md) covers other machines, "
            "clusters and the cloud.")
