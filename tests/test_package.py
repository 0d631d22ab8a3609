"""The package as a whole: static checks, imports between its rooms, optional dependencies and the installation."""

import importlib
import pkgutil
import re
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import grimp
import numpy as np
import pytest
from conftest import FIRST

import neorl
from neorl.common.extras import require

ROOT = Path(__file__).parents[1]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]


@pytest.mark.parametrize("imported, when_used", [
    ("neorl", ("anywidget", "distributed", "gymnasium", "IPython", "matplotlib", "numba", "pandas", "psutil", "scipy",
               "tqdm")),
    ("neorl.drawing, companion.thesis.reading", ("scipy.optimize", "scipy.signal", "scipy.stats"))])
def test_what_takes_long_is_imported_when_it_is_used(imported, when_used):
    listed = subprocess.run([sys.executable, "-c", f"import {imported}, sys; print(*sys.modules)"],
                            capture_output=True, text=True, check=True)
    assert not set(when_used) & set(listed.stdout.split())


def test_an_older_numpy_is_named(monkeypatch):
    monkeypatch.setattr(np, "__version__", "1.26.4")
    with pytest.raises(ImportError, match="neorl must have numpy 2.0 or later, but .*numpy.* is of 1.26.4: update it"):
        importlib.reload(neorl.common)


def test_the_version_is_the_same_everywhere():
    assert f"\nversion: {neorl.__version__}\n" in (ROOT / "CITATION.cff").read_text()
    assert "version" in PROJECT["dynamic"]


def test_an_installation_compiles_nothing_and_carries_what_the_wheel_to_publish_is_given(tmp_path):
    build = tomllib.loads((ROOT / "pyproject.toml").read_text())["build-system"]
    assert build["requires"] == ["setuptools>=77"] and not (ROOT / "setup.py").exists()
    left_out = shutil.ignore_patterns("__pycache__", "*.wasm")
    shutil.copytree(ROOT / "neorl", tmp_path / "clone" / "neorl", ignore=left_out)
    for name in ("pyproject.toml", "README.md", "LICENSE"):
        shutil.copy(ROOT / name, tmp_path / "clone")
    for given in ([], ["plane.wasm"]):
        for name in given:
            (tmp_path / "clone" / "neorl" / "browser" / name).write_bytes(b"")
        subprocess.run([sys.executable, "-m", "pip", "install", "--quiet", "--no-deps", "--no-build-isolation",
                        "--no-compile", "--target", tmp_path / f"with {given}", tmp_path / "clone"], check=True)
        installed = tmp_path / f"with {given}" / "neorl"
        assert [path.name for path in installed.rglob("*.wasm")] == given
        files = {path.relative_to(installed) for path in installed.rglob("*.*")}
        assert files == {path.relative_to(ROOT / "neorl") for path in (ROOT / "neorl").rglob("*.*")
                         if path.suffix in (".py", ".toml", ".typed", ".csv", ".json", ".js", ".css")} | {
                             Path("browser", name) for name in given}


def test_the_files_that_run_first_exist():
    assert {*FIRST} <= {path.stem for path in (ROOT / "tests").rglob("test_*.py")}


def test_every_extra_that_a_message_names_exists():
    named = [name for path in (ROOT / "neorl").rglob("*.py")
             for name in re.findall(r'require\([^)]*extra="(\w+)"', path.read_text())]
    assert named and set(named) <= set(PROJECT["optional-dependencies"])


def test_a_missing_package_is_named_with_its_extra(monkeypatch):
    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(ImportError, match="pandas must be installed for this, but is not; pip install 'neorl-compani"):
        require("pandas", extra="data")


def test_an_error_inside_a_package_that_is_there_is_not_hidden(tmp_path, monkeypatch):
    (tmp_path / "broken_package.py").write_text("import missing_dependency")
    monkeypatch.syspath_prepend(tmp_path)
    with pytest.raises(ModuleNotFoundError, match="missing_dependency"):
        require("broken_package", extra="data")


@pytest.mark.parametrize("command", [("ruff", "check"), ("lint-imports", "--no-cache")], ids=lambda each: each[0])
def test_a_checker_finds_no_error(command):
    """And no room imports but from the rooms below it. Types are checked by `make types`, which takes longer."""
    program = Path(sys.executable).with_name(command[0])
    done = subprocess.run([program, *command[1:]], cwd=ROOT, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    assert (ROOT / "neorl" / "py.typed").exists()


def test_no_modules_import_each_other_in_a_circle():
    graph = grimp.build_graph("neorl", "companion", cache_dir=None)
    for module in graph.modules:
        for imported in graph.find_modules_directly_imported_by(module):
            assert not graph.chain_exists(importer=imported, imported=module), (module, imported)


def test_no_name_shadows_a_module():
    """`import neorl.kernels.kernel as k` gives the module, though `neorl.kernel` is a function."""
    modules = [(name.rpartition("."), module) for name, module in sys.modules.items() if name.startswith("neorl.")]
    assert len(modules) > 30
    for (parent, _, name), module in modules:
        assert getattr(sys.modules[parent], name) is module


def test_files_and_names_that_the_sources_speak_of_exist():
    """Not those of notebooks, or below `book/chapters`, where the build puts its own."""
    sources = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", ROOT / "Makefile", *(ROOT / "book").glob("*.md"), *(
        path for folder in ("neorl", "notebooks", "book", "tests") for path in (ROOT / folder).rglob("*.py"))]
    named = {(path.relative_to(ROOT), *name) for path in sources for name in re.findall(
        r"(?<![\w/.])((?:neorl|notebooks|book|tests)(?:/[\w-]+)+\.(?:py|toml|ipynb|md|js|css|csv|json))\b"
        r"|`((?:neorl|companion)(?:\.\w+)+)`", path.read_text(encoding="utf-8"))
             if not name[0].startswith("book/chapters/")}
    missing = [each for each in named if each[1] and not any((ROOT / folder / each[1]).exists()
                                                             for folder in ("", "notebooks"))]
    for each in named:
        try:
            pkgutil.resolve_name(each[2] or "neorl")
        except (ImportError, AttributeError):
            missing.append(each)
    assert len(named) > 100 and missing == []
