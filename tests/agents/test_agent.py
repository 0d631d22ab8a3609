"""Agents as data: validation, the order of evaluation, and the parameters that an agent compiles to."""

from dataclasses import replace

import numpy as np
import pytest

from neorl import (CALIBRATED, GREEDY, Agent, Desire, Node, NresMap, Place, Policy, Run, WaterWorld, brownian,
                   multimodal, network_a, network_b, network_c, network_d, object_vector_cells, place_cells)
from neorl.core.modality import (BORDER_CELL, BOUNDARY_VECTOR_CELL, CARTESIAN_OBJECT_VECTOR_CELL, HEAD_DIRECTION_CELL,
                                 LANDMARK_VECTOR_CELL, MODALITIES, OBJECT_VECTOR_CELL, PLACE_CELL, SPEED_CELL)
from neorl.agents.compile import compiled, n_values
from neorl.core.choices import Source
from neorl.core.modality import cartesian

PC, OVC = Node("PC", PLACE_CELL, (2, 3)), Node("OVC", CARTESIAN_OBJECT_VECTOR_CELL, (3,))
HD, SPEED = Node("HD", HEAD_DIRECTION_CELL, (4,)), Node("speed", SPEED_CELL, (3,))
PAPERS = (place_cells, brownian, object_vector_cells, multimodal, network_a, network_b, network_c, network_d)


@pytest.mark.parametrize("name, message", [
    ("discount", "discount must be a choice of this agent, 'weighting', 'tiled_fraction', 'object_state', 'object_re"),
    ("exploration", "exploration must be a choice of this agent, 'weighting', 'tiled_fraction', 'object_state', 'obj"),
    ("colour", "colour must be a choice of this agent, 'weighting', 'tiled_fraction', 'object_state', 'object_reach")])
def test_what_is_no_choice_of_an_agent_is_refused_and_its_place_is_named(name, message):
    with pytest.raises(TypeError, match=message):
        network_d([3], **{name: 0.9})


def test_resolutions_may_be_numbers_of_numpy_but_not_a_single_one():
    assert place_cells(np.array([3, 5])) == place_cells([np.int8(3), np.array(5)])
    with pytest.raises(ValueError, match=r"resolutions must be a list or a tuple, but is array\(5\)"):
        place_cells(np.array(5))


@pytest.mark.parametrize("desires, message", [
    ([Desire("blue", "PC")], "valence of the desire 'blue' → 'PC' must be a finite number, since it does not come fr"),
    ([Desire("green", "PC")], "valence of the desire 'green' → 'PC' must be a finite number, since it does not come "),
    ([Desire((0.1, 0.2), "PC")], r"valence of the desire \(0.1, 0.2\) → 'PC' must be a finite number, since it does n"),
    ([Desire(Place(0.5, 0.5), "PC")], "valence of the desire Place.* is None"),
    ([Desire("PC", "PC")], "valence of the desire 'PC' → 'PC' must be a finite number, since it does not come from a"),
    ([Desire("green", "OVC", 1.0, of=("green",))], r"of in the desire 'green' → 'OVC' must be \(\), since its source "),
    ([Desire((0.5, 0.5), "OVC", 1.0, of=("green",))], r"of in the desire \(0.5, 0.5\) → 'OVC' must be \(\), since its"),
    ([Desire("green", "CP", 1.0)], "target of the desire 'green' → 'CP' must be a node, 'PC', 'OVC', 'HD' or 'speed'"),
    ([Desire("PC", "red")], "target of the desire 'PC' → 'red' must be a node, 'PC', 'OVC', 'HD' or 'speed', but is "),
    ([Desire("PC", "OVC"), Desire("OVC", "PC")], "desires between nodes must not form a cycle, but 'PC' → 'OVC' clos"),
    ([Desire("PC", "OVC"), Desire("OVC", "HD"), Desire("HD", "PC")],
     "must not form a cycle, but ('PC' → 'OVC' closes PC → OVC → HD → PC|'OVC' → 'HD' closes OVC → HD → PC → OVC|"
     "'HD' → 'PC' closes HD → PC → OVC → HD); only a node may"),
    ([Desire("green", "speed", 1.0)], "source of the desire 'green' → 'speed' must be a point in the space of speed "),
    ([Desire(Place(0.5, 0.5), "speed", 1.0)], r"source of the desire Place\(0.5, 0.5\) → 'speed' must be a point in t"),
    ([Desire((0.5,), "PC", 1.0)], r"source of the desire \(0.5,\) → 'PC' must be a point of 2 coordinates, for x, y, "),
    ([Desire((0.5, 0.5), "HD", 1.0)], r"source of the desire \(0.5, 0.5\) → 'HD' must be a point of 1 coordinates, fo"),
    ([Desire((), "OVC", 1.0)], r"source of the desire \(\) → 'OVC' must be a point of 2 coordinates, for x, y, but is"),
    ([Desire("green", "PC", 1.0), Desire("PC", "OVC", of=("green", "red"))],
     "of in the desire 'PC' → 'OVC' must be among the sources of 'PC', 'green', but is 'red'"),
    ([Desire("red", "OVC", 1.0), Desire("PC", "OVC", of=("red",))], "of in the desire 'PC' → 'OVC' must be among the"),
])
def test_a_network_that_cannot_be_evaluated_is_refused(desires, message):
    with pytest.raises(ValueError, match=message):
        Agent((PC, OVC, HD, SPEED), desires)


@pytest.mark.parametrize("node, desires, message", [
    (Node("green", PLACE_CELL, (3,)), [], "name of a node must be other than the kinds of this world's things, 'gree"),
    (Node("red", PLACE_CELL, (3,)), [], "name of a node must be other than the kinds of this world's things, 'green'"),
    (PC, [Desire("blue", "PC", 1.0)], "source of the desire 'blue' → 'PC' must be a node of the agent or a kind of t"),
    (PC, [Desire(Place(0.5), "PC", 1.0)], r"source of the desire Place\(0.5,\) → 'PC' must be a place of 2 coordinate"),
    (PC, [Desire(Place(0.5, 0.5, 0.5), "PC", 1.0)], r"source of the desire Place\(0.5, 0.5, 0.5\) → 'PC' must be a pl"),
    (PC, [Desire(Place(9, 9), "PC", 1.0)], r"source of the desire Place\(9.0, 9.0\) → 'PC' must be a place on the boa"),
    (Node("LVC", replace(LANDMARK_VECTOR_CELL, landmarks=((0.1, 0.2, 0.3),)), (3,)), [],
     "the world of landmark-vector cells must have 3 axes or more, but has 2"),
])
def test_an_agent_and_a_world_that_do_not_go_together_are_refused_when_they_meet(node, desires, message):
    agent = Agent((node,), desires)
    for meet in (compiled, Run):
        with pytest.raises(ValueError, match=message):
            meet(agent, WaterWorld())
    with pytest.raises(ValueError, match=message):
        Run(place_cells([3]), WaterWorld()).change(agent)


def test_recursion_to_itself_and_points_of_a_nodes_own_space_are_allowed():
    Agent((PC, SPEED), (Desire("green", "PC", 1.0), Desire("PC", "PC", -1.0, of=("PC", "green")),
                        Desire((0.5,), "speed", 1.0), Desire((0.1, 0.2), "PC", 1.0)))


@pytest.mark.parametrize("make", PAPERS)
def test_an_agent_is_a_value(make):
    assert make() == make() and hash(make()) == hash(make())
    assert [make() == other() for other in PAPERS] == [make is other for other in PAPERS]


def test_the_agent_of_paper_a_is_one_node_and_two_desires():
    desires = (Desire("green", "PC", 1.0), Desire("red", "PC", -1.0))
    middle = replace(PLACE_CELL, axes=cartesian("position", (0.25, 0.75), (0.25, 0.75)))
    rules = {"learning": CALIBRATED, "policy": GREEDY}
    assert place_cells([3, 7], tiled_fraction=0.5) == Agent((Node("PC", middle, (3, 7)),), desires, **rules)
    assert place_cells([3, 7], tiled_fraction=0.5) == Agent([Node("PC", middle, np.array([3, 7]))], [*desires], **rules)
    assert place_cells([3, 7], tiled_fraction=1) == Agent((Node("PC", PLACE_CELL, (3, 7)),), desires, **rules)
    assert place_cells([3], own_cell="silent") != place_cells([3], own_cell="counts")
    assert place_cells([3], object_tiled_fraction=0.1) == place_cells([3])


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
    assert n_values(place_cells([3, 7, 23]), WaterWorld()) == 4 * (3**4 + 7**4 + 23**4)
    assert n_values(Agent((HD, SPEED)), WaterWorld()) == 4 * (4**2 + 3**2)
    assert Agent((PC, OVC)).maps == (NresMap(2), NresMap(3), NresMap(3, CARTESIAN_OBJECT_VECTOR_CELL))


@pytest.mark.parametrize("weighting, weight", [
    ("equal", [1 / 3] * 3), ("resolution", [3 / 33, 7 / 33, 23 / 33]), ("cells", [9 / 587, 49 / 587, 529 / 587])])
def test_the_weights_of_the_maps_of_a_node_add_up_to_one(weighting, weight):
    parameters = compiled(multimodal([3, 7, 23], weighting=weighting), WaterWorld())
    np.testing.assert_allclose(parameters.maps.weight, weight * 2)


def test_maps_tracks_and_desires_lie_one_after_the_other():
    desires = (Desire("green", "OVC", 1.0), Desire((0.9, 0.4), "PC", 1.0), Desire("red", "OVC", -1.0),
               Desire("PC", "OVC"))
    parameters = compiled(Agent((PC, OVC, HD), desires), WaterWorld(n_creeps=5))
    maps, nodes, chosen = parameters.maps, parameters.nodes, parameters.desires
    assert maps.first_value.tolist() == [0, 4 * 2**4, 4 * (2**4 + 3**4), 4 * (2**4 + 2 * 3**4),
                                         4 * (2**4 + 2 * 3**4 + 4**2)]
    assert maps.first_cell.tolist() == [0, 4, 13, 22, 26]
    assert nodes.first_map.tolist() == [0, 2, 3, 4] and maps.first_track.tolist() == [0, 1, 2, 7, 8]
    assert nodes.inputs.tolist() == [1, 0, 2, 3] and nodes.first_input.tolist() == [0, 1, 4, 4]
    assert chosen.source.tolist() == [Source.kind, Source.point, Source.kind, Source.node]
    assert chosen.kind[[0, 2]].tolist() == [0, 1]
    assert chosen.goal[1].tolist() == [1, 5, 0, 0]
    assert chosen.valence.tolist() == [1, 1, -1, 0] and chosen.sums_valence.tolist() == [False, False, False, True]


def test_a_node_follows_as_many_points_as_there_are_things():
    nodes = [Node(str(n), modality, (2,)) for n, modality in enumerate(MODALITIES)]
    parameters = compiled(Agent(nodes), WaterWorld(n_creeps=7))
    expected = {PLACE_CELL: 1, BORDER_CELL: 1, OBJECT_VECTOR_CELL: 7, CARTESIAN_OBJECT_VECTOR_CELL: 7,
                BOUNDARY_VECTOR_CELL: 4, LANDMARK_VECTOR_CELL: 1, HEAD_DIRECTION_CELL: 1, SPEED_CELL: 1}
    assert parameters.nodes.points.tolist() == [expected[modality] for modality in MODALITIES]
    assert parameters.nodes.landmark.tolist() == [[0.5, 0.5]]


@pytest.mark.parametrize("node, contact", [(Node("OVC", CARTESIAN_OBJECT_VECTOR_CELL, (3, 4)), [4, 10]),
                                           (Node("OVC", OBJECT_VECTOR_CELL, (3, 4)), [0, 0])])
def test_contact_is_the_cell_of_the_null_vector(node, contact):
    assert compiled(Agent((node,)), WaterWorld()).maps.contact.tolist() == contact


def test_a_desire_comes_from_the_elements_that_it_names_or_from_all():
    by_colour = [[0, 0, 0, 0], [0, 0, 0, 0], [1, 0, 0, 0], [0, 1, 0, 0]]
    assert compiled(network_a([3]), WaterWorld()).desires.elements.tolist() == [[0, 0, 0], [0, 0, 0], [1, 1, 0]]
    assert compiled(network_b([3]), WaterWorld()).desires.elements.tolist() == by_colour
    recursive = compiled(network_d([3]), WaterWorld()).desires.elements
    assert recursive[:4, :4].tolist() == by_colour and not recursive[:4, 4].any()
    assert recursive[4].tolist() == [0, 0, 1, 1, 1]


def test_a_chain_of_three_nodes_runs_and_every_desire_gets_to_its_end():
    desires = (Desire("green", "OVC", 1.0), Desire("OVC", "PC"), Desire("PC", "HD", valence=0.5))
    run = Run(Agent((HD, PC, OVC), desires, own_cell="counts"), WaterWorld(), seed=0)
    run.advance(500)
    assert run.step == 500 and run.state.values.q.any()
    values = run._state.values.q
    values[:] = np.random.default_rng(0).random(values.size)  # so that no desire happens to be satisfied
    run.advance(1)
    assert run.state.desires.valence[0] == run.state.desires.valence[1] >= 1 and run.state.desires.valence[2] == 0.5
    assert run.state.desires.target[1:].all() and run.state.desires.q.all()
