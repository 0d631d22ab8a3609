"""How a map learns whose state is the self, from where one's own motion leads (paper B, section 3; thesis 4.1.3).

1. The self is always in the centre, so there is one state and a value for every goal: q[goal, action].
2. A transition is that the self leaves the centre cell, and the map is centred on it anew: half a cell along an axis.
3. Remembered are the places where this happened. Each has led to the cell in which the self now is, as seen from there:
   that cell is the goal that is looked up, and all else is as in `neorl.core.learning`, except that a place is
   forgotten at a strength of 0.01.
4. By eq. 4.8, a goal is worth γ max q of the same place as seen from the new centre.

In `notebooks/companion/one_file.py`, this is `learn_motion` in section 5.
"""

import numpy as np

from neorl.core.choices import MapState
from neorl.core.functions import UserFunctions
from neorl.core.geometry import cell_within, component
from neorl.core.layout import Memory, Record
from neorl.core.learning import (SMALLEST, UNBOUNDED, UNIT, ZERO, enter, higher, order_of, rate_events, rule_of,
                                 stepped, sunk, values_of, widen)
from neorl.core.scene import ABSENT, Scene
from neorl.core.trace import forget_all, join, learn_remembered, trace_of
from neorl.kernels.kernel import inlined_kernel, kernel


@kernel
def observe_self(agent: Record, memory: Memory, scene: Scene, user: UserFunctions, n: int, point: int) -> None:
    """Follow the agent, or the agent as seen from a thing, and learn in every map whose centre it has left."""
    node = agent.nodes[n]
    starts = node.state == MapState.per_object and (scene.met[point] != 0 or scene.kinds[point] < 0)
    locate_self(agent, memory, scene, node, point)
    for m in range(node.first_map, node.end_map):
        nres = agent.maps[m]
        t = nres.first_track + point
        if starts or memory.tracks[t].cell < 0:
            start_self(agent, memory, nres, point, centre_cell(scene, node, nres, point))
        elif has_left_centre(agent, memory, nres, point):
            if agent.learns:
                cell = cell_within(agent, memory, node, nres, agent.offset)
                learn_displacement(agent, memory, user, node, nres, point, cell)
                enter(memory, t, nres.contact)
            else:
                start_self(agent, memory, nres, point, nres.contact)


@kernel
def begin_self(agent: Record, memory: Memory, scene: Scene, user: UserFunctions, n: int, point: int) -> None:
    """Start the tracks of the agent, or of the agent as seen from a thing, at its present place."""
    node = agent.nodes[n]
    locate_self(agent, memory, scene, node, point)
    for m in range(node.first_map, node.end_map):
        nres = agent.maps[m]
        start_self(agent, memory, nres, point, centre_cell(scene, node, nres, point))


@inlined_kernel
def locate_self(agent, memory, scene, node, point):
    """Write where the agent is, or where it is as seen from a thing, into agent.coordinates."""
    for axis in range(agent.here.shape[0]):
        if node.state == MapState.per_object:
            agent.coordinates[axis] = -component(agent, memory, scene, node, node.follows, point, axis)
        else:
            agent.coordinates[axis] = scene.position[axis] / agent.size


@inlined_kernel
def centre_cell(scene, node, nres, point):
    """The centre of a map, or no cell if it is of an absent thing."""
    absent = node.state == MapState.per_object and scene.kinds[point] < 0
    return ABSENT if absent else nres.contact


@inlined_kernel
def start_self(agent, memory, nres, point, cell):
    """Start the track of the self, at agent.coordinates, in a cell: the centre, or none."""
    t = nres.first_track + point
    enter(memory, t, cell)
    memory.tracks[t].passed = 0
    pass_by(agent, memory, nres, point)


@inlined_kernel
def learn_displacement(agent, memory, user, node, nres, point, reached):
    """Learn that the self has reached a cell as seen from the last centre, and centre the map on it."""
    rule, values, trace = rule_of(agent.learning), values_of(agent, memory, nres), trace_of(agent, memory, nres, point)
    rate_events(agent, memory, user, nres.first_track + point)
    if agent.learning.bootstrap and reached >= 0:
        learn_all_displacements(memory, values, rule, node, nres, reached, agent.rates)
    count = join_passed(agent, memory, trace, rule, node, nres, point)
    learn_remembered(values, order_of(agent, nres), rule, trace, count, 0)
    forget_all(trace, count)
    pass_by(agent, memory, nres, point)


@inlined_kernel
def join_passed(agent, memory, trace, rule, node, nres, point):
    """List where the self now is as seen from each place that it has passed, and return the number of such cells."""
    learning, passed = agent.learning, memory.tracks[nres.first_track + point].passed
    begin, size = passed_slots(nres, point), nres.passed
    newest, count = (passed - 1) % size, 0
    strength, worth = UNIT, UNIT
    for event in range(agent.rates.shape[0]):
        memory.passed_rates[begin + newest, event] = agent.rates[event]
    filled = min(passed, size)
    look_back(agent, memory, node, nres, begin, filled)
    # Of a place k changes of cell ago: Σ α_a += α_a (m / (1 + m))ᵏ, and Σ α_a γᵏ += α_a (γ m / (1 + m))ᵏ.
    for back in range(filled):
        # Unsigned, and around the ring without %, which would divide.
        slot = np.uint64(begin + (newest - back if back <= newest else newest - back + size))
        cell = memory.seen_from[slot]
        if cell >= 0.0 and (back > 0 or not learning.bootstrap):  # the last centre has learned by bootstrapping
            count = join(trace, count, int(cell), memory.passed_rates[slot], rule.absent_rate, strength, worth)
        strength *= learning.memory_retained
        worth *= learning.memory_retained * learning.discount
        worth = worth if worth > SMALLEST else ZERO
    return count


@kernel
def look_back(agent, memory, node, nres, begin, filled):
    """Write the cell of the self as seen from each place into memory.seen_from, or −∞ beyond the range."""
    # cell = Σ stride ⌊(here − passed_at − low) scale⌋ over axes, all places along one axis at a time.
    seen_from = memory.seen_from[begin : begin + filled]
    for i in range(filled):
        seen_from[i] = 0.0
    for along in range(node.axes):
        axis, cut = agent.axes[node.first_axis + along], memory.cuts[nres.first_cut + along]
        here = agent.coordinates[along]
        low, scale, last, beyond, stride = cut.low, cut.scale, cut.last, cut.beyond, cut.stride  # in registers
        least = axis.low if node.ends else -np.inf
        most = axis.high if node.ends else np.inf
        passed_at = memory.passed_at[begin : begin + filled, along]
        for i in range(filled):  # compiles to vector instructions
            offset = here - passed_at[i]
            interval = np.floor((offset - low) * scale)
            interval = interval if interval > 0.0 else 0.0
            seen = seen_from[i] + stride * (beyond if interval > last else interval)
            seen = seen if offset >= least else -np.inf
            seen_from[i] = seen if offset <= most else -np.inf


@inlined_kernel
def learn_all_displacements(memory, values, rule, node, nres, reached, rates):
    """One update of every goal of the self, which has reached a cell as seen from the last centre (eq. 4.8)."""
    q, actions, target = values.q, values.actions, values.scratch
    cells, shift, width = nres.cells, reached - nres.contact, int(memory.cuts[nres.first_cut].last) + 1
    across = reached % width - nres.contact % width  # along the first axis, whose cells follow each other
    # target_i = R_i + γ max_a q[i − shift, a]: i − shift is goal i as seen from the new centre, if it is in the map.
    for row in range(0, cells, width):
        inside = stays_inside(memory, node, nres, row, reached)
        for goal in range(row, row + width):
            target[goal] = ZERO
            if inside and 0 <= goal - row - across < width:
                for event in range(actions):
                    target[goal] = higher(q[values.first + (goal - shift) * actions + event], target[goal])
            target[goal] *= rule.discount
    target[reached] = UNIT if rule.terminal else UNIT + target[reached]
    highest = UNIT if rule.terminal else UNIT / (UNIT - rule.discount)
    # q[i, a] += α_a (target_i − q[i, a]), as in `learn_all_goals`.
    for goal in range(cells):
        widen(values.goal_range, goal, 0)
        for event in range(actions):
            index = values.first + goal * actions + event
            if rates[event] > ZERO:
                q[index] = stepped(q[index], rates[event], target[goal], UNBOUNDED)
            elif rule.absent_rate > ZERO:
                q[index] = sunk(q[index], rule.absent_rate, target[goal], rule.away, highest)


@inlined_kernel
def stays_inside(memory, node, nres, goal, centre):
    """Whether a goal is in the map, along all axes but the first, once the map is centred on another of its cells."""
    for axis in range(np.uint64(1), node.axes):  # unsigned: numba adds an int64 and a uint64 as doubles
        cut = memory.cuts[nres.first_cut + axis]
        stride, intervals = int(cut.stride), int(cut.last) + 1
        interval = goal // stride % intervals - centre // stride % intervals + nres.contact // stride % intervals
        if interval < 0 or interval >= intervals:
            return False
    return True


@inlined_kernel
def has_left_centre(agent, memory, nres, point):
    """Whether the self is half a cell or more from the centre, along an axis; its offset is then in agent.offset."""
    slot, far = passed_slots(nres, point) + (memory.tracks[nres.first_track + point].passed - 1) % nres.passed, False
    for axis in range(np.uint64(agent.here.shape[0])):  # unsigned, as above
        agent.offset[axis] = agent.coordinates[axis] - memory.passed_at[slot, axis]
        cells = agent.offset[axis] * memory.cuts[nres.first_cut + axis].scale
        far = far or cells >= 0.5 or cells <= -0.5
    return far


@inlined_kernel
def pass_by(agent, memory, nres, point):
    """Centre a map on the self at agent.coordinates: the newest of the places that its track has passed."""
    track = memory.tracks[nres.first_track + point]
    slot = passed_slots(nres, point) + track.passed % nres.passed
    for axis in range(agent.here.shape[0]):
        memory.passed_at[slot, axis] = agent.coordinates[axis]
    track.passed += 1


@inlined_kernel
def passed_slots(nres, point):
    """Where the ring buffer of the places that a track has passed begins."""
    return nres.first_passed + point * nres.passed
