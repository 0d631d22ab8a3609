"""Checks of user input: each returns the value, or raises a ValueError.

Its message is a sentence, `error`: what the argument must be, what it is, and what to do where that is known.

NumPy scalars and zero-dimensional arrays count as numbers. Numbers are finite and at most 1e30 (`LARGEST`) in
magnitude, so that sums and products of several do not overflow; divisors are at least 1e-30 (`SMALLEST`).
"""

import contextlib
import dataclasses
import functools
import math
import numbers
import operator
import os
import reprlib
import sys
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import Annotated, Any, NamedTuple, TypeVar, get_args, get_type_hints

import numpy as np
from numpy.typing import NDArray

Kind = TypeVar("Kind")

LARGEST, SMALLEST = 1e30, 1e-30
MOST = 2**20  # values in a list
LONGEST = 600  # characters of a value in a message

_REPR = reprlib.Repr()
_REPR.maxtuple = _REPR.maxlist = _REPR.maxdict = 50
_REPR.maxstring = _REPR.maxother = _REPR.maxlong = 500


def shown(value: object) -> str:
    """The repr of a value for a message, truncated; its type if the repr fails."""
    try:
        text = _REPR.repr(value)
        return text if len(text) <= LONGEST else f"{text[:LONGEST // 2]}…{text[-LONGEST // 4:]}"
    except Exception:  # a user-defined repr, or that of an integer with too many digits
        return f"a value of type {type(value).__name__}"


def error(name: str, must_be: str, value: object, remedy: str = "") -> ValueError:
    """The error for an argument that is not what it must be, and what to do about it."""
    return ValueError(f"{name} must be {must_be}, but is {shown(value)}{remedy and f'; {remedy}'}")


def either(options: Iterable[object]) -> str:
    """Options in words: "'a', 'b' or 'c'"."""
    return " or ".join(", ".join(map(repr, options)).rsplit(", ", 1)) or "of which there are none"


def integer(name: str, value: Any, at_least: int, at_most: int | None = None) -> int:
    """`value` as an int, if it is an integer in the range (True and False are not integers here)."""
    with contextlib.suppress(TypeError):
        number = operator.index(value)
        if not isinstance(value, bool) and at_least <= number and (at_most is None or number <= at_most):
            return number
    raise error(name, f"an integer {f'of at least {at_least}' if at_most is None else f'from {at_least} to {at_most}'}",
                value)


def real(name: str, value: Any, at_least: float = -LARGEST, at_most: float = LARGEST) -> float:
    """`value` as a float, if it is a number in the range; −0.0 becomes 0.0, so that equal values are identical."""
    number = plain(value)
    is_real = isinstance(number, numbers.Real) and not isinstance(number, bool)
    if is_real and at_least <= number <= at_most:
        return float(number) + 0.0
    raise error(name, f"a {'finite ' * (at_most == LARGEST)}number from {at_least:g} to {at_most:g}", value)


def positive(name: str, value: Any) -> float:
    """`value` as a float, if it is a number ≥ 1e-30 (`SMALLEST`)."""
    return real(name, value, SMALLEST)


def one_of(name: str, value: Any, options: Iterable[Kind]) -> Kind:
    """The member of `options` that equals `value`."""
    for each in options:
        if isinstance(value, type(each)) and type(each).__eq__(each, value) is True:  # not that of a subclass
            return each
    raise error(name, either(options), value)


def several(name: str, values: Any) -> tuple[Any, ...]:
    """`values` as a tuple, if they are a list, a tuple, a range or an array of at most 2²⁰ values."""
    values = as_array(name, values) if isinstance(values, np.ndarray) else values
    if isinstance(values, list | tuple | range) or isinstance(values, np.ndarray) and values.ndim:
        with contextlib.suppress(OverflowError):  # a range may be too long for its length
            if len(values) <= MOST:
                return tuple(values)
        raise error(name, f"{MOST} values or fewer", values)
    raise error(name, "a list or a tuple", values)


def flag(name: str, value: Any) -> bool:
    """`value` as a bool, if it is True or False."""
    return one_of(name, plain(value), (True, False))


def finite(name: str, array: NDArray, at_most: float = LARGEST) -> NDArray:
    """`array`, if all its numbers lie between −`at_most` and `at_most`."""
    fits = np.abs(array) <= at_most
    if np.all(fits):
        return array
    raise error(name, f"finite numbers from {-at_most:g} to {at_most:g}", array, _where(name, array, fits))


def _where(name, array, fits):
    """How many rows of an array do not fit, and the first of them."""
    if array.ndim == 0:
        return ""
    wrong = np.argwhere(~(fits if array.ndim == 1 else fits.all(axis=-1)))
    first = tuple(map(int, wrong[0]))
    return (f"{len(wrong):,} of its {math.prod(array.shape[:max(array.ndim - 1, 1)]):,} "
            f"{'numbers' if array.ndim == 1 else 'rows'} are not, the first of them "
            f"{name}[{', '.join(map(str, first))}], {shown(np.asarray(array[first]).tolist())}")


def doubles(name: str, values: Any, at_most: float = LARGEST) -> NDArray[np.float64]:
    """`values` as a new array of doubles, if they are finite numbers, in lists of equal lengths."""
    array = as_array(name, values)
    if array.dtype.kind == "O" and all(isinstance(each, numbers.Real) for each in array.flat):
        with contextlib.suppress(TypeError, ValueError, OverflowError):
            array = array.astype(float)
    if array.dtype.kind not in "fiub":
        fits = np.array([isinstance(each, numbers.Real) for each in array.flat], bool).reshape(array.shape)
        raise error(name, "numbers, in lists of equal lengths", values,
                    _where(name, array, fits) if array.dtype.kind == "O" and array.size else "")
    with np.errstate(over="ignore"):  # wider floats than doubles, which may become infinite
        return finite(name, np.array(array, float, order="C"), at_most)


def as_array(name: str, values: Any) -> NDArray:
    """`values` as an array of any type, that of None if they are lists of unequal lengths; none may be masked."""
    if isinstance(values, np.ma.MaskedArray) and np.ma.is_masked(values):
        raise error(name, "free of masked values", values, "fill them in, or leave them out")
    try:
        return np.asarray(several(name, values) if isinstance(values, range) else values)
    except (TypeError, ValueError, OverflowError):
        return np.array(None)


def points(name: str, values: Any, axes: Sequence[str]) -> NDArray[np.float64]:
    """`values` as an array (…, axes) of doubles, if they are finite and have one coordinate per axis."""
    array = doubles(name, values, sys.float_info.max)  # points beyond a map's range are in the cell at its end
    if array.ndim == 0 or array.shape[-1] != len(axes):
        raise ValueError(f"{name} must have the shape (…, {len(axes)}), for {', '.join(axes)}, but has {array.shape}")
    return array


def instance(name: str, value: Any, kind: type[Kind]) -> Kind:
    """`value`, if it is an instance of `kind`."""
    if isinstance(value, kind):
        return value
    raise error(name, vars(kind).get("in_words") or with_article(kind.__name__), value)


def with_article(noun: str) -> str:
    """A noun with its article: "an Agent"."""
    return f"{'an' if noun[0] in 'AEIOUaeio' or noun == 'ndarray' else 'a'} {noun}"


def plain(value):
    """A NumPy scalar, zero-dimensional array or fraction as a Python number; anything else unchanged."""
    if isinstance(value, np.generic | np.ndarray) and value.ndim == 0 and not np.ma.is_masked(value):
        return value.item()
    try:
        return float(value) if isinstance(value, numbers.Real) and not isinstance(value, int | float) else value
    except OverflowError:
        return value


def path(name: str, value: Any) -> Path:
    """`value` as a `pathlib.Path`, if it is one, or a string that can name a file; ~ is the user's home folder."""
    with contextlib.suppress(TypeError, ValueError):
        if b"\0" not in os.fsencode(Path(value)):
            return Path(os.path.expanduser(value))
    raise error(name, "the path of a file", value)


class Final:
    """Base of classes that kernels read by their fields alone, and that therefore cannot be subclassed."""

    def __init_subclass__(cls, **keywords: Any) -> None:
        super().__init_subclass__(**keywords)
        if Final not in cls.__bases__:
            raise TypeError(f"{cls.__name__} cannot be a subclass of {cls.__bases__[0].__name__}: kernels read its "
                            "fields and would never call what a subclass overrides; give a neorl.kernel as a field")


class Within(NamedTuple):
    """The range of a field, in its annotation: ``Annotated[float, Within(0, 1)]``."""

    at_least: float
    at_most: float


class OneOf(NamedTuple):
    """The options of a field, in its annotation: ``Annotated[str, OneOf(("a", "b"))]``."""

    options: Sequence[object]


Share = Annotated[float, Within(0, 1)]
NotNegative = Annotated[float, Within(0, LARGEST)]
Positive = Annotated[float, Within(SMALLEST, LARGEST)]
AtLeastOne = Annotated[int, Within(1, 2**31)]


def check_fields(instance: Any) -> None:
    """Set the fields of a frozen dataclass to their checked values, as far as their annotations are rules.

    Rules are ``bool``, ``float``, ``str``, a dataclass, and ``Annotated`` with `Within` or `OneOf`. Raises ValueError
    for a field that breaks its rule.
    """
    kind: Any = type(instance)
    assign(instance, **{name: check(name, getattr(instance, name)) for name, check in _rules(kind).items()})


@functools.cache
def _rules(kind: Any) -> dict[str, Callable[[str, Any], Any]]:
    """The check of each field whose annotation is a rule, by the name of the field."""
    found: dict[str, Callable[[str, Any], Any]] = {}
    hints = get_type_hints(kind, include_extras=True)
    simple: dict[Any, Callable[[str, Any], Any]] = {bool: flag, float: real, str: _text}
    for name in (each.name for each in dataclasses.fields(kind)):
        for rule in getattr(hints[name], "__metadata__", [hints[name]]):
            if isinstance(rule, Within):
                found[name] = functools.partial(integer if get_args(hints[name])[0] is int else real, **rule._asdict())
            elif isinstance(rule, OneOf):
                found[name] = functools.partial(one_of, options=rule.options)
            elif rule in simple:
                found[name] = simple[rule]
            elif isinstance(rule, type) and dataclasses.is_dataclass(rule):
                found[name] = functools.partial(instance, kind=rule)
    return found


def _text(name: str, value: Any) -> str:
    return str(instance(name, value, str))  # not a subclass, such as NumPy's


def assign(instance: object, **values: Any) -> None:
    """Set fields of a frozen dataclass to their checked values, so that equal instances are identical."""
    for name, value in values.items():
        object.__setattr__(instance, name, value)


def equal_fields(one: Any, other: Any) -> bool:
    """Whether two instances of a dataclass have equal fields, arrays included: the ``==`` of results."""
    if type(one) is not type(other):
        return NotImplemented
    pairs = [(getattr(one, each.name), getattr(other, each.name)) for each in dataclasses.fields(one)]
    return all(np.array_equal(a, b) if isinstance(a, np.ndarray) else a == b for a, b in pairs)
