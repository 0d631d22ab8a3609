"""The ways into a clone: papermill, JupyterLab, Binder and Python share a cache, and leave the work tree as it was."""

import asyncio
import copy
import io
import os
import re
import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import nbformat
import pytest
from jupyter_client.manager import start_new_kernel
from companion.page import saving
from nbformat.v4 import new_code_cell, new_notebook, new_output
from traitlets.config import Config

from neorl import WaterWorld, place_cells, simulate
from neorl.common.files import cache_folder

ROOT = Path(__file__).parents[2]
BIN = Path(sys.executable).parent
SIMULATE = "import neorl\nneorl.simulate(neorl.place_cells([3]), neorl.WaterWorld(), steps=1_000, runs=1);"
BAR = r"\d+%\|"


@pytest.mark.parametrize("named, folder", [(None, ROOT / ".cache"), ("", ROOT / ".cache"), ("kept", "began/kept"),
                                           ("~/kept", "home/kept"), ("/kept", "/kept")])
def test_the_cache_is_that_of_the_clone_unless_it_is_named(named, folder, tmp_path, monkeypatch):
    for name in ("began", "elsewhere"):
        (tmp_path / name).mkdir()
    monkeypatch.chdir(tmp_path / "elsewhere")
    monkeypatch.setenv("PWD", str(tmp_path / "began"))
    monkeypatch.setenv("HOME", str(tmp_path / "home"))
    monkeypatch.setenv("NEORL_CACHE", named) if named is not None else monkeypatch.delenv("NEORL_CACHE", raising=False)
    assert cache_folder() == tmp_path / folder
    monkeypatch.delenv("PWD")
    assert cache_folder() == tmp_path / str(folder).replace("began", "elsewhere")


@pytest.mark.parametrize("options", [["--cwd", "notebooks"], []], ids=["in the pages' folder", "from the clone"])
def test_papermill_finds_the_pages_and_the_cache_of_the_clone_and_records_no_progress(options, tmp_path):
    cells = [new_code_cell("from companion.page import report"), new_code_cell(SIMULATE),
             new_code_cell("from neorl.common.files import cache_folder\nprint(cache_folder())")]
    metadata = {"kernelspec": {"name": "python3", "display_name": "Python 3", "language": "python"}}
    nbformat.write(new_notebook(cells=cells, metadata=metadata), tmp_path / "page.ipynb")
    environment = {name: value for name, value in os.environ.items() if name not in ("NEORL_CACHE", "PYTHONPATH")}
    subprocess.run([BIN / "papermill", *options, tmp_path / "page.ipynb", tmp_path / "out.ipynb"], cwd=ROOT,
                   env=environment, check=True, capture_output=True)
    *before, last = [cell.outputs for cell in nbformat.read(tmp_path / "out.ipynb", 4).cells]
    assert not any(before) and [output.text for output in last] == [f"{ROOT / '.cache'}\n"]


def test_a_notebook_that_can_ask_for_input_shows_progress():
    shown = []
    manager, client = start_new_kernel(kernel_name="python3")
    try:
        for allow_stdin in (True, False):
            client.execute_interactive(SIMULATE, allow_stdin=allow_stdin, timeout=120, output_hook=lambda message: (
                shown.append((allow_stdin, message["content"]["text"])) if message["msg_type"] == "stream" else None))
    finally:
        client.stop_channels()
        manager.shutdown_kernel(now=True)
    assert re.search(BAR, "".join(text for _, text in shown)) and all(allowed for allowed, _ in shown)


@pytest.mark.parametrize("terminal", [True, False])
def test_a_terminal_shows_progress_and_a_file_does_not(terminal, monkeypatch):
    class Errors(io.StringIO):
        def isatty(self):
            return terminal

    monkeypatch.setattr("sys.stderr", Errors())
    simulate(place_cells([3]), WaterWorld(), steps=1_000, runs=1)
    assert bool(re.search(BAR, sys.stderr.getvalue())) == terminal


@pytest.fixture
def lab(tmp_path, monkeypatch):
    """The contents manager of `make lab`, for a clone with the pages."""
    from jupyter_server.services.contents.largefilemanager import AsyncLargeFileManager  # here, since it takes long

    command = subprocess.run(["make", "--dry-run", "lab"], cwd=ROOT, check=True, capture_output=True, text=True).stdout
    assert ("--allow-root" in command) == (os.getuid() == 0)
    hook = re.search(r"--ContentsManager.pre_save_hook=(\S+)", command)[1]
    monkeypatch.setattr(saving, "PAGES", tmp_path / "notebooks")
    saving.PAGES.mkdir()
    for path in (ROOT / "notebooks").glob("*.ipynb"):
        shutil.copy(path, saving.PAGES)
    for arguments in (["init", "--quiet"], ["add", "."]):
        subprocess.run(["git", *arguments], cwd=tmp_path, check=True)
    return AsyncLargeFileManager(root_dir=str(tmp_path), config=Config(ContentsManager={"pre_save_hook": hook}))


def executed(notebook):
    """A notebook after a session in JupyterLab, in which everything was run, and folded."""
    notebook = copy.deepcopy(notebook)
    for k, cell in enumerate(notebook.cells):
        cell.metadata |= {"collapsed": True, "scrolled": False, "ExecuteTime": {"end_time": "now"}, "editable": True,
                          "execution": {"iopub.execute_input": "now"}, "jupyter": {"source_hidden": k % 2 == 0}}
        if cell.cell_type == "code":
            cell.execution_count, cell.outputs = k, [new_output("stream", name="stdout", text="said")]
    notebook.metadata.kernelspec.display_name = "Python 3 (ipykernel)"
    notebook.metadata.language_info = {"name": "python", "version": "3.11.7"}
    notebook.metadata.widgets = {"application/vnd.jupyter.widget-state+json": {"state": {}}}
    return notebook


def save(lab, path, notebook):
    """Save a notebook as JupyterLab does; returns the bytes of the file."""
    saving_it = lab.save({"type": "notebook", "format": "json", "content": notebook}, path)
    with ThreadPoolExecutor(1) as apart:  # from the loop of the browser that other tests may have started
        apart.submit(asyncio.run, saving_it).result()
    return Path(lab.root_dir, path.strip("/")).read_bytes()


def test_outputs_of_a_page_are_kept_under_a_name_of_ones_own(lab):
    notebook = executed(nbformat.read(saving.PAGES / "paper_a.ipynb", 4))
    mine = saving.PAGES / "mine.ipynb"
    save(lab, f"notebooks/{mine.name}", notebook)
    kept = nbformat.read(mine, 4)
    assert [cell.get("outputs") for cell in kept.cells] == [cell.get("outputs") for cell in notebook.cells]


@pytest.mark.parametrize("said", ["Pyodide and JupyterLite have no numba", "by nbconvert needs Inkscape",
                                  "To keep the outputs of a long page, save it under a name of your own"])
def test_the_page_running_it_says_once_what_does_not_work_and_how_to_keep_outputs(said):
    text = " ".join((ROOT / "book" / "running.md").read_text(encoding="utf-8").split())
    assert text.count(said) == 1


def test_a_page_that_was_run_in_lab_is_saved_as_it_was(lab):
    for path in saving.PAGES.glob("*.ipynb"):
        committed = path.read_bytes()
        notebook = executed(nbformat.read(path, 4))
        assert save(lab, f"notebooks/{path.name}", notebook) == committed, path.name
        notebook.cells[1].source = "runs: int = 3  # changed"
        assert save(lab, f"/notebooks/{path.name}", notebook) != committed
        saved = nbformat.read(path, 4)
        assert saved.cells[1].source == notebook.cells[1].source and "said" not in path.read_text()


@pytest.mark.parametrize("folder, name", [("notebooks", "own.ipynb"), ("", "paper_a.ipynb")])
def test_a_readers_own_notebook_keeps_its_outputs(lab, folder, name):
    notebook = executed(nbformat.read(saving.PAGES / "paper_a.ipynb", 4))
    assert b"said" in save(lab, f"{folder}/{name}", notebook)


def test_binder_compiles_kernels_and_webassembly():
    done = subprocess.run([ROOT / ".binder" / "postBuild"], cwd=ROOT, capture_output=True, text=True,
                          env=os.environ | {"PATH": os.pathsep.join([str(BIN), os.environ["PATH"]])})
    assert done.returncode == 0, done.stderr
    assert list((cache_folder() / "wasm").iterdir()) and list((cache_folder() / "compiled").iterdir())
