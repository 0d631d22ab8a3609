"""How the values of a map learn from a change of cell (thesis 4.1.3 and 4.4).

All goals learn off-policy at every update, whether they are desired or not. A goal pays 1 when its cell is entered;
there is no other reward.

1. A change of cell drives the update (*inference inversion*, eq. 4.7 and 4.8): for each event that occurred in the cell
   just left, the values of all goals move towards γ max q of the cell entered, at the rate ψ(a) α. With an update after
   every step, and the action taken as its only event, this is *temporal difference* (eq. 4.6).
2. The value of an event that did not occur sinks, towards zero or away from the target.

`neorl.core.trace` is for the cells left before, `neorl.core.displacement` for maps whose state is the self. A value
below 1e-30 counts as zero, because arithmetic on subnormal numbers is slow.

In `notebooks/companion/one_file.py`, this is section 5; docstrings name its functions, as in “one file: `updated`”.
"""

from typing import NamedTuple

import numpy as np

from neorl.core.choices import Credit
from neorl.core.layout import OF_CREDIT
from neorl.kernels.annotations import array
from neorl.kernels.kernel import inlined_kernel, kernel

ZERO, UNIT, SMALLEST = np.float32(0.0), np.float32(1.0), np.float32(1e-30)  # single: a literal is a double
UNBOUNDED = np.float32(np.inf)
INACTIVE = np.float32(0.01)


class MapValues(NamedTuple):
    """The values of one map, and what is needed to learn them."""

    q: array("float32", "values")  # of this map and possibly others, see `Order`
    first: int  # where in q the map begins
    goals: int  # of each cell; 1 where the state is the self, so that a cell is itself a goal
    actions: int
    goal_range: array("int64", "cells", 2)  # for each cell, the range of goals whose values may differ from 0
    scratch: array("float32", "scratch")  # working memory: a number per goal or, with memory, per goal and action


class Order(NamedTuple):
    """The strides in q of successive states, goals and actions.

    An agent that bootstraps runs through all goals of an action, so its maps are q[state, action, goal]. One that does
    not runs through all actions for one goal in many states: its maps are q[goal, state, action].
    """

    # Unsigned: an index that may be negative costs numba two instructions more at every access.
    state: np.uint64
    goal: np.uint64
    action: np.uint64


class Rule(NamedTuple):
    """How values move towards their targets."""

    discount: np.float32
    terminal: bool
    absent_rate: np.float32  # −α ψ(0), the rate at which the values of an event that did not occur sink
    away: bool  # away from the target instead of towards zero


@inlined_kernel
def rule_of(learning):
    """The `Rule` of an agent."""
    return Rule(learning.discount, learning.terminal, learning.learning_rate * learning.absent_decay, learning.away)


@inlined_kernel
def rate_events(agent, memory, user, t):
    """α_a = ψ_a α of each event in the cell that a track leaves, 1 at most (thesis eq. 4.7; one file: `rates_of`)."""
    learning, steps = agent.learning, 0
    for event in range(agent.rates.shape[0] + 1):
        steps += memory.events[t, event]
    # ψ_a = n_a / Σ n, unless the rule of credit is another.
    for event in range(agent.rates.shape[0]):
        count = memory.events[t, event]
        credit = np.float32(count) / np.float32(steps)
        if learning.credit == Credit.happened:
            credit = UNIT if count > 0 else ZERO
        elif learning.credit == Credit.last:
            credit = UNIT if event == agent.last_event else ZERO
        elif learning.credit == Credit.count:
            credit = np.float32(count)
        elif learning.credit == Credit.activity:
            credit = agent.activity[event] if agent.activity[event] >= INACTIVE else ZERO
        elif learning.credit == Credit.own:
            credit = np.float32(user.credit(count, steps, event == agent.last_event, agent.activity[event]))
            if credit != credit:
                agent.faults[OF_CREDIT] = 1
            credit = credit if credit > ZERO else ZERO
        agent.rates[event] = min(learning.learning_rate * credit, UNIT)


@inlined_kernel
def values_of(agent, memory, nres):
    """The `MapValues` of a map."""
    goal_range = memory.goal_range[nres.first_cell : nres.end_cell]
    return MapValues(memory.q, nres.first_value, nres.goals, agent.rates.shape[0], goal_range, memory.scratch)


@inlined_kernel
def order_of(agent, nres):
    """The `Order` of a map's values."""
    goals, actions = np.uint64(nres.goals), np.uint64(agent.rates.shape[0])
    if agent.learning.bootstrap and goals > 1:
        return Order(actions * goals, np.uint64(1), goals)
    # A goal's values side by side: a memory learns a fine map in a third of the time.
    return Order(actions, actions * goals, np.uint64(1))


@inlined_kernel
def enter(memory, t, cell):
    """Let a track enter a cell, in which nothing has happened yet."""
    memory.tracks[t].cell = cell
    for event in range(memory.events.shape[1]):
        memory.events[t, event] = 0


@kernel
def learn_all_goals(values, rule, cell_tm1, cell_t, rates):
    """Q_i(s⁻, a) ← Q_i(s⁻, a) + α_a (R_i + γ max Q_i(s⁺, ·) − Q_i(s⁻, a)) for all goals i (eq. 4.8).

    R_i is 1 if i is s⁺, else 0. rates: α_a. One file: `bootstrapped`. Values outside goal_range are zero and remain so,
    which saves most of the work in fine maps.
    """
    q, cells, goal_range, target = values.q, values.goals, values.goal_range, values.scratch
    begin = min(min(goal_range[cell_tm1, 0], goal_range[cell_t, 0]), cell_t)
    end = max(max(goal_range[cell_tm1, 1], goal_range[cell_t, 1]), cell_t + 1)
    goal_range[cell_tm1, 0], goal_range[cell_tm1, 1] = begin, end
    count, last = end - begin, values.actions - 1
    row = values.first + cell_t * values.actions * cells + begin
    # target_i = γ max_a Q_i(s⁺, a), by four actions at a time, so that each is written once; the last stands for those
    # missing.
    for event in range(0, values.actions, 4):
        factor = UNIT if event + 4 <= last else rule.discount
        first, second = row + event * cells, row + min(event + 1, last) * cells
        third, fourth = row + min(event + 2, last) * cells, row + min(event + 3, last) * cells
        # Views, whose indices count from 0 and so need no test for being negative.
        one, two, three, four = (q[first : first + count], q[second : second + count], q[third : third + count],
                                 q[fourth : fourth + count])
        # The first four write the targets, which then need not be cleared before.
        if event == 0:
            for goal in range(count):
                target[goal] = factor * higher(higher(one[goal], two[goal]), higher(three[goal], four[goal]))
        else:
            for goal in range(count):
                best = higher(higher(one[goal], two[goal]), higher(three[goal], four[goal]))
                target[goal] = factor * higher(best, target[goal])
    # R_i is 1 for i = s⁺, and if goals are terminal, no value follows it.
    target[cell_t - begin] = UNIT if rule.terminal else UNIT + target[cell_t - begin]
    highest = UNIT if rule.terminal else UNIT / (UNIT - rule.discount)
    # Q_i(s⁻, a) += α_a (target_i − Q_i(s⁻, a)); of absent events −= rate (target_i − Q_i(s⁻, a)), or rate Q_i(s⁻, a).
    # A loop for each, which compiles to vector instructions.
    for event in range(values.actions):
        row = values.first + (cell_tm1 * values.actions + event) * cells + begin
        value = q[row : row + count]  # a view, as above
        occurred = rates[event] > ZERO
        if occurred or rule.away and rule.absent_rate > ZERO:
            rate, bound = (rates[event], UNBOUNDED) if occurred else (-rule.absent_rate, highest)
            for goal in range(count):
                value[goal] = stepped(value[goal], rate, target[goal], bound)
        elif rule.absent_rate > ZERO:
            for goal in range(count):
                new = value[goal] - rule.absent_rate * value[goal]
                value[goal] = new if new > SMALLEST else ZERO


@inlined_kernel
def higher(one, other):
    """The higher of two values, by comparison instead of max(), so that loops compile to vector instructions."""
    return one if one > other else other


@inlined_kernel
def stepped(value, rate, target, bound):
    """Q + α (target − Q), up to a bound (one file: `updated`)."""
    new = value + rate * (target - value)
    new = new if new < bound else bound
    return new if new > SMALLEST else ZERO


@kernel
def learn_one_goal(values, order, rule, cell_tm1, goal, rates):
    """Q_i(s⁻, a) ← Q_i(s⁻, a) + α_a (1 − Q_i(s⁻, a)) for the goal i = s⁺ alone; values of absent events sink."""
    widen(values.goal_range, cell_tm1, goal)
    for event in range(values.actions):
        index = place_of(values.first, order, cell_tm1, goal) + np.uint64(event) * order.action
        if rates[event] > ZERO:
            values.q[index] += rates[event] * (UNIT - values.q[index])
        elif rule.absent_rate > ZERO:
            values.q[index] = sunk(values.q[index], rule.absent_rate, UNIT, rule.away, UNIT)


@inlined_kernel
def place_of(first, order, cell, goal):
    """The index in q at which a cell's action values for a goal begin; unsigned, since it is never negative."""
    return np.uint64(first) + np.uint64(cell) * order.state + np.uint64(goal) * order.goal


@inlined_kernel
def widen(goal_range, cell, goal):
    """Widen the goal range of a cell to include a goal."""
    goal_range[cell, 0] = min(goal_range[cell, 0], goal)
    goal_range[cell, 1] = max(goal_range[cell, 1], goal + 1)


@kernel
def sunk(value, rate, target, away, highest):
    """The new value of an event that did not occur: closer to zero, or away from its target within 0 … `highest`."""
    # Q − rate · (target − Q), or Q − rate · Q.
    if away:
        value -= rate * (target - value)
        value = value if value < highest else highest
    else:
        value -= rate * value
    return value if value > SMALLEST else ZERO
