"""The life of an agent in WaterWorld, step by step: choose, act, perceive, learn.

1. The values of the actions come from desires through the network of nodes; the policy chooses among them.
2. The action is an event in the active cell of every track until that track has moved on.
3. A map learns all its goals from each track whose active cell changes (with driver "step", after every step).
4. A creep that is touched has met the agent: its tracks learn that, then follow the fresh creep as if it had always
   been there. After the last green creep the tank starts afresh. Neither leap is a transition to learn from.
5. At rest, or at distance 0, a track keeps the direction that it had.
"""

import numpy as np

from neorl.horde import N_EVENTS, UNIT, ZERO, learn_all_goals, learn_one_goal
from neorl.kernel import array, inlined_kernel, kernel
from neorl.modality import OBJECTS
from neorl.network import cell_of, contact_cell, evaluate, point_coordinates, without_direction
from neorl.plan import Memory, Plan
from neorl.stream import below, uniform
from neorl.waterworld import NO_OP, Rules, WaterWorldState, reset_board, step_board

DRIVER_STEP = 1
CREDIT_HAPPENED, CREDIT_LAST = 1, 2


@kernel
def live(plan: Plan, memory: Memory, rules: Rules, state: WaterWorldState, contacts: array("int8", "creeps"),
         first_step: int, last_step: int, bin_steps: int, rewards: array("float32", "bins"),
         hits: array("int16", "bins", 2)) -> float:
    """Live the steps first_step … last_step − 1, adding what they bring to the bins of `rewards` and `hits`.

    Returns the reward that they bring in all. contacts: working memory. hits: green and red creeps.
    """
    total = 0.0
    for step in range(first_step, last_step):
        action = choose(plan, memory, state)
        for track in range(memory.cell.shape[0]):
            memory.events[track, action] += 1
        memory.last_event[0] = action
        reward, done = step_board(state, rules, action, contacts)
        for n in range(plan.points.shape[0]):
            perceive(plan, memory, state, contacts, n)
        total += reward
        interval = step // bin_steps
        rewards[interval] += np.float32(reward)
        for creep in range(contacts.shape[0]):
            hits[interval, 0] += contacts[creep] == 1
            hits[interval, 1] += contacts[creep] == -1
        if done:
            reset_board(state, rules)
            settle(plan, memory, state)
    return total


@kernel
def settle(plan: Plan, memory: Memory, state: WaterWorldState) -> None:
    """Take the present cells as given, with nothing that led to them, and desires without a past."""
    for n in range(plan.points.shape[0]):
        for point in range(plan.points[n]):
            settle_point(plan, memory, state, n, point)
    for e in range(plan.source.shape[0]):
        memory.worth[e] = 0.0
        for action in range(N_EVENTS):
            memory.pull[e, action] = 0.0


@inlined_kernel
def settle_point(plan, memory, state, n, point):
    u, v = point_coordinates(plan, state, n, point)
    for m in range(plan.first_map[n], plan.first_map[n + 1]):
        appear(memory, plan.first_track[m] + point, cell_of(plan, m, u, v))


@inlined_kernel
def appear(memory, track, cell):
    """Begin a track in a cell."""
    enter(memory, track, cell)
    memory.trace_count[track] = 0


@inlined_kernel
def enter(memory, track, cell):
    memory.cell[track] = cell
    for event in range(N_EVENTS + 1):
        memory.events[track, event] = 0


@inlined_kernel
def choose(plan, memory, state):
    """The action of the behaviour policy."""
    if plan.exploration > 0.0 and uniform(memory.stream) < plan.exploration:
        return below(memory.stream, N_EVENTS)
    evaluate(plan, memory, state)
    value = memory.value
    best = max(max(value[0], value[1]), max(value[2], value[3]))
    if plan.idle_is_no_op and best == 0.0 and min(min(value[0], value[1]), min(value[2], value[3])) == 0.0:
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
def perceive(plan, memory, state, contacts, n):
    """Let every map of a node find its active cells, and learn if there is reason to."""
    for point in range(plan.points[n]):
        met = plan.vector[n] == OBJECTS and contacts[point] != 0
        u, v = point_coordinates(plan, state, n, point)
        for m in range(plan.first_map[n], plan.first_map[n + 1]):
            track = plan.first_track[m] + point
            cell_tm1, cell = memory.cell[track], cell_of(plan, m, u, v)
            cell_t = contact_cell(plan, m, cell_tm1) if met or without_direction(plan, m, u) else cell
            if cell_t != cell_tm1 or plan.driver == DRIVER_STEP:
                learn_transition(plan, memory, m, track, cell_tm1, cell_t)
                enter(memory, track, cell_t)
            if met:
                appear(memory, track, cell)


@inlined_kernel
def learn_transition(plan, memory, m, track, cell_tm1, cell_t):
    cells = plan.cells[m]
    known = memory.known[plan.first_cell[m] : plan.first_cell[m] + cells]
    slot = memory.trace_count[track] % plan.trace
    memory.trace_cell[track, slot] = cell_tm1
    rate_events(plan, memory, track, memory.trace_rates[track, slot])
    memory.trace_count[track] += 1
    if plan.bootstrap:
        learn_all_goals(memory.q, plan.first[m], cells, known, cell_tm1, cell_t, memory.trace_rates[track, slot],
                        plan.learning_rate * plan.absence, plan.discount, plan.terminal, memory.target)
    fading = UNIT
    for back in range(min(memory.trace_count[track], plan.trace)):
        if back > 0 or not plan.bootstrap:
            slot = (memory.trace_count[track] - 1 - back) % plan.trace
            learn_one_goal(memory.q, plan.first[m], cells, known, memory.trace_cell[track, slot], cell_t,
                           memory.trace_rates[track, slot], fading)
        fading *= plan.discount


@inlined_kernel
def rate_events(plan, memory, track, rates):
    """The rates α ψ of the events in the cell that a track leaves (thesis eq. 4.7)."""
    steps = 0
    for event in range(N_EVENTS + 1):
        steps += memory.events[track, event]
    for event in range(N_EVENTS):
        count = memory.events[track, event]
        credit = np.float32(count) / np.float32(steps)
        if plan.credit == CREDIT_HAPPENED:
            credit = UNIT if count > 0 else ZERO
        elif plan.credit == CREDIT_LAST:
            credit = UNIT if event == memory.last_event[0] else ZERO
        rates[event] = plan.learning_rate * credit
