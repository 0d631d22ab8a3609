"""The page of paper C: the experiment in its cells, its parameters, where desires land, and runs that stand still."""

import re
from dataclasses import replace

import numpy as np
import pytest
from page_cells import (LAST, assert_captions_and_prose_speak_of_what_is_drawn,
                        assert_captions_end_with_numbers_of_their_figures, executed)

from companion import paper_c
from companion.thesis.reading import A_LITTLE, NODES, READINGS, Reading, conditions, networks, nodes
from neorl import Condition, Learning, Policy, Result, Run, WaterWorld, network_b, network_c, simulate


@pytest.mark.parametrize("name", READINGS)
def test_the_page_runs_and_judges_the_networks_of_a_reading(name):
    page = executed("paper_c", until=LAST[name], reading=name)
    expected = conditions(READINGS[name], 1_000, 2, groups=["networks"])
    ran = {key: each.condition for key, each in (page.results | page.control).items()}
    names = {"network": lambda name: name, "node": NODES.get, "brownian": lambda creeps: "Brownian"}
    assert ran == {names[kind](name): each for (kind, name), each in expected.items()}
    assert {"C1", "C2", "C3", "C4"} <= {claim.name for claim in page.judged}
    assert not any(claim.full_length for claim in page.judged)


@pytest.fixture(scope="module")
def page():
    """The page with other networks and another board."""
    return executed("paper_c", recursion=-0.5, n_creeps=5, resolutions=(2, 7))


def test_parameters_are_those_of_the_networks_and_their_variations_and_other_ones_are_not_judged(page):
    reading = Reading(recursion=-0.5, network_resolutions=(2, 7))
    agents = networks(reading) | {NODES[name]: agent for name, agent in nodes(reading).items()}
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


def test_the_page_lets_networks_and_their_nodes_explore(page):
    assert [*page.exploring] == ["C", "D", *NODES.values()]
    for name, result in page.exploring.items():
        agent = page.results[name].agent
        assert result.agent == replace(agent, policy=replace(agent.policy, exploration=A_LITTLE))


def test_what_the_explorer_offers_before_the_page_has_run_has_what_the_page_runs():
    results = executed("paper_c", until="judging").results
    offered, ran = paper_c.of_paper(), paper_c.explorer_conditions(results, of_paper=True)
    assert [*offered] == [*ran]
    for name, result in ran.items():
        assert (offered[name].agent, offered[name].world) == (result.agent, result.world)


def touching(*touches, steps=1_000):
    """A result of runs that touch so many green creeps in every bin from the tenth of the run on, and earn as much."""
    condition = Condition(network_c([2]), WaterWorld(), steps, len(touches))
    (bins,) = simulate(network_c([2]), WaterWorld(), steps=steps, runs=1).time.shape
    hits = np.zeros((len(touches), bins, 2), np.int16)
    hits[:, bins // 10:, 0] = np.array(touches)[:, None]
    return Result(condition, hits[..., 0].astype(np.float32), hits)


def test_a_run_that_touches_nothing_at_the_end_stands_still():
    result = touching(0, 1, 0)
    assert paper_c.still(result).tolist() == [True, False, True]
    assert "| C | 2 of 3 | 67 |" in paper_c.standing({"C": touching(0, 1, 0, steps=15_000)})


def test_ratios_of_runs_that_do_not_stand_still_leave_the_others_out():
    alone = {"object vectors alone": touching(0, 1), "both in one layer": touching(1, 1)}
    greedy = {"C": touching(0, 2), "D": touching(0, 3), "places alone": touching(1, 2), **alone}
    exploring = {"C": touching(0, 0), "D": touching(4, 4), "places alone": touching(0, 1), **alone}
    text = paper_c.explored(greedy, exploring)
    assert re.search(r"without desires \| 1.00 \(places alone\) \| 4.00 .*\(both in one layer\)", text)
    assert "| D / C | 1.50" in text
    assert "| D / C, of runs that do not stand still | 1.50 | no runs |" in text


def test_the_stillest_run_goes_on_as_before_unless_its_agent_changes():
    result = simulate(network_c([2, 3]), WaterWorld(), steps=3_000, runs=3, seed=5)
    run, k = paper_c.stillest(result)
    assert run.step == 3_000 and k == result.hit_rate(0.8, 1).sum(axis=1).argmin()
    straight = Run(result.agent, result.world, 5, k)
    straight.advance(3_000)
    assert np.array_equal(paper_c.path_as(run, run.agent).positions, straight.record(15_000).positions)
    other = replace(run.agent, policy=Policy(1.0))
    recorded = {"none": paper_c.path_as(run, run.agent), "random": paper_c.path_as(run, other)}
    (none, random) = paper_c.paths(run, recorded).splitlines()[2:]
    assert none.startswith("| none |") and random.startswith("| random |") and none[7:] != random[9:]
    assert run.step == 3_000


def test_what_a_node_says_is_weighted_by_its_gain():
    run = Run(network_c([2, 3], place_gain=0.0), WaterWorld())
    run.advance(20_000)
    place, objects = paper_c.says(run).splitlines()[2:]
    assert place.startswith("| PC | 0.0000 | 0.0000 | 0.0000 | 0.0000 |") and objects.startswith("| OVC |")


def test_captions_end_with_numbers_of_their_figures(page):
    assert_captions_end_with_numbers_of_their_figures(page, ["still-runs"])
