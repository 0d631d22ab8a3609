"""How the values of a map learn from tracks that change cells (thesis 4.1.3 and 4.4).

All goals learn off-policy at every update, whether they are desired or not. A goal pays 1 when its cell is entered;
there is no other reward.

1. A track's change of cell drives the update (*inference inversion*, eq. 4.7 and 4.8): for each event that occurred in
   the cell just left, the values of all goals move towards γ max q of the cell entered, at the rate ψ(a) α. With an
   update after every step, and the action taken as its only event, this is *temporal difference* (eq. 4.6).
2. The cells that a track remembers, by a leaky integrator, learn that they led to the cell entered. A cell joins the
   memory when it is left: each event adds its rate to a weight of its own, one for having occurred there and one, by
   ψ(0), for having been absent. At every change of cell the weights fade, and the worth of a goal to them by γ. The
   value of each remembered event for the cell entered moves towards that worth, at its weight or at 1, whichever is
   less. A cell is forgotten when its strength, which grows by 1 each time it is left, has faded below 1e-4.
3. The value of an event that did not occur sinks, towards zero or away from the target.

`neorl.core.displacement` does the same for maps whose state is the self. A value below 1e-30 counts as zero, because
arithmetic on subnormal numbers is slow.
"""

from typing import NamedTuple

import numpy as np

from neorl.core.choices import Credit
from neorl.core.geometry import OF_CREDIT
from neorl.core.kernel import array, inlined_kernel, kernel
from neorl.core.parameters import FORGOTTEN

ZERO, UNIT, SMALLEST = np.float32(0.0), np.float32(1.0), np.float32(1e-30)
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

    state: np.uint64
    goal: np.uint64
    action: np.uint64


class Rule(NamedTuple):
    """How values move towards their targets."""

    discount: np.float32
    terminal: bool
    absent_rate: np.float32  # −α ψ(0), the rate at which the values of an event that did not occur sink
    away: bool  # away from the target instead of towards zero


class Trace(NamedTuple):
    """The memory of one track.

    The list `cells` is unordered. Weights and worths have a number for each place in it and each event, first all those
    of events that occurred, then all those of absent events.
    """

    cells: array("int64", "cells")  # a list of the cells remembered
    places: array("int64", "cells")  # the place in the list of each cell of the map, plus one; 0 if it is not in it
    strength: array("float32", "cells")  # by place in the list
    weight: array("float32", "trace_weights")
    goal_worth: array("float32", "trace_weights")  # weight times the worth of a goal
    actions: tuple  # their numbers, see `neorl.core.constants.Constants`


@inlined_kernel
def learn_transition(parameters, constants, state, m, point, cell_t):
    """Learn from a track's change of cell."""
    learning, tracks = parameters.learning, state.tracks
    track = np.uint64(parameters.maps.first_track[m] + point)
    cell_tm1 = tracks.cell[track]
    rule, values, order = rule_of(learning), values_of(parameters, state, m), order_of(parameters, m)
    trace, rates = trace_of(parameters, constants, tracks, m, point), state.rates
    rate_events(learning, constants, state, track, rates)
    if learning.bootstrap:
        learn_all_goals(values, rule, cell_tm1, cell_t, rates)
    if learning.memory_retained > ZERO:
        tracks.remembered_count[track] = fade(trace, tracks.remembered_count[track], learning.memory_retained,
                                              learning.discount)
        for turn in range(2):
            if turn == learning.bootstrap:  # a cell that has already learned by bootstrapping joins afterwards
                tracks.remembered_count[track] = join(trace, tracks.remembered_count[track], cell_tm1, rates,
                                                      rule.absent_rate, UNIT, UNIT)
            else:
                learn_remembered(values, order, rule, trace, tracks.remembered_count[track], cell_t)
    elif not learning.bootstrap:
        learn_one_goal(values, order, rule, cell_tm1, cell_t, rates)


@inlined_kernel
def rule_of(learning):
    """The `Rule` of an agent."""
    return Rule(learning.discount, learning.terminal, learning.learning_rate * learning.absent_decay, learning.away)


@inlined_kernel
def rate_events(learning, constants, state, track, rates):
    """The rates α ψ of the events in the cell that a track leaves (thesis eq. 4.7)."""
    steps = 0
    for event in range(len(constants.actions) + 1):
        steps += state.tracks.events[track, event]
    for event in range(len(constants.actions)):
        count = state.tracks.events[track, event]
        credit = np.float32(count) / np.float32(steps)
        if learning.credit == Credit.happened:
            credit = UNIT if count > 0 else ZERO
        elif learning.credit == Credit.last:
            credit = UNIT if event == state.last_event[0] else ZERO
        elif learning.credit == Credit.count:
            credit = np.float32(count)
        elif learning.credit == Credit.activity:
            credit = state.activity[event] if state.activity[event] >= INACTIVE else ZERO
        elif learning.credit == Credit.own:
            credit = np.float32(constants.credit(count, steps, event == state.last_event[0], state.activity[event]))
            if credit != credit:
                state.faults[OF_CREDIT] = 1
            credit = credit if credit > ZERO else ZERO
        rates[event] = min(learning.learning_rate * credit, UNIT)


@inlined_kernel
def values_of(parameters, state, m):
    """The `MapValues` of a map."""
    maps = parameters.maps
    begin, end = maps.first_cell[m], maps.first_cell[m + 1]
    return MapValues(state.values.q, maps.first_value[m], maps.goals[m], parameters.push.shape[0],
                     state.values.goal_range[begin:end], state.values.scratch)


@inlined_kernel
def order_of(parameters, m):
    """The `Order` of a map's values."""
    goals, actions = np.uint64(parameters.maps.goals[m]), np.uint64(parameters.push.shape[0])
    if parameters.learning.bootstrap and goals > 1:
        return Order(actions * goals, np.uint64(1), goals)
    return Order(actions, actions * goals, np.uint64(1))


@inlined_kernel
def trace_of(parameters, constants, tracks, m, point):
    """The `Trace` of a track."""
    maps, actions = parameters.maps, len(constants.actions)
    begin = maps.first_trace[m] + point * maps.cells[m]
    end = begin + maps.cells[m]
    first, last = 2 * actions * begin, 2 * actions * end
    return Trace(tracks.remembered[begin:end], tracks.remembered_at[begin:end], tracks.strength[begin:end],
                 tracks.trace_weight[first:last], tracks.trace_worth[first:last], constants.actions)


@inlined_kernel
def start_track(parameters, constants, tracks, m, point, cell):
    """Start the track of a point in a cell, without a memory."""
    track = np.uint64(parameters.maps.first_track[m] + point)
    enter(constants, tracks, track, cell)
    if tracks.remembered_count[track] > 0:
        forget_all(trace_of(parameters, constants, tracks, m, point), tracks.remembered_count[track])
        tracks.remembered_count[track] = 0


@inlined_kernel
def enter(constants, tracks, track, cell):
    tracks.cell[track] = cell
    for event in range(len(constants.actions) + 1):
        tracks.events[track, event] = 0


@kernel
def learn_all_goals(values, rule, cell_tm1, cell_t, rates):
    """One update of every goal of a map. rates: α ψ for each event.

    All values outside goal_range are zero and remain so, which saves most of the work in fine maps.
    """
    q, cells, goal_range, target = values.q, values.goals, values.goal_range, values.scratch
    begin = min(min(goal_range[cell_tm1, 0], goal_range[cell_t, 0]), cell_t)
    end = max(max(goal_range[cell_tm1, 1], goal_range[cell_t, 1]), cell_t + 1)
    goal_range[cell_tm1, 0], goal_range[cell_tm1, 1] = begin, end
    count, last = end - begin, values.actions - 1
    row = values.first + cell_t * values.actions * cells + begin
    for event in range(0, values.actions, 4):  # four actions at a time; the last is repeated if there are fewer
        factor = UNIT if event + 4 <= last else rule.discount
        first, second = row + event * cells, row + min(event + 1, last) * cells
        third, fourth = row + min(event + 2, last) * cells, row + min(event + 3, last) * cells
        one, two, three, four = (q[first : first + count], q[second : second + count], q[third : third + count],
                                 q[fourth : fourth + count])
        if event == 0:
            for goal in range(count):
                target[goal] = factor * higher(higher(one[goal], two[goal]), higher(three[goal], four[goal]))
        else:
            for goal in range(count):
                best = higher(higher(one[goal], two[goal]), higher(three[goal], four[goal]))
                target[goal] = factor * higher(best, target[goal])
    target[cell_t - begin] = UNIT if rule.terminal else UNIT + target[cell_t - begin]
    highest = UNIT if rule.terminal else UNIT / (UNIT - rule.discount)
    for event in range(values.actions):
        row = values.first + (cell_tm1 * values.actions + event) * cells + begin
        value = q[row : row + count]
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
    """A value after a step towards its target, up to a bound."""
    new = value + rate * (target - value)
    new = new if new < bound else bound
    return new if new > SMALLEST else ZERO


@kernel
def learn_one_goal(values, order, rule, cell_tm1, goal, rates):
    """Move each event's value for one goal towards 1, at `rates`; those of absent events sink."""
    widen(values.goal_range, cell_tm1, goal)
    for event in range(values.actions):
        index = place_of(values, order, cell_tm1, goal) + np.uint64(event) * order.action
        if rates[event] > ZERO:
            values.q[index] += rates[event] * (UNIT - values.q[index])
        elif rule.absent_rate > ZERO:
            values.q[index] = sunk(values.q[index], rule.absent_rate, UNIT, rule.away, UNIT)


@inlined_kernel
def place_of(values, order, cell, goal):
    """The index in q at which a cell's action values for a goal begin; unsigned, since it is never negative."""
    return np.uint64(values.first) + np.uint64(cell) * order.state + np.uint64(goal) * order.goal


@inlined_kernel
def widen(goal_range, cell, goal):
    """Widen the goal range of a cell to include a goal."""
    goal_range[cell, 0] = min(goal_range[cell, 0], goal)
    goal_range[cell, 1] = max(goal_range[cell, 1], goal + 1)


@kernel
def sunk(value, rate, target, away, highest):
    """The new value of an event that did not occur: closer to zero, or away from its target within 0 … `highest`."""
    if away:
        value -= rate * (target - value)
        value = value if value < highest else highest
    else:
        value -= rate * value
    return value if value > SMALLEST else ZERO


@kernel
def fade(trace, count, retained, discount):
    """Let the memory fade to the share `retained`, and return how many cells are still remembered."""
    for i in range(count):
        trace.strength[i] *= retained
    size, half = count * len(trace.actions), trace.cells.shape[0] * len(trace.actions)
    for begin in range(0, 2 * half, half):
        weights, worths = trace.weight[begin : begin + size], trace.goal_worth[begin : begin + size]
        for i in range(size):
            weights[i] *= retained
            reached = worths[i] * retained * discount
            worths[i] = reached if reached > SMALLEST else ZERO
    i = 0
    while i < count:
        if trace.strength[i] < FORGOTTEN:
            count -= 1
            forget(trace, i, count)
        else:
            i += 1
    return count


@kernel
def forget(trace, i, last):
    """Forget a cell: replace it by the last of the list."""
    cells, actions = trace.cells, len(trace.actions)
    trace.places[cells[last]] = i + 1
    trace.places[cells[i]] = 0
    cells[i], trace.strength[i] = cells[last], trace.strength[last]
    for begin in range(0, 2 * cells.shape[0] * actions, cells.shape[0] * actions):
        for event in range(actions):
            into, of = np.uint64(begin + i * actions + event), np.uint64(begin + last * actions + event)
            trace.weight[into], trace.goal_worth[into] = trace.weight[of], trace.goal_worth[of]


@kernel
def forget_all(trace, count):
    """Remove all cells from the list."""
    for i in range(count):
        trace.places[trace.cells[i]] = 0


@kernel
def join(trace, count, cell, rates, absent_rate, strength, worth):
    """Add a cell to the memory, at a strength and a worth of the goal, and return how many cells are remembered."""
    actions, half = len(trace.actions), trace.cells.shape[0] * len(trace.actions)
    i = trace.places[cell] - 1
    if i < 0:
        i = count
        count += 1
        trace.cells[i], trace.places[cell], trace.strength[i] = cell, count, ZERO
        for begin in range(i * actions, i * actions + 2 * half, half):
            for at in range(begin, begin + actions):
                trace.weight[at] = trace.goal_worth[at] = ZERO
    trace.strength[i] += strength
    for event in range(actions):
        absent = rates[event] == ZERO
        at = i * actions + event + absent * half
        rate = absent_rate if absent else rates[event]
        trace.weight[at] += strength * rate
        trace.goal_worth[at] += worth * rate
    return count


@kernel
def learn_remembered(values, order, rule, trace, count, goal):
    """Learn, in all remembered cells, that they led to the goal.

    All values are read before any is used: those of a fine map are not in the cache, and the processor can then wait
    for many at a time.
    """
    cells, actions, read = trace.cells, len(trace.actions), values.scratch
    for i in range(count):
        widen(values.goal_range, np.uint64(cells[i]), goal)
    for i in range(count):
        place = place_of(values, order, cells[i], goal)
        for event in range(actions):
            read[np.uint64(i * actions + event)] = values.q[place + np.uint64(event) * order.action]
    size, half = count * actions, cells.shape[0] * actions
    move(read, size, trace.weight[:size], trace.goal_worth[:size], trace.weight[half : half + size],
         trace.goal_worth[half : half + size], rule.away)
    for i in range(count):
        place = place_of(values, order, cells[i], goal)
        for event in range(actions):
            values.q[place + np.uint64(event) * order.action] = read[np.uint64(i * actions + event)]


@kernel
def move(values, count, happened, reached, absent, missed, away):
    """Move values towards the worth of the goal for events that occurred, and let those of absent events sink."""
    for i in range(count):
        value = values[i]
        weight = happened[i] if happened[i] > ZERO else UNIT
        raised = value + (weight if weight < UNIT else UNIT) * (reached[i] / weight - value)
        value = raised if happened[i] > ZERO else value
        weight = absent[i] if absent[i] > ZERO else UNIT
        lowered = sunk(value, weight if weight < UNIT else UNIT, missed[i] / weight, away, UNIT)
        value = lowered if absent[i] > ZERO else value
        values[i] = value if value > SMALLEST else ZERO
