"""The Horde: one general value function for every cell of a map, all learned from the same stream of experience.

``q[state, action, goal]`` estimates the discounted value of taking an action in one cell for reaching another (Sutton
et al. 2011; thesis sections 4.1.2 and 4.1.3). All goals learn off policy at every update, whether anybody asked for
them or not: this is latent learning. A goal pays 1 when its cell is entered, and nothing else is ever paid.

1. *Inference inversion* (eq. 4.7, 4.8): a change of cell drives the update. Each event a that occurred in the cell
   just left moves q[cell_tm1, a, :] towards γ max q[cell_t, :, :] at the rate ψ(a) α.
2. *Temporal difference* (eq. 4.6) is the same update after every step, with the action taken as its only event.
3. *Superposition* (eq. 4.3, 4.4): the value of an action is the sum of its values for the cells that hold elements of
   interest, each weighted by the valence of its element.

A value below 1e-30 counts as zero, because arithmetic on subnormal numbers is slow.
"""

import numpy as np

from neorl import checks
from neorl.core.kernel import kernel

N_EVENTS = 4  # N, S, E, W; the no-op is no event
OWN_CELL = ("silent", "counts")  # an element in the agent's own cell
ZERO, UNIT, SMALLEST = np.float32(0.0), np.float32(1.0), np.float32(1e-30)
UNBOUNDED = np.float32(np.inf)


def learn(q, cell_tm1, cell_t, credit, learning_rate=0.03, discount=0.8, terminal=True):
    """Learn every goal, in place, from the one transition cell_tm1 → cell_t (thesis eq. 4.8; eq. 4.6 with one event).

    q: float32 (cells, 4, cells), C-contiguous. cell_tm1, cell_t: 0 … cells − 1.
    credit: (4,), ψ of each event in [0, 1]. learning_rate α, discount γ: in [0, 1].
    terminal: a goal reached is worth 1, and not 1 + γ times what may follow.
    Raises ValueError for anything else.
    """
    cells = _check_q(q)
    checks.integer("cell_tm1", cell_tm1, at_least=0, at_most=cells - 1)
    checks.integer("cell_t", cell_t, at_least=0, at_most=cells - 1)
    credit = np.array([checks.real("credit", value, 0, 1) for value in credit], np.float32)
    if len(credit) != N_EVENTS:
        raise ValueError(f"credit has {len(credit)} values, allowed are {N_EVENTS}")
    rates = np.float32(checks.real("learning_rate", learning_rate, 0, 1)) * credit
    discount = np.float32(checks.real("discount", discount, 0, 1))
    learn_all_goals(q.reshape(-1), 0, cells, np.tile([0, cells], (cells, 1)), cell_tm1, cell_t, rates, ZERO, False,
                    discount, checks.flag("terminal", terminal), np.empty(cells, np.float32))


def superpose(q, cell, goals, valences, own_cell="counts"):
    """The value of each action in a cell: float64 (4,) (thesis eq. 4.3 and 4.4).

    q: float32 (cells, 4, cells). cell: where the agent is. goals: the cells of the elements of interest; valences:
    their weights, as many. own_cell: whether an element in `cell` itself is "silent" or "counts".
    Raises ValueError for anything else.
    """
    cells = _check_q(q)
    checks.integer("cell", cell, at_least=0, at_most=cells - 1)
    if len(goals) != len(valences):
        raise ValueError(f"valences has {len(valences)} values, allowed is one for each of the {len(goals)} goals")
    checks.one_of("own_cell", own_cell, OWN_CELL)
    value = np.zeros(N_EVENTS)
    for goal, valence in zip(goals, valences):
        checks.integer("goals", goal, at_least=0, at_most=cells - 1)
        checks.real("valences", valence)
        if goal != cell or own_cell == "counts":
            add_goal(q.reshape(-1), 0, cells, cell, goal, valence, value)
    return value


def as_vectors(values):
    """Action values (n, 4) as vectors in the arena (n, 2): (E − W, S − N)."""
    return np.stack([values[:, 2] - values[:, 3], values[:, 1] - values[:, 0]], axis=1)


def _check_q(q):
    cells = q.shape[0]
    if q.dtype != np.float32 or q.shape != (cells, N_EVENTS, cells) or not q.flags.c_contiguous:
        raise ValueError(f"q is {q.dtype} {q.shape}, allowed are C-contiguous float32 arrays (cells, 4, cells)")
    return cells


@kernel
def learn_all_goals(q, first, cells, known, cell_tm1, cell_t, rates, decay, away, discount, terminal, target):
    """One update of every goal of the map that begins at q[first]; `target` is working memory for a value a goal.

    known: int64 (cells, 2), the goals from … to − 1 of which a cell may know anything. All others are zero there and
    remain so, which spares fine maps most of the work.
    rates: α ψ for each event. decay: the rate −α ψ(0) at which the values of an event that did not occur sink: towards
    zero or, if `away`, away from the target.
    """
    begin = min(min(known[cell_tm1, 0], known[cell_t, 0]), cell_t)
    end = max(max(known[cell_tm1, 1], known[cell_t, 1]), cell_t + 1)
    known[cell_tm1, 0], known[cell_tm1, 1] = begin, end
    count = end - begin
    row = first + cell_t * N_EVENTS * cells + begin
    north, south = q[row : row + count], q[row + cells : row + cells + count]
    east, west = q[row + 2 * cells : row + 2 * cells + count], q[row + 3 * cells : row + 3 * cells + count]
    for goal in range(count):  # comparisons instead of max(), so that the loop compiles to vector instructions
        vertical = north[goal] if north[goal] > south[goal] else south[goal]
        horizontal = east[goal] if east[goal] > west[goal] else west[goal]
        target[goal] = discount * (vertical if vertical > horizontal else horizontal)
    target[cell_t - begin] = UNIT if terminal else UNIT + target[cell_t - begin]
    highest = UNIT if terminal else UNIT / (UNIT - discount)
    for event in range(N_EVENTS):
        row = first + (cell_tm1 * N_EVENTS + event) * cells + begin
        value = q[row : row + count]
        occurred = rates[event] > ZERO
        if occurred or away and decay > ZERO:
            rate, bound = (rates[event], UNBOUNDED) if occurred else (-decay, highest)
            for goal in range(count):
                new = value[goal] + rate * (target[goal] - value[goal])
                new = new if new < bound else bound
                value[goal] = new if new > SMALLEST else ZERO
        elif decay > ZERO:
            for goal in range(count):
                new = value[goal] - decay * value[goal]
                value[goal] = new if new > SMALLEST else ZERO


@kernel
def learn_one_goal(q, first, cells, known, cell_tm1, goal, rates, decay, away, fading):
    """Move one goal's value of each event in a cell towards 1, at `rates` times `fading`, or let it sink at `decay`."""
    known[cell_tm1, 0] = min(known[cell_tm1, 0], goal)
    known[cell_tm1, 1] = max(known[cell_tm1, 1], goal + 1)
    for event in range(N_EVENTS):
        index = first + (cell_tm1 * N_EVENTS + event) * cells + goal
        if rates[event] > ZERO:
            q[index] += fading * rates[event] * (UNIT - q[index])
        elif decay > ZERO:
            q[index] = sunk(q[index], fading * decay, UNIT, away, UNIT)


@kernel
def sunk(value, rate, target, away, highest):
    """The value of an event that did not occur: nearer to zero, or away from its target but within 0 … `highest`."""
    if away:
        value -= rate * (target - value)
        value = value if value < highest else highest
    else:
        value -= rate * value
    return value if value > SMALLEST else ZERO


@kernel
def add_goal(q, first, cells, cell, goal, weight, value):
    """Add one goal's value of each action in a cell, times `weight`, to `value`."""
    index = first + cell * N_EVENTS * cells + goal
    for action in range(N_EVENTS):
        value[action] += weight * q[index + action * cells]
