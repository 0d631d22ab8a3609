"""The installed package: the cost of `import neorl`, optional dependencies, and metadata."""

import re
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

import neorl
from neorl.extras import require

ROOT = Path(__file__).parents[1]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
WHEN_USED = ("anywidget", "distributed", "gymnasium", "IPython", "matplotlib", "numba", "pandas", "psutil", "scipy",
             "tqdm", "xarray")


def test_import_neorl_imports_nothing_that_takes_long():
    listed = subprocess.run([sys.executable, "-c", "import neorl, sys; print(*sys.modules)"], capture_output=True,
                            text=True, check=True)
    assert not set(WHEN_USED) & set(listed.stdout.split())


def test_figures_and_statistics_import_no_part_of_scipy_before_they_use_it():
    listed = subprocess.run([sys.executable, "-c", "import neorl.drawing, neorl.evidence.report, sys; "
                             "print(*sys.modules)"], capture_output=True, text=True, check=True)
    assert not {"scipy.optimize", "scipy.signal", "scipy.stats"} & set(listed.stdout.split())


def test_the_version_is_the_same_everywhere():
    assert f"\nversion: {neorl.__version__}\n" in (ROOT / "CITATION.cff").read_text()
    assert "version" in PROJECT["dynamic"]


def test_every_extra_that_a_message_names_exists():
    named = [name for path in (ROOT / "neorl").rglob("*.py")
             for name in re.findall(r'require\([^)]*extra="(\w+)"', path.read_text())]
    assert named and set(named) <= set(PROJECT["optional-dependencies"])


def test_a_missing_package_is_named_with_its_extra(monkeypatch):
    monkeypatch.setitem(sys.modules, "xarray", None)
    with pytest.raises(ImportError, match=r"this needs xarray: pip install 'neorl-companion\[data\]'"):
        require("xarray", extra="data")


def test_an_error_inside_a_package_that_is_there_is_not_hidden(tmp_path, monkeypatch):
    (tmp_path / "broken_package.py").write_text("import missing_dependency")
    monkeypatch.syspath_prepend(tmp_path)
    with pytest.raises(ModuleNotFoundError, match="missing_dependency"):
        require("broken_package", extra="data")
