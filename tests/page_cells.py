"""What the cells of a notebook define, for tests: a page's world, rules and toy systems are cells of its notebook."""

import json
from pathlib import Path
from types import SimpleNamespace

NOTEBOOKS = Path(__file__).parents[1] / "notebooks"


def code(page):
    """The code in the cells of a page, in their order: {cell: source}."""
    cells = json.loads((NOTEBOOKS / f"{page}.ipynb").read_text(encoding="utf-8"))["cells"]
    return {each["id"]: "".join(each["source"]) for each in cells if each["cell_type"] == "code"}


def source(page, cell):
    return code(page)[cell]


def defined(page, *cells, **given):
    """The names that cells define, as attributes. given: names that they look up, such as those of folded imports."""
    names = {"__name__": f"cells_of_{page}", **given}
    for cell in cells:
        exec(compile(source(page, cell), f"{page}.ipynb, {cell}", "exec"), names)
    return SimpleNamespace(**names)


def planned(page, *cells, until=(), **given):
    """The names that a page's parameters, imports and some of its cells define, with conditions in place of results.

    until: lines that need results; a cell ends before the first of them. given: other values of names.
    """
    parameters, imports, *_ = code(page).values()
    names = {"__name__": f"cells_of_{page}"}
    exec(parameters, names)
    chosen = {name: value for name, value in given.items() if name in names}
    names |= chosen
    exec(imports, names)  # lists become tuples
    names |= {"sweep": iter, **{name: value for name, value in given.items() if name not in chosen}}
    for cell in cells:
        text = source(page, cell)
        for line in until:
            text = text.partition(line)[0]
        exec(compile(text, f"{page}.ipynb, {cell}", "exec"), names)
    return names
