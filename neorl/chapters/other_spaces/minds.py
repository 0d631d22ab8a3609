"""The agents of the page: one rule of learning, one policy, and for each world what its cells stand for.

Nothing but nodes and desires differs between them. `RULE` is plain bootstrapping at changes of cell, without memory of
earlier cells. The page says how it and the maps were found (`neorl.chapters.other_spaces.report.SEARCHED`).
"""

from dataclasses import replace

from neorl import Agent, Axis, Desire, Learning, Modality, Node, Place, Policy, kernel
from neorl.core.geometry import turn
from neorl.core.modality import PLACE_CELL, cartesian

RULE = Learning(learning_rate=0.1, discount=0.9, update_on="cell", credit="share", absent_decay=0.0, terminal=True,
                memory=0.0, bootstrap=True, causes="any", capture="contact", attention="each")
POLICY = Policy(exploration=0.1)
AVERSION = -0.3  # the valence of what is to be avoided, beside 1 of what is sought
FARTHEST, NEAR = 1.0, 0.3  # to which the two maps of a radar reach, in widths of the area


def seeker(nodes, desires=()):
    """An agent of these nodes and desires, with the rule and the policy of the page."""
    return Agent(nodes, desires, RULE, POLICY, "silent")


def aimless(agent):
    """The same agent, but for drawing every action at random."""
    return replace(agent, policy=Policy(exploration=1.0))


def reacher(links, valence=AVERSION):
    """An agent for an arm of so many links: cells for the way from its posture to another, joint by joint, closed.

    valence: of obstacles.
    """
    axes = [Axis("objects", "component", joint, -0.5, 0.5, closed=True) for joint in range(links)]
    desires = [Desire("target", "joints", 1.0), Desire("obstacle", "joints", valence)]
    return seeker([Node("joints", Modality("joint-vector cell", axes), [{2: 9, 3: 7}[links]])], desires)


@kernel
def bearing(scene, point):
    """The direction of a thing as seen from the bow, in turns: 0 ahead, a quarter to starboard."""
    x, y = scene.things[point, 0] - scene.position[0], scene.things[point, 1] - scene.position[1]
    ahead, aside = scene.velocity[0], scene.velocity[1]
    return turn(ahead * x + aside * y, ahead * y - aside * x)


def radar_node(name, reach, rings):
    """Cells for the distance of a thing, up to `reach`, and its bearing."""
    return Node(name, Modality("radar cell", [Axis("objects", "length", high=reach),
                                              Axis(bearing, closed=True, intervals=8)]), [rings])


FAR_RADAR, NEAR_RADAR = radar_node("far", FARTHEST, 8), radar_node("near", NEAR, 4)


def far_pilot():
    """A pilot with the map alone that reaches far, which seeks waypoints and knows no fear."""
    return seeker([FAR_RADAR], [Desire("waypoint", "far", 1.0)])


def pilot():
    """A pilot with both maps of a radar, which avoids the vessels that are near."""
    return seeker([FAR_RADAR, NEAR_RADAR], [
        Desire("waypoint", "far", 1.0), Desire("waypoint", "near", 1.0), Desire("vessel", "near", AVERSION)])


def compass_pilot():
    """A pilot whose cells stand for the way to a thing, east and south, and for its own heading."""
    cells = Modality("object-vector × head-direction cell", [
        *cartesian("objects", (-0.7, 0.7), (-0.7, 0.7)), Axis("velocity", "direction", intervals=8)])
    return seeker([Node("compass", cells, [7])], [Desire("waypoint", "compass", 1.0)])


def swimmer():
    """A swimmer with place cells of two resolutions, which seeks the platform where it remembers it."""
    return seeker([Node("place", PLACE_CELL, [5, 9])], [Desire("platform", "place", 1.0)])


NECK, LEGS = (Axis("position", "component", along, name=name) for along, name in enumerate(("neck", "legs")))


def thinker(apart):
    """An agent in the space of birds, without a desire: one map of both features, or one for each of them *apart*."""
    if apart:
        return seeker([Node("neck", Modality("neck cell", [NECK]), [9]),
                       Node("legs", Modality("leg cell", [LEGS]), [9])])
    return seeker([Node("bird", Modality("bird cell", [NECK, LEGS]), [9])])


def in_haste(agent):
    """The same agent with three times the rate of learning."""
    return replace(agent, learning=replace(agent.learning, learning_rate=3 * agent.learning.learning_rate))


def thinks_of(agent, bird):
    """The same agent with a desire for a bird, (neck, legs), in each of its nodes."""
    return replace(agent, desires=[Desire(Place(*bird), node.name, 1.0) for node in agent.nodes])


TRACK, SPEEDS, COLUMNS, ROWS = (-1.2, 0.6), (-0.07, 0.07), 18, 14  # ranges of place and velocity, and cells along them


def driver():
    """A driver whose cells stand for where its car is and how fast it goes, and which seeks the flag."""
    cells = Modality("place × velocity cell", [Axis("position", "component", 0, *TRACK, intervals=COLUMNS),
                                               Axis("velocity", "component", 0, *SPEEDS, intervals=ROWS)])
    return seeker([Node("car", cells, [1])], [Desire(Place(0.55), "car", 1.0)])
