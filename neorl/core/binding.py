"""Repeated calls of a kernel with the same arguments, at the cost of passing one.

An agent consists of some eighty arrays, and passing them from Python to compiled code takes ten microseconds. So their
addresses are put into a table once, and a compiled entry point reads them from it.
"""

import functools

import numpy as np

from neorl.core.kernel import Kernel, execute, fields, is_tuple, kernel_maker
from neorl.core.kernel_errors import raise_named


def bound(called, *arguments):
    """A function without arguments that executes a kernel on these named tuples of arrays and numbers."""
    if not isinstance(called, Kernel):
        return lambda: execute(called, *arguments)
    numbers, table = [], []
    for each in arguments:
        _enter(each, table, numbers)
    entry, table, numbers = _entry(called), np.array(table, np.int64), np.array(numbers, np.float64)

    def call(kept_alive=arguments):
        try:
            return entry.for_python(table, numbers)
        except Exception as error:
            raise_named(entry, error)

    return call


def _enter(values, table, numbers):
    for value, kind in zip(values, fields(type(values)).values()):
        if is_tuple(kind):
            _enter(value, table, numbers)
        elif isinstance(value, np.ndarray):
            table += [value.ctypes.data, *value.shape]
        elif kind in (bool, int):
            table.append(value)
        else:
            numbers.append(value)


@kernel_maker
def _entry(called):
    """The compiled function (table, numbers) that calls a kernel."""
    from numba import carray

    scope, place = {"__name__": __name__, "called": called, "carray": carray, "np": np}, [0, 0]
    kinds = [kind for name, kind in fields(called).items() if name != "return"]
    source = f"def entry(table, numbers):\n    return called({', '.join(_taken(kind, scope, place) for kind in kinds)})"
    exec(source, scope)
    return Kernel(scope["entry"], {"error_model": "numpy", "nogil": True})  # making an array from an address needs _nrt


def _taken(kind, scope, place):
    """The expression that reads a value from the table or the numbers; advances `place`, the positions in both."""
    if is_tuple(kind):
        scope[kind.__name__] = kind
        return f"{kind.__name__}({', '.join(_taken(each, scope, place) for each in fields(kind).values())})"
    at, number = place
    if isinstance(kind, tuple):
        dtype, shape = kind
        scope[f"pointer_to_{np.dtype(dtype)}"] = _pointer_to(dtype)
        place[0] += 1 + len(shape)
        lengths = "".join(f"table[{at + 1 + axis}], " for axis in range(len(shape)))
        return f"carray(pointer_to_{np.dtype(dtype)}(table[{at}]), ({lengths}))"
    if kind in (bool, int):
        place[0] += 1
        return f"table[{at}] != 0" if kind is bool else f"table[{at}]"
    place[1] += 1
    return f"np.float32(numbers[{number}])" if kind is np.float32 else f"numbers[{number}]"


@functools.cache
def _pointer_to(dtype):
    """A function for compiled code that turns an address into a pointer to an array."""
    from numba import from_dtype, types
    from numba.extending import intrinsic

    kind = types.CPointer(from_dtype(np.dtype(dtype)))

    @intrinsic
    def pointer(typing, address):
        def generate(context, builder, signature, arguments):
            return builder.inttoptr(arguments[0], context.get_value_type(kind))

        return kind(types.int64), generate

    return pointer
