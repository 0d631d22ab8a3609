"""Compiled kernels on disk, so that a process need not recompile the kernels of another.

A kernel called from Python is cached with everything inlined into it, under a key of all that its code depends on: the
source of the rooms `core` and `worlds`, the code and constants of every user-defined kernel, the types of its
arguments, numba, LLVM and the processor, and the lines on which the user's kernels raise. So the cache need not be
cleared after a change, and deleted files are compiled again. A file is complete or absent; one that is damaged, or
cannot be read, counts as absent.

numba numbers the functions of a process, and links their code by names that contain these numbers. The numbers of each
process begin elsewhere, so that code from disk does not share a name with other code.
"""

import dis
import hashlib
import itertools
import os
import pickle
import secrets
import sys

import llvmlite
import numba
from numba import types
from numba.core.bytecode import FunctionIdentity
from numba.core.caching import NullCache
from numba.core.compiler import CompileResult
from numba.core.sigutils import normalize_signature

from neorl import files
from neorl.core.identity import can_cache, digest_of_source, name_of
from neorl.warn import warn_once

OF_KERNELS = ("core", "worlds")  # the rooms whose code is compiled
SETTINGS = ("BOUNDSCHECK", "LOOP_VECTORIZE", "OPT", "SLP_VECTORIZE")  # of numba that affect compiled code


def number_apart():
    """Begin to number the functions that this process compiles where no other process does."""
    FunctionIdentity._unique_ids = itertools.count(secrets.randbits(60))


number_apart()
if hasattr(os, "register_at_fork"):  # not on Windows
    os.register_at_fork(after_in_child=number_apart)


class CompileCache(NullCache):
    """The cache that numba asks for the compiled code of one kernel, as it stood at a `neorl.core.identity.Reading`."""

    def __init__(self, kernel, reading):
        self._kernel, self._reading = kernel, reading

    def load_overload(self, sig, target_context):
        """The compiled code for a signature, or None."""
        target_context.refresh()
        path = self._path(sig, target_context.codegen())
        content = path and files.read_checked(path)
        if not content:
            return None
        try:
            return CompileResult._rebuild(target_context, *pickle.loads(content))
        except (ImportError, AttributeError):  # a type that has moved or gone
            return None

    def save_overload(self, sig, data):
        """Cache the code compiled for a signature."""
        path = self._path(sig, data.codegen)
        if path is None:
            return
        try:
            files.write_checked(path, pickle.dumps(data._reduce()))
        except OSError as error:
            warn_once(f"{path.parent} takes no compiled kernels ({error.strerror}): each process compiles them again")
        except (pickle.PicklingError, AttributeError):  # a type without a name
            return

    def _path(self, sig, codegen):
        if self._reading.unknown is not None or not can_cache(*OF_KERNELS) or not self._reading.stands():
            return None
        made_of = (self._reading.text, digest_of_source(*OF_KERNELS),
                   [_name_of(each) for each in normalize_signature(sig)[0]], self._kernel.options, numba.__version__,
                   llvmlite.__version__, sys.version, codegen.magic_tuple(), _lines_that_raise(self._reading.functions),
                   [getattr(numba.config, name) for name in SETTINGS])
        return files.cache_folder() / "compiled" / hashlib.sha256(repr(made_of).encode()).hexdigest()


def _lines_that_raise(functions):
    """Where those of a user's functions stand that raise: their compiled code names the file and the line."""
    codes = [each.__code__ for each in functions]
    return [(code.co_qualname, code.co_filename, code.co_firstlineno, code.co_linetable) for code in codes
            if any(each.opname == "RAISE_VARARGS" for each in dis.get_instructions(code))]


def _name_of(kind):
    """The name of a numba type; for a named tuple, with the types of its fields."""
    if not isinstance(kind, types.BaseNamedTuple):
        return str(kind)
    of_fields = [f"{name}: {_name_of(each)}" for name, each in zip(kind.fields, kind)]
    return f"{name_of(kind.instance_class)}({', '.join(of_fields)})"
