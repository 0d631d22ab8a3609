"""Processes that remember, against counts and exact values."""

import itertools

import numpy as np
import pytest
from matplotlib import pyplot as plt

from lib.chapter_3 import decision, decision_figures, temporality
from lib.shared.grid import Grid
from neorl.drawing.style import FILL

CLIFF = Grid(("....", ".CCG"))
WORTH = {CLIFF.marked("C")[0]: -1.0, CLIFF.marked("C")[1]: -1.0, CLIFF.marked("G")[0]: 1.0}


def test_histories_are_counted_in_base_psi_with_the_newest_last():
    digits = temporality.symbols(3, 2)
    np.testing.assert_array_equal(digits @ [3, 1], np.arange(9))
    np.testing.assert_array_equal(digits[temporality.next_histories(3, 2)[5]], [[2, 0], [2, 1], [2, 2]])  # 5 is 1, 2


@pytest.mark.parametrize("rule, history, outcome", [
    ("sum", [1, 2, 1], 1), ("sum", [2, 2, 2], 0), ("delay", [2, 0, 1], 2), ("pause", [0, 0, 0], 1),
    ("pause", [1, 0, 0], 0),
])
def test_outcomes(rule, history, outcome):
    assert temporality.outcomes(3, 3, rule)[np.dot(history, [9, 3, 1])] == outcome


def test_a_table_is_fixed_by_its_seed():
    table = temporality.outcomes(2, 8, "table", seed=1)
    np.testing.assert_array_equal(table, temporality.outcomes(2, 8, "table", seed=1))
    assert (table != temporality.outcomes(2, 8, "table", seed=2)).any() and 90 < table.sum() < 166


@pytest.mark.parametrize("rule, needed", [("sum", 3**4), ("delay", 3**4), ("pause", 4 + 1)])
def test_the_states_that_are_needed(rule, needed):
    assert temporality.states_needed(temporality.next_histories(3, 4), temporality.outcomes(3, 4, rule)) == needed


@pytest.mark.parametrize("rule, seed", [("table", 0), ("table", 1), ("table", 2), ("pause", 0), ("sum", 0)])
def test_the_states_that_are_needed_are_those_that_futures_tell_apart(rule, seed):
    """Brute force: the outcomes after every sequence of up to L symbols; L symbols replace a history completely."""
    memory, following = 4, temporality.next_histories(2, 4)
    outcome = temporality.outcomes(2, memory, rule, seed)
    futures = [outcome]
    for length in range(1, memory + 1):
        for sequence in itertools.product(range(2), repeat=length):
            at = np.arange(len(outcome))
            for symbol in sequence:
                at = following[at, symbol]
            futures.append(outcome[at])
    expected = len(np.unique(np.stack(futures), axis=1).T)
    assert temporality.states_needed(following, outcome) == expected


@pytest.mark.parametrize("call, message", [
    (lambda: temporality.symbols(1, 2), "alphabet must be .*, but is 1"),
    (lambda: temporality.symbols(2, 0), "memory must be .*, but is 0"),
    (lambda: temporality.outcomes(2, 2, "product"), "rule must be 'sum', 'delay', 'table' or 'pause', but is 'produc"),
    (lambda: temporality.window(2, 3, 4), "length must be an integer from 0 to 3, but is 4"),
    (lambda: temporality.sticky(CLIFF.next_state, WORTH, 1.5), "stickiness must be .*, but is 1.5"),
])
def test_a_bad_process_is_refused(call, message):
    with pytest.raises(ValueError, match=message):
        call()


def test_rules_by_which_nothing_can_be_lumped_need_every_history():
    least = {"sum": [2, 4, 8], "table": [2, 4, 7], "delay": [2, 4, 8]}
    assert temporality.unlumpable(np.arange(1, 4), least) == ["sum", "delay"]


def test_the_memory_for_a_number_of_histories():
    assert 2 ** temporality.memory_for(6) == pytest.approx(1e6)


def test_a_mechanism_pays_for_the_outcome_of_the_symbols_it_has_shown():
    memory = 3
    lived = decision.live(temporality.mechanism(2, memory, "sum"), [2_000], 1, 0, discount=0.0)
    shown = lived.states_t[0] % 2
    sums = np.convolve(shown, np.ones(memory, int))[memory - 1 : -memory]
    np.testing.assert_array_equal(lived.rewards[0, memory:], lived.actions[0, memory:] == sums % 2)
    assert np.unique(lived.states_tm1).size == 2**memory


def test_states_are_met_as_fast_as_coupons_are_collected():
    n = 64  # neighbouring histories overlap, which costs little; the last of n coupons is due after n (ln n + 0.577)
    lived = decision.live(temporality.mechanism(2, 6, "sum"), [4_000], 40, 0, discount=0.0)
    last = [np.unique(path, return_index=True)[1].max() for path in lived.states_tm1]
    assert np.mean(last) == pytest.approx(n * (np.log(n) + 0.577), rel=0.2)


@pytest.mark.parametrize("rule", ["sum", "table"])
def test_a_short_window_earns_the_most_that_it_allows_and_a_full_one_everything(rule):
    outcome = temporality.outcomes(2, 4, rule)
    for length in range(5):
        lived = decision.live(temporality.mechanism(2, 4, rule), [20_000], 2, 0, temporality.window(2, 4, length),
                              discount=0.0)
        shares = outcome.reshape(-1, 2**length).mean(axis=0)  # of outcome 1, given what is seen
        best = np.maximum(shares, 1 - shares).mean()
        assert temporality.hits(lived, 2, 4, rule, length)[:, -1] == pytest.approx(best)
    assert best == 1.0


def test_sticky_actions_repeat_the_last_one_as_often_as_they_should():
    process = temporality.sticky(CLIFF.next_state, WORTH, 0.25)
    lived = decision.live(process, [40_000], 1, 0)
    taken, before = lived.states_t[0] % 4, lived.states_tm1[0] % 4
    unlike = lived.actions[0] != before
    assert (taken == before)[unlike].mean() == pytest.approx(0.25, abs=0.01)
    np.testing.assert_array_equal(taken[~unlike], before[~unlike])
    np.testing.assert_array_equal(CLIFF.next_state[lived.states_tm1[0] // 4, taken], lived.states_t[0] // 4)


def test_actions_that_do_not_stick_are_those_of_the_grid():
    plain = decision.plan(*decision.reaching(CLIFF.next_state, WORTH).expected(), 0.9)
    process = temporality.sticky(CLIFF.next_state, WORTH, 0.0)
    np.testing.assert_allclose(decision.plan(*process.expected(), 0.9), np.repeat(plain, 4, axis=0))
    assert len(process.starts) == 4 * (CLIFF.states - 3)


def test_shares_of_the_best_return_are_those_of_learners_with_that_floor_and_that_view():
    process = temporality.sticky(CLIFF.next_state, WORTH, 0.25)
    pairs = np.arange(process.states)
    shares = temporality.shares_by_floor(process, 0.5, (0.02, 0.9), steps=300, runs=2, seed=1, discount=0.9)
    for floor, both in shares.items():
        for seen, share in zip((pairs // 4, pairs), both, strict=True):
            lived = decision.live(process, [300], 2, 1, seen, learning_rate=floor, discount=0.9)
            values = decision.policy_values(process, lived.q[:, 0].argmax(axis=-1)[:, seen], 0.9)
            np.testing.assert_allclose(share, values[:, process.starts].mean(axis=1) / 0.5)
    assert len({tuple(share) for both in shares.values() for share in both}) == 4


def test_the_last_action_matters_only_if_actions_stick():
    values = decision.plan(*temporality.sticky(CLIFF.next_state, WORTH, 0.25).expected(), 0.9).max(axis=1)
    by_place = values.reshape(-1, 4)
    above_the_cliff = 1
    assert by_place[above_the_cliff, 1] < by_place[above_the_cliff, 2] - 0.1  # coming from the north, it may fall


def test_means_are_drawn_with_their_names_and_on_powers_of_ten():
    xs, values = np.array([1, 10, 100]), np.array([[10.0, 100.0, 1_000.0], [30.0, 300.0, 3_000.0]])
    decision_figures.draw_means({"one": (xs, values), "half": (xs[:2], values[:, :2])}, "x", "y", logs="xy", marks=True,
                                guides=[(xs, xs)])
    axes = plt.gca()
    guide, one, half = axes.lines
    np.testing.assert_allclose(one.get_xydata(), [[0, np.log10(20)], [1, np.log10(200)], [2, np.log10(2_000)]])
    np.testing.assert_allclose(guide.get_xydata(), [[0, 0], [1, 1], [2, 2]])
    assert len(half.get_xdata()) == 2
    assert [text.get_text() for text in axes.texts] == ["one", "half"]
    assert axes.texts[1].xy == pytest.approx((1, np.log10(200)))
    assert axes.yaxis.get_major_formatter()(3, 0) == "$10^{3}$"


def test_plans_are_shaded_by_value_and_show_the_marks_of_the_grid():
    _, panels = plt.subplots(1, 2)
    values = np.linspace(0, 1, CLIFF.states)
    decision_figures.draw_plans(panels, CLIFF, {"a": (values, None), "b": (values / 2, np.eye(CLIFF.states)[:, :4])})
    fills = [[patch.get_alpha() for patch in axes.patches[-CLIFF.states:]] for axes in panels]
    np.testing.assert_allclose(fills[0], FILL * values)
    np.testing.assert_allclose(fills[1], FILL / 2 * values)
    assert [text.get_text() for text in panels[0].texts] == ["C", "C", "G"]
    assert not panels[0].collections and panels[1].collections


def test_the_other_drawings_show_what_they_are_given():
    decision_figures.draw_loop()
    assert "agent" in [text.get_text() for text in plt.gca().texts]
    decision_figures.draw_alternation([1.0, 0.0625, 0.5], [0.0, 0.2, 0.0])
    np.testing.assert_allclose(plt.gca().lines[0].get_xdata(), [1.0, 0.5, 0.5**0.25])
    assert {text.get_text(): text.xy[0] for text in plt.gca().texts}["start"] == 1.0
    decision_figures.draw_trend([1970, 1972], [10, 20], [11, 22])
    np.testing.assert_allclose(plt.gca().lines[1].get_ydata(), [11, 22])
    decision_figures.draw_activations(np.array([-1.0, 0, 1]), np.array([0.0, 0, 1]), np.array([0.0, 0, 1]), [0.0, 1.0])
    np.testing.assert_allclose(plt.gcf().axes[0].lines[1].get_xdata(), [-0.5, 0.5])
    decision_figures.draw_pattern(np.array([[0.0, 1.0], [0.5, 0.5]]), np.array([-1, 1]), {"line": (1.0, 2.0, 0.5)})
    np.testing.assert_allclose(plt.gca().lines[-1].get_ydata(), [0.25, -0.75])  # x + 2 y + 0.5 = 0 at −1 and 1
