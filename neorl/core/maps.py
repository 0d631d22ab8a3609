"""NRES maps: neural representation of a Euclidean space by cells with mutually exclusive receptive fields.

An N-map cuts each axis of a modality's space into N equal intervals, so that exactly one cell is active for any point
(one-hot; thesis section 4.1.2, paper B section 2.1). Cells are counted along the first axis first: a map of places row
by row from the upper left. An interval holds its lower end and not its upper one. A point beyond the range of the map
belongs to the cell at the end of the range; a direction closes on itself, its first interval centred on east.
"""

from dataclasses import dataclass

import numpy as np

from neorl import checks
from neorl.core.geometry import cell_at, tiling
from neorl.core.kernel import execute
from neorl.core.modality import PLACE_CELL, Modality


MOST_CELLS = 2**31 - 1


@dataclass(frozen=True)
class NresMap:
    """A map of one modality.

    resolution: N, intervals an axis, at least 1; there can be `MOST_CELLS` cells.

    Raises ValueError for anything else.
    """

    resolution: int
    modality: Modality = PLACE_CELL

    def __post_init__(self):
        checks.assign(self, resolution=checks.integer("resolution", self.resolution, at_least=1))
        checks.instance("modality", self.modality, Modality)
        if self.cells > MOST_CELLS:
            raise ValueError(f"resolution is {self.resolution}, allowed are maps of at most {MOST_CELLS} cells")

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
        tiles = execute(tiling, self.resolution, *self.modality.space)
        cells = [execute(cell_at, u, v, tiles) for u, v in self.modality.as_pairs(points)]
        return np.array(cells, np.int64).reshape(points.shape[:-1])

    def covers(self, points):
        """Whether each point lies in the range of the map, so that encoding it clamps nothing: bool (…)."""
        points = checks.points("points", points, self.modality.axes)[..., : len(self.modality.ranges)]
        low, high = np.array(self.modality.ranges).reshape(-1, 2).T
        return np.all((low <= points) & (points <= high), axis=-1)
