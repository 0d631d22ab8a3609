"""Tabular learning with action values q[state, action], float64: select an action, update a value.

Selection is greedy or exploring, with ties broken at random; an update moves a value towards its target (Watkins 1989;
thesis eq. 3.5 and 4.6).
"""

from typing import NamedTuple

from neorl import kernel
from neorl.custom import randint, uniform


class Rates(NamedTuple):
    """The rates at which a tabular learner learns and explores, each from 0 to 1."""

    learning_rate: float  # α
    discount: float  # γ
    exploration: float  # ε


@kernel
def greedy_action(value, stream):
    """An action with the largest value; ties are broken at random."""
    best, ties = 0, 0
    for action in range(value.shape[0]):
        if ties == 0 or value[action] > value[best]:
            best, ties = action, 1
        elif value[action] == value[best]:
            ties += 1
            if randint(stream, ties) == 0:
                best = action
    return best


@kernel
def exploring_action(value, exploration, stream):
    """A greedy action, or with probability `exploration` (ε) a random one."""
    if uniform(stream) < exploration:
        return randint(stream, value.shape[0])
    return greedy_action(value, stream)


@kernel
def learn_q(q, state_tm1, action_tm1, reward_t, state_t, terminal, learning_rate, discount):
    """One update of Q-learning after a step; a terminal state has value 0."""
    following = 0.0
    if not terminal:
        following = q[state_t, 0]
        for action in range(1, q.shape[1]):
            following = max(following, q[state_t, action])
    target = reward_t + discount * following
    q[state_tm1, action_tm1] += learning_rate * (target - q[state_tm1, action_tm1])
