"""Compiled kernels on disk are reused if everything that they were compiled from is unchanged, and only then."""

import importlib.util
import os
import subprocess
import sys

import pytest

from neorl import files
from neorl.core.kernel import announcing, execute, kernel

SOURCE = """
from typing import NamedTuple
import numpy as np
import helpers
from neorl import kernel

FACTOR = 3.0

class Pair(NamedTuple):
    one: float
    other: float

@kernel
def doubled(x):
    return 2.0 * x

@kernel
def answer(pair):
    return FACTOR * doubled(pair.one) - helpers.halved(pair.other)
"""
HELPERS = "from neorl import kernel\n\n@kernel\ndef halved(x):\n    return 0.5 * x\n"


@pytest.fixture
def module(tmp_path, monkeypatch):
    """A function that imports a module with this source, as a new process would."""
    monkeypatch.setenv("NEORL_CACHE", str(tmp_path))

    def load(source=SOURCE, helpers=HELPERS):
        for name, content in (("helpers", helpers), ("own", source)):
            path = tmp_path / f"{name}.py"
            path.write_text(content)
            importlib.invalidate_caches()
            spec = importlib.util.spec_from_loader(name, Loader(name, str(path)))
            monkeypatch.setitem(sys.modules, name, importlib.util.module_from_spec(spec))
            spec.loader.exec_module(sys.modules[name])
        return sys.modules["own"]

    return load


class Loader(importlib.machinery.SourceFileLoader):
    def get_code(self, fullname):
        return compile(self.get_data(self.path), self.path, "exec")


@pytest.fixture(autouse=True)
def only_when_compiled():
    if os.environ.get("NUMBA_DISABLE_JIT") == "1":
        pytest.skip("the compiler is off")


def called(own):
    """The result of the kernel, and whether it was loaded from disk."""
    answer = execute(own.answer, own.Pair(1.0, 4.0))
    return answer, sum(own.answer.for_python.stats.cache_hits.values()) == 1


def kept():
    return sorted((files.cache_folder() / "compiled").glob("*"))


def test_what_one_process_has_compiled_another_takes_from_disk(module):
    assert called(module()) == (4.0, False) and len(kept()) == 1
    assert called(module()) == (4.0, True) and len(kept()) == 1


@pytest.mark.parametrize("changed, answer", [
    ({"source": SOURCE.replace("3.0", "5.0")}, 8.0),
    ({"source": SOURCE.replace("2.0 * x", "4.0 * x")}, 10.0),
    ({"source": SOURCE.replace("    one: float\n    other: float", "    other: float\n    one: float")}, 23.5),
    ({"helpers": HELPERS.replace("0.5", "0.25")}, 5.0),
], ids=["a constant", "another kernel", "the order of fields", "a kernel of another module"])
def test_a_change_in_anything_that_a_kernel_is_made_of_compiles_it_again(module, changed, answer):
    assert called(module()) == (4.0, False)
    assert called(module(**changed)) == (answer, False) and len(kept()) == 2


def test_a_file_that_changes_after_it_was_read_does_not_lend_its_source_to_older_code(module, tmp_path):
    own, changed = module(), SOURCE.replace("2.0 * x", "4.0 * x")
    (tmp_path / "own.py").write_text(changed)
    assert called(own) == (4.0, False)
    assert called(module(changed)) == (10.0, False)


def test_another_processor_or_compiler_compiles_again(module, monkeypatch):
    called(module())
    monkeypatch.setattr("numba.__version__", "0.0")
    assert called(module()) == (4.0, False)


@pytest.mark.parametrize("damage", [lambda content: content[:-1], lambda content: b"", lambda content: b"x" * 100],
                         ids=["truncated", "empty", "foreign"])
def test_a_damaged_file_is_compiled_again_and_replaced(module, damage):
    called(module())
    path, = kept()
    content = path.read_bytes()
    path.write_bytes(damage(content))
    assert called(module()) == (4.0, False)
    assert called(module()) == (4.0, True)


def test_a_folder_that_cannot_be_written_to_costs_time_alone(module, tmp_path, monkeypatch):
    own = module()
    (tmp_path / "file").write_text("")
    monkeypatch.setenv("NEORL_CACHE", str(tmp_path / "file"))
    assert called(own) == (4.0, False)


def test_processes_that_start_at_once_do_not_disturb_each_other(module, tmp_path):
    module()
    command = [sys.executable, "-c", "import own; from neorl.core.kernel import execute\n"
               "print(execute(own.answer, own.Pair(1.0, 4.0)))"]
    environment = os.environ | {"PYTHONPATH": os.pathsep.join([str(tmp_path), *sys.path])}
    processes = [subprocess.Popen(command, env=environment, stdout=subprocess.PIPE) for _ in range(4)]
    assert [process.communicate()[0].strip() for process in processes] == [b"4.0"] * 4
    assert len(kept()) == 1 and called(module()) == (4.0, True)


def test_a_kernel_that_no_module_defines_is_compiled_and_not_kept(module):
    own = {}
    exec("from neorl import kernel\n@kernel\ndef answer(x):\n    return x", own)
    assert execute(own["answer"], 2.0) == 2.0 and not kept()


def test_compilation_is_announced_once_and_reading_from_disk_is_not(cache_folder):
    told = []
    for _ in range(2):
        @kernel
        def halved(x):
            return x / 2

        @kernel
        def quartered(x):
            return halved(halved(x))

        with announcing(told.append):
            assert execute(quartered, 3.0) == execute(quartered, 3.0) == 0.75
    assert told == [True, False]
