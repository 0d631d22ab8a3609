"""Finite Markov decision processes, solved by planning or by learning (thesis sections 3.1, 3.3 and 3.4.2).

Planning uses a known process: sweeps of the Bellman equation give values, values give a policy (Bellman 1957; eq. 3.7).
Learning starts without a model and uses each step: to update action values by Q-learning (Watkins 1989; eq. 4.6), or to
count transitions, which give a model to plan with.

Whatever the action, a step has one of the same few *outcomes*, each with its chance; the outcome determines the next
state and the reward. A state that ends an episode is followed by a start, and has value 0 itself.

What came steps ago makes a process with more states (observation 1). A *mechanism* of memory L shows one of Ψ symbols
at each step, drawn uniformly, and pays 1 for naming its *outcome*, a symbol that its last L symbols determine by one of
`RULES`. A *history* is the last L symbols, as a number in base Ψ whose last digit is the newest. The Ψ^L histories are
the states of a Markov process; `states_needed` counts how many of them have to be distinguished, by what follows them.
*Sticky actions* (Machado et al. 2018) are a memory of one step: with some probability the last action is repeated.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from companion.shared.tabular import Rates, exploring_action, learn_q
from neorl.common import checks
from neorl.core.stream import new_stream, randint, uniform
from neorl import kernel
from neorl.custom import execute

RULES = {
    "sum": "the sum of the last L symbols modulo Ψ",
    "delay": "the symbol that came L steps ago",
    "table": "a random symbol, fixed for each history",
    "pause": "1 after L symbols of 0 in a row, else 0",
}


@dataclass(frozen=True, eq=False)
class Process:
    """A Markov decision process."""

    successors: np.ndarray  # int64 (states, actions, outcomes), the next states
    chances: np.ndarray  # (outcomes,), which add up to 1
    rewards: np.ndarray  # (states, actions, outcomes)
    ends: np.ndarray  # bool (states,), whether a state ends the episode
    starts: np.ndarray  # the states in which an episode may begin, each equally likely

    def __eq__(self, other):
        return isinstance(other, Process) and all(map(np.array_equal, vars(self).values(), vars(other).values()))

    @property
    def states(self):
        """The number of states."""
        return self.successors.shape[0]

    @property
    def actions(self):
        """The number of actions."""
        return self.successors.shape[1]

    def expected(self):
        """The probability of each next state, (states, actions, states), and the expected reward, (states, actions).

        Both are 0 in states that end an episode.
        """
        goes_on = ~self.ends[:, None]
        probability = np.zeros((self.states, self.actions, self.states))
        for outcome, chance in enumerate(self.chances):
            np.add.at(probability, (*np.indices((self.states, self.actions)), self.successors[..., outcome]), chance)
        return probability * goes_on[..., None], self.rewards @ self.chances * goes_on


def reaching(next_state, worth, slip=0.0, starts=None):
    """A `Process` that pays a reward at certain states and ends there.

    worth: {state: reward}. slip: the probability that a step takes a random action instead. starts: list of states; by
    default all that do not end an episode.
    """
    states, actions = next_state.shape
    value, ends = _ending(states, worth)
    slipped = np.broadcast_to(next_state[:, None], (states, actions, actions))
    successors = np.concatenate([next_state[..., None], slipped], axis=2)
    return Process(successors, np.array([1 - slip] + [slip / actions] * actions), value[successors], ends,
                   np.flatnonzero(~ends) if starts is None else np.array(starts))


def _ending(states, worth):
    """What each state pays, and whether it ends the episode, both (states,), from {state: reward}."""
    value, ends = np.zeros(states), np.isin(np.arange(states), list(worth))
    value[list(worth)] = list(worth.values())
    return value, ends


def lattice(side, dimensions):
    """The next state after each action on a grid of any dimension: int64 (side ** dimensions, 2 * dimensions).

    The actions go up and down each axis in turn; a step over the border leaves the state unchanged.
    """
    shape = (side,) * dimensions
    places = np.indices(shape).reshape(dimensions, -1)
    moves = [sign * axis for axis in np.eye(dimensions, dtype=int) for sign in (1, -1)]
    return np.stack([np.ravel_multi_index(places + move[:, None], shape, mode="clip") for move in moves], axis=1)


def symbols(alphabet, memory):
    """The symbols of each history, the newest last: int64 (alphabet ** memory, memory)."""
    checks.integer("memory", memory, at_least=1)
    return np.indices((alphabet,) * memory).reshape(memory, -1).T


def next_histories(alphabet, memory):
    """The history that follows each history with each symbol: int64 (alphabet ** memory, alphabet)."""
    histories = alphabet**memory
    return (np.arange(histories)[:, None] * alphabet + np.arange(alphabet)) % histories


def outcomes(alphabet, memory, rule, seed=0):
    """The outcome of each history by one of `RULES`: int64 (alphabet ** memory,)."""
    digits = symbols(alphabet, memory)
    if rule == "sum":
        return digits.sum(axis=1) % alphabet
    if rule == "delay":
        return digits[:, 0]
    if rule == "table":
        return np.random.default_rng(seed).integers(alphabet, size=len(digits))
    return (digits == 0).all(axis=1).astype(int)


def states_needed(following, outcome):
    """The number of states needed to predict all outcomes: the size of the smallest equivalent machine.

    Two histories are one state if they have the same outcome now, and after every sequence of symbols. Histories are
    split until no symbol leads from one class to two (Moore 1956).
    """
    label = np.unique(outcome, return_inverse=True)[1]
    while True:
        distinguished = np.column_stack([label, label[following]])
        finer = np.unique(distinguished, axis=0, return_inverse=True)[1].ravel()
        if finer.max() == label.max():
            return int(label.max()) + 1
        label = finer


def mechanism(alphabet, memory, rule, seed=0):
    """A `Process` whose states are histories and whose action names the outcome."""
    outcome = outcomes(alphabet, memory, rule, seed)
    histories, shape = len(outcome), (len(outcome), alphabet, alphabet)
    right = outcome[:, None, None] == np.arange(alphabet)[:, None]
    return Process(np.broadcast_to(next_histories(alphabet, memory)[:, None], shape).copy(),
                   np.full(alphabet, 1 / alphabet), np.broadcast_to(right, shape).astype(float),
                   np.zeros(histories, bool), np.arange(histories))


def window(alphabet, memory, length):
    """What an agent that remembers `length` symbols sees of each history."""
    return np.arange(alphabet**memory) % alphabet**length


def sticky(next_state, worth, stickiness):
    """`reaching`, but with probability `stickiness` the last action is repeated.

    Its states are pairs: state · actions + the last action. An episode starts as after any action. An agent that does
    not remember its last action sees ``numpy.arange(states * actions) // actions``.
    """
    states, actions = next_state.shape
    state, last = np.divmod(np.arange(states * actions), actions)
    chosen = next_state[state] * actions + np.arange(actions)
    again = np.broadcast_to((next_state[state, last] * actions + last)[:, None], chosen.shape)
    successors = np.stack([chosen, again], axis=2)
    value, ends = _ending(states, worth)
    return Process(successors, np.array([1 - stickiness, stickiness]), value[successors // actions], ends[state],
                   np.flatnonzero(~ends[state]))


def action_values(probability, reward, values, discount):
    """The value of each action if the next states have `values`, (…, states): the right side of eq. 3.7.

    probability: (…, states, actions, states). reward, and the result: (…, states, actions).
    """
    states, actions = reward.shape[-2:]
    flat = probability.reshape(*probability.shape[:-3], states * actions, states)
    return reward + discount * (flat @ values[..., None]).reshape(reward.shape)


def policy_values(process, policy, discount):
    """The value of each state under policies, (…, states): the solution of eq. 3.7."""
    policies = policy.reshape(-1, process.states)
    each, goes_on = np.arange(process.states), ~process.ends
    following = process.successors[each, policies].reshape(len(policies), -1)
    paid = process.rewards[each, policies] @ process.chances * goes_on
    values, change = paid, np.inf
    while change > 1e-10 * (1 - discount) * np.abs(values).max():
        after = np.take_along_axis(values, following, axis=1).reshape(*values.shape, -1) @ process.chances
        before, values = values, paid + discount * after * goes_on
        change = np.abs(values - before).max()
    return values.reshape(policy.shape)


class Stage(NamedTuple):
    """Values and policy after an evaluation or an improvement of policy iteration."""

    values: np.ndarray  # (states,)
    policy: np.ndarray  # (states,), actions


def policy_iteration(probability, reward, discount, sweeps):
    """Alternate evaluation and improvement until neither changes anything: a list of `Stage`, the start first.

    It starts from values of 0 and the policy that always takes action 0. An evaluation is that many sweeps of eq. 3.7.
    An improvement replaces an action only by one of higher value. Two stages make an iteration.
    """
    each = np.arange(len(reward))
    values, policy = np.zeros(len(reward)), np.zeros(len(reward), int)
    stages = [Stage(values, policy)]
    while True:
        for _ in range(sweeps):
            values = action_values(probability, reward, values, discount)[each, policy]
        stages.append(Stage(values, policy))
        q = action_values(probability, reward, values, discount)
        better = q.max(axis=1) > q[each, policy] + 1e-12
        policy = np.where(better, q.argmax(axis=1), policy)
        stages.append(Stage(values, policy))
        if np.abs(q[each, policy] - values).max() < 1e-9:
            return stages


def plan(probability, reward, discount, sweeps=200):
    """The best action values, by sweeps of the Bellman optimality equation: float64 (…, states, actions).

    Value iteration (Sutton and Barto 2018, section 4.4), with arguments as in `action_values`.
    """
    q = np.zeros(reward.shape)
    for _ in range(sweeps):
        q = action_values(probability, reward, q.max(axis=-1), discount)
    return q


class Experience(NamedTuple):
    """The steps of learners, (runs, steps), with states as they see them."""

    states_tm1: np.ndarray
    actions: np.ndarray
    rewards: np.ndarray
    states_t: np.ndarray
    q: np.ndarray  # float64 (runs, checkpoints, states seen, actions)
    ran: tuple  # (process, seen, `Rates`), as given to `simulate`, with what is seen of each state as a tuple


class ProcessArrays(NamedTuple):
    """A `Process` as the kernel takes it, and its states as a learner sees them."""

    successors: np.ndarray
    limits: np.ndarray  # float64 (outcomes − 1,), thresholds between outcomes of a draw from [0, 1)
    rewards: np.ndarray
    ends: np.ndarray
    starts: np.ndarray
    seen: np.ndarray


class Path(NamedTuple):
    """The part of an `Experience` that a kernel fills in, each (steps,)."""

    states_tm1: np.ndarray
    actions: np.ndarray
    rewards: np.ndarray
    states_t: np.ndarray


def simulate(process, checkpoints, runs, seed, seen=None, learning_rate=0.0, discount=0.9, exploration=1.0):
    """Run Q-learners, each in its own copy of a process: their `Experience` up to the last checkpoint.

    checkpoints: the numbers of steps after which to keep a copy of q, rising. seen: what a learner sees of each state,
    integers (states,) from 0; by default the state. learning_rate: an action taken for the n-th time in a state is
    learned at the rate 1 / n, but never at less than this. exploration: the probability that an action is drawn at
    random (ε); at 1, behaviour does not depend on what is learned.
    Raises ValueError for more than 32,767 states.
    """
    checks.integer("states", process.states, at_least=1, at_most=np.iinfo(np.int16).max)  # grows with a page's memory
    steps = [0, *map(int, checkpoints)]
    seen = np.arange(process.states) if seen is None else np.asarray(seen)
    rates = Rates(float(learning_rate), float(discount), float(exploration))
    experience = Experience(
        *(np.zeros((runs, steps[-1]), kind) for kind in (np.int16, np.int8, np.float32, np.int16)),
        np.zeros((runs, len(checkpoints), seen.max() + 1, process.actions)), (process, tuple(seen.tolist()), rates))
    table = ProcessArrays(process.successors, np.cumsum(process.chances)[:-1], process.rewards, process.ends,
                          process.starts, seen)
    for run in range(runs):
        stream = new_stream(np.random.SeedSequence(seed, spawn_key=(run,)))
        q, visits = np.zeros(experience.q.shape[2:]), np.zeros(experience.q.shape[2:])
        state = process.starts[execute(randint, stream, len(process.starts))]
        for checkpoint, (begin, end) in enumerate(zip(steps, steps[1:])):
            path = Path(*(each[run, begin:end] for each in experience[:4]))
            state = execute(_run_on, table, rates, state, q, visits, stream, path)
            experience.q[run, checkpoint] = q
    return experience


@kernel
def _run_on(table, rates, state, q, visits, stream, path):
    """Take as many steps as the path has room for, and return the state after the last."""
    seen, limits = table.seen, table.limits
    for step in range(path.rewards.shape[0]):
        action = exploring_action(q[seen[state]], rates.exploration, stream)
        drawn, outcome = uniform(stream), 0
        while outcome < limits.shape[0] and drawn >= limits[outcome]:
            outcome += 1
        next_state, reward = table.successors[state, action, outcome], table.rewards[state, action, outcome]
        visits[seen[state], action] += 1
        rate = max(rates.learning_rate, 1.0 / visits[seen[state], action])
        learn_q(q, seen[state], action, reward, seen[next_state], table.ends[next_state], rate, rates.discount)
        path.states_tm1[step], path.actions[step], path.rewards[step] = seen[state], action, reward
        path.states_t[step] = seen[next_state]
        state = table.starts[randint(stream, table.starts.shape[0])] if table.ends[next_state] else next_state
    return state


def count_transitions(experience, steps):
    """Transitions from state by action to state in the first steps: int64 (runs, states, actions, states)."""
    runs, _, states, actions = experience.q.shape
    pairs, following = _pairs(experience, steps), experience.states_t[:, :steps].ravel()
    counts = np.bincount(pairs * states + following, minlength=runs * states * actions * states)
    return counts.reshape(runs, states, actions, states)


def learned_model(experience, steps):
    """The model of a process from the first steps of each run, as `Process.expected` has it."""
    counts = count_transitions(experience, steps)
    tried = np.maximum(counts.sum(axis=-1), 1)
    paid = np.bincount(_pairs(experience, steps), weights=experience.rewards[:, :steps].ravel(), minlength=tried.size)
    return counts / tried[..., None], paid.reshape(tried.shape) / tried


def first_visits(experience):
    """The step at which each action is first taken in each state, or 0: int64 (runs, states, actions)."""
    runs, steps = experience.actions.shape
    first = np.zeros((runs, *experience.q.shape[2:]), int)
    backwards = _pairs(experience, steps)[::-1]  # of several visits the last one written remains
    first.ravel()[backwards] = np.tile(np.arange(steps, 0, -1), runs)
    return first


def _pairs(experience, steps):
    """Run, state and action of each step as one number, (runs * steps,)."""
    runs, _, states, actions = experience.q.shape
    run = np.arange(runs)[:, None] * states
    return ((run + experience.states_tm1[:, :steps]) * actions + experience.actions[:, :steps]).ravel()


def time_to(good, checkpoints):
    """The first checkpoint at which each run is good, the last if it never is: (runs,)."""
    return np.asarray(checkpoints)[np.where(good.any(axis=1), good.argmax(axis=1), -1)]
