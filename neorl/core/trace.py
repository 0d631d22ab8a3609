"""The memory of a track: the cells that it has left, which learn where they led (thesis 4.1.3).

1. A track remembers cells by a leaky integrator. A cell joins the memory when it is left: each event adds its rate to a
   weight of its own, one for having occurred there and one, by ψ(0), for having been absent.
2. At every change of cell the weights fade, and the worth of a goal to them by γ. The value of each remembered event
   for the cell entered moves towards that worth, at its weight or at 1, whichever is less.
3. A cell is forgotten when its strength, which grows by 1 each time it is left, has faded below 1e-4.

In `notebooks/companion/one_file.py`, this is the second half of section 5.
"""

from typing import NamedTuple

import numpy as np

from neorl.core.learning import SMALLEST, UNIT, ZERO, place_of, sunk, widen
from neorl.kernels.annotations import array
from neorl.kernels.kernel import inlined_kernel, kernel

FORGOTTEN = np.float32(1e-4)  # the strength below which a cell is no longer remembered


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
    rates: array("float32", "actions")  # of the events in the cell that the track leaves


@inlined_kernel
def trace_of(agent, memory, nres, point):
    """The `Trace` of a track."""
    actions = agent.rates.shape[0]
    begin = nres.first_trace + point * nres.cells
    end = begin + nres.cells
    first, last = 2 * actions * begin, 2 * actions * end
    return Trace(memory.remembered[begin:end], memory.remembered_at[begin:end], memory.strength[begin:end],
                 memory.trace_weight[first:last], memory.trace_worth[first:last], agent.rates)


@kernel
def join(trace, count, cell, rates, absent_rate, strength, worth):
    """Σ α_a += α_a and Σ α_a γᵏ += α_a for a cell just left; return how many are remembered (one file: `join`)."""
    actions, half = trace.rates.shape[0], trace.cells.shape[0] * trace.rates.shape[0]
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
def fade(trace, count, retained, discount):
    """Weights × m / (1 + m), and worths × γ besides; return how many cells are still remembered.

    retained: m / (1 + m), for a mean of m earlier cells.
    """
    for i in range(count):
        trace.strength[i] *= retained
    size, half = count * trace.rates.shape[0], trace.cells.shape[0] * trace.rates.shape[0]
    # Σ α_a ×= m / (1 + m), and Σ α_a γᵏ ×= γ m / (1 + m), of events that occurred, and then of absent ones.
    for begin in range(0, 2 * half, half):
        # Views, whose indices count from 0.
        weights, worths = trace.weight[begin : begin + size], trace.goal_worth[begin : begin + size]
        for i in range(size):
            weights[i] *= retained
            reached = worths[i] * retained * discount
            worths[i] = reached if reached > SMALLEST else ZERO
    i = 0
    while i < count:  # not a range: the last cell takes the place of one that is forgotten, and is looked at next
        if trace.strength[i] < FORGOTTEN:
            count -= 1
            forget(trace, i, count)
        else:
            i += 1
    return count


@kernel
def forget(trace, i, last):
    """Forget a cell: replace it by the last of the list."""
    cells, actions = trace.cells, trace.rates.shape[0]
    trace.places[cells[last]] = i + 1
    trace.places[cells[i]] = 0
    cells[i], trace.strength[i] = cells[last], trace.strength[last]
    for begin in range(0, 2 * cells.shape[0] * actions, cells.shape[0] * actions):
        for event in range(actions):
            # Unsigned, as in `learning.Order`.
            into, of = np.uint64(begin + i * actions + event), np.uint64(begin + last * actions + event)
            trace.weight[into], trace.goal_worth[into] = trace.weight[of], trace.goal_worth[of]


@kernel
def forget_all(trace, count):
    """Remove all cells from the list."""
    for i in range(count):
        trace.places[trace.cells[i]] = 0


@kernel
def learn_remembered(values, order, rule, trace, count, goal):
    """Q_i(s, a) ← Q_i(s, a) + min(Σ α_a, 1) (Σ α_a γᵏ / Σ α_a − Q_i(s, a)) in all cells s remembered, for i = s⁺.

    The sums are over the times that s was left, k changes of cell ago (one file: `remembered`). All values are read
    before any is used: those of a fine map are not in the cache, and the processor can then wait for many at a time.
    """
    cells, actions, read = trace.cells, trace.rates.shape[0], values.scratch
    for i in range(count):
        widen(values.goal_range, np.uint64(cells[i]), goal)
    for i in range(count):
        place = place_of(values.first, order, cells[i], goal)
        for event in range(actions):
            read[np.uint64(i * actions + event)] = values.q[place + np.uint64(event) * order.action]
    size, half = count * actions, cells.shape[0] * actions
    move(read, size, trace.weight[:size], trace.goal_worth[:size], trace.weight[half : half + size],
         trace.goal_worth[half : half + size], rule.away)
    for i in range(count):
        place = place_of(values.first, order, cells[i], goal)
        for event in range(actions):
            values.q[place + np.uint64(event) * order.action] = read[np.uint64(i * actions + event)]


@kernel
def move(values, count, happened, reached, absent, missed, away):
    """Move values towards the worth of the goal for events that occurred, and let those of absent events sink."""
    # Q += min(Σ α_a, 1) (Σ α_a γᵏ / Σ α_a − Q) where a occurred, and then, by Σ |α ψ(0)|, `sunk` where it was absent.
    for i in range(count):
        value = values[i]
        # Both results, then a choice: without a branch, the loop compiles to vector instructions.
        weight = happened[i] if happened[i] > ZERO else UNIT
        raised = value + (weight if weight < UNIT else UNIT) * (reached[i] / weight - value)
        value = raised if happened[i] > ZERO else value
        weight = absent[i] if absent[i] > ZERO else UNIT
        lowered = sunk(value, weight if weight < UNIT else UNIT, missed[i] / weight, away, UNIT)
        value = lowered if absent[i] > ZERO else value
        values[i] = value if value > SMALLEST else ZERO
