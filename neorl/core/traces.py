"""The leaky integrator: which cells, and which events in them, led a track to where it is (thesis 4.1.3 and 4.4).

1. A cell that a track leaves joins what the track remembers. Each event adds its rate α ψ to a weight of its own: one
   weight for having happened there and one, by ψ(0), for having been absent.
2. At every change of cell the weights fade by one factor, and what a goal is worth to them by another (1, or γ).
3. When a cell is entered, each remembered event moves its value for that goal towards what the goal is worth to it, at
   its weight or at 1, whichever is less. An absent event lets its value sink (`neorl.core.horde.sunk`).
4. A cell is forgotten when its strength, 1 more each time it is left, has faded below 1e-4.

Arrays are those of one track. `cells` (cells,) lists the `count` cells that are remembered, in no order, and `places`
(cells,) says where in the list each cell stands, plus one; 0 is nowhere. strength (cells,) goes by place in the list,
and so do weight and worth (8 · cells,), a row each for having happened, of each event, and then for having been absent.
Rows are contiguous, so that the processor can work on several places at a time.
"""

import numpy as np

from neorl.core.horde import N_EVENTS, SMALLEST, UNIT, ZERO, sunk
from neorl.core.kernel import kernel

CUT = np.float32(1e-4)
N_ROWS = 2 * N_EVENTS


@kernel
def fade(cells, places, count, strength, weight, worth, factor, discount):
    """Let all that is remembered fade, and return how many cells still are."""
    for i in range(count):
        strength[i] *= factor
    for row in range(N_ROWS):
        begin = row * cells.shape[0]
        weights, worths = weight[begin : begin + count], worth[begin : begin + count]
        for i in range(count):
            weights[i] *= factor
            reached = worths[i] * factor * discount
            worths[i] = reached if reached > SMALLEST else ZERO
    i = 0
    while i < count:
        if strength[i] < CUT:
            count -= 1
            forget(cells, places, i, count, strength, weight, worth)
        else:
            i += 1
    return count


@kernel
def forget(cells, places, i, last, strength, weight, worth):
    """Put the last of the list in place of the one to be forgotten."""
    places[cells[last]] = i + 1
    places[cells[i]] = 0
    cells[i], strength[i] = cells[last], strength[last]
    for row in range(N_ROWS):
        begin = row * cells.shape[0]
        weight[begin + i], worth[begin + i] = weight[begin + last], worth[begin + last]


@kernel
def forget_all(cells, places, count):
    """Take all cells off the list."""
    for i in range(count):
        places[cells[i]] = 0


@kernel
def join(cells, places, count, strength, weight, worth, cell, rates, absent_rate):
    """Remember a cell that is left, and return how many cells are remembered."""
    i = places[cell] - 1
    if i < 0:
        i = count
        count += 1
        cells[i], places[cell], strength[i] = cell, count, ZERO
        for row in range(N_ROWS):
            weight[row * cells.shape[0] + i] = worth[row * cells.shape[0] + i] = ZERO
    strength[i] += UNIT
    for event in range(N_EVENTS):
        absent = rates[event] == ZERO
        at = (event + absent * N_EVENTS) * cells.shape[0] + i
        rate = absent_rate if absent else rates[event]
        weight[at] += rate
        worth[at] += rate
    return count


@kernel
def learn_remembered(q, first, known, cells, count, weight, worth, goal, away, values):
    """Learn in all remembered cells that the goal is where they led to.

    values: (cells,), room for the values of one event. All are read before any is used: those of a fine map lie far
    apart, and so the processor can wait for many at a time.
    """
    map_cells = cells.shape[0]
    for i in range(count):
        known[cells[i], 0] = min(known[cells[i], 0], goal)
        known[cells[i], 1] = max(known[cells[i], 1], goal + 1)
    for event in range(N_EVENTS):
        column = first + event * map_cells + goal
        for i in range(count):
            values[i] = q[column + cells[i] * N_EVENTS * map_cells]
        happened, absent = event * map_cells, (event + N_EVENTS) * map_cells
        move(values, count, weight[happened : happened + count], worth[happened : happened + count],
             weight[absent : absent + count], worth[absent : absent + count], away)
        for i in range(count):
            q[column + cells[i] * N_EVENTS * map_cells] = values[i]


@kernel
def move(values, count, happened, reached, absent, missed, away):
    """Move values of an event towards what the goal is worth where it happened, and let them sink where it did not."""
    for i in range(count):
        value = values[i]
        weight = happened[i] if happened[i] > ZERO else UNIT
        raised = value + (weight if weight < UNIT else UNIT) * (reached[i] / weight - value)
        value = raised if happened[i] > ZERO else value
        weight = absent[i] if absent[i] > ZERO else UNIT
        lowered = sunk(value, weight if weight < UNIT else UNIT, missed[i] / weight, away, UNIT)
        value = lowered if absent[i] > ZERO else value
        values[i] = value if value > SMALLEST else ZERO
