"""The page "Is it general?": its runs and sentences, on short runs and made-up ones."""

import math

import numpy as np
import pytest

from lib.other_spaces import birds, figures, hill, lives, minds, pool, report, scores
from neorl import Learning, Policy, Run, Scene
from neorl.core.kernel import function_of

STEPS, RUNS = 3_000, 2


@pytest.fixture(scope="module")
def reached():
    return lives.reach(STEPS, RUNS, 0)


@pytest.fixture(scope="module")
def sailed():
    return lives.sail(STEPS, RUNS, 0)


@pytest.fixture(scope="module")
def swum():
    return pool.swim(RUNS, 0)


@pytest.fixture(scope="module")
def asked():
    return birds.ask(RUNS, 0)


@pytest.fixture(scope="module")
def driven():
    return {name: np.tile(np.linspace(200, last, hill.POINTS), (RUNS, 1)) + np.arange(RUNS)[:, None]
            for name, last in (("neoRL", 150), ("Q-learning", 160), ("random", 195))}


def test_an_arm_of_other_than_two_or_three_links_is_refused():
    with pytest.raises(ValueError, match="links must be 2 or 3, but is 4"):
        minds.reacher(4)


def test_all_agents_have_one_rule_and_one_policy():
    agents = [minds.reacher(2), minds.reacher(3), minds.pilot(), minds.far_pilot(), minds.compass_pilot(),
              minds.swimmer(), minds.thinker(True), minds.thinker(False), minds.driver()]
    assert {(agent.learning, agent.policy, agent.own_cell) for agent in agents} == {
        (Learning(credit="share"), Policy(), "silent")}


@pytest.mark.parametrize("thing, turns", [((0.9, 0.5), 0.0), ((0.5, 0.9), 0.25), ((0.1, 0.5), 0.5), ((0.5, 0.1), 0.75)])
def test_a_bearing_is_seen_from_the_bow(thing, turns):
    for heading in (0.0, 1.0, 4.0):
        to_world = np.array([[math.cos(heading), -math.sin(heading)], [math.sin(heading), math.cos(heading)]])
        place = 0.5 + to_world @ (np.array(thing) - 0.5)
        scene = Scene(np.array([0.5, 0.5]), 0.1 * to_world[:, 0], place[None], np.zeros(1, int), np.zeros(1, int))
        (seen,) = minds.FAR_RADAR.modality.coordinates(scene, 1.0)
        assert (seen[1] - turns + 0.5) % 1 == pytest.approx(0.5, abs=1e-9)
        assert seen[0] == pytest.approx(0.4)


def test_a_second_map_joins_at_half_time(sailed):
    assert sailed["near joins"].changes == ((STEPS // 2, minds.pilot()),)
    half = sailed["near joins"].rewards.shape[1] // 2
    np.testing.assert_array_equal(sailed["near joins"].rewards[:, :half], sailed["far radar"].rewards[:, :half])


def test_what_is_watched_follows_the_run():
    seen = lives.watch(minds.reacher(2), lives.ARMS[2], 100, 50, 3)
    run = Run(minds.reacher(2), lives.ARMS[2], 3)
    run.advance(150)
    np.testing.assert_array_equal(seen[-1][0].scene.position, run.world_state.scene.position)
    assert len(seen) == 50 and not np.array_equal(seen[0][0].scene.position, seen[-1][0].scene.position)


def test_every_trial_in_the_pool_has_a_latency(swum):
    for by_name in swum.values():
        assert list(by_name) == ["neoRL", "Q-learning", "random"]
        for seconds in by_name.values():
            assert seconds.shape == (RUNS, pool.DAYS, pool.TRIALS_A_DAY)
            assert np.all((0 < seconds) & (seconds <= pool.MOVED.trial_seconds))


def test_an_experienced_swimmer_finds_a_new_place_again_at_the_second_trial(swum):
    assert scores.seconds_at_a_new_place(swum, "neoRL").mean() < 0.6 * scores.seconds_at_a_new_place(
        swum, "random").mean()


def test_paths_lead_from_the_rim_to_the_platform():
    for path in pool.last_path(pool.experienced(0), 2):
        assert math.dist(path[0], (0.5, 0.5)) == pytest.approx(0.45)


def test_cells_of_the_table_of_q_learning():
    cells = {(0.0, 0.0): 0, (0.999, 0.0): 8, (0.5, 0.5): 40, (1.0, 1.0): 80}
    assert {place: function_of(pool.cell_at)(np.array(place), 9) for place in cells} == cells


@pytest.mark.parametrize("here, there, steps", [
    ((0.5, 0.5), (0.5, 0.5), 0), ((0.5, 0.5), (0.57, 0.5), 0), ((0.5, 0.5), (0.65, 0.5), 2),
    ((0.5, 0.5), (0.65, 0.65), 4), ((0.1, 0.9), (0.9, 0.9), 15)])
def test_the_fewest_steps_to_a_bird(here, there, steps):
    assert birds.fewest(here, there) == steps


def test_an_agent_that_has_morphed_birds_makes_any_of_them(asked):
    assert {each.shape for each in asked.values()} == {(RUNS, len(birds.NAMED) + len(birds.NAMELESS))}
    assert max(asked["one map"].mean(), asked["a map of each"].mean()) < 2 < 5 < asked["random"].mean()


def test_actions_are_held_and_cells_are_those_of_the_agent():
    env, alone = hill.environment(), hill.environment(1)
    env.reset(seed=1), alone.reset(seed=1)
    seen, reward, *_ = env.step(2)
    assert reward == -hill.HELD
    for _ in range(hill.HELD):
        single, *_ = alone.step(2)
    np.testing.assert_array_equal(seen, single)
    rng = np.random.default_rng(0)
    points = rng.uniform([-1.2, -0.07], [0.6, 0.07], (300, 2))
    assert [hill.cell_of(*point) for point in points] == minds.driver().maps[0].encode(points).tolist()
    assert hill.cell_of(0.6, 0.07) == minds.COLUMNS * minds.ROWS - 1


def test_drivers_take_all_decisions(monkeypatch):
    monkeypatch.setattr(hill, "DECISIONS", 160)
    driven = hill.drive(1, 0)
    assert {each.shape for each in driven.values()} == {(1, hill.POINTS)}
    assert np.all(hill.learned(0).q() >= 0)


def test_more_is_better_in_every_score(reached, sailed, swum, asked, driven):
    found = scores.of_each_world(reached, sailed, swum, asked, driven)
    assert {each.shape for pair in found.values() for each in pair} == {(RUNS,)} and len(found) == 6
    assert all(found[world][0].mean() > found[world][1].mean() for world in ("water maze", "birds", "mountain car"))


def test_the_number_of_a_path_stands_beside_it():
    path = np.column_stack([np.linspace(0.05, 0.5, 90), np.full(90, 0.5)])
    axes = figures.draw_paths([path])
    (number,) = axes.texts
    assert number.get_text() == "1" and 0.04 < np.hypot(*(path - number.get_position()).T).min() < 0.06
    assert figures.draw_paths([path[:1]]).texts[0].get_position() == tuple(path[0])


def test_the_report_and_the_figures(reached, sailed, swum, asked, driven):
    verdicts = report.judge(reached, sailed, swum, asked, driven)
    found = scores.of_each_world(reached, sailed, swum, asked, driven)
    assert [claim.name for claim in verdicts] == ["G1", "G2", "G3", "G4"]
    assert {claim.verdict for claim in verdicts} == {"no verdict"}
    text = report.summary(verdicts, found)
    assert "birds" in text and "no verdict: efficient, general, compositional, incremental" in text
    feared = {valence: reached[2, "agent"] for valence in lives.VALENCES}
    assert report.reaching(reached, feared).count("\n") == 2 + 1 + len(lives.VALENCES)
    assert report.sailing(sailed).count("\n") == 1 + len(sailed) and "Trial 4" in report.swimming(swum)
    assert "| Seconds to the platform, from day 5 on |" in report.swimming(swum)
    assert "saves" in report.savings(swum) and "newborn" in report.thinking(asked, 6)
    assert "| 1.00 [" in report.driving(driven) and "343" in report.cells()
    assert report.luck({1: 0.0, 16: 0.1}).startswith("With actions held for 1 step a random driver reaches the flag")
    assert "arm" in report.searched()
    figures.draw_worlds(found)
    seen = lives.watch(minds.reacher(2), lives.ARMS[2], 100, 30, 3)
    left, right = figures.draw_arms(reached, seen)
    assert len(right.lines) == 4 and len(left.lines) > figures.SEEN
    left, right = figures.draw_vessel(sailed, lives.watch(minds.pilot(), lives.WATERS, 100, 30, 3))
    assert len(right.lines) == len(sailed)
    assert right.get_ylabel() == "reward per minute"  # as in the table
    assert right.lines[0].get_ydata()[-1] == pytest.approx(60 * sailed["radar"].rate(0.95).mean())
    figures.draw_pool(swum, pool.last_path(pool.experienced(0), 2))
    figures.draw_birds(asked, birds.path(True, 0, [(0.2, 0.3)]))
    figures.draw_car(driven, hill.learned(0))


def test_joints_of_a_posture():
    np.testing.assert_allclose(figures.joints_of(np.array([0.25, 0.75])), [[0, 0], [0, 0.5], [0.5, 0.5]], atol=1e-12)
