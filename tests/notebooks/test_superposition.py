"""Sums of functions of one variable, and of value functions, against exact results."""

import itertools

import numpy as np
import pytest

from lib.chapter_4 import potentials
from lib.chapter_4.superposition import AXES, exact_sums, fit_ridges
from lib.shared.grid import Grid
from neorl.core.horde import learn

SIDE = np.linspace(-1, 1, 31)
X, Y = np.meshgrid(SIDE, SIDE)
N5 = Grid((".....",) * 5)


def test_a_product_is_the_sum_of_two_ridges_at_right_angles():
    ridges = fit_ridges(X * Y, terms=2)
    assert ridges.errors[0] == 1 and ridges.errors[1] > 0.3 and ridges.errors[2] < 1e-9
    np.testing.assert_allclose(np.sort(ridges.angles), np.pi * np.array([1, 3]) / 4)


def test_a_single_ridge_is_found_at_its_angle():
    angle = np.pi / 6
    ridges = fit_ridges((X * np.cos(angle) + Y * np.sin(angle)) ** 3, terms=1)
    assert ridges.angles[0] == pytest.approx(angle) and ridges.errors[1] < 1e-9


def test_no_sum_of_functions_of_the_coordinates_makes_a_product():
    ridges = fit_ridges(X * Y, 2, AXES)
    np.testing.assert_allclose(ridges.errors, 1)


def test_the_error_is_the_residual_of_a_least_squares_fit_of_all_ridges_together():
    values = np.exp(-3 * ((X - 0.4) ** 2 + (Y + 0.1) ** 2))
    ridges = fit_ridges(values, terms=3)
    basis = np.hstack([np.vander((X * np.cos(a) + Y * np.sin(a)).ravel(), 11) for a in ridges.angles])
    fit = basis @ np.linalg.lstsq(basis, values.ravel())[0]
    assert ridges.errors[3] == pytest.approx((values.ravel() - fit).std() / values.std(), rel=1e-5)


@pytest.mark.parametrize("values, terms, message", [
    (np.ones((4, 4)), 1, "values has the shape"), (np.ones((4, 5)), 1, "values has the shape"),
    (X, 0, "terms must be .*, but is 0"),
    (np.full((4, 4), np.nan), 1, r"values must be finite numbers from -1e\+30 to 1e\+30, but is array\(\[\[nan, nan, "),
])
def test_a_fit_refuses_values_that_are_no_function_on_a_square(values, terms, message):
    with pytest.raises(ValueError, match=message):
        fit_ridges(values, terms)


def test_some_functions_show_their_sum_at_a_glance():
    found = exact_sums(X, Y)
    assert list(found) == ["product of x and y", "larger of x and y", "distance from 0"]
    for function, _, total in found.values():
        np.testing.assert_allclose(total, function, atol=1e-12)
    assert [function[0, -1] for function, *_ in found.values()] == pytest.approx([-1, 1, 2**0.5])  # x = 1, y = −1


def test_the_value_of_a_single_goal_falls_by_the_discount_with_each_step():
    goal = 7
    q = potentials.plan(N5, np.eye(25)[goal], discount=0.8)
    distance = np.abs(N5.places - N5.places[goal]).sum(axis=1)
    away = distance > 0
    np.testing.assert_allclose(q.max(axis=1)[away], 0.8 ** (distance[away] - 1) / (1 - 0.8**2))
    assert q[goal].max() == pytest.approx(0.8 / (1 - 0.8**2))  # out and in again


def test_a_step_into_a_wall_enters_nothing():
    q = potentials.plan(N5, np.eye(25)[0], discount=0.5)
    assert q[0, 0] == q[0, 3] == pytest.approx(0.5 * q[0].max())


def test_the_best_values_are_those_of_the_best_of_all_policies():
    corridor = Grid(("...",))
    rewards = np.array([1.0, -0.5, 0.3])
    best = np.max([potentials.evaluate(corridor, np.eye(4)[list(policy)], rewards)
                   for policy in itertools.product(range(4), repeat=3)], axis=0)
    np.testing.assert_allclose(potentials.plan(corridor, rewards).max(axis=1), best)


def test_values_of_a_policy_add_up_over_rewards_and_optimal_values_do_not():
    policy = np.full((25, 4), 0.25)
    rewards = np.eye(25)[[0, 4, 12]]
    alone = potentials.evaluate(N5, np.stack([policy] * 3), rewards)
    np.testing.assert_allclose(alone.sum(axis=0), potentials.evaluate(N5, policy, rewards.sum(axis=0)))
    sums, together = potentials.plan(N5, rewards).sum(axis=0), potentials.plan(N5, rewards.sum(axis=0))
    assert np.all(sums >= together - 1e-9) and (sums - together).max() > 0.5


def test_the_values_of_drawn_actions_add_up():
    assert potentials.error_of_sum(N5, np.eye(25)[3] - np.eye(25)[20]) < 1e-12


def test_the_sum_would_be_off_if_values_of_drawn_actions_did_not_add_up(monkeypatch):
    monkeypatch.setattr(potentials, "evaluate", lambda grid, policy, rewards: rewards.sum(axis=-1) ** 2 * np.ones(25))
    assert potentials.error_of_sum(N5, np.eye(25)[0] + np.eye(25)[1]) == 2


def test_several_actions_may_be_best():
    q = np.array([[1.0, 1.0, 0.5, 1 - 1e-12], [0.0, 0.2, 0.1, 0.2]])
    assert potentials.best_actions(q).tolist() == [[True, True, False, True], [False, True, False, True]]


def test_a_sum_misleads_where_one_of_its_best_actions_is_not_best_by_the_plan():
    planned = np.array([[1.0, 1, 0, 0]] * 4)
    added = np.array([[1.0, 1, 0, 0], [1, 0, 0, 0], [0, 1, 1, 0], [0, 0, 1, 0]])
    assert potentials.misled(added, planned, elements=[3]) == [2]
    assert potentials.misled(added, planned, elements={}) == [2, 3]


def test_the_horde_learns_towards_each_goal_what_planning_finds():
    """On a random walk with one step per cell, equal up to the factor for entering the goal again and again."""
    rng, q, state = np.random.default_rng(0), np.zeros((9, 4, 9), np.float32), 0
    n3 = Grid(("...",) * 3)
    for _ in range(4_000):
        action = rng.integers(4)
        following = n3.next_state[state, action]
        if following != state:
            learn(q, state, following, np.eye(4)[action], learning_rate=0.5)
        state = following
    exact = potentials.plan(n3, np.eye(9)).transpose(1, 2, 0) * (1 - 0.8**2)
    moves = (n3.next_state != np.arange(9)[:, None])[:, :, None]
    np.testing.assert_allclose(np.where(moves, q, 0), np.where(moves, exact, 0), atol=1e-3)


def test_one_or_two_equal_elements_are_pursued_as_planned():
    for count in (1, 2):
        comparison = potentials.compare(N5, [1.0] * count, placements=50)
        np.testing.assert_allclose([comparison.agreement, comparison.achieved], 1)
        assert np.all(comparison.at_random < 0.5)


def test_a_comparison_is_that_of_superposed_and_planned_actions():
    comparison = potentials.compare(N5, [1, 1, 1, -1], placements=1, seed=5)
    states = np.random.default_rng(5).choice(25, 4, replace=False)
    rewards = np.zeros(25)
    rewards[states] = 1, 1, 1, -1
    sums = sum(reward * potentials.plan(N5, goal) for reward, goal in zip(rewards, np.eye(25)))
    best = potentials.plan(N5, rewards)
    outside = [state for state in range(25) if state not in states]
    agreed = [np.isclose(best[s], best[s].max())[np.isclose(sums[s], sums[s].max())].mean() for s in outside]
    assert comparison.agreement[0] == pytest.approx(np.mean(agreed)) and np.mean(agreed) < 1
    followed = potentials.evaluate(N5, potentials.greedy(sums), rewards)[outside].sum()
    assert comparison.achieved[0] == pytest.approx(followed / best.max(axis=1)[outside].sum())


def test_the_loss_is_a_share_of_the_average_return_of_the_plan():
    """In a corridor of three, a desired cell may lie behind a feared one; the plan then stays and earns nothing."""
    corridor = Grid(("...",))
    assert potentials.plan(corridor, [0, -1, 1])[0].max() == pytest.approx(0)
    comparison = potentials.compare(corridor, [1.0, -1.0], placements=200)
    assert np.isfinite(comparison).all() and comparison.achieved.max() == pytest.approx(1)
    assert np.mean(comparison.at_random) < np.mean(comparison.achieved) < 1


def test_placements_are_drawn_and_the_same_each_time():
    one, two = (potentials.compare(N5, [1, 1, -1], placements=30) for _ in range(2))
    np.testing.assert_array_equal(one.achieved, two.achieved)
    assert len(set(one.achieved.round(6))) > 20


def test_many_wanted_and_few_among_feared_are_compared_under_other_discounts():
    found = potentials.compare_discounts(N5, placements=3, seed=2, discounts=(0.5, 0.9))
    assert list(found) == [0.5, 0.9]
    for discount, (many, few) in found.items():
        for comparison, valences in ((many, [1, 1, 1, 1, 1, 1]), (few, [1, -1, -1])):
            expected = potentials.compare(N5, valences, 3, seed=2, discount=discount)
            np.testing.assert_array_equal(comparison, expected)


def test_cosines_are_those_of_the_angles():
    vectors = np.array([[1.0, 0], [0, 2], [3, 3]])
    assert not potentials.cosines(np.zeros((2, 3))).any()
    np.testing.assert_allclose(potentials.cosines(vectors), [[1, 0, 0.5**0.5], [0, 1, 0.5**0.5],
                                                             [0.5**0.5, 0.5**0.5, 1]], atol=1e-12)


@pytest.mark.parametrize("call, message", [
    (lambda: potentials.plan(N5, np.ones(24)), r"rewards has the shape \(24,\), allowed are \(…, 25\)"),
    (lambda: potentials.plan(N5, np.full(25, np.nan)), r"rewards must be finite numbers from -1e\+30 to 1e\+30, but i"),
    (lambda: potentials.plan(N5, np.ones(25), 1.0), "discount must be .*, but is 1.0"),
    (lambda: potentials.compare(N5, [-1], 3), "valences is"), (lambda: potentials.compare(N5, [1] * 25, 3), "valences"),
    (lambda: potentials.compare(N5, [1], 0), "placements must be .*, but is 0"),
])
def test_a_bad_argument_is_refused(call, message):
    with pytest.raises(ValueError, match=message):
        call()
