"""Drawings of networks show every node, desire and gain, and nothing hides anything else."""

from itertools import combinations

import matplotlib
import pytest
from matplotlib import pyplot as plt
from matplotlib.patches import Circle, FancyArrowPatch, FancyBboxPatch
from matplotlib.path import Path

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


def lines():
    """The corners of every arrow."""
    return [arrow._path_original.vertices for arrow in drawn(FancyArrowPatch)]


@pytest.mark.parametrize("agent", AGENTS, ids=lambda agent: "-".join(node.name for node in agent.nodes))
def test_everything_is_drawn_and_nothing_overlaps(agent):
    draw_network(agent)
    plt.gcf().draw_without_rendering()
    gains = [node for node in agent.nodes if node.gain]
    assert len(drawn(FancyBboxPatch)) == len(agent.nodes) + 1
    assert len(drawn(Circle)) == sum(not agent.comes_from_node(desire) for desire in agent.desires)
    assert len(drawn(FancyArrowPatch)) == len(agent.desires) + len(gains)
    written = [text.get_window_extent() for text in plt.gca().texts if text.get_text()]
    boxes = [box.get_window_extent() for box in drawn(FancyBboxPatch)]
    page = plt.gcf().bbox
    for extent in written + boxes:
        assert page.x0 <= extent.x0 and extent.x1 <= page.x1 and page.y0 <= extent.y0 and extent.y1 <= page.y1
    assert not any(a.overlaps(b) for a, b in combinations(written, 2))
    assert not any(a.overlaps(b) for a, b in combinations(boxes, 2))
    assert all(not text.overlaps(box) or box.x0 < text.x0 and text.x1 < box.x1 and box.y0 < text.y0
               and text.y1 < box.y1 for text in written for box in boxes)
    arrows = [Path(plt.gca().transData.transform(line)) for line in lines()]
    assert not any(arrow.intersects_bbox(text, filled=False) for arrow in arrows for text in written)
    inner = [box.get_bbox().padded(-1e-6) for box in drawn(FancyBboxPatch)]
    assert not any(box.overlaps(matplotlib.transforms.Bbox([start, end]))
                   for line in lines() for start, end in zip(line, line[1:]) for box in inner)
    ends = [tuple(line[i].round(6)) for line in lines() for i in (0, -1)]
    assert len(set(ends)) == len(ends)
