"""neorl: agents that navigate by neural representations of Euclidean space, and the experiments of their thesis.

An `Agent` is a network of `Node`s and `Desire`s, a node tiles the space of a `Modality`, and `simulate` lets agents
live in `WaterWorld`; `sweep` does many `Condition`s at a time. The agents of the papers are values of these types;
`neorl.modality` holds the modalities by name. `neorl.statistics`, `neorl.claims`, `neorl.ledger`, `neorl.figures` and
`neorl.multiverse` serve the book's pages, and `neorl.classics` holds the small experiments of its chapters;
`neorl.wasm` takes the kernels into a page, where an `Explorer` runs them.
"""

from neorl.agent import Agent, Desire, Learning, Node, Place, Policy
from neorl.horde import learn, superpose
from neorl.modality import Modality
from neorl.nres import NresMap
from neorl.papers import (brownian, multimodal, network_a, network_b, network_c, network_d, object_vector_cells,
                          place_cells)
from neorl.simulation import Result, Run, simulate
from neorl.store import Condition, simulate_once
from neorl.sweep import sweep
from neorl.waterworld import WaterWorld

__all__ = ["Agent", "Condition", "Desire", "Learning", "Modality", "Node", "NresMap", "Place", "Policy", "Result",
           "Run", "WaterWorld", "learn", "simulate", "simulate_once", "superpose", "sweep",
           "brownian", "multimodal", "network_a", "network_b", "network_c", "network_d", "object_vector_cells",
           "place_cells"]


def __getattr__(name):
    if name == "Explorer":  # imported when asked for, since the rest of the package does without anywidget
        try:
            from neorl.explorer import Explorer
        except ModuleNotFoundError as error:
            raise ImportError(f"neorl.Explorer needs {error.name}: pip install {error.name}") from error
        return Explorer
    raise AttributeError(f"module 'neorl' has no attribute {name!r}")
