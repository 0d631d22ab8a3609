"""The leaky integrator: which cells, and which events in them, led a track to where it is (thesis 4.1.3 and 4.4).

1. A cell that a track leaves joins what the track remembers. Each event adds its rate α ψ to a weight of its own: one
   weight for having happened there and one, by ψ(0), for having been absent.
2. At every change of cell the weights fade by one factor, and what a goal is worth to them by another (1, or γ).
3. When a cell is entered, each remembered event moves its value for that goal towards what the goal is worth to it, at
   its weight or at 1, whichever is less. An absent event lets its value sink (`neorl.horde.sunk`).
4. A cell is forgotten when its strength, 1 more each time it is left, has faded below 1e-4.

Arrays are those of one track: cells (cells,), of which the first `count` are remembered; strength (cells,); weight and
worth (cells, 8), of having happened for each event and then of having been absent for each.
"""

import numpy as np

from neorl.horde import N_EVENTS, SMALLEST, UNIT, ZERO, sunk
from neorl.kernel import kernel

CUT = np.float32(1e-4)


@kernel
def fade(cells, count, strength, weight, worth, factor, discount):
    """Let all that is remembered fade, with a factor of 0 at once, and return how many cells still are."""
    kept = 0
    for i in range(count):
        cell = cells[i]
        strength[cell] *= factor
        remains = strength[cell] >= CUT
        if not remains:
            strength[cell] = ZERO
        for event in range(2 * N_EVENTS):
            reached = worth[cell, event] * factor * discount
            weight[cell, event] = weight[cell, event] * factor if remains else ZERO
            worth[cell, event] = reached if remains and reached > SMALLEST else ZERO
        if remains:
            cells[kept] = cell
            kept += 1
    return kept


@kernel
def join(cells, count, strength, weight, worth, cell, rates, absent_rate):
    """Remember a cell that is left, and return how many cells are remembered."""
    if strength[cell] == ZERO:
        cells[count] = cell
        count += 1
    strength[cell] += UNIT
    for event in range(N_EVENTS):
        absent = rates[event] == ZERO
        rate = absent_rate if absent else rates[event]
        weight[cell, event + absent * N_EVENTS] += rate
        worth[cell, event + absent * N_EVENTS] += rate
    return count


@kernel
def learn_remembered(q, first, map_cells, known, cells, count, weight, worth, goal, away):
    """Learn in all remembered cells that the goal is where they led to."""
    for i in range(count):
        cell = cells[i]
        known[cell, 0] = min(known[cell, 0], goal)
        known[cell, 1] = max(known[cell, 1], goal + 1)
        for event in range(N_EVENTS):
            index = first + (cell * N_EVENTS + event) * map_cells + goal
            value = q[index]
            happened, absent = weight[cell, event], weight[cell, event + N_EVENTS]
            if happened > ZERO:
                value += min(happened, UNIT) * (worth[cell, event] / happened - value)
            if absent > ZERO:
                value = sunk(value, min(absent, UNIT), worth[cell, event + N_EVENTS] / absent, away, UNIT)
            q[index] = value if value > SMALLEST else ZERO
