"""How a map learns whose state is the self, from where one's own motion leads (paper B, section 3; thesis 4.1.3).

1. The self is always in the centre, so there is one state and a value for every goal: q[goal, action].
2. A transition is that the self leaves the centre cell, and the map is centred on it anew: half a cell along an axis.
3. Remembered are the places where this happened. Each has led to the cell in which the self now is, as seen from there:
   that cell is the goal that is looked up, and all else is as in `neorl.core.learning`, except that a place is
   forgotten at a strength of 0.01.
4. By eq. 4.8, a goal is worth γ max q of the same place as seen from the new centre.
"""

import numpy as np

from neorl.core.geometry import LAST, SCALE, STRIDE, interval_at
from neorl.core.kernel import inlined_kernel, kernel
from neorl.core.learning import (SMALLEST, UNBOUNDED, UNIT, ZERO, enter, forget_all, higher, join, learn_remembered,
                                 order_of, rate_events, rule_of, stepped, sunk, trace_of, values_of, widen)


@inlined_kernel
def start_self(parameters, constants, state, m, point, cell):
    """Start the track of the self, at state.coordinates, in a cell: the centre, or none."""
    track = np.uint64(parameters.maps.first_track[m] + point)
    enter(constants, state.tracks, track, cell)
    state.tracks.passed_count[track] = 0
    pass_by(parameters, state, m, point, track)


@inlined_kernel
def learn_displacement(parameters, constants, state, n, m, point, reached):
    """Learn that the self has reached a cell as seen from the last centre, and centre the map on it."""
    track = np.uint64(parameters.maps.first_track[m] + point)
    rule, values = rule_of(parameters.learning), values_of(parameters, state, m)
    trace, rates = trace_of(parameters, constants, state.tracks, m, point), state.rates
    rate_events(parameters.learning, constants, state, track, rates)
    if parameters.learning.bootstrap and reached >= 0:
        learn_all_displacements(parameters, values, rule, n, m, reached, rates)
    count = join_passed(parameters, state, trace, rule, n, m, point, rates)
    learn_remembered(values, order_of(parameters, m), rule, trace, count, 0)
    forget_all(trace, count)
    pass_by(parameters, state, m, point, track)


@inlined_kernel
def join_passed(parameters, state, trace, rule, n, m, point, rates):
    """List where the self now is as seen from each place that it has passed, and return the number of such cells."""
    learning, maps, tracks = parameters.learning, parameters.maps, state.tracks
    track, begin, size = np.uint64(maps.first_track[m] + point), passed_slots(parameters, m, point), maps.passed[m]
    newest, count = (tracks.passed_count[track] - 1) % size, 0
    strength, worth = UNIT, UNIT
    for event in range(rates.shape[0]):
        tracks.passed_rates[begin + newest, event] = rates[event]
    filled = min(tracks.passed_count[track], size)
    look_back(parameters, state, n, m, begin, filled)
    for back in range(filled):
        slot = np.uint64(begin + (newest - back if back <= newest else newest - back + size))
        cell = state.seen_from[slot]
        if cell >= 0.0 and (back > 0 or not learning.bootstrap):  # the last centre has learned by bootstrapping
            count = join(trace, count, int(cell), tracks.passed_rates[slot], rule.absent_rate, strength, worth)
        strength *= learning.memory_retained
        worth *= learning.memory_retained * learning.discount
        worth = worth if worth > SMALLEST else ZERO
    return count


@kernel
def look_back(parameters, state, n, m, begin, filled):
    """Write the cell of the self as seen from each place into state.seen_from, or −∞ beyond the range."""
    seen_from, ends = state.seen_from[begin : begin + filled], parameters.nodes.ends[n]
    for at in range(filled):
        seen_from[at] = 0.0
    for axis in range(np.uint64(state.tracks.passed_at.shape[1])):
        row, a = parameters.grid[np.uint64(parameters.maps.first_grid[m]) + axis], parameters.nodes.first_axis[n] + axis
        cut, here = (row[0], row[1], row[2], row[3], row[4]), state.coordinates[axis]  # in registers
        least = parameters.axes.low[a] if ends else -np.inf
        most = parameters.axes.high[a] if ends else np.inf
        passed_at = state.tracks.passed_at[begin : begin + filled, axis]
        for at in range(filled):  # compiles to vector instructions
            offset = here - passed_at[at]
            seen = seen_from[at] + cut[STRIDE] * interval_at(cut, offset)
            seen = seen if offset >= least else -np.inf
            seen_from[at] = seen if offset <= most else -np.inf


@inlined_kernel
def learn_all_displacements(parameters, values, rule, n, m, reached, rates):
    """One update of every goal of the self, which has reached a cell as seen from the last centre (eq. 4.8)."""
    q, actions, target, maps = values.q, values.actions, values.scratch, parameters.maps
    cells, shift, width = maps.cells[m], reached - maps.contact[m], int(parameters.grid[maps.first_grid[m], LAST]) + 1
    across = reached % width - maps.contact[m] % width  # along the first axis, whose cells follow each other
    for row in range(0, cells, width):
        inside = stays_inside(parameters, n, m, row, reached)
        for goal in range(row, row + width):
            target[goal] = ZERO
            if inside and 0 <= goal - row - across < width:
                for event in range(actions):
                    target[goal] = higher(q[values.first + (goal - shift) * actions + event], target[goal])
            target[goal] *= rule.discount
    target[reached] = UNIT if rule.terminal else UNIT + target[reached]
    highest = UNIT if rule.terminal else UNIT / (UNIT - rule.discount)
    for goal in range(cells):
        widen(values.goal_range, goal, 0)
        for event in range(actions):
            index = values.first + goal * actions + event
            if rates[event] > ZERO:
                q[index] = stepped(q[index], rates[event], target[goal], UNBOUNDED)
            elif rule.absent_rate > ZERO:
                q[index] = sunk(q[index], rule.absent_rate, target[goal], rule.away, highest)


@inlined_kernel
def stays_inside(parameters, n, m, goal, centre):
    """Whether a goal is in the map, along all axes but the first, once the map is centred on another of its cells."""
    first = parameters.maps.first_grid[m]
    for axis in range(1, parameters.nodes.first_axis[n + 1] - parameters.nodes.first_axis[n]):
        stride, intervals = int(parameters.grid[first + axis, STRIDE]), int(parameters.grid[first + axis, LAST]) + 1
        interval = (goal // stride % intervals - centre // stride % intervals
                    + parameters.maps.contact[m] // stride % intervals)
        if interval < 0 or interval >= intervals:
            return False
    return True


@inlined_kernel
def has_left_centre(parameters, state, m, point, track):
    """Whether the self is half a cell or more from the centre, along an axis; its offset is then in state.offset."""
    tracks, far = state.tracks, False
    slot = passed_slots(parameters, m, point) + (tracks.passed_count[track] - 1) % parameters.maps.passed[m]
    for axis in range(tracks.passed_at.shape[1]):
        state.offset[axis] = state.coordinates[axis] - tracks.passed_at[slot, axis]
        cells = state.offset[axis] * parameters.grid[np.uint64(parameters.maps.first_grid[m] + axis), SCALE]
        far = far or cells >= 0.5 or cells <= -0.5
    return far


@inlined_kernel
def pass_by(parameters, state, m, point, track):
    """Centre a map on the self at state.coordinates: the newest of the places that its track has passed."""
    tracks, count = state.tracks, state.tracks.passed_count[track]
    slot = passed_slots(parameters, m, point) + count % parameters.maps.passed[m]
    for axis in range(tracks.passed_at.shape[1]):
        tracks.passed_at[slot, axis] = state.coordinates[axis]
    tracks.passed_count[track] = count + 1


@inlined_kernel
def passed_slots(parameters, m, point):
    """Where the ring buffer of the places that a track has passed begins."""
    return parameters.maps.first_passed[m] + point * parameters.maps.passed[m]
