"""Runs equal the agent in one file of plain Python, `companion.one_file`, under all options of learning and desires."""

from dataclasses import replace

import numpy as np
import pytest
from golden import plain_rule
from companion.one_file import simulate

from neorl import (Agent, Desire, Node, Place, Policy, Run, WaterWorld, multimodal, network_a, network_b, network_c,
                   network_d, object_vector_cells, place_cells)
from neorl.core.modality import (BORDER_CELL, BOUNDARY_VECTOR_CELL, HEAD_DIRECTION_CELL, LANDMARK_VECTOR_CELL,
                                 OBJECT_VECTOR_CELL, PLACE_CELL, SPEED_CELL)

SENSES = (Node("PC", PLACE_CELL, (2, 5), gain=0.5), Node("border", BORDER_CELL, (3,)),
          Node("polar", OBJECT_VECTOR_CELL, (4, 5)), Node("HD", HEAD_DIRECTION_CELL, (6,), gain=0.7),
          Node("landmark", LANDMARK_VECTOR_CELL, (4,)), Node("wall", BOUNDARY_VECTOR_CELL, (3, 4)),
          Node("speed", SPEED_CELL, (3, 4), weighting="cells"))
DESIRES = (Desire("green", "polar", 1.0), Desire("red", "polar", -0.5), Desire("polar", "PC"),
          Desire("green", "border", 0.3), Desire("green", "HD", 1.0), Desire("HD", "polar", valence=0.2, scale=0.5),
          Desire((0.3, 0.9), "PC", 1.0), Desire((0.4,), "speed", 0.5), Desire((0.1, np.pi), "wall", -1.0),
          Desire(Place(0.2, 0.7), "PC", 0.5), Desire(Place(0.6, 0.1), "polar", -0.4),
          Desire(Place(0.9, 0.9), "HD", 0.3),
          Desire("PC", "landmark", signed=True), Desire("polar", "polar", -0.5, of=("green", "polar")))
FAR = {"scale": 30.0, "signed": False}  # far enough for desires of the step before to land elsewhere
READINGS = {
    "default": place_cells([3, 7]),
    "several": place_cells([2, 5, 9], weighting="cells", policy=Policy(exploration=0.3, when_indifferent="no-op")),
    "happened": place_cells([5], learning=plain_rule(credit="happened", absent_decay=0.1)),
    "last": place_cells([5], learning=plain_rule(credit="last", terminal=False), own_cell="counts"),
    "step": multimodal([5], learning=plain_rule(update_on="step"), object_state="object"),
    "objects": object_vector_cells([3, 4], weighting="resolution"),
    "memory": multimodal([4, 6], learning=plain_rule(memory=4.0)),
    "memory alone": multimodal([2, 5], learning=plain_rule(memory=30.0, bootstrap=False, absent_decay=0.3,
                                                           learning_rate=0.3)),
    "away": multimodal([5], learning=plain_rule(absent_decay=0.2, absent_form="away", terminal=False)),
    "away with memory": multimodal([5], learning=plain_rule(absent_decay=0.4, absent_form="away", memory=6.0,
                                                            bootstrap=False)),
    "count": place_cells([4], learning=plain_rule(credit="count", learning_rate=0.4)),
    "activity": multimodal([4], learning=plain_rule(credit="activity", activity=0.1, absent_decay=0.1, memory=2.0)),
    **{f"{state}, {name}": multimodal([2, 5], learning=plain_rule(**rule), object_state=state)
       for state in ("self", "per object") for name, rule in {
           "memory": {"memory": 7.0, "bootstrap": False, "absent_decay": 0.7, "absent_form": "away"},
           "discounted": {"memory": 3.0, "bootstrap": False, "absent_decay": 0.1, "credit": "activity"},
           "no memory": {"bootstrap": False, "credit": "count"},
           "bootstrapping": {"credit": "happened", "absent_decay": 0.2, "absent_form": "away"},
           "both": {"memory": 4.0, "terminal": False}}.items()},
    "self, more places than are remembered": object_vector_cells([40], object_state="self", learning=plain_rule(
        memory=300.0, bootstrap=False)),
    "self, centred": object_vector_cells([2, 4], object_state="self", object_centred=True),
    "self, ends": object_vector_cells([5], object_state="self", object_beyond="none", object_tiled_fraction=0.2,
                                      own_cell="silent"),
    "object, reach": object_vector_cells([2, 5, 6], object_state="object", object_reach=0.2, learning=plain_rule()),
    "object, ends": object_vector_cells([4], object_state="object", object_beyond="none", object_tiled_fraction=0.3,
                                        object_centred=True),
    "per object, ends": object_vector_cells([4], object_state="per object", object_beyond="none",
                                            object_tiled_fraction=0.3, learning=plain_rule(memory=3.0)),
    **{f"{state}, resets unnoticed": multimodal(
        [2, 5], learning=plain_rule(memory=4.0, credit="activity", bootstrap=state == "object"), object_state=state,
        resets="unnoticed") for state in ("object", "self", "per object")},
    **{f"{state}, once": multimodal([2, 5], object_state=state, shared_cell="once", learning=plain_rule(memory=3.0))
       for state in ("object", "self", "per object")},
    "D, once, resets unnoticed": network_d([2, 3], resets="unnoticed", shared_cell="once", **FAR),
    "all senses, once, resets unnoticed": Agent(SENSES, DESIRES, shared_cell="once", resets="unnoticed"),
    "D of the self": network_d([2, 5], object_state="self", **FAR),
    "A": network_a([2, 3]),
    "B": network_b([3, 5], signed=True),
    "C": network_c([3], object_gain=0.5),
    "D": network_d([3, 5], policy=Policy(exploration=0.05)),
    "A that recurs": replace(network_a([3, 5], object_state="object"), desires=(
        *network_a(**FAR).desires, Desire("OVC", "OVC", valence=0.5, **FAR),
        Desire("OVC", "OVC", valence=-0.7, of=("PC", "OVC"), **FAR))),
    "all senses": Agent(SENSES, DESIRES),
    "compass": Agent((Node("PC", PLACE_CELL, (7,), gain=0.0), Node("HD", HEAD_DIRECTION_CELL, (4,))),
                     (Desire("green", "PC", 1.0), Desire("PC", "HD"))),
}


@pytest.mark.parametrize("name", READINGS)
def test_a_run_equals_the_rules_in_plain_python(name):
    agent, world, steps = READINGS[name], WaterWorld(width=100, n_creeps=2, win_reward=5.0), 600
    run = Run(agent, world, seed=3, run=2)
    brought = run.advance(steps)
    rewards, q = simulate(agent, world, steps, seed=3, run=2)
    assert brought == sum(rewards) != 0
    for m, table in enumerate(q):
        np.testing.assert_array_equal(run.q(m), table)
        assert table.any() or agent.maps[m].cells < 10
