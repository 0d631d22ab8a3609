"""The searches for the settings of the page's agents, and the records of all settings tried.

1. *The forager*: differential evolution (Storn and Price 1997) of six fields of `neorl.Contacts` and of the
   resolutions. A setting's score is the sum of three mean rewards per second while learning: over the last third of
   150,000 steps with 3 creeps, half of that with 8, and over the last 100,000 of 600,000 steps with 3.
2. *Networks down to control*: settings drawn from `NETWORK_RANGES`, the same number for the network of two layers and
   for that of three, each judged by its reward in the last third of 150,000 steps with 3 creeps.
3. Every setting is judged by runs with `SEED`, which no figure of the page uses. ``python -m
   companion.beyond_agents.search`` repeats the first search and writes ``search.json``; `search_networks` repeats the
   second for the function that makes a network, a cell of the page, and writes ``networks.json``.
"""

import json
from pathlib import Path

import numpy as np

from companion.alternatives.search import drawn
from neorl import Contacts, WaterWorld, forager, simulate

SEED = 1_000
FORAGERS, NETWORKS = (Path(__file__).with_name(name) for name in ("search.json", "networks.json"))
RESOLUTIONS = ((5, 9, 15), (4, 7, 12), (5, 11, 19), (4, 7, 11, 17), (5, 9, 15, 25))
# The bounds of the search, which scales the fields named in LOGARITHMIC by their logarithms.
RANGES = {"horizon": (0.3, 1.3), "learning_rate": (0.005, 0.1), "familiarity": (2.0, 60.0), "first_value": (0.05, 0.6),
          "trace_rate": (0.05, 1.0), "caution": (0.15, 1.0)}
LOGARITHMIC = ("learning_rate", "familiarity", "trace_rate")
CANDIDATES, GENERATIONS = 2, 9  # candidates for each of the seven dimensions
# A pair has the ends of a range from which a number is drawn log-uniformly; a list has the choices.
NETWORK_RANGES = {
    "scale": (3.0, 1_000.0),  # of the velocity desired
    "reach": (1.0, 100.0),  # of the place desired
    "fastest": (0.8, 2.5),  # velocity up to which the map reaches
    "velocities": [5, 7, 9, 13, 17], "places": [7, 13, 23], "update_on": ["cell", "step"],
    "learning_rate": (0.01, 0.5), "discount": (0.5, 0.98), "horizon": (0.2, 2.0), "caution": (0.1, 3.0),
    "own_cell": ["silent", "counts"]}
LAYERS, SETTINGS, RUNS, STEPS = (2, 3), 128, 2, 150_000  # of networks


def main():
    """Search for the forager's settings, and write the record."""
    from scipy.optimize import differential_evolution

    tried = []

    def cost(point):
        settings = settings_at(point)
        scores = rewards_of(settings)
        tried.append(settings | dict(zip(("with_3", "with_8", "late"), np.round(scores, 4).tolist())))
        _write(FORAGERS, tried)
        return -score_of(tried[-1])

    differential_evolution(cost, [(0.0, 1.0)] * (1 + len(RANGES)), popsize=CANDIDATES, maxiter=GENERATIONS, seed=SEED,
                           polish=False, init="sobol")


def settings_at(point):
    """The settings at a point of the unit cube: {field: value}, resolutions first."""
    index = min(int(point[0] * len(RESOLUTIONS)), len(RESOLUTIONS) - 1)
    settings = {"resolutions": list(RESOLUTIONS[index])}
    for (name, (low, high)), share in zip(RANGES.items(), point[1:]):
        value = low * (high / low) ** share if name in LOGARITHMIC else low + (high - low) * share
        settings[name] = float(f"{value:.3g}")
    return settings


def agent_of(settings):
    """The `Agent` with these settings."""
    fields = {name: settings[name] for name in RANGES}
    return forager(settings["resolutions"], contacts=Contacts(**fields))


def rewards_of(settings, seed=SEED):
    """The three rewards per second by which a setting is judged: float64 (3,)."""
    agent = agent_of(settings)
    with_3 = simulate(agent, WaterWorld(), runs=4, steps=150_000, seed=seed)
    with_8 = simulate(agent, WaterWorld(n_creeps=8), runs=2, steps=150_000, seed=seed)
    late = simulate(agent, WaterWorld(), runs=2, steps=600_000, seed=seed)
    return np.array([each.rewards[:, -round(steps / 10):].sum() / each.runs / (steps / 50)
                     for each, steps in ((with_3, 50_000), (with_8, 50_000), (late, 100_000))])


def score_of(row):
    """The score of a row of the record."""
    return row["with_3"] + 0.5 * row["with_8"] + row["late"]


def tried_foragers():
    """All settings tried for the forager, best first: a list of dicts."""
    return sorted(json.loads(FORAGERS.read_text()), key=score_of, reverse=True)


def search_networks(network):
    """Search for the settings of networks, and write the record. network: function of (layers, setting), an `Agent`."""
    _write(NETWORKS, [{"layers": layers, "number": number,
                       "earned": earned_by(network(layers, setting_of(layers, number)))}
                      for layers in LAYERS for number in range(SETTINGS)])


def setting_of(layers, number):
    """The setting at place `number` of a network's search: {name: value}, numbers to three digits."""
    return {name: float(f"{value:.3g}") if isinstance(value, float) else value
            for name, value in drawn(NETWORK_RANGES, SEED, layers, number).items()}


def earned_by(agent):
    """Reward per second of a network in the last third, a mean over the runs of the search."""
    result = simulate(agent, WaterWorld(), steps=STEPS, runs=RUNS, seed=SEED, progress=False)
    return float(np.round(result.rate(2 / 3).mean(), 4))


def tried_networks():
    """All settings tried for networks, best first: a list of dicts."""
    return sorted(json.loads(NETWORKS.read_text()), key=lambda row: row["earned"], reverse=True)


def best_setting(layers):
    """The best setting of the networks with so many layers: {name: value}."""
    return setting_of(layers, next(row["number"] for row in tried_networks() if row["layers"] == layers))


def _write(path, rows):
    path.write_text("[" + ",\n ".join(map(json.dumps, rows)) + "]\n")


if __name__ == "__main__":
    main()
