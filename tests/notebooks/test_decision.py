"""Decision processes against closed forms, brute force and NumPy."""

import itertools
from dataclasses import replace

import numpy as np
import pytest

from lib.chapter_3 import decision
from lib.chapter_3.data import TRANSISTORS
from lib.shared.grid import Grid

MAZE = Grid(("....", ".#..", "...G"))
GOAL = MAZE.marked("G")[0]


@pytest.fixture(scope="module")
def task():
    return decision.reaching(MAZE.next_state, {GOAL: 1.0}, slip=0.2)


@pytest.fixture(scope="module")
def lives(task):
    return decision.live(task, [100, 1_000, 20_000], runs=3, seed=5, learning_rate=0.02)


def test_a_task_on_a_grid_has_the_transitions_of_the_grid(task):
    probability, reward = task.expected()
    goes_on = np.arange(MAZE.states) != GOAL
    np.testing.assert_allclose(probability[goes_on], MAZE.transitions(0.2)[goes_on])
    np.testing.assert_allclose(reward[goes_on], MAZE.transitions(0.2)[goes_on][..., GOAL])
    assert not probability[GOAL].any() and not reward[GOAL].any()
    assert list(task.starts) == list(np.flatnonzero(goes_on))


@pytest.mark.parametrize("change, message", [
    ({"successors": np.full((2, 1, 1), 2)}, "successors lie from 2 to 2, allowed are states from 0 to 1"),
    ({"starts": np.array([-1])}, "starts lie from -1"), ({"chances": np.array([0.9])}, "chances add up to 0.9"),
])
def test_a_bad_process_is_refused(change, message):
    process = decision.Process(np.zeros((2, 1, 1), int), np.ones(1), np.zeros((2, 1, 1)), np.zeros(2, bool),
                               np.array([0]))
    with pytest.raises(ValueError, match=message):
        replace(process, **change)


@pytest.mark.parametrize("arguments, message", [
    ({"worth": {99: 1.0}}, "worth must be .*, but is 99"), ({"worth": {0: np.inf}}, "worth must be .*, but is inf"),
    ({"slip": 1.1}, "slip must be .*, but is 1.1"),
])
def test_a_bad_task_is_refused(arguments, message):
    with pytest.raises(ValueError, match=message):
        decision.reaching(MAZE.next_state, **{"worth": {GOAL: 1.0}, **arguments})


def test_a_lattice_of_two_dimensions_is_a_grid():
    south_north_east_west = [1, 0, 2, 3]
    np.testing.assert_array_equal(decision.lattice(3, 2), Grid(("...",) * 3).next_state[:, south_north_east_west])


def test_every_step_on_a_lattice_goes_one_cell_along_one_axis_or_stays():
    side, dimensions = 3, 4
    places = np.array(list(itertools.product(range(side), repeat=dimensions)))
    steps = places[decision.lattice(side, dimensions)] - places[:, None]
    moved = np.abs(steps).sum(axis=-1)
    assert set(np.unique(moved)) == {0, 1}
    assert (moved == 0).sum() == 2 * dimensions * side ** (dimensions - 1)  # the faces


def test_the_values_of_a_walk_to_the_end_are_powers_of_the_discount():
    corridor = decision.reaching(decision.lattice(5, 1), {4: 2.0})
    always_up, always_down = np.zeros(5, int), np.ones(5, int)
    np.testing.assert_allclose(decision.policy_values(corridor, always_up, 0.5), [0.25, 0.5, 1, 2, 0])
    assert not decision.policy_values(corridor, always_down, 0.5).any()


def test_the_values_of_a_policy_solve_the_bellman_equation(task):
    policy, (probability, reward) = np.arange(task.states) % 4, task.expected()
    each = np.arange(task.states)
    solved = np.linalg.solve(np.eye(task.states) - 0.95 * probability[each, policy], reward[each, policy])
    np.testing.assert_allclose(decision.policy_values(task, policy, 0.95), solved, atol=1e-9)
    with pytest.raises(ValueError, match="discount must be .*, but is 1"):
        decision.policy_values(task, policy, 1)


def test_several_policies_have_the_values_of_each_alone(task):
    policies = np.random.default_rng(0).integers(4, size=(2, 3, task.states))
    together = decision.policy_values(task, policies, 0.9)
    for index in np.ndindex(2, 3):
        alone = decision.policy_values(task, policies[index], 0.9)
        np.testing.assert_allclose(together[index], alone)


def test_planning_finds_the_best_of_all_policies():
    """Brute force over the 4⁵ policies of a corridor with a side room."""
    grid = Grid(("...G", "#.##"))
    process = decision.reaching(grid.next_state, {grid.marked("G")[0]: 1.0}, slip=0.3)
    probability, reward = process.expected()
    policies = np.array(list(itertools.product(range(4), repeat=grid.states)))
    best = decision.policy_values(process, policies, 0.8).max(axis=0)
    np.testing.assert_allclose(decision.plan(probability, reward, 0.8).max(axis=1), best, atol=1e-9)
    np.testing.assert_allclose(decision.policy_iteration(probability, reward, 0.8, 4)[-1].values, best, atol=1e-7)


@pytest.mark.parametrize("sweeps", [1, 3, 50])
def test_policy_iteration_alternates_and_never_gets_worse(task, sweeps):
    probability, reward = task.expected()
    stages = decision.policy_iteration(probability, reward, 0.9, sweeps)
    assert len(stages) % 2 == 1
    for before, evaluated, improved in zip(stages[0::2], stages[1::2], stages[2::2]):
        np.testing.assert_array_equal(before.policy, evaluated.policy)
        np.testing.assert_array_equal(evaluated.values, improved.values)
        q = decision.action_values(probability, reward, improved.values, 0.9)
        assert np.allclose(q[np.arange(task.states), improved.policy], q.max(axis=1))
        assert (evaluated.values >= before.values - 1e-12).all()  # the iteration starts from below
        if sweeps == 50:
            own = decision.policy_values(task, evaluated.policy, 0.9)
            np.testing.assert_allclose(evaluated.values, own, atol=0.9**50)


@pytest.mark.parametrize("change, message", [({"sweeps": 0}, "sweeps must be .*, but is 0"),
({"discount": 1.0}, "discount must be .*, but is 1.0")])
def test_an_iteration_that_might_not_end_is_refused(task, change, message):
    with pytest.raises(ValueError, match=message):
        decision.policy_iteration(*task.expected(), **{"discount": 0.9, "sweeps": 3, **change})


def test_a_loss_is_looked_at_after_iterations_only():
    losses = [1.0, 0.1, 0.6, 0.1, 0.4, 0.1, 0.0]  # every second loss is that of an evaluation
    assert [decision.iterations_until(losses, limit) for limit in (2, 0.5, 0.3)] == [0, 2, 3]


def test_sweeps_are_counted_over_all_iterations(task):
    stages = decision.policy_iteration(*task.expected(), 0.9, 3)
    assert decision.sweeps_until_stable(*task.expected(), 0.9, 3) == 3 * (len(stages) - 1) // 2 > 3


def test_a_sweep_is_the_bellman_equation():
    probability = np.array([[[0.25, 0.75]], [[1.0, 0.0]]])
    q = decision.action_values(probability, np.array([[1.0], [2.0]]), np.array([10.0, 20.0]), 0.5)
    np.testing.assert_allclose(q, [[1 + 0.5 * (2.5 + 15)], [2 + 0.5 * 10]])


def test_a_life_keeps_to_the_process(task, lives):
    state, following = lives.states_tm1.astype(int), lives.states_t.astype(int)
    went = task.successors[state, lives.actions] == following[..., None]
    assert went.any(axis=-1).all()
    np.testing.assert_array_equal(lives.rewards, following == GOAL)
    goes_on = following[:, :-1] != GOAL
    assert (state[:, 1:] == following[:, :-1])[goes_on].all()
    assert set(np.unique(state[:, 1:][~goes_on])) <= set(task.starts)


def test_outcomes_occur_with_their_probabilities(task):
    lived = decision.live(task, [100_000], runs=1, seed=0)
    counts = decision.count_transitions(lived, 100_000)[0]
    probability, _ = task.expected()
    share = counts[:GOAL] / counts[:GOAL].sum(axis=-1, keepdims=True)
    np.testing.assert_allclose(share, probability[:GOAL], atol=0.03)
    np.testing.assert_allclose(np.bincount(lived.actions[0]) / 100_000, 0.25, atol=0.01)


def test_q_learning_finds_the_values_of_the_best_policy(task, lives):
    best = decision.plan(*task.expected(), 0.9)
    first, _, last = (np.abs(lives.q[:, k] - best).max() for k in range(3))
    assert last < 0.1 < 0.5 < first


def test_q_learning_in_numpy_learns_the_same_values(task, lives):
    q, visits = np.zeros((task.states, 4)), np.zeros((task.states, 4), int)
    for state, action, reward, following in zip(*(path[1, :1_000] for path in lives[:4])):
        visits[state, action] += 1
        rate = max(0.02, 1 / visits[state, action])
        q[state, action] += rate * (reward + 0.9 * (following != GOAL) * q[following].max() - q[state, action])
    np.testing.assert_allclose(lives.q[1, 1], q, atol=1e-6)


def test_a_run_is_the_same_among_others_and_for_any_number_of_checkpoints(task, lives):
    again = decision.live(task, [20_000], runs=2, seed=5, learning_rate=0.02)
    np.testing.assert_array_equal(again.q[1, 0], lives.q[1, 2])
    np.testing.assert_array_equal(again.states_t, lives.states_t[:2])
    assert (lives.actions[0] != lives.actions[1]).any()


def test_a_learner_that_explores_little_mostly_takes_the_best_action():
    corridor = decision.reaching(decision.lattice(5, 1), {4: 1.0})
    lived = decision.live(corridor, [5_000], runs=1, seed=0, exploration=0.1)
    assert (lived.actions[0, 2_500:] == 0).mean() == pytest.approx(0.95, abs=0.02)


def test_a_learner_knows_only_what_it_sees(task):
    lived = decision.live(task, [500], runs=1, seed=0, seen=np.arange(task.states) // 4)
    assert lived.q.shape == (1, 1, 3, 4) and lived.states_t.max() == 2


def test_no_value_is_bootstrapped_from_an_end_that_the_learner_cannot_see():
    lived = decision.live(decision.reaching(decision.lattice(2, 1), {1: 1.0}), [100], runs=1, seed=0, seen=[0, 0])
    assert lived.q[0, 0, 0, 0] == pytest.approx(1.0)


@pytest.mark.parametrize("change, message", [
    ({"runs": 0}, "runs must be .*, but is 0"), ({"checkpoints": [1.5]}, "checkpoints must be .*, but is 1.5"),
    ({"discount": 2}, "discount must be .*, but is 2"),
    ({"learning_rate": -1}, "learning_rate must be .*, but is -1"),
    ({"exploration": 1.5}, "exploration must be .*, but is 1.5"),
])
def test_a_bad_life_is_refused(task, change, message):
    with pytest.raises(ValueError, match=message):
        decision.live(task, **{"checkpoints": [10], "runs": 1, "seed": 0, **change})


def test_a_process_with_too_many_states_is_refused():
    with pytest.raises(ValueError, match="states must be an integer from 1 to 32767, but is 40000"):
        decision.live(decision.reaching(decision.lattice(200, 2), {0: 1.0}), [1], 1, 0)


def test_transitions_and_first_visits_are_counted_one_by_one(lives):
    counts, first = decision.count_transitions(lives, 200), decision.first_visits(lives)
    for run in range(3):
        table, met = np.zeros(counts.shape[1:], int), np.zeros(first.shape[1:], int)
        for step, (state, action, following) in enumerate(zip(lives.states_tm1[run], lives.actions[run],
                                                              lives.states_t[run])):
            table[state, action, following] += step < 200
            met[state, action] = met[state, action] or step + 1
        np.testing.assert_array_equal(counts[run], table)
        np.testing.assert_array_equal(first[run], met)


def test_the_filling_of_models_is_reported_in_percent_and_by_pair():
    percent, branching = decision.model_filling(np.array([10, 30]), np.array([100, 100]), np.array([5, 10]))
    assert percent == pytest.approx(20) and branching == pytest.approx((2.5, 2, 3))


def test_a_learned_model_is_the_process_itself_in_the_end(task, lives):
    (probability, reward), truth = decision.learned_model(lives, 20_000), task.expected()
    np.testing.assert_allclose(probability, np.broadcast_to(truth[0], probability.shape), atol=0.12)
    np.testing.assert_allclose(reward, np.broadcast_to(truth[1], reward.shape), atol=0.12)
    untried = decision.learned_model(lives, 1)
    assert untried[0].sum() == 3.0 and (untried[1] == 0).all()


def test_the_time_to_something_is_its_first_checkpoint():
    good = np.array([[False, True, False], [False, False, False], [True, True, True]])
    assert list(decision.time_to(good, [10, 20, 30])) == [20, 30, 10]


def test_the_largest_processors_are_those_of_the_table():
    assert TRANSISTORS[1971] == 2.31 and TRANSISTORS[2021] == 58_200_000
    assert list(TRANSISTORS) == sorted(TRANSISTORS) and len(TRANSISTORS) == 39
