"""From the positions of things to active cells.

A space is a list of axes. Along each, an agent perceives one number, the axis's *coordinate*: a *feature* of a *vector*
in units of the world's size (per second, for velocity); a direction is in turns, from the first axis of the world
towards the second. A map cuts each axis into intervals; those that contain the coordinates determine the one active
cell (`cell_of`). Without a direction, as at rest, the coordinate is NaN and the interval does not change.

A node *follows* one vector (`neorl.core.layout.NODE`): the agent's own, or that of each of several points. An
element of interest is *placed* along the axes of that vector, except that a contact leaves its direction unchanged;
along the axes of other vectors it is everywhere. Cells are numbered along the axes in this order.

In `notebooks/companion/one_file.py`, this is section 1: `followed`, `coordinate`, and the methods of `Map`.
"""

import math

import numpy as np

from neorl.core.choices import Cut, Feature, Vector
from neorl.core.direction import turn
from neorl.core.layout import OF_AXIS
from neorl.core.scene import ABSENT
from neorl.kernels.kernel import inlined_kernel, kernel


@inlined_kernel
def component(agent, memory, scene, node, vector, point, axis):
    """One component of the vector of a point, along an axis of the world."""
    own = scene.position[axis] / agent.size + agent.ahead[axis]
    if vector == Vector.position:
        return own
    if vector == Vector.velocity:
        return scene.velocity[axis] / agent.size + agent.efferent[axis]
    if vector == Vector.objects:
        return scene.things[point, axis] / agent.size - own
    if vector == Vector.landmarks:
        return memory.landmark[node.first_landmark + point, axis] - own
    if point % agent.here.shape[0] != axis:  # walls: first those where each axis begins, then where it ends
        return 0.0
    return -own if point < agent.here.shape[0] else 1.0 - own


@inlined_kernel
def locate(agent, memory, scene, user, node, point, from_offset):
    """Write the coordinates of a point of a node into agent.coordinates, NaN where there is no direction.

    from_offset: whether agent.offset takes the place of the perceived vector that the node follows.
    Returns whether that vector, and whether every vector, has a direction where one is needed.
    """
    coordinates, offset = agent.coordinates, agent.offset
    followed_has, all_have = True, True
    # The usual case: the components themselves, without a look at features.
    if node.is_cartesian:
        for axis in range(node.axes):
            coordinates[axis] = (offset[axis] if from_offset else
                                 component(agent, memory, scene, node, node.follows, point, axis))
        return True, True
    for i in range(node.axes):
        axis = agent.axes[node.first_axis + i]
        replaced = from_offset and axis.vector == node.follows
        if axis.vector == Vector.own:
            coordinate = user.feature(axis.along, scene, point)
            if coordinate != coordinate:  # it is not a number
                agent.faults[OF_AXIS] = axis.along + 1
        elif axis.feature <= Feature.margin:
            coordinate = (offset[axis.along] - agent.ahead[axis.along] if replaced else
                          component(agent, memory, scene, node, axis.vector, point, axis.along))
            if axis.feature == Feature.foveated:
                root = math.sqrt(abs(coordinate))  # abs() avoids a library call for negative arguments
                coordinate = root if coordinate > 0.0 else -root
            elif axis.feature == Feature.margin:
                reach = axis.high  # into the margin along either wall, negative along the first
                coordinate = min(coordinate - reach, 0.0) if coordinate < 0.5 else max(coordinate - (1.0 - reach), 0.0)
        else:
            coordinate, x, y = 0.0, 0.0, 0.0
            for along in range(agent.here.shape[0]):
                value = (offset[along] - agent.ahead[along] if replaced else
                         component(agent, memory, scene, node, axis.vector, point, along))
                coordinate += value * value
                x, y = value if along == 0 else x, value if along == 1 else y
            coordinate = math.sqrt(abs(coordinate))
            if axis.feature == Feature.direction:
                has_direction = x != 0.0 or y != 0.0
                all_have = all_have and has_direction
                followed_has = followed_has and (has_direction or axis.vector != node.follows)
                coordinate = turn(x, y) if has_direction else np.nan
        if axis.cut > Cut.centred:
            coordinate = in_range(memory, axis, coordinate)
        coordinates[i] = coordinate
    return followed_has, all_have


@inlined_kernel
def cell_of(memory, node, nres, coordinates):
    """Σ stride · interval over the axes: the cell of a point in a map; a missing direction counts as 0."""
    cell = 0.0  # a double, as strides and intervals are, so that only the sum is converted
    for axis in range(node.axes):
        cut = memory.cuts[nres.first_cut + axis]
        cell += cut.stride * interval_at(cut, coordinates[axis])
    return int(cell)


@inlined_kernel
def cell_within(agent, memory, node, nres, coordinates):
    """The cell of a point in a map of a node, or ABSENT beyond the range of a node whose maps end there."""
    if node.ends:
        for i in range(node.axes):
            axis = agent.axes[node.first_axis + i]
            is_open = axis.cut <= Cut.centred and axis.feature != Feature.direction
            if is_open and (coordinates[i] < axis.low or coordinates[i] > axis.high):
                return ABSENT
    return cell_of(memory, node, nres, coordinates)


@inlined_kernel
def interval_at(cut, coordinate):
    """⌊(x − low) · scale⌋, the interval that contains a coordinate, or the one at the end of the range."""
    interval = np.floor((coordinate - cut.low) * cut.scale)
    interval = interval if interval > 0.0 else 0.0  # also for a missing direction, NaN
    return cut.beyond if interval > cut.last else interval


@kernel
def in_range(memory, axis, coordinate):
    """A coordinate wrapped into the range of an axis that closes; among boundaries, the number of its interval."""
    if coordinate != coordinate or axis.cut <= Cut.centred:
        return coordinate
    if axis.cut == Cut.closed:
        length = axis.high - axis.low
        return coordinate - length * np.floor((coordinate - axis.low) / length)
    interval = 0.0
    for i in range(axis.first_boundary, axis.end_boundary):
        interval += coordinate >= memory.boundary[i]
    return interval


@kernel
def with_kept_directions(memory, node, nres, coordinates, cell, before):
    """A cell with the intervals of the cell `before` along the axes without a direction."""
    kept = 0
    for axis in range(node.axes):
        cut = memory.cuts[nres.first_cut + axis]
        stride, intervals = int(cut.stride), int(cut.last) + 1
        kept += stride * ((cell if coordinates[axis] == coordinates[axis] else before) // stride % intervals)
    return kept


@inlined_kernel
def contact_cell(nres, cell):
    """The cell that a thing enters when it meets the agent: distance 0, in the same direction."""
    if nres.placed == nres.cells:
        return nres.contact
    return cell - cell % nres.placed + nres.contact
