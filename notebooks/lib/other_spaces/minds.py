"""Agents of the page: one learning rule and policy, cells for each world.

They differ only in their nodes and desires; those of the arm, the vessel
and the water maze are in `neorl.agents.spaces`. The page says how the rule
and the maps were found (`lib.other_spaces.report.SEARCHED`).
"""

from dataclasses import replace

from neorl import Axis, Desire, Modality, Node, Place, Policy
from neorl.agents.spaces import FAR_RADAR, pilot, reacher, seeker, swimmer
from neorl.core.modality import cartesian

__all__ = ["FAR_RADAR", "aimless", "compass_pilot", "driver", "far_pilot",
           "in_haste", "pilot", "reacher", "seeker", "swimmer", "thinker",
           "thinks_of"]


def aimless(agent):
    """The same agent with every action drawn at random."""
    return replace(agent, policy=Policy(exploration=1.0))


def far_pilot():
    """A pilot with the far map alone: it seeks waypoints, avoids nothing."""
    return seeker([FAR_RADAR], [Desire("waypoint", "far", 1.0)])


def compass_pilot():
    """A pilot whose cells represent the way to a thing, and its own heading.

    The way is split into east and south.
    """
    cells = Modality("object-vector × head-direction cell", [
        *cartesian("objects", (-0.7, 0.7), (-0.7, 0.7)),
        Axis("velocity", "direction", intervals=8)])
    return seeker([Node("compass", cells, [7])],
                  [Desire("waypoint", "compass", 1.0)])


NECK, LEGS = (Axis("position", "component", along, name=name)
              for along, name in enumerate(("neck", "legs")))


def thinker(apart):
    """An agent in the space of birds, without a desire.

    apart: whether each feature has a map of its own.
    """
    if apart:
        return seeker([Node("neck", Modality("neck cell", [NECK]), [9]),
                       Node("legs", Modality("leg cell", [LEGS]), [9])])
    return seeker([Node("bird", Modality("bird cell", [NECK, LEGS]), [9])])


def in_haste(agent):
    """The same agent with three times the learning rate."""
    learning = agent.learning
    tripled = replace(learning, learning_rate=3 * learning.learning_rate)
    return replace(agent, learning=tripled)


def thinks_of(agent, bird):
    """The same agent with a desire for a bird (neck, legs) in each node."""
    return replace(agent, desires=[Desire(Place(*bird), node.name, 1.0)
                                   for node in agent.nodes])


TRACK, SPEEDS = (-1.2, 0.6), (-0.07, 0.07)  # ranges of place and velocity
COLUMNS, ROWS = 18, 14  # cells along them


def driver():
    """A driver that seeks the flag, by the place and velocity of its car."""
    cells = Modality("place × velocity cell", [
        Axis("position", "component", 0, *TRACK, intervals=COLUMNS),
        Axis("velocity", "component", 0, *SPEEDS, intervals=ROWS)])
    return seeker([Node("car", cells, [1])],
                  [Desire(Place(0.55), "car", 1.0)])
