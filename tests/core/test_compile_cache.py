"""Compiled kernels on disk are reused if everything that they were compiled from is unchanged, and only then."""

import copy
import importlib.util
import os
import pickle
import subprocess
import sys

import pytest
from numba.core.compiler import Flags

from neorl import files
from neorl.core.calls import execute
from neorl.core.kernel import announcing, jit_is_off, kernel
from neorl.core.linking import LinkedFlags
from neorl.worlds import waterworld

pytestmark = pytest.mark.skipif(jit_is_off(), reason="the compiler is off")

SOURCE = """
from neorl import kernel

@kernel
def doubled(x):
    return 2.0 * x

@kernel
def answer(x):
    return 3.0 * doubled(x)
"""


@pytest.fixture
def module(tmp_path, monkeypatch):
    """A function that imports a module with this source, as a new process would."""
    monkeypatch.setenv("NEORL_CACHE", str(tmp_path))

    def load(source=SOURCE):
        path = tmp_path / "own.py"
        path.write_text(source)
        importlib.invalidate_caches()
        spec = importlib.util.spec_from_loader("own", Loader("own", str(path)))
        monkeypatch.setitem(sys.modules, "own", importlib.util.module_from_spec(spec))
        spec.loader.exec_module(sys.modules["own"])
        return sys.modules["own"]

    return load


class Loader(importlib.machinery.SourceFileLoader):
    def get_code(self, fullname):
        return compile(self.get_data(self.path), self.path, "exec")


def called(own):
    """The result of the kernel, and whether it was loaded from disk."""
    answer = execute(own.answer, 1.0)
    return answer, sum(own.answer.for_python.stats.cache_hits.values()) == 1


def kept():
    return sorted((files.cache_folder() / "compiled").glob("*"))


def test_what_one_process_has_compiled_another_takes_from_disk(module):
    assert called(module()) == (6.0, False) and len(kept()) == 1
    assert called(module()) == (6.0, True) and len(kept()) == 1


def test_a_file_that_changes_after_it_was_read_does_not_lend_its_source_to_older_code(module, tmp_path):
    own, changed = module(), SOURCE.replace("2.0 * x", "4.0 * x")
    (tmp_path / "own.py").write_text(changed)
    assert called(own) == (6.0, False)
    assert called(module(changed)) == (12.0, False)


def test_a_kernel_that_raises_tells_its_own_line_after_it_has_moved(module):
    for line in (4, 6):
        above = (line - 4) * "\n" + "from neorl import kernel\n@kernel\ndef answer(x):\n"
        with pytest.raises(ValueError, match=f"own.answer .*, line {line}. must not raise, but has raised"):
            execute(module(above + "    assert x > 5.0\n    return x").answer, 1.0)


def test_another_processor_or_compiler_compiles_again(module, monkeypatch):
    called(module())
    monkeypatch.setattr("numba.__version__", "0.0")
    assert called(module()) == (6.0, False)


@pytest.mark.parametrize("damage", [lambda content: content[:-1], lambda content: b"", lambda content: b"x" * 100],
                         ids=["truncated", "empty", "foreign"])
def test_a_damaged_file_is_compiled_again_and_replaced(module, damage):
    called(module())
    path, = kept()
    content = path.read_bytes()
    path.write_bytes(damage(content))
    assert called(module()) == (6.0, False)
    assert called(module()) == (6.0, True)


def test_a_folder_that_cannot_be_written_to_costs_time_alone(module, tmp_path, monkeypatch):
    own = module()
    (tmp_path / "file").write_text("")
    monkeypatch.setenv("NEORL_CACHE", str(tmp_path / "file"))
    with pytest.warns(RuntimeWarning, match="takes no compiled kernels"):
        assert called(own) == (6.0, False)


def test_processes_that_start_at_once_do_not_disturb_each_other(module, tmp_path):
    module()
    command = [sys.executable, "-c", "import own; from neorl.core.calls import execute\n"
               "print(execute(own.answer, 1.0))"]
    processes = [subprocess.Popen(command, cwd=tmp_path, stdout=subprocess.PIPE) for _ in range(2)]
    assert [process.communicate()[0].strip() for process in processes] == [b"6.0"] * 2
    assert len(kept()) == 1 and called(module()) == (6.0, True)


def test_code_that_two_processes_have_compiled_is_linked_by_names_of_its_own(tmp_path, monkeypatch):
    monkeypatch.setenv("NEORL_CACHE", str(tmp_path))
    program = tmp_path / "answering.py"
    program.write_text("""
import sys
from neorl import kernel, kernel_maker

@kernel_maker
def answering(x):
    @kernel
    def answer():
        return x

    return answer

made = [answering(float(x)) for x in sys.argv[1:]]
for _ in range(2):  # compiled, then found again
    addresses = {each.compiled_for(()).address for each in made}
assert len(addresses) == len(made)
""")
    for numbers in ("1", "21"):  # the second process compiles one and finds the other on disk
        subprocess.run([sys.executable, program, *numbers], check=True)


@pytest.mark.parametrize("protocol", range(2, pickle.HIGHEST_PROTOCOL + 1))
def test_a_kernel_of_a_module_is_pickled_by_its_name(protocol):
    assert pickle.loads(pickle.dumps(waterworld.step, protocol)) is waterworld.step is copy.deepcopy(waterworld.step)


def test_compilations_do_not_share_the_flags_that_numba_changes_meanwhile():
    flags = LinkedFlags(Flags())
    changed = flags.copy()
    assert changed == flags and hash(changed) == hash(flags)
    changed.force_pyobject = True
    assert changed != flags and not flags.force_pyobject


@pytest.mark.skipif(not hasattr(os, "fork"), reason="processes cannot be forked")
def test_forked_processes_number_their_functions_apart():
    numbers = ("import os\nfrom neorl.core.compile_cache import FunctionIdentity\n"
               "os.fork() and os.wait()\nprint(next(FunctionIdentity._unique_ids))")
    forked = subprocess.run([sys.executable, "-c", numbers], check=True, capture_output=True, text=True).stdout
    assert len(set(forked.split())) == 2


def test_a_kernel_that_no_module_defines_is_compiled_and_not_kept(module):
    own = {}
    exec("from neorl import kernel\n@kernel\ndef answer(x):\n    return x", own)
    assert execute(own["answer"], 2.0) == 2.0 and not kept()


def test_compilation_is_announced_once_and_reading_from_disk_is_not(tmp_path, monkeypatch):
    monkeypatch.setenv("NEORL_CACHE", str(tmp_path))
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
