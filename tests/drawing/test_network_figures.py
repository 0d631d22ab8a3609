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
from neorl.drawing.network_figures import draw_network, draw_networks

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


def drawn(kind, axes=None):
    return [patch for patch in (axes or plt.gca()).patches if isinstance(patch, kind)]


def texts():
    return [text.get_text() for text in plt.gca().texts if text.get_text()]


def lines():
    """The corners of every arrow."""
    return [arrow._path_original.vertices for arrow in drawn(FancyArrowPatch)]


def crossings():
    """The number of crossings of arrows that start at a node."""
    paths = [Path(line) for line in lines() if line[0][0] > 2]
    return sum(a.intersects_path(b, filled=False) for a, b in combinations(paths, 2))


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


@pytest.mark.parametrize("agent", AGENTS, ids=lambda agent: "-".join(node.name for node in agent.nodes))
def test_no_arrow_runs_through_a_node_or_over_another(agent):
    draw_network(agent)
    inner = [box.get_bbox().padded(-1e-6) for box in drawn(FancyBboxPatch)]
    arrows = lines()
    assert not any(box.overlaps(matplotlib.transforms.Bbox([start, end]))
                   for arrow in arrows for start, end in zip(arrow, arrow[1:]) for box in inner)
    ends = [tuple(arrow[i].round(6)) for arrow in arrows for i in (0, -1)]
    assert len(set(ends)) == len(ends)


def test_desires_of_one_node_do_not_cross():
    draw_network(network_b())
    assert crossings() == 0
    nodes = [Node(name, PLACE_CELL, (5,), gain=0.0) for name in "abcd"]
    edges = [("a", "b"), ("a", "c"), ("b", "c"), ("a", "d"), ("c", "d"), ("b", "d")]
    draw_network(Agent(nodes, [Desire(*edge) for edge in edges]))
    assert crossings() == 0


def test_a_node_shows_its_name_modality_and_resolutions():
    draw_network(object_vector_cells())
    assert {"OVC", "object-vector", "cell, Cartesian", "N2 … N13"} <= set(texts())
    draw_network(chain())
    assert {"PC", "place cell", "N5", "N3, N7", "head-direction"} <= set(texts())


def test_networks_below_one_another_share_a_size():
    draw_networks({"A": network_a(), "B": network_b(), "C": network_c(), "D": network_d(), "E": place_cells()})
    panels = plt.gcf().axes
    assert [panel.texts[0].get_text() for panel in panels] == list("ABCDE")
    assert len({round(panel.get_position().y0, 6) for panel in panels}) == 5
    assert len({text.get_fontsize() for panel in panels for text in panel.texts}) == 2
    ems = [panel.transData.transform([[0, 0], [1, -1]]) for panel in panels]
    assert len({tuple((end - start).round(6)) for start, end in ems}) == 1
