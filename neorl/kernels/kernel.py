"""How kernels are compiled, and what they may contain.

A *kernel* is a function compiled by numba. Every number that the project shows is computed by kernels, so a run must be
the same to the last bit on any machine, on any number of threads, and with the compiler switched off
(``NUMBA_DISABLE_JIT=1`` when neorl is imported). This holds as long as a kernel keeps to these rules:

- it takes flat arrays, scalars and named tuples of them, and does not allocate, raise, print or look anything up;
- it uses only ``+ - * /``, square root, floor and comparisons, whose results IEEE 754 fixes, and no ``fastmath``;
- it draws random numbers from a stream passed to it (`neorl.core.stream`); ``np.random`` and ``random`` are refused;
- it writes ``np.float32(...)`` where single precision is meant: a literal is a double in numba, but weakly typed in
  NumPy.

A kernel trusts its arguments: an index out of range or a shape that does not fit would crash the interpreter. So it
cannot be called from Python directly; public functions check every argument and pass them on by
`neorl.kernels.execution.execute`.

numba takes globals and closures for constants, so a kernel is compiled again once any that it reads, or that a kernel
it calls reads, has another value (`neorl.kernels.compiling` has how).
"""

import contextlib
import functools
import gc
import inspect
import os
import sys
import threading
from collections.abc import Callable
from typing import Any

import numpy as np

from neorl.common import checks
from neorl.kernels.errors import not_compiled
from neorl.kernels.identity import Reading, digest_of, is_ours
from neorl.kernels.pickling import definition_of, itself, refused, restored

_making, _interpreting = threading.RLock(), threading.local()
_of_makers: dict[tuple, Any] = {}  # kernels, by origin and identity


class Kernel:
    """A compiled function that only other kernels and `neorl.kernels.execution.execute` can call.

    numba is the slowest package to import, so it is imported when a kernel is first compiled.
    """

    def __init__(self, function, is_inlined):
        functools.update_wrapper(self, function)
        self.py_func, self.is_inlined = function, is_inlined
        self._reading, self._dispatchers = None, {}

    def __reduce_ex__(self, protocol):
        make, values = getattr(self, "origin", (self, None))
        if make is not self and is_ours(make):
            return make, values
        digest = None if is_ours(self) else digest_of(self)
        if make is not self and digest != digest_of(make(*values)):
            raise refused(make)
        return restored, (make._definition, values, digest)

    @functools.cached_property
    def _definition(self):
        """What stands for the kernel where it is pickled."""
        return definition_of(self, Kernel, self.py_func, self.is_inlined)

    def __deepcopy__(self, memo):
        return self

    def __repr__(self):
        return f"<kernel {full_name(self)}>"

    def __call__(self, *arguments):
        if getattr(_interpreting, "is_on", False):
            return self.py_func(*arguments)
        raise TypeError(f"{self.__module__}.{self.__name__} is a kernel, which checks nothing: call it by "
                        "neorl.kernels.execution.execute, with arrays that fit")

    @property
    def _numba_type_(self):
        """The numba type of the kernel, for kernels that call it."""
        return self.dispatcher._numba_type_

    @property
    def dispatcher(self):
        """The numba dispatcher that compiles the kernel for other kernels, the same for all threads."""
        return self._present("inner")

    @property
    def for_python(self):
        """The dispatcher for calls from Python, and by the kernel's address."""
        return self._present("outer")

    def compiled_for(self, arguments, returns=None):
        """The `neorl.kernels.compiling.Compiled` for arguments of these numba types. returns: its result's, or None."""
        from neorl.kernels.compiling import compiled

        with self._compiling():
            return compiled(self.for_python, arguments, returns)

    def _present(self, name):
        """A dispatcher, another one once anything that the kernel depends on has changed: numba freezes it."""
        from neorl.kernels import compiling

        with _making:
            if self._reading is None or not self._reading.stands():
                self._reading, self._dispatchers = _read(self), {}
            if name not in self._dispatchers:
                jit_is_off()  # or it raises: numba may have been imported just now
                self._dispatchers[name] = getattr(compiling, name)(self, self._reading)
                # numba's dispatcher asks itself for code for new types: this way its error names the kernel to blame,
                # and calls with known types take no longer than numba's own.
                self._dispatchers[name]._compile_for_args = self._entry_for
            return self._dispatchers[name]

    def _entry_for(self, *arguments):
        """The code for arguments of types that are new to numba's dispatcher, which calls this and then the code."""
        return self.compiled_for(tuple(map(self.for_python.typeof_pyval, arguments))).entry

    @contextlib.contextmanager
    def _compiling(self):
        """Blame this kernel if numba fails, and collect no garbage meanwhile: that took a tenth of the time."""
        from numba.core.errors import NumbaError, UnsupportedBytecodeError

        collects = gc.isenabled()
        gc.disable()
        try:
            yield
        except (NumbaError, UnsupportedBytecodeError, TypeError) as error:
            raise not_compiled(self, error) from error
        finally:
            if collects:
                gc.enable()


@contextlib.contextmanager
def interpreting():
    """Within this context, in this thread, a kernel is the Python function that it was written as."""
    before, _interpreting.is_on = getattr(_interpreting, "is_on", False), True
    try:
        with np.errstate(all="ignore"):  # as in compiled code, where random streams overflow
            yield
    finally:
        _interpreting.is_on = before


def kernel(function: Callable) -> Any:
    """Compile a kernel.

    Raises ValueError for anything but a Python function, and for one that draws from a global random stream, itself or
    by a helper.
    """
    return _compiled(function, is_inlined=False)


def inlined_kernel(function):
    """Compile a kernel that is only inlined into other kernels.

    An agent's parameters are so many arrays that passing them costs more than running most kernels that take them;
    inlining makes passing them free.
    """
    return _compiled(function, is_inlined=True)


def inlined(kernel):
    """The same kernel, only to be inlined into other kernels."""
    copy = inlined_kernel(function_of(kernel))
    if isinstance(kernel, Kernel):
        copy.origin = inlined, (kernel,)
    return copy


def full_name(kernel):
    """The name of a kernel with that of its module; for one that was made, of its maker, with the arguments."""
    made_by, arguments = getattr(kernel, "origin", (kernel, ""))
    return f"{made_by.__module__}.{made_by.__qualname__}{arguments}"


def function_of(kernel):
    """The Python function that a kernel was compiled from; anything else unchanged."""
    return getattr(kernel, "py_func", kernel)


def _compiled(function, is_inlined):
    if not inspect.isfunction(function):
        raise checks.error("function", "a Python function to make a kernel of", function)
    _read(function)
    return function if jit_is_off() else Kernel(function, is_inlined)


def _read(kernel):
    """The `Reading` of a kernel. Raises ValueError for one that draws from a global random stream, or by a helper."""
    reading = Reading(kernel)
    if reading.draws:
        raise ValueError(f"a kernel must draw its random numbers from a stream that is passed to it, but "
                         f"{full_name(kernel)} calls {reading.draws}, which no seed of a run determines: call "
                         "neorl.core.stream.uniform or randint with the stream of the world's state or of the policy")
    return reading


def jit_is_off():
    """Whether kernels stay Python functions: as numba's switch was when the first of this package was made.

    Raises RuntimeError if it has been switched since.
    """
    is_off = _was_off()
    now = getattr(sys.modules.get("numba.core.config"), "DISABLE_JIT", is_off)
    if bool(now) != is_off:
        raise RuntimeError(f"numba's compiler must stay {'off' if is_off else 'on'}, as it was when neorl was "
                           f"imported, but numba.config.DISABLE_JIT is {now} now: set it back, or restart Python with "
                           f"NUMBA_DISABLE_JIT={int(not is_off)} in the environment")
    return is_off


@functools.cache
def _was_off():
    """numba's own reading of its switch; it takes long to import, and is not if there is but one reading."""
    said = os.environ.get("NUMBA_DISABLE_JIT", "" if os.path.exists(".numba_config.yaml") else "0")
    if said in ("0", "1") and "numba" not in sys.modules:
        return said == "1"
    from numba.core import config

    return bool(config.DISABLE_JIT)


def check_kernel(name, value):
    """`value`, if it is a kernel. Raises ValueError for anything else, such as an undecorated function."""
    if isinstance(value, Kernel) or jit_is_off() and callable(value):
        return value
    raise checks.error(name, "a function that is decorated by neorl.kernel", value)


def kernel_maker(function: Callable) -> Any:
    """Decorate a function that makes kernels, to return the same one for the same arguments: a rule with parameters.

    The function is called every time, and its kernel replaced by an earlier one if that is the same in all that it
    depends on. NumPy scalars and zero-dimensional arrays count as Python numbers. Raises ValueError for anything but a
    Python function, and for one with arguments by name alone. The decorated function raises TypeError for arguments
    that cannot be hashed, and ValueError if it does not return a kernel.
    """
    if not inspect.isfunction(function):
        raise checks.error("function", "a Python function that makes kernels", function)
    signature = inspect.signature(function)
    if {parameter.kind.name for parameter in signature.parameters.values()} & {"KEYWORD_ONLY", "VAR_KEYWORD"}:
        raise checks.error("function", "without arguments by name alone, after * or **", function)

    @functools.wraps(function)
    def make(*arguments, **by_name):
        bound = signature.bind(*arguments, **by_name)
        bound.apply_defaults()
        values = tuple(map(checks.plain, bound.args))
        try:
            hash(values)
        except TypeError:
            function(*values)  # whose own error may say more
            raise TypeError(f"arguments of {function.__qualname__} must be hashable, but are "
                            f"{checks.shown(values)}") from None
        kernel = check_kernel(f"what {function.__qualname__} returns", function(*values))
        kernel.origin = make, values
        return _first_of(make, values, kernel)

    make.makes_kernels, make._definition = True, definition_of(make, itself, make)  # type: ignore[attr-defined]
    return make


def _first_of(maker, values, kernel):
    """The first kernel of the same origin and identity, kept here so that a pickled maker takes none along."""
    return _of_makers.setdefault((maker, values, Reading((values, kernel)).text), kernel)
