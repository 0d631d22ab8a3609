"""Annotations of kernels' arguments, and the named tuples whose fields they describe.

They give the types of the arrays in a named tuple, and of the arguments that are passed as tables
(`neorl.kernels.execution`) or from outside Python (`neorl.browser.wasm`); numba does not read them.
"""

import functools
from collections.abc import Callable
from typing import TYPE_CHECKING, Annotated, Any, NamedTuple, get_args, get_type_hints

import numpy as np

from neorl.common import checks
from neorl.kernels.identity import name_of


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
    """Declare that a kind of named tuple is passed to compiled code as a table (`neorl.kernels.execution`)."""
    kind.is_tabled = True
    return kind


if TYPE_CHECKING:
    Record = Any
else:
    class Record:
        """The annotation of an agent's record, of the dtype `neorl.core.layout.agent_type`."""


@functools.cache
def fields(kind):
    """The fields of a named tuple or arguments of a kernel: {name: (dtype, shape)} for arrays, else {name: type}."""
    return {name: get_args(hint)[1:3] or hint for name, hint in get_type_hints(kind, include_extras=True).items()}


@functools.cache
def marks(kind):
    """What else the arrays of a named tuple are annotated with, ``Annotated[array(…), mark]``: {name: mark}."""
    return {name: get_args(hint)[3] for name, hint in get_type_hints(kind, include_extras=True).items()
            if get_args(hint)[3:]}


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


def is_again(kind, other):
    """Whether two kinds are one kind of named tuples, perhaps defined again: of the same name and the same fields."""
    if kind is other or not (is_tuple(kind) and is_tuple(other)):
        return kind is other
    return (name_of(kind), kind._fields) == (name_of(other), other._fields) and all(
        field == again or is_again(field, again) for field, again in zip(fields(kind).values(), fields(other).values()))


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
