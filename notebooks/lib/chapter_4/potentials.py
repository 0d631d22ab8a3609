"""Value functions of rewards on a grid: their overlap, and the return from following their sum (thesis section 4.1.2).

1. A state pays its reward whenever it is entered. A step into a wall enters no state. The task is continuing.
2. `plan` finds the best values exactly. With a reward of 1 in one state they are the operant value function towards it;
   definition 4 of the thesis calls mutually exclusive rewards orthogonal.
3. *Superposition* (eq. 4.3, 4.4) adds the value functions of all elements, each times its valence. The values of a
   fixed policy are linear in the rewards, so for them the sum is exact. The best values are not linear: each term of
   the sum assumes that the agent pursues its element alone.
"""

import math
from typing import NamedTuple

import numpy as np

from lib.chapter_3 import decision
from neorl import checks

CONVERGED = 1e-12  # remaining share of the initial error


class Comparison(NamedTuple):
    """Superposition against the plan for all elements at once, in the states without an element, for each placement.

    Losses are shares of the plan's return averaged over placements, since in some placements it earns nothing.
    """

    agreement: np.ndarray  # share of the actions of superposition that are best: float64 (placements,)
    achieved: np.ndarray  # 1 less the loss from following them: float64 (placements,)
    at_random: np.ndarray  # 1 less the loss from drawing actions: float64 (placements,)


def plan(grid, rewards, discount=0.8):
    """Best action values, by value iteration: float64 (…, states, 4).

    grid: a `Grid`. rewards: (…, states), paid on entering. discount: γ per step, from 0 to 0.99.
    Raises ValueError for anything else.
    """
    rewards = _checked(grid, rewards, discount)
    sweeps = 1 if discount == 0 else math.ceil(math.log(CONVERGED) / math.log(discount))
    return decision.plan(grid.transitions(), _paid(grid, rewards), discount, sweeps)


def evaluate(grid, policy, rewards, discount=0.8):
    """Value of each state under a policy, by solving its linear equations: float64 (…, states).

    policy: (…, states, 4), the probability of each action. Other arguments as in `plan`.
    """
    rewards = _checked(grid, rewards, discount)
    moves = np.zeros((*policy.shape[:-1], grid.states))
    for action in range(4):
        moves[..., np.arange(grid.states), grid.next_state[:, action]] += policy[..., action]
    brought = (policy * _paid(grid, rewards)).sum(axis=-1)
    return np.linalg.solve(np.eye(grid.states) - discount * moves, brought[..., None])[..., 0]


def error_of_sum(grid, rewards):
    """Largest error of a sum of value functions, one for each state's reward, under random actions: float.

    rewards: (states,). The error is 0 up to rounding, as for every fixed policy.
    """
    drawn = np.full((grid.states, 4), 0.25)
    alone = evaluate(grid, np.stack([drawn] * grid.states), np.eye(grid.states))
    return np.abs(rewards @ alone - evaluate(grid, drawn, rewards)).max()


def best_actions(q):
    """Which actions are best, including ties: bool (…, states, 4)."""
    return q > q.max(axis=-1, keepdims=True) - 1e-9


def greedy(q):
    """Greedy policy, in which tied actions are equally likely: float64 (…, states, 4)."""
    best = best_actions(q)
    return best / best.sum(axis=-1, keepdims=True)


def misled(q, planned, elements):
    """States without an element in which an action is best by q but not by the plan: a list of integers.

    q, planned: (states, 4). elements: a collection of states.
    """
    wrong = (best_actions(q) & ~best_actions(planned)).any(axis=1)
    return [state for state in np.flatnonzero(wrong) if state not in elements]


def compare(grid, valences, placements, seed=0, discount=0.8):
    """Compare superposition with the plan, for elements in states drawn for each placement: a `Comparison`.

    valences: of the elements, fewer than the states, at least one of them positive. placements: integer ≥ 1.
    seed: integer ≥ 0. Other arguments as in `plan`.
    Raises ValueError for anything else.
    """
    valences = checks.finite("valences", np.asarray(valences, float))
    if valences.ndim != 1 or not 0 < len(valences) < grid.states or valences.max() <= 0:
        raise ValueError(f"valences is {valences}, allowed are fewer than {grid.states} numbers, at least one above 0")
    rng = np.random.default_rng(checks.integer("seed", seed, at_least=0))
    checks.integer("placements", placements, at_least=1)
    rewards = np.zeros((placements, grid.states))
    for reward in rewards:
        reward[rng.choice(grid.states, len(valences), replace=False)] = valences
    alone = plan(grid, np.eye(grid.states), discount)
    superposed = greedy(np.tensordot(rewards, alone, axes=1))
    best = plan(grid, rewards, discount)
    empty = rewards == 0
    agreement = (superposed * (greedy(best) > 0)).sum(axis=-1)
    worth = {"best": best.max(axis=-1), "superposed": evaluate(grid, superposed, rewards, discount),
             "random": evaluate(grid, np.full_like(superposed, 0.25), rewards, discount)}
    worth = {name: (value * empty).sum(axis=-1) for name, value in worth.items()}
    usual = worth["best"].mean()
    achieved, at_random = (1 - (worth["best"] - worth[name]) / usual for name in ("superposed", "random"))
    return Comparison((agreement * empty).sum(axis=-1) / empty.sum(axis=-1), achieved, at_random)


def compare_discounts(grid, placements, seed=0, discounts=(0.5, 0.95)):
    """Compare superposition with the plan under several discounts: {γ: two `Comparison`}.

    The first has six elements of valence 1, the second one of 1 and two of −1. Other arguments as in `compare`.
    """
    return {discount: [compare(grid, valences, placements, seed, discount) for valences in ([1] * 6, [1, -1, -1])]
            for discount in discounts}


def cosines(vectors):
    """Cosine of the angle between each two of several vectors (n, length): float64 (n, n), 0 for a zero vector."""
    length = np.linalg.norm(vectors, axis=1, keepdims=True)
    unit = vectors / np.where(length > 0, length, 1)
    return unit @ unit.T


def _checked(grid, rewards, discount):
    rewards = checks.finite("rewards", np.asarray(rewards, float))
    checks.real("discount", discount, 0, 0.99)
    if rewards.shape[-1:] != (grid.states,):
        raise ValueError(f"rewards has the shape {rewards.shape}, allowed are (…, {grid.states})")
    return rewards


def _paid(grid, rewards):
    entered = grid.next_state != np.arange(grid.states)[:, None]
    return rewards[..., grid.next_state] * entered
