"""The building of the book: what it refuses, and when it has nothing to do."""

import base64
import json
import shutil
import subprocess
import sys
from pathlib import Path

import nbformat
import pytest

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "book"))
import build  # noqa: E402


@pytest.fixture
def notebook(tmp_path, monkeypatch):
    """A notebook of two cells, and chapters of its own."""
    monkeypatch.setattr(build, "CHAPTERS", tmp_path / "chapters")
    cells = [nbformat.v4.new_code_cell("runs: int = 20", metadata={"tags": ["parameters"]}),
             nbformat.v4.new_markdown_cell("[Sources](../book/sources.md) of [maps](../book/glossary.md#nres-map)"),
             nbformat.v4.new_code_cell("assert runs != 13\nprint(runs)")]
    metadata = {"kernelspec": {"name": "python3", "display_name": "Python 3", "language": "python"}}
    path = tmp_path / "page.ipynb"
    nbformat.write(nbformat.v4.new_notebook(cells=cells, metadata=metadata), path)
    return path


def test_a_parameter_that_the_notebook_does_not_have_is_refused(notebook):
    with pytest.raises(ValueError, match="parameter runz is 4, allowed for page.ipynb are runs"):
        build.check_parameters(notebook, {"runz": 4})
    assert not build.CHAPTERS.exists()


@pytest.mark.filterwarnings("ignore")
def test_a_notebook_is_computed_when_something_has_changed_and_kept_when_not(notebook, monkeypatch, capsys):
    target = build.CHAPTERS / "page.ipynb"
    build.compute(notebook, {"runs": 3})
    executed = nbformat.read(target, 4)
    assert executed.cells[-1].outputs[0].text == "3\n"
    assert executed.cells[2].source == "[Sources](../sources.md) of {term}`maps <NRES map>`"
    assert json.loads((build.CHAPTERS / "page.inputs.json").read_text())["parameters"] == {"runs": 3}

    before = target.stat().st_mtime_ns
    build.compute(notebook, {"runs": 3})
    assert target.stat().st_mtime_ns == before
    assert "nothing has changed" in capsys.readouterr().out

    with pytest.raises(build.PapermillExecutionError):
        build.compute(notebook, {"runs": 13})
    assert nbformat.read(target, 4).cells[-1].outputs[0].text == "3\n"  # a failure leaves the page alone
    assert (build.CHAPTERS / ".page" / "page.ipynb").exists()  # and shows how far it came
    build.compute(notebook, {"runs": 4})
    assert nbformat.read(target, 4).cells[-1].outputs[0].text == "4\n"
    assert sorted(path.name for path in build.CHAPTERS.iterdir()) == ["page.inputs.json", "page.ipynb"]


TEXT = "</script><!-- <script> </SCRIPT >"  # which must not end the tag that holds it


def anywidget(**values):
    esm = f"export default {{ render({{ el }}) {{ el.append({json.dumps(TEXT)}); el.className = 'told'; }} }}"
    return {"model_module": "anywidget", "state": {"_esm": esm, **values}}


def page_of_widgets(*cells):
    """A notebook that has stored four models, of which one refers to two others, and shows those that are asked for."""
    state = {"one": anywidget(layout="IPY_MODEL_two", parts=[{"part": "anywidget:three"}], lost="IPY_MODEL_lost"),
             "two": {"model_module": "@jupyter-widgets/base", "state": {"_view_name": "LayoutView"}},
             "three": anywidget(parent="IPY_MODEL_one"), "four": anywidget()}
    widgets = {build.WIDGET_STATE: {"version_major": 2, "version_minor": 0, "state": state}}
    page = nbformat.v4.new_notebook(metadata={"widgets": widgets})
    for name, models in cells:
        views = [nbformat.v4.new_output("display_data", {build.WIDGET_VIEW: {"model_id": model}}) for model in models]
        cell = nbformat.v4.new_code_cell(outputs=views, metadata={"widget": {"name": name}} if name else {})
        page.cells += [cell, nbformat.v4.new_markdown_cell("Prose.")]
    return page


def contents(name):
    """The JSON of the two tags of a named widget: the state by model, and the view."""
    lines = (build.CHAPTERS / f"{name}.html").read_text().splitlines()
    tags = [f'<script type="{kind}">' for kind in (build.WIDGET_STATE, build.WIDGET_VIEW)]
    state, view = [json.loads(line.removeprefix(tag).removesuffix("</script>"))
                   for line, tag in zip(lines, tags, strict=True)]
    return state["state"], view


@pytest.fixture
def chapters(tmp_path, monkeypatch):
    monkeypatch.setattr(build, "CHAPTERS", tmp_path)
    return tmp_path


def test_a_named_widget_is_saved_with_the_state_of_all_that_it_refers_to(chapters):
    page = page_of_widgets(("first", ["one"]), (None, ["four"]), ("last", ["four"]))
    stored = page.metadata.widgets[build.WIDGET_STATE].state.copy()
    build.save_widgets(page)
    assert contents("first") == ({model: stored[model] for model in ["one", "two", "three"]}, {"model_id": "one"})
    assert contents("last") == ({"four": stored["four"]}, {"model_id": "four"})
    assert sorted(path.name for path in chapters.iterdir()) == ["first.html", "last.html"]


def test_the_state_of_widgets_that_a_page_does_not_show_is_dropped(chapters):
    for models, kept in [(["four"], {"four"}), (["one", "four"], {"one", "two", "three", "four"}), ([], set())]:
        page = page_of_widgets((None, models))
        build.save_widgets(page)
        assert set(page.metadata.widgets[build.WIDGET_STATE].state) == kept
    page = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell()])
    build.save_widgets(page)
    assert page.metadata == {}
    assert not list(chapters.iterdir())


@pytest.mark.parametrize("models", [[], ["one", "four"]])
def test_a_named_cell_shows_one_widget(chapters, models):
    message = f"cell of widget first shows {len(models)} widgets, allowed is 1"
    with pytest.raises(ValueError, match=message):
        build.save_widgets(page_of_widgets(("first", models)))


def test_a_saved_widget_lives_on_any_page(chapters, open_page):
    build.save_widgets(page_of_widgets(("first", ["one"])))
    shutil.copy(ROOT / "book" / "vendor" / "widgets.js", chapters)
    head = '<!doctype html><link rel="icon" href="data:,"><script defer src="widgets.js"></script><body>'
    (chapters / "page.html").write_text(f"{head}{(chapters / 'first.html').read_text()}<p>The end.</p>")
    page = open_page(chapters, "page.html", over="file")
    assert page.locator(".told").inner_text() == TEXT
    assert page.locator("p").inner_text() == "The end."


@pytest.mark.filterwarnings("ignore")
def test_a_computed_notebook_keeps_its_widgets(notebook):
    page = nbformat.read(notebook, 4)
    source = """import anywidget, traitlets
class Counter(anywidget.AnyWidget):
    _esm = "export default {}"
    count = traitlets.Int(1).tag(sync=True)
    data = traitlets.Bytes(b"").tag(sync=True)
hidden, counter = Counter(count=7), Counter(data=bytes(range(256)))
counter.count = 2
counter"""
    page.cells.append(nbformat.v4.new_code_cell(source, metadata={"widget": {"name": "counter"}}))
    nbformat.write(page, notebook)
    build.compute(notebook, {"runs": 3})
    state, view = contents("counter")
    assert state[view["model_id"]]["state"]["count"] == 2
    assert state[view["model_id"]]["state"]["_esm"] == "export default {}"
    (buffer,) = state[view["model_id"]]["buffers"]
    assert buffer["path"] == ["data"] and base64.b64decode(buffer["data"]) == bytes(range(256))
    kept = nbformat.read(build.CHAPTERS / "page.ipynb", 4).metadata.widgets[build.WIDGET_STATE]["state"]
    assert kept == state


@pytest.mark.parametrize("runs", ["0", "-3", "many", "2.5"])
def test_bad_runs_are_refused_before_anything_runs(runs):
    command = [sys.executable, ROOT / "book" / "build.py", "--runs", runs]
    refused = subprocess.run(command, capture_output=True, text=True)
    assert refused.returncode != 0
    assert "--runs" in refused.stderr and "allowed are integers ≥ 1" in refused.stderr


@pytest.mark.parametrize("runs, points", [(1, 4), (4, 4), (10, 16), (20, 32), (79, 64), (80, 128), (100, 128)])
def test_the_assumptions_are_varied_in_a_power_of_two_of_readings(runs, points):
    assert build.points(runs) == points


@pytest.mark.filterwarnings("ignore")
def test_what_a_notebook_has_found_stands_beside_its_page_and_in_the_table_of_all_claims(notebook, tmp_path,
                                                                                          monkeypatch):
    monkeypatch.setenv("NEORL_CACHE", str(tmp_path / "cache"))
    content = nbformat.read(notebook, 4)
    content.cells[2].source = ("from neorl.evidence import report\nreport.save('page', shares={'A2': "
                               "{'holds': 1, 'undecided': 1, 'untestable': 0, 'readings': 4}})")
    nbformat.write(content, notebook)
    build.compute(notebook, {"runs": 3})
    build.write_claims()
    table = (build.CHAPTERS / "claims-table.md").read_text()
    assert "| short runs: 25\u00a0% of 4, 25\u00a0% undecided |" in table
    assert table.count("not computed in this build") == 28
    written = (build.CHAPTERS / "claims-table.md").stat().st_mtime_ns
    build.write_claims()
    assert (build.CHAPTERS / "claims-table.md").stat().st_mtime_ns == written


def test_links_into_the_glossary_become_references_to_its_terms():
    text = ("A [map of cells](../book/glossary.md#nres-map), [off-policy](../book/glossary.md#off-policy), "
            "[s](../book/s.md)")
    assert build.link_terms(text) == (
        "A {term}`map of cells <NRES map>`, {term}`off-policy <off-policy>`, [s](../book/s.md)")
    assert build.link_terms("[lost](../book/glossary.md#lost)") == "{term}`lost <lost>`"  # which Sphinx complains about


def test_papers_come_after_the_shares_that_they_read_and_the_conclusion_after_all_that_finds():
    names = ["assumptions", "another", "chapter_1", "chapter_5", "paper_a", "paper_b", "performance"]
    order = [path.stem for path in sorted(sorted(map(Path, names)), key=build.turn)]
    assert order == ["another", "assumptions", "chapter_1", "paper_a", "paper_b", "chapter_5", "performance"]
    found = {path.stem for path in (ROOT / "notebooks").glob("*.ipynb")}
    assert found == {name for names in build.ROUNDS for name in names}


@pytest.mark.filterwarnings("ignore")
def test_what_went_wrong_in_a_process_is_told_as_text(notebook):
    assert build.attempt(notebook, {"runs": 3}) is None
    assert "Exception encountered" in build.attempt(notebook, {"runs": 13})


def test_the_conclusion_reads_all_other_records_and_every_other_page_the_shares(chapters):
    for name in ("assumptions", "chapter_5", "paper_a"):
        (chapters / f"{name}.claims.json").write_text("{}")
    read = {page: [path.name.split(".")[0] for path in build.records(Path(f"{page}.ipynb"))]
            for page in ("assumptions", "paper_a", "calibration", "chapter_5")}
    assert read == {"assumptions": [], "paper_a": ["assumptions"], "calibration": ["assumptions"],
                    "chapter_5": ["assumptions", "paper_a"]}


@pytest.mark.filterwarnings("ignore")
def test_the_conclusion_is_computed_again_when_a_claim_has_changed(notebook, capsys):
    conclusion = notebook.rename(notebook.with_name("chapter_5.ipynb"))
    build.compute(conclusion, {"runs": 3})
    build.compute(conclusion, {"runs": 3})
    assert capsys.readouterr().out.count("nothing has changed") == 1
    (build.CHAPTERS / "paper_a.claims.json").write_text("{}")
    build.compute(conclusion, {"runs": 3})
    assert "nothing has changed" not in capsys.readouterr().out
