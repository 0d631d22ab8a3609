"""The build of the book: what it refuses, what it recomputes, and what it keeps."""

import base64
import json
import shutil
import subprocess
import sys
from pathlib import Path

import build
import excerpts
import nbformat
import pytest


@pytest.fixture
def notebook(tmp_path, monkeypatch):
    """A notebook with two code cells, and an output folder of its own."""
    monkeypatch.setattr(build, "CHAPTERS", tmp_path / "chapters")
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


@pytest.fixture
def chapters(tmp_path, monkeypatch):
    monkeypatch.setattr(build, "CHAPTERS", tmp_path)
    return tmp_path


def test_a_parameter_that_the_notebook_does_not_have_is_refused(notebook):
    with pytest.raises(ValueError, match="a parameter of page.ipynb must be runs.*, but is runz, 4"):
        build.check_parameters(notebook, {"runz": 4})
    assert not build.CHAPTERS.exists()


@pytest.mark.filterwarnings("ignore")
def test_a_notebook_is_computed_when_something_has_changed_and_kept_when_not(notebook, monkeypatch, capsys):
    target = build.CHAPTERS / "page.ipynb"
    build.compute(notebook, {"runs": 3})
    executed = nbformat.read(target, 4)
    assert executed.cells[3].outputs[0].text == "3\n"
    assert executed.cells[2].source == "[Sources](../sources.md) of {term}`maps <NRES map>`"
    assert json.loads((build.CHAPTERS / "page.inputs.json").read_text())["parameters"] == {"runs": 3}

    before = target.stat().st_mtime_ns
    build.compute(notebook, {"runs": 3})
    assert target.stat().st_mtime_ns == before
    assert "nothing has changed" in capsys.readouterr().out

    assert build.attempt(notebook, {"runs": 13}) == 1
    said = capsys.readouterr().out
    assert "page.ipynb, In [3]: AssertionError: " in said and "runs != 13" in said
    assert nbformat.read(target, 4).cells[3].outputs[0].text == "3\n"  # a failure leaves the page as it was
    assert (build.CHAPTERS / ".page" / "page.ipynb").exists()  # and shows how far the notebook got
    build.compute(notebook, {"runs": 4})
    assert nbformat.read(target, 4).cells[3].outputs[0].text == "4\n"
    assert sorted(path.name for path in build.CHAPTERS.iterdir()) == ["page.inputs.json", "page.ipynb"]


NOTES_INTERRUPTION = """
import pathlib, signal
noted = pathlib.Path({path!r})
get_ipython().kernel.post_handler_hook = lambda: signal.signal(signal.SIGINT, lambda *_: noted.touch())
"""


@pytest.mark.filterwarnings("ignore")
def test_a_kernel_is_not_interrupted_when_its_notebook_is_done(notebook, tmp_path):
    change_last_cell(notebook, NOTES_INTERRUPTION.format(path=str(tmp_path / "noted")))
    build.compute(notebook, {"runs": 3})
    assert not (tmp_path / "noted").exists()


@pytest.mark.filterwarnings("ignore")
def test_a_computed_notebook_keeps_its_widgets(notebook):
    source = """import anywidget, traitlets
class Counter(anywidget.AnyWidget):
    _esm = "export default {}"
    count = traitlets.Int(1).tag(sync=True)
    data = traitlets.Bytes(b"").tag(sync=True)
hidden, counter = Counter(count=7), Counter(data=bytes(range(256)))
counter.count = 2
counter"""
    change_last_cell(notebook, source, widget={"name": "counter"})
    build.compute(notebook, {"runs": 3})
    state = nbformat.read(build.CHAPTERS / "page.ipynb", 4).metadata.widgets[excerpts.WIDGET_STATE]["state"]
    (shown,) = [each for each in state.values() if "count" in each["state"]]
    assert shown["state"]["count"] == 2 and shown["state"]["_esm"] == "export default {}"
    (buffer,) = shown["buffers"]
    assert buffer["path"] == ["data"] and base64.b64decode(buffer["data"]) == bytes(range(256))
    assert buffer["data"] in (build.CHAPTERS / "counter.html").read_text()


@pytest.mark.parametrize("runs", ["0", "2.5"])
def test_bad_runs_are_refused_before_anything_runs(runs):
    command = [sys.executable, build.__file__, "--runs", runs]
    refused = subprocess.run(command, capture_output=True, text=True)
    assert refused.returncode != 0
    assert "--runs" in refused.stderr and "must be an integer of at least 1" in refused.stderr


@pytest.mark.filterwarnings("ignore")
def test_what_a_notebook_has_found_stands_beside_its_page_and_in_the_table_of_all_claims(notebook, tmp_path,
                                                                                          monkeypatch):
    monkeypatch.setenv("NEORL_CACHE", str(tmp_path / "cache"))
    change_last_cell(notebook, "from lib.shared import report\nreport.save('page', shares={'A2': "
                               "{'holds': 1, 'undecided': 1, 'untestable': 0, 'readings': 4}})")
    build.compute(notebook, {"runs": 3})
    build.write_tables()
    table = (build.CHAPTERS / "claims-table.md").read_text()
    assert "| 1 of 4 | 1 of 4 |" in table
    assert table.count("not computed in this build</span></summary>") == 35
    written = (build.CHAPTERS / "claims-table.md").stat().st_mtime_ns
    build.write_tables()
    assert (build.CHAPTERS / "claims-table.md").stat().st_mtime_ns == written


def test_links_into_the_glossary_become_references_to_its_terms():
    text = ("A [map of cells](../book/glossary.md#nres-map), [off-policy](../book/glossary.md#off-policy), "
            "[s](../book/s.md)")
    assert build.link_terms(text) == (
        "A {term}`map of cells <NRES map>`, {term}`off-policy <off-policy>`, [s](../book/s.md)")
    assert build.link_terms("[*map*](../book/glossary.md#nres-map)") == "*{term}`map <NRES map>`*"
    assert build.link_terms("[lost](../book/glossary.md#lost)") == "{term}`lost <lost>`"  # Sphinx warns about it


def test_the_conclusion_reads_all_other_records_and_no_other_page_reads_any(chapters):
    for name in ("assumptions", "chapter_5", "paper_a"):
        (chapters / f"{name}.claims.json").write_text("{}")
    read = {page: [path.name.split(".")[0] for path in build.records(Path(f"{page}.ipynb"))]
            for page in ("assumptions", "paper_a", "chapter_5")}
    assert read == {"assumptions": [], "paper_a": [], "chapter_5": ["assumptions", "paper_a"]}


def test_the_conclusion_is_computed_again_when_a_claim_has_changed(notebook, capsys, monkeypatch):
    monkeypatch.setattr(build, "execute", lambda source, target, parameters: shutil.copy(source, target))
    conclusion = notebook.rename(notebook.with_name("chapter_5.ipynb"))
    build.compute(conclusion, {"runs": 3})
    build.compute(conclusion, {"runs": 3})
    assert capsys.readouterr().out.count("nothing has changed") == 1
    (build.CHAPTERS / "paper_a.claims.json").write_text("{}")
    build.compute(conclusion, {"runs": 3})
    assert "nothing has changed" not in capsys.readouterr().out


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("damage", [
    lambda chapters: (chapters / "page.ipynb").write_text((chapters / "page.ipynb").read_text()[:-9]),
    lambda chapters: (chapters / "page.claims.json").write_bytes(b""),
    lambda chapters: (chapters / "page.claims.json").unlink(),
    lambda chapters: (chapters / "page.inputs.json").write_text('{"parameters": {"runs": 3}, "inp'),
    lambda chapters: (chapters / "page.inputs.json").write_text('{"format": 9, "parameters": {"runs": 3}}'),
    lambda chapters: (chapters / "page.inputs.json").write_text("[]"),
])
def test_what_is_damaged_or_of_another_version_is_made_again(notebook, cache_folder, damage, capsys, monkeypatch):
    def execute(source, target, parameters):
        shutil.copy(source, target)
        build.report.save("page")

    monkeypatch.setattr(build, "execute", execute)
    build.compute(notebook, {"runs": 3})
    whole = {path.name: path.read_bytes() for path in build.CHAPTERS.iterdir()}
    assert whole.keys() == {"page.ipynb", "page.claims.json", "page.inputs.json"}
    damage(build.CHAPTERS)
    build.compute(notebook, {"runs": 3})
    assert {path.name: path.read_bytes() for path in build.CHAPTERS.iterdir()} == whole
    assert "nothing has changed" not in capsys.readouterr().out


PAGES = ("index.html", "page.html")


@pytest.fixture
def made_pages(chapters, monkeypatch):
    """A stand-in for Sphinx that makes two pages: the list of its calls."""
    made = []

    def make_pages(command):
        made.append(command)
        for page in PAGES:
            target = build.BUILT / "next" / "_build" / "html" / page
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_text("new")
        return 0

    for name, value in (("BUILT", chapters), ("HTML", chapters / "html" / "index.html")):
        monkeypatch.setattr(build, name, value)
    monkeypatch.setattr(build.workers, "run", make_pages)
    return made


@pytest.mark.parametrize("damage", [Path.unlink, lambda page: page.write_text("ne"), lambda page: page.write_text("")])
def test_a_built_book_is_made_again_only_if_a_page_of_it_is_damaged(chapters, made_pages, damage):
    build.build()
    build.build()
    assert len(made_pages) == 1
    damage(chapters / "html" / PAGES[1])
    build.build()
    assert len(made_pages) == 2 and (chapters / "html" / PAGES[1]).read_text() == "new"


@pytest.mark.parametrize("bad", ["", "paper_b"])
def test_measurements_run_alone_and_the_conclusion_after_all_others(monkeypatch, capsys, bad):
    stages = []

    def work(commands, at_once, say):
        stages.append((sorted(commands), at_once))
        return [name for name in commands if name == f"{bad}.ipynb"]

    monkeypatch.setattr(build.workers, "work", work)
    monkeypatch.setattr(build, "tidy", lambda notebooks: None)
    monkeypatch.setattr(build, "restore_claims", lambda notebooks: None)
    monkeypatch.setattr(build.psutil, "virtual_memory", lambda: type("Memory", (), {"available": 2**40}))
    notebooks = {Path(f"{name}.ipynb"): {} for name in ("chapter_1", "chapter_5", "paper_a", "paper_b", "performance")}
    if bad:
        with pytest.raises(SystemExit, match="not computed, see above: paper_b.ipynb, chapter_5.ipynb; all others"):
            build.compute_all(notebooks)
        assert "chapter_5.ipynb: left out, since it needs paper_b.ipynb" in capsys.readouterr().out
    else:
        build.compute_all(notebooks)
    wanted = [(["chapter_1.ipynb", "paper_a.ipynb"], min(2, build.os.cpu_count())),
              (["paper_b.ipynb", "performance.ipynb"], 1), (["chapter_5.ipynb"], 1)]
    assert stages == (wanted[:2] if bad else wanted)


def test_what_no_notebook_has_made_is_removed(notebook, chapters):
    for name in ("gone.ipynb", "gone.claims.json", "figure.svg", "claims-table.md", "page.ipynb", "page.inputs.json"):
        (chapters / name).write_text("{}")
    (chapters / ".page").mkdir()
    (chapters / "page.inputs.json").write_text('{"parameters": {}, "inputs": "", "outputs": {"page.ipynb": ""}}')
    build.tidy([notebook])
    assert {path.name for path in chapters.iterdir()} >= {"claims-table.md", "page.ipynb", "page.inputs.json"}
    assert not {"gone.ipynb", "gone.claims.json", "figure.svg", ".page"} & {path.name for path in chapters.iterdir()}


def test_notebooks_read_the_claims_of_the_chapters_and_no_others(notebook, chapters, cache_folder):
    stray, mine = cache_folder / "claims" / "stray.json", cache_folder / "claims" / "page.json"
    stray.parent.mkdir()
    stray.write_text("trunc")
    (chapters / "page.claims.json").write_text("{}")
    outputs = {"page.claims.json": build.digest([chapters / "page.claims.json"])}
    (chapters / "page.inputs.json").write_text(json.dumps({"parameters": {}, "inputs": "", "outputs": outputs}))
    build.restore_claims([notebook])
    assert not stray.exists() and mine.read_text() == "{}"
    (chapters / "page.claims.json").write_text("{")
    build.restore_claims([notebook])
    assert not mine.exists()


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("source, message", [
    ("import os, signal; os.kill(os.getpid(), signal.SIGKILL)", "its kernel has died, perhaps for lack of memory"),
    ("import time; time.sleep(1000)", "its kernel has hung: no processor time in 3 s, in the cell that begins 'import"),
])
def test_a_kernel_that_dies_or_hangs_is_noticed(notebook, source, message, monkeypatch, capsys):
    monkeypatch.setattr(build, "STALL_SECONDS", 3)
    change_last_cell(notebook, source)
    assert build.attempt(notebook, {"runs": 3}) == 1
    assert f"page.ipynb: RuntimeError: {message}" in capsys.readouterr().out
