"""The identity of values that a result depends on: their content, and everything that their code looks up.

A cached result is found by a text of everything that determined it (`neorl.experiments.condition`). A function counts
by its bytecode, since its file may have changed after it was read, and by the present values of its globals, closures,
defaults and attributes of modules, down to the functions among them. The code of the rooms `core` and `worlds` counts
by name, since the key of a result also contains the digest of their source (`digest_of_source`); so does that of
Python, numba and NumPy. A program must not assign to names in them.

numba takes all these values for constants when it compiles; a `Reading` tells whether they are still the same.
"""

import builtins
import copyreg
import dis
import functools
import hashlib
import importlib.util
import pkgutil
import sys
import sysconfig
from collections.abc import Iterator
from dataclasses import fields, is_dataclass
from enum import Enum
from types import CellType, CodeType, FunctionType, MethodType, ModuleType, NoneType

import numpy as np

from neorl.common import files
from neorl.common.warn import warn_once

OURS = ("neorl.kernels.", "neorl.core.", "neorl.worlds.", "neorl.beyond.")
ROOMS = ("kernels", "core", "worlds", "agents", "gym", "browser")  # of this package that have kernels
WITHOUT_SOURCE = ("numba", "numpy")
PLAIN = (NoneType, bool, int, float, complex, str, bytes)
CONSTANTS = (*PLAIN, tuple, np.ndarray, np.generic, Enum)  # among the attributes of a class
MISSING = object()
NOT_OF_NUMBA = ("kernels must call functions decorated with neorl.kernel, but call {}, which is compiled by numba's {} "
                "and would keep the values that its globals had then")
STANDARD_LIBRARY = sysconfig.get_path("stdlib")
RANDOM = ("random", "numpy.random")  # modules of global random streams
HEAP_TYPE = 1 << 9  # of `type.__flags__`: made by a class statement or a call, and not in C, as nothing else tells


class Reading:
    """The identity of a value, `text`, and whether the value still has it.

    unknown: a value within it whose content cannot be read, or None. draws: the name, as in the source, of a function
    of a global random stream that it uses, which no seed of a run determines, or None. Raises ValueError for
    functions of numba.njit.
    """

    def __init__(self, value):
        self._value, self.unknown, self.draws, self._met = value, None, None, {}
        self.functions, self._unchanged = [], []  # of the user's; whether each part that can change has not
        self.text = self._of(value)

    def stands(self):
        """Whether the value is still the same, with all that it depends on."""
        if all(is_unchanged() for is_unchanged in self._unchanged):
            return True
        now = Reading(self._value)
        if now.text == self.text:
            vars(self).update(vars(now))  # compared faster the next time
            return True
        return False

    def _read_again(self):
        """Let `stands` compare texts: nothing faster tells whether a part has changed."""
        self._unchanged.append(bool)  # which returns False

    def _watched(self, look_up, *arguments):
        """What a function returns, which `stands` compares with what it returns then."""
        value = look_up(*arguments)
        self._unchanged.append(lambda: look_up(*arguments) is value)
        return value

    def _of(self, value):
        if type(value) in PLAIN or isinstance(value, np.generic) and not isinstance(value, np.void):
            return repr(value)
        if isinstance(value, tuple):
            return f"{_kind(value)}{getattr(value, '_fields', '')}({', '.join(map(self._of, value))})"
        if isinstance(value, np.ndarray | np.void) and not value.dtype.hasobject:
            content = value.tobytes()
            self._unchanged.append(lambda: value.tobytes() == content)
            return f"{value.dtype}{value.shape}{content.hex()}"
        if isinstance(value, ModuleType):
            return value.__name__
        if isinstance(value, type):
            return self._once(value, self._class)
        if isinstance(value, MethodType):
            return self._of((value.__func__, value.__self__))
        if type(value).__name__ in ("DUFunc", "GUFunc", "_Intrinsic", "CFunc"):
            raise ValueError(NOT_OF_NUMBA.format(value.__name__, type(value).__name__))
        if isinstance(getattr(value, "py_func", value), FunctionType):
            return self._once(value, self._function)
        if isinstance(value, Enum):
            return f"{value!s}={self._of(value.value)}"
        if isinstance(value, list | set | frozenset | dict):
            self._read_again()
            content = list(map(self._of, value.items() if isinstance(value, dict) else value))
            return f"{_kind(value)}[{', '.join(content if isinstance(value, list) else sorted(content))}]"
        return self._object(value)

    def _once(self, value, describe):
        """The description of a function or class; its number where it appears again, perhaps within itself."""
        key = getattr(value, "py_func", value)  # stays alive as long as `value`
        if id(key) in self._met:
            return f"#{self._met[id(key)][0]}"
        self._met[id(key)] = len(self._met), key
        return describe(value)

    def _class(self, kind):
        name = name_of(kind)
        if _is_known_class(kind):
            return name
        self._read_again()
        constants = dict(getattr(kind, "__members__", {}))
        for base in reversed(kind.__mro__):
            constants |= {attribute: value for attribute, value in vars(base).items()
                          if isinstance(value, CONSTANTS) and not attribute.startswith("__")}
        return f"{name}({self._named(constants.items())})"

    def _function(self, value):
        function = getattr(value, "py_func", value)
        module, name = str(function.__globals__.get("__name__")), function.__qualname__
        used = [(variable, self._watched(getattr, cell, "cell_contents")) for variable, cell in zip(
            function.__code__.co_freevars, function.__closure__ or ()) if cell != CellType()]  # an empty one
        if _is_known(module):
            arguments = self._of(getattr(value, "origin", (None, ()))[1])
            return f"{module}:{name}{arguments}({self._named(used) if module.startswith(OURS) else ''})"
        if hasattr(value, "targetoptions"):
            raise ValueError(NOT_OF_NUMBA.format(name, "jit"))
        self.functions.append(function)
        bytecode, defaults, by_name = (self._watched(getattr, function, f"__{part}__")
                                       for part in ("code", "defaults", "kwdefaults"))
        code, of_globals, attributes = _read(bytecode)
        used += [(global_name, self._watched(_global, function.__globals__, global_name)) for global_name in of_globals]
        modules = [(each, module) for each, module in used if isinstance(module, ModuleType)]
        for path, module in modules:  # which grows
            if _is_known(module.__name__):
                of_module = [(f"{path}.{each}", vars(module)[each]) for each in attributes if each in vars(module)]
                modules += [(name, part) for name, part in of_module
                            if isinstance(part, ModuleType) and part.__name__ in RANDOM]
                self._note_draws(sorted(of_module, key=lambda each: each[0].endswith("random")))
                continue
            for each in attributes:
                if (attribute := self._watched(getattr, module, each, MISSING)) is not MISSING:
                    used.append((f"{path}.{each}", attribute))
                    if isinstance(attribute, ModuleType) and all(attribute is not known for _, known in modules):
                        modules.append((f"{path}.{each}", attribute))
        self._note_draws(used)
        return f"{code}{self._of((defaults, by_name))}({self._named(used)})"

    def _note_draws(self, used):
        """Keep the first name of a function of a global random stream, or of a generator, among (name, value) pairs."""
        for name, value in used:
            kinds = value, type(value), type(getattr(value, "__self__", None))
            if any(str(getattr(kind, "__module__", "")).startswith(("numpy.random", "random")) for kind in kinds):
                self.draws = self.draws or name

    def _named(self, used):
        return ", ".join(f"{name}={self._of(each)}" for name, each in used)

    def _object(self, value):
        content = (self._named((each.name, getattr(value, each.name)) for each in fields(value))
                   if is_dataclass(value) else self._pickled(value))
        if not _is_known_class(type(value)):
            content += self._of(getattr(value, "determinants", ()))
            content += self._of(type(value).__call__) if callable(value) else ""
        return f"{_kind(value)}({content})"

    def _pickled(self, value):
        """An object by what `pickle` would save of it."""
        reduce = copyreg.dispatch_table.get(type(value), lambda value: value.__reduce_ex__(4))
        try:
            reduced = reduce(value)
        except Exception:  # of any class
            self.unknown = value
            return str(id(value))
        if isinstance(reduced, str):
            return f"{getattr(value, '__module__', '')}:{reduced}"
        if any(part is not None for part in reduced[2:]):
            self._read_again()
        return ", ".join(self._of(list(each) if isinstance(each, Iterator) else each) for each in reduced)


def identity(value):
    """A text that is equal for equal values, and for kernels and worlds with equal code and constants.

    Raises ValueError for values that cannot be read, and for functions of numba.njit.
    """
    reading = Reading(value)
    if reading.unknown is None:
        return reading.text
    raise ValueError("what a result depends on must be numbers, texts, tuples, arrays, kernels or objects that pickle "
                     f"can save, so that it can be cached, but worlds or kernels look up {reading.unknown!r}, which "
                     "cannot be read")


def digest_of(value):
    """A digest of `identity`, which raises what that raises."""
    return hashlib.sha256(identity(value).encode()).hexdigest()


def is_ours(value):
    """Whether a function or a class is of this package."""
    return str(value.__module__).partition(".")[0] == "neorl"


def name_of(value):
    """The name of a class or function, with that of its module; workers import the main module by another name."""
    return f"{value.__module__}:{value.__qualname__}".replace("__mp_main__", "__main__")


@functools.cache
def digest_of_source(*parts):
    """A digest of the source of some rooms and modules of this package, such as "core", when it was first called.

    None where there is bytecode alone. The source is read by what loads the modules, perhaps from a zip file.
    """
    sources = [source for part in parts for source in _sources(importlib.util.find_spec(f"neorl.{part}"))]
    return None if None in sources else hashlib.sha256("\0".join(sources).encode()).hexdigest()


def _sources(spec):
    """The source of a module and of those within it, each a text, or None."""
    yield getattr(spec.loader, "get_source", lambda name: None)(spec.name)
    for finder, name, _ in pkgutil.iter_modules(spec.submodule_search_locations or (), f"{spec.name}."):
        yield from _sources(finder.find_spec(name))


def can_cache(*parts):
    """Whether there is a folder to cache in, and source by which to tell apart what it was computed with.

    parts: as in `digest_of_source`. Warns where there is not, once in a process.
    """
    try:
        files.cache_folder()
    except OSError as error:
        warn_once(f"nothing is cached: {error}")
        return False
    if digest_of_source(*parts) is None:
        warn_once("nothing is cached: neorl was imported from bytecode without its source, by which another version "
                  "would be noticed; install it with its source")
        return False
    return True


def _global(scope, name):
    return scope[name] if name in scope else getattr(builtins, name, None)


def _kind(value):
    return name_of(type(value))


def _is_known(module):
    """Whether the code of a module, given its name, counts by name."""
    if module == "__main__":  # the user's, even where `python -m cProfile` has its own module by that name
        return False
    if module.startswith(OURS) or module.partition(".")[0] in WITHOUT_SOURCE or module in sys.builtin_module_names:
        return True
    file = getattr(sys.modules.get(module), "__file__", None) or ""
    return file.startswith(STANDARD_LIBRARY) and "-packages" not in file


def _is_known_class(kind):
    """Whether a class counts by name: code that is run without a name, and `make_dataclass`, borrow those of others."""
    module, is_made = str(kind.__module__), bool(kind.__flags__ & HEAP_TYPE)
    return _is_known(module) and (not is_made or getattr(sys.modules.get(module), kind.__name__, None) is kind)


@functools.cache
def _read(code):
    """The code of a function as a text, and the names of globals and of attributes that it looks up, each once."""
    nested = [_read(each) for each in code.co_consts if isinstance(each, CodeType)]
    constants = [identity(each) for each in code.co_consts if not isinstance(each, CodeType)]
    found = {name: [each.argval for each in dis.get_instructions(code) if each.opname.startswith(name)]
             for name in ("LOAD_GLOBAL", "LOAD_ATTR", "LOAD_METHOD")}
    text = (code.co_code.hex(), code.co_exceptiontable.hex(), code.co_names, code.co_varnames, code.co_freevars,
            code.co_cellvars, code.co_argcount, code.co_posonlyargcount, code.co_kwonlyargcount, code.co_flags,
            constants, [each for each, _, _ in nested])
    of_globals = dict.fromkeys([*found["LOAD_GLOBAL"], *(name for _, names, _ in nested for name in names)])
    attributes = dict.fromkeys([*found["LOAD_ATTR"], *found["LOAD_METHOD"],
                                *(name for _, _, names in nested for name in names)])
    return repr(text), tuple(of_globals), tuple(attributes)


digest_of_source(*ROOMS)  # on import, since the files may change while this process goes on with their code
