"""Checks of what users pass in: each returns the value, or raises a ValueError that names argument, value and rule."""

import math
import numbers
import operator

import numpy as np


def integer(name, value, at_least, at_most=None):
    """`value` as an int, if it is an integer in the range (True and False are not integers here)."""
    try:
        number = operator.index(value)
    except TypeError:
        number = None
    if number is not None and not isinstance(value, bool):
        if number >= at_least and (at_most is None or number <= at_most):
            return number
    allowed = f"integers ≥ {at_least}" if at_most is None else f"integers from {at_least} to {at_most}"
    raise ValueError(f"{name} is {value!r}, allowed are {allowed}")


def real(name, value, at_least=-math.inf, at_most=math.inf):
    """`value` as a float, if it is a finite number in the range."""
    number = value[()] if isinstance(value, np.ndarray) and value.ndim == 0 else value
    if isinstance(number, numbers.Real) and not isinstance(number, bool):
        number = float(number)  # first, since the bounds may be beyond what a short number of NumPy's can hold
        if math.isfinite(number) and at_least <= number <= at_most:
            return number
    bounds = f"numbers from {at_least:g} to {at_most:g}" if math.isfinite(at_most) else "finite numbers"
    bounds += f" ≥ {at_least:g}" if math.isinf(at_most) and math.isfinite(at_least) else ""
    raise ValueError(f"{name} is {value!r}, allowed are {bounds}")


def positive(name, value):
    """`value` as a float, if it is a finite number above 0."""
    number = real(name, value)
    if number > 0:
        return number
    raise ValueError(f"{name} is {value!r}, allowed are numbers above 0")


def one_of(name, value, allowed):
    """The one of `allowed` that `value` is."""
    for each in allowed:
        if isinstance(value, type(each)) and value == each:
            return each
    raise ValueError(f"{name} is {value!r}, allowed are {', '.join(map(repr, allowed))}")


def several(name, values):
    """`values` as a tuple, if they are a list, a tuple, a range or an array."""
    if isinstance(values, list | tuple | range) or isinstance(values, np.ndarray) and values.ndim:
        return tuple(values)
    raise ValueError(f"{name} is {values!r}, allowed are lists and tuples")


def flag(name, value):
    """`value` as a bool, if it is True or False."""
    return one_of(name, bool(value) if isinstance(value, np.bool) else value, (True, False))


def finite(name, array):
    """`array`, if every number in it is finite."""
    if np.all(np.isfinite(array)):
        return array
    raise ValueError(f"{name} is {array!r}, allowed are finite numbers")


def points(name, values, axes):
    """`values` as an array (…, axes) of doubles, if they are finite and have a coordinate for each of the axes."""
    array = finite(name, np.asarray(values, float))
    if array.ndim == 0 or array.shape[-1] != len(axes):
        raise ValueError(f"{name} has the shape {array.shape}, allowed are (…, {len(axes)}): {', '.join(axes)}")
    return array


def instance(name, value, kind):
    """`value`, if it is of the kind."""
    if isinstance(value, kind):
        return value
    article = "an" if kind.__name__[0] in "AEIOU" or kind is np.ndarray else "a"
    raise ValueError(f"{name} is {value!r}, allowed is {article} {kind.__name__}")


class Final:
    """A class that kernels read by its fields alone, and that therefore has no subclasses."""

    def __init_subclass__(cls, **keywords):
        super().__init_subclass__(**keywords)
        if Final not in cls.__bases__:
            raise TypeError(f"{cls.__name__} cannot be a subclass of {cls.__bases__[0].__name__}: kernels read its "
                            "fields and would never call what a subclass overrides; give a neorl.kernel as a field")


def assign(instance, **values):
    """Put checked values into the fields of a frozen dataclass, so that equal values are the same in every way."""
    for name, value in values.items():
        object.__setattr__(instance, name, value)
