"""neorl: agents that navigate by neural representations of Euclidean space, and the experiments of their thesis.

The names below carry the papers.
"""

from neorl.agent import Agent, Learning, Policy, brownian, place_cells
from neorl.horde import learn, superpose
from neorl.nres import NresMap
from neorl.simulation import Result, Run, simulate
from neorl.waterworld import WaterWorld

__all__ = ["Agent", "Learning", "NresMap", "Policy", "Result", "Run", "WaterWorld", "brownian", "learn", "place_cells",
           "simulate", "superpose"]
