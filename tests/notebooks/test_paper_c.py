"""The page of paper C: the experiment in its cells, its parameters, and where desires land."""

from dataclasses import replace

import numpy as np
import pytest
from page_cells import LAST, assert_captions_and_prose_speak_of_what_is_drawn, executed

from companion import paper_c
from neorl import Learning, Policy, Run, WaterWorld, network_b
from companion.thesis.reading import READINGS, Reading, conditions, networks
from neorl.experiments.condition import Condition


@pytest.mark.parametrize("name", READINGS)
def test_the_page_runs_and_judges_the_networks_of_a_reading(name):
    page = executed("paper_c", until=LAST[name], reading=name)
    expected = conditions(READINGS[name], 1_000, 2, groups=["networks"])
    ran = {key: each.condition for key, each in (page.results | page.control).items()}
    assert ran == {key[1] if key[0] == "network" else "Brownian": each for key, each in expected.items()}
    assert [claim.name for claim in page.judged] == ["C1", "C2", "C3", "C4"]
    assert not any(claim.full_length for claim in page.judged)


@pytest.fixture(scope="module")
def page():
    """The page with other networks and another board."""
    return executed("paper_c", recursion=-0.5, n_creeps=5, resolutions=(2, 7))


def test_parameters_are_those_of_the_networks_and_their_variations_and_other_ones_are_not_judged(page):
    agents = networks(Reading(recursion=-0.5, network_resolutions=(2, 7)))
    assert {name: each.agent for name, each in page.results.items()} == agents
    assert {each.world for each in page.results.values()} == {WaterWorld(n_creeps=5)} and page.judged == []
    for name, variant in page.variants.items():
        assert {each.world.n_creeps for each in page.varied[name].values()} == {5}
        assert page.varied[name]["D"].agent == networks(variant)["D"] and variant.recursion == -0.5


def test_captions_and_prose_speak_of_what_is_drawn(page):
    assert_captions_and_prose_speak_of_what_is_drawn("paper_c", page.parts_drawn)


def test_the_moment_is_the_first_seen_at_which_the_agent_is_well_inside_and_desires_something_far(monkeypatch):
    monkeypatch.setattr(paper_c, "FAR", 0.001)
    network, world = network_b([2, 3]), WaterWorld()
    run, other = paper_c.moment_of_desire(network, world, 300, seed=1), Run(network, world, 1)
    assert 300 <= run.step < 300 + paper_c.PATIENCE
    other.advance(300)
    fits = []
    for _ in range(300, run.step + 1, paper_c.EVERY):
        at = other.world_state.scene.position / world.size
        lands = np.hypot(*other.state.desires.target_at[2:].T)  # after the desires for creeps
        fits.append(np.abs(at - 0.5).max() < 0.2 and lands.max() > 0.001)
        other.advance(paper_c.EVERY)
    assert fits[-1] and not any(fits[:-1])


MOVING = Reading(Learning(0.03, 0.8, credit="share"), object_state="object", policy=Policy(0.1))


def test_desires_that_land_on_the_agent_are_distinguished_from_those_that_do_not():
    def distances(name, scale):
        agent = networks(replace(MOVING, scale=scale))[name]
        return paper_c.distances(Condition(agent, WaterWorld(), 20_000, 2), runs=2)

    for name in "ABCD":
        widths, share, beyond = distances(name, scale=1e-6)
        assert widths.shape == (2,) and np.all(widths < 0.01) and np.all(share == 1) and not np.any(beyond)
    widths, share, beyond = distances("D", scale=1e6)
    assert np.all(widths > 1) and np.all(share < 1) and np.all(beyond > 0)
