"""A page speaks of no part of a figure that its parameters leave out, such as the thesis's own levels."""

import json
import re

import page_cells
import pytest
from matplotlib import pyplot as plt
from matplotlib.text import Annotation, Text
from page_cells import NOTEBOOKS, code, executed

WORDS = {"dashed": r"[Dd]ashed", "thesis": r"the (thesis|paper)('s number| reports)"}  # what speaks of a part


def parts():
    """The parts of `WORDS` that the open figures have."""
    found = [each for number in plt.get_fignums() for each in plt.figure(number).findobj()]
    arrows = [each.arrow_patch for each in found if isinstance(each, Annotation) and each.arrow_patch]
    return {"dashed"} & {"dashed" for each in (*found, *arrows) if getattr(each, "get_linestyle", str)() == "--"} | {
        "thesis" for each in found if isinstance(each, Text) and "thesis" in each.get_text()}


@pytest.mark.parametrize("page, others", [
    ("paper_a", {"layers": "[5, 11]"}), ("paper_a", {"n_creeps": 3}), ("paper_b", {"n_creeps": 5}),
    ("paper_b", {"resolutions": "[2, 4]"}), ("paper_c", {"n_creeps": 5}), ("paper_c", {"recursion": 0.5})])
def test_captions_and_prose_speak_of_what_is_drawn(page, others, monkeypatch):
    drawn, close = [], plt.close
    monkeypatch.setattr(page_cells.plt, "close", lambda *which: (drawn.append(parts()), close(*which)))
    executed.__wrapped__(page, **others)
    of_cell = dict(zip(code(page), drawn, strict=True))
    shown = set()
    for cell in json.loads((NOTEBOOKS / f"{page}.ipynb").read_text(encoding="utf-8"))["cells"]:
        text = " ".join("".join(cell["source"]).split())
        if cell["cell_type"] == "code":
            shown = of_cell[cell["id"]]
        elif "caption" in cell["metadata"].get("tags", ()):
            assert {part for part, words in WORDS.items() if re.search(words, text)} <= shown, text
        else:
            assert "dashed line" not in text
