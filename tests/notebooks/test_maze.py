"""The maze of T-shaped units, the animals that run it, and the plan of it."""

import numpy as np
import pytest
from page_cells import executed

from companion.chapter_2.maze import (DAYS, GROUPS, LEARNERS, Animal, Maze, Record, Rival, _learn_by_traces, findings,
                                      run_days, simulate)
from companion.shared.grid import MOVES
from companion.shared.tabular import Rates
from neorl.core.stream import new_stream
from neorl.kernels.annotations import new_tuple
from neorl.kernels.execution import execute

N, S, E, W = range(4)
FED_FROM = dict(zip(GROUPS, (1, DAYS + 1, 11)))


def groups(animal, runs):
    """The three groups of animals, as on the page."""
    return {group: simulate(animal, Maze(), day, runs, 0, number)
            for number, (group, day) in enumerate(FED_FROM.items())}


def walk(maze, moves, state=0):
    states = [state]
    for move in moves:
        states.append(int(maze.next_state[states[-1], move]))
    return states


def test_the_true_path_leads_from_the_start_through_every_choice_point_to_the_goal_box():
    maze = Maze("RLL")
    assert maze.states == 8 and list(maze.choice_points) == [1, 2, 3] and maze.goal == 4
    assert walk(maze, [N, E, N, W]) == [0, 1, 2, 3, 4]
    assert maze.places[: maze.goal + 1].tolist() == [[0, 0], [0, -1], [1, -1], [1, -2], [0, -2]]


def test_a_blind_is_on_the_other_side_of_each_unit_and_leads_back_only():
    maze = Maze("RLL")
    assert walk(maze, [N, W, N, S, W, E, E, S]) == [0, 1, 5, 5, 5, 5, 1, 2, 6]
    assert walk(maze, [E, W], state=3) == [3, 7, 3]
    np.testing.assert_allclose(maze.places[5:], [[-0.55, -1], [1, -0.45], [1.55, -2]])


def test_doors_close_behind_an_animal_that_leaves_a_choice_point():
    maze = Maze("RLL")
    assert walk(maze, [N, S, N, E, W, N, S]) == [0, 1, 0, 1, 2, 2, 3, 3]


def test_every_move_leads_to_where_it_points():
    maze = Maze(alley=1)
    for state, action in np.ndindex(maze.states, 4):
        moved = maze.places[maze.next_state[state, action]] - maze.places[state]
        assert np.allclose(moved, 0) or np.allclose(moved / np.abs(moved).sum(), MOVES[action])


@pytest.mark.parametrize("turns", ["", "RX", "RRR", "LLL", "RLRRR"])
def test_a_bad_path_or_one_that_crosses_itself_is_refused(turns):
    with pytest.raises(ValueError, match="turns must be L and R, on a way that does not cross itself, but is"):
        Maze(turns)


@pytest.fixture(scope="module")
def by_learner():
    return {learner: groups(Animal(learner), 60) for learner in LEARNERS}


@pytest.mark.parametrize("learner", LEARNERS)
def test_a_run_is_the_same_alone_and_among_others(by_learner, learner):
    alone = groups(Animal(learner), 2)
    for group in GROUPS:
        np.testing.assert_array_equal(alone[group].errors, by_learner[learner][group].errors[:2])
    assert (by_learner[learner]["never"].errors[:, :10] != by_learner[learner]["delayed"].errors[:, :10]).any()


def test_a_random_walk_enters_each_blind_once_a_day_on_average(by_learner):
    errors = by_learner["neoRL"]["never"].errors  # blind and true path are equally likely: one error per unit
    assert errors.shape == (60, DAYS)
    assert errors.mean() == pytest.approx(14, abs=4 * np.sqrt(28 / errors.size))  # geometric, with variance 2


def test_neorl_learns_one_more_unit_a_day_fed_or_not(by_learner):
    expected = np.minimum(np.arange(1, DAYS + 1), 14) / 14
    for record in by_learner["neoRL"].values():
        np.testing.assert_allclose(record.known, np.tile(expected, (60, 1)))


def test_q_learning_learns_one_more_unit_a_meal(by_learner):
    meals = {"throughout": np.arange(1, DAYS + 1), "never": np.zeros(DAYS), "delayed": np.arange(DAYS) - 9}
    for group, record in by_learner["Q-learning"].items():
        np.testing.assert_allclose(record.known, np.tile(np.clip(meals[group], 0, 14) / 14, (60, 1)))


def test_sarsa_learns_the_whole_path_from_one_meal(by_learner):
    known = by_learner["Sarsa(λ)"]["delayed"].known
    assert (known[:, :10] == 0).all() and known[:, 10:].mean() > 0.99


@pytest.mark.parametrize("ended", [False, True])
def test_sarsa_learns_along_replacing_traces(ended):
    animal, rng = new_tuple(Rival, {"states": 3}, {}), np.random.default_rng(0)
    animal.q[:], animal.traces[:] = rng.random((2, 3, 4))
    target = 2.0 + (0 if ended else 0.9 * animal.q[2, 3])
    traces = animal.traces.copy()
    traces[1] = [0, 1, 0, 0]
    expected = animal.q + 0.1 * (target - animal.q[1, 1]) * traces
    execute(_learn_by_traces, animal, 1, 1, 2.0, 2, 3, ended, Rates(0.1, 0.9, 0.0), 0.5)
    np.testing.assert_allclose(animal.q, expected)
    np.testing.assert_allclose(animal.traces, 0.45 * traces)


def test_sarsa_leaves_no_trace_of_yesterday():
    maze, animal = Maze(), Animal("Sarsa(λ)", discount=1.0, exploration=0.0, trace=1.0)
    days = run_days(animal, maze, 1, new_stream(np.random.SeedSequence(0)))
    errors, learned = zip(*[(errors, worth[maze.blinds].copy()) for (errors, worth), _ in zip(days, range(3))])
    assert errors[0] > 0 and errors[2] == 0  # it enters blinds on the first day and none on the last
    assert learned[0].any() and np.array_equal(learned[1], learned[2])


def test_fed_throughout_and_without_exploration_neorl_and_q_learning_do_the_same():
    hardly = Animal("neoRL", exploration=1e-12), Animal("Q-learning", exploration=1e-12)  # both draw whether to explore
    neorl, q_learning = (simulate(animal, Maze(), 1, 20).errors for animal in hardly)
    np.testing.assert_array_equal(neorl, q_learning)
    assert (neorl[:, 14:] == 0).all()


def test_exploration_is_the_share_of_drawn_actions():
    errors = simulate(Animal(exploration=0.2), Maze(), 1, 60).errors[:, 15:]
    # At a known choice point an action leads to the true path with probability 0.85 and to the blind with 0.05.
    assert errors.mean() == pytest.approx(14 * 0.05 / 0.85, abs=0.3)


@pytest.mark.parametrize("learner", ["neoRL", "Q-learning"])
def test_learned_values_solve_the_bellman_equation(learner):
    maze = Maze()
    *_, (_, q) = run_days(Animal(learner, learning_rate=1.0), maze, 1, new_stream(np.random.SeedSequence(0)))
    steps_left = maze.goal - np.arange(maze.goal)
    np.testing.assert_allclose(q[: maze.goal].max(axis=1), 0.9 ** (steps_left - 1.0), rtol=1e-5)
    if learner == "neoRL":  # not only for the goal box
        horde = q.base.reshape(30, 4, 30)
        np.testing.assert_allclose(horde[0, N, 1 : maze.goal], 0.9 ** np.arange(maze.goal - 1.0), rtol=1e-5)


def flat(level, after=None, day_12=None, runs=20):
    errors = np.full((runs, DAYS), float(level)) + np.arange(runs)[:, None] % 2 * 0.01
    errors[:, 11:] += (level if after is None else after) - level
    errors[:, 11] = day_12 if day_12 is not None else errors[:, 11]
    return Record(errors, None, None)


def test_the_findings_of_the_original_are_found_in_results_that_have_them():
    falling = Record(np.tile(np.concatenate([np.linspace(14, 3, 11), np.full(6, 2.0)]), (20, 1)), None, None)
    results = {"throughout": falling, "never": flat(14, 13), "delayed": flat(14, 1, 3)}
    assert [found.holds for found in findings(results, 11).values()] == [True] * 8


def test_the_findings_of_the_original_are_not_found_in_results_that_lack_them():
    results = {"throughout": flat(12), "never": flat(12), "delayed": flat(14, 13, 14.1)}
    assert [found.holds for found in findings(results, 11).values()] == [False] * 8
    numbers = [found.here.value for found in findings(results, 11).values()]
    assert numbers == pytest.approx([0, 0, 0, 2, 0.1, 2.1, 7.1 / 6, 2.1], abs=0.01)


@pytest.mark.parametrize("after, verdict", [(2.5, "partly"), (1, "reproduced"), (12, "contradicted")])
def test_the_demonstration_holds_as_far_as_its_animals_do(after, verdict):
    by_kind = {kind: {"throughout": flat(2), "never": flat(14), "delayed": flat(14, after, after)} for kind in LEARNERS}
    assert executed("chapter_2", until="judging").judge(by_kind).verdict == verdict


@pytest.mark.parametrize("page, judged", [
    ({}, ["H1"]), ({"exploration": 0.3}, []),
    ({"changes": (("Maze()", 'Maze("RLRL")'),)}, [])])
def test_the_page_judges_the_animals_of_the_book_alone(page, judged):
    page = executed("chapter_2", until="judging", **page)
    assert [claim.name for claim in page.judged] == judged
