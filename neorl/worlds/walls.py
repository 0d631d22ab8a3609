"""Walls that any world of two axes can hold, and that the cells of an agent can sense.

1. A wall is a rectangle (left, top, right, bottom), in the world's units of length. A world keeps its walls in its
   rules, as an array annotated ``array("float64", "walls", 4)`` and made by `table`.
2. The kernel ``block(walls, position, axis, after)`` returns whether a wall is in the way of a move along one axis,
   from a position to the coordinate `after`. The whole way counts, so no wall is too thin to stop an agent. An agent
   may stand on the edge of a wall; walls that meet must overlap, or it can pass between them along the seam.
3. The kernel ``contain(walls, x, y)`` returns whether a point is inside a wall.
4. `distance` and `distance_along` make axes (`neorl.custom.Axis`) on which cells sense walls: border cells fire at a
   distance from the nearest wall, boundary-vector cells at a distance from the first wall in a direction (Solstad
   et al. 2008, Lever et al. 2009). Cells sense only the walls in the list, which may include the sides of the world.
"""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from neorl.common import checks
from neorl.kernels.kernel import kernel, kernel_maker


def checked(name: str, walls: Sequence[Sequence[float]], low: float = -checks.LARGEST,
            high: float = checks.LARGEST) -> tuple[tuple[float, ...], ...]:
    """Walls as a tuple of (left, top, right, bottom).

    name: of the argument. walls: rectangles (left, top, right, bottom) in `low` … `high`, with left < right and
    top < bottom. Raises ValueError for anything else.
    """
    rectangles = tuple(tuple(checks.real(name, value, low, high) for value in checks.several(name, wall))
                       for wall in checks.several(name, walls))
    if any(len(wall) != 4 or not (wall[0] < wall[2] and wall[1] < wall[3]) for wall in rectangles):
        raise checks.error(name, "rectangles (left, top, right, bottom)", walls)
    return rectangles


def table(walls: Sequence[Sequence[float]]) -> NDArray[np.float64]:
    """Walls as the rules of a world hold them: float64 (walls, 4).

    walls: rectangles (left, top, right, bottom), with left < right and top < bottom. Raises ValueError for anything
    else.
    """
    return np.array(checked("walls", walls), float).reshape(-1, 4)


@kernel
def block(walls, position, axis, after):
    """Whether a wall is in the way of a move along one axis, from a position to the coordinate `after`."""
    before, beside, blocked = position[axis], position[1 - axis], False
    first, last = min(before, after), max(before, after)
    for wall in range(walls.shape[0]):
        low, high = walls[wall, axis], walls[wall, axis + 2]
        enters, crosses = low < after < high, first <= low and high <= last
        blocked = blocked or walls[wall, 1 - axis] < beside < walls[wall, 3 - axis] and (enters or crosses)
    return blocked


@kernel
def contain(walls, x, y):
    """Whether a point is inside a wall; the edge is outside."""
    inside = False
    for wall in range(walls.shape[0]):
        inside = inside or walls[wall, 0] < x < walls[wall, 2] and walls[wall, 1] < y < walls[wall, 3]
    return inside


def distance(walls: Sequence[Sequence[float]]) -> Any:
    """The kernel of an axis of border cells, which returns the distance to the nearest wall.

    The distance is 0 inside a wall; it is in the world's units of length, as are the ends of the axis.
    walls: one or more, as in `table`. Raises ValueError for anything else.

    >>> corner = ((0.0, 0.0, 0.1, 1.0), (0.0, 0.0, 1.0, 0.1))
    >>> border = Modality("border cell", [Axis(walls.distance(corner), high=0.5)])
    """
    return _distance(_some(walls))


def distance_along(walls: Sequence[Sequence[float]], x: float, y: float) -> Any:
    """The kernel of an axis of boundary-vector cells: the distance to the first wall in the direction (x, y).

    The distance is 0 inside a wall, and infinite if there is no wall in that direction; it is in the world's units of
    length, as are the ends of the axis. x, y: a vector of any length ≥ 10⁻³⁰, x to the east and y to the south.
    walls: one or more, as in `table`. Raises ValueError for anything else.

    >>> corner = ((0.0, 0.0, 0.1, 1.0), (0.0, 0.0, 1.0, 0.1))
    >>> axes = [Axis(walls.distance_along(corner, *push)) for push in ((-1, 0), (0, -1))]
    """
    x, y = checks.real("x", x), checks.real("y", y)
    largest = checks.positive("the length of (x, y)", max(abs(x), abs(y)))
    x, y = x / largest, y / largest
    length = math.sqrt(x * x + y * y)
    return _distance_along(_some(walls), x / length, y / length)


def _some(walls):
    walls = checked("walls", walls)
    if not walls:
        raise ValueError("walls must hold a wall or more, since there is no distance to none, but is empty")
    return walls


@kernel_maker
def _distance(walls):
    @kernel
    def wall_distance(scene, point):
        x, y, nearest = scene.position[0], scene.position[1], np.inf
        for left, top, right, bottom in walls:
            dx, dy = max(max(left - x, x - right), 0.0), max(max(top - y, y - bottom), 0.0)
            nearest = min(nearest, dx * dx + dy * dy)
        return math.sqrt(abs(nearest))

    return wall_distance


@kernel_maker
def _distance_along(walls, east, south):
    @kernel
    def wall_distance(scene, point):
        x, y, nearest = scene.position[0], scene.position[1], np.inf
        for left, top, right, bottom in walls:
            enters, leaves = clipped(0.0, nearest, left - x, right - x, east)
            enters, leaves = clipped(enters, leaves, top - y, bottom - y, south)
            if enters < leaves:
                nearest = enters
        return nearest

    return wall_distance


@kernel
def clipped(enters, leaves, low, high, push):
    """The part of a ray, from its distance `enters` to `leaves`, that lies between two coordinates along an axis."""
    if push == 0.0:
        return (enters if low < 0.0 < high else leaves), leaves
    at_low, at_high = low / push, high / push
    return max(enters, min(at_low, at_high)), min(leaves, max(at_low, at_high))
