"""Value functions of rewards on a grid: their overlap, and what their sum is worth (thesis section 4.1.2).

1. A state pays its reward whenever it is entered. A step into a wall enters nothing. Nothing ever ends.
2. `plan` finds the best values exactly. For a reward of 1 in one state they are the operant value function towards it;
   mutually exclusive rewards are what definition 4 of the thesis calls orthogonal.
3. *Superposition* (eq. 4.3, 4.4) adds the value functions of all elements, each times its valence. What a fixed policy
   is worth is linear in the rewards, so for it the sum is exact. The best values are not linear: each function of the
   sum supposes that the agent goes after its element alone.
"""

import math
from typing import NamedTuple

import numpy as np

from neorl import checks
from neorl.chapters.chapter_3 import decision

CONVERGED = 1e-12  # what is left of the error at the start


class Comparison(NamedTuple):
    """Superposition against the plan for all elements at once, in the states without an element, for each placement.

    Losses are shares of the plan's average return over placements, since in some of them it makes nothing.
    """

    agreement: np.ndarray  # share of the actions of superposition that are best: float64 (placements,)
    achieved: np.ndarray  # 1 less what is lost by following them: float64 (placements,)
    at_random: np.ndarray  # 1 less what is lost by drawing actions: float64 (placements,)


def plan(grid, rewards, discount=0.8):
    """The best action values: float64 (…, states, 4), by value iteration.

    grid: a `Grid`. rewards: (…, states), paid on entering. discount: γ a step, from 0 to 0.99.
    Raises ValueError for anything else.
    """
    rewards = _checked(grid, rewards, discount)
    sweeps = 1 if discount == 0 else math.ceil(math.log(CONVERGED) / math.log(discount))
    return decision.plan(grid.transitions(), _paid(grid, rewards), discount, sweeps)


def evaluate(grid, policy, rewards, discount=0.8):
    """What a policy is worth in each state: float64 (…, states), by solving its linear equations.

    policy: (…, states, 4), the probability of each action. All else is as in `plan`.
    """
    rewards = _checked(grid, rewards, discount)
    moves = np.zeros((*policy.shape[:-1], grid.states))
    for action in range(4):
        moves[..., np.arange(grid.states), grid.next_state[:, action]] += policy[..., action]
    brought = (policy * _paid(grid, rewards)).sum(axis=-1)
    return np.linalg.solve(np.eye(grid.states) - discount * moves, brought[..., None])[..., 0]


def error_of_sum(grid, rewards):
    """How far the values of drawn actions are off if those for each state's reward are added: float.

    rewards: (states,). It is 0 up to rounding, as for every fixed policy.
    """
    drawn = np.full((grid.states, 4), 0.25)
    alone = evaluate(grid, np.stack([drawn] * grid.states), np.eye(grid.states))
    return np.abs(rewards @ alone - evaluate(grid, drawn, rewards)).max()


def best_actions(q):
    """Which actions are best, several where they are equal: bool (…, states, 4)."""
    return q > q.max(axis=-1, keepdims=True) - 1e-9


def greedy(q):
    """The policy of the best actions, equally likely where there are several: float64 (…, states, 4)."""
    best = best_actions(q)
    return best / best.sum(axis=-1, keepdims=True)


def misled(q, planned, elements):
    """The states without an element in which an action is best by q and not by the plan: a list of integers.

    q, planned: (states, 4). elements: a collection of states.
    """
    wrong = (best_actions(q) & ~best_actions(planned)).any(axis=1)
    return [state for state in np.flatnonzero(wrong) if state not in elements]


def compare(grid, valences, placements, seed=0, discount=0.8):
    """A `Comparison` for elements of these valences in states that are drawn anew for each placement.

    valences: fewer than there are states, one of them positive at least. placements: integer ≥ 1. seed: integer ≥ 0.
    Raises ValueError for anything else.
    """
    valences = checks.finite("valences", np.asarray(valences, float))
    if valences.ndim != 1 or not 0 < len(valences) < grid.states or valences.max() <= 0:
        raise ValueError(f"valences is {valences}, allowed are fewer than {grid.states} numbers, not all negative")
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
    """Many wanted elements, and few among feared ones, under several discounts: {γ: two `Comparison`}.

    The first has six elements of valence 1, the second one of 1 and two of −1. All else is as in `compare`.
    """
    return {discount: [compare(grid, valences, placements, seed, discount) for valences in ([1] * 6, [1, -1, -1])]
            for discount in discounts}


def cosines(vectors):
    """The cosine of the angle between any two of several vectors (n, length): float64 (n, n), 0 with a vector of 0."""
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
