"""From where things are to the cells that are active.

A vector, in board widths or in board widths a second, becomes a point (u, v) of a modality's space (`tuned`), and a
point the one active cell of a map of that space (`cell_at`). A direction is in turns, from east by way of south.

`scene` is what the agent perceives of its world: its own position and velocity, and where things are.
"""

import math
from typing import NamedTuple

import numpy as np

from neorl.core.choices import Tuning, Vector
from neorl.core.kernel import inlined_kernel, kernel

TAU = 2.0 * math.pi
SQRT_3 = math.sqrt(3.0)
TAN_15_DEGREES = 2.0 - SQRT_3
TERMS = 14  # of the series of the arctangent, so that it is exact to the last few bits


class Tiles(NamedTuple):
    """How the two axes of a map are cut; v may be a direction, in turns."""

    columns: int
    rows: int
    low_u: float  # where the first column begins
    scale_u: float  # columns a unit
    low_v: float
    scale_v: float
    closed: bool  # whether the last row borders on the first


@kernel
def boundary_vector(wall, x, y):
    """From a place to the nearest point of the western, northern, eastern or southern wall (0 … 3): (x, y)."""
    if wall == 0:
        return -x, 0.0
    if wall == 1:
        return 0.0, -y
    if wall == 2:
        return 1.0 - x, 0.0
    return 0.0, 1.0 - y


@kernel
def tuned(tuning, x, y, reach_x, reach_y):
    """The two coordinates of a vector: length, and direction in turns, also if the cells are tuned to one of them."""
    if tuning == Tuning.proximal:
        return into_margin(x, reach_x), into_margin(y, reach_y)
    if tuning == Tuning.cartesian:
        return x, y
    return math.sqrt(x * x + y * y), turn(x, y)


@kernel
def into_margin(x, reach):
    """How far a component in 0 … 1 reaches into the margin along either wall, negative along the first."""
    if x < 0.5:
        return min(x - reach, 0.0)
    return max(x - (1.0 - reach), 0.0)


@kernel
def turn(x, y):
    """The direction of a vector in turns, 0 ≤ turn < 1: 0 along +x, a quarter along +y."""
    wide, high = abs(x), abs(y)
    longer = max(wide, high)
    if longer == 0.0:
        return 0.0
    # The arctangent of a slope in 0 … 1 by its series, which converges fast below tan 15°.
    slope, turned = min(wide, high) / longer, 0.0
    if slope > TAN_15_DEGREES:
        slope, turned = (slope * SQRT_3 - 1.0) / (slope + SQRT_3), 1.0 / 12.0
    series = 0.0
    for n in range(TERMS - 1, -1, -1):
        series = 1.0 / (2 * n + 1) - slope * slope * series
    turned += slope * series / TAU
    if high > wide:
        turned = 0.25 - turned
    if x < 0.0:
        turned = 0.5 - turned
    if y < 0.0:
        turned = 1.0 - turned
    return turned if turned < 1.0 else 0.0


@kernel
def tiling(resolution, tuning, low_0, high_0, low_1, high_1):
    """The `Tiles` of a map of N intervals an axis, with cells of that tuning, between those bounds."""
    columns = 1 if tuning == Tuning.angle else resolution
    rows = 1 if tuning == Tuning.length else resolution
    closed = tuning == Tuning.angle or tuning == Tuning.polar
    if closed:  # in turns, the first interval centred on east
        low_1 = -0.5 / resolution
        high_1 = 1.0 + low_1
    return Tiles(columns, rows, low_0, columns / (high_0 - low_0), low_1, rows / (high_1 - low_1), closed)


@kernel
def cell_at(u, v, tiles):
    """The cell of a point (u, v)."""
    column = np.floor((u - tiles.low_u) * tiles.scale_u)
    row = np.floor((v - tiles.low_v) * tiles.scale_v)
    if tiles.closed and row >= tiles.rows:
        row -= tiles.rows
    return clamp_index(row, tiles.rows) * tiles.columns + clamp_index(column, tiles.columns)


@inlined_kernel
def clamp_index(interval, count):
    """The nearest of the intervals 0 … count − 1; compared before it becomes an integer, which may not hold it."""
    if not interval > 0.0:
        return 0
    return count - 1 if interval > count - 1 else int(interval)


@inlined_kernel
def tiles_of(maps, m):
    """The `Tiles` of a map."""
    return Tiles(maps.columns[m], maps.rows[m], maps.low_u[m], maps.scale_u[m], maps.low_v[m], maps.scale_v[m],
                 maps.closed[m])


@inlined_kernel
def point_coordinates(parameters, scene, n, point):
    """The coordinates of a point that a node follows, a direction in turns."""
    nodes, width = parameters.nodes, parameters.width
    x, y = scene.agent_position[0] / width, scene.agent_position[1] / width
    if nodes.vector[n] == Vector.velocity:
        x, y = scene.agent_velocity[0] / width, scene.agent_velocity[1] / width
    elif nodes.vector[n] == Vector.objects:
        x, y = scene.creep_position[point, 0] / width - x, scene.creep_position[point, 1] / width - y
    elif nodes.vector[n] == Vector.boundaries:
        x, y = boundary_vector(point, x, y)
    elif nodes.vector[n] != Vector.position:
        landmark = nodes.first_landmark[n] + point
        x, y = nodes.landmark[landmark, 0] - x, nodes.landmark[landmark, 1] - y
    return place_coordinates(nodes, n, x, y)


@inlined_kernel
def place_coordinates(nodes, n, x, y):
    return tuned(nodes.tuning[n], x, y, nodes.high[n, 0], nodes.high[n, 1])


@inlined_kernel
def cell_of(maps, m, u, v):
    return cell_at(u, v, tiles_of(maps, m))


@inlined_kernel
def without_direction(maps, m, u):
    """Whether a map of directions is to place a vector of length 0."""
    return maps.closed[m] and u == 0.0


@inlined_kernel
def contact_cell(maps, m, cell):
    """Where a thing that is in a cell arrives when it meets the agent."""
    if maps.closed[m]:
        return cell - cell % maps.columns[m] + maps.contact[m] % maps.columns[m]
    return maps.contact[m]


@inlined_kernel
def moved_alone(parameters, state, scene, n, m, point):
    """Whether a thing's cell would have changed had the thing stood still in this step."""
    dx = (state.thing_position[point, 0] - scene.agent_position[0]) / parameters.width
    dy = (state.thing_position[point, 1] - scene.agent_position[1]) / parameters.width
    u, v = place_coordinates(parameters.nodes, n, dx, dy)
    return cell_of(parameters.maps, m, u, v) != state.tracks.cell[parameters.maps.first_track[m] + point]
