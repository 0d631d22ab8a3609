"""The maze of T-shaped units, the animals that run it, and their figures."""

import numpy as np
import pytest
from matplotlib import pyplot as plt

from lib.chapter_2 import maze_figures
from lib.chapter_2.latent_learning import (DAYS, GROUPS, LEARNERS, Animal, Record, Rival, _learn_by_traces,
                                                      compare_groups, compare_learners, findings, judge, known_by, live,
                                                      simulate_groups)
from lib.chapter_2.maze import Maze, random_maze
from lib.shared.grid import MOVES
from lib.shared.tabular import Rates
from neorl.core.kernel import execute, new_tuple
from neorl.core.stream import new_stream
from neorl.evidence.statistics import Estimate

N, S, E, W = range(4)


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


def test_alleys_between_choice_points_can_be_walked_both_ways_up_to_the_door():
    maze = Maze("RL", alley=2)
    assert list(maze.choice_points) == [3, 6] and maze.goal == 9 and maze.states == 12
    assert walk(maze, [N, N, S, N, N, E, E, W, W, E, E, N]) == [0, 1, 2, 1, 2, 3, 4, 5, 4, 4, 5, 6, 7]
    assert walk(maze, [W, E], state=3) == [3, 10, 3]


def test_every_move_leads_to_where_it_points():
    maze = Maze(alley=1)
    for state, action in np.ndindex(maze.states, 4):
        moved = maze.places[maze.next_state[state, action]] - maze.places[state]
        assert np.allclose(moved, 0) or np.allclose(moved / np.abs(moved).sum(), MOVES[action])


@pytest.mark.parametrize("turns", ["", "RX", "RRR", "LLL", "RLRRR"])
def test_a_bad_path_or_one_that_crosses_itself_is_refused(turns):
    with pytest.raises(ValueError, match="turns is .*, allowed are L and R"):
        Maze(turns)


def test_random_mazes_have_as_many_units_and_differ():
    drawn = {random_maze(seed, units=9).turns for seed in range(5)}
    assert len(drawn) > 3 and {len(turns) for turns in drawn} == {9}
    assert random_maze(1) == random_maze(1) and random_maze(1, alley=2).alley == 2


@pytest.mark.parametrize("change, message", [
    ({"learner": "rat"}, "learner must be .*, but is 'rat'"), ({"exploration": 2}, "exploration must be .*, but is 2"),
    ({"trace": -1}, "trace must be .*, but is -1"),
    ({"learning_rate": "a"}, "learning_rate must be .*, but is 'a'"),
    ({"discount": 1.1}, "discount must be .*, but is 1.1"),
])
def test_a_bad_animal_is_refused(change, message):
    with pytest.raises(ValueError, match=message):
        Animal(**change)


@pytest.mark.parametrize("change, message", [
    ({"animal": "neoRL"}, "animal must be an Animal, but is"), ({"maze": "RL"}, "maze must be a Maze,"),
    ({"runs": 0}, "runs must be .*, but is 0"),
    ({"seed": -1}, "seed must be .*, but is -1"), ({"first_reward": 0}, "first_reward must be .*, but is 0"),
])
def test_a_bad_experiment_is_refused(change, message):
    with pytest.raises(ValueError, match=message):
        simulate_groups(**{"animal": Animal(), "maze": Maze(), "runs": 2} | change)


@pytest.fixture(scope="module")
def by_learner():
    return {learner: simulate_groups(Animal(learner), Maze(), runs=60) for learner in LEARNERS}


@pytest.mark.parametrize("learner", LEARNERS)
def test_a_run_is_the_same_alone_and_among_others(by_learner, learner):
    alone = simulate_groups(Animal(learner), Maze(), runs=2)
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


def test_sarsa_without_a_trace_learns_one_unit_a_meal():
    known = simulate_groups(Animal("Sarsa(λ)", trace=0.0, exploration=0.0), Maze(), runs=3)["throughout"].known
    np.testing.assert_allclose(known[:, :5], np.tile(np.arange(1, 6) / 14, (3, 1)))


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
    days = live(animal, maze, 1, new_stream(np.random.SeedSequence(0)))
    errors, learned = zip(*[(errors, worth[maze.blinds].copy()) for (errors, worth), _ in zip(days, range(3))])
    assert errors[0] > 0 and errors[2] == 0  # it enters blinds on the first day and none on the last
    assert learned[0].any() and np.array_equal(learned[1], learned[2])


def test_sarsa_tries_what_it_has_tried_least():
    errors = simulate_groups(Animal("Sarsa(λ)", exploration=0.0), Maze(), runs=60)["never"].errors
    # It tries the four actions in turn, the blind before or after the true path: half an error per unit on the first
    # day, and from then on as many entries into the blind as into the true path.
    assert errors[:, 0].mean() == pytest.approx(7, abs=1)
    assert (np.abs(errors.sum(axis=1) - 14 * DAYS) <= 14).all()


def test_fed_throughout_and_without_exploration_neorl_and_q_learning_do_the_same():
    hardly = Animal("neoRL", exploration=1e-12), Animal("Q-learning", exploration=1e-12)  # both draw whether to explore
    neorl, q_learning = (simulate_groups(animal, Maze(), runs=20)["throughout"].errors for animal in hardly)
    np.testing.assert_array_equal(neorl, q_learning)
    assert (neorl[:, 14:] == 0).all()


def test_exploration_is_the_share_of_drawn_actions():
    errors = simulate_groups(Animal(exploration=0.2), Maze(), runs=60)["throughout"].errors[:, 15:]
    # At a known choice point an action leads to the true path with probability 0.85 and to the blind with 0.05.
    assert errors.mean() == pytest.approx(14 * 0.05 / 0.85, abs=0.3)


@pytest.mark.parametrize("learner", ["neoRL", "Q-learning"])
def test_learned_values_solve_the_bellman_equation(learner):
    maze = Maze()
    *_, (_, q) = live(Animal(learner, learning_rate=1.0), maze, 1, new_stream(np.random.SeedSequence(0)))
    steps_left = maze.goal - np.arange(maze.goal)
    np.testing.assert_allclose(q[: maze.goal].max(axis=1), 0.9 ** (steps_left - 1.0), rtol=1e-5)
    if learner == "neoRL":  # not only for the goal box
        horde = q.base.reshape(30, 4, 30)
        np.testing.assert_allclose(horde[0, N, 1 : maze.goal], 0.9 ** np.arange(maze.goal - 1.0), rtol=1e-5)


def test_the_delayed_group_is_fed_from_the_day_that_is_given():
    groups = simulate_groups(Animal("Q-learning"), Maze(), runs=5, first_reward=4)
    assert (groups["delayed"].known[:, :3] == 0).all() and (groups["delayed"].known[:, 3] == 1 / 14).all()


def flat(level, after=None, day_12=None, runs=20):
    errors = np.full((runs, DAYS), float(level)) + np.arange(runs)[:, None] % 2 * 0.01
    errors[:, 11:] += (level if after is None else after) - level
    errors[:, 11] = day_12 if day_12 is not None else errors[:, 11]
    return Record(errors, None)


def test_the_findings_of_the_original_are_found_in_results_that_have_them():
    falling = Record(np.tile(np.concatenate([np.linspace(14, 3, 11), np.full(6, 2.0)]), (20, 1)), None)
    groups = {"throughout": falling, "never": flat(14, 13), "delayed": flat(14, 1, 3)}
    assert [found.holds for found in findings(groups).values()] == [True] * 8


def test_the_findings_of_the_original_are_not_found_in_results_that_lack_them():
    groups = {"throughout": flat(12), "never": flat(12), "delayed": flat(14, 13, 14.1)}
    assert [found.holds for found in findings(groups).values()] == [False] * 8
    numbers = [found.here.value for found in findings(groups).values()]
    assert numbers == pytest.approx([0, 0, 0, 2, 0.1, 2.1, 7.1 / 6, 2.1], abs=0.01)


def test_groups_differ_in_either_direction_and_are_ahead_only_with_the_whole_interval():
    found = findings({"throughout": flat(12), "never": flat(12), "delayed": flat(10, 13, 12.005)})
    assert found["before"].here.value == pytest.approx(-2) and not found["before"].holds
    assert found["one meal"].here.low < 0 < found["one meal"].here.high and not found["one meal"].holds


def test_every_kind_of_animal_is_compared_and_neorl_is_judged():
    level = {"throughout": flat(2), "never": flat(14), "delayed": flat(14, 2, 2)}
    ahead = level | {"delayed": flat(14, 1, 1)}
    by_learner = {"neoRL": level, "Q-learning": ahead, "Sarsa(λ)": level}
    found = compare_learners(by_learner)
    assert [found[name]["below"].holds for name in LEARNERS] == [False, True, False]
    assert found["Q-learning"] == findings(ahead)
    assert judge(by_learner).verdict == "partly" and judge(by_learner | {"neoRL": ahead}).verdict == "reproduced"
    assert "With other learners it is: Q-learning −1.00" in judge(by_learner).detail


@pytest.mark.parametrize("day", [0, DAYS])
def test_findings_need_a_day_after_the_first_meal(day):
    with pytest.raises(ValueError, match=f"first_reward must be an integer from 1 to 16, but is {day}"):
        findings(dict.fromkeys(GROUPS, flat(1)), day)


def test_the_plan_draws_every_blind_and_every_door():
    maze = Maze()
    maze_figures.draw_plan(maze)
    drawn = {tuple(np.round(line.get_xydata().ravel(), 6)) for line in plt.gca().lines}
    for choice, blind in zip(maze.choice_points, maze.blinds):
        assert tuple(np.round(maze.places[[choice, blind]].ravel(), 6)) in drawn
    doors = [line for line in plt.gca().lines if line.get_linewidth() == 2.5]
    assert len(doors) == 14
    for door, choice in zip(doors, maze.choice_points):
        np.testing.assert_allclose(door.get_xydata().mean(axis=0), maze.places[[choice, choice + 1]].mean(axis=0))


def test_mean_errors_are_drawn_in_a_panel_for_each_learner(by_learner):
    maze_figures.draw_errors(by_learner, 11)
    panels = plt.gcf().axes
    assert [axes.get_title() for axes in panels] == list(LEARNERS)
    for axes, groups in zip(panels, by_learner.values()):
        for line, record in zip(axes.lines, groups.values()):
            np.testing.assert_allclose(line.get_ydata(), record.errors.mean(axis=0))
        assert {text.get_text() for text in axes.texts} == {"throughout", "never", "from day 11"}


def test_what_is_known_is_drawn_by_day(by_learner):
    maze_figures.draw_known({name: groups["delayed"].known for name, groups in by_learner.items()}, 11)
    neorl, q_learning, sarsa, day = plt.gca().lines
    assert neorl.get_xdata()[[0, -1]].tolist() == [1, 17] and day.get_xdata() == [11, 11]
    np.testing.assert_allclose(q_learning.get_ydata(), np.maximum(np.arange(17) - 9, 0) / 14)


def test_settings_are_drawn_as_points_with_their_intervals():
    rows = {"a": {"x": [Estimate(1, 0, 2), Estimate(3, 2, 4)], "y": [Estimate(5, 4, 6), Estimate(7, 6, 8)]},
            "b": {"x": [Estimate(2, 1, 3), Estimate(4, 3, 5)], "y": [Estimate(6, 5, 7), Estimate(8, 7, 9)]}}
    maze_figures.draw_settings(rows, ["first", "second"])
    first, second = plt.gcf().axes
    assert [list(line.get_xdata()) for line in second.lines[1:]] == [[3, 4], [7, 8]]
    assert [list(each.get_segments()[0][:, 0]) for each in first.collections] == [[0, 2], [4, 6]]
    assert [label.get_text() for label in first.get_yticklabels()] == ["a", "b"]


def test_all_kinds_of_animals_are_compared_in_all_groups_and_by_what_they_know():
    found = compare_groups(Maze(), runs=2)
    assert list(found) == list(LEARNERS) and {*found["neoRL"]} == {*GROUPS}
    known = known_by(found, "delayed")
    assert list(known) == list(LEARNERS) and known["neoRL"] is found["neoRL"]["delayed"].known
