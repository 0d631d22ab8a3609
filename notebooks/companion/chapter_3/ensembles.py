"""Ensembles: five learners with the same experience, and four rules by which they act together (thesis section 3.3).

The rules, the task and its numbers are those of Wiering and van Hasselt (2008), Ensemble algorithms in reinforcement
learning. The agent walks a maze from start to goal, over and over; a step goes in a random direction with probability
0.2, whatever the action. The goal pays 100, a bump against a wall or the border −2, every other step −0.1. An episode
ends after 1,000 steps at most.

All five learners learn from every step: Q-learning and Sarsa have action values; the other three have a critic, a value
for each state: actor-critic, whose preferences accumulate the critic's temporal-difference errors (surprises);
QV-learning, whose action values are learned from the critic; and ACLA, a learning automaton that makes an action more
probable after a positive surprise and less after a negative one. The policy of a learner is proportional to
exp(greediness × preference). The rules:

1. *Majority voting*: the policy is proportional to exp(greediness × votes); a vote is drawn from a learner's policy.
2. *Rank voting*: the same with the sum of ranks, from 4 for a learner's most preferred action to 1 for its least.
3. *Boltzmann multiplication*: the product of the policies, to the power of the greediness.
4. *Boltzmann addition*: the sum of the policies, to the power of the greediness, which is 1.
"""

from typing import NamedTuple

import numpy as np

from companion.shared.runs import each_run
from companion.shared.tabular import learn_q
from neorl.core.stream import randint, new_stream, uniform
from neorl import kernel
from neorl.custom import execute

LEARNERS = ("Q-learning", "Sarsa", "actor–critic", "QV-learning", "ACLA")
RULES = ("majority voting", "rank voting", "Boltzmann multiplication", "Boltzmann addition")
CHOOSERS = (*LEARNERS, *RULES)
MAJORITY, RANK, MULTIPLICATION, ADDITION = range(len(LEARNERS), len(CHOOSERS))

LEARNING_RATES = np.array([0.2, 0.2, 0.1, 0.2, 0.005])
CRITIC_RATES = np.array([0.0, 0.0, 0.2, 0.2, 0.1])
DISCOUNTS = np.array([0.9, 0.9, 0.95, 0.9, 0.99])
GREEDINESS = np.array([1.0, 1.0, 1.0, 1.0, 9.0, 1.6, 0.6, 0.2, 1.0])  # inverse temperature of each chooser
SLIP, GOAL, BUMP, STEP = 0.2, 100.0, -2.0, -0.1
LIMIT, BINS = 1_000, 20
SQUARINGS = 10  # of exp(x / 1024)


def best_reward(maze):
    """The highest reward per step of any policy in the long run, by policy iteration (Howard 1960)."""
    (start,), (goal,) = maze.marked("S"), maze.marked("G")
    n = maze.states
    following = maze.transitions(SLIP)
    bumps = np.einsum("sas->sa", following)  # the probability of staying
    reward = STEP + (BUMP - STEP) * bumps + (GOAL - STEP) * following[:, :, goal]
    following[:, :, start] += following[:, :, goal]  # arrival leads back to the start
    following[:, :, goal] = 0
    each, policy, before = np.arange(n), np.zeros(n, int), None
    while before is None or np.any(policy != before):
        # The gain takes the place of the start's value, which is 0.
        equations = np.eye(n) - following[each, policy]
        equations[:, start] = 1
        value = np.linalg.solve(equations, reward[each, policy])
        gain, value[start] = value[start], 0
        worth = reward + following @ value
        better = worth.max(axis=1) > worth[each, policy] + 1e-9
        before, policy = policy, np.where(better, worth.argmax(axis=1), policy)
    return float(gain)


class Maze(NamedTuple):
    """A maze as the kernel takes it."""

    next_state: np.ndarray
    start: int
    goal: int


def run_ensemble(maze, chooser, *, steps, runs, seed=0):
    """Reward per step in each twentieth of ``runs`` runs of ``steps`` steps: float64 (runs, 20).

    maze: a `Grid` that marks one start, "S", and one goal, "G". chooser: one of `CHOOSERS`. Run k is
    the same for any number of runs.
    """
    edges = np.linspace(0, steps, BINS + 1).astype(int)
    rewards = np.zeros((runs, BINS))
    table = Maze(maze.next_state, *maze.marked("S"), *maze.marked("G"))

    def run_one(run):
        preferences = np.zeros((len(LEARNERS), maze.states, 4))
        preferences[-1] = 1 / 4
        stream = new_stream(np.random.SeedSequence(seed, spawn_key=(run,)))
        execute(_run, table, CHOOSERS.index(chooser), edges, stream, preferences,
                np.zeros((len(LEARNERS), maze.states)), np.zeros(4), np.zeros(4), rewards[run])

    each_run(run_one, runs)
    return rewards / np.diff(edges)


@kernel
def _run(maze, chooser, edges, stream, preferences, critics, weight, policy, rewards):
    """Run until the last edge; weight and policy (4,) are working memory."""
    start, goal = maze.start, maze.goal
    state_tm1, age = start, 0
    action_tm1 = _choice(preferences, state_tm1, chooser, stream, weight, policy)
    for part in range(rewards.shape[0]):
        for _ in range(edges[part], edges[part + 1]):
            direction = randint(stream, 4) if uniform(stream) < SLIP else action_tm1
            state_t, age = maze.next_state[state_tm1, direction], age + 1
            arrived = state_t == goal
            reward = GOAL if arrived else BUMP if state_t == state_tm1 else STEP
            rewards[part] += reward
            begins = arrived or age == LIMIT
            state_next = start if begins else state_t
            action_t = _choice(preferences, state_next, chooser, stream, weight, policy)
            for learner in range(preferences.shape[0]):
                if chooser == learner or chooser >= MAJORITY:
                    _learn(learner, preferences[learner], critics[learner], state_tm1, action_tm1, reward, state_t,
                           action_t, arrived)
            state_tm1, action_tm1 = state_next, action_t
            age = 0 if begins else age


@kernel
def _learn(learner, preference, critic, state_tm1, action_tm1, reward_t, state_t, action_t, terminal):
    """One update of a learner, given by its index in `LEARNERS`."""
    rate, discount = LEARNING_RATES[learner], DISCOUNTS[learner]
    if learner == 0:
        learn_q(preference, state_tm1, action_tm1, reward_t, state_t, terminal, rate, discount)
        return
    if learner == 1:  # out of time, no action is taken there; the first of the next episode stands in for it
        target = reward_t + (0.0 if terminal else discount * preference[state_t, action_t])
        preference[state_tm1, action_tm1] += rate * (target - preference[state_tm1, action_tm1])
        return
    target = reward_t + (0.0 if terminal else discount * critic[state_t])
    surprise = target - critic[state_tm1]
    critic[state_tm1] += CRITIC_RATES[learner] * surprise
    if learner == 2:
        preference[state_tm1, action_tm1] += rate * surprise
    elif learner == 3:
        preference[state_tm1, action_tm1] += rate * (target - preference[state_tm1, action_tm1])
    else:
        others = -preference[state_tm1, action_tm1]
        for action in range(4):
            others += preference[state_tm1, action]
        for action in range(4):
            if surprise >= 0:
                aim = 1.0 if action == action_tm1 else 0.0
            elif action == action_tm1:
                aim = 0.0
            else:
                aim = min(preference[state_tm1, action] / others, 1.0) if others > 0 else 1 / 3
            preference[state_tm1, action] += rate * (aim - preference[state_tm1, action])


@kernel
def _choice(preferences, state, chooser, stream, weight, policy):
    """An action drawn from the chooser's policy. `weight` is what a rule adds up over learners."""
    weight[:] = 0.0
    for learner in range(preferences.shape[0]):
        for action in range(4):
            policy[action] = GREEDINESS[learner] * preferences[learner, state, action]
        if chooser == MAJORITY or chooser == ADDITION:
            _to_policy(policy)
        if chooser == MAJORITY:
            weight[_drawn(policy, stream)] += 1
        elif chooser == RANK:
            for action in range(4):
                for other in range(4):  # tied actions share their ranks
                    weight[action] += 1 if policy[action] > policy[other] else 0.5 * (policy[action] == policy[other])
        elif chooser == MULTIPLICATION or chooser == ADDITION or chooser == learner:
            for action in range(4):
                weight[action] += policy[action]
    if chooser >= MAJORITY and chooser != ADDITION:
        for action in range(4):
            weight[action] *= GREEDINESS[chooser]
    if chooser != ADDITION:
        _to_policy(weight)
    return _drawn(weight, stream)


@kernel
def _to_policy(values):
    """Turn values into the probabilities exp(value) / Σ exp(value), in place."""
    highest = max(max(values[0], values[1]), max(values[2], values[3]))
    total = 0.0
    for action in range(4):
        values[action] = _exponential(values[action] - highest)
        total += values[action]
    for action in range(4):
        values[action] /= total


@kernel
def _exponential(x):
    """exp(x) for x ≤ 0 in arithmetic that is the same on any machine: its series at x / 1024, squared ten times."""
    if x < -50:
        return 0.0
    x /= 2**SQUARINGS
    y = 1 + x * (1 + x / 2 * (1 + x / 3 * (1 + x / 4 * (1 + x / 5))))
    for _ in range(SQUARINGS):
        y *= y
    return y


@kernel
def _drawn(weight, stream):
    """An action, drawn in proportion to the weights."""
    at = uniform(stream) * (weight[0] + weight[1] + weight[2] + weight[3])
    action = 0
    while action < 3 and at >= weight[action]:
        at -= weight[action]
        action += 1
    return action
