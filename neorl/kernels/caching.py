"""Compiled kernels on disk, so that a process need not compile again what another has compiled.

A file is found by all that determines the code: the source of this package, the kernel, the types of its arguments, the
processor, numba and its settings. So the cache need not be cleared after a change. It is complete or absent, and read
only if its digest is right: damaged machine code would give other numbers or crash the interpreter, and the files that
numba itself keeps have no digest.

This module relies on private parts of numba: on the `_cache` that a dispatcher asks for code, and on `CompileResult`,
which reduces code to what `pickle` saves. Where a version of numba lacks them, each process compiles all its kernels.
"""

import contextlib
import hashlib
import pickle
import sys

import llvmlite
import numba
from numba.core.caching import NullCache
from numba.core.compiler import CompileResult
from numba.core.sigutils import normalize_signature

from neorl.common import files
from neorl.common.warn import warn_once
from neorl.kernels.identity import ROOMS, can_cache, digest_of_source, is_ours

SETTINGS = ("BOUNDSCHECK", "DEBUGINFO_DEFAULT", "LOOP_VECTORIZE", "OPT", "SLP_VECTORIZE")  # that affect compiled code


def check():
    """Raise AttributeError unless this version of numba has what this module relies on."""
    CompileResult._reduce, CompileResult._rebuild, numba.njit(lambda: None)._cache


class KernelCache(NullCache):
    """The cache that numba asks for the code of a kernel of this package.

    made_of: what determines the code beside the source of the package, with a `repr` that is the same in any process.
    """

    def __init__(self, name, made_of):
        self._name, self._made_of, self._is_flushed = name, made_of, False

    def flush(self):
        """Load nothing from now on, for `recompile`."""
        self._is_flushed = True

    def load_overload(self, sig, target_context):
        """The compiled code for a signature, or None."""
        target_context.refresh()
        path = self._path(sig, target_context.codegen())
        content = None if self._is_flushed or path is None else files.read_checked(path)
        with _warned():
            return CompileResult._rebuild(target_context, *pickle.loads(content)) if content else None

    def save_overload(self, sig, data):
        """Cache the code compiled for a signature, unless it contains addresses."""
        path = self._path(sig, data.codegen)
        if path and not data.library.has_dynamic_globals:
            with _warned():
                files.write_checked(path, pickle.dumps(data._reduce()))

    def _path(self, signature, codegen):
        arguments, returns = normalize_signature(signature)
        if not can_cache(*ROOMS) or not all(map(_is_known, arguments)):
            return None
        made_of = (self._made_of, arguments, returns, digest_of_source(*ROOMS), codegen.magic_tuple(), sys.version,
                   numba.__version__, llvmlite.__version__, [getattr(numba.config, name) for name in SETTINGS])
        digest = hashlib.sha256(repr(made_of).encode()).hexdigest()
        return _folder() / f"{self._name}-{digest[:32]}"


def _folder():
    return files.cache_folder() / "compiled"


def _is_known(kind):
    """Whether the name of a numba type tells all of it: not where it is of a class of the user's, which may change."""
    named_tuple = getattr(kind, "instance_class", None)
    return (named_tuple is None or is_ours(named_tuple)) and all(map(_is_known, getattr(kind, "types", ())))


@contextlib.contextmanager
def _warned():
    """Do without the cache if it fails, and warn once in a process."""
    try:
        yield
    except Exception as error:  # of any class, from the disk, pickle or numba
        warn_once(f"{_folder()} takes no compiled kernels ({getattr(error, 'strerror', None) or error}): "
                  "each process compiles them again")
