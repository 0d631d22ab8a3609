"""What the cells of a notebook define, for tests: a page's world, rules and toy systems are cells of its notebook."""

import json
from pathlib import Path
from types import SimpleNamespace

NOTEBOOKS = Path(__file__).parents[1] / "notebooks"


def source(page, cell):
    """The code in the cell of a page, by the names of both."""
    cells = json.loads((NOTEBOOKS / f"{page}.ipynb").read_text(encoding="utf-8"))["cells"]
    (found,) = ["".join(each["source"]) for each in cells if each["id"] == cell]
    return found


def defined(page, *cells, **given):
    """The names that cells define, as attributes. given: names that they look up, such as those of folded imports."""
    names = {"__name__": f"cells_of_{page}", **given}
    for cell in cells:
        exec(compile(source(page, cell), f"{page}.ipynb, {cell}", "exec"), names)
    return SimpleNamespace(**names)
