"""neorl: agents that navigate by neural representations of Euclidean space, and the experiments of their thesis.

The names below carry the papers; `neorl.statistics`, `neorl.claims` and `neorl.figures` serve the book's pages.
"""

from neorl.agent import Agent, Learning, Policy, brownian, place_cells
from neorl.horde import learn, superpose
from neorl.nres import NresMap
from neorl.simulation import Result, Run, simulate
from neorl.store import simulate_once
from neorl.waterworld import WaterWorld

__all__ = ["Agent", "Learning", "NresMap", "Policy", "Result", "Run", "WaterWorld", "brownian", "learn", "place_cells",
           "simulate", "simulate_once", "superpose"]
