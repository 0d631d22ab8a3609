"""How numba compiles kernels: linked into each other (`neorl.kernels.linking`), or else each by itself.

The kernels of this package are cached on disk (`neorl.kernels.caching`). The user's kernels, and those with them
within, are compiled in each process.
"""

import functools
import hashlib
import importlib
import logging
import os
from types import FunctionType
from typing import Any, NamedTuple

import numba

from neorl.kernels.identity import is_ours

# A division by zero does not raise, and threads run side by side.
OPTIONS = {"error_model": "numpy", "nogil": True}
UNLINKED = "NEORL_UNLINKED"  # set in the environment, kernels are compiled each by itself


class Compiled(NamedTuple):
    """A kernel's code for certain types of its arguments."""

    dispatcher: Any  # numba's, which keeps the code
    library: Any
    name: str  # in the library
    entry: Any  # for calls from Python with arguments of just these types


@functools.cache
def links():
    """Whether kernels are linked into each other."""
    return not os.environ.get(UNLINKED) and _has("linking", "link kernels, so a first step takes twice as long")


@functools.cache
def caches():
    """Whether the kernels of this package are cached."""
    return _has("caching", "cache kernels, so each process compiles them again")


def _has(module, purpose):
    """Whether this version of numba has what a module relies on; where not, it is logged what that was for."""
    try:
        importlib.import_module(f"neorl.kernels.{module}").check()
    except Exception as error:  # of any class, from another version of numba
        logging.getLogger("neorl").warning("numba %s cannot %s: %s", numba.__version__, purpose, error)
        return False
    return True


@functools.cache
def options(**more):
    """numba's options for kernels: those it documents, and those of the others that this version has.

    Without its memory runtime (_nrt), a kernel cannot allocate, and does not count references to its arrays.
    """
    try:
        from numba.core.options import DefaultOptions
    except ImportError:
        return OPTIONS
    return OPTIONS | {name: value for name, value in {"_nrt": False, **more}.items() if hasattr(DefaultOptions, name)}


def inner(kernel, reading):
    """The numba dispatcher that compiles a kernel for other kernels. reading: of the kernel, see `identity`."""
    inlined = {"forceinline": True} if kernel.is_inlined else {}
    chosen = options(no_cpython_wrapper=True, no_cfunc_wrapper=True, **inlined)
    if links():
        from neorl.kernels.linking import linked

        return linked(named_apart(kernel, reading), chosen)
    return numba.njit(**chosen)(named_apart(kernel, reading))


def outer(kernel, reading):
    """The numba dispatcher that compiles a kernel for calls from Python, and by its address."""
    dispatcher = numba.njit(**options(no_cfunc_wrapper=True))(named_apart(kernel, reading))
    if all(map(is_ours, reading.functions)) and reading.unknown is None and caches():
        from neorl.kernels.caching import KernelCache

        dispatcher._cache = KernelCache(kernel.__name__, (reading.text, links()))
    return dispatcher


def named_apart(kernel, reading):
    """The function of a kernel; if this package has made it with a closure, under a name that tells what of.

    numba links code by the names of functions and their numbers in a process, so code from the cache must not share its
    name with other code of the same maker that this process compiles.
    """
    function = kernel.py_func
    if not (function.__closure__ and is_ours(function)):
        return function
    copy = FunctionType(function.__code__, function.__globals__, function.__name__, function.__defaults__,
                        function.__closure__)
    copy.__qualname__ = f"{function.__qualname__}_{hashlib.sha256(reading.text.encode()).hexdigest()[:16]}"
    return copy


def compiled(dispatcher, arguments, returns=None):
    """A dispatcher's code for arguments of these numba types. returns: the type of its result, if given."""
    if arguments not in dispatcher.overloads:
        dispatcher.compile(returns(*arguments) if returns else arguments)
    made = dispatcher.overloads[arguments]
    return Compiled(dispatcher, made.library, made.fndesc.llvm_func_name, made.entry_point)
