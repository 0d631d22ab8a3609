"""How Python calls kernels, and passes them the record and the named tuples of an agent: each by one pointer.

In a kernel, a table looks like the named tuple that it is made of (`neorl.kernels.tables`). A kernel among the fields
is passed by the address of its code. So it is compiled once and by itself, and replacing it compiles nothing else.
"""

import numpy as np

from neorl.kernels.annotations import is_tuple
from neorl.kernels.errors import raise_named
from neorl.kernels.interpreted import interpreted
from neorl.kernels.kernel import Kernel, full_name, interpreting, jit_is_off


def execute(kernel, *arguments):
    """Call a kernel from Python.

    A named tuple whose kind is `tabled`, and that the kernel annotates as such, is passed as a table.

    Raises TypeError for one that is only inlined into others, or that numba cannot compile, ValueError for one of the
    user's that raises. Both name the kernel that is to blame. Raises RuntimeError if numba's compiler was switched off
    or on since the package was imported.
    """
    if getattr(kernel, "is_inlined", False):
        raise TypeError(f"{kernel.__module__}.{kernel.__name__} must be called by kernels, into which it is inlined, "
                        "not by execute")
    jit_is_off()  # or it raises
    try:
        if not isinstance(kernel, Kernel):
            return interpret(kernel, *arguments)
        return kernel.for_python(*_passed(kernel, arguments))
    except Exception as error:
        raise_named((kernel, *_kernels_in(arguments)), error)


def interpret(kernel, *arguments):
    """Call a kernel as a Python function, which gives the same bits; to compile what runs once would take longer."""
    with interpreting():
        return kernel(*map(interpreted, arguments))


def bound(kernel, *arguments):
    """A function without arguments that executes a kernel of this package on these named tuples."""
    if jit_is_off():
        return lambda: execute(kernel, *arguments)
    tables = [in_table(values, _record_among(arguments)) for values in arguments]
    # Past numba's dispatcher, which would look up the types of the arguments at every call.
    entry = kernel.compiled_for(tuple(table._numba_type_ for table in tables)).entry

    def call():
        for table in tables:
            table.refresh()
        try:
            return entry(*tables)
        except Exception as error:
            raise_named((kernel, *_kernels_in(tables)), error)

    return call


def in_table(values, record=None):
    """A named tuple, or an agent's record, as `execute` passes it on, so that this need not be done at every call.

    record: the dtype of the record of an agent whose kernels are among the fields.
    """
    if jit_is_off():
        return interpreted(values)
    if _is_record(values):
        return values[()]
    from neorl.kernels.tables import Table

    return Table(values, record)


def _passed(kernel, arguments):
    code = kernel.py_func.__code__
    if len(arguments) != code.co_argcount:
        raise TypeError(f"{full_name(kernel)} must be called with {code.co_argcount} arguments, but is with "
                        f"{len(arguments)}")
    for name, value in zip(code.co_varnames, arguments):
        if hasattr(value, "refresh"):
            value.refresh()
        elif _is_record(value) or is_tuple(value) and getattr(kernel.__annotations__.get(name), "is_tabled", False):
            value = in_table(value, _record_among(arguments))
        yield value


def _record_among(values):
    """The dtype of the record of an agent among arguments, and what they consist of, or None."""
    if isinstance(values, tuple):
        return next(filter(None, map(_record_among, values)), None)
    return values.dtype if _is_record(values) else None


def _is_record(value):
    return isinstance(value, np.ndarray | np.void) and value.ndim == 0 and value.dtype.names is not None


def _kernels_in(arguments):
    for value in arguments:
        value = getattr(value, "values", value)
        if is_tuple(value):
            yield from _kernels_in(value)
        elif callable(value):
            yield value
