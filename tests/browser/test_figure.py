"""What living figures leave in exported notebooks: a sentence, and a picture where nothing can run."""

import pytest
from computing import excerpts
from nbclient import NotebookClient
from nbconvert import HTMLExporter, MarkdownExporter
from nbformat.v4 import new_code_cell, new_notebook
from playwright.sync_api import expect

from neorl import Condition, Explorer, WaterWorld, place_cells, simulate

BEGIN = """from neorl import Condition, Explorer, Run, WaterWorld, place_cells, simulate
from companion.chapter_4.changes import Changes
from companion.chapter_5.turn import Turn
from companion.shared.replay import Replay, record
agent, tank = place_cells([3]), WaterWorld()
explorer = Explorer(Condition(agent, tank, 500, 2))"""
FIGURES = {"explorer": "An Explorer that runs PC N3, in JupyterLab or a page with JavaScript.",
           "Explorer('Arm of two links')": "An Explorer that runs Arm of two links, in JupyterLab or a page with",
           "Replay([record('a <b>', Run(agent, tank), 50)])": "A replay of 1 second of a &lt;b&gt;.",
           "Changes(Run(agent, tank), 500)": " in all, on a board of 3 × 3 cells, from",
           "Turn(*[Condition(agent, tank, 500, 1, 0, ((250, agent),))] * 2)": "An agent that avoids red creeps for a w"}
END = "explorer.show(simulate(agent, tank, steps=500, runs=2, progress=False))"


@pytest.fixture(scope="module")
def notebook(tmp_path_factory):
    """A notebook with all figures, executed, with the state of its widgets."""
    cells = [*map(new_code_cell, [BEGIN, *FIGURES, END])]
    made = new_notebook(cells=cells)
    NotebookClient(made, kernel_name="python3", resources={"metadata": {"path": tmp_path_factory.mktemp("figures")}}
                   ).execute()
    return made


def test_an_exported_page_that_is_read_offline_has_a_picture_of_each_figure(notebook, chromium, tmp_path):
    text, _ = HTMLExporter().from_notebook_node(notebook)
    (tmp_path / "page.html").write_text(text)
    context = chromium.new_context(offline=True)
    page = context.new_page()
    page.goto((tmp_path / "page.html").as_uri(), wait_until="domcontentloaded")
    pictures = page.locator(".neorl-still svg")
    expect(pictures).to_have_count(len(FIGURES))
    for picture in pictures.all():
        expect(picture).to_be_visible()
        assert picture.locator("circle, polyline").count() > 0
    assert pictures.first.locator("polyline").count() == 1  # the curve of the results that are shown in the end
    context.close()


def test_exported_markdown_says_what_each_figure_is(notebook):
    text, _ = MarkdownExporter().from_notebook_node(notebook)
    assert " at 0x" not in text and text.count("<svg") == len(FIGURES)
    assert all(sentence in text for sentence in FIGURES.values())


def test_the_book_has_the_widgets_alone_and_a_notebook_hardly_grows(notebook, tmp_path):
    sizes = [len(str(output)) for cell in notebook.cells for output in cell.outputs]
    assert len(sizes) == 2 * len(FIGURES) and max(sizes) < 4_000
    excerpts.save_widgets(notebook, tmp_path)
    assert [len(cell.outputs) for cell in notebook.cells] == [0, *[1] * len(FIGURES), 0]


def test_outside_a_notebook_a_figure_is_its_sentence(capsys):
    explorer = Explorer(Condition(place_cells([3]), WaterWorld(), 500, 1))
    explorer.show(simulate(place_cells([4]), WaterWorld(), steps=500, runs=2, progress=False))
    assert repr(explorer) == "An Explorer that runs PC N4, in JupyterLab or a page with JavaScript."
    assert capsys.readouterr().out == ""
