"""How numba compiles kernels: linked into each other (`neorl.core.linking`), or else each by itself.

The kernels of this package are cached on disk by numba, in a folder named by a digest of their source, of numba and of
its settings: so the cache need not be cleared after a change. The user's kernels, and those with them within, are
compiled in each process.
"""

import contextlib
import functools
import hashlib
import logging
import os
import sys
from types import FunctionType
from typing import Any, NamedTuple

import llvmlite
import numba

from neorl import files
from neorl.core.identity import ROOMS, can_cache, digest_of_source
from neorl.warn import warn_once

OPTIONS = {"error_model": "numpy", "nogil": True}
SETTINGS = ("BOUNDSCHECK", "LOOP_VECTORIZE", "OPT", "SLP_VECTORIZE")  # of numba that affect compiled code
UNLINKED = "NEORL_UNLINKED"  # set in the environment, kernels are compiled each by itself


class Compiled(NamedTuple):
    """A kernel's code for certain types of its arguments."""

    dispatcher: Any  # numba's, which keeps the code
    library: Any
    name: str  # in the library
    entry: Any  # for calls from Python with arguments of just these types


@functools.cache
def links():
    """Whether kernels are linked: not where this version of numba lacks what that relies on, which is logged."""
    if os.environ.get(UNLINKED):
        return False
    try:
        from neorl.core import linking

        linking.check()
    except Exception as error:  # of any class, from another version of numba
        logging.getLogger("neorl").warning("numba %s cannot link kernels, so a first step takes twice as long: %s",
                                           numba.__version__, error)
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
        from neorl.core.linking import linked

        return linked(named_apart(kernel, reading), chosen)
    return numba.njit(**chosen)(named_apart(kernel, reading))


def outer(kernel, reading):
    """The numba dispatcher that compiles a kernel for calls from Python, and by its address."""
    with _cache(all(is_ours(each) for each in reading.functions)) as caches:
        in_file = os.path.exists(kernel.py_func.__code__.co_filename)  # which numba looks at, and not in a zip file
        return numba.njit(**options(no_cfunc_wrapper=True), cache=caches and in_file)(named_apart(kernel, reading))


def is_ours(function):
    """Whether a function is of this package."""
    return str(function.__module__).partition(".")[0] == "neorl"


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


@contextlib.contextmanager
def _cache(is_ours):
    """Let numba cache what is decorated within this context, in a folder of its own. Yields whether it can."""
    folder = folder_of_compiled() if is_ours else None
    before = numba.config.CACHE_DIR
    try:
        if folder:
            numba.config.CACHE_DIR = str(folder)
        yield bool(folder)
    finally:
        numba.config.CACHE_DIR = before


def folder_of_compiled():
    """Where numba caches the kernels of this package, or None, with a warning, where it cannot."""
    if not can_cache(*ROOMS):
        return None
    made_of = (digest_of_source(*ROOMS), numba.__version__, llvmlite.__version__, sys.version, links(),
               [getattr(numba.config, name) for name in SETTINGS])
    folder = files.cache_folder() / "compiled" / hashlib.sha256(repr(made_of).encode()).hexdigest()[:32]
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        warn_once(f"{folder.parent} takes no compiled kernels ({error.strerror}): each process compiles them again")
        return None
    return folder


def compiled(dispatcher, arguments, returns=None):
    """A dispatcher's code for arguments of these numba types. returns: the type of its result, if given."""
    if arguments not in dispatcher.overloads:
        try:
            dispatcher.compile(returns(*arguments) if returns else arguments)
        except OSError as error:  # on caching it, when it is already compiled
            if arguments not in dispatcher.overloads:
                raise
            warn_once(f"compiled kernels cannot be kept ({error.strerror}): each process compiles them again")
    made = dispatcher.overloads[arguments]
    return Compiled(dispatcher, made.library, made.fndesc.llvm_func_name, made.entry_point)
