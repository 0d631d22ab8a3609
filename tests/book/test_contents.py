"""The table of contents in pictures: the first figure of each page that has one, in the order of the contents."""

import sys
from pathlib import Path

import nbformat
import pytest

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "book"))
import contents  # noqa: E402


@pytest.fixture
def chapters(tmp_path):
    """Two pages with figures, all but one of which have been drawn, and one page without."""
    def write(name, *figures):
        cells = [nbformat.v4.new_markdown_cell(f"# Page {name}\n\nText.")]
        for each in figures:
            cells.append(nbformat.v4.new_code_cell("draw()", metadata={
                "mystnb": {"figure": {"name": each, "caption": "C"}, "image": {"alt": f"Alt of {each}."}}}))
        nbformat.write(nbformat.v4.new_notebook(cells=cells), tmp_path / f"{name}.ipynb")

    write("a", "fig-missing", "fig-a", "fig-later")
    write("b")
    write("c", "fig-c")
    for name in ("fig-a", "fig-later", "fig-c"):
        (tmp_path / f"{name}.svg").touch()
    return tmp_path


def test_each_page_with_a_figure_has_a_card_with_its_first_one(chapters):
    toc = "- file: index\n- file: chapters/c\n- file: chapters/a\n- file: chapters/b\n- file: chapters/gone\n"
    text = contents.pictures(toc, chapters)
    assert text.count(":::{grid-item-card}") == 2 and text.startswith("::::{grid}") and text.endswith("::::\n")
    assert text.index("Page c") < text.index("Page a")
    assert (":link: chapters/a\n:link-type: doc\n:img-top: chapters/fig-a.svg\n:img-alt: Alt of fig-a.\n\nPage a\n:::"
            in text)
