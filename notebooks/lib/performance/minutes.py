"""Where the build time of the book goes, by the times that papermill recorded in the pages that it computed.

A page's time is split by what its cells do: import the package, draw a figure, or anything else, that is, compile and
simulate. Results found in the cache took no time.
"""

import json
import re
from pathlib import Path
from typing import NamedTuple


class PageTime(NamedTuple):
    """The seconds that a page took to compute."""

    page: str
    starting: float  # the interpreter that its cells run in
    importing: float
    computing: float
    drawing: float

    @property
    def total(self):
        """The sum of all parts."""
        return self.starting + self.importing + self.computing + self.drawing


def of_pages(folder):
    """The times of the computed pages in a folder, which need not exist: a list of `PageTime`, the longest first."""
    found = [_of_page(path) for path in sorted(Path(folder).glob("*.ipynb"))]
    return sorted((each for each in found if each), key=lambda each: -each.total)


def _of_page(path):
    """The `PageTime` of one file, or None if it has none."""
    try:
        page = json.loads(path.read_text(encoding="utf-8"))
        total, spent = page["metadata"]["papermill"]["duration"], {"importing": 0.0, "computing": 0.0, "drawing": 0.0}
        for cell in page["cells"]:
            spent[_kind(cell)] += cell["metadata"].get("papermill", {}).get("duration") or 0.0
    except (ValueError, KeyError):
        return None
    return PageTime(path.stem, max(0.0, total - sum(spent.values())), **spent) if total else None


def _kind(cell):
    if "figure" in cell["metadata"].get("mystnb", {}):
        return "drawing"
    return "importing" if re.search(r"^(import|from) neorl", "".join(cell["source"]), re.MULTILINE) else "computing"
