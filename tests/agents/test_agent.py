"""Agents as data: validation, the order of evaluation and the number of values."""

from dataclasses import replace

import numpy as np
import pytest

from neorl import (CALIBRATED, GREEDY, Agent, Desire, Node, NresMap, Place, Policy, Run, WaterWorld, brownian,
                   multimodal, network_d, object_vector_cells, place_cells)
from neorl.agents.embodiment import embodied
from neorl.core.building import n_values
from neorl.core.modality import (CARTESIAN_OBJECT_VECTOR_CELL, HEAD_DIRECTION_CELL, LANDMARK_VECTOR_CELL, PLACE_CELL,
                                 SPEED_CELL, cartesian)

PC, OVC = Node("PC", PLACE_CELL, (2, 3)), Node("OVC", CARTESIAN_OBJECT_VECTOR_CELL, (3,))
HD, SPEED = Node("HD", HEAD_DIRECTION_CELL, (4,)), Node("speed", SPEED_CELL, (3,))


def test_what_is_no_choice_of_an_agent_is_refused_and_resolutions_must_be_several():
    with pytest.raises(TypeError, match="exploration must be a choice of this agent, 'weighting', 'tiled_fraction', "):
        network_d([3], exploration=0.9)
    assert place_cells(np.array([3, 5])) == place_cells([np.int8(3), np.array(5)])
    with pytest.raises(ValueError, match=r"resolutions must be a list or a tuple, but is array\(5\)"):
        place_cells(np.array(5))


@pytest.mark.parametrize("desires, message", [
    ([Desire("green", "PC")], "valence of the desire 'green' → 'PC' must be a finite number, since it does not come "),
    ([Desire("PC", "PC")], "valence of the desire 'PC' → 'PC' must be a finite number, since it does not come from a"),
    ([Desire("green", "OVC", 1.0, of=("green",))], r"of in the desire 'green' → 'OVC' must be \(\), since its source "),
    ([Desire("green", "CP", 1.0)], "target of the desire 'green' → 'CP' must be a node, 'PC', 'OVC', 'HD' or 'speed'"),
    ([Desire("PC", "OVC"), Desire("OVC", "PC")], "desires between nodes must not form a cycle, but 'PC' → 'OVC' clos"),
    ([Desire("PC", "OVC"), Desire("OVC", "HD"), Desire("HD", "PC")],
     "must not form a cycle, but ('PC' → 'OVC' closes PC → OVC → HD → PC|'OVC' → 'HD' closes OVC → HD → PC → OVC|"
     "'HD' → 'PC' closes HD → PC → OVC → HD); only a node may"),
    ([Desire("green", "speed", 1.0)], "source of the desire 'green' → 'speed' must be a point in the space of speed "),
    ([Desire((0.5,), "PC", 1.0)], r"source of the desire \(0.5,\) → 'PC' must be a point of 2 coordinates, for x, y, "),
    ([Desire("green", "PC", 1.0), Desire("PC", "OVC", of=("green", "red"))],
     "of in the desire 'PC' → 'OVC' must be among the sources of 'PC', 'green', but is 'red'")])
def test_a_network_that_cannot_be_evaluated_is_refused(desires, message):
    with pytest.raises(ValueError, match=message):
        Agent((PC, OVC, HD, SPEED), desires)


@pytest.mark.parametrize("node, desires, message", [
    (Node("red", PLACE_CELL, (3,)), [], "name of a node must be other than the kinds of this world's things, 'green'"),
    (PC, [Desire("blue", "PC", 1.0)], "source of the desire 'blue' → 'PC' must be a node of the agent or a kind of t"),
    (PC, [Desire(Place(0.5), "PC", 1.0)], r"source of the desire Place\(0.5,\) → 'PC' must be a place of 2 coordinate"),
    (PC, [Desire(Place(9, 9), "PC", 1.0)], r"source of the desire Place\(9.0, 9.0\) → 'PC' must be a place on the boa"),
    (Node("LVC", replace(LANDMARK_VECTOR_CELL, landmarks=((0.1, 0.2, 0.3),)), (3,)), [],
     "the world of landmark-vector cells must have 3 axes or more, but has 2")])
def test_an_agent_and_a_world_that_do_not_go_together_are_refused_when_they_meet(node, desires, message):
    agent = Agent((node,), desires)
    for meet in (embodied, Run):
        with pytest.raises(ValueError, match=message):
            meet(agent, WaterWorld())
    with pytest.raises(ValueError, match=message):
        Run(place_cells([3]), WaterWorld()).change(agent)


def test_the_agent_of_paper_a_is_one_node_and_two_desires():
    desires = (Desire("green", "PC", 1.0), Desire("red", "PC", -1.0))
    middle = replace(PLACE_CELL, axes=cartesian("position", (0.25, 0.75), (0.25, 0.75)))
    rules = {"learning": CALIBRATED, "policy": GREEDY}
    assert place_cells([3, 7], tiled_fraction=0.5) == Agent((Node("PC", middle, (3, 7)),), desires, **rules)
    assert place_cells([3, 7], tiled_fraction=0.5) == Agent([Node("PC", middle, np.array([3, 7]))], [*desires], **rules)
    assert place_cells([3, 7], tiled_fraction=1) == Agent((Node("PC", PLACE_CELL, (3, 7)),), desires, **rules)


def test_object_vectors_may_have_a_range_of_their_own():
    places, objects = multimodal([3], tiled_fraction=1, object_tiled_fraction=0.25, object_centred=False).nodes
    assert places.modality == PLACE_CELL and objects.modality.axes == cartesian("objects", (-0.25, 0.25),
                                                                                                  (-0.25, 0.25))
    assert object_vector_cells([3], tiled_fraction=0.2, object_tiled_fraction=1,
                               object_centred=False).nodes[0].modality == CARTESIAN_OBJECT_VECTOR_CELL
    for name in ("tiled_fraction", "object_tiled_fraction"):
        with pytest.raises(ValueError, match=f"{name} must be a finite number from 1e-30 to .*, but is 0"):
            multimodal([3], **{name: 0})
    assert brownian().policy == Policy(exploration=1.0)


def test_a_node_is_evaluated_after_those_that_it_takes_desires_from():
    chain = (Desire("OVC", "HD"), Desire("HD", "PC"), Desire("PC", "PC", 1.0))
    assert Agent((PC, HD, OVC), chain).evaluation_order == ("OVC", "HD", "PC")
    assert network_d([3]).evaluation_order == ("PC", "OVC")
    assert sorted(multimodal([3]).evaluation_order) == ["OVC", "PC"]


def test_n_values_counts_four_actions_for_each_pair_of_cells():
    assert n_values(embodied(place_cells([3, 7, 23]), WaterWorld())[0]) == 4 * (3**4 + 7**4 + 23**4)
    assert n_values(embodied(Agent((HD, SPEED)), WaterWorld())[0]) == 4 * (4**2 + 3**2)
    assert Agent((PC, OVC)).maps == (NresMap(2), NresMap(3), NresMap(3, CARTESIAN_OBJECT_VECTOR_CELL))
