"""NRES maps: neural representation of a Euclidean space by cells with mutually exclusive receptive fields.

An N-map cuts each axis of a modality's space into N equal intervals, so that exactly one cell is active for any point
(one-hot; thesis section 4.1.2, paper B section 2.1). Cells are counted along the first axis first: a map of places row
by row from the upper left. An interval holds its lower end and not its upper one. A point beyond the range of the map
belongs to the cell at the end of the range; a direction closes on itself, its first interval centred on east.
"""

from dataclasses import dataclass

import numpy as np

from neorl import checks
from neorl.core.kernel import kernel
from neorl.core.modality import ANGLE, LENGTH, PLACE_CELL, POLAR, Modality


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
        tiles = tiling(self.resolution, *self.modality.space)
        cells = [cell_at(*pair, *tiles) for pair in self.modality.as_pairs(points)]
        return np.array(cells, np.int64).reshape(points.shape[:-1])

    def covers(self, points):
        """Whether each point lies in the range of the map, so that encoding it clamps nothing: bool (…)."""
        points = checks.points("points", points, self.modality.axes)[..., : len(self.modality.ranges)]
        low, high = np.array(self.modality.ranges).reshape(-1, 2).T
        return np.all((low <= points) & (points <= high), axis=-1)


@kernel
def tiling(resolution, tuning, low_0, high_0, low_1, high_1):
    """How `cell_at` cuts the two axes: (columns, rows, low_u, scale_u, low_v, scale_v, closed)."""
    columns = 1 if tuning == ANGLE else resolution
    rows = 1 if tuning == LENGTH else resolution
    closed = tuning == ANGLE or tuning == POLAR
    if closed:  # in turns, the first interval centred on east
        low_1 = -0.5 / resolution
        high_1 = 1.0 + low_1
    return columns, rows, low_0, columns / (high_0 - low_0), low_1, rows / (high_1 - low_1), closed


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
