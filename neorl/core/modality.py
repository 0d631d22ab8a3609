"""Modalities: rules that turn the situation into coordinates in a Euclidean space.

A modality starts from a vector, in board widths and seconds: the agent's position or velocity, or where things are as
seen from the agent (objects, boundaries, landmarks), axes staying as they are in the arena. It keeps what its cells are
tuned to (thesis section 2.2 and table 2.1; paper B, table 1):

- *cartesian*: both components as they are; the experiments use it for places and, as an emulation, for objects;
- *proximal*: how far either component reaches into a margin along the walls, negative in the west and the north, and 0
  in the middle of the board;
- *polar*: length and direction; *angle*: the direction alone; *length*: the length alone.

A direction runs from east (0) by way of south, since y points down. A vector of length 0 has none: by itself it is
taken to be east, and in the life of an agent it keeps the direction that it had (see `neorl.core.life`).
"""

from dataclasses import dataclass

import numpy as np

from neorl import checks
from neorl.core.choices import Tuning
from neorl.core.geometry import TAU, boundary_vector, tuned
from neorl.core.kernel import execute


TUNED = {"position": ("cartesian", "proximal"), "velocity": ("cartesian", "polar", "angle", "length")}
TUNED |= dict.fromkeys(("objects", "boundaries", "landmarks"), ("cartesian", "polar"))
AXES = {"cartesian": ("x", "y"), "proximal": ("x", "y"), "polar": ("distance", "direction"), "angle": ("direction",),
        "length": ("speed",)}
SEEN_FROM_AGENT = "centred on the agent, allocentric direction"
FRAMES = {"position": "allocentric", "velocity": "allocentric direction"}


@dataclass(frozen=True)
class Modality:
    """What the cells of a map stand for.

    name: of such a cell in neuroscience.
    vector: "position", "velocity", "objects", "boundaries" (the nearest point of each wall) or "landmarks".
    tuning: "cartesian", "proximal", "polar", "angle" or "length"; see the module for which goes with what.
    ranges: (low, high) for each axis but a direction, in board widths (a second, for velocity). Beyond it lies the
        cell at its end. For "proximal" high is the width of the margin.
    landmarks: where they stand, (x, y) each, if `vector` is "landmarks".

    Raises ValueError for anything else.
    """

    name: str
    vector: str
    tuning: str
    ranges: tuple[tuple[float, float], ...] = ()
    landmarks: tuple[tuple[float, float], ...] = ()

    def __post_init__(self):
        checks.instance("name", self.name, str)
        checks.assign(self, vector=checks.one_of("vector", self.vector, tuple(TUNED)))
        checks.assign(self, tuning=checks.one_of("tuning", self.tuning, TUNED[self.vector]))
        axes = len(AXES[self.tuning]) - self.has_direction
        self._set_pairs("ranges", axes, axes)
        self._set_pairs("landmarks", *((1, np.inf) if self.vector == "landmarks" else (0, 0)))
        for low, high in self.ranges:
            if low >= high:
                raise ValueError(f"ranges is {self.ranges!r}, allowed are pairs with the lower number first")
            if self.tuning == "proximal" and not 0 < high <= 0.5:
                raise ValueError(f"ranges is {self.ranges!r}, allowed are margins up to half a board width")

    def _set_pairs(self, name, fewest, most):
        pairs = tuple(checks.several(name, pair) for pair in checks.several(name, getattr(self, name)))
        if not fewest <= len(pairs) <= most or any(len(pair) != 2 for pair in pairs):
            allowed = f"{fewest}" if fewest == most else f"{fewest} or more"
            raise ValueError(f"{name} is {getattr(self, name)!r}, allowed are {allowed} pairs of numbers")
        checks.assign(self, **{name: tuple(tuple(checks.real(name, value) for value in pair) for pair in pairs)})

    @property
    def axes(self):
        """The names of the coordinates; a direction comes last, and is in radians."""
        return AXES[self.tuning]

    @property
    def has_direction(self):
        """Whether the last axis is a direction, and closes on itself."""
        return self.tuning in ("polar", "angle")

    @property
    def space(self):
        """What `maps.tiling` takes of it: (tuning, low, high, low, high), 0 and 1 where an axis has no range."""
        bounds = [float(bound) for pair in self.ranges for bound in pair]
        return int(Tuning[self.tuning]), *[*bounds, 0.0, 1.0, 0.0, 1.0][:4]

    @property
    def in_pair(self):
        """Where the coordinates stand in the pairs of `tuned`, of which a 1-D modality has only one: a slice."""
        return slice(1, 2) if self.tuning == "angle" else slice(len(self.axes))

    @property
    def frame(self):
        """The reference frame; a length alone has none."""
        return "–" if self.tuning == "length" else FRAMES.get(self.vector, SEEN_FROM_AGENT)

    @property
    def takes_places(self):
        """Whether an element of interest at a place in the arena has a meaning here."""
        return self.vector != "velocity" or self.tuning == "angle"

    def coordinates(self, world, state):
        """Where everything that the modality follows is, in a state of a world: float64 (points, axes)."""
        velocity = state.agent_velocity / world.width
        x, y = state.agent_position / world.width
        vectors = {"position": [(x, y)], "velocity": [velocity],
                   "objects": state.creep_position / world.width - (x, y),
                   "boundaries": [execute(boundary_vector, wall, x, y) for wall in range(4)],
                   "landmarks": np.array(self.landmarks).reshape(-1, 2) - (x, y)}[self.vector]
        return self.tune(vectors)

    def tune(self, vectors):
        """The coordinates that vectors (…, 2) have for these cells: float64 (…, axes).

        Raises ValueError if a vector is not finite or not of two components.
        """
        vectors = checks.points("vectors", vectors, ("x", "y"))
        tuning, _, reach_x, _, reach_y = self.space
        pairs = [execute(tuned, tuning, x, y, reach_x, reach_y) for x, y in vectors.reshape(-1, 2)]
        pairs = np.array(pairs).reshape(-1, 2)
        pairs[:, 1] *= TAU if self.has_direction else 1.0
        return pairs[:, self.in_pair].reshape(*vectors.shape[:-1], len(self.axes))

    def as_pairs(self, points):
        """Coordinates (…, axes) as kernels take them: float64 (points, 2), a direction in turns."""
        points = np.asarray(points, float).reshape(-1, len(self.axes))
        pairs = np.zeros((len(points), 2))
        pairs[:, self.in_pair] = points
        if self.has_direction:
            pairs[:, 1] = pairs[:, 1] / TAU % 1.0
        return pairs


# O'Keefe and Dostrovsky 1971; Solstad et al. 2008; Høydal et al. 2019 and, in its Cartesian emulation, paper B,
# section 3; Lever et al. 2009; Deshmukh and Knierim 2013; Taube et al. 1990; Kropff et al. 2015.
PLACE_CELL = Modality("place cell", "position", "cartesian", ((0, 1), (0, 1)))
BORDER_CELL = Modality("border cell", "position", "proximal", ((-0.25, 0.25), (-0.25, 0.25)))
OBJECT_VECTOR_CELL = Modality("object-vector cell", "objects", "polar", ((0, 1),))
CARTESIAN_OBJECT_VECTOR_CELL = Modality("object-vector cell, Cartesian", "objects", "cartesian", ((-1, 1), (-1, 1)))
BOUNDARY_VECTOR_CELL = Modality("boundary-vector cell", "boundaries", "polar", ((0, 1),))
LANDMARK_VECTOR_CELL = Modality("landmark-vector cell", "landmarks", "polar", ((0, 1),), ((0.5, 0.5),))
HEAD_DIRECTION_CELL = Modality("head-direction cell", "velocity", "angle")
SPEED_CELL = Modality("speed cell", "velocity", "length", ((0, 2),))
MODALITIES = (PLACE_CELL, BORDER_CELL, OBJECT_VECTOR_CELL, CARTESIAN_OBJECT_VECTOR_CELL, BOUNDARY_VECTOR_CELL,
              LANDMARK_VECTOR_CELL, HEAD_DIRECTION_CELL, SPEED_CELL)
