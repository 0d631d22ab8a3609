"""How a kernel is compiled, and what it may contain.

A *kernel* is a function that numba compiles. Every number that the project shows comes out of one, so a run must be
the same to the last bit on any machine, on any number of threads, and with the compiler switched off
(``NUMBA_DISABLE_JIT=1``). That holds as long as a kernel keeps to these rules:

- it takes flat arrays, scalars and named tuples of them, and allocates, raises, prints and looks up nothing;
- it uses only ``+ - * /``, square root, floor and comparisons, whose results IEEE 754 fixes, and no ``fastmath``;
- it draws random numbers from a stream that it is handed (`neorl.core.stream`), never from ``np.random``;
- it writes ``np.float32(...)`` where single precision is meant: a literal is double for numba, but weak for NumPy.

Annotations say what the arrays of a named tuple hold, and what a kernel takes that is called from outside Python
(`neorl.browser.wasm`); numba does not read them.

Nothing that is compiled is kept on disk: numba notices a change in a kernel's own file, but not in the files of the
kernels that it calls, and a result must never come from code that is no longer there.
"""

from typing import Annotated, get_args, get_type_hints

import numba
import numpy as np

# Without numba's memory runtime (_nrt) a kernel cannot allocate, and counts no references to the arrays it is handed.
OPTIONS = {"error_model": "numpy", "nogil": True, "_nrt": False}
kernel = numba.njit(**OPTIONS)
# A plan has so many arrays that handing it over costs more than most kernels that take it; inlined, it costs nothing.
inlined_kernel = numba.njit(**OPTIONS, forceinline=True, no_cpython_wrapper=True, no_cfunc_wrapper=True)


def array(dtype, *shape):
    """The annotation of an array: what it holds, and its shape in numbers, names of sizes, or names plus one."""
    return Annotated[np.ndarray, dtype, shape]


def fields(kind):
    """What a named tuple or a kernel takes: {name: (dtype, shape)} for arrays, {name: type} for all else."""
    return {name: get_args(hint)[1:] or hint for name, hint in get_type_hints(kind, include_extras=True).items()}


def zeros(kind, sizes):
    """The arrays of a named tuple, all 0, by name."""
    return {name: np.zeros([length(each, sizes) for each in field[1]], field[0])
            for name, field in fields(kind).items() if isinstance(field, tuple)}


def length(dimension, sizes):
    """How long a dimension is: a number, a name of `sizes`, or "name + 1"."""
    if isinstance(dimension, int):
        return dimension
    name, _, more = dimension.partition(" + ")
    return sizes[name] + int(more or 0)
