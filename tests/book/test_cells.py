"""A built page has its notebook's order, and shows the parameters that it was computed with."""

import sys
from pathlib import Path

from nbformat.v4 import new_code_cell, new_markdown_cell

sys.path.insert(0, str(Path(__file__).parents[2] / "book"))
import cells  # noqa: E402


def cell(source, *tags):
    return new_code_cell(source, metadata={"tags": list(tags)})


CELLS = [new_markdown_cell("# Title"), cell("runs: int = 20  # of each", "parameters"),
         cell("runs = 4", "injected-parameters"), cell("import neorl", "remove-input"), new_markdown_cell("Text.")]


def test_a_page_keeps_the_order_of_its_notebook():
    assert [each.source for each in cells.of_page(CELLS, {"runs": 1_000})] == [
        "# Title", "runs: int = 1_000  # of each", "import neorl", "Text."]


def test_only_the_parameters_that_were_given_change():
    source = "runs: int = 20\nruns_more: int = 3\nname: str = 'a'  # b"
    assert cells.with_values(source, {"runs": 4, "name": "c"}) == (
        "runs: int = 4\nruns_more: int = 3\nname: str = 'c'  # b")
