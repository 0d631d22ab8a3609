"""What the page's claims are about: its own agents and worlds, as they stand in its cells.

Arms and vessels are conditions, with the length of their runs. Of the other experiments there are the objects that are
run: agents, worlds and rules, and the car's decisions, with the steps for which it holds an action.
"""

from dataclasses import replace

import numpy as np

from companion.shared.tabular import Rates
from neorl import Condition, Desire, Node, Place, Policy
from neorl.custom import Axis, Modality
from neorl.worlds import Arena, Arm, Vessel, WaterMaze
from neorl.agents.spaces import FAR_RADAR, pilot, reacher, seeker, swimmer
from neorl.core.direction import TAU

STEPS = 200_000
ANGLES = TAU * np.arange(8) * 3 / 8
FAR_PILOT = seeker([FAR_RADAR], [Desire("waypoint", "far", 1.0)])
ARMS = {2: Arm((0.5, 0.5), radius=0.15), 3: Arm((0.4, 0.3, 0.3), radius=0.15)}
NECK, LEGS = (Axis("position", "component", along, name=name) for along, name in enumerate(("neck", "legs")))
ONE_MAP = seeker([Node("bird", Modality("bird cell", [NECK, LEGS]), [9])])
MAP_OF_EACH = seeker([Node("neck", Modality("neck cell", [NECK]), [9]),
                      Node("legs", Modality("leg cell", [LEGS]), [9])])
NAMED = {"bell": (0.15, 0.25), "candle": (0.8, 0.15), "star": (0.5, 0.55), "sleigh": (0.85, 0.75),
         "wreath": (0.2, 0.9), "gingerbread": (0.6, 0.9)}
NAMELESS = (0.1, 0.6), (0.9, 0.45), (0.4, 0.1), (0.35, 0.75)
CAR = Modality("place × velocity cell", [Axis("position", "component", 0, -1.2, 0.6, intervals=18),
                                         Axis("velocity", "component", 0, -0.07, 0.07, intervals=14)])


def at_random(agent):
    return replace(agent, policy=Policy(exploration=1.0))


def in_water(agent, changes=()):
    return Condition(agent, Vessel(), STEPS, 1, changes=changes)


OWN = {
    "arms": {(links, name): Condition(agent, arm, STEPS, 1) for links, arm in ARMS.items()
             for name, agent in (("agent", reacher(links)), ("random", at_random(reacher(links))))},
    "vessel": {"radar": in_water(pilot()), "far radar": in_water(FAR_PILOT), "random": in_water(at_random(pilot())),
               "near joins": in_water(FAR_PILOT, ((STEPS // 2, pilot()),))},
    "water maze": ({"neoRL": swimmer(), "random": at_random(swimmer())},
                   Rates(learning_rate=0.3, discount=0.99, exploration=0.05),
                   WaterMaze([(0.5 + 0.25 * np.cos(angle), 0.5 + 0.25 * np.sin(angle)) for angle in ANGLES],
                             trials_a_day=4)),
    "birds": ({"one map": (ONE_MAP, 20_000), "a map of each": (MAP_OF_EACH, 20_000), "random": (at_random(ONE_MAP), 0)},
              Arena([(name, *bird) for name, bird in NAMED.items()], shape="square", motion="steps", step_length=0.05,
                    radius=0.08, ends=False, start=(0.5, 0.5), trial_seconds=1e6, fps=10), NAMED, NAMELESS),
    "car": (seeker([Node("car", CAR, [1])], [Desire(Place(0.55), "car", 1.0)]), 16, 2_400)}
