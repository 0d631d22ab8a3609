"""Imports run only downwards, by the contracts in pyproject.toml, and never in a circle."""

import subprocess
import sys
from pathlib import Path

import grimp

import neorl  # noqa: F401, loads the modules that its users get

ROOT = Path(__file__).parents[1]


def test_a_room_imports_only_from_the_rooms_below_it():
    command = [Path(sys.executable).with_name("lint-imports"), "--no-cache"]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout


def test_every_module_lies_in_a_room():
    assert [path.name for path in sorted((ROOT / "neorl").glob("*.py"))] == [
        "__init__.py", "__main__.py", "checks.py", "description.py", "extras.py", "files.py"]


def test_no_modules_import_each_other_in_a_circle():
    graph = grimp.build_graph("neorl", "lib", cache_dir=None)
    for module in graph.modules:
        for imported in graph.find_modules_directly_imported_by(module):
            assert not graph.chain_exists(importer=imported, imported=module), (module, imported)


def test_no_name_shadows_a_module():
    """`import neorl.core.kernel as k` gives the module, though `neorl.kernel` is a function."""
    modules = [(name.rpartition("."), module) for name, module in sys.modules.items() if name.startswith("neorl.")]
    assert len(modules) > 30
    for (parent, _, name), module in modules:
        assert getattr(sys.modules[parent], name) is module
