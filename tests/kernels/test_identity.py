"""The identity of a kernel changes with everything that it looks up, and compiled code with its identity."""

import subprocess
import sys
from dataclasses import dataclass
from enum import Enum
from types import ModuleType, SimpleNamespace

import numpy as np
import pytest

from neorl import kernel
from neorl.custom import kernel_maker
from neorl.kernels.execution import execute
from neorl.kernels.identity import Reading, identity
from neorl.kernels.kernel import jit_is_off

OUTER = """
from enum import IntEnum
from typing import NamedTuple
import numpy as np
from neorl import kernel
import outer.inner

P, TABLE, SHADOW = 1.0, np.array([1.0, 2.0]), 0.0

class Kind(IntEnum):
    A = 4
    B = 5

class Pair(NamedTuple):
    one: float
    other: float

PAIR = Pair(1.0, 2.0)

def adding(amount):
    def add_to(more):
        nonlocal amount
        amount += more

    @kernel
    def add(x):
        return x + amount
    return add, add_to

add, add_to = adding(1.0)

@kernel
def raised(x, by=P):
    return x + by

@kernel
def answer(x):
    x += outer.inner.Q + outer.inner.SHADOW + TABLE[0] + PAIR.one + (Kind.A + 0) + P
    return max(add(raised(outer.inner.halved(x))), 0.0)
"""
INNER = """
from neorl import kernel

Q, SHADOW = 1.0, 2.0

@kernel
def halved(x):
    return 0.5 * x + Q
"""
ANSWER = 0.5 * (2.0 + 1.0 + 2.0 + 1.0 + 1.0 + 4.0 + 1.0) + 1.0 + 1.0 + 1.0
FILE_EDITS = {  # what an editor changes between two processes, and the answer then
    "a constant, which is also a default": (("P, TABLE, SHADOW = 1.0", "P, TABLE, SHADOW = 3.0"), ANSWER + 3.0),
    "the order of fields": (("    one: float\n    other: float", "    other: float\n    one: float"), ANSWER + 0.5),
    "an enumeration": (("A = 4", "A = 6"), ANSWER + 1.0),
    "a closure": (("adding(1.0)", "adding(3.0)"), ANSWER + 2.0),
    "a constant called as a global of another module": (("SHADOW = 1.0, 2.0", "SHADOW = 1.0, 4.0"), ANSWER + 1.0),
    "the kernel of a module in a module": (("0.5 * x + Q", "0.5 * x - Q"), ANSWER - 2.0),
    "a builtin": (("@kernel\ndef answer", "@kernel\ndef max(x, y):\n    return -x\n\n@kernel\ndef answer"), -ANSWER)}
CELL_EDITS = {  # what a notebook's cell changes
    "an array in place": ("TABLE[0] = 3.0", ANSWER + 1.0),
    "a named tuple": ("PAIR = PAIR._replace(one=3.0)", ANSWER + 1.0),
    "a closure": ("add_to(2.0)", ANSWER + 2.0),
    "a kernel with a closure": ("add, _ = adding(3.0)", ANSWER + 2.0),
    "a kernel": ("@kernel\ndef raised(x, by=P):\n    return x - by", ANSWER - 2.0),
    "the constant of a module": ("outer.inner.Q = 3.0", ANSWER + 1.0 + 2.0),
    "the kernel of a module": ("outer.inner.halved = raised", ANSWER + 6.0),
    "a builtin": ("@kernel\ndef max(x, y):\n    return -x", -ANSWER)}


@pytest.fixture
def program(tmp_path, monkeypatch):
    """A function that executes the two modules as another process would, and returns the outer one."""
    monkeypatch.setenv("NEORL_CACHE", str(tmp_path))

    def load(*edit):
        for name, source in (("outer", OUTER), ("outer.inner", INNER)):
            monkeypatch.setitem(sys.modules, name, ModuleType(name))
        sys.modules["outer"].inner = sys.modules["outer.inner"]
        for name, source in (("outer.inner", INNER), ("outer", OUTER)):
            exec(source.replace(*edit) if edit else source, vars(sys.modules[name]))
        return sys.modules["outer"]

    return load


@pytest.mark.parametrize("edit, answer", FILE_EDITS.values(), ids=FILE_EDITS)
def test_what_an_editor_changes_between_processes_changes_the_identity_and_the_answer(program, edit, answer):
    before, again = identity(program().answer), identity(program().answer)
    assert before == again != identity(program(*edit).answer)
    assert execute(program().answer, 2.0) == ANSWER  # which is then on disk
    assert execute(program(*edit).answer, 2.0) == answer


@pytest.mark.parametrize("cell, answer", CELL_EDITS.values(), ids=CELL_EDITS)
def test_what_a_cell_changes_within_a_process_changes_the_compiled_code(program, cell, answer):
    outer = program()
    before = identity(outer.answer)
    assert execute(outer.answer, 2.0) == ANSWER
    exec(cell, vars(outer))
    assert execute(outer.answer, 2.0) == answer and identity(outer.answer) != before
    assert execute(program().answer, 2.0) == ANSWER  # another process reads nothing that was compiled otherwise


@pytest.mark.skipif(jit_is_off(), reason="the compiler is off")
def test_nothing_is_compiled_again_while_values_are_equal(program):
    outer = program()
    execute(outer.answer, 2.0)
    compiled = outer.answer.for_python
    outer.P, outer.TABLE = 2.0 / 2.0, outer.TABLE.copy()
    assert outer.answer.for_python is compiled and Reading(outer.answer).stands()


def test_a_maker_that_looks_up_a_changed_value_makes_another_kernel():
    scale = 1.0

    @kernel_maker
    def scaled(factor):
        by = factor * scale

        @kernel
        def multiply(x):
            return by * x

        return multiply

    first = scaled(2.0)
    assert scaled(2.0) is first is not scaled(3.0) and execute(first, 1.0) == 2.0
    scale = 5.0
    assert scaled(2.0) is not first and execute(scaled(2.0), 1.0) == 10.0
    with pytest.raises(ValueError, match="function must be without arguments by name alone"):
        kernel_maker(lambda a, *, by: None)


def test_a_maker_that_is_given_an_equal_kernel_makes_another_since_either_may_change():
    def adding(amount):
        def add_to(more):
            nonlocal amount
            amount += more

        return kernel(lambda x: x + amount), add_to

    @kernel_maker
    def twice(once):
        return kernel(lambda x: once(once(x)))

    (one, _), (other, add_to_other) = adding(1.0), adding(1.0)
    of_one, of_other = twice(one), twice(other)
    add_to_other(2.0)
    assert (execute(of_one, 0.0), execute(of_other, 0.0)) == (2.0, 6.0)


@pytest.mark.skipif(jit_is_off(), reason="the compiler is off")
def test_functions_that_numba_compiles_by_itself_are_refused():
    import numba

    def tripled(x):
        return 3.0 * x

    def answering(called):
        return kernel(lambda x: called(x))

    for called in numba.njit(tripled), numba.vectorize(tripled):
        with pytest.raises(ValueError, match="decorated with neorl.kernel, but call .*tripled, which"):
            answering(called)


def test_what_borrows_the_name_of_a_known_module_counts_by_its_content_all_the_same():
    made = [type("Made", (), {"pay": pay, "__module__": "types"}) for pay in (1, 2)]
    numbered = [Enum("E", {"name": number}) for number in (1, 2)]
    record = np.array([(1.0, 2)], dtype=[("pay", "f8"), ("n", "i8")])[0]
    before = Reading(record)
    record["pay"] = 5.0
    assert identity(made[0]) != identity(made[1]) and identity(numbered[0]) != identity(numbered[1])
    assert not before.stands() and identity(record) != before.text


def test_what_a_module_makes_when_it_is_asked_for_a_name_is_read_again_each_time():
    paying, made = ModuleType("paying"), SimpleNamespace(pay=1.0)
    paying.__getattr__ = lambda name: getattr(made, name)
    before = Reading(kernel(lambda: paying.pay))
    assert before.stands()
    made.pay = 2.0
    assert not before.stands()


@dataclass(frozen=True)
class Holder:
    held: object


@pytest.mark.parametrize("one, other", [
    ({"a": 1}, {"a": 2}), ({1, 2}, {1, 3}), ([1], (1,)), (1, 1.0), (0.0, -0.0), (np.float32(1), 1.0),
    (np.array([1, "a"], object), np.array([1, "b"], object)), ({"a": np.zeros(9_999)}, {"a": np.eye(1, 9_999, 5)[0]}),
    (Holder([1]), Holder([2])), (np.random.default_rng(1), np.random.default_rng(2))])
def test_values_have_the_identity_of_their_content(one, other):
    assert identity(Holder(one)) == identity(Holder(one)) != identity(Holder(other))


def test_what_cannot_be_read_has_no_identity():
    with pytest.raises(ValueError, match="what a result depends on must be numbers, texts, tuples, arrays, kernels o"):
        identity(Holder(each for each in ()))


def test_source_that_changes_after_the_import_does_not_count():
    work = ("import importlib.machinery, neorl\nimportlib.machinery.SourceFileLoader.get_source = None\n"
            "from neorl.kernels.identity import ROOMS, digest_of_source\n"
            "from neorl.experiments.condition import source_digest\n"
            "print(source_digest(), digest_of_source(*ROOMS))")
    subprocess.run([sys.executable, "-c", work], check=True)


def test_a_kernel_of_the_main_program_counts_by_its_content_under_a_profiler_too(tmp_path):
    program = "from neorl import kernel\nfrom neorl.kernels.identity import identity\nA = {}\n\n@kernel\ndef f(x):\n" \
              "    return x + A\n\nprint(identity(f))\n"
    read = []
    for constant, how in [(1.0, []), (1.0, ["-m", "cProfile"]), (2.0, ["-m", "cProfile"])]:
        (tmp_path / "program.py").write_text(program.format(constant))
        done = subprocess.run([sys.executable, *how, "program.py"], cwd=tmp_path, check=True, capture_output=True,
                              text=True)
        read.append(done.stdout.splitlines()[0])
    assert read[0] == read[1] != read[2]
