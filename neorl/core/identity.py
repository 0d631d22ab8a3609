"""The identity of values that a result depends on: their content, and the source of their code.

A cached file is found by a text of everything that determined it (`neorl.experiments.cache`,
`neorl.core.compile_cache`). The source of the rooms `core` and `worlds` is left out of the text, since the key of
such a file also contains its digest (`digest_of_source`).
"""

import functools
import hashlib
import inspect
from dataclasses import fields, is_dataclass
from pathlib import Path
from types import CodeType, ModuleType

import numpy as np

OURS = ("neorl.core.", "neorl.worlds.")
WITHOUT_SOURCE = ("math", "neorl", "numba", "numpy")  # modules whose functions are identified by name


def identity(value):
    """A text that is equal for equal values, and for kernels and worlds with equal source and constants.

    Raises ValueError for a kernel whose source cannot be read.
    """
    if is_dataclass(value) and not isinstance(value, type):
        content = [f"{each.name}={identity(getattr(value, each.name))}" for each in fields(value)]
        if hasattr(value, "dynamics") and not type(value).__module__.startswith(OURS):
            content += [_source(type(value)), *map(identity, value.dynamics)]
        return f"{name_of(type(value))}({', '.join(content)})"
    if isinstance(value, tuple | list):
        return f"({', '.join(map(identity, value))})"
    if isinstance(value, np.ndarray):
        return f"{value.dtype}{value.shape}{value.tobytes().hex()}"
    if isinstance(value, type):
        return f"{name_of(value)}({_named(_constants(value))})"
    if isinstance(value, ModuleType):
        return value.__name__
    return _of_function(value) if callable(value) else repr(value)


def name_of(value):
    """The name of a class or function, with that of its module."""
    return f"{value.__module__}:{value.__qualname__}"


@functools.cache
def digest_of_source(*parts):
    """A digest of the source of some rooms and modules of this package, such as "core"."""
    package = Path(__file__).parents[1]
    paths = [path for part in parts for path in sorted([*package.glob(f"{part}.py"), *(package / part).rglob("*.py")])]
    return hashlib.sha256(b"".join(path.read_bytes() for path in paths)).hexdigest()


def _of_function(value):
    function = getattr(value, "py_func", value)
    arguments = identity(getattr(value, "origin", (None, ()))[1])
    if not inspect.isfunction(function):
        return f"{name_of(function)}{arguments}"
    used = inspect.getclosurevars(function)
    if (function.__module__ or "").startswith(OURS):
        return f"{name_of(function)}{arguments}({_named(used.nonlocals)})"
    found = {name: each for name, each in sorted({**used.nonlocals, **used.globals}.items(), key=lambda item: item[0])
             if each is not value}  # in this order, since that of globals differs between processes of Python 3.14
    for module in [each for each in found.values() if isinstance(each, ModuleType)]:
        if module.__name__.split(".")[0] not in WITHOUT_SOURCE:
            found |= {f"{module.__name__}.{name}": getattr(module, name) for name in sorted(used.unbound)
                      if hasattr(module, name)}
    return f"{_source(function)}{_code(function.__code__)}({_named(found)})"


def _named(values):
    return ", ".join(f"{name}={identity(each)}" for name, each in values.items())


def _constants(kind):
    return {name: value for name, value in vars(kind).items()
            if not name.startswith("__") and isinstance(value, int | float | str | tuple)}


def _code(code):
    """The bytecode of a function, since its file may have changed after it was read."""
    constants = [_code(each) if isinstance(each, CodeType) else repr(each) for each in code.co_consts]
    return f"{code.co_code.hex()}({', '.join(constants)})"


def _source(value):
    try:
        return inspect.getsource(value)
    except (OSError, TypeError):
        raise ValueError(f"{value!r} has no source that can be read, allowed are functions and classes of a file or "
                         "of a notebook's cell") from None
