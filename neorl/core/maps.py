"""NRES maps: neural representation of a Euclidean space by cells with mutually exclusive receptive fields.

An N-map cuts each axis of a modality's space into N equal intervals, unless the axis has its own, so that exactly one
cell is active for any point (one-hot; thesis section 4.1.2, paper B section 2.1). Cells are numbered along the first
axis first: in a map of places, row by row from the upper left. An interval contains its lower end but not its upper
one. A point beyond the range of the map belongs to the cell at the end of the range; a direction closes on itself, its
first interval centred on east.
"""

import math
from dataclasses import dataclass
from types import SimpleNamespace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from neorl.common import checks
from neorl.core.building import choices_of, space_of
from neorl.core.coordinates import as_turns
from neorl.core.derived import intervals_along
from neorl.core.geometry import cell_of, in_range
from neorl.core.layout import Memory, Record
from neorl.core.modality import MOST_CELLS, PLACE_CELL, Modality
from neorl.kernels.annotations import array
from neorl.kernels.execution import execute, interpret
from neorl.kernels.kernel import kernel


@dataclass(frozen=True)
class NresMap(checks.Final):
    """A map of one modality.

    resolution: N, intervals per axis, at least 1; at most `neorl.core.modality.MOST_CELLS` cells in all.
    modality: the `Modality` that its cells represent.

    Raises ValueError for anything else.
    """

    resolution: int
    modality: Modality = PLACE_CELL

    def __post_init__(self):
        checks.assign(self, resolution=checks.integer("resolution", self.resolution, 1, MOST_CELLS))
        checks.instance("modality", self.modality, Modality)
        if self.cells > MOST_CELLS:
            raise checks.error("resolution", f"that of a map of at most {MOST_CELLS} cells", self.resolution)

    @property
    def intervals(self) -> tuple[int, ...]:
        """The number of intervals along each axis: a tuple."""
        (node,) = choices_of([self.modality])
        return tuple(interpret(intervals_along, SimpleNamespace(**axis), self.resolution) for axis in node["axes"])

    @property
    def cells(self) -> int:
        """The number of cells: the product of the intervals of all axes."""
        return math.prod(self.intervals)

    def encode(self, points: ArrayLike) -> NDArray[np.int64]:
        """The active cell for each point.

        points: float (…, axes), coordinates of the modality. Returns int64 (…), 0 … cells − 1.
        Raises ValueError if a point is not finite or has another number of coordinates.
        """
        points = checks.points("points", points, self.modality.names)
        cells = np.zeros(points.shape[:-1], np.int64)
        agent, memory = space_of(self.modality, self.resolution)
        execute(encode, agent, memory, as_turns(self.modality, points), cells.reshape(-1))
        return cells


@kernel
def encode(agent: Record, memory: Memory, points: array("float64", "points", "coordinates"),
           cells: array("int64", "points")) -> None:
    """The cell of each point in the only map; points are brought into its range in place."""
    for point in range(cells.shape[0]):
        for i in range(points.shape[1]):
            points[point, i] = in_range(memory, agent.axes[i], points[point, i])
        cells[point] = cell_of(memory, agent.nodes[0], agent.maps[0], points[point])
