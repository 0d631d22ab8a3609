"""Memory of an agent's arrays: whether it suffices, and its layout."""

import numpy as np

from neorl.common.container import usable_bytes
from neorl.core.building import n_bytes
from neorl.kernels.annotations import mapped

CACHE_LINES = 128  # bytes; two lines, because processors fetch them in pairs
PAGE = 4_096


def fitting_runs(record):
    """How many runs of an agent fit into nine tenths of the free memory, by its record. MemoryError if none fits."""
    needed = n_bytes(record)
    return int(usable_bytes(needed, "a run of this agent needs", "choose fewer or coarser maps") // needed)


def kept_apart(values):
    """The same record or named tuple, with its small arrays on cache lines of their own.

    Cores that write to the same line have to take turns (false sharing), which made parallel runs a sixth slower.
    """
    return mapped(lambda array: on_lines_of_its_own(array) if array.nbytes < PAGE or array.ndim == 0 else array, values)


def on_lines_of_its_own(array):
    """A copy of an array that shares no cache line with any other."""
    buffer = np.zeros(array.nbytes + 2 * CACHE_LINES, np.uint8)
    copy = buffer[CACHE_LINES : CACHE_LINES + array.nbytes].view(array.dtype).reshape(array.shape)
    copy[...] = array
    return copy


def read_only(array):
    """A read-only view of an array, with the fields of records as attributes."""
    view = array.view(np.recarray) if array.dtype.names else array.view()
    view.flags.writeable = False
    return view
