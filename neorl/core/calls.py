"""How Python calls kernels, and passes them the record and the named tuples of an agent: each by one pointer.

In a kernel, a table looks like the named tuple that it is made of (`neorl.core.tables`). A kernel among the fields is
passed by the address of its code. So it is compiled once and by itself, and replacing it compiles nothing else.
"""

import functools

import numpy as np

from neorl.core.interpreted import interpreted
from neorl.core.kernel import Kernel, full_name, interpreting, is_tuple, jit_is_off
from neorl.core.kernel_errors import raise_named


def execute(kernel, *arguments):
    """Call a kernel from Python.

    A named tuple whose kind is `tabled`, and that the kernel annotates as such, is passed as a table.

    Raises TypeError for one that is only inlined into others, or that numba cannot compile, ValueError for one of the
    user's that raises. Both name the kernel that is to blame.
    """
    if getattr(kernel, "is_inlined", False):
        raise TypeError(f"{kernel.__module__}.{kernel.__name__} must be called by kernels, into which it is inlined, "
                        "not by execute")
    try:
        if not isinstance(kernel, Kernel):
            return interpret(kernel, *arguments)
        passed = list(_passed(kernel, arguments))
        if any(is_passed(each) for each in passed):  # numba would look up their types far more slowly
            return kernel.compiled_for(tuple(map(type_of, passed))).entry(*map(content_of, passed))
        return kernel.for_python(*passed)
    except Exception as error:
        raise_named((kernel, *_kernels_in(arguments)), error)


def interpret(kernel, *arguments):
    """Call a kernel as a Python function, which gives the same bits; to compile what runs once would take longer."""
    with interpreting():
        return kernel(*map(interpreted, arguments))


def bound(called, *arguments):
    """A function without arguments that executes a kernel of this package on these named tuples."""
    if jit_is_off():
        return lambda: execute(called, *arguments)
    arguments = [in_table(each, record_among(arguments)) for each in arguments]
    entry = called.compiled_for(tuple(map(type_of, arguments))).entry
    contents = [content_of(each) for each in arguments]

    def call():
        for each in arguments:
            each.refresh()
        try:
            return entry(*contents)
        except Exception as error:
            raise_named((called, *_kernels_in(arguments)), error)

    return call


def in_table(values, record=None):
    """A named tuple, or an agent's record, as `execute` passes it on, so that this need not be done at every call.

    record: the dtype of the record of an agent whose kernels are among the fields.
    """
    if jit_is_off():
        return interpreted(values)
    from neorl.core.tables import Table

    return PassedRecord(values) if is_record(values) else Table(values, record)


def record_among(arguments):
    """The dtype of the record among the arguments of a kernel, or None."""
    within = (record_among(each) for each in arguments if is_tuple(each))
    return next((each.dtype for each in arguments if is_record(each) or isinstance(each, PassedRecord)),
                next(filter(None, within), None))


def is_record(value):
    """Whether an argument is the record of an agent: an array without axes."""
    return isinstance(value, np.ndarray) and value.ndim == 0 and value.dtype.names is not None


def is_passed(value):
    """Whether an argument is as `in_table` returns it."""
    return hasattr(value, "refresh")


def _passed(kernel, arguments):
    code = kernel.py_func.__code__
    if len(arguments) != code.co_argcount:
        raise TypeError(f"{full_name(kernel)} must be called with {code.co_argcount} arguments, but is with "
                        f"{len(arguments)}")
    for name, each in zip(code.co_varnames, arguments):
        if is_passed(each):
            each.refresh()
        elif is_record(each) or getattr(kernel.__annotations__.get(name), "is_tabled", False):
            each = in_table(each, record_among(arguments))
        yield each


def _kernels_in(arguments):
    for each in arguments:
        values = getattr(each, "values", each)
        for field in values if is_tuple(values) else ():
            yield from [field] if callable(field) else _kernels_in([field])


def type_of(value):
    """The numba type of an argument."""
    from numba import typeof

    return value.type if is_passed(value) else typeof(value)


def content_of(value):
    """What compiled code is called with for an argument."""
    return value.content if is_passed(value) else value


class PassedRecord:
    """An agent's record for compiled code, with its numba type."""

    def __init__(self, record):
        self.content, self.dtype, self.type = record[()], record.dtype, _type_of_record(record.dtype)

    def refresh(self):
        """Do nothing: the user's kernels are elsewhere."""


@functools.cache
def _type_of_record(dtype):
    from numba import from_dtype

    return from_dtype(dtype)
