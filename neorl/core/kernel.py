"""How kernels are compiled, and what they may contain.

A *kernel* is a function compiled by numba. Every number that the project shows is computed by kernels, so a run must be
the same to the last bit on any machine, on any number of threads, and with the compiler switched off
(``NUMBA_DISABLE_JIT=1``). This holds as long as a kernel keeps to these rules:

- it takes flat arrays, scalars and named tuples of them, and does not allocate, raise, print or look anything up;
- it uses only ``+ - * /``, square root, floor and comparisons, whose results IEEE 754 fixes, and no ``fastmath``;
- it draws random numbers from a stream passed to it (`neorl.core.stream`); ``np.random`` and ``random`` are refused;
- it writes ``np.float32(...)`` where single precision is meant: a literal is a double in numba, but weakly typed in
  NumPy.

A kernel trusts its arguments: an index out of range or a shape that does not fit would crash the interpreter. So it
cannot be called from Python directly; public functions check every argument and pass them on by
`neorl.core.calls.execute`.

Annotations give the types of the arrays in a named tuple, and of the arguments that are passed as tables
(`neorl.core.calls`) or from outside Python (`neorl.browser.wasm`); numba does not read them.

numba takes globals and closures for constants, so a kernel is compiled again once any that it reads, or that a kernel
it calls reads, has another value (`neorl.core.compiling` has how).
"""

import contextlib
import functools
import gc
import inspect
import os
import sys
import threading
from collections.abc import Callable
from typing import TYPE_CHECKING, Annotated, Any, NamedTuple, get_args, get_type_hints
from weakref import WeakKeyDictionary

import numpy as np

from neorl import checks
from neorl.core.global_random import global_random_in
from neorl.core.identity import Reading
from neorl.core.kernel_errors import not_compiled

_making, _interpreting = threading.RLock(), threading.local()
_kernels = WeakKeyDictionary[type, Any]()  # by the class that stands for them
_of_makers: dict[tuple, Any] = {}  # kernels, by origin and identity


class Kernel:
    """A compiled function that only other kernels and `neorl.core.calls.execute` can call.

    numba is the slowest package to import, so it is imported when a kernel is first compiled.
    """

    def __init__(self, function, is_inlined):
        functools.update_wrapper(self, function)
        self.py_func, self.is_inlined = function, is_inlined
        self._reading, self._dispatchers = None, {}

    def __reduce_ex__(self, protocol):
        if protocol < 4 and not hasattr(self, "origin"):
            return self.__name__  # older protocols know no names of attributes
        return getattr(self, "origin", (_kernel_of, (self.definition,)))

    @functools.cached_property
    def definition(self):
        """A class that stands for the kernel where it is pickled: as an attribute, another process finds it by name.

        cloudpickle saves it by its content where it so saves other classes of the same module, such as those that the
        kernel's arguments are instances of: both must come to be the same in the other process.
        """
        definition = type("definition", (), {"made_of": (self.py_func, self.is_inlined), "__module__": self.__module__,
                                             "__qualname__": f"{self.__qualname__}.definition"})
        _kernels[definition] = self
        return definition

    def __repr__(self):
        return f"<kernel {full_name(self)}>"

    def __call__(self, *arguments):
        if getattr(_interpreting, "is_on", False):
            return self.py_func(*arguments)
        raise TypeError(f"{self.__module__}.{self.__name__} is a kernel, which checks nothing: call it by "
                        "neorl.core.calls.execute, with arrays that fit")

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
        """The `neorl.core.compiling.Compiled` for arguments of these numba types. returns: of its result, if given."""
        from neorl.core.compiling import compiled

        with self._compiling():
            return compiled(self.for_python, arguments, returns)

    def _present(self, name):
        """A dispatcher, another one once anything that the kernel depends on has changed: numba freezes it."""
        from neorl.core import compiling

        with _making:
            if self._reading is None or not self._reading.stands():
                _refuse_global_random(self.py_func)  # again, since it may have come with a global
                self._reading, self._dispatchers = Reading(self), {}
            if name not in self._dispatchers:
                self._dispatchers[name] = getattr(compiling, name)(self, self._reading)
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


def _kernel_of(definition):
    """The kernel that a class stands for."""
    if definition not in _kernels:  # from another process
        kernel = Kernel(*definition.made_of)
        kernel.definition, _kernels[definition] = definition, kernel
    return _kernels[definition]


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
    _refuse_global_random(function)
    return function if jit_is_off() else Kernel(function, is_inlined)


def _refuse_global_random(function):
    """Raise ValueError for a function that draws from a global random stream, itself or by a helper."""
    drawn = global_random_in(function)
    if drawn:
        raise ValueError(f"a kernel must draw its random numbers from a stream that is passed to it, but "
                         f"{full_name(function)} calls {drawn}, which no seed of a run determines: call "
                         "neorl.core.stream.uniform or randint with the stream of the world's state or of the policy")


@contextlib.contextmanager
def announcing(told):
    """Within this context, call told(True) when numba begins to compile, in any thread, and told(False) when it ends.

    Kernels that are found on disk are not compiled.
    """
    if jit_is_off():
        yield
        return
    from numba.core import event

    class Announcer(event.Listener):
        depth = 0  # kernels that are called are compiled within those that call them

        def on_start(self, _):
            self.depth += 1
            if self.depth == 1:
                told(True)

        def on_end(self, _):
            self.depth -= 1
            if self.depth == 0:
                told(False)

    with event.install_listener("numba:compile", Announcer()):
        yield


def jit_is_off():
    """Whether kernels stay Python functions: by ``NUMBA_DISABLE_JIT=1``, or by numba's setting once it is imported."""
    if "numba" in sys.modules:
        return bool(sys.modules["numba"].config.DISABLE_JIT)
    return os.environ.get("NUMBA_DISABLE_JIT", "0") not in ("", "0")


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

    make.makes_kernels = True  # type: ignore[attr-defined]
    return make


def _first_of(maker, values, kernel):
    """The first kernel of the same origin and identity, kept here so that a pickled maker takes none along."""
    return _of_makers.setdefault((maker, values, Reading((values, kernel)).text), kernel)


def array(dtype, *shape):
    """The annotation of an array: its type, and its shape in numbers, names of sizes, or names plus one."""
    return Annotated[np.ndarray, dtype, shape]


class Signature(NamedTuple):
    """The types of a kernel: each argument an annotation."""

    arguments: tuple
    returns: type | None


def function(*arguments, returns):
    """The annotation of a kernel with these arguments that is called by its address, and may be missing: None."""
    return Annotated[Callable, Signature(tuple(get_args(each)[1:] or each for each in arguments), returns)]


def tabled(kind):
    """Declare that a kind of named tuple is passed to compiled code as a table (`neorl.core.calls`)."""
    kind.is_tabled = True
    return kind


if TYPE_CHECKING:
    Record = Any
else:
    class Record:
        """The annotation of an agent's record, of the dtype `neorl.core.record.agent_type`."""


@functools.cache
def fields(kind):
    """The fields of a named tuple or arguments of a kernel: {name: (dtype, shape)} for arrays, else {name: type}."""
    return {name: get_args(hint)[1:] or hint for name, hint in get_type_hints(kind, include_extras=True).items()}


def new_tuple(kind, sizes, known):
    """A named tuple of known values, {name: value, or a dict for a nested tuple}; other arrays are filled with 0."""
    values = {}
    for name, field in fields(kind).items():
        if is_tuple(field):
            values[name] = new_tuple(field, sizes, known.get(name, {}))
        elif name in known:
            values[name] = known[name]
        else:
            dtype, shape = field
            values[name] = np.zeros([length(dimension, sizes) for dimension in shape], dtype)
    return kind(**values)


def is_tuple(value):
    """Whether a value, or a type, is a named tuple."""
    return hasattr(value, "_fields")


def mapped(function, values):
    """A named tuple with a function applied to each of its arrays, and to those of nested tuples; or of an array."""
    if is_tuple(values):
        return type(values)(*(mapped(function, value) for value in values))
    return function(values) if isinstance(values, np.ndarray) else values


def arrays(values):
    """The arrays of numbers in a named tuple or an array of records, by name, {"scene.position": array, …}."""
    by_name = {}
    for name in values._fields if is_tuple(values) else values.dtype.names:
        value = getattr(values, name) if is_tuple(values) else values[name]
        if is_tuple(value) or isinstance(value, np.ndarray) and value.dtype.names:
            by_name |= {f"{name}.{inner}": array for inner, array in arrays(value).items()}
        elif isinstance(value, np.ndarray):
            by_name[name] = value
    return by_name


def length(dimension, sizes):
    """The length of a dimension, which is a number, a name in `sizes`, or "name + 1"."""
    if isinstance(dimension, int):
        return dimension
    name, _, more = dimension.partition(" + ")
    if name not in sizes:
        raise checks.error("the length of an array in an annotation", f"a number or {checks.either(sizes)}", name)
    return sizes[name] + int(more or 0)
