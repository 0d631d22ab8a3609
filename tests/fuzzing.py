"""Hostile values, and calls in which one of them replaces a valid argument: the engine of `test_fuzzing.py`.

    python tests/fuzzing.py EXAMPLES NAME…    fuzzes some entries of `public_calls.TABLE` in a process of their own

A call must raise a clear error, which names the argument and what it must be, or return a sound value, which is
usable and without NaN. A call that takes `SECONDS` ends the process with a traceback.
"""

import contextlib
import copy
import dataclasses
import faulthandler
import inspect
import itertools
import math
import numbers
import operator
import resource
import sys
import tempfile
import warnings
from collections.abc import Callable
from decimal import Decimal
from fractions import Fraction

import numba
import numpy as np
from hypothesis import HealthCheck, Phase, given, settings
from hypothesis import strategies as st

from neorl import kernel
from neorl.custom import greedy
from neorl.kernels.kernel import Kernel

SECONDS = 100 if numba.config.DISABLE_JIT else 900  # compiling is slow on a busy machine
MEMORY = 12 * 2**30  # bytes of address space, so that an excessive list raises an error before memory is exhausted
ERRORS = (ValueError, TypeError, MemoryError)


class Unprintable:
    def __repr__(self):
        raise RuntimeError("no repr")


class Unequal(str):
    def __eq__(self, other):
        return np.array([True, False])

    __hash__ = str.__hash__


class Wordy:
    def __repr__(self):
        return "{x!r} %s\n" * 100_000


def itself():
    inner = []
    inner.append(inner)
    return inner


def deep():
    inner = []
    for _ in range(100_000):
        inner = [inner]
    return inner


@kernel
def of_nothing():
    return 0


ODD = [
    lambda: None, lambda: True, lambda: "", lambda: "x", lambda: "\ud800", lambda: b"x", lambda: "nan", lambda: 0,
    lambda: -1, lambda: 1, lambda: 2**31, lambda: 2**53 + 1, lambda: 2**63, lambda: 2**64, lambda: 2**80,
    lambda: -(2**80), lambda: 10**400, lambda: 10**5000, lambda: math.nan, lambda: math.inf, lambda: -math.inf,
    lambda: -0.0, lambda: 5e-324, lambda: 1e-300, lambda: 1e30, lambda: -1e30, lambda: 1e38, lambda: 1e308,
    lambda: -1.7e308, lambda: 1j, lambda: Fraction(1, 3), lambda: Fraction(10**400, 3), lambda: Decimal("1.5"),
    lambda: Decimal("NaN"), lambda: np.float16(0.5), lambda: np.float32("nan"), lambda: np.longdouble("1e400"),
    lambda: np.int8(-1), lambda: np.uint64(2**64 - 1), lambda: np.bool(True), lambda: np.array(5),
    lambda: np.array(0.5), lambda: np.array("x"), lambda: np.array(math.nan), lambda: np.array(None),
    lambda: np.datetime64("NaT"),
    lambda: (), lambda: [], lambda: {}, lambda: set(), lambda: {"x": 1}, lambda: {0.5}, lambda: [None],
    lambda: [math.nan], lambda: [[1], [1, 2]], lambda: ["x", 1], lambda: [0.5], lambda: (1, 2), lambda: range(3),
    lambda: range(2**80), lambda: range(10**12), lambda: range(10**9), lambda: np.zeros(0), lambda: np.zeros((0, 3)),
    lambda: np.zeros(3), lambda: np.zeros((2, 2), complex), lambda: np.ones((2, 3)), lambda: np.zeros((1,) * 64),
    lambda: np.array(["a", "b"]), lambda: np.array([1, None]), lambda: np.broadcast_to(0.0, (10**12,)),
    lambda: np.array([0.5, math.nan]), lambda: np.array([2**80, 1]), lambda: np.array([("a", 1)], "U1,i4"),
    lambda: np.ma.masked_array([1.0, 2.0], [True, False]), lambda: object(), Unprintable, lambda: [Unprintable()],
    Wordy, lambda: Unequal("cell"), lambda: itertools.repeat(0), lambda: iter([1.0]), lambda: (lambda *_: 0),
    lambda: int, lambda: ValueError("x"), lambda: greedy, lambda: of_nothing, itself, deep, lambda: sys,
    lambda: Ellipsis,
]
DTYPES = ("f2", "f4", ">f4", "f8", ">f8", "g", "i1", "i8", "u8", "?", "c16", "O", "U8", "M8[s]")

odd = st.one_of(st.sampled_from(ODD).map(lambda make: make()), st.integers(), st.floats(), st.text(max_size=5))


@st.composite
def altered(draw, value):
    """A user's value in another form, or with an odd value in it or in its place."""
    kind = draw(st.integers(0, 3))
    if kind == 0 or not isinstance(value, numbers.Real | str | tuple | list | np.ndarray):
        return draw(odd)
    if isinstance(value, bool | str):
        return draw(st.sampled_from([value, np.array(value), [value], np.str_(value), str(value).encode(), not value]))
    if isinstance(value, numbers.Real):
        forms = [lambda: np.array(value), lambda: np.float64(value), lambda: np.array([value]), lambda: [value],
                 lambda: str(value), lambda: -value, lambda: value * 1e300, lambda: value * 1e-320,
                 lambda: Fraction(value), lambda: complex(value)]
        return draw(st.sampled_from(forms))()
    if isinstance(value, np.ndarray):
        return draw(altered_array(value))
    if len(value) and kind > 1:
        values, at = list(value), draw(st.integers(0, len(value) - 1))
        values[at] = draw(altered(values[at]))
        return type(value)(*values) if hasattr(value, "_fields") else type(value)(values)
    if hasattr(value, "_fields"):
        return tuple(value)
    forms = [list, tuple, iter, lambda each: each[1:], lambda each: [*each, *each], lambda each: [each], set_or_none,
             lambda each: np.array(each, object), lambda each: dict.fromkeys(map(repr, each))]
    return draw(st.sampled_from(forms))(value)


def set_or_none(values):
    try:
        return set(values)
    except TypeError:
        return None


@st.composite
def altered_array(draw, value):
    if draw(st.booleans()) and value.size and value.dtype.kind == "f":
        value = value.copy()
        value.flat[draw(st.integers(0, value.size - 1))] = draw(st.sampled_from(
            [math.nan, math.inf, -math.inf, 1e30, 3e38, -3e38, 1e-40, -0.0]))
        return value
    forms = [np.asfortranarray, lambda each: each[..., ::-1], lambda each: np.repeat(each, 2, 0)[::2], read_only,
             lambda each: each[1:], lambda each: each[None], lambda each: each.reshape(-1), lambda each: each.tolist(),
             lambda each: each.view(np.matrix) if each.ndim == 2 else each, lambda each: each[:0],
             *(lambda each, to=to: each.astype(to) for to in DTYPES)]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            return draw(st.sampled_from(forms))(value)
        except (ValueError, TypeError, IndexError):
            return None


def read_only(array):
    array = array.copy()
    array.flags.writeable = False
    return array


@dataclasses.dataclass(frozen=True)
class Entry:
    """A callable to fuzz: the function, a strategy for each argument, words in its errors, and the use of its value."""

    function: Callable
    arguments: dict
    also: tuple = ()  # words that an error may use in place of the argument's name
    then: Callable = lambda value: value
    errors: tuple = ()  # other exceptions that are documented
    long: tuple = ()  # arguments that count steps or runs: large values are allowed and take long


def entry(function, /, *, also=(), then=lambda value: value, errors=(), long=(), **arguments):
    """An `Entry`. arguments: for each, a list of allowed values, which are copied, or a strategy."""
    return Entry(function, {name: each if isinstance(each, st.SearchStrategy) else
                            st.sampled_from(each).map(copy.deepcopy) for name, each in arguments.items()},
                 (also,) if isinstance(also, str) else also, then, errors, long)


def attempt(name, called, arguments, replaced, shown):
    """Call an entry's function. Raises AssertionError unless the outcome is a clear error or a sound value."""
    try:
        value = called.then(called.function(**arguments))
    except (*ERRORS, *called.errors) as error:
        message = str(error)
        clear = (isinstance(error, (MemoryError, *called.errors))
                 or type(error) in ERRORS and any(word in message for word in (replaced, *called.also))
                 and any(word in message for word in ("must", "cannot")))
        assert clear and len(message) < 5_000, f"{name}({shown}): {type(error).__name__}: {message[:600]}"
    except Exception as error:
        raise AssertionError(f"{name}({shown}): {type(error).__name__}: {str(error)[:600]}") from error
    else:
        assert not has_nan(value), f"{name}({shown}) is {str(value)[:600]}"


def has_nan(value, depth=6):
    """Whether a value contains NaN."""
    if depth == 0 or isinstance(value, Kernel):
        return False
    if isinstance(value, np.ndarray):
        return value.dtype.kind in "fc" and bool(np.isnan(value).any())
    if isinstance(value, float | np.floating):
        return bool(np.isnan(value))
    if isinstance(value, tuple | list):
        return any(has_nan(each, depth - 1) for each in value)
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        return any(has_nan(getattr(value, each.name), depth - 1) for each in dataclasses.fields(value))
    return False


def fuzz(name, called, examples):
    """Call an entry's function `examples` times, each time with at most one argument altered."""

    @settings(max_examples=examples, deadline=None, derandomize=True, database=None,
              phases=(Phase.explicit, Phase.generate) if examples < 200 else (Phase.generate, Phase.shrink),
              suppress_health_check=list(HealthCheck), print_blob=False)
    @given(st.data())
    def run(data):
        arguments = {each: data.draw(values) for each, values in called.arguments.items()}
        replaced = data.draw(st.sampled_from(list(arguments)))
        before = arguments[replaced]
        arguments[replaced] = data.draw(altered(before))
        if (replaced in called.long and takes_long(arguments[replaced])
                or numba.config.DISABLE_JIT and inspect.isfunction(arguments[replaced])):  # all are kernels then
            return
        faulthandler.dump_traceback_later(SECONDS, exit=True)
        attempt(name, called, arguments, replaced, f"{replaced}={text(arguments[replaced])}")
        faulthandler.cancel_dump_traceback_later()

    run()


def takes_long(value):
    try:
        return 1_000 < operator.index(value) < 2**62
    except TypeError:
        return False


def text(value):
    try:
        return f"{type(value).__name__} {value!r}"[:300]
    except Exception:
        return f"a {type(value).__name__}"


def main(examples, *names):
    from public_calls import TABLE

    faulthandler.enable()
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    warnings.simplefilter("error")
    failed = 0
    with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):  # a path may be any text
        for name in names or TABLE:
            print(name, flush=True)
            try:
                fuzz(name, TABLE[name], int(examples))
            except Exception as error:
                failed += 1
                print("FAILED", getattr(error, "exceptions", [error])[0], flush=True)
    sys.exit(min(failed, 1))


if __name__ == "__main__":
    main(*sys.argv[1:])
