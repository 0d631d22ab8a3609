"""The life of an agent in WaterWorld, step by step: choose, act, perceive, learn.

1. The values of the actions come from desires through the network of nodes; the policy chooses among them.
2. The action is an event in the active cell of every track until that track has moved on.
3. A map learns all its goals from each track whose active cell changes (with update_on "step", after every step).
4. A creep that is touched has met the agent: its tracks learn that, then follow the fresh creep as if it had always
   been there. After the last green creep the tank starts afresh. Neither leap is a transition to learn from.
5. At rest, or at distance 0, a track keeps the direction that it had.
6. What a capture is, which changes of cell a thing's tracks learn from and which things have any are choices of
   `neorl.agents.agent.Learning`; a track that does not learn follows its point all the same.
"""

import numpy as np

from neorl.core.choices import Attention, Capture, Credit, UpdateOn
from neorl.core.horde import N_EVENTS, UNIT, ZERO, learn_all_goals, learn_one_goal
from neorl.core.kernel import inlined_kernel, kernel
from neorl.core.modality import OBJECTS
from neorl.core.network import cell_of, contact_cell, evaluate, place_coordinates, point_coordinates, without_direction
from neorl.core.stream import below, uniform
from neorl.core.traces import CUT, N_ROWS, fade, forget_all, join, learn_remembered

NO_OP = N_EVENTS  # the action that is no event
INACTIVE = np.float32(0.01)


@kernel
def settle(plan, memory, state):
    """Take the present cells as given, with nothing that led to them, and desires without a past."""
    for n in range(plan.points.shape[0]):
        for point in range(plan.points[n]):
            settle_point(plan, memory, state, n, point)
    for event in range(N_EVENTS):
        memory.activity[event] = ZERO
    attend(plan, memory, state)
    for e in range(plan.source.shape[0]):
        memory.worth[e] = 0.0
        for action in range(N_EVENTS):
            memory.pull[e, action] = 0.0


@inlined_kernel
def settle_point(plan, memory, state, n, point):
    u, v = point_coordinates(plan, state, n, point)
    for m in range(plan.first_map[n], plan.first_map[n + 1]):
        appear(plan, memory, m, point, cell_of(plan, m, u, v))


@inlined_kernel
def appear(plan, memory, m, point, cell):
    """Begin the track of a point in a cell."""
    track = plan.first_track[m] + point
    enter(memory, track, cell)
    memory.trace_count[track] = 0
    if plan.memory_fade > ZERO:
        begin, end = traces_of(plan, m, point)
        forget_all(memory.remembered[begin:end], memory.remembered_at[begin:end], memory.remembered_count[track])
        memory.remembered_count[track] = 0


@inlined_kernel
def enter(memory, track, cell):
    memory.cell[track] = cell
    for event in range(N_EVENTS + 1):
        memory.events[track, event] = 0


@inlined_kernel
def traces_of(plan, m, point):
    """Where what the track of a point remembers begins and ends."""
    begin = plan.first_trace[m] + point * plan.cells[m]
    return begin, begin + plan.cells[m]


@inlined_kernel
def attend(plan, memory, state):
    """See where the things are, and which of them is to be learned about."""
    if plan.own_causes:
        for thing in range(memory.seen.shape[0]):
            memory.seen[thing, 0] = state.creep_position[thing, 0]
            memory.seen[thing, 1] = state.creep_position[thing, 1]
    if plan.attention != Attention.each:
        nearest = np.inf
        for thing in range(memory.seen.shape[0]):
            dx = state.creep_position[thing, 0] - state.agent_position[0]
            dy = state.creep_position[thing, 1] - state.agent_position[1]
            distance = dx * dx + dy * dy
            if distance < nearest and (plan.attention != Attention.wanted or state.creep_is_green[thing]):
                nearest = distance
                memory.attended[0] = thing


@inlined_kernel
def choose(plan, memory, state):
    """The action of the behaviour policy."""
    if plan.exploration > 0.0 and uniform(memory.stream) < plan.exploration:
        return below(memory.stream, N_EVENTS)
    evaluate(plan, memory, state)
    value = memory.value
    best = max(max(value[0], value[1]), max(value[2], value[3]))
    if plan.indifferent_is_no_op and best == 0.0 and min(min(value[0], value[1]), min(value[2], value[3])) == 0.0:
        return NO_OP
    ties = 0
    for action in range(N_EVENTS):
        ties += value[action] == best
    skip = below(memory.stream, ties) if ties > 1 else 0
    action = 0
    while action < N_EVENTS - 1 and (value[action] != best or skip > 0):
        skip -= value[action] == best
        action += 1
    return action


@inlined_kernel
def act(plan, memory, action):
    """Note that an action was taken, as an event in the active cell of every track."""
    for track in range(memory.cell.shape[0]):
        memory.events[track, action] += 1
    memory.last_event[0] = action
    if plan.credit == Credit.activity:
        for event in range(N_EVENTS):
            memory.activity[event] *= plan.activity
            memory.activity[event] += UNIT - plan.activity if event == action else ZERO


@inlined_kernel
def perceive(plan, memory, state, contacts, n):
    """Let every map of a node find its active cells, and learn if there is reason to."""
    things = plan.vector[n] == OBJECTS
    for point in range(plan.points[n]):
        met = things and contacts[point] != 0
        attended = not things or plan.attention == Attention.each or memory.attended[0] == point
        u, v = point_coordinates(plan, state, n, point)
        for m in range(plan.first_map[n], plan.first_map[n + 1]):
            track = plan.first_track[m] + point
            cell_tm1, cell = memory.cell[track], cell_of(plan, m, u, v)
            arrives = met and plan.capture == Capture.contact
            cell_t = contact_cell(plan, m, cell_tm1) if arrives or without_direction(plan, m, u) else cell
            ends = not attended or met and plan.capture != Capture.leap
            if attended and (arrives or not ends) and (cell_t != cell_tm1 or plan.update_on == UpdateOn.step):
                caused = arrives or not (things and plan.own_causes) or moved_alone(plan, memory, state, n, m, point)
                learn_transition(plan, memory, m, point, cell_tm1, cell_t, caused)
                enter(memory, track, cell_t)
            if ends:
                appear(plan, memory, m, point, cell)


@inlined_kernel
def moved_alone(plan, memory, state, n, m, point):
    """Whether a thing's cell would have changed had the thing stood still in this step."""
    u, v = place_coordinates(plan, n, (memory.seen[point, 0] - state.agent_position[0]) / plan.width,
                             (memory.seen[point, 1] - state.agent_position[1]) / plan.width)
    return cell_of(plan, m, u, v) != memory.cell[plan.first_track[m] + point]


@inlined_kernel
def learn_transition(plan, memory, m, point, cell_tm1, cell_t, caused):
    """Learn from a change of cell; one that the agent has not caused only lets what is remembered fade."""
    track = plan.first_track[m] + point
    cells = plan.cells[m]
    known = memory.known[plan.first_cell[m] : plan.first_cell[m] + cells]
    decay = plan.learning_rate * plan.absent_decay
    begin, end = traces_of(plan, m, point)
    if plan.memory_fade > ZERO:
        memory.remembered_count[track] = fade(
            memory.remembered[begin:end], memory.remembered_at[begin:end], memory.remembered_count[track],
            memory.strength[begin:end], memory.trace_weight[N_ROWS * begin : N_ROWS * end],
            memory.trace_worth[N_ROWS * begin : N_ROWS * end], faded(plan, memory, track),
            plan.discount if plan.memory_discounts else UNIT)
    if not caused:
        return
    slot = memory.trace_count[track] % plan.trace
    memory.trace_cell[track, slot] = cell_tm1
    rate_events(plan, memory, track, memory.trace_rates[track, slot])
    memory.trace_count[track] += 1
    if plan.bootstrap:
        learn_all_goals(memory.q, plan.first[m], cells, known, cell_tm1, cell_t, memory.trace_rates[track, slot],
                        decay, plan.away, plan.discount, plan.terminal, memory.target)
    if plan.memory_fade > ZERO:
        for turn in range(2):
            if turn == plan.bootstrap:  # the cell just left joins late if it has learned already, by bootstrapping
                memory.remembered_count[track] = join(
                    memory.remembered[begin:end], memory.remembered_at[begin:end], memory.remembered_count[track],
                    memory.strength[begin:end], memory.trace_weight[N_ROWS * begin : N_ROWS * end],
                    memory.trace_worth[N_ROWS * begin : N_ROWS * end], cell_tm1, memory.trace_rates[track, slot], decay)
            else:
                learn_remembered(
                    memory.q, plan.first[m], known, memory.remembered[begin:end], memory.remembered_count[track],
                    memory.trace_weight[N_ROWS * begin : N_ROWS * end],
                    memory.trace_worth[N_ROWS * begin : N_ROWS * end], cell_t, plan.away, memory.target)
        return
    fading = UNIT
    for back in range(min(memory.trace_count[track], plan.trace)):
        if back > 0 or not plan.bootstrap:
            slot = (memory.trace_count[track] - 1 - back) % plan.trace
            learn_one_goal(memory.q, plan.first[m], cells, known, memory.trace_cell[track, slot], cell_t,
                           memory.trace_rates[track, slot], decay, plan.away, fading)
        fading *= plan.discount


@inlined_kernel
def faded(plan, memory, track):
    """By which factor what is remembered fades while a track leaves its cell."""
    factor = plan.memory_fade
    if plan.memory_by_time:
        steps = 0
        for event in range(N_EVENTS + 1):
            steps += memory.events[track, event]
        for _ in range(steps - 1):
            factor = factor * plan.memory_fade if factor > CUT else ZERO
    return factor


@inlined_kernel
def rate_events(plan, memory, track, rates):
    """The rates α ψ of the events in the cell that a track leaves (thesis eq. 4.7)."""
    steps = 0
    for event in range(N_EVENTS + 1):
        steps += memory.events[track, event]
    for event in range(N_EVENTS):
        count = memory.events[track, event]
        credit = np.float32(count) / np.float32(steps)
        if plan.credit == Credit.happened:
            credit = UNIT if count > 0 else ZERO
        elif plan.credit == Credit.last:
            credit = UNIT if event == memory.last_event[0] else ZERO
        elif plan.credit == Credit.count:
            credit = np.float32(count)
        elif plan.credit == Credit.activity:
            credit = memory.activity[event] if memory.activity[event] >= INACTIVE else ZERO
        rates[event] = min(plan.learning_rate * credit, UNIT)
