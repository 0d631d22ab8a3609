"""How kernels are compiled: linked or each by itself, cached where they are the package's, and never as they were."""

import copy
import logging
import os
import pickle
import re
import shutil
import subprocess
import sys

import numpy as np
import pytest
from numba.core.compiler import Flags

from neorl import Policy, Run, WaterWorld, kernel, place_cells
from neorl.custom import softmax
from neorl.common import files
from neorl.core import stream
from neorl.kernels import caching, compiling
from neorl.kernels.execution import execute
from neorl.kernels.kernel import jit_is_off
from neorl.kernels.linking import LinkedFlags
from neorl.worlds import waterworld

pytestmark = pytest.mark.skipif(jit_is_off(), reason="the compiler is off")
LOADED = """
import sys
import numpy as np
from neorl import WaterWorld
from neorl.custom import softmax
from neorl.kernels.execution import execute

value, stream = np.array([0.0, 1.0]), np.arange(4, dtype=np.uint64)
made = [softmax(float(each)) for each in sys.argv[1:]]
chosen = [sum(execute(each, value, stream) for _ in range(1_000)) for each in made]
assert sorted(chosen) == chosen[::-1], chosen  # the higher the temperature, the rarer the better action
WaterWorld().reset(0)
print(sum(sum(each.for_python.stats.cache_hits.values()) for each in (*made, WaterWorld.dynamics.reset)))
"""


@pytest.fixture
def run_program(tmp_path):
    """Start programs with a cache of their own, and return what they print."""
    def start(source, *arguments, **environment):
        return subprocess.run([sys.executable, "-c", source, *map(str, arguments)], check=True, capture_output=True,
                              text=True, env=os.environ | {"NEORL_CACHE": str(tmp_path)} | environment).stdout.strip()

    return start


def kept():
    """The names of the files of compiled kernels on disk, which begin with theirs."""
    return {path.name for path in files.cache_folder().glob("compiled/*")}


def test_processes_that_start_at_once_do_not_disturb_each_other(run_program, tmp_path, monkeypatch):
    monkeypatch.setenv("NEORL_CACHE", str(tmp_path))
    processes = [subprocess.Popen([sys.executable, "-c", LOADED, "0.5"], stdout=subprocess.PIPE) for _ in range(2)]
    assert [process.communicate()[0] != b"" for process in processes] == [True] * 2
    assert run_program(LOADED, 0.5) == "2"


DAMAGES = {"bits flipped": lambda content: bytes(each ^ (place % 64 == 0) for place, each in enumerate(content)),
           "truncated": lambda content: content[:-1], "empty": lambda content: b"",
           "zeros": lambda content: bytes(len(content))}
TEMPERATURES = 0.1, 0.2, 0.5, 1.0  # one for each


def test_what_one_process_has_compiled_another_takes_from_disk_unless_it_is_damaged(run_program, tmp_path):
    """Under names of its own: the second process compiles three kernels of the same name and finds one on disk.

    One file is then damaged in each way, which the third process compiles again, so that all are whole in the next.
    """
    assert [run_program(LOADED, *temperatures) for temperatures in ((0.5,), TEMPERATURES)] == ["0", "2"]
    whole = sorted(each for each in tmp_path.glob("compiled/*") if each.name.startswith("choose"))
    assert len(whole) == len(DAMAGES)
    for path, damage in zip(whole, DAMAGES.values()):
        path.write_bytes(damage(path.read_bytes()))
    assert [run_program(LOADED, *TEMPERATURES) for _ in range(2)] == ["1", "5"]  # the world's alone, then all


FIELDS = """
import os
from collections import namedtuple
from neorl.worlds.waterworld import Rules
Mine = namedtuple("Mine", Rules._fields[::int(os.environ["ORDER"])])
"""
CALLED = """
import numpy as np
from neorl import WaterWorld
from neorl.kernels.execution import execute
from neorl.worlds.world import checked_rules
from fields import Mine
world = WaterWorld(width=100)
state = world.reset(0)
execute(world.dynamics.reset, state, Mine(**checked_rules(world)._asdict()))
print(state)
"""


def test_code_for_a_tuple_of_the_users_is_that_for_its_present_fields(run_program, tmp_path):
    (tmp_path / "fields.py").write_text(FIELDS)
    printed = {run_program(CALLED, PYTHONPATH=str(tmp_path), ORDER=order) for order in ("1", "-1")}
    assert len(printed) == 1


def test_another_numba_or_another_setting_of_it_compiles_again(tmp_path, monkeypatch):
    monkeypatch.setenv("NEORL_CACHE", str(tmp_path))
    for name, value in [("numba.__version__", "0.0"), ("numba.config.SLP_VECTORIZE", 7), ("numba.config.OPT", 3)]:
        monkeypatch.setattr(name, value)
        execute(kernel(stream.uniform.py_func), np.arange(4, dtype=np.uint64))
    assert len(list((tmp_path / "compiled").iterdir())) == 3


def test_a_folder_that_cannot_be_written_to_costs_time_alone(tmp_path, monkeypatch):
    (tmp_path / "file").write_text("")
    monkeypatch.setenv("NEORL_CACHE", str(tmp_path / "file"))
    with pytest.warns(RuntimeWarning, match="takes no compiled kernels .Not a directory"):
        assert execute(softmax(0.75), np.array([0.0, 9.0]), np.arange(4, dtype=np.uint64)) in (0, 1)


def test_the_users_kernels_and_what_has_them_within_are_not_kept(tmp_path, monkeypatch):
    compiled = files.cache_folder() / "compiled"
    if compiled.exists():  # what need not be compiled again, but for files that others are writing
        shutil.copytree(compiled, tmp_path / "compiled", ignore=shutil.ignore_patterns(".*"))
    monkeypatch.setenv("NEORL_CACHE", str(tmp_path))
    before = kept()

    @kernel
    def first(value, stream):
        return 0

    execute(first, np.zeros(2), np.zeros(4, np.uint64))
    Run(place_cells([2], policy=Policy(choose=first)), WaterWorld()).advance(1)
    assert not {path.partition("-")[0] for path in kept() - before} & {"first", "chosen"}


A_WORLD = """
world = neorl.WaterWorld()
state = world.reset(1)
found = f"{sum(world.step(state, k % 5)[0] for k in range(3_000))} {state.scene.position} {compiling.links()}"
"""
A_RUN = """
run = neorl.Run(neorl.multimodal([3, 4], object_state="self"), neorl.WaterWorld(), seed=1)
found = f"{run.advance(3_000)} {run.memory.q.sum(dtype=float)} {compiling.links()}"
"""


@pytest.mark.parametrize("program", [A_WORLD, pytest.param(A_RUN, marks=pytest.mark.exact)], ids=["world", "run"])
def test_without_linking_a_result_is_the_same_to_the_last_bit(run_program, program):
    linked, program = {}, f"import neorl\nfrom neorl.kernels import compiling\n{program}"
    exec(program, linked)
    unlinked = run_program(f"{program}print(found)", **{compiling.UNLINKED: "1"})
    assert linked["found"].removesuffix("True") == unlinked.removesuffix("False") != unlinked


@pytest.mark.parametrize("asked, name, value, said", [
    (compiling.links, "linking.OVERRIDDEN", ["_gone"], "link kernels, so a first step takes twice as long: .*'_gone'"),
    (compiling.links, "linking.TAKEN", ["library"], "link kernels, .*: its compiler takes typingctx, "),
    (compiling.caches, "caching.CompileResult", None, "cache kernels, so each process compiles .*: .*'_reduce'")])
def test_a_numba_that_lacks_private_parts_is_asked_first_and_one_line_is_logged(monkeypatch, caplog, asked, name, value,
                                                                                said):
    monkeypatch.setattr(f"neorl.kernels.{name}", value)
    with caplog.at_level(logging.WARNING, "neorl"):
        assert asked.__wrapped__() is False
    (line,) = caplog.messages
    assert re.search(f"cannot {said}", line)


def test_a_numba_that_caches_otherwise_than_it_seems_costs_time_alone(tmp_path, monkeypatch):
    monkeypatch.setenv("NEORL_CACHE", str(tmp_path))
    monkeypatch.setattr(caching.CompileResult, "_reduce", lambda self, other: None)
    with pytest.warns(RuntimeWarning, match="takes no compiled kernels"):
        assert execute(softmax(0.0625), np.array([0.0, 9.0]), np.arange(4, dtype=np.uint64)) in (0, 1)


@pytest.mark.parametrize("protocol", range(2, pickle.HIGHEST_PROTOCOL + 1))
def test_a_kernel_of_a_module_is_pickled_by_its_name(protocol):
    assert pickle.loads(pickle.dumps(waterworld.step, protocol)) is waterworld.step is copy.deepcopy(waterworld.step)


def test_compilations_do_not_share_the_flags_that_numba_changes_meanwhile():
    flags = LinkedFlags(Flags())
    changed = flags.copy()
    assert changed == flags and hash(changed) == hash(flags)
    changed.force_pyobject = True
    assert changed != flags and not flags.force_pyobject
