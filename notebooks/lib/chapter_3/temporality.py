"""Processes with memory: what came steps ago determines what comes next (thesis section 3.4.2, observation 1).

A *mechanism* of memory L shows one of Ψ symbols at each step, drawn uniformly, and pays 1 for naming its *outcome*, a
symbol that its last L symbols determine by one of `RULES`. A *history* is the last L symbols, as a number in base Ψ
whose last digit is the newest. The Ψ^L histories are the states of a Markov process; `states_needed` counts how many of
them have to be distinguished, by what follows them.

*Sticky actions* (Machado et al. 2018) are a memory of one step: with some probability the last action is repeated.
"""

import numpy as np

from lib.chapter_3.decision import Process
from neorl import checks

RULES = {
    "sum": "the sum of the last L symbols modulo Ψ",
    "delay": "the symbol that came L steps ago",
    "table": "a random symbol, fixed for each history",
    "pause": "1 after L symbols of 0 in a row, else 0",
}


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
    """`lib.chapter_3.decision.reaching`, but with probability `stickiness` the last action is repeated.

    Its states are pairs: state · actions + the last action. An episode starts as after any action. An agent that does
    not remember its last action sees ``numpy.arange(states * actions) // actions``.
    """
    states, actions = next_state.shape
    state, last = np.divmod(np.arange(states * actions), actions)
    chosen = next_state[state] * actions + np.arange(actions)
    again = np.broadcast_to((next_state[state, last] * actions + last)[:, None], chosen.shape)
    successors = np.stack([chosen, again], axis=2)
    value, ends = np.zeros(states), np.isin(np.arange(states), list(worth))
    value[list(worth)] = list(worth.values())
    return Process(successors, np.array([1 - stickiness, stickiness]), value[successors // actions], ends[state],
                   np.flatnonzero(~ends[state]))
