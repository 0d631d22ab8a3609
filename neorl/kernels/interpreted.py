"""Records as interpreted kernels see them: with attributes, like compiled kernels, and faster than by `np.recarray`."""

import functools

import numpy as np

from neorl.kernels.annotations import mapped


def interpreted(values):
    """A record (an array without axes), or a named tuple of arrays, with attributes; anything else unchanged."""
    if isinstance(values, np.ndarray) and values.dtype.names:
        return _row_type(values.dtype)(values) if values.ndim == 0 else Rows(values)
    return mapped(interpreted, values) if hasattr(values, "_fields") else values


class Rows:
    """The rows of an array of records."""

    def __init__(self, array):
        self.shape, self._array, self._rows = array.shape, array, {}  # rows are made when first read, and kept

    def __getitem__(self, index):
        if index not in self._rows:
            self._rows[index] = interpreted(self._array[index : index + 1].reshape(()))
        return self._rows[index]


@functools.cache
def _row_type(dtype):
    """The class of the rows of a dtype, in which each number is a property, and each array or record an attribute."""
    numbers = [name for name, (kind, *_) in dtype.fields.items() if kind.base.names is None and kind.ndim == 0]

    def __init__(self, row):
        for name in dtype.names:
            setattr(self, f"_{name}" if name in numbers else name, interpreted(row[name]))

    def number(name):
        return property(lambda self: getattr(self, name)[()], lambda self, value: getattr(self, name).__setitem__(
            (), value))

    return type("Row", (), {"__init__": __init__} | {name: number(f"_{name}") for name in numbers})
