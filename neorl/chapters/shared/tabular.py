"""Tables of action values q[state, action], float64, and the two things that every tabular learner does with them.

A learner chooses, greedily or not, with ties drawn at random; and it moves a value towards what followed (Watkins 1989;
thesis eq. 3.5 and 4.6).
"""

from typing import NamedTuple

from neorl.core.kernel import kernel
from neorl.core.stream import randint, uniform


class Rates(NamedTuple):
    """How a tabular learner learns and explores, each from 0 to 1."""

    learning_rate: float  # α
    discount: float  # γ
    exploration: float  # ε


@kernel
def greedy_action(value, stream):
    """An action with the largest value, drawn where there are several."""
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
    """A greedy action, or with probability `exploration` (ε) any."""
    if uniform(stream) < exploration:
        return randint(stream, value.shape[0])
    return greedy_action(value, stream)


@kernel
def learn_q(q, state_tm1, action_tm1, reward_t, state_t, terminal, learning_rate, discount):
    """One update of Q-learning after a step; what follows a terminal state is worth nothing."""
    following = 0.0
    if not terminal:
        following = q[state_t, 0]
        for action in range(1, q.shape[1]):
            following = max(following, q[state_t, action])
    target = reward_t + discount * following
    q[state_tm1, action_tm1] += learning_rate * (target - q[state_tm1, action_tm1])
