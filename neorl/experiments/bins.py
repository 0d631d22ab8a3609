"""The bins of about 0.2 s in which the rewards and hits of runs are added up."""

import numpy as np

from neorl.common import checks

BIN_SECONDS = 0.2


def bin_steps(world):
    """The number of steps in a bin: 0.2 s, rounded, and at least one."""
    return max(1, round(BIN_SECONDS * world.fps))


def n_bins(world, steps):
    """The number of bins of a run of `steps` steps, of which the last may be short."""
    return -(-steps // bin_steps(world))


def bin_shapes(world, runs, steps):
    """The types and shapes of the rewards and hits of runs of `steps` steps, {name: (dtype, shape)}."""
    bins = n_bins(world, steps)
    return {"rewards": (np.dtype(np.float32), (runs, bins)),
            "hits": (np.dtype(np.int16), (runs, bins, len(world.kinds)))}


def new_bins(world, runs, steps):
    """Zeros for the rewards and hits of runs of `steps` steps: float32 (runs, bins) and int16 (runs, bins, kinds)."""
    return tuple(np.zeros(shape, dtype) for dtype, shape in bin_shapes(world, runs, steps).values())


def checked_bins(name, array, dtype, bins, *beside):
    """An array for a run's rewards or hits, or a new one in place of None. Raises ValueError if it does not fit."""
    if array is None:
        return np.zeros((bins, *beside), dtype)
    if (not isinstance(array, np.ndarray) or array.dtype != dtype or len(array) < bins or array.shape[1:] != beside
            or not array.flags.c_contiguous or not array.flags.writeable):
        shown = f"{array.dtype} {array.shape}" if isinstance(array, np.ndarray) else checks.shown(array)
        raise ValueError(f"{name} must be {dtype.__name__} from {(bins, *beside)} on, contiguous and writeable, but is "
                         f"{shown}")
    return array
