"""The parameters of an agent, as flat arrays for the kernels: its maps, nodes, desires, learning and policy.

Maps are in the order of the agent's nodes. A *track* is one point that a map follows: the agent itself, or one of the
things that its modality represents. All tracks of a map share its values. Desires keep the agent's order. Derived
parameters are filled in by a kernel: once for each agent, so Python interprets it, and the browser needs no Python.

User-defined kernels are not included, see `neorl.core.constants`.
"""

from typing import NamedTuple

import numpy as np

from neorl.core.choices import Cut, Feature, MapState, Source, Vector
from neorl.core.geometry import (ALONG, BEYOND, CUT, FEATURE, INTERVALS, LAST, LOW, SCALE, STRIDE, VECTOR,
                                 AxisParameters, in_range, interval_at)
from neorl.core.calls import tabled
from neorl.core.kernel import array, inlined_kernel, kernel


FORGOTTEN = np.float32(1e-4)  # the strength below which a cell is no longer remembered
FADED, MOST_PASSED = np.float32(0.01), 500  # the same for a place that the self has passed, and the most of them
ENTRIES = 3  # values of an action in a cell of a map of contacts: `contacts.APPROACH`, `FEAR`, `VISITS`


class MapParameters(NamedTuple):
    """The maps of all nodes. `first_…` arrays have one more entry, for the end of the last map."""

    resolution: array("int64", "maps")
    # derived
    cells: array("int64", "maps")
    placed: array("int64", "maps")  # number of cells along the axes on which a contact determines the place
    goals: array("int64", "maps")  # that a cell has values for: all cells, or 1 if a cell is itself a goal
    contact: array("int64", "maps")  # the first cell at distance 0
    followed: array("int64", "maps")  # number of cells along the axes of the vector that the node follows
    weight: array("float64", "maps")
    first_grid: array("int64", "maps + 1")  # where in `grid` its axes begin
    first_value: array("int64", "maps + 1")  # where in q the map begins
    first_cell: array("int64", "maps + 1")  # number of cells in the maps before it
    first_track: array("int64", "maps + 1")
    first_trace: array("int64", "maps + 1")  # where its tracks' memory begins, which has room for all cells
    passed: array("int64", "maps")  # the most places that a track of the self remembers
    first_passed: array("int64", "maps + 1")  # where its tracks' passed places begin


class NodeParameters(NamedTuple):
    """The nodes. `first_…` arrays have one more entry, for the end of the last node."""

    follows: array("int64", "nodes")  # see `choices.Vector`: the one in which an element has a place
    state: array("int64", "nodes")  # see `choices.MapState`
    ends: array("bool", "nodes")  # whether no cell represents what lies beyond the range of its maps
    reach: array("float64", "nodes")  # half the side of the square around the self that counts as contact
    weighting: array("int64", "nodes")  # see `choices.Weighting`
    gain: array("float64", "nodes")
    first_map: array("int64", "nodes + 1")
    first_axis: array("int64", "nodes + 1")
    first_landmark: array("int64", "nodes + 1")
    order: array("int64", "nodes")  # nodes, each after those whose desires it receives
    landmark: array("float64", "landmarks", "axes")
    # derived
    points: array("int64", "nodes")  # number of points that it follows
    learns_contacts: array("bool", "nodes")  # see `neorl.core.contacts`
    mirrored: array("bool", "nodes")
    is_cartesian: array("bool", "nodes")  # whether its coordinates are the components of the vector it follows
    first_input: array("int64", "nodes + 1")  # where in `inputs` its desires begin
    inputs: array("int64", "desires")  # desires, node by node
    receives: array("bool", "nodes")  # whether any of them comes from a node


class DesireParameters(NamedTuple):
    """The desires."""

    source: array("int64", "desires")  # see `choices.Source`
    kind: array("int64", "desires")  # of the things that it is for
    target: array("int64", "desires")  # the node
    valence: array("float64", "desires")
    learned: array("bool", "desires")  # whether the valence is only the initial one
    sums_valence: array("bool", "desires")  # whether the valence is the sum of its elements' instead
    scale: array("float64", "desires")
    signed: array("bool", "desires")
    elements: array("bool", "desires", "desires")  # the desires of its source that its vector comes from
    at: array("float64", "desires", "coordinates")  # coordinates of a point, or position of a place
    # derived
    goal: array("int64", "desires", "maps")  # the cell of a point


class LearningParameters(NamedTuple):
    """How the Horde learns, see `neorl.agents.rules.Learning`."""

    learning_rate: np.float32
    discount: np.float32
    absent_decay: np.float32
    away: bool  # whether the value of an absent event sinks away from the target
    update_on: int  # see `choices.UpdateOn`
    credit: int  # see `choices.Credit`
    activity_retained: np.float32  # share of an event's activity that a step retains
    terminal: bool
    memory_retained: np.float32  # share that a change of cell retains; 0 without memory
    bootstrap: bool


class ContactParameters(NamedTuple):
    """How nodes whose only goals are contacts learn, see `neorl.agents.rules.Contacts`."""

    discount: float  # per step
    learning_rate: float
    familiarity: float
    first_value: float
    trace: int  # steps back over which a contact is credited
    trace_rate: float
    caution: float
    flees: bool
    rivals_add: bool


class PolicyParameters(NamedTuple):
    """How the agent chooses, see `neorl.agents.rules.Policy`."""

    exploration: float
    indifferent_is_no_op: bool
    is_greedy: bool  # the usual policy, which is compiled into the kernels instead of being called


@tabled
class SpaceParameters(NamedTuple):
    """The parameters of a modality without an agent: the part of `Parameters` that finds cells."""

    size: float
    maps: MapParameters
    grid: array("float64", "map_axes", 5)
    nodes: NodeParameters
    axes: AxisParameters


@tabled
class Parameters(NamedTuple):
    """The parameters of an agent for one world."""

    size: float  # of the world, in its own units of length
    own_cell_counts: bool
    shared_cell_counts_once: bool
    notices_resets: bool
    push: array("float64", "actions", "axes")  # of each action that is an event
    frames: array("int64", "frames", "actions")  # what each action becomes in each mirror image of the world
    maps: MapParameters
    grid: array("float64", "map_axes", 5)  # how each map cuts each axis of its node, see `geometry.LOW`
    nodes: NodeParameters
    axes: AxisParameters
    desires: DesireParameters
    learning: LearningParameters
    contacts: ContactParameters
    policy: PolicyParameters


@kernel
def derive(parameters: Parameters, n_things: int) -> None:
    """Fill in the derived parameters."""
    maps, nodes = parameters.maps, parameters.nodes
    for n in range(nodes.follows.shape[0]):
        points = 1
        if nodes.state[n] == MapState.self:
            points = 1
        elif nodes.follows[n] == Vector.objects:
            points = n_things
        elif nodes.follows[n] == Vector.boundaries:
            points = 2 * parameters.push.shape[1]
        elif nodes.follows[n] == Vector.landmarks:
            points = nodes.first_landmark[n + 1] - nodes.first_landmark[n]
        nodes.points[n] = points
        nodes.is_cartesian[n] = True
        for axis in range(nodes.first_axis[n], nodes.first_axis[n + 1]):
            what = parameters.axes.what[axis]
            if (what[VECTOR] != nodes.follows[n] or what[FEATURE] != Feature.component
                    or what[ALONG] != axis - nodes.first_axis[n] or what[CUT] > Cut.centred):
                nodes.is_cartesian[n] = False
        total = 0.0
        for m in range(nodes.first_map[n], nodes.first_map[n + 1]):
            cut_axes(parameters, n, m)
            cells = maps.cells[m]
            maps.weight[m] = 1.0
            for _ in range(nodes.weighting[n]):
                maps.weight[m] *= maps.resolution[m]
            total += maps.weight[m]
            of_self = nodes.state[n] != MapState.object
            maps.goals[m] = ENTRIES if nodes.learns_contacts[n] else 1 if of_self else cells
            maps.first_value[m + 1] = maps.first_value[m] + parameters.push.shape[0] * cells * maps.goals[m]
            maps.first_cell[m + 1] = maps.first_cell[m] + cells
            maps.first_track[m + 1] = maps.first_track[m] + points
            remembers = not nodes.learns_contacts[n] and (of_self or parameters.learning.memory_retained > 0)
            maps.first_trace[m + 1] = maps.first_trace[m] + (points * cells if remembers else 0)
            maps.passed[m] = most_passed(parameters.learning.memory_retained) if of_self else 0
            maps.first_passed[m + 1] = maps.first_passed[m] + points * maps.passed[m]
        for m in range(nodes.first_map[n], nodes.first_map[n + 1]):
            maps.weight[m] /= total
    find_inputs(parameters)


@kernel
def most_passed(retained):
    """The number of places passed that are remembered at a strength of 0.01 or more, at most MOST_PASSED."""
    count, strength = 1, retained
    while strength >= FADED and count < MOST_PASSED:
        count += 1
        strength *= retained
    return count


@kernel
def cut_axes(parameters: SpaceParameters, n: int, m: int) -> None:
    """Cut the axes of a node into the intervals of a map."""
    maps, grid, axes, nodes = parameters.maps, parameters.grid, parameters.axes, parameters.nodes
    g = maps.first_grid[m]
    maps.cells[m] = maps.placed[m] = maps.followed[m] = 1
    maps.contact[m] = 0
    for axis in range(nodes.first_axis[n], nodes.first_axis[n + 1]):
        is_direction = axes.what[axis, FEATURE] == Feature.direction and axes.what[axis, VECTOR] != Vector.own
        intervals = axes.what[axis, INTERVALS] if axes.what[axis, INTERVALS] > 0 else maps.resolution[m]
        low, high = axes.low[axis], axes.high[axis]
        if is_direction:  # in turns, the first interval centred on 0
            low = -0.5 / intervals
            high = 1.0 + low
        elif axes.what[axis, CUT] == Cut.boundaries:  # here the coordinate is the number of the interval
            low, high = 0.0, float(intervals)
        grid[g, SCALE] = intervals / (high - low)
        if axes.what[axis, CUT] == Cut.centred and intervals % 2 == 0:  # half an interval more at either end
            low -= 0.5 / grid[g, SCALE]
            intervals += 1
        grid[g, LOW], grid[g, LAST] = low, intervals - 1.0
        grid[g, BEYOND] = 0.0 if is_direction or axes.what[axis, CUT] == Cut.closed else intervals - 1.0
        grid[g, STRIDE] = maps.cells[m]
        maps.cells[m] *= intervals
        if axes.what[axis, VECTOR] == nodes.follows[n]:
            maps.followed[m] = maps.cells[m]
            if not is_direction:
                maps.placed[m] = maps.cells[m]
                maps.contact[m] += int(grid[g, STRIDE] * interval_in(axes, axis, grid[g], 0.0))
        g += 1
    maps.first_grid[m + 1] = g


@inlined_kernel
def interval_in(axes, axis, cut, coordinate):
    """The interval of a map that contains a coordinate along an axis."""
    return interval_at(cut, in_range(axes, axis, coordinate))


@kernel
def find_inputs(parameters):
    """List the desires of each node, and find the goals of those for a point."""
    nodes, desires, maps = parameters.nodes, parameters.desires, parameters.maps
    nodes.first_input[:] = 0
    nodes.receives[:] = False
    for e in range(desires.target.shape[0]):
        n, first_axis = desires.target[e], nodes.first_axis[desires.target[e]]
        nodes.first_input[n + 1] += 1
        nodes.receives[n] = nodes.receives[n] or desires.source[e] == Source.node
        for m in range(nodes.first_map[n], nodes.first_map[n + 1]):
            desires.goal[e, m] = 0
            for axis in range(nodes.first_axis[n + 1] - first_axis):
                cut = parameters.grid[maps.first_grid[m] + axis]
                interval = interval_in(parameters.axes, first_axis + axis, cut, desires.at[e, axis])
                desires.goal[e, m] += int(cut[STRIDE] * interval)
    end = 0
    for n in range(nodes.follows.shape[0]):  # where its list begins, and then, as it fills, ends
        end, nodes.first_input[n + 1] = end + nodes.first_input[n + 1], end
    for e in range(desires.target.shape[0]):
        nodes.inputs[nodes.first_input[desires.target[e] + 1]] = e
        nodes.first_input[desires.target[e] + 1] += 1
