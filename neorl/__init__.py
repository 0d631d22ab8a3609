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

An `Agent` is a network of `Node`s and `Desire`s; each node tiles the space of a `modality`. `simulate` runs agents in
`WaterWorld` or any other `World`; `sweep` runs many `Condition`s in parallel. A `Learner` is an agent for a loop of the
user's own. The agents of the papers are values of these types, and learn by `CALIBRATED` and choose by `GREEDY`; the
defaults of `Learning` and `Policy` are plain. The rest is in namespaces:

- `neorl.custom`: what worlds, modalities and policies of one's own are written with;
- `neorl.worlds`: other worlds, such as an `Arena`, and walls;
- `neorl.statistics`, `neorl.drawing`, `neorl.gym`: estimates with intervals; figures; Gymnasium environments.

The package is organised in rooms; a module imports only from its own room and from the rooms below it:

- `neorl.browser`: the kernels compiled for web pages, and the Explorer that runs them there;
- `neorl.gym`: worlds as Gymnasium environments, and agents in any Gymnasium environment;
- `neorl.drawing`: figures;
- `neorl.statistics`: estimates with their intervals, and comparisons;
- `neorl.experiments`: runs, sweeps, and the cache of finished ones;
- `neorl.agents`: agents as data, and the `Learner`;
- `neorl.custom`: the namespace of what users write;
- `neorl.worlds`: the interface of worlds, WaterWorld and others, and the rollout of an agent in them;
- `neorl.description`: agents, worlds and conditions as plain data;
- `neorl.core`: the agent: scenes, modalities, maps, and the kernels that learn and choose;
- `neorl.kernels`: how kernels are compiled, cached and called;
- `neorl.common`: checks, files, warnings.
"""

import importlib

from neorl import custom as custom
from neorl import worlds
from neorl.agents.agent import Agent, Desire, Node, Place
from neorl.agents.forager import forager
from neorl.agents.learner import Learner
from neorl.agents.papers import (brownian, multimodal, network_a, network_b, network_c, network_d, object_vector_cells,
                                 place_cells)
from neorl.agents.rules import CALIBRATED, GREEDY, TO_THE_LETTER, Contacts, Learning, Policy
from neorl.common.version import VERSION
from neorl.core import modality
from neorl.core.maps import NresMap
from neorl.core.policy import greedy, softmax
from neorl.core.scene import CARDINAL, Actions, Scene
from neorl.description import name_shortly
from neorl.experiments.condition import Condition
from neorl.experiments.result import Result
from neorl.experiments.run import Run
from neorl.experiments.simulation import simulate, sweep
from neorl.kernels.kernel import kernel
from neorl.worlds.waterworld import WaterWorld
from neorl.worlds.world import World

AGENTS = (brownian, forager, multimodal, network_a, network_b, network_c, network_d, object_vector_cells, place_cells)
WORLDS = (WaterWorld, worlds.Arena, worlds.Arm, worlds.Vessel, worlds.WaterMaze)
NAMESPACES = ("custom", "drawing", "gym", "modality", "statistics", "worlds")

__version__ = VERSION
name_shortly(*AGENTS, *WORLDS, Agent, Place, greedy, softmax)

__all__ = ["Actions", "Agent", "CALIBRATED", "CARDINAL", "Condition", "Contacts", "Desire", "Explorer", "GREEDY",
           "Learner", "Learning", "Node", "NresMap", "Place", "Policy", "Result", "Run", "Scene", "TO_THE_LETTER",
           "WaterWorld", "World", "kernel", "modality", "simulate", "sweep",
           "brownian", "forager", "multimodal", "network_a", "network_b", "network_c", "network_d",
           "object_vector_cells", "place_cells"]


def __getattr__(name):
    """What is imported on demand: the rest of the package needs neither anywidget nor SciPy nor Matplotlib."""
    if name == "Explorer":
        from neorl.browser.explorer import Explorer
        return Explorer
    if name in NAMESPACES:
        return importlib.import_module(f"neorl.{name}")
    raise AttributeError(f"module 'neorl' has no attribute {name!r}")


def __dir__():
    return sorted({*__all__, *NAMESPACES, "__version__"})
