"""The Horde: one general value function for every cell of a map, all learned from the same stream of experience.

``q[state, action, goal]`` estimates the discounted value of taking an action in one cell for reaching another (Sutton
et al. 2011; thesis sections 4.1.2 and 4.1.3). All goals learn at every update (`neorl.core.learning`): this is latent
learning. *Superposition* (eq. 4.3, 4.4) turns it into behaviour: the value of an action is the sum of its values for
the cells that hold elements of interest, each weighted by the valence of its element.
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from neorl.common import checks
from neorl.core.learning import ZERO, MapValues, Rule, learn_all_goals
from neorl.core.scene import CARDINAL, Actions
from neorl.kernels.execution import execute

OWN_CELL = ("silent", "counts")  # an element in the agent's own cell


def learn(q: NDArray[np.float32], cell_tm1: int, cell_t: int, credit: Sequence[float], learning_rate: float = 0.03,
          discount: float = 0.8, terminal: bool = True) -> None:
    """Update every goal, in place, from one transition cell_tm1 → cell_t (thesis eq. 4.8; eq. 4.6 with one event).

    q: float32 (cells, actions, cells), C-contiguous, finite. cell_tm1, cell_t: 0 … cells − 1.
    credit: (actions,), ψ of each event in [0, 1]. learning_rate: α in [0, 1]. discount: γ in [0, 1].
    terminal: whether a goal reached is worth 1, instead of 1 + γ times the value that follows.
    Raises ValueError for anything else.
    """
    cells, actions = _check_q(q)
    if not q.flags.c_contiguous:
        raise ValueError("q must be C-contiguous, but is not; pass a copy")
    if not q.flags.writeable:
        raise ValueError("q must be writeable, but is read-only; pass a copy")
    cell_tm1 = checks.integer("cell_tm1", cell_tm1, at_least=0, at_most=cells - 1)
    cell_t = checks.integer("cell_t", cell_t, at_least=0, at_most=cells - 1)
    psi = np.array([checks.real("credit", value, 0, 1) for value in checks.several("credit", credit)], np.float32)
    if len(psi) != actions:
        raise ValueError(f"credit must have {actions} values, one for each action, but has {len(psi)}")
    checks.finite("q", q[[cell_tm1, cell_t]])
    rates = np.float32(checks.real("learning_rate", learning_rate, 0, 1)) * psi
    rule = Rule(np.float32(checks.real("discount", discount, 0, 1)), checks.flag("terminal", terminal), ZERO, False)
    every_goal = np.tile([0, cells], (cells, 1))
    execute(learn_all_goals, MapValues(q.reshape(-1), 0, cells, actions, every_goal, np.empty(cells, np.float32)), rule,
            cell_tm1, cell_t, rates)


def superpose(q: NDArray[np.float32], cell: int, goals: Sequence[int], valences: Sequence[float],
              own_cell: str = "counts") -> NDArray[np.float64]:
    """The value of each action in a cell: float64 (actions,) (thesis eq. 4.3 and 4.4).

    q: float32 (cells, actions, cells). cell: where the agent is. goals: the cells of the elements of interest.
    valences: their weights, one for each. own_cell: whether an element in `cell` itself is "silent" or "counts".
    Raises ValueError for anything else.
    """
    cells, actions = _check_q(q)
    cell = checks.integer("cell", cell, at_least=0, at_most=cells - 1)
    goals = [checks.integer("goals", goal, at_least=0, at_most=cells - 1) for goal in checks.several("goals", goals)]
    valences = [checks.real("valences", valence) for valence in checks.several("valences", valences)]
    if len(goals) != len(valences):
        raise ValueError(f"valences must have a value for each of the {len(goals)} goals, but has {len(valences)}")
    checks.one_of("own_cell", own_cell, OWN_CELL)
    checks.finite("q", q[cell][:, goals])
    value = np.zeros(actions)
    for goal, valence in zip(goals, valences):
        if goal != cell or own_cell == "counts":
            value += valence * q[cell, :, goal].astype(float)
    return value


def as_vectors(values: ArrayLike, actions: Actions = CARDINAL) -> NDArray[np.float64]:
    """Action values (…, actions) as vectors in the world (…, axes): the sum of the pushes times the values.

    actions: the world's `neorl.core.scene.Actions`; by default (E − W, S − N). Raises ValueError for anything else.
    """
    pushes = np.array(checks.instance("actions", actions, Actions).pushes)
    return checks.points("values", values, actions.names) @ pushes


def _check_q(q):
    checks.instance("q", q, np.ndarray)
    cells, actions = q.shape[:2] if q.ndim == 3 else (0, 0)
    if q.dtype != np.float32 or not q.dtype.isnative or q.shape != (cells, actions, cells) or not q.size:
        raise ValueError(f"q must be float32 (cells, actions, cells), but is {q.dtype} {q.shape}")
    return cells, actions
