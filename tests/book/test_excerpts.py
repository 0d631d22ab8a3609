"""Figures and widgets are saved beside their page, each widget with the state that it needs, and run on any page."""

import io
import json
import re
import shutil
from pathlib import Path

from computing import excerpts
import nbformat
import numpy as np
import pytest
from companion.page import found
from computing.cells import LABEL, of_page
from computing.excerpts import without_ground
from matplotlib import pyplot as plt

from neorl.drawing import STYLE

TEXT = "</script><!-- <script> </SCRIPT >"  # must not end the tag that contains it


def anywidget(**values):
    esm = f"export default {{ render({{ el }}) {{ el.append({json.dumps(TEXT)}); el.className = 'shown'; }} }}"
    return {"model_module": "anywidget", "state": {"_esm": esm, **values}}


def page_of_widgets(*cells):
    """A notebook that stores four models, one of which refers to two others, and whose cells show the given ones."""
    state = {"one": anywidget(layout="IPY_MODEL_two", parts=[{"part": "anywidget:three"}], lost="IPY_MODEL_lost"),
             "two": {"model_module": "@jupyter-widgets/base", "state": {"_view_name": "LayoutView"}},
             "three": anywidget(parent="IPY_MODEL_one"), "four": anywidget()}
    widgets = {excerpts.WIDGET_STATE: {"version_major": 2, "version_minor": 0, "state": state}}
    page = nbformat.v4.new_notebook(metadata={"widgets": widgets})
    for name, models in cells:
        views = [nbformat.v4.new_output("display_data", {excerpts.WIDGET_VIEW: {"model_id": each}}) for each in models]
        cell = nbformat.v4.new_code_cell(outputs=views, metadata={"widget": {"name": name}} if name else {})
        page.cells += [cell, nbformat.v4.new_markdown_cell("Prose.")]
    return page


def contents(folder, name):
    """The JSON in the two tags of a named widget: the state by model, and the view."""
    lines = (folder / f"{name}.html").read_text().splitlines()
    tags = [f'<script type="{kind}">' for kind in (excerpts.WIDGET_STATE, excerpts.WIDGET_VIEW)]
    state, view = [json.loads(line.removeprefix(tag).removesuffix("</script>"))
                   for line, tag in zip(lines, tags, strict=True)]
    return state["state"], view


def test_a_named_widget_is_saved_with_the_state_of_all_that_it_refers_to(tmp_path):
    page = page_of_widgets(("first", ["one"]), (None, ["four"]), ("last", ["four"]))
    stored = page.metadata.widgets[excerpts.WIDGET_STATE].state.copy()
    excerpts.save_widgets(page, tmp_path)
    state = {model: stored[model] for model in ["one", "two", "three"]}
    assert contents(tmp_path, "first") == (state, {"model_id": "one"})
    assert contents(tmp_path, "last") == ({"four": stored["four"]}, {"model_id": "four"})
    assert sorted(path.name for path in tmp_path.iterdir()) == ["first.html", "last.html"]


def test_the_state_of_widgets_that_a_page_does_not_show_is_dropped(tmp_path):
    for models, kept in [(["four"], {"four"}), (["one", "four"], {"one", "two", "three", "four"}), ([], set())]:
        page = page_of_widgets((None, models))
        excerpts.save_widgets(page, tmp_path)
        assert set(page.metadata.widgets[excerpts.WIDGET_STATE].state) == kept
    page = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell()])
    excerpts.save_widgets(page, tmp_path)
    assert page.metadata == {}
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("models", [[], ["one", "four"]])
def test_a_named_cell_shows_one_widget(tmp_path, models):
    message = f"cell of widget first must show one widget, but shows {len(models)}"
    with pytest.raises(ValueError, match=message):
        excerpts.save_widgets(page_of_widgets(("first", models)), tmp_path)


def test_a_saved_widget_runs_on_any_page(tmp_path, open_page):
    excerpts.save_widgets(page_of_widgets(("first", ["one"])), tmp_path)
    shutil.copy(Path(excerpts.__file__).parents[1] / "vendor" / "widgets.js", tmp_path)
    head = '<!doctype html><link rel="icon" href="data:,"><script defer src="widgets.js"></script><body>'
    (tmp_path / "page.html").write_text(f"{head}{(tmp_path / 'first.html').read_text()}<p>The end.</p>")
    page = open_page(tmp_path, "page.html", over="file")
    assert page.locator(".shown").inner_text() == TEXT
    assert page.locator("p").inner_text() == "The end."


def test_figures_are_saved_by_name_and_the_first_small_without_letters_too(tmp_path):
    plt.title("title")
    plt.savefig(drawn := io.StringIO(), format="svg")
    output = nbformat.v4.new_output("display_data", {"image/svg+xml": drawn.getvalue()})
    cells = [nbformat.v4.new_code_cell(outputs=[output], metadata={"mystnb": {"figure": figure}})
             for figure in ({}, {"name": "fig-one"}, {"name": "fig-two"})]
    excerpts.save_figures(nbformat.v4.new_notebook(cells=cells), tmp_path)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["fig-one-small.svg", "fig-one.svg", "fig-two.svg"]
    assert ['id="text_' in (tmp_path / f"fig-one{which}.svg").read_text() for which in ("", "-small")] == [True, False]


def test_a_figure_whose_paths_draw_nothing_has_a_small_one():
    plt.errorbar([0, 1], [1.0, 2.0], yerr=[np.nan, np.nan])  # as of one run
    plt.savefig(drawn := io.StringIO(), format="svg")
    whiskers, = re.findall(r'<g id="LineCollection_1">.*?</g>', drawn.getvalue(), re.DOTALL)
    assert whiskers.count("<path") == 2 and " d=" not in whiskers
    paths = re.findall("<path [^>]*", excerpts.small(drawn.getvalue()))
    assert len([each for each in paths if " d=" not in each]) == 2 and any(' d="M ' in each for each in paths)


def test_the_book_s_figures_have_no_ground_since_its_style_sheet_knows_the_page():
    with plt.rc_context(STYLE):
        plt.figure().add_subplot().add_patch(plt.Circle((0, 0), 1, facecolor="#ffffff"))
        plt.savefig(drawn := io.StringIO(), format="svg")
    before, after = (each.count("fill: #ffffff") for each in (drawn.getvalue(), without_ground(drawn.getvalue())))
    assert (before, after) == (2, 1) and without_ground("<svg></svg>") == "<svg></svg>"


def test_captions_and_titles_of_folds_are_the_book_s_and_cells_of_papermill_are_left_out():
    figure = nbformat.v4.new_code_cell("# Rewards, run by run\ndraw()", metadata={
        "mystnb": {"figure": {"name": "fig-one"}}, "tags": ["hide-cell"]})
    caption = nbformat.v4.new_markdown_cell(f"{LABEL}Rewards\nof *runs*.", metadata={"tags": ["caption"]})
    parameters = nbformat.v4.new_code_cell("runs: int = 4  # of each", metadata={"tags": ["parameters"]})
    injected = nbformat.v4.new_code_cell("runs = 2", metadata={"tags": ["injected-parameters"]})
    shown = found("Here", {"N7": 0.1, "all": 0.6})
    figure.outputs = [nbformat.v4.new_output("display_data", {"text/html": shown.data},
                                             metadata={"text/html": shown.metadata})]
    parameters, figure = of_page([parameters, injected, figure, caption], {"runs": 2})
    assert (parameters.source, figure.source) == ("runs: int = 2  # of each", "draw()")
    assert figure.metadata["mystnb"] == {
        "figure": {"name": "fig-one", "caption": "Rewards of *runs*. Here: N7 0.10 and all 0.60."},
        "code_prompt_show": "Rewards, run by run", "code_prompt_hide": "Rewards, run by run"}
    assert not figure.outputs  # which says the same below the figure
