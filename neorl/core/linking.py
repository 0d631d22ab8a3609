"""How numba compiles a kernel for other kernels: to LLVM code that is linked into theirs, and optimised there.

By default numba optimises every function that it compiles and generates machine code for it, in case Python calls it.
For kernels within kernels that took a third of the time, and made what is called from Python no faster.
"""

import numba
from numba import types
from numba.core.codegen import JITCodeLibrary
from numba.core.compiler import Compiler


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


class LinkedCompiler(Compiler):
    """numba's compiler, with a `LinkedLibrary` for what it compiles."""

    def __init__(self, typing_context, target_context, library, *rest):
        library = LinkedLibrary(target_context.codegen(), "kernel")
        super().__init__(typing_context, target_context, library, *rest)


def linked(kernel):
    """The numba dispatcher that compiles a kernel for other kernels, once whether or not an argument is a constant."""
    dispatcher = numba.njit(**kernel.options | {"no_cpython_wrapper": True, "no_cfunc_wrapper": True},
                            pipeline_class=LinkedCompiler)(kernel.py_func)
    template = dispatcher.get_call_template
    dispatcher.get_call_template = lambda args, by_name: template(
        tuple(map(types.unliteral, args)), {name: types.unliteral(each) for name, each in by_name.items()})
    return dispatcher
