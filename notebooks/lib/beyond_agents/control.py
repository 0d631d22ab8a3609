"""Networks down to control: nodes whose desire is a velocity, and a velocity node that knows how to reach it.

1. *two layers*: the desire vector of an object-vector node, whose goals are contacts, is a desired velocity. A node of
   velocity cells acts on it; it has learned the way from every velocity to every other, and nothing about creeps.
2. *three layers*: the desire vector of the object-vector node is a place for place cells, whose desire vector is the
   desired velocity.
3. In both, the object-vector cells do not represent velocity, unlike the forager's; only the velocity node acts.
4. Settings are drawn from `RANGES`, the same number for each network. Each is judged by its reward in the last third of
   `RUNS` runs with `SEED`, which no figure uses. ``python -m lib.beyond_agents.control`` writes all rewards
   to ``control.json``, one row per setting.
"""

import json
from pathlib import Path

import numpy as np

from lib.alternatives.search import drawn
from neorl import checks
from neorl.agents.agent import Agent, Desire, Node
from neorl.agents.beyond import forager, foveated_cells
from neorl.agents.rules import GREEDY, Contacts, Learning
from neorl.core.modality import PLACE_CELL, Modality, cartesian
from neorl.experiments.cache import Condition
from neorl.experiments.simulation import simulate
from neorl.experiments.sweeping import sweep
from neorl.worlds.waterworld import WaterWorld

SEED, SETTINGS, RUNS, STEPS = 1_000, 128, 2, 150_000
RECORD = Path(__file__).with_name("control.json")
NETWORKS = {"two layers": 2, "three layers": 3}
ALONE, FORAGER = "object vectors alone", "forager"
RESOLUTIONS = forager().nodes[0].resolutions
# A pair has the ends of a range from which a number is drawn log-uniformly; a list has the choices.
RANGES = {"scale": (3.0, 1_000.0),  # of the velocity desired
          "reach": (1.0, 100.0),  # of the place desired
          "fastest": (0.8, 2.5),  # velocity up to which the map reaches
          "velocities": [5, 7, 9, 13, 17], "places": [7, 13, 23], "update_on": ["cell", "step"],
          "learning_rate": (0.01, 0.5), "discount": (0.5, 0.98), "horizon": (0.2, 2.0), "caution": (0.1, 3.0),
          "own_cell": ["silent", "counts"]}


def control_network(layers, setting):
    """The network of 2 or 3 layers with a setting, {name: value} with the names of `RANGES`: an `Agent`."""
    checks.one_of("layers", layers, tuple(NETWORKS.values()))
    fastest = setting["fastest"]
    velocities = Modality("velocity cell", cartesian("velocity", (-fastest, fastest), (-fastest, fastest)))
    nodes = [Node("OVC", foveated_cells(velocity=False), RESOLUTIONS, gain=0.0, goals="contacts"),
             Node("V", velocities, (setting["velocities"],))]
    desires = [Desire("green", "OVC", 1.0), Desire("red", "OVC", -1.0)]
    if layers == 2:
        desires.append(Desire("OVC", "V", 1.0, scale=setting["scale"]))
    else:
        nodes.append(Node("PC", PLACE_CELL, (setting["places"],), gain=0.0))
        desires += [Desire("OVC", "PC", 1.0, scale=setting["reach"]), Desire("PC", "V", 1.0, scale=setting["scale"])]
    choices = {"learning_rate": setting["learning_rate"], "discount": setting["discount"]}
    learning = (Learning(update_on="step", **choices) if setting["update_on"] == "step" else
                Learning(**choices, absent_decay=0.1101, absent_form="away"))
    return Agent(nodes, desires, learning, GREEDY, own_cell=setting["own_cell"],
                 contacts=Contacts(horizon=setting["horizon"], caution=setting["caution"]))


def setting_of(layers, number):
    """The setting at place `number` of a network's search: {name: value}, numbers to three digits."""
    return {name: float(f"{value:.3g}") if isinstance(value, float) else value
            for name, value in drawn(RANGES, SEED, layers, number).items()}


def earned_by(layers, number):
    """Reward per second of a setting in the last third, a mean over the runs of the search."""
    result = simulate(control_network(layers, setting_of(layers, number)), WaterWorld(), steps=STEPS, runs=RUNS,
                      seed=SEED, progress=False)
    return float(np.round(result.rate(2 / 3, 1.0).mean(), 4))


def main():
    """Search, and write the record."""
    rows = [{"layers": layers, "number": number, "earned": earned_by(layers, number)}
            for layers in NETWORKS.values() for number in range(SETTINGS)]
    RECORD.write_text("[" + ",\n ".join(map(json.dumps, rows)) + "]\n")


def read_record():
    """All settings that were tried, best first: a list of dicts."""
    return sorted(json.loads(RECORD.read_text()), key=lambda row: row["earned"], reverse=True)


def best_networks():
    """The best networks of the search: {name: `Agent`}."""
    record = read_record()
    found = {}
    for name, layers in NETWORKS.items():
        best = next(row["number"] for row in record if row["layers"] == layers)
        found[name] = control_network(layers, setting_of(layers, best))
    return found


def compared(steps, runs, seed=0):
    """Run the networks, their object-vector node alone, and the forager: {name: `Result`}."""
    alone = Agent([Node("OVC", foveated_cells(velocity=False), RESOLUTIONS, goals="contacts")],
                  [Desire("green", "OVC", 1.0), Desire("red", "OVC", -1.0)], policy=GREEDY)
    agents = best_networks() | {ALONE: alone, FORAGER: forager()}
    results = sweep([Condition(agent, WaterWorld(), steps, runs, seed) for agent in agents.values()], progress=False)
    return dict(zip(agents, results))


if __name__ == "__main__":
    main()
