"""NRES maps: neural representation of a Euclidean space by cells with mutually exclusive receptive fields.

An N-map cuts each axis of the unit board into N equal intervals, so N × N square receptive fields tile the board and
exactly one cell is active for any point (one-hot; thesis section 4.1.2, paper B section 2.1). Cells are counted row by
row from the upper left. A point beyond the range of the map belongs to the nearest cell.
"""

from dataclasses import dataclass

import numpy as np

from neorl import checks
from neorl.kernel import kernel


@dataclass(frozen=True)
class NresMap:
    """A map of place cells.

    resolution: N, intervals an axis, at least 1.
    extent: (low, high), the stretch of either axis that the map covers, in board widths; (0, 1) is the whole board.

    Raises ValueError for anything else.
    """

    resolution: int
    extent: tuple[float, float] = (0.0, 1.0)

    def __post_init__(self):
        object.__setattr__(self, "resolution", checks.integer("resolution", self.resolution, at_least=1))
        object.__setattr__(self, "extent", checks.several("extent", self.extent))
        if len(self.extent) != 2 or not np.all(np.isfinite(self.extent)) or self.extent[0] >= self.extent[1]:
            raise ValueError(f"extent is {self.extent!r}, allowed are two finite numbers, the lower one first")

    @property
    def cells(self):
        """The number of cells, N²."""
        return self.resolution**2

    def encode(self, points):
        """The active cell for each point.

        points: float (…, 2), x and y in board widths. Returns int64 (…), 0 … N² − 1.
        Raises ValueError if a point is not finite.
        """
        points = checks.finite("points", np.asarray(points, float))
        low, scale = self.extent[0], self.resolution / (self.extent[1] - self.extent[0])
        flat = [cell_at(x, y, low, scale, self.resolution) for x, y in points.reshape(-1, 2)]
        return np.array(flat, np.int64).reshape(points.shape[:-1])


@kernel
def cell_at(x, y, low, scale, resolution):
    """The cell of a point: `scale` intervals for each unit of x and y, counted from `low`."""
    column = int(np.floor((x - low) * scale))
    row = int(np.floor((y - low) * scale))
    column = min(max(column, 0), resolution - 1)
    row = min(max(row, 0), resolution - 1)
    return row * resolution + column
