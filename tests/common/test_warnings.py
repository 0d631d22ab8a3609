"""Warnings point at the user's line, and what holds for a whole process is said once."""

import compileall
import re
import shutil
import subprocess
import sys
import warnings
import zipfile
from pathlib import Path

import numpy as np
import pytest

import neorl
from neorl import Policy, WaterWorld, gym, place_cells, simulate
from neorl.custom import softmax
from neorl.browser import wasm
from neorl.kernels.kernel import jit_is_off

PACKAGE = Path(neorl.__file__).parent
PROGRAM = """
import os, pwd, sys
sys.path.insert(0, sys.argv[1])
if "homeless" in sys.argv:
    pwd.getpwuid = {}.__getitem__  # KeyError, as for a user whom the system does not know
    del os.environ["HOME"], os.environ["NEORL_CACHE"]
    from neorl.common import files
    files.CHECKOUT = files.Path()  # as if it were installed, not imported from a clone, which has a cache
from neorl import WaterWorld, place_cells, simulate
from neorl.custom import execute, heading
from neorl.kernels.identity import digest_of_source
turns = 0.1
for _ in range(2):
    execute(heading, turns), "alone" in sys.argv or simulate(
        place_cells([3]), WaterWorld(), steps=300, runs=1, cache=True, progress=False)
print(digest_of_source("kernels", "core", "worlds"))
"""


@pytest.fixture
def choose():
    """A policy's kernel, of the package, that is not compiled yet."""
    return softmax(np.random.default_rng().random())


def simulated(choose, cache):
    simulate(place_cells([2], policy=Policy(0.0, choose=choose)), WaterWorld(), steps=10, runs=1, cache=cache,
             progress=False)


def rendered(_):
    envs = gym.VectorWorldEnv("WaterWorld")
    envs.reset(seed=0)
    envs.render()


COMPILED = pytest.mark.skipif(jit_is_off(), reason="the compiler is off")


@pytest.mark.parametrize("action, message", [
    (lambda choose: simulated(choose, True), r"takes no results \(\w+.*\): they stay in memory"),
    pytest.param(lambda choose: simulated(choose, False),
                 r"compiled takes no compiled kernels \(\w+.*\): each process compiles", marks=COMPILED),
    (lambda _: wasm._kept({"plane": b""}), r"wasm takes no WebAssembly modules \(\w+.*\): they will be built"),
    (rendered, "without a render_mode")], ids=["results", "kernels", "modules", "render"])
def test_warnings_point_at_the_users_line(cache_folder, choose, action, message):
    for folder in ("compiled", "runs", "wasm") if "results" not in message else ("runs",):
        (cache_folder / folder).unlink(missing_ok=True)
        (cache_folder / folder).write_text("")
    with warnings.catch_warnings(record=True) as warned:
        warnings.simplefilter("always")
        action(choose)
    assert any(re.search(message, str(each.message)) for each in warned)
    assert {each.filename for each in warned} == {__file__}


@pytest.fixture
def program(tmp_path, monkeypatch):
    """A function that runs the program with the package at a path: (what it prints, its warnings)."""
    (tmp_path / "program.py").write_text(PROGRAM)
    monkeypatch.setenv("NEORL_CACHE", str(tmp_path / "cache"))
    monkeypatch.delenv("PYTHONPATH")
    monkeypatch.delenv("XDG_CACHE_HOME", raising=False)

    def run(path, more=(), jit=False):
        monkeypatch.setenv("NUMBA_DISABLE_JIT", str(int(not jit)))
        done = subprocess.run([sys.executable, "program.py", path, *more], cwd=tmp_path, capture_output=True,
                              text=True)
        assert done.returncode == 0, done.stderr
        return done.stdout.strip(), re.findall(r"(\w+.py:\d+): RuntimeWarning: (.*)", done.stderr)

    return run


def kept(folder):
    return {path.name for path in folder.rglob("*") if path.is_file()}


def test_a_user_without_a_home_folder_has_no_cache_and_one_warning(program, tmp_path):
    _, warned = program(PACKAGE.parent, ["homeless"])
    message = "nothing is cached: NEORL_CACHE must name a folder, since this user has no home folder"
    assert warned == [("program.py:14", message)]
    assert kept(tmp_path) == {"program.py"}


def zipped(path, drag):
    """The package in a zip file, with the drag of WaterWorld as given."""
    with zipfile.ZipFile(path, "w") as file:
        for each in [*PACKAGE.rglob("*.py"), *PACKAGE.rglob("*.toml")]:
            content = each.read_text(encoding="utf-8").replace("DRAG = 0.975", f"DRAG = {drag}")
            file.writestr(each.relative_to(PACKAGE.parent).as_posix(), content)
    return path


def test_versions_in_zip_files_share_nothing(program, tmp_path):
    digests, results = set(), []
    for drag in (0.975, 0.9, 0.975):
        printed, warned = program(zipped(tmp_path / f"{drag}.zip", drag))
        assert not warned
        digests.add(printed)
        results.append(kept(tmp_path / "cache"))
    assert len(digests) == 2 and list(map(len, results)) == [1, 2, 2]


@pytest.mark.parametrize("options", [{}, pytest.param({"more": ["alone"], "jit": True}, marks=COMPILED)],
                         ids=["results", "kernels"])
def test_bytecode_without_source_caches_nothing_and_says_so_once(program, tmp_path, options):
    shutil.copytree(PACKAGE, tmp_path / "tree" / "neorl", ignore=shutil.ignore_patterns("__pycache__"))
    compileall.compile_dir(tmp_path / "tree", quiet=1, legacy=True)
    for path in (tmp_path / "tree").rglob("*.py"):
        path.unlink()
    printed, warned = program("tree", **options)
    assert printed == "None" and [where for where, _ in warned] == ["program.py:14"]
    assert "imported from bytecode without its source" in warned[0][1] and not kept(tmp_path / "cache")
