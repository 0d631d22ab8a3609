"""What makes two conditions the same: values, and the source of all code that is the user's own.

The source of neorl itself is left out here, see `neorl.experiments.cache.source_digest`.
"""

import inspect
from dataclasses import fields, is_dataclass
from types import ModuleType

import numpy as np

from neorl.agents.description import name_of
from neorl.core.kernel import function_of
from neorl.worlds.world import World

OURS = "neorl."


def identity(value):
    """A text that is equal for values that are, and for kernels and worlds whose source and constants are.

    Raises ValueError for a kernel whose source cannot be read.
    """
    if is_dataclass(value) and not isinstance(value, type):
        of_fields = [f"{each.name}={identity(getattr(value, each.name))}" for each in fields(value)]
        if isinstance(value, World) and not type(value).__module__.startswith(OURS):
            of_fields += [_source(type(value)), *map(identity, value.dynamics)]
        return f"{name_of(type(value))}({', '.join(of_fields)})"
    if isinstance(value, tuple | list):
        return f"({', '.join(map(identity, value))})"
    if isinstance(value, np.ndarray):
        return f"{value.dtype}{value.shape}{value.tobytes().hex()}"
    if isinstance(value, ModuleType | type):
        return value.__name__
    return _of_function(value) if callable(value) else repr(value)


def _of_function(value):
    function = function_of(value)
    if not inspect.isfunction(function) or function.__module__.startswith(OURS):
        _, arguments = getattr(value, "origin", (None, ()))
        return f"{name_of(function)}{identity(arguments)}"
    used = inspect.getclosurevars(function)
    constants = {**used.nonlocals, **used.globals}
    of_constants = [f"{name}={identity(each)}" for name, each in constants.items() if each is not value]
    return f"{_source(function)}({', '.join(of_constants)})"


def _source(value):
    try:
        return inspect.getsource(value)
    except (OSError, TypeError):
        raise ValueError(f"{value!r} has no source that can be read, allowed are functions and classes of a file or "
                         "of a notebook's cell") from None
