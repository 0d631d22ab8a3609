"""Decision processes of chapter 3 against closed forms, brute force and NumPy."""

import itertools

import numpy as np
import pytest
from page_cells import executed

from companion.chapter_3 import decision
from companion.shared.grid import Grid

MAZE = Grid(("....", ".#..", "...G"))
GOAL = MAZE.marked("G")[0]


def transitions(grid, slip):
    """The probability of each next state, with random slips: float64 (states, 4, states)."""
    probability = np.zeros((grid.states, 4, grid.states))
    each = np.arange(grid.states)
    for action, direction in itertools.product(range(4), repeat=2):
        share = slip / 4 + (1 - slip) * (direction == action)
        probability[each, action, grid.next_state[:, direction]] += share
    return probability


@pytest.fixture(scope="module")
def task():
    return decision.reaching(MAZE.next_state, {GOAL: 1.0}, slip=0.2)


@pytest.fixture(scope="module")
def learned(task):
    return decision.simulate(task, [100, 1_000, 20_000], runs=3, seed=5, learning_rate=0.02)


def test_a_task_on_a_grid_has_the_transitions_of_the_grid(task):
    probability, reward = task.expected()
    goes_on = np.arange(MAZE.states) != GOAL
    np.testing.assert_allclose(probability[goes_on], transitions(MAZE, 0.2)[goes_on])
    np.testing.assert_allclose(reward[goes_on], transitions(MAZE, 0.2)[goes_on][..., GOAL])
    assert not probability[GOAL].any() and not reward[GOAL].any()
    assert list(task.starts) == list(np.flatnonzero(goes_on))


def test_every_step_on_a_lattice_goes_one_cell_along_one_axis_or_stays():
    side, dimensions = 3, 4
    places = np.array(list(itertools.product(range(side), repeat=dimensions)))
    steps = places[decision.lattice(side, dimensions)] - places[:, None]
    moved = np.abs(steps).sum(axis=-1)
    assert set(np.unique(moved)) == {0, 1}
    assert (moved == 0).sum() == 2 * dimensions * side ** (dimensions - 1)  # the faces


def test_the_values_of_a_policy_solve_the_bellman_equation(task):
    policy, (probability, reward) = np.arange(task.states) % 4, task.expected()
    each = np.arange(task.states)
    solved = np.linalg.solve(np.eye(task.states) - 0.95 * probability[each, policy], reward[each, policy])
    np.testing.assert_allclose(decision.policy_values(task, policy, 0.95), solved, atol=1e-9)


def test_planning_finds_the_best_of_all_policies():
    """Brute force over the 4⁵ policies of a corridor with a side room."""
    grid = Grid(("...G", "#.##"))
    process = decision.reaching(grid.next_state, {grid.marked("G")[0]: 1.0}, slip=0.3)
    probability, reward = process.expected()
    policies = np.array(list(itertools.product(range(4), repeat=grid.states)))
    best = decision.policy_values(process, policies, 0.8).max(axis=0)
    np.testing.assert_allclose(decision.plan(probability, reward, 0.8).max(axis=1), best, atol=1e-9)
    np.testing.assert_allclose(decision.policy_iteration(probability, reward, 0.8, 4)[-1].values, best, atol=1e-7)


@pytest.mark.parametrize("sweeps", [1, 50])
def test_policy_iteration_alternates_and_never_gets_worse(task, sweeps):
    probability, reward = task.expected()
    stages = decision.policy_iteration(probability, reward, 0.9, sweeps)
    for before, evaluated, improved in zip(stages[0::2], stages[1::2], stages[2::2], strict=False):
        np.testing.assert_array_equal(before.policy, evaluated.policy)
        np.testing.assert_array_equal(evaluated.values, improved.values)
        q = decision.action_values(probability, reward, improved.values, 0.9)
        assert np.allclose(q[np.arange(task.states), improved.policy], q.max(axis=1))
        assert (evaluated.values >= before.values - 1e-12).all()  # the iteration starts from below
        if sweeps == 50:
            own = decision.policy_values(task, evaluated.policy, 0.9)
            np.testing.assert_allclose(evaluated.values, own, atol=0.9**50)


def test_a_run_keeps_to_the_process(task, learned):
    state, following = learned.states_tm1.astype(int), learned.states_t.astype(int)
    went = task.successors[state, learned.actions] == following[..., None]
    assert went.any(axis=-1).all()
    np.testing.assert_array_equal(learned.rewards, following == GOAL)
    goes_on = following[:, :-1] != GOAL
    assert (state[:, 1:] == following[:, :-1])[goes_on].all()
    assert set(np.unique(state[:, 1:][~goes_on])) <= set(task.starts)


def test_q_learning_in_numpy_learns_the_same_values(task, learned):
    q, visits = np.zeros((task.states, 4)), np.zeros((task.states, 4), int)
    for state, action, reward, following in zip(*(path[1, :1_000] for path in learned[:4])):
        visits[state, action] += 1
        rate = max(0.02, 1 / visits[state, action])
        q[state, action] += rate * (reward + 0.9 * (following != GOAL) * q[following].max() - q[state, action])
    np.testing.assert_allclose(learned.q[1, 1], q, atol=1e-6)


def test_a_run_is_the_same_among_others_and_for_any_number_of_checkpoints(task, learned):
    again = decision.simulate(task, [20_000], runs=2, seed=5, learning_rate=0.02)
    np.testing.assert_array_equal(again.q[1, 0], learned.q[1, 2])
    np.testing.assert_array_equal(again.states_t, learned.states_t[:2])
    assert (learned.actions[0] != learned.actions[1]).any()


def test_no_value_is_bootstrapped_from_an_end_that_the_learner_cannot_see():
    task = decision.reaching(decision.lattice(2, 1), {1: 1.0})
    learned = decision.simulate(task, [100], runs=1, seed=0, seen=[0, 0])
    assert learned.q.shape == (1, 1, 1, 2) and learned.q[0, 0, 0, 0] == pytest.approx(1.0)


def test_transitions_and_first_visits_are_counted_one_by_one(learned):
    counts, first = decision.count_transitions(learned, 200), decision.first_visits(learned)
    for run in range(3):
        transitions, met = np.zeros(counts.shape[1:], int), np.zeros(first.shape[1:], int)
        for step, (state, action, following) in enumerate(zip(learned.states_tm1[run], learned.actions[run],
                                                              learned.states_t[run])):
            transitions[state, action, following] += step < 200
            met[state, action] = met[state, action] or step + 1
        np.testing.assert_array_equal(counts[run], transitions)
        np.testing.assert_array_equal(first[run], met)


def test_a_learned_model_is_the_process_itself_in_the_end(task, learned):
    (probability, reward), truth = decision.learned_model(learned, 20_000), task.expected()
    np.testing.assert_allclose(probability, np.broadcast_to(truth[0], probability.shape), atol=0.12)
    np.testing.assert_allclose(reward, np.broadcast_to(truth[1], reward.shape), atol=0.12)
    untried = decision.learned_model(learned, 1)
    assert untried[0].sum() == 3.0 and (untried[1] == 0).all()


def test_the_page_fits_the_factor_of_growth_from_the_second_point_on():
    growth = executed("chapter_3").growth
    xs, needed = np.arange(1, 5), np.array([7.0 * 3.0 ** np.arange(1, 5), 2.0 * 5.0 ** np.arange(1, 5)])
    needed[:, 0] = 1e6
    assert growth(xs, needed).value == pytest.approx(4)  # the mean of 3 and 5
    assert growth(xs[:2], np.array([[5.0, 20.0]])).value == pytest.approx(4)


@pytest.mark.parametrize("page, judged", [
    ({}, ["T3", "T4"]), ({"until": "judging", "memory": 4, "changes": (("10, 13)", "10)"),)}, []),
    ({"until": "judging", "changes": (("exploration=0.1", "exploration=0.3"),)}, ["T4"]),
    ({"until": "judging", "changes": (("slip=0.2", "slip=0.5"),)}, ["T3"])])
def test_the_page_judges_its_own_worlds_and_learners_alone(page, judged):
    claims = executed("chapter_3", **page).judged
    assert [(claim.name, claim.full_length) for claim in claims] == [(name, False) for name in judged]
