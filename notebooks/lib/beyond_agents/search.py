"""Search for the settings of the forager: ``python -m lib.beyond_agents.search``.

Differential evolution (Storn and Price 1997) of six fields of `neorl.Contacts` and of the resolutions. A setting's
score is the sum of three mean rewards per second while learning: over the last third of 150,000 steps with 3 creeps,
half of that with 8, and over the last 100,000 of 600,000 steps with 3. Every setting is judged by the same runs, with
`SEED`, which no figure of the page uses. All settings tried are written to ``search.json``, one row per setting.
"""

import json
from pathlib import Path

import numpy as np

from neorl.agents.beyond import forager
from neorl.agents.rules import Contacts
from neorl.experiments.simulation import simulate
from neorl.worlds.waterworld import WaterWorld

SEED = 1_000
RECORD = Path(__file__).with_name("search.json")
RESOLUTIONS = ((5, 9, 15), (4, 7, 12), (5, 11, 19), (4, 7, 11, 17), (5, 9, 15, 25))
# The bounds of the search, which scales the fields named in LOGARITHMIC by their logarithms.
RANGES = {"horizon": (0.3, 1.3), "learning_rate": (0.005, 0.1), "familiarity": (2.0, 60.0), "first_value": (0.05, 0.6),
          "trace_rate": (0.05, 1.0), "caution": (0.15, 1.0)}
LOGARITHMIC = ("learning_rate", "familiarity", "trace_rate")
CANDIDATES, GENERATIONS = 2, 9  # candidates for each of the seven dimensions


def main():
    """Search, and write the record."""
    from scipy.optimize import differential_evolution

    tried = []

    def cost(point):
        settings = settings_at(point)
        scores = rewards_of(settings)
        tried.append(settings | dict(zip(("with_3", "with_8", "late"), np.round(scores, 4).tolist())))
        RECORD.write_text("[" + ",\n ".join(map(json.dumps, tried)) + "]\n")
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


def read_record():
    """All settings that were tried, best first: a list of dicts."""
    return sorted(json.loads(RECORD.read_text()), key=score_of, reverse=True)


if __name__ == "__main__":
    main()
