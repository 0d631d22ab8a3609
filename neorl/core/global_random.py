"""What a function draws from the global random streams of Python or NumPy, which no seed of a run determines."""

import dis
import inspect
from types import CodeType, ModuleType

LIBRARIES = ("neorl", "numba", "numpy")
LOADS = ("LOAD_GLOBAL", "LOAD_DEREF", "LOAD_NAME", "LOAD_FAST")
ATTRIBUTES = ("LOAD_ATTR", "LOAD_METHOD")


def global_random_in(function, seen=()):
    """The name, as in the source, of what a function or its helpers draw from a global random stream, or None.

    Functions of `LIBRARIES`, and those in `seen`, are not searched.
    """
    seen = {*seen, function}
    if (function.__module__ or "").split(".")[0] in LIBRARIES:
        return None
    known = function.__globals__ | inspect.getclosurevars(function).nonlocals
    for name, value in _used(function.__code__, known):
        helper = getattr(value, "py_func", value)
        if _is_random(value):
            return name
        if inspect.isfunction(helper) and helper not in seen:
            drawn = global_random_in(helper, seen)
            if drawn:
                return drawn
    return None


def _used(code, known):
    """The known values that a function uses, and the attributes of modules among them: (name, value) pairs."""
    name, value, known = "", None, dict(known)
    for instruction in dis.get_instructions(code):
        if instruction.opname == "STORE_FAST" and value is not None:
            known[instruction.argval] = value
        if instruction.opname in ATTRIBUTES and isinstance(value, ModuleType):
            name, value = f"{name}.{instruction.argval}", getattr(value, instruction.argval, None)
        elif instruction.opname != "EXTENDED_ARG":
            name, value = instruction.argval, known.get(instruction.argval) if instruction.opname in LOADS else None
        if value is not None:
            yield name, value
    for inner in code.co_consts:
        if isinstance(inner, CodeType):
            yield from _used(inner, known)


def _is_random(value):
    """Whether a value is a function of a global stream, or a generator."""
    kinds = value, type(value), type(getattr(value, "__self__", None))
    modules = [getattr(each, "__module__", None) or "" for each in kinds]
    return any(each == "random" or each.startswith("numpy.random") for each in modules)
