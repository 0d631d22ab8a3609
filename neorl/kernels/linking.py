"""How numba compiles a kernel for other kernels: to LLVM code that is linked into theirs, and optimised there.

By default numba optimises every function that it compiles and generates machine code for it, in case Python calls it.
For kernels within kernels that takes half of the time before a first step, and makes no step faster.

This module alone relies on private parts of numba: on the methods of `JITCodeLibrary` that are overridden here, on what
`Compiler` takes, and on the values of `Flags`. Where a version of numba lacks them, `check` raises an error, and
`neorl.kernels.compiling` does without this module.
"""

import inspect

import numba
from numba import types
from numba.core.codegen import JITCodeLibrary
from numba.core.compiler import Compiler, Flags

TAKEN = ["typingctx", "targetctx", "library", "args", "return_type", "flags", "locals"]  # by numba's compiler
OVERRIDDEN = ("_optimize_final_module", "_finalize_final_module", "_finalize_dynamic_globals",
              "get_pointer_to_function")


def check():
    """Raise AttributeError or TypeError unless this version of numba has what this module relies on."""
    for name in OVERRIDDEN:
        getattr(JITCodeLibrary, name)
    taken = list(inspect.signature(Compiler.__init__).parameters)[1:]
    if taken != TAKEN:
        raise TypeError(f"its compiler takes {', '.join(taken)}")
    Flags()._values


class LinkedLibrary(JITCodeLibrary):
    """The LLVM code of a kernel and of all that it calls, which is linked and never loaded."""

    def _optimize_final_module(self):
        """Leave it to the library that this one is linked into."""

    def _finalize_final_module(self):
        self._finalize_dynamic_globals()
        self._finalized = True

    def get_pointer_to_function(self, name):
        """0: nothing here has an address."""
        return 0

    @property
    def codegen(self):
        """What numba asks to `set_env`."""
        return self

    def set_env(self, name, env):
        """Do nothing: numba would set a global of loaded code, which only code that raises exceptions reads."""


class LinkedFlags(Flags):
    """numba's flags of a compilation, equal where the same ones are set to the same values.

    numba compares them whenever it types a call, and would read all forty of both, which took half a second of the ten
    before a first step. It also changes flags while it compiles, so that no two compilations may share an object.
    """

    __slots__ = ()

    def __eq__(self, other):
        return type(other) is type(self) and other._values == self._values

    def __hash__(self):
        return hash(frozenset(self._values))


class LinkedCompiler(Compiler):
    """numba's compiler, with a `LinkedLibrary` for what it compiles."""

    def __init__(self, typing_context, target_context, library, args, return_type, flags, locals):
        library, flags = LinkedLibrary(target_context.codegen(), "kernel"), LinkedFlags(flags)
        super().__init__(typing_context, target_context, library, args, return_type, flags, locals)


def linked(function, options):
    """The numba dispatcher that compiles a kernel for other kernels, once whether or not an argument is a constant."""
    dispatcher = numba.njit(**options, pipeline_class=LinkedCompiler)(function)
    # numba takes constants among the arguments for types, and would compile a kernel once for each of them.
    template = dispatcher.get_call_template
    dispatcher.get_call_template = lambda args, by_name: template(
        tuple(map(types.unliteral, args)), {name: types.unliteral(each) for name, each in by_name.items()})
    return dispatcher
