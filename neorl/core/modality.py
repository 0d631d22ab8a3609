"""Modalities: the Euclidean spaces that the cells of maps represent, each given by its axes.

Along each axis an agent perceives one number, computed from a vector in units of the world's size (its width in
WaterWorld) and seconds: its own position or velocity, or the position of things relative to it (objects, boundaries,
landmarks), along the axes of the world. The number is a *feature* of the vector (thesis section 2.2 and table 2.1;
paper B, table 1):

- *component*: one component, unchanged; the experiments use two for places and, as an emulation, for objects;
- *foveated*: the square root of a component, with its sign; its equal intervals are wider the greater the distance,
  as receptive fields grow with eccentricity;
- *margin*: how far a component reaches into a margin along the walls, negative in the west and the north, and 0 in the
  middle of the board;
- *length*, and *direction*.

A direction runs from east (0) by way of south, since y points down, and closes on itself. A vector of length 0 has no
direction: by itself it counts as east, and in a run it keeps its last direction (see `neorl.core.loop`).

Axes of several vectors make *conjunctive* cells, such as those of place and head direction: `PLACE_CELL.axes +
HEAD_DIRECTION_CELL.axes`.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Annotated

import numpy as np

from neorl.common import checks
from neorl.common.checks import OneOf, Within
from neorl.core.choices import Feature
from neorl.core.scene import MOST_AXES
from neorl.kernels.kernel import check_kernel

VECTORS = ("position", "velocity", "objects", "boundaries", "landmarks")
SEVERAL = ("objects", "boundaries", "landmarks")  # there may be several of each; a modality follows one kind at most
MOST_CELLS = 2**31 - 1  # of a map
MOST_MIRRORED = 3  # axes of a world; one of n axes has 2ⁿ n! mirror images
FEATURES = tuple(Feature.__members__)


@dataclass(frozen=True)
class Axis(checks.Final):
    """One axis of a space.

    of: "position", "velocity", "objects", "boundaries" (the nearest point of each side of the board) or "landmarks"; or
        a `neorl.kernel` ``(scene, point) → number`` that returns the coordinate, never NaN, given the
        `neorl.core.scene.Scene` and the number of the thing, side or landmark; `neorl.worlds.walls` makes such kernels
        for walls anywhere.
    feature: of that vector: "component", "foveated", "margin" (of a position), "length" or "direction" (in the plane of
        the first two axes of the world).
    along: for a component, foveated or not, or a margin, the axis of the world: 0 for x, 1 for y, and so on.
    low, high: the range, in units of the world's size (per second, for velocity); points beyond it are in the
        interval at its end. For a margin, `high` is its width; for a foveated component, both are square roots. A
        direction has none.
    closed: whether the range closes on itself, as for an angle; a direction always does. A goal on it is a
        `neorl.Place`, or coordinates of the map, anywhere on the circle.
    centred: whether an interval is centred on the middle of the range also if their number is even; there is then one
        more, of which half lies beyond either end.
    intervals: their number, whatever the resolution of the map; None stands for that resolution.
    boundaries: of unequal intervals, from the first to the last, in place of `low`, `high` and `intervals`.
    name: of the coordinate; by default derived from the other fields.

    Raises ValueError for anything else.
    """

    of: str | Callable[..., float]
    feature: Annotated[str, OneOf(FEATURES)] = "component"
    along: Annotated[int, Within(0, MOST_AXES - 1)] = 0
    low: float = 0.0
    high: float = 1.0
    closed: bool = False
    intervals: int | None = None
    boundaries: Sequence[float] = ()
    name: str = ""
    centred: bool = False

    def __post_init__(self):
        of = check_kernel("of", self.of) if callable(self.of) else checks.one_of("of", self.of, VECTORS)
        checks.check_fields(self)
        checks.assign(self, of=of, boundaries=tuple(checks.real("boundaries", each)
                                      for each in checks.several("boundaries", self.boundaries)))
        if self.boundaries:
            if len(self.boundaries) < 2 or any(np.diff(self.boundaries) <= 0):
                raise checks.error("boundaries", "two numbers or more that increase", self.boundaries)
            checks.assign(self, low=self.boundaries[0], high=self.boundaries[-1], intervals=len(self.boundaries) - 1)
        checks.assign(self, closed=self.closed or self.is_direction)
        if self.centred and (self.closed or self.boundaries):
            raise checks.error("centred", "False for an axis that is closed or has boundaries", self.centred)
        if self.intervals is not None:
            checks.assign(self, intervals=checks.integer("intervals", self.intervals, 1, MOST_CELLS))
        if self.low >= self.high or not np.isfinite(MOST_CELLS / (self.high - self.low)):
            raise checks.error("low", f"below high, {self.high!r}", self.low)
        if self.feature == "margin" and (self.of != "position" or not 0 < self.high <= 0.5):
            raise ValueError(f"a margin must be one of 'position', of at most 0.5, but is of {self.of!r}, "
                             f"{self.high!r}")
        if self.boundaries and self.closed:
            raise checks.error("boundaries", "() for an axis that is closed", self.boundaries)
        checks.assign(self, name=self.name or self._name)

    @property
    def is_direction(self) -> bool:
        """Whether the coordinate is a direction, in radians."""
        return not callable(self.of) and self.feature == "direction"

    @property
    def _name(self):
        if callable(self.of):
            return self.of.__name__
        if self.feature in ("component", "foveated", "margin"):
            return "xyz"[self.along] if self.along < 3 else f"x{self.along}"
        return "speed" if (self.of, self.feature) == ("velocity", "length") else (
            "distance" if self.feature == "length" else "direction")


def cartesian(of: str, *ranges: Sequence[float], intervals: int | None = None) -> tuple[Axis, ...]:
    """Axes for the components of a vector: a tuple of `Axis`.

    of, intervals: as in `Axis`. ranges: (low, high) for each component. Raises ValueError for anything else.
    """
    pairs = [checks.several("ranges", each) for each in ranges]
    if any(len(pair) != 2 for pair in pairs):
        raise checks.error("ranges", "pairs (low, high)", ranges)
    return tuple(Axis(of, "component", along, low, high, intervals=intervals)
                 for along, (low, high) in enumerate(pairs))


def polar(of: str, reach: float, intervals: int | None = None) -> tuple[Axis, ...]:
    """Axes for the length of a vector in the plane, from 0 to `reach`, and its direction: a tuple of `Axis`.

    of, intervals: as in `Axis`. Raises ValueError for anything else, such as a reach that is not above 0.
    """
    return Axis(of, "length", high=reach, intervals=intervals), Axis(of, "direction", intervals=intervals)


@dataclass(frozen=True)
class Modality(checks.Final):
    """The Euclidean space that the cells of a map represent.

    name: of such a cell in neuroscience.
    axes: one `Axis` or more; of objects, boundaries and landmarks, one kind at most.
    landmarks: their positions, in units of the world's size, if an axis is of landmarks.
    mirrored: whether points that differ only by reflections along the axes of the world and exchanges of two of them
        share a cell, whose actions are those of the mirror image. The axes must then be, for each vector, a component,
        foveated or not, along every axis of the world in turn, with the same range and intervals. Coordinates of the
        first vector are never below 0. Only nodes whose goals are contacts can have such maps.

    Raises ValueError for anything else.
    """

    name: str
    axes: Sequence[Axis]
    landmarks: Sequence[Sequence[float]] = ()
    mirrored: bool = False

    def __post_init__(self):
        checks.check_fields(self)
        axes = tuple(checks.instance("axes", each, Axis) for each in checks.several("axes", self.axes))
        if not axes or len({axis.of for axis in axes if axis.of in SEVERAL}) > 1:
            raise checks.error("axes", f"one or more, and of {', '.join(SEVERAL)} of one kind at most", axes)
        landmarks = tuple(tuple(checks.real("landmarks", value) for value in checks.several("landmarks", each))
                          for each in checks.several("landmarks", self.landmarks))
        checks.assign(self, axes=axes, landmarks=landmarks)
        order = [0.0 if axis.of == self.follows and not axis.is_direction else 1.0 if axis.of == self.follows else 2.0
                 for axis in axes]
        if order != sorted(order):
            raise checks.error("axes", f"first those of {self.follows}, a direction last, then those of other vectors",
                               axes)
        if bool(landmarks) != (self.follows == "landmarks") or len({len(each) for each in landmarks}) > 1:
            raise checks.error("landmarks", "places of equally many coordinates where an axis is of landmarks, and () "
                               "elsewhere", self.landmarks)
        if self.mirrored and not self._is_symmetric:
            raise checks.error("axes", "for each vector a component along every axis of the world in turn, of the same "
                               "range and intervals, since mirrored is True", axes)
        if landmarks and len(landmarks[0]) < self.least_axes:
            raise checks.error("landmarks", f"places of {self.least_axes} coordinates or more", landmarks)

    @property
    def _is_symmetric(self):
        along_each = [[axis for axis in self.axes if axis.of == of] for of in dict.fromkeys(
            axis.of for axis in self.axes)]
        return all([replace(axis, along=0, name="") for axis in group] == [replace(group[0], along=0, name="")] * len(
            group) and [axis.along for axis in group] == list(range(self.least_axes)) and not callable(group[0].of)
            and group[0].feature in ("component", "foveated") for group in along_each)

    @property
    def follows(self) -> str:
        """The vector in which elements of interest have a place: that of several points, or else the agent's own."""
        vectors = [axis.of for axis in self.axes if not callable(axis.of)]
        several = [each for each in vectors if each in SEVERAL]
        return several[0] if several else "position" if "position" in vectors or not vectors else "velocity"

    @property
    def is_cartesian(self) -> bool:
        """Whether the axes are the components of one vector, in turn, cut into equal intervals of an open range."""
        return all((axis.of, axis.feature, axis.along) == (self.follows, "component", along)
                   and not (axis.closed or axis.boundaries) for along, axis in enumerate(self.axes))

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the coordinates; a direction is in radians."""
        return tuple(axis.name for axis in self.axes)

    @property
    def takes_places(self) -> bool:
        """Whether a place in the world can be an element of interest for these cells."""
        return self.follows != "velocity" or [axis.feature for axis in self.axes] == ["direction"]

    @property
    def functions(self) -> tuple[Callable[..., float], ...]:
        """The user-defined kernels among its axes: a tuple."""
        return tuple(axis.of for axis in self.axes if callable(axis.of))

    def check_axes(self, n_axes: int) -> None:
        """Raise ValueError unless these cells are defined in a world of `n_axes` axes."""
        if self.least_axes > n_axes:
            raise ValueError(f"the world of {self.name}s must have {self.least_axes} axes or more, but has {n_axes}")
        if self.mirrored and not self.least_axes == n_axes <= MOST_MIRRORED:
            raise ValueError(f"mirrored {self.name}s must have components along all axes of a world, which has "
                             f"{n_axes}, and along {MOST_MIRRORED} at most, but have {self.least_axes}")
        if self.landmarks and len(self.landmarks[0]) != n_axes:
            raise checks.error("landmarks", f"places of {n_axes} coordinates in this world", self.landmarks)

    @property
    def least_axes(self) -> int:
        """The least number of axes of a world in which these cells are defined."""
        least = [2 if axis.feature == "direction" else axis.along + 1 for axis in self.axes if not callable(axis.of)]
        return max([1, *least, *(len(each) for each in self.landmarks)])


# O'Keefe and Dostrovsky 1971; Solstad et al. 2008; Høydal et al. 2019 and, in its Cartesian emulation, paper B,
# section 3; Lever et al. 2009; Deshmukh and Knierim 2013; Taube et al. 1990; Kropff et al. 2015.
PLACE_CELL = Modality("place cell", cartesian("position", (0, 1), (0, 1)))
BORDER_CELL = Modality("border cell", [Axis("position", "margin", along, -0.25, 0.25) for along in (0, 1)])
OBJECT_VECTOR_CELL = Modality("object-vector cell", polar("objects", 1))
CARTESIAN_OBJECT_VECTOR_CELL = Modality("object-vector cell, Cartesian", cartesian("objects", (-1, 1), (-1, 1)))
BOUNDARY_VECTOR_CELL = Modality("boundary-vector cell", polar("boundaries", 1))
LANDMARK_VECTOR_CELL = Modality("landmark-vector cell", polar("landmarks", 1), ((0.5, 0.5),))
HEAD_DIRECTION_CELL = Modality("head-direction cell", [Axis("velocity", "direction")])
SPEED_CELL = Modality("speed cell", [Axis("velocity", "length", high=2)])
MODALITIES = (PLACE_CELL, BORDER_CELL, OBJECT_VECTOR_CELL, CARTESIAN_OBJECT_VECTOR_CELL, BOUNDARY_VECTOR_CELL,
              LANDMARK_VECTOR_CELL, HEAD_DIRECTION_CELL, SPEED_CELL)
