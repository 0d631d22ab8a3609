"""NRES maps: neural representation of a Euclidean space by cells with mutually exclusive receptive fields.

An N-map cuts each axis of a modality's space into N equal intervals, so that exactly one cell is active for any point
(one-hot; thesis section 4.1.2, paper B section 2.1). Cells are counted along the first axis first: a map of places row
by row from the upper left. An interval holds its lower end and not its upper one. A point beyond the range of the map
belongs to the cell at the end of the range; a direction closes on itself, its first interval centred on east.
"""

from dataclasses import dataclass

import numpy as np

from neorl import checks
from neorl.kernel import kernel
from neorl.modality import PLACE_CELL, TAU, Modality


@dataclass(frozen=True)
class NresMap:
    """A map of one modality.

    resolution: N, intervals an axis, at least 1.

    Raises ValueError for anything else.
    """

    resolution: int
    modality: Modality = PLACE_CELL

    def __post_init__(self):
        object.__setattr__(self, "resolution", checks.integer("resolution", self.resolution, at_least=1))
        checks.instance("modality", self.modality, Modality)

    @property
    def cells(self):
        """The number of cells: N for each axis of the modality, multiplied."""
        return self.resolution ** len(self.modality.axes)

    def encode(self, points):
        """The active cell for each point.

        points: float (…, axes), coordinates of the modality. Returns int64 (…), 0 … cells − 1.
        Raises ValueError if a point is not finite or has another number of coordinates.
        """
        points = checks.points("points", points, self.modality.axes)
        axes = points.shape[-1]
        pairs = np.zeros((points.size // axes, 2))
        pairs[:, self.modality.in_pair] = points.reshape(-1, axes)
        if self.modality.has_direction:
            pairs[:, 1] = pairs[:, 1] / TAU % 1.0
        tiles = tiling(self)
        return np.array([cell_at(*pair, *tiles) for pair in pairs], np.int64).reshape(points.shape[:-1])

    def covers(self, points):
        """Whether each point lies in the range of the map, so that encoding it clamps nothing: bool (…)."""
        points = checks.points("points", points, self.modality.axes)[..., : len(self.modality.ranges)]
        low, high = np.array(self.modality.ranges).reshape(-1, 2).T
        return np.all((low <= points) & (points <= high), axis=-1)


def tiling(nres_map):
    """How `cell_at` cuts the two axes: (columns, rows, low_u, scale_u, low_v, scale_v, closed)."""
    n, modality = nres_map.resolution, nres_map.modality
    ranges = list(modality.ranges)
    if modality.has_direction:
        ranges.append((-0.5 / n, 1 - 0.5 / n))  # turns
    count = [n] * len(ranges)
    if len(ranges) == 1:
        at = 0 if modality.has_direction else 1
        ranges.insert(at, (0.0, 1.0))
        count.insert(at, 1)
    (low_u, high_u), (low_v, high_v) = ranges
    return (*count, low_u, count[0] / (high_u - low_u), low_v, count[1] / (high_v - low_v), modality.has_direction)


@kernel
def cell_at(u, v, columns, rows, low_u, scale_u, low_v, scale_v, closed):
    """The cell of a point (u, v); `closed` if v is a direction, in turns."""
    column = np.floor((u - low_u) * scale_u)
    row = np.floor((v - low_v) * scale_v)
    if closed and row >= rows:
        row -= rows
    return within(row, rows) * columns + within(column, columns)


@kernel
def within(interval, count):
    """The nearest of the intervals 0 … count − 1; compared before it becomes an integer, which may not hold it."""
    if not interval > 0.0:
        return 0
    return count - 1 if interval > count - 1 else int(interval)
