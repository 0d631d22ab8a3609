"""Sums in place of a whole: functions as sums of ridges, and sums of value functions (thesis sections 4.1.1, 4.1.2).

1. Each term of the sum of Kolmogorov and Arnold (eq. 4.2) is a *ridge* here, χ(x cos θ + y sin θ). Ridges are added one
   at a time, at the angle that explains most of the residual (projection pursuit, Friedman and Stuetzle 1981); the
   outer functions χ are polynomials, fitted jointly by least squares.
2. On a grid, a state pays its reward whenever it is entered, and a step into a wall enters no state. *Superposition*
   (eq. 4.3, 4.4) adds the value functions of all elements, each times its valence. For a fixed policy the sum is exact;
   for the best one it is not, since each term assumes that the agent pursues its element alone.
"""

import math
from typing import NamedTuple

import numpy as np

DEGREE = 10  # of the outer functions
ANGLES = np.pi * np.arange(60) / 60
CONVERGED = 1e-12  # remaining share of the initial error of a plan


class Comparison(NamedTuple):
    """Superposition against the plan for all elements at once, in the states without an element, for each placement.

    Losses are shares of the plan's return averaged over placements, since in some placements it earns nothing.
    """

    achieved: np.ndarray  # 1 less the loss from following the sum: float64 (placements,)
    at_random: np.ndarray  # 1 less the loss from drawing actions: float64 (placements,)


def fit_ridges(values, terms):
    """Residuals of sums of 0, 1, … ridges fitted to a function on the square from −1 to 1: float64 (terms + 1,).

    values: of the function, (side, side), y first. Residuals are root mean squares, in standard deviations of it.
    """
    side = np.linspace(-1, 1, len(values))
    x, y = (each.ravel() for each in np.meshgrid(side, side))
    outer = [np.linalg.qr(np.vander((x * np.cos(angle) + y * np.sin(angle)) / 2, DEGREE + 1))[0] for angle in ANGLES]
    left = values.ravel() - values.mean()
    spread = left.std()
    errors, fitted = [1.0], np.empty((left.size, 0))
    for _ in range(terms):
        best = max(outer, key=lambda each: np.square(each.T @ left).sum())
        new = best - fitted @ (fitted.T @ best)
        directions, sizes, _ = np.linalg.svd(new, full_matrices=False)
        fitted = np.hstack([fitted, directions[:, sizes > 1e-8]])  # without what earlier ridges span
        left = left - fitted @ (fitted.T @ left)
        errors.append(left.std() / spread)
    return np.array(errors)


def plan(grid, rewards, discount=0.8):
    """Best action values for rewards on entering states, by value iteration: float64 (…, states, 4)."""
    paid = _paid(grid, rewards)
    q = np.zeros_like(paid)
    for _ in range(math.ceil(math.log(CONVERGED) / math.log(discount))):
        q = paid + discount * q.max(axis=-1)[..., grid.next_state]
    return q


def evaluate(grid, policy, rewards, discount=0.8):
    """Value of each state under a policy (…, states, 4): float64 (…, states)."""
    moves = np.zeros((*policy.shape[:-1], grid.states))
    for action in range(4):
        moves[..., np.arange(grid.states), grid.next_state[:, action]] += policy[..., action]
    earned = (policy * _paid(grid, rewards)).sum(axis=-1)
    return np.linalg.solve(np.eye(grid.states) - discount * moves, earned[..., None])[..., 0]


def best_actions(q):
    """Which actions are best, including ties: bool (…, states, 4)."""
    return q > q.max(axis=-1, keepdims=True) - 1e-9


def greedy(q):
    """Greedy policy, in which tied actions are equally likely: float64 (…, states, 4)."""
    best = best_actions(q)
    return best / best.sum(axis=-1, keepdims=True)


def misled(q, planned, elements):
    """States without an element where an action is best by q but not by the plan."""
    wrong = (best_actions(q) & ~best_actions(planned)).any(axis=1)
    return [state for state in np.flatnonzero(wrong) if state not in elements]


def compare(grid, valences, placements, seed=0, discount=0.8):
    """Compare superposition with the plan, for elements in states drawn for each placement: a `Comparison`.

    valences: of the elements, fewer than the states, at least one of them positive. Other arguments as in `plan`.
    """
    rng = np.random.default_rng(seed)
    rewards = np.zeros((placements, grid.states))
    for reward in rewards:
        reward[rng.choice(grid.states, len(valences), replace=False)] = valences
    superposed = greedy(np.tensordot(rewards, plan(grid, np.eye(grid.states), discount), axes=1))
    best = plan(grid, rewards, discount)
    empty = rewards == 0
    worth = {"best": best.max(axis=-1), "superposed": evaluate(grid, superposed, rewards, discount),
             "random": evaluate(grid, np.full_like(superposed, 0.25), rewards, discount)}
    worth = {name: (value * empty).sum(axis=-1) for name, value in worth.items()}
    usual = worth["best"].mean()
    achieved, at_random = (1 - (worth["best"] - worth[name]) / usual for name in ("superposed", "random"))
    return Comparison(achieved, at_random)


def cosines(vectors):
    """Cosine of the angle between each two of several vectors (n, length): float64 (n, n), 0 for a zero vector."""
    length = np.linalg.norm(vectors, axis=1, keepdims=True)
    unit = vectors / np.where(length > 0, length, 1)
    return unit @ unit.T


def _paid(grid, rewards):
    """The reward of each action in each state: float64 (…, states, 4)."""
    return rewards[..., grid.next_state] * (grid.next_state != np.arange(grid.states)[:, None])
