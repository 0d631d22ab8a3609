"""The page of paper C: the experiment in its cells, its parameters, and where desires land."""

from dataclasses import replace

import numpy as np
import pytest
from page_cells import planned, source

from companion import paper_c
from neorl import Learning, Policy, Result, Run, WaterWorld, network_b
from companion.thesis.reading import READINGS, Reading, conditions, networks
from neorl.experiments.condition import Condition


def experiment(*cells, **parameters):
    """The names that the page's cells define down to its experiment, with an iterator of conditions for results."""
    return planned("paper_c", "1e283f34", *cells, **parameters)


@pytest.mark.parametrize("name", READINGS)
@pytest.mark.parametrize("steps", [4_000, 300_000, 600_000])
def test_the_page_runs_the_networks_of_a_reading(name, steps):
    page = experiment(reading=name, runs=3, steps=steps, seed=2)
    expected = conditions(READINGS[name], steps, 3, 2, groups=["networks"])
    assert page["results"] | page["control"] == {key[1] if key[0] == "network" else "Brownian": each
                                                 for key, each in expected.items()}


def test_weights_and_creeps_and_maps_are_those_of_the_parameters():
    page = experiment(recursion=-0.5, n_creeps=5, resolutions=(2, 7))
    agents = networks(Reading(recursion=-0.5, network_resolutions=(2, 7)))
    assert {name: each.agent for name, each in page["results"].items()} == agents
    assert {each.world for each in page["results"].values()} == {WaterWorld(n_creeps=5)}


def without_reward(conditions):
    """Made-up results of conditions."""
    return (Result(each, np.zeros((each.runs, bins := each.steps // 10), np.float32),
                   np.zeros((each.runs, bins, 2), np.int16)) for each in conditions)


@pytest.mark.parametrize("parameters, judged", [
    ({}, True), ({"recursion": -0.5}, False), ({"n_creeps": 4}, False), ({"resolutions": (3, 7)}, False),
    ({"resolutions": (3, 7, 23)}, True), ({"network_a": network_b}, False)])
def test_claims_are_judged_only_if_what_the_paper_ran_is_what_was_run(parameters, judged):
    for name in READINGS:
        claims = experiment("ran", "judging", reading=name, runs=2, steps=2_000, sweep=without_reward,
                            **parameters)["judged"]
        assert [claim.name for claim in claims] == (["C1", "C2", "C3", "C4"] if judged else [])


def test_runs_as_long_as_the_paper_s_give_verdicts_and_shorter_ones_do_not():
    for steps in (300_000, 299_990):
        claims = experiment("ran", "judging", runs=2, steps=steps, sweep=without_reward)["judged"]
        assert {claim.full_length for claim in claims} == {steps == 300_000}


def test_the_variations_are_those_of_what_was_run_whatever_the_parameters_are_now():
    names = experiment("ran", runs=3, steps=4_000, n_creeps=5, recursion=-0.5)
    names |= {"n_creeps": 8, "steps": 9_000, "recursion": 2.0}
    exec(source("paper_c", "variations"), names)
    for name, variant in names["variants"].items():
        assert {each.world.n_creeps for each in names["varied"][name].values()} == {5}
        assert names["varied"][name]["D"].agent == networks(variant)["D"] and variant.recursion == -0.5
        assert names["varied"][name]["D"].steps == 4_000


def test_the_moment_is_the_first_seen_at_which_the_agent_is_well_inside_and_desires_something_far(monkeypatch):
    monkeypatch.setattr(paper_c, "FAR", 0.001)
    network, world = network_b([2, 3]), WaterWorld()
    run, other = paper_c.moment_of_desire(network, world, 300, seed=1), Run(network, world, 1)
    assert 300 <= run.step < 300 + paper_c.PATIENCE
    other.advance(300)
    fits = []
    for _ in range(300, run.step + 1, paper_c.EVERY):
        at = other.world_state.scene.position / world.size
        lands = np.hypot(*other.state.desires.target[2:, :2].T)  # after the desires for creeps
        fits.append(np.abs(at - 0.5).max() < 0.2 and lands.max() > 0.001)
        other.advance(paper_c.EVERY)
    assert fits[-1] and not any(fits[:-1])


MOVING = Reading(Learning(0.03, 0.8, credit="share"), object_state="object", policy=Policy(0.1))


def test_desires_that_land_on_the_agent_are_distinguished_from_those_that_do_not():
    near, far = ({name: paper_c.distances(Condition(agent, WaterWorld(), 60_000, 2), runs=2)
                  for name, agent in networks(replace(MOVING, scale=scale)).items()} for scale in (1e-6, 1e6))
    for widths, share, beyond in near.values():
        assert widths.shape == (2,) and np.all(widths < 0.01) and np.all(share == 1) and not np.any(beyond)
    widths, share, beyond = far["D"]
    assert np.all(widths > 1) and np.all(share < 1) and np.all(beyond > 0)
