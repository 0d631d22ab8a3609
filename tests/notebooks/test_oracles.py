"""The gaps between the forager and the planner, networks down to control, and gains that adapt to reward."""

import numpy as np
import pytest

from lib.alternatives.controllers import act_planner, planner
from lib.alternatives.living import BOARDS, live
from lib.alternatives.search import best_settings
from lib.beyond_agents import adapting, control, figures, oracles, report
from neorl import GREEDY, Agent, Contacts, Desire, Learning, Node, Run, WaterWorld, multimodal
from neorl.agents.beyond import foveated_cells
from neorl.core.choices import Action
from neorl.core.kernel import execute, kernel
from neorl.core.modality import Modality, cartesian


@pytest.fixture(scope="module")
def boards():
    return oracles.rates_by_creeps(9_000, 2, 5)


def test_gaps_add_up_to_the_distance(boards):
    for rates in boards.values():
        assert sum(oracles.shares(rates).values()) == pytest.approx(1.0)
        assert sum(gap.mean() for gap in oracles.gaps(rates).values()) == pytest.approx(
            rates[oracles.ALL].mean() - rates[oracles.FORAGER].mean())


def test_the_page_says_and_draws_the_gaps(boards):
    text = report.gaps_in_words(boards)
    assert "With 3 creeps" in text and "With 8 creeps" in text and text.count("Perfect ") == 2
    assert report.gap_table(boards).count("\n") == 1 + 4
    labels = [label.get_text() for label in figures.draw_oracles(boards).get_yticklabels()]
    assert labels == [oracles.BLIND_FORAGER, oracles.FORAGER, *oracles.ORACLES]


def test_a_planner_that_knows_of_red_creeps_meets_fewer():
    gains = best_settings()["PD"]
    earned = {avoiding: live(planner(gains, captures=1, avoiding=avoiding), BOARDS[8], steps=3_000, runs=4, bins=1)
              for avoiding in (False, True)}
    assert earned[True].rewards.sum() > 1.3 * earned[False].rewards.sum()


@kernel
def ask(setting, memory, state, rules, found):
    found[0] = act_planner(setting, memory, state, rules)


def test_a_plan_of_one_capture_does_not_look_beyond():
    """Two green creeps east of the agent, one behind the other, and a nearer one to its west."""
    world, gains = WaterWorld(n_creeps=3), best_settings()["PD"]
    state = world.reset(0)
    state.speed[:] = 0
    state.scene.kinds[:] = 0
    state.scene.things[:] = [[125 + 62, 125], [125 + 88, 125], [125 - 58, 125]]
    chosen = {}
    for captures in (1, 2):
        contestant, found = planner(gains, captures=captures), np.zeros(1, int)
        execute(ask, contestant.setting, contestant.new_memory(world, None), state, world.rules, found)
        chosen[captures] = found[0]
    assert chosen[1] != Action.E == chosen[2]


def desiring_velocities(scale):
    """An agent that wants a velocity towards a green creep."""
    velocities = Modality("velocity cell", cartesian("velocity", (-1, 1), (-1, 1)))
    return Agent([Node("OVC", foveated_cells(velocity=False), (5,), gain=0.0, goals="contacts"),
                  Node("V", velocities, (9,))],
                 [Desire("green", "OVC", 1.0), Desire("OVC", "V", 1.0, scale=scale)],
                 Learning(0.1, 0.9, update_on="step"), GREEDY, own_cell="silent", contacts=Contacts(first_value=0.0))


def test_a_desire_vector_is_a_velocity_for_a_node_of_velocities():
    run, elsewhere = Run(desiring_velocities(50.0), WaterWorld(), 3), 0
    run.advance(30_000)
    velocities = run.agent.maps[1]
    for _ in range(100):
        here, known = velocities.encode(run.world_state.scene.velocity / run.world.size), run.q(1).copy()
        run.advance(1)
        goal = velocities.encode(50.0 * run.output("OVC").desire)
        if goal != here and run.output("V").valence:  # otherwise the desire is met, or the board is new
            elsewhere += 1
            assert np.array_equal(run.output("V").q, known[here, :, goal])
    assert elsewhere > 10


def test_networks_down_to_control_are_those_of_the_record():
    record = control.read_record()
    assert len(record) == control.SETTINGS * len(control.NETWORKS)
    best = next(row for row in record if row["layers"] == 2)
    assert control.best_networks()["two layers"] == control.control_network(2, control.setting_of(2, best["number"]))
    assert control.earned_by(2, best["number"]) == pytest.approx(best["earned"], abs=2e-3)
    with pytest.raises(ValueError, match="layers must be 2 or 3, but is 4"):
        control.control_network(4, {})


def test_the_page_compares_networks():
    results = control.compared(1_000, 2)
    text = report.networks_in_words(results)
    assert list(results) == [*control.NETWORKS, control.ALONE, control.FORAGER]
    assert all(f"{name} " in text for name in results)


def test_gains_move_to_where_reward_is(monkeypatch):
    """Where the reward is the gain itself, the parameter rises; with a rate of 0 it stays."""
    monkeypatch.setattr(Run, "advance", lambda run, steps: run.agent.nodes[0].gain * steps / run.world.fps)
    adaptable = adapting.Adaptable(lambda octaves: multimodal(place_gain=octaves + 10), ("gain",), (0.0,))
    path, rewards = adapting.adapt(adaptable, 40_000)
    assert path.shape == (21, 1) and rewards.shape == (40,)
    assert path[-1, 0] == adapting.HIGHEST and np.all(np.diff(path[:, 0]) >= 0)
    path, _ = adapting.adapt(adaptable, 40_000, rate=0.0)
    assert not path.any()


def test_the_page_says_and_draws_what_adapting_brings():
    lives = adapting.lives(2_000, 2, 1)
    text = report.adapting_in_words(lives)
    assert all(f"{name[1:]}**: " in text for name in adapting.ADAPTABLE)
    for of_ways in lives.values():
        names = [text.get_text() for text in figures.draw_adapting(of_ways).texts]
        assert sorted(names) == sorted(of_ways)
