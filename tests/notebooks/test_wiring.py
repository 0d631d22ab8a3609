"""Desires as the wires of a network."""

from dataclasses import replace

import numpy as np
import pytest

from neorl import Desire, Run, WaterWorld, network_a, network_b
from lib.paper_c import wiring
from neorl.evidence.reading import Reading, networks

OF_B = [Desire("green", "PC", valence=1.0), Desire("red", "PC", valence=-1.0),
        Desire("PC", "OVC", of=["green"]), Desire("PC", "OVC", of=["red"])]


@pytest.mark.parametrize("reading", [Reading(), Reading(scale=0.5, vectors="by size")])
def test_desires_that_make_up_a_network_do_so_in_any_reading(reading):
    network = networks(reading)["B"]
    assert wiring.make_up(network, OF_B, reading)
    assert not wiring.make_up(network, OF_B[:-1], reading)
    assert not wiring.make_up(network, [replace(OF_B[0], valence=2.0), *OF_B[1:]], reading)


def test_a_desire_of_another_scale_is_not_that_of_the_network():
    assert not wiring.make_up(networks(Reading())["B"], OF_B, Reading(scale=0.5))


def test_the_moment_is_the_first_at_which_the_agent_is_well_inside_and_desires_something_far(monkeypatch):
    monkeypatch.setattr(wiring, "FAR", 0.001)
    network, world = network_b([2, 3]), WaterWorld()
    run, other = wiring.moment_of_desire(network, world, 300, seed=1), Run(network, world, 1)
    assert 300 <= run.step < 300 + wiring.PATIENCE
    other.advance(300)
    fits = []
    for _ in range(run.step - 300 + 1):
        at = other.world_state.scene.position / world.size
        lands = np.hypot(*other.state.desires.target[2:, :2].T)  # after the desires for creeps
        fits.append(np.abs(at - 0.5).max() < 0.2 and lands.max() > 0.001)
        other.advance(1)
    assert fits[-1] and not any(fits[:-1])


def test_the_moment_is_not_waited_for_in_vain(monkeypatch):
    monkeypatch.setattr(wiring, "PATIENCE", 7)
    monkeypatch.setattr(wiring, "WELL_INSIDE", 0.0)
    assert wiring.moment_of_desire(network_b([2]), WaterWorld(), 10).step == 17


def test_the_table_has_where_each_desire_between_nodes_lands():
    run = Run(network_b([2, 3]), WaterWorld())
    run._state.desires.target[2:] = [[0.25, -0.1, 1.0], [-0.0001, 0.5, -1.5]]
    assert wiring.landings(run).splitlines()[2:] == ["| PC to OVC, green creeps | (0.250, −0.100) | +1 |",
                                                     "| PC to OVC, red creeps | (0.000, 0.500) | −1.5 |"]


def test_a_network_that_cannot_be_evaluated_is_refused_in_short_lines():
    message = wiring.refusal(network_a([2]), Desire("OVC", "PC"))
    assert message.startswith("desires between nodes must not form a cycle, but 'PC' → 'OVC'\ncloses PC → OVC → PC; ")
    assert max(map(len, message.splitlines())) <= 66
    assert len(message.splitlines()) == 2
    assert wiring.refusal(network_a([2]), Desire("OVC", "OVC", valence=-1.0)) == ""
