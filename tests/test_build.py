"""The building of the book: what it refuses, and when it has nothing to do."""

import json
import subprocess
import sys
from pathlib import Path

import nbformat
import pytest

ROOT = Path(__file__).parent.parent
sys.path.insert(0, str(ROOT / "book"))
import build  # noqa: E402


@pytest.fixture
def notebook(tmp_path, monkeypatch):
    """A notebook of two cells, and chapters of its own."""
    monkeypatch.setattr(build, "CHAPTERS", tmp_path / "chapters")
    cells = [nbformat.v4.new_code_cell("runs: int = 20", metadata={"tags": ["parameters"]}),
             nbformat.v4.new_markdown_cell("[Sources](../book/sources.md)"),
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
    assert executed.cells[2].source == "[Sources](../sources.md)"
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


@pytest.mark.parametrize("runs", ["0", "-3", "many", "2.5"])
def test_bad_runs_are_refused_before_anything_runs(runs):
    command = [sys.executable, ROOT / "book" / "build.py", "--runs", runs]
    refused = subprocess.run(command, capture_output=True, text=True)
    assert refused.returncode != 0
    assert "--runs" in refused.stderr and "allowed are integers ≥ 1" in refused.stderr
