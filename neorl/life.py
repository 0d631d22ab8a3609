"""The life of an agent in WaterWorld, step by step: choose, act, perceive, learn.

1. The values of the actions are superposed over maps and elements of interest; the policy chooses among them.
2. The action is an event in the active cell of every map until the tank has moved on.
3. A map whose active cell changes learns all its goals (with driver "step" it learns after every step).
4. After the last green creep the tank starts afresh. The leap to the centre is no transition: nothing learns from it.
"""

import numpy as np

from neorl.horde import N_EVENTS, UNIT, ZERO, add_goal, learn_all_goals, learn_one_goal
from neorl.kernel import kernel
from neorl.nres import cell_at
from neorl.stream import below, uniform
from neorl.waterworld import NO_OP, reset_board, step_board

DRIVER_STEP = 1
CREDIT_HAPPENED, CREDIT_LAST = 1, 2


@kernel
def live(plan, memory, rules, state, contacts, first_step, last_step, bin_steps, rewards, hits):
    """Live the steps first_step … last_step − 1, adding what they bring to the bins of `rewards` and `hits`.

    Returns the reward that they bring in all.
    contacts: int8 (creeps,), working memory. rewards: float32 (bins,). hits: int16 (bins, 2), green and red creeps.
    """
    total = 0.0
    for step in range(first_step, last_step):
        action = choose(plan, memory, state)
        for m in range(memory.cell.shape[0]):
            memory.events[m, action] += 1
        memory.last_event[0] = action
        reward, done = step_board(state, rules, action, contacts)
        for m in range(memory.cell.shape[0]):
            perceive(plan, memory, state, m)
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
def settle(plan, memory, state):
    """Take the present cells as given, with nothing that led to them."""
    for m in range(memory.cell.shape[0]):
        memory.cell[m] = cell_of(plan, m, state.agent_position[0], state.agent_position[1])
        forget_events(memory, m)
        memory.trace_count[m] = 0


@kernel
def cell_of(plan, m, x, y):
    return cell_at(x - plan.low[m], y - plan.low[m], 0.0, plan.scale[m], plan.resolution[m])


@kernel
def forget_events(memory, m):
    for event in range(N_EVENTS + 1):
        memory.events[m, event] = 0


@kernel
def choose(plan, memory, state):
    """The action of the behaviour policy."""
    if plan.exploration > 0.0 and uniform(memory.stream) < plan.exploration:
        return below(memory.stream, N_EVENTS)
    superpose_all(plan, memory, state)
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


@kernel
def superpose_all(plan, memory, state):
    """The value of each action, summed over maps and over the creeps as elements of interest."""
    for action in range(N_EVENTS):
        memory.value[action] = 0.0
    for m in range(memory.cell.shape[0]):
        cell = memory.cell[m]
        cells = plan.resolution[m] * plan.resolution[m]
        for creep in range(state.creep_speed.shape[0]):
            goal = cell_of(plan, m, state.creep_position[creep, 0], state.creep_position[creep, 1])
            if goal != cell or plan.own_cell_counts:
                valence = plan.valence_green if state.creep_is_green[creep] else plan.valence_red
                add_goal(memory.q, plan.first[m], cells, cell, goal, plan.weight[m] * valence, memory.value)


@kernel
def perceive(plan, memory, state, m):
    """Let a map find its active cell, and learn if there is reason to."""
    cell_tm1 = memory.cell[m]
    cell_t = cell_of(plan, m, state.agent_position[0], state.agent_position[1])
    if cell_t != cell_tm1 or plan.driver == DRIVER_STEP:
        learn_transition(plan, memory, m, cell_tm1, cell_t)
        memory.cell[m] = cell_t
        forget_events(memory, m)


@kernel
def learn_transition(plan, memory, m, cell_tm1, cell_t):
    cells = plan.resolution[m] * plan.resolution[m]
    known = memory.known[plan.first_cell[m] : plan.first_cell[m] + cells]
    slot = memory.trace_count[m] % plan.trace
    memory.trace_cell[m, slot] = cell_tm1
    rate_events(plan, memory, m, memory.trace_rates[m, slot])
    memory.trace_count[m] += 1
    if plan.bootstrap:
        learn_all_goals(memory.q, plan.first[m], cells, known, cell_tm1, cell_t, memory.trace_rates[m, slot],
                        plan.learning_rate * plan.absence, plan.discount, plan.terminal, memory.target)
    fading = UNIT
    for back in range(min(memory.trace_count[m], plan.trace)):
        if back > 0 or not plan.bootstrap:
            slot = (memory.trace_count[m] - 1 - back) % plan.trace
            learn_one_goal(memory.q, plan.first[m], cells, known, memory.trace_cell[m, slot], cell_t,
                           memory.trace_rates[m, slot], fading)
        fading *= plan.discount


@kernel
def rate_events(plan, memory, m, rates):
    """The rates α ψ of the events in the cell that a map leaves (thesis eq. 4.7)."""
    steps = 0
    for event in range(N_EVENTS + 1):
        steps += memory.events[m, event]
    for event in range(N_EVENTS):
        count = memory.events[m, event]
        credit = np.float32(count) / np.float32(steps)
        if plan.credit == CREDIT_HAPPENED:
            credit = UNIT if count > 0 else ZERO
        elif plan.credit == CREDIT_LAST:
            credit = UNIT if event == memory.last_event[0] else ZERO
        rates[event] = plan.learning_rate * credit
