"""neorl: agents that learn the ways between the cells of their maps, and go where they come to want.

The package builds, runs and compares agents that navigate by brain-like maps of space, after P. R. Leikanger,
*Autonomous Navigation in (the Animal and) the Machine* (2022). As such an agent acts, it learns the way to each cell of
each of its maps. What it wants only weighs these ways, and may change at any time without new learning:

>>> agent, tank = neorl.multimodal(), neorl.WaterWorld()
>>> run = neorl.Run(agent, tank)
>>> score = run.advance(300_000)  # 100 minutes of catching discs
>>> star = [neorl.Desire(neorl.Place(0.2, 0.8), node.name, 2.0) for node in agent.nodes]
>>> run.change(dataclasses.replace(agent, desires=[*agent.desires, *star]))
>>> path = run.record(3_000).positions / tank.width  # of the next minute
>>> print(path.mean(axis=0).round(1))
[0.2 0.8]

An `Agent` is a network of `Node`s and `Desire`s; each node tiles the space of a `Modality`. `simulate` runs agents in
`WaterWorld`, an `Arena`, an `Arm`, a `Vessel`, a `WaterMaze` or any other `World`; `sweep` runs many `Condition`s in
parallel. A `Learner` is an agent for a loop of the user's own. The agents of the papers are values of these types, and
learn by `CALIBRATED` and choose by `GREEDY`; the defaults of `Learning` and `Policy` are plain.

The package is organised in rooms; a module imports only from its own room and from the rooms below it:

- `neorl.browser`: the kernels compiled for web pages, and the Explorer that runs them there;
- `neorl.gym`: worlds as Gymnasium environments, and agents in any Gymnasium environment;
- `neorl.drawing`: figures;
- `neorl.statistics`: estimates with their intervals, and comparisons;
- `neorl.experiments`: runs, sweeps, and the cache of finished ones;
- `neorl.agents`: agents as data, and the `Learner`;
- `neorl.beyond`: learners that go beyond the thesis;
- `neorl.worlds`: the interface of worlds, WaterWorld and others, and the rollout of an agent in them;
- `neorl.core`: the agent: scenes, modalities, maps, and the kernels that learn and choose;
- `neorl.kernels`: how kernels are compiled, cached and called;
- `neorl.common`: checks, files, warnings.
"""

from neorl.agents.agent import Agent, Desire, Node, Place
from neorl.agents.beyond import forager
from neorl.agents.learner import Learner
from neorl.agents.papers import (brownian, multimodal, network_a, network_b, network_c, network_d, object_vector_cells,
                                 place_cells)
from neorl.agents.rules import CALIBRATED, GREEDY, TO_THE_LETTER, Contacts, Learning, Policy
from neorl.core import modality
from neorl.core.coordinates import sense, tune
from neorl.core.direction import heading, turn
from neorl.core.horde import learn, superpose
from neorl.core.maps import NresMap
from neorl.core.modality import Axis, Modality, cartesian, polar
from neorl.core.policy import greedy, softmax
from neorl.core.scene import ABSENT, CARDINAL, Actions, Scene
from neorl.core.stream import randint, uniform
from neorl.experiments.condition import Condition
from neorl.experiments.result import Result
from neorl.experiments.run import Run, Trajectory
from neorl.experiments.simulation import simulate, sweep
from neorl.kernels.annotations import array
from neorl.kernels.execution import execute
from neorl.kernels.kernel import kernel, kernel_maker
from neorl.worlds import walls
from neorl.worlds.arena import Arena
from neorl.worlds.arm import Arm
from neorl.worlds.vessel import Vessel
from neorl.worlds.water_maze import WaterMaze
from neorl.worlds.waterworld import WaterWorld
from neorl.worlds.world import Dynamics, World

__version__ = "0.1.0"
__all__ = ["ABSENT", "Actions", "Agent", "Arena", "Arm", "Axis", "CALIBRATED", "CARDINAL", "Condition", "Contacts",
           "Desire", "Dynamics", "Estimate", "GREEDY", "Learner", "Learning", "Modality", "Node", "NresMap", "Place",
           "Policy", "Result", "Run", "Scene", "TO_THE_LETTER", "Trajectory", "Vessel", "WaterMaze", "WaterWorld",
           "World", "array", "cartesian", "estimate", "execute", "greedy", "heading", "kernel", "kernel_maker", "learn",
           "modality", "polar", "randint", "sense", "simulate", "softmax", "superpose", "sweep", "tune", "turn",
           "uniform", "walls",
           "brownian", "forager", "multimodal", "network_a", "network_b", "network_c", "network_d",
           "object_vector_cells", "place_cells"]


def __getattr__(name):
    """What is imported on demand: the rest of the package needs neither anywidget nor SciPy."""
    if name == "Explorer":
        from neorl.browser.explorer import Explorer
        return Explorer
    if name in ("Estimate", "estimate"):
        from neorl import statistics
        return getattr(statistics, name)
    raise AttributeError(f"module 'neorl' has no attribute {name!r}")
