"""The experiments of paper B, against lives that are followed step by step."""

from dataclasses import replace

import numpy as np
import pytest

import neorl
from neorl.agents import papers
from neorl.chapters import paper_b
from neorl.evidence.reading import Reading

READING = Reading(causes="any", capture="contact", attention="each", place_gain=1.0, weighting="resolution")
PRIMES = (2, 3)


@pytest.fixture(autouse=True)
def small(monkeypatch):
    """Maps of few cells."""
    monkeypatch.setattr(paper_b, "PRIMES", PRIMES)


def test_main_conditions_have_all_runs_and_others_fewer():
    made = paper_b.experiments(READING, 1_000, 60, seed=3)
    assert {made[key].runs for key in paper_b.AGENTS.values()} == {60}
    assert made["place", 3].runs == made["revalued"].runs == made["joined"].runs == 10
    assert {each.seed for each in made.values()} == {3}
    assert [paper_b.few(runs) for runs in (1, 10, 20, 100)] == [1, 10, 10, 10]


def test_object_vector_cells_join_place_cells_at_half_time():
    made = paper_b.experiments(READING, 1_000, 2)
    assert made["joined"].agent == made["place", "all"].agent
    assert made["joined"].changes == ((500, made["both"].agent),)


def test_points_are_taken_from_the_same_lives(cache_folder):
    made = paper_b.experiments(READING, 4_000, 1)
    chosen = {key: made[key] for key in ("both", ("points", "PC + OVC"))}
    results = paper_b.live({"calibrated": chosen})["calibrated"]
    np.testing.assert_array_equal(results["both"].hits, results["points", "PC + OVC"].hits)
    (found,) = paper_b.points_a_reset(results).values()
    boards = results["points", "PC + OVC"].totals[0] - results["both"].totals[0]
    assert boards > 0 and found.value == results["both"].totals[0] / boards


def test_conditions_that_readings_share_are_lived_once(cache_folder):
    made = paper_b.experiments(READING, 1_000, 1)
    lived = paper_b.live({name: {"both": made["both"]} for name in "ab"})
    assert lived["a"]["both"] is lived["b"]["both"]


def test_neighbours_differ_in_one_choice():
    made = paper_b.neighbours(READING, 1_000, 2)
    assert "causes: own" in made and "gain of place, B: 3" in made
    assert READING.capture not in [name.split(": ")[1] for name in made if name.startswith("capture")]
    wanted = made["attention: wanted"]["both"].agent
    assert wanted.learning == replace(READING.learning, attention="wanted")


def test_a_stay_is_the_time_from_one_change_of_cell_to_the_next_but_for_resets():
    (found,) = paper_b.mean_stays(READING, 8_000, 1)
    agent = papers.place_cells(PRIMES, **READING.place_agents)
    run, changes = neorl.Run(agent, neorl.WaterWorld(win_reward=100.0), 0), np.zeros(2)
    run.advance(2_000)
    run.advance(1)
    resets = 0
    for _ in range(1_999):
        before = run.state.tracks.cell.copy()
        reset = run.advance(1) > 50
        resets += reset
        changes += (run.state.tracks.cell != before) & (not reset)
    assert resets > 0
    np.testing.assert_allclose(found, 40 / changes)


def test_the_desired_place_moves_and_experience_is_worth_something():
    moved, seconds = paper_b.distances(READING, 40_000, 2)
    assert moved["ignorant"].shape == moved["experienced"].shape == (2, 6, 150) and seconds[-1] == 30
    run = neorl.Run(papers.place_cells(PRIMES, **READING.place_agents), neorl.WaterWorld(), 0, 1)
    run.advance(10_000)
    for place in paper_b.PLACES:
        run.change(paper_b.desiring(READING, place))
        run.advance(1_500)
        at = run.world_state.agent_position / 250 - (place.x, place.y)
        assert np.hypot(*at) in moved["experienced"][1, :2, -1]
    assert moved["experienced"].mean() < moved["ignorant"].mean()


def test_values_are_those_of_goals_that_can_be_asked_for():
    found = paper_b.mean_values(READING, 5_000, 1)
    run = neorl.Run(papers.multimodal(PRIMES, **READING.agents), neorl.WaterWorld())
    run.advance(5_000)
    expected = {"PC": 0.0, "OVC": 0.0}
    for m, (node, n) in enumerate([("PC", 2), ("PC", 3), ("OVC", 2), ("OVC", 3)]):
        contact = int(run.agent.maps[m].encode([0, 0]))
        goals = range(n * n) if node == "PC" else [contact]
        best = [neorl.superpose(run.q(m), state, [goal], [1.0]).max() for state in range(n * n) for goal in goals
                if state != goal]
        expected[node] += np.mean(best) * n / 5
    assert expected["OVC"] > 0
    for node, value in expected.items():
        np.testing.assert_allclose(found[node], [value], rtol=1e-5)


def test_costs_are_of_agents_with_one_map_more_each_time():
    both = papers.multimodal(PRIMES)
    one = paper_b._with_maps(both, [("PC", 2), ("OVC", 3)])
    assert [(node.name, node.resolutions) for node in one.nodes] == [("PC", (2,)), ("OVC", (3,))]
    assert one.desires == both.desires and paper_b._with_maps(both, []).desires == ()
    cost = paper_b.measure_costs(READING, 500, 3)
    assert cost.labels == ["PC N2", "PC N3", "OVC N2", "OVC N3"]
    assert cost.alone.shape == cost.first.shape == (4, 3) and (cost.first > 0).all()
    assert cost.measured[0] == cost.predicted[0]


def test_red_creeps_a_minute_add_up_to_those_taken(cache_folder):
    made = paper_b.experiments(READING, 6_000, 1)["both"]
    result = neorl.simulate(**made.choices, progress=False)
    curves, minutes = paper_b.red_a_minute(result, stretches=10)
    assert curves.shape == (1, 10) and minutes[-1] == pytest.approx(1.9)
    assert curves.mean() * 2 == pytest.approx(result.hits[..., 1].sum())
