"""Agents for spaces other than the plane of WaterWorld: an arm, a vessel, and the water maze.

They share a learning rule and a policy: the defaults, except that all actions taken in a cell are credited. They differ
in nodes and desires: in what their cells represent and in what they seek.
"""

from collections.abc import Sequence

from neorl.agents.agent import Agent, Desire, Node
from neorl.agents.rules import Learning
from neorl.common import checks
from neorl.core.direction import turn
from neorl.core.modality import PLACE_CELL, Axis, Modality
from neorl.kernels.kernel import kernel

AVERSION = -0.3  # the valence of things to avoid; that of things sought is 1
JOINT_CELLS = {2: 9, 3: 7}  # along each axis, by the number of links
FARTHEST, NEAR = 1.0, 0.3  # the ranges of a radar's two maps, in widths of the area


def seeker(nodes: Sequence[Node], desires: Sequence[Desire] = ()) -> Agent:
    """An agent of these nodes and desires, with the shared rule and policy, to which its own cell is silent.

    nodes: one `Node` or more. desires: any number of `Desire`. Raises ValueError for what `Agent` refuses.
    """
    return Agent(nodes, desires, Learning(credit="share"), own_cell="silent")


def reacher(links: int, valence: float = AVERSION) -> Agent:
    """An agent for an arm of two or three links: cells for the offset of a posture, joint by joint, on closed axes.

    links: 2, with 9 cells along each axis, or 3, with 7. valence: of obstacles, a number; that of targets is 1.
    Raises ValueError for anything else.
    """
    resolution = JOINT_CELLS[checks.one_of("links", links, tuple(JOINT_CELLS))]
    axes = [Axis("objects", "component", joint, -0.5, 0.5, closed=True) for joint in range(links)]
    desires = [Desire("target", "joints", 1.0), Desire("obstacle", "joints", valence)]
    return seeker([Node("joints", Modality("joint-vector cell", axes), [resolution])], desires)


@kernel
def bearing(scene, point):
    """The direction of a thing as seen from the bow, in turns: 0 ahead, a quarter to starboard."""
    x, y = scene.things[point, 0] - scene.position[0], scene.things[point, 1] - scene.position[1]
    ahead, aside = scene.velocity[0], scene.velocity[1]
    return turn(ahead * x + aside * y, ahead * y - aside * x)


# Nodes of cells for the distance of a thing, in 8 rings and in 4, and its bearing, in eight sectors.
FAR_RADAR, NEAR_RADAR = (
    Node(name, Modality("radar cell", [Axis("objects", "length", high=reach),
                                       Axis(bearing, closed=True, intervals=8)]), [rings])
    for name, reach, rings in (("far", FARTHEST, 8), ("near", NEAR, 4)))


def pilot() -> Agent:
    """A pilot with both maps of a radar, which avoids nearby vessels."""
    return seeker([FAR_RADAR, NEAR_RADAR], [
        Desire("waypoint", "far", 1.0), Desire("waypoint", "near", 1.0), Desire("vessel", "near", AVERSION)])


def swimmer() -> Agent:
    """A swimmer with place cells of two resolutions, which seeks the platform at its remembered place."""
    return seeker([Node("place", PLACE_CELL, [5, 9])], [Desire("platform", "place", 1.0)])
