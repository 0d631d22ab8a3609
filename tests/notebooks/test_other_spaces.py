"""The page "Is it general?": its agents, its trials in each world, and the rivals."""

import math

import numpy as np
import pytest
from page_cells import assert_captions_end_with_numbers_of_their_figures, executed

from companion.other_spaces import trials
from companion.shared.tabular import Rates
from neorl import Learning, Policy, Run, Scene, WaterWorld, place_cells, simulate
from neorl.agents.spaces import FAR_RADAR, pilot, reacher, swimmer
from neorl.core.coordinates import sense
from neorl.kernels.kernel import function_of

RUNS, STEPS = 2, 3_000


@pytest.fixture(scope="module")
def page():
    return executed("other_spaces", steps=STEPS)


def test_all_agents_have_one_rule_and_one_policy(page):
    agents = [reacher(2), reacher(3), pilot(), swimmer(), page.far_pilot, page.compass_pilot, page.one_map,
              page.map_of_each, page.driver]
    assert {(agent.learning, agent.policy, agent.own_cell) for agent in agents} == {
        (Learning(credit="share"), Policy(), "silent")}


@pytest.mark.parametrize("thing, turns", [((0.9, 0.5), 0.0), ((0.5, 0.9), 0.25), ((0.1, 0.5), 0.5), ((0.5, 0.1), 0.75)])
def test_a_bearing_is_seen_from_the_bow(thing, turns):
    for heading in (0.0, 1.0, 4.0):
        to_world = np.array([[math.cos(heading), -math.sin(heading)], [math.sin(heading), math.cos(heading)]])
        place = 0.5 + to_world @ (np.array(thing) - 0.5)
        scene = Scene(np.array([0.5, 0.5]), 0.1 * to_world[:, 0], place[None], np.zeros(1, int), np.zeros(1, int))
        (seen,) = sense(FAR_RADAR.modality, scene, 1.0)
        assert (seen[1] - turns + 0.5) % 1 == pytest.approx(0.5, abs=1e-9)
        assert seen[0] == pytest.approx(0.4)


def test_a_second_map_joins_at_half_time(page):
    assert page.sailed["near joins"].changes == ((STEPS // 2, pilot()),)
    assert page.sailed["near joins"].agent == page.sailed["far radar"].agent == page.far_pilot


def test_what_is_watched_follows_the_run():
    result = simulate(place_cells([3]), WaterWorld(), steps=100, runs=1, seed=3, progress=False)
    seen = trials.watch(result, 50)
    run = Run(result.agent, result.world, 3)
    run.advance(150)
    np.testing.assert_array_equal(seen[-1][0].scene.position, run.world_state.scene.position)
    assert len(seen) == 50 and not np.array_equal(seen[0][0].scene.position, seen[-1][0].scene.position)


def test_an_experienced_swimmer_finds_a_new_place_again_at_the_second_trial(page):
    for by_swimmer in page.swum.values():
        for seconds in by_swimmer.values():
            assert seconds.shape == (RUNS, 8, 4) and np.all((0 < seconds) & (seconds <= page.moved.trial_seconds))
    again = {name: seconds[:, page.late, 1].mean() for name, seconds in page.swum["moved"].items()}
    assert again["neoRL"] < 0.6 * again["random"]


def test_cells_of_the_table_of_q_learning():
    numbers = {(0.0, 0.0): 0, (0.999, 0.0): 8, (0.5, 0.5): 40, (1.0, 1.0): 80}
    assert {place: function_of(trials.cell_at)(np.array(place), 9) for place in numbers} == numbers


@pytest.mark.parametrize("here, there, steps", [
    ((0.5, 0.5), (0.5, 0.5), 0), ((0.5, 0.5), (0.57, 0.5), 0), ((0.5, 0.5), (0.65, 0.5), 2),
    ((0.5, 0.5), (0.65, 0.65), 4), ((0.1, 0.9), (0.9, 0.9), 15)])
def test_the_fewest_steps_to_a_bird(page, here, there, steps):
    assert trials.fewest(page.square, here, there) == steps


def test_an_agent_that_has_morphed_birds_makes_any_of_them(page):
    assert {each.shape for each in page.asked.values()} == {(RUNS, len(page.named) + len(page.nameless))}
    assert max(page.asked["one map"].mean(), page.asked["a map of each"].mean()) < 2 < 5 < page.asked["random"].mean()


def test_actions_are_held(page):
    env, alone = page.mountain_car(), page.mountain_car(1)
    env.reset(seed=1), alone.reset(seed=1)
    seen, reward, *_ = env.step(2)
    assert reward == -16
    for _ in range(16):
        single, *_ = alone.step(2)
    np.testing.assert_array_equal(seen, single)


def test_the_length_of_an_episode_counts_where_it_ends():
    ends = np.zeros(16, bool)
    ends[[1, 2, 3, 5, 7, 9, 11, 13, 15]] = True
    assert trials.lengths(np.full(16, -16.0), ends).tolist() == [32, 16, 32, 32, 32, 32, 32, 32]


def test_q_learning_drives_sooner_to_the_flag_than_chance(page):
    learned, chance = (trials.drive_by_table(page.mountain_car(), page.driver.maps[0], rates, 2_400, 1)
                       for rates in (Rates(0.3, 1.0, 0.05), Rates(0.0, 1.0, 1.0)))
    assert learned.shape == (trials.POINTS,) and learned[-2:].mean() < 190 < chance[-2:].mean()


def test_more_is_better_in_every_score(page):
    assert {each.shape for pair in page.scores.values() for each in pair} == {(RUNS,)} and len(page.scores) == 6
    assert all(page.scores[world][0].mean() > page.scores[world][1].mean() for world in ("water maze", "birds"))


def test_a_claim_is_judged_with_a_verdict_only_of_runs_as_long_as_its_own(page):
    assert [(claim.name, claim.full_length) for claim in page.judged] == [("G1", True), ("G3", True), ("G4", False)]


def test_a_claim_is_judged_only_of_the_page_s_own_agents_and_worlds():
    changes = ("HELD = 16", "HELD = 8"), ("(map_of_each, 20_000)", "(map_of_each, 10_000)")
    assert [claim.name for claim in executed("other_spaces", changes, "judging", traffic=12).judged] == ["G1"]


def test_captions_end_with_numbers_of_their_figures(page):
    assert_captions_end_with_numbers_of_their_figures(page, ["spaces-6", "spaces-29"])
