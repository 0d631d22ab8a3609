"""From the positions of things to active cells.

A space is a list of axes. Along each, an agent perceives one number, the axis's *coordinate*: a *feature* of a *vector*
in units of the world's size (per second, for velocity); a direction is in turns, from the first axis of the world
towards the second. A map cuts each axis into intervals; those that contain the coordinates determine the one active
cell (`cell_of`). Without a direction, as at rest, the coordinate is NaN and the interval does not change.

A node *follows* one vector (`parameters.NodeParameters`): the agent's own, or that of each of several points. An
element of interest is *placed* along the axes of that vector, except that a contact leaves its direction unchanged;
along the axes of other vectors it is everywhere. Cells are numbered along the axes in this order.
"""

import math
from typing import NamedTuple

import numpy as np

from neorl.core.choices import Cut, Feature, Vector
from neorl.core.kernel import array, inlined_kernel, kernel
from neorl.core.scene import ABSENT

OF_AXIS, OF_CREDIT = range(2)  # faults
TAU = 2.0 * math.pi
SQRT_3 = math.sqrt(3.0)
TAN_15_DEGREES = 2.0 - SQRT_3
TERMS = 14  # of the series of the arctangent, exact to the last few bits
CIRCLE_TERMS = 9  # of the series of sine and cosine up to an eighth of a turn, likewise


# What defines an axis: `choices.Vector`; `choices.Feature`; the axis of the world that it runs along, or the number of
# a user-defined feature; `choices.Cut`; its own number of intervals, or 0 for the resolution of the map.
VECTOR, FEATURE, ALONG, CUT, INTERVALS = range(5)


class AxisParameters(NamedTuple):
    """The axes of the spaces of all nodes, one node after the other."""

    what: array("int64", "node_axes", 5)
    low: array("float64", "node_axes")
    high: array("float64", "node_axes")
    first_boundary: array("int64", "node_axes + 1")
    boundary: array("float64", "boundaries")  # between unequal intervals


# How a map cuts an axis: where the first interval begins; intervals per unit; the number of the last interval; that of
# the interval beyond the range (the last, or the first if the axis closes); and the step in cell number per interval.
LOW, SCALE, LAST, BEYOND, STRIDE = range(5)


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
def heading(turns):
    """The vector of length 1 in a direction given in turns, (x, y): the inverse of `turn`, for any finite number.

    It stands in for cosine and sine, whose last bits differ between platforms.
    """
    return circle(turns, CIRCLE_TERMS)


@kernel
def circle(turns, terms):
    """Cosine and sine of an angle in turns, by so many terms of their series."""
    quarters = np.floor(4.0 * (turns - np.floor(turns)) + 0.5)
    angle = TAU * (turns - np.floor(turns) - 0.25 * quarters)  # within an eighth of a turn from the nearest axis
    square, cosine, sine = angle * angle, 1.0, 1.0
    for n in range(terms - 1, -1, -1):
        cosine = 1.0 - square / ((2 * n + 1) * (2 * n + 2)) * cosine
        sine = 1.0 - square / ((2 * n + 2) * (2 * n + 3)) * sine
    sine *= angle
    if quarters == 1.0:
        return 0.0 - sine, cosine
    if quarters == 2.0:
        return -cosine, 0.0 - sine
    if quarters == 3.0:
        return sine, -cosine
    return cosine, sine


@inlined_kernel
def component(parameters, constants, scene, n, vector, point, axis):
    """One component of the vector of a point, along an axis of the world."""
    own = scene.position[axis] / parameters.size
    if vector == Vector.position:
        return own
    if vector == Vector.velocity:
        return scene.velocity[axis] / parameters.size
    if vector == Vector.objects:
        return scene.things[point, axis] / parameters.size - own
    if vector == Vector.landmarks:
        return parameters.nodes.landmark[parameters.nodes.first_landmark[n] + point, axis] - own
    if point % len(constants.axes) != axis:  # walls: first those where each axis begins, then where it ends
        return 0.0
    return -own if point < len(constants.axes) else 1.0 - own


@inlined_kernel
def locate(parameters, constants, scene, n, point, given, offset, coordinates, faults):
    """Write the coordinates of a point of a node into `coordinates`, NaN where there is no direction.

    given: whether `offset` takes the place of the perceived vector that the node follows. faults: see `state.State`.
    Returns whether that vector, and whether every vector, has a direction where one is needed.
    """
    axes, nodes = parameters.axes, parameters.nodes
    followed_has, all_have, follows, first = True, True, nodes.follows[n], nodes.first_axis[n]
    if nodes.is_cartesian[n]:
        for axis in range(np.uint64(nodes.first_axis[n + 1] - first)):
            coordinates[axis] = (offset[axis] if given else
                                 component(parameters, constants, scene, n, follows, point, axis))
        return True, True
    for axis in range(first, nodes.first_axis[n + 1]):
        vector, feature, along = axes.what[axis, VECTOR], axes.what[axis, FEATURE], axes.what[axis, ALONG]
        replaced = given and vector == follows
        if vector == Vector.own:
            coordinate = constants.feature(along, scene, point)
            if coordinate != coordinate:
                faults[OF_AXIS] = along + 1
        elif feature <= Feature.margin:
            coordinate = offset[along] if replaced else component(parameters, constants, scene, n, vector, point, along)
            if feature == Feature.foveated:
                root = math.sqrt(abs(coordinate))  # abs() avoids a library call for negative arguments
                coordinate = root if coordinate > 0.0 else -root
            elif feature == Feature.margin:
                reach = axes.high[axis]  # into the margin along either wall, negative along the first
                coordinate = min(coordinate - reach, 0.0) if coordinate < 0.5 else max(coordinate - (1.0 - reach), 0.0)
        else:
            coordinate, x, y = 0.0, 0.0, 0.0
            for each in range(len(constants.axes)):
                value = offset[each] if replaced else component(parameters, constants, scene, n, vector, point, each)
                coordinate += value * value
                x, y = value if each == 0 else x, value if each == 1 else y
            coordinate = math.sqrt(abs(coordinate))
            if feature == Feature.direction:
                has_direction = x != 0.0 or y != 0.0
                all_have = all_have and has_direction
                followed_has = followed_has and (has_direction or vector != follows)
                coordinate = turn(x, y) if has_direction else np.nan
        if axes.what[axis, CUT] > Cut.centred:
            coordinate = in_range(axes, axis, coordinate)
        coordinates[axis - first] = coordinate
    return followed_has, all_have


@inlined_kernel
def maps_of(nodes, n):
    """The numbers of the maps of a node; unsigned, since an index that may be negative costs more."""
    return range(np.uint64(nodes.first_map[n]), np.uint64(nodes.first_map[n + 1]))


@inlined_kernel
def cell_of(parameters, coordinates, n, m):
    """The cell of a point in a map of a node; a missing direction counts as 0."""
    cell, first = 0.0, np.uint64(parameters.maps.first_grid[m])  # an unsigned index cannot count from the end
    for axis in range(np.uint64(parameters.nodes.first_axis[n + 1] - parameters.nodes.first_axis[n])):
        cut = parameters.grid[first + axis]
        cell += cut[STRIDE] * interval_at(cut, coordinates[axis])
    return int(cell)


@inlined_kernel
def cell_within(parameters, coordinates, n, m):
    """The cell of a point in a map of a node, or ABSENT beyond the range of a node whose maps end there."""
    if parameters.nodes.ends[n]:
        for axis in range(np.uint64(parameters.nodes.first_axis[n]), np.uint64(parameters.nodes.first_axis[n + 1])):
            coordinate = coordinates[axis - np.uint64(parameters.nodes.first_axis[n])]
            is_open = parameters.axes.what[axis, CUT] <= Cut.centred and parameters.axes.what[
                axis, FEATURE] != Feature.direction
            if is_open and (coordinate < parameters.axes.low[axis] or coordinate > parameters.axes.high[axis]):
                return ABSENT
    return cell_of(parameters, coordinates, n, m)


@inlined_kernel
def interval_at(cut, coordinate):
    """The number of the interval that contains a coordinate, or of the one at the end of the range."""
    interval = np.floor((coordinate - cut[LOW]) * cut[SCALE])
    interval = interval if interval > 0.0 else 0.0
    return cut[BEYOND] if interval > cut[LAST] else interval


@kernel
def in_range(axes, axis, coordinate):
    """A coordinate wrapped into the range of an axis that closes; among boundaries, the number of its interval."""
    if coordinate != coordinate or axes.what[axis, CUT] <= Cut.centred:
        return coordinate
    if axes.what[axis, CUT] == Cut.closed:
        low, length = axes.low[axis], axes.high[axis] - axes.low[axis]
        return coordinate - length * np.floor((coordinate - low) / length)
    interval = 0.0
    for at in range(axes.first_boundary[axis], axes.first_boundary[axis + 1]):
        interval += coordinate >= axes.boundary[at]
    return interval


@kernel
def with_kept_directions(grid, g, coordinates, n_axes, cell, before):
    """A cell with the intervals of `before` along the axes without a direction. g: the row of the map's first axis."""
    kept = 0
    for axis in range(n_axes):
        stride, intervals = int(grid[g + axis, STRIDE]), int(grid[g + axis, LAST]) + 1
        kept += stride * ((cell if coordinates[axis] == coordinates[axis] else before) // stride % intervals)
    return kept


@inlined_kernel
def contact_cell(maps, m, cell):
    """The cell that a thing enters when it meets the agent: distance 0, in the same direction."""
    if maps.placed[m] == maps.cells[m]:
        return maps.contact[m]
    return cell - cell % maps.placed[m] + maps.contact[m]
