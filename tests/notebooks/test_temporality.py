"""Processes of chapter 3 that remember, against counts and exact values."""

import itertools

import numpy as np
import pytest

from companion.chapter_3 import decision
from companion.shared.grid import Grid

CLIFF = Grid(("....", ".CCG"))
WORTH = {CLIFF.marked("C")[0]: -1.0, CLIFF.marked("C")[1]: -1.0, CLIFF.marked("G")[0]: 1.0}


def test_histories_are_counted_in_base_psi_with_the_newest_last():
    digits = decision.symbols(3, 2)
    np.testing.assert_array_equal(digits @ [3, 1], np.arange(9))
    np.testing.assert_array_equal(digits[decision.next_histories(3, 2)[5]], [[2, 0], [2, 1], [2, 2]])  # 5 is 1, 2


@pytest.mark.parametrize("rule, history, outcome", [
    ("sum", [1, 2, 1], 1), ("sum", [2, 2, 2], 0), ("delay", [2, 0, 1], 2), ("pause", [0, 0, 0], 1),
    ("pause", [1, 0, 0], 0),
])
def test_outcomes(rule, history, outcome):
    assert decision.outcomes(3, 3, rule)[np.dot(history, [9, 3, 1])] == outcome


@pytest.mark.parametrize("rule, seed, needed", [("sum", 0, 2**4), ("delay", 0, 2**4), ("pause", 0, 4 + 1),
                                                ("table", 0, None), ("table", 1, None)])
def test_the_states_that_are_needed_are_those_that_futures_tell_apart(rule, seed, needed):
    """Brute force: the outcomes after every sequence of up to L symbols; L symbols replace a history completely."""
    memory, following = 4, decision.next_histories(2, 4)
    outcome = decision.outcomes(2, memory, rule, seed)
    futures = [outcome]
    for length in range(1, memory + 1):
        for sequence in itertools.product(range(2), repeat=length):
            at = np.arange(len(outcome))
            for symbol in sequence:
                at = following[at, symbol]
            futures.append(outcome[at])
    expected = len(np.unique(np.stack(futures), axis=1).T)
    assert decision.states_needed(following, outcome) == expected == (needed or expected)


def test_a_mechanism_pays_for_the_outcome_of_the_symbols_it_has_shown():
    memory = 3
    learned = decision.simulate(decision.mechanism(2, memory, "sum"), [2_000], 1, 0, discount=0.0)
    shown = learned.states_t[0] % 2
    sums = np.convolve(shown, np.ones(memory, int))[memory - 1 : -memory]
    np.testing.assert_array_equal(learned.rewards[0, memory:], learned.actions[0, memory:] == sums % 2)
    assert np.unique(learned.states_tm1).size == 2**memory


@pytest.mark.parametrize("rule", ["sum", "table"])
def test_a_short_window_earns_the_most_that_it_allows_and_a_full_one_everything(rule):
    outcome = decision.outcomes(2, 4, rule)
    for length in range(5):
        seen = decision.window(2, 4, length)
        learned = decision.simulate(decision.mechanism(2, 4, rule), [20_000], 2, 0, seen, discount=0.0)
        shares = outcome.reshape(-1, 2**length).mean(axis=0)  # of outcome 1, given what is seen
        best = np.maximum(shares, 1 - shares).mean()
        named = learned.q[:, -1].argmax(axis=-1)[:, seen]
        assert (named == outcome).mean(axis=-1) == pytest.approx(best)
    assert best == 1.0


def test_sticky_actions_repeat_the_last_one_as_often_as_they_should():
    process = decision.sticky(CLIFF.next_state, WORTH, 0.25)
    learned = decision.simulate(process, [40_000], 1, 0)
    taken, before = learned.states_t[0] % 4, learned.states_tm1[0] % 4
    unlike = learned.actions[0] != before
    assert (taken == before)[unlike].mean() == pytest.approx(0.25, abs=0.01)
    np.testing.assert_array_equal(taken[~unlike], before[~unlike])
    np.testing.assert_array_equal(CLIFF.next_state[learned.states_tm1[0] // 4, taken], learned.states_t[0] // 4)


def test_actions_that_do_not_stick_are_those_of_the_grid():
    plain = decision.plan(*decision.reaching(CLIFF.next_state, WORTH).expected(), 0.9)
    process = decision.sticky(CLIFF.next_state, WORTH, 0.0)
    np.testing.assert_allclose(decision.plan(*process.expected(), 0.9), np.repeat(plain, 4, axis=0))
    assert len(process.starts) == 4 * (CLIFF.states - 3)
