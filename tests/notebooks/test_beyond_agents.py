"""The page on the forager: what its cells build and run, the planners that lack knowledge, the records of searches."""

import numpy as np
import pytest
from page_cells import executed

from companion.alternatives.controllers import act_planner, planner
from companion.alternatives.search import best_settings
from companion.beyond_agents import figures, ideas, search
from neorl import NresMap, Run, WaterWorld, forager, kernel, multimodal, simulate
from neorl.agents.forager import AFTER_STATES
from neorl.custom import execute
from neorl.core.choices import Action

@pytest.fixture(scope="module")
def page():
    return executed("beyond_agents", steps=5_000, seed=5, n_creeps=4)


def test_all_parts_make_the_forager_and_none_the_bare_agent(page):
    assert page.agent_with(page.PARTS) == forager() and len(page.PARTS) == 8
    bare = page.agent_with(())
    assert (bare.contacts.fear, bare.contacts.rivals) == ("approach", 1.0)
    assert bare.contacts.first_value == bare.contacts.trace_rate == 0 and len(bare.nodes[0].modality.axes) == 2


def test_receptive_fields_are_as_large_without_mirror_images(page):
    widths, point = [], np.array([0.3, 0.2, 0.1, -0.4])
    for parts in (page.PARTS[:-1], [each for each in page.PARTS[:-1] if each != "mirror images"]):
        (node,) = page.agent_with(parts).nodes
        at = np.linspace(0, 1, 2_001)
        passed = np.column_stack([at, *(np.full(at.shape, each) for each in point[1:])])
        widths.append(len(set(NresMap(node.resolutions[0], node.modality).encode(passed).tolist())))
    assert abs(widths[0] - widths[1]) <= 1


def test_each_condition_has_another_agent_and_long_runs_are_four_times_as_long(page):
    made = page.made
    assert len({repr(each.agent) for each in made.values()}) == 19  # two ways lead to all parts but the last
    assert [made[f"{n} creeps"].world.n_creeps for n in (3, 8)] == [3, 8]
    assert {each.world.n_creeps for name, each in made.items() if "creeps" not in name} == {4}
    assert {each.steps for each in made.values()} == {5_000, 20_000}
    assert made["revalued"].changes == ((2_500, forager((5, 9, 15, 25), 1.0, 1.0)),)


def test_hits_per_second_count_all_hits():
    result = simulate(forager(), WaterWorld(), steps=2_000, runs=2, progress=False)
    minutes, rates = figures.hits_per_second(result, stretches=4)
    assert np.allclose(sum(rates["green"].T) * result.seconds / 4, result.hits[:, :, 0].sum(axis=1))
    assert np.allclose(minutes, (np.arange(4) + 0.5) * result.seconds / 240)


def test_fear_stays_low_where_there_is_a_way_out(page):
    known = np.isfinite(page.fears).all(axis=0)
    middles, mean = page.edges[:-1][known] + 0.025, page.fears[:, known].mean(axis=0)
    assert mean[middles < 0.6].max() < 0.1 < mean.max()


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


def test_gains_move_to_where_reward_is(page, monkeypatch):
    """Where the reward is the gain itself, the parameter rises; with a rate of 0 it stays."""
    monkeypatch.setattr(Run, "advance", lambda run, steps: run.agent.nodes[0].gain * steps / run.world.fps)
    monkeypatch.setitem(page.adapt.__globals__, "steps", 80_000)
    gain = lambda octaves: multimodal(place_gain=octaves + 10)  # noqa: E731
    path, rewards = page.adapt(gain, (0.0,), 0.5, 0.5, 0)
    assert path.shape == (21, 1) and rewards.shape == (40,)
    assert path[-1, 0] == page.HIGHEST and np.all(np.diff(path[:, 0]) >= 0)
    path, shaken = page.adapt(gain, (0.0,), 0.5, 0.0, 0)
    assert not path.any() and {*shaken} == {9.5, 10.5}


def test_the_network_of_the_page_is_the_best_of_its_record(page):
    record = search.tried_networks()
    assert len(record) == search.SETTINGS * len(search.LAYERS)
    best = next(row for row in record if row["layers"] == 2)
    network = page.control_network(2, search.best_setting(2))
    assert search.earned_by(network) == pytest.approx(best["earned"], abs=2e-3)


def test_the_forager_is_the_best_of_its_record():
    best = search.tried_foragers()[0]
    assert search.agent_of(best) == forager()
    found = simulate(forager(), WaterWorld(), runs=4, steps=150_000, seed=search.SEED, progress=False)
    assert np.isclose(found.rate(2 / 3).mean(), best["with_3"], atol=2e-3)


def test_ideas_lead_from_the_forager_to_that_of_after_states_one_by_one():
    assert ideas.agent_with(()) == forager() and ideas.agent_with(ideas.IDEAS) == forager(**AFTER_STATES)
    agents = {name: ideas.agent_with(each) for name, each in ideas.agents().items()}
    assert len({repr(each) for each in agents.values()}) == len(agents) == 2 + 2 * len(ideas.IDEAS)
    for idea in ideas.IDEAS:
        assert changes(agents[f"{idea} alone"], agents[ideas.WITHOUT]) == 1 + (idea in ideas.NEEDED)
        assert changes(agents[f"all but {idea}"], agents[ideas.ALL]) == 1 + (idea in ideas.NEEDED.values())


def changes(agent, other):
    """The number of parameters by which two foragers differ."""
    of_contacts = [getattr(agent.contacts, each) != getattr(other.contacts, each) for each in vars(agent.contacts)]
    return sum(of_contacts) + (agent.nodes != other.nodes)


@pytest.mark.parametrize("name, creeps", [(ideas.ALL, 3), ("all but twelve maps", 8)])
def test_the_record_of_ideas_has_the_runs_of_its_seeds(name, creeps):
    run = Run(ideas.agent_with(ideas.agents()[name]), WaterWorld(n_creeps=creeps), seed=ideas.SEEDS[5])
    earned = [run.advance(ideas.STEPS // 3) / (ideas.STEPS / 3 / run.world.fps) for _ in range(3)]
    thirds = ideas.thirds_of(name, creeps)
    assert thirds.shape == (len(ideas.SEEDS), 3) and np.allclose(thirds[5], earned, atol=2e-2)


def test_what_is_said_of_a_target_follows_from_the_record(monkeypatch):
    mean = ideas.thirds_of(ideas.ALL)[:, -1].mean()
    for target, words in ((mean - 0.2, "reached"), (mean + 0.2, "not reached"), (mean, "neither reached nor missed")):
        monkeypatch.setattr(ideas, "TARGETS", {ideas.ALL: target})
        assert f"target of {target} is {words};" in ideas.sentence()
