"""What of an agent's record follows from the rest: how maps cut axes, where their values are, the lists of desires.

In `notebooks/companion/one_file.py`, `Map` and `cut` do some of this. It is computed once for each agent, so Python
interprets these kernels; the browser has them compiled.
"""

import numpy as np

from neorl.core.choices import Cut, Feature, MapState, Source, Vector
from neorl.core.geometry import in_range, interval_at
from neorl.core.layout import ENTRIES, Memory, Record
from neorl.kernels.kernel import inlined_kernel, kernel

FADED, MOST_PASSED = np.float32(0.01), 500  # the strength below which a place passed is forgotten, and the most of them


@kernel
def derive(agent: Record, memory: Memory, n_things: int) -> None:
    """Fill in what is derived in the record, and the cuts and the goals in the memory."""
    cut, value, cell, t, trace, passed = 0, 0, 0, 0, 0, 0
    for n in range(agent.n_nodes):
        node = agent.nodes[n]
        node.points = points_of(node, n_things, agent.here.shape[0])
        of_self = node.state != MapState.object
        node.is_cartesian = True
        for i in range(node.axes):
            axis = agent.axes[node.first_axis + i]
            if (axis.vector != node.follows or axis.feature != Feature.component or axis.along != i
                    or axis.cut > Cut.centred):
                node.is_cartesian = False
        total = 0.0
        for m in range(node.first_map, node.end_map):
            nres = agent.maps[m]
            nres.first_cut = cut
            cut_axes(agent, memory, node, nres)
            nres.weight = 1.0
            for _ in range(node.weighting):
                nres.weight *= nres.resolution
            total += nres.weight
            nres.goals = ENTRIES if node.learns_contacts else 1 if of_self else nres.cells
            nres.events = 1 if node.learns_contacts and agent.contacts.after_states > 0 else agent.rates.shape[0]
            remembers = not node.learns_contacts and (of_self or agent.learning.memory_retained > 0)
            nres.passed = most_passed(agent.learning.memory_retained) if of_self else 0
            nres.first_value, nres.first_cell, nres.first_track = value, cell, t
            nres.first_trace, nres.first_passed = trace, passed
            cut += int(node.axes)
            value += nres.events * nres.cells * nres.goals
            cell += 0 if node.learns_contacts else nres.cells
            t += node.points
            trace += node.points * nres.cells if remembers else 0
            passed += node.points * nres.passed
            nres.end_value, nres.end_cell, nres.end_track = value, cell, t
            nres.end_trace, nres.end_passed = trace, passed
        for m in range(node.first_map, node.end_map):
            agent.maps[m].weight /= total
    list_desires(agent, memory)


@inlined_kernel
def points_of(node, n_things, axes):
    """The number of points that a node follows."""
    if node.state == MapState.self:
        return 1
    if node.follows == Vector.objects:
        return n_things
    if node.follows == Vector.boundaries:
        return 2 * axes
    return node.landmarks if node.follows == Vector.landmarks else 1


@kernel
def most_passed(retained):
    """The number of places passed that are remembered at a strength of 0.01 or more, at most MOST_PASSED."""
    count, strength = 1, retained
    while strength >= FADED and count < MOST_PASSED:
        count += 1
        strength *= retained
    return count


@inlined_kernel
def intervals_along(axis, resolution):
    """The number of intervals into which a map cuts an axis."""
    intervals = axis.intervals if axis.intervals > 0 else resolution
    return intervals + 1 if axis.cut == Cut.centred and intervals % 2 == 0 else intervals


@kernel
def cut_axes(agent, memory, node, nres):
    """Cut the axes of a node into the intervals of a map."""
    nres.cells = nres.placed = nres.followed = 1
    nres.contact = 0
    for i in range(node.axes):
        axis, cut = agent.axes[node.first_axis + i], memory.cuts[nres.first_cut + i]
        is_direction = axis.feature == Feature.direction and axis.vector != Vector.own
        intervals = intervals_along(axis, nres.resolution)
        low, high = axis.low, axis.high
        if is_direction:  # in turns, the first interval centred on 0
            low = -0.5 / intervals
            high = 1.0 + low
        elif axis.cut == Cut.boundaries:  # here the coordinate is the number of the interval
            low, high = 0.0, float(intervals)
        within = float(axis.intervals if axis.intervals > 0 else nres.resolution)
        cut.scale = within / (high - low)
        if intervals > within:  # half an interval more at either end
            low -= 0.5 / cut.scale
        cut.low, cut.last = low, intervals - 1.0
        cut.beyond = 0.0 if is_direction or axis.cut == Cut.closed else intervals - 1.0
        stride = nres.cells
        cut.stride = stride
        nres.cells *= intervals
        if axis.vector == node.follows:
            nres.followed = nres.cells
            if not is_direction:
                nres.placed = nres.cells
                nres.contact += stride * int(interval_at(cut, in_range(memory, axis, 0.0)))


@kernel
def list_desires(agent, memory):
    """List the desires of each node, and find the cells of those for a point."""
    for n in range(agent.n_nodes):
        agent.nodes[n].end_input = 0
        agent.nodes[n].receives = False
    for e in range(agent.n_desires):
        desire = agent.desires[e]
        node = agent.nodes[desire.target]
        node.end_input += 1
        node.receives = node.receives or desire.source == Source.node
        desire.worth, desire.worth_of = desire.valence, e
        for first in range(e if desire.learned else 0):
            if agent.desires[first].learned and agent.desires[first].kind == desire.kind:
                desire.worth_of = first
                break
        if desire.source == Source.point:
            for m in range(node.first_map, node.end_map):
                goal = 0
                for i in range(node.axes):
                    axis, cut = agent.axes[node.first_axis + i], memory.cuts[agent.maps[m].first_cut + i]
                    coordinate = in_range(memory, axis, memory.points[desire.first_coordinate + int(i)])
                    goal += int(cut.stride * interval_at(cut, coordinate))
                memory.goals[desire.first_goal + int(m - node.first_map)] = goal
    end = 0
    for n in range(agent.n_nodes):  # each list begins where the last one ends, and then, as it fills, ends
        node = agent.nodes[n]
        end += node.end_input
        node.first_input = node.end_input = end - node.end_input
    for e in range(agent.n_desires):
        node = agent.nodes[agent.desires[e].target]
        agent.inputs[node.end_input] = e
        node.end_input += 1


@kernel
def begin_values(agent: Record, memory: Memory) -> None:
    """Set the goal ranges to empty, and the approach of contacts to its first value, in a memory of zeros."""
    for m in range(agent.n_maps):
        nres = agent.maps[m]
        memory.goal_range[nres.first_cell : nres.end_cell, 0] = nres.cells
        memory.goal_range[nres.first_cell : nres.end_cell, 1] = 0
        if agent.nodes[nres.node].learns_contacts:
            memory.q[nres.first_value : nres.end_value : ENTRIES] = np.float32(agent.contacts.first_value)
