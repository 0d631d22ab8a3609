"""A page of the book, computed from its notebook, and what other pages include of it."""

import base64
import json
import os
import subprocess
import sys

from computing import compute
from computing import excerpts
import nbformat
import pytest



@pytest.fixture
def notebook(tmp_path, cache_folder, monkeypatch):
    """A notebook with two code cells, and a folder of pages of its own."""
    monkeypatch.setattr(compute, "CHAPTERS", tmp_path / "chapters")
    cells = [nbformat.v4.new_markdown_cell("# Page"),
             nbformat.v4.new_code_cell("runs: int = 20", metadata={"tags": ["parameters"]}),
             nbformat.v4.new_markdown_cell("[Sources](../book/sources.md) of [maps](../book/glossary.md#nres-map)"),
             nbformat.v4.new_code_cell("assert runs != 13\nprint(runs)")]
    metadata = {"kernelspec": {"name": "python3", "display_name": "Python 3", "language": "python"}}
    path = tmp_path / "page.ipynb"
    nbformat.write(nbformat.v4.new_notebook(cells=cells, metadata=metadata), path)
    return path


def change_last_cell(notebook, source, **metadata):
    page = nbformat.read(notebook, 4)
    page.cells[-1].source, page.cells[-1].metadata = source, metadata
    nbformat.write(page, notebook)


def test_a_parameter_that_the_notebook_does_not_have_is_refused(notebook):
    with pytest.raises(ValueError, match="a parameter of page.ipynb must be runs.*, but is runz, 4"):
        compute.compute(notebook, {"runz": 4})
    assert not compute.CHAPTERS.exists()


@pytest.mark.filterwarnings("ignore")
def test_a_page_has_the_values_used_and_links_of_its_own_and_a_failure_leaves_it_as_it_was(notebook, monkeypatch):
    page = compute.CHAPTERS / "page.ipynb"
    compute.compute(notebook, {"runs": 3})
    executed = nbformat.read(page, 4)
    assert executed.cells[1].source == "runs: int = 3" and executed.cells[3].outputs[0].text == "3\n"
    assert executed.cells[2].source == "[Sources](../sources.md) of {term}`maps <NRES map>`"
    assert [path.name for path in compute.CHAPTERS.iterdir()] == ["page.ipynb"]

    monkeypatch.setattr("sys.argv", ["compute.py", str(notebook), "--runs", "13"])
    with pytest.raises(SystemExit, match=r"runs != 13(.|\n)*page.ipynb, In \[3\]: AssertionError: "):
        compute.main()
    assert nbformat.read(page, 4) == executed
    assert (compute.work_of(notebook) / "page.ipynb").exists()  # shows how far the notebook got


@pytest.mark.filterwarnings("ignore")
def test_a_kernel_that_dies_is_noticed(notebook, monkeypatch):
    change_last_cell(notebook, "import os, signal; os.kill(os.getpid(), signal.SIGKILL)")
    monkeypatch.setattr("sys.argv", ["compute.py", str(notebook)])
    with pytest.raises(SystemExit, match="page.ipynb: its kernel has died, perhaps for lack of memory"):
        compute.main()


@pytest.mark.filterwarnings("ignore")
def test_a_page_keeps_its_widgets(notebook):
    source = """import anywidget, traitlets
class Counter(anywidget.AnyWidget):
    _esm = "export default {}"
    count = traitlets.Int(1).tag(sync=True)
    data = traitlets.Bytes(b"").tag(sync=True)
hidden, counter = Counter(count=7), Counter(data=bytes(range(256)))
counter.count = 2
counter"""
    change_last_cell(notebook, source, widget={"name": "counter"})
    compute.compute(notebook, {"runs": 3})
    state = nbformat.read(compute.CHAPTERS / "page.ipynb", 4).metadata.widgets[excerpts.WIDGET_STATE]["state"]
    (shown,) = [each for each in state.values() if "count" in each["state"]]
    assert shown["state"]["count"] == 2 and shown["state"]["_esm"] == "export default {}"
    (buffer,) = shown["buffers"]
    assert buffer["path"] == ["data"] and base64.b64decode(buffer["data"]) == bytes(range(256))
    assert buffer["data"] in (compute.CHAPTERS / "counter.html").read_text()


@pytest.mark.filterwarnings("ignore")
def test_what_a_notebook_has_found_is_beside_its_page(notebook):
    change_last_cell(notebook, "from companion.page import report\nreport.save('page', shares={'A2': "
                               "{'agrees': 1, 'measured': 4}})")
    compute.compute(notebook, {"runs": 3})
    assert json.loads((compute.CHAPTERS / "page.claims.json").read_text())["shares"]["A2"]["measured"] == 4
    change_last_cell(notebook, "pass")
    compute.compute(notebook, {"runs": 3})
    assert not (compute.CHAPTERS / "page.claims.json").exists()


@pytest.mark.filterwarnings("ignore")
def test_two_processes_compute_a_page_at_once_and_clear_what_a_killed_one_has_left(notebook, monkeypatch):
    ended = subprocess.Popen([sys.executable, "-c", ""])
    ended.wait()
    for pid in (ended.pid, os.getppid()):
        (compute.CHAPTERS / f".page-{pid}").mkdir(parents=True)
    compute.compute(notebook, {"runs": 3})
    assert sorted(path.name for path in compute.CHAPTERS.iterdir()) == [f".page-{os.getppid()}", "page.ipynb"]


def test_links_into_the_glossary_become_references_to_its_terms():
    text = ("A [map of cells](../book/glossary.md#nres-map), [off-policy](../book/glossary.md#off-policy), "
            "[s](../book/s.md)")
    assert compute.link_terms(text) == (
        "A {term}`map of cells <NRES map>`, {term}`off-policy <off-policy>`, [s](../book/s.md)")
    assert compute.link_terms("[*map*](../book/glossary.md#nres-map)") == "*{term}`map <NRES map>`*"
    assert compute.link_terms("[lost](../book/glossary.md#lost)") == "{term}`lost <lost>`"  # Sphinx warns about it
