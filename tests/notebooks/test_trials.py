"""Trials of paper B's agents, on its page and in chapter 5, against runs followed step by step."""

import numpy as np
import pytest

import neorl
from neorl import Condition, Learning
from neorl.agents import papers
from neorl.core.horde import superpose
from companion.chapter_5 import trials as changes
from companion.paper_b import trials
from companion.thesis.reading import Reading

READING = Reading(Learning(0.03, 0.8, credit="share"), object_state="object", object_tiled_fraction=1.0,
                  object_beyond="outermost", object_centred=False, place_gain=1.0,
                  weighting="resolution")  # whatever the defaults
PRIMES = (2, 3)
PLACE, BOTH = papers.place_cells(PRIMES, **READING.agents), papers.multimodal(PRIMES, **READING.agents)
TANK = neorl.WaterWorld()


def test_a_stay_is_the_time_from_one_change_of_cell_to_the_next_but_for_resets():
    stays = trials.mean_stays(Condition(PLACE, TANK, 8_000, 1))
    (found,) = stays.seconds
    run, changes = neorl.Run(PLACE, neorl.WaterWorld(win_reward=100.0), 0), np.zeros(2)
    run.advance(2_000)
    resets = 0
    for _ in range(2_000):
        before = run.memory.tracks.cell.copy()
        reset = run.advance(1) > 50
        resets += reset
        changes += (run.memory.tracks.cell != before) & (not reset)
    assert resets > 0
    np.testing.assert_allclose(found, 40 / changes)
    assert [each.shape for each in stays.without.values()] == [(1, 2)] * 2
    assert all((each != found).all() for each in stays.without.values())


def test_the_desired_place_moves_and_experience_is_worth_something():
    _, moved, seconds = found = changes.distances(Condition(PLACE, TANK, 40_000, 2))
    assert {*{desire.target for desire in changes.desiring(BOTH, changes.PLACES[0]).desires}} == {"PC", "OVC"}
    np.testing.assert_allclose(found.means["ignorant"], moved["ignorant"].mean(axis=2))
    assert moved["ignorant"].shape == moved["experienced"].shape == (2, 6, 150) and seconds[-1] == 30
    run = neorl.Run(PLACE, TANK, 0, 1)
    run.advance(10_000)
    for place in changes.PLACES:
        run.change(changes.desiring(PLACE, place))
        run.advance(1_500)
        at = run.world_state.scene.position / 250 - place.coordinates
        assert np.hypot(*at) in moved["experienced"][1, :2, -1]
    assert moved["experienced"].mean() < moved["ignorant"].mean()


def test_values_are_those_of_goals_that_can_be_asked_for():
    found = trials.mean_values(BOTH, TANK, 5_000, 1)
    run = neorl.Run(BOTH, TANK)
    run.advance(5_000)
    expected = {"PC": 0.0, "OVC": 0.0}
    for m, (node, n) in enumerate([("PC", 2), ("PC", 3), ("OVC", 2), ("OVC", 3)]):
        contact = int(run.agent.maps[m].encode([0, 0]))
        goals = range(n * n) if node == "PC" else [contact]
        best = [superpose(run.q(m), state, [goal], [1.0]).max() for state in range(n * n) for goal in goals
                if state != goal]
        expected[node] += np.mean(best) * n / 5
    assert expected["OVC"] > 0
    for node, value in expected.items():
        np.testing.assert_allclose(found[node], [value], rtol=1e-5)


def test_an_object_is_the_goal_or_the_state():
    agents = {state: papers.object_vector_cells([2, 5], object_state=state) for state in ("self", "object")}
    learned = trials.learn(agents, neorl.WaterWorld(), 4_000, 2, seed=3)
    again = neorl.Run(agents["self"], neorl.WaterWorld(), 3, 1)
    again.advance(4_000)
    np.testing.assert_array_equal(learned["self"][1].q(1), again.q(1))
    for state, (run, _) in learned.items():
        centre = int(run.agent.maps[1].encode([0, 0]))
        values = trials.values_for_objects(run, 1)
        for cell in (0, 7, 24):
            expected = run.q(1)[0, :, cell] if state == "self" else run.q(1)[cell, :, centre]
            np.testing.assert_array_equal(values[cell], expected)
        best = np.delete(values.max(axis=1), centre)
        assert trials.best_values(run)[1] == pytest.approx(best.mean()) and best.any()


def test_a_map_of_one_cell_has_no_other_to_go_to():
    run = neorl.Run(papers.multimodal([1, 3], **READING.agents), TANK)
    run.advance(3_000)
    assert trials.best_values(run)[[0, 2]].tolist() == [0, 0] and trials.best_values(run)[[1, 3]].all()
