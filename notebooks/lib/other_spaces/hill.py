"""Gymnasium's MountainCar-v0 (Moore 1990): the page's agent, Q-learning on the same cells, and a random driver.

1. An episode ends at the flag, or after 200 steps of the environment; every step costs 1.
2. A decision holds for `HELD` steps, as is usual where single steps hardly matter (Mnih et al. 2015).
3. Q-learning (Watkins 1989) receives the environment's reward, so its values begin above all later ones and make it
   try everything. The agent receives no reward, and desires the flag.
"""

import gymnasium
import numpy as np

from lib.other_spaces import minds
from lib.shared.tabular import Rates, exploring_action, learn_q
from neorl import Scene
from neorl.core.kernel import execute
from neorl.core.stream import new_stream
from neorl.gym import play

HELD, DECISIONS = 16, 2_400
EPISODES = 100  # of a random driver, in `luck`
RATES = Rates(0.3, 1.0, 0.05)
POINTS = 8  # of a curve


class Held(gymnasium.Wrapper):
    """An environment in which each action is held for some steps."""

    def __init__(self, env, steps):
        super().__init__(env)
        self.steps = steps

    def step(self, action):
        """As in Gymnasium; the reward is the sum over the steps."""
        total = 0.0
        for _ in range(self.steps):
            observation, reward, terminated, truncated, info = self.env.step(action)
            total += reward
            if terminated or truncated:
                break
        return observation, total, terminated, truncated, info


def environment(held=HELD):
    """The task with its actions held for so many steps."""
    return Held(gymnasium.make("MountainCar-v0", disable_env_checker=True), held)


def scene_of(observation, info):
    """The `Scene` of an observation: the car's place and velocity on a line."""
    return Scene(observation[:1].astype(float), observation[1:].astype(float))


def drive(runs, seed):
    """Steps per episode over the decisions taken: {driver: float64 (runs, POINTS)}."""
    agent = minds.driver()
    return {"neoRL": np.array([_lengths(play(agent, environment(), scene_of, steps=DECISIONS, seed=seed + run))
                               for run in range(runs)]),
            "Q-learning": np.array([_table(RATES, seed + run) for run in range(runs)]),
            "random": np.array([_table(Rates(0.0, 1.0, 1.0), seed + run) for run in range(runs)])}


def luck(seed):
    """Share of episodes in which a random driver reaches the flag: {steps for which actions are held: share}."""
    shares = {}
    for held in (1, HELD):
        env, rng, reached = environment(held), np.random.default_rng(seed), 0
        for episode in range(EPISODES):
            env.reset(seed=seed if episode == 0 else None)
            over = False
            while not over:
                _, _, terminated, truncated, _ = env.step(rng.integers(3))
                over = terminated or truncated
            reached += terminated
        shares[held] = reached / EPISODES
    return shares


def learned(seed):
    """A driver after all its decisions: a `neorl.Learner`."""
    return play(minds.driver(), environment(), scene_of, steps=DECISIONS, seed=seed).learner


def _table(rates, seed):
    """One run of Q-learning, or of a random driver, as `drive` returns it."""
    env, stream = environment(), new_stream(np.random.SeedSequence(seed))
    q = np.zeros((minds.COLUMNS * minds.ROWS, 3))
    rewards, ends = np.zeros(DECISIONS), np.zeros(DECISIONS, bool)
    cell = cell_of(*env.reset(seed=seed)[0])
    for now in range(DECISIONS):
        cell_tm1, action = cell, execute(exploring_action, q[cell], rates.exploration, stream)
        observation, rewards[now], reached, truncated, _ = env.step(action)
        cell, ends[now] = cell_of(*observation), reached or truncated
        execute(learn_q, q, cell_tm1, action, rewards[now], cell, reached, rates.learning_rate, rates.discount)
        if ends[now]:
            cell = cell_of(*env.reset()[0])
    return _by_decisions(rewards, ends)


def cell_of(place, velocity):
    """The number of the agent's cell for a place and a velocity."""
    column, row = ((value - low) / (high - low) * cells for value, (low, high), cells in (
        (place, minds.TRACK, minds.COLUMNS), (velocity, minds.SPEEDS, minds.ROWS)))
    return min(int(column), minds.COLUMNS - 1) + minds.COLUMNS * min(int(row), minds.ROWS - 1)


def _lengths(played):
    return _by_decisions(played.rewards, played.terminated | played.truncated)


def _by_decisions(rewards, ends):
    """Mean steps of the episodes that end in each stretch of the decisions: (POINTS,)."""
    last = np.flatnonzero(ends)
    steps = -np.diff(np.cumsum(rewards)[last], prepend=0.0)
    stretch = last * POINTS // DECISIONS
    return np.bincount(stretch, steps, POINTS) / np.bincount(stretch, minlength=POINTS)
