"""The order of a built page: results first, parameters last, and only the cell that papermill injects is removed."""

import sys
from pathlib import Path

from nbformat.v4 import new_code_cell, new_markdown_cell

sys.path.insert(0, str(Path(__file__).parents[2] / "book"))
import page_order  # noqa: E402


def cell(source, *tags):
    return new_code_cell(source, metadata={"tags": list(tags)})


CELLS = [new_markdown_cell("# Title"), cell("runs: int = 20  # of each", "parameters"),
         cell("runs = 4", "injected-parameters"), cell("import neorl", "remove-input"), new_markdown_cell("Text."),
         cell("figure", "hide-input", "found"), cell("other", "hide-input"), cell("box", "remove-input", "found")]
CELLS[5].metadata.mystnb = {"figure": {"name": "fig"}}


def test_a_page_opens_with_its_title_and_what_was_found_and_ends_with_its_parameters():
    ordered = page_order.results_first([each.copy() for each in CELLS], "page", {"runs": 1_000}, 30.0)
    *others, heading, parameters = ordered
    assert [each.source for each in others] == ["# Title", "box", "figure", "import neorl", "Text.", "other"]
    assert heading.source.startswith("## Run it yourself") and "took 30 seconds" in heading.source
    assert "notebooks/page.ipynb out.ipynb -p runs 4" in heading.source
    assert parameters.source == "runs: int = 1_000  # of each"
    assert page_order.tags(parameters) == {"parameters", "hide-input"}


def test_a_page_that_holds_its_experiment_keeps_its_order():
    kept = [each.copy() for each in CELLS if "found" not in page_order.tags(each)]
    ordered = page_order.results_first(kept, "page", {"runs": 4}, 30.0)
    assert [each.source for each in ordered] == ["# Title", "runs: int = 4  # of each", "import neorl", "Text.",
                                                 "other"]


def test_only_the_parameters_that_were_given_change():
    source = "runs: int = 20\nruns_more: int = 3\nname: str = 'a'  # b"
    assert page_order.with_values(source, {"runs": 4, "name": "c"}) == (
        "runs: int = 4\nruns_more: int = 3\nname: str = 'c'  # b")


def test_long_times_are_in_minutes():
    assert "took 89 seconds" in page_order.run_it_yourself("page", 89.0)
    assert "took 2 minutes" in page_order.run_it_yourself("page", 120.0)
