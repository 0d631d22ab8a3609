"""How Python calls kernels, and passes them the named tuples of an agent: each as a `Table`, by its address.

An agent consists of some eighty arrays. Passing them one by one would make every call slow, and every kernel that
takes them slow to compile. In a kernel a table looks like the named tuple that it is made of (`neorl.core.views`).

A kernel among the fields, with the signature that `function` annotates, is passed by the address of its code. So it is
compiled once and by itself, and replacing it compiles nothing else.
"""

from collections.abc import Callable
from typing import Annotated, NamedTuple, get_args

import numpy as np

from neorl import checks
from neorl.core.kernel import Kernel, fields, full_name, interpreting, is_tuple, jit_is_off
from neorl.core.kernel_errors import raise_named


def execute(kernel, *arguments):
    """Call a kernel from Python.

    A named tuple whose kind is `tabled`, and that the kernel annotates as such, is passed as a table.

    Raises TypeError for one that is only inlined into others, or that numba cannot compile, ValueError for one of the
    user's that raises. Both name the kernel that is to blame.
    """
    if "no_cpython_wrapper" in getattr(kernel, "options", ()):
        raise TypeError(f"{kernel.__module__}.{kernel.__name__} must be called by kernels, into which it is inlined, "
                        "not by execute")
    try:
        if isinstance(kernel, Kernel):
            return kernel.for_python(*_passed(kernel, arguments))
        return interpret(kernel, *arguments)
    except Exception as error:
        raise_named((kernel, *_kernels_in(arguments)), error)


def interpret(kernel, *arguments):
    """Call a kernel as a Python function, which gives the same bits; to compile what runs once would take longer."""
    with interpreting():
        return kernel(*arguments)


def bound(called, *arguments):
    """A function without arguments that executes a kernel of this package on these named tuples."""
    if jit_is_off():
        return lambda: execute(called, *arguments)
    from numba import typeof

    tables = [Table(each) for each in arguments]
    entry = called.compiled_for(tuple(map(typeof, tables))).entry

    def call():
        for table in tables:
            table.refresh()
        try:
            return entry(*tables)
        except Exception as error:
            raise_named((called, *_kernels_in(arguments)), error)

    return call


def tabled(kind):
    """Declare that a kind of named tuple is passed to compiled code as a table."""
    kind.is_tabled = True
    return kind


def in_table(values):
    """A named tuple as `execute` passes it on, so that this need not be done at every call."""
    return values if jit_is_off() else Table(values)


def _passed(kernel, arguments):
    code = kernel.py_func.__code__
    if len(arguments) != code.co_argcount:
        raise TypeError(f"{full_name(kernel)} must be called with {code.co_argcount} arguments, but is with "
                        f"{len(arguments)}")
    for name, each in zip(code.co_varnames, arguments):
        if isinstance(each, Table):
            each.refresh()
        elif getattr(kernel.__annotations__.get(name), "is_tabled", False):
            each = Table(each)
        yield each


def _kernels_in(arguments):
    values = [each.values if isinstance(each, Table) else each for each in arguments]
    return [field for each in values if is_tuple(each) for field in each if callable(field)]


class Signature(NamedTuple):
    """The types of a kernel: each argument an annotation, or `typing.Self` for the tuple that holds the kernel."""

    arguments: tuple
    returns: type | None


def function(*arguments, returns):
    """The annotation of a kernel with these arguments, which may be missing: None."""
    return Annotated[Callable, Signature(tuple(get_args(each)[1:] or each for each in arguments), returns)]


class Table:
    """A named tuple for compiled code: words, of which each is an address or a length of an array, or a number.

    The lengths of tuples among the fields are part of its type, so that they are known when kernels are compiled.
    """

    def __init__(self, values):
        self.values, self.kind, self._users = values, type(values), []
        self.lengths = tuple(len(each) for each in values if type(each) is tuple)
        self.words = np.array(list(self._words(values)), np.int64)
        self.address = self.words.ctypes.data

    @property
    def _numba_type_(self):
        from neorl.core.views import View

        return View(self.kind, self.lengths)

    def _words(self, values):
        for value, (name, field) in zip(values, fields(type(values)).items()):
            if is_tuple(field):
                yield from self._words(value)
            elif isinstance(value, np.ndarray):
                dtype, shape = field
                if value.dtype != dtype or value.ndim != len(shape) or not value.flags.c_contiguous:
                    raise ValueError(f"{name} must be a contiguous array of {np.dtype(dtype)} with {len(shape)} axes, "
                                     f"but is {checks.shown(value)}")
                yield from (value.ctypes.data, *value.shape)
            elif field in (bool, int):
                yield int(value)
            elif field in (float, np.float32):
                yield int(np.float64(value).view(np.int64))
            elif field is not tuple:
                yield self._address(name, value)

    def _address(self, name, kernel):
        if kernel is None:
            return 0
        called = self._numba_type_.member(name)[1]
        compiled = kernel.compiled_for(called.arguments, called.returns)
        if kernel.is_users:
            self._users.append((kernel, compiled.dispatcher))
        return compiled.address

    def refresh(self):
        """Compile the user's kernels again if what they look up has changed."""
        if any(kernel.for_python is not compiled for kernel, compiled in self._users):
            self._users = []
            self.words[:] = list(self._words(self.values))

