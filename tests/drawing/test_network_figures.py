"""Drawings of networks show every node, desire and gain."""

import pytest
from matplotlib import pyplot as plt
from matplotlib.patches import Circle, FancyArrowPatch, FancyBboxPatch

from neorl import (Agent, Desire, Node, multimodal, network_a, network_b, network_c, network_d,
                   object_vector_cells, place_cells)
from neorl.core.modality import HEAD_DIRECTION_CELL, OBJECT_VECTOR_CELL, PLACE_CELL
from neorl.drawing.network_figures import draw_network

CREEPS = (Desire("green", "PC", 1.0), Desire("red", "PC", -1.0))


def chain():
    nodes = (Node("PC", PLACE_CELL, (5,)), Node("OVC", OBJECT_VECTOR_CELL, (3, 7), gain=0.0),
             Node("HD", HEAD_DIRECTION_CELL, (8,), gain=-0.5))
    return Agent(nodes, (*CREEPS, Desire("PC", "OVC"), Desire("OVC", "HD")))


def entangled():
    """An agent with fixed points, skipped depths, several recursions, and two sending nodes at one depth."""
    nodes = (Node("place cells", PLACE_CELL, (5,)), Node("PC", PLACE_CELL, (4,)),
             Node("OVC", OBJECT_VECTOR_CELL, (3,)), Node("HD", HEAD_DIRECTION_CELL, (8,), gain=0.0))
    desires = (*CREEPS, Desire((0.5, 0.25), "PC", 2.0), Desire("red", "place cells", -3.0), Desire("PC", "OVC"),
               Desire("PC", "HD", of=("red",)), Desire("place cells", "HD", 0.5), Desire("OVC", "HD"),
               Desire("OVC", "OVC", -1.0), Desire("OVC", "OVC", 0.5, of=("PC",)), Desire("green", "HD", 1.0))
    return Agent(nodes, desires)


def recursive():
    return Agent((Node("PC", PLACE_CELL, (5,)),), (*CREEPS, Desire("PC", "PC", 0.25, of=("green",))))


AGENTS = [place_cells(), object_vector_cells(), multimodal(), network_a(), network_b(), network_c(), network_d(),
          chain(), entangled(), recursive()]


def drawn(kind):
    return [patch for patch in plt.gca().patches if isinstance(patch, kind)]


@pytest.mark.parametrize("agent", AGENTS, ids=lambda agent: "-".join(node.name for node in agent.nodes))
def test_everything_is_drawn_once(agent):
    draw_network(agent)
    gains = [node for node in agent.nodes if node.gain]
    assert len(drawn(FancyBboxPatch)) == len(agent.nodes) + 1
    assert len(drawn(Circle)) == sum(not agent.comes_from_node(desire) for desire in agent.desires)
    assert len(drawn(FancyArrowPatch)) == len(agent.desires) + len(gains)
    ends = [tuple(arrow._path_original.vertices[i].round(6)) for arrow in drawn(FancyArrowPatch) for i in (0, -1)]
    assert len(set(ends)) == len(ends)
