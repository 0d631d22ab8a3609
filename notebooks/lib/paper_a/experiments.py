"""The two experiments of paper A, under several readings of the text.

1. The first experiment has agents with one map, N10 to N90, the second agents with N3, N7, N23 and with all three.
2. The paper shows single runs of the first and the mean of many runs of the second. Here, too, the first has fewer
   runs: as many as a verdict needs.
"""

from dataclasses import replace

import numpy as np

from neorl.agents.papers import brownian
from lib.shared import side_by_side
from lib.shared.side_by_side import by_resolution, changed, few
from neorl.core.maps import NresMap
from neorl.evidence.reading import LAYERS, SINGLE, conditions
from neorl.evidence.report import CALIBRATED, LETTER
from neorl.experiments.run import Run

CONTROL = "control"


def live(readings, steps, runs, seed=0, groups=("layers", "single")):
    """The results of both experiments under each reading: {name: {key: Result}}, with the keys of `reading.conditions`.

    readings: {name: Reading}. steps, runs, seed: as in `reading.conditions`, except that the group "single" has at most
    10 runs. groups: of `reading.conditions`, "layers" and "single". The latter adds the key `CONTROL`, Brownian motion
    for as many steps and runs.
    """
    made = {name: {} for name in readings}
    for name, reading in readings.items():
        for group in groups:
            made[name] |= conditions(reading, steps, few(runs) if group == "single" else runs, seed, groups=(group,))
        if "single" in groups:
            made[name][CONTROL] = replace(made[name]["single", SINGLE[0]], agent=brownian())
    return side_by_side.live(made)


def singles(results):
    """Results of the first experiment's agents under one reading: {"N10": Result, …}."""
    return by_resolution(results, "single", SINGLE)


def layers(results):
    """Results of the second experiment's agents with one map under one reading: {"N3": Result, …}."""
    return by_resolution(results, "layer", LAYERS)


def squares_entered(agent, world, steps, runs, seed=0):
    """The squares of the board in which runs of an agent have been so far, every 0.1 s: (runs, moments).

    The squares are the cells of N90, which divides the board more finely than any map of the agents.
    """
    squares, found, interval = NresMap(max(SINGLE)), [], max(1, round(world.fps / 10))
    for k in range(runs):
        run, path = Run(agent, world, seed, k), np.empty((max(1, steps // interval), 2))
        for moment in range(len(path)):
            run.advance(interval)
            path[moment] = run.world_state.scene.position / world.size
        new = np.zeros(len(path), int)
        new[np.unique(squares.encode(path), return_index=True)[1]] = 1
        found.append(new.cumsum())
    return np.array(found)


def explore(results, steps, runs, seed=0):
    """The squares in which agents of the second experiment are under one reading: {"Brownian motion": …, "N3": …, …}.

    results: of one reading. The values are those of `squares_entered`.
    """
    agents = {"Brownian motion": results["brownian", 8], **layers(results), "all three": results["layers"]}
    return {name: squares_entered(result.agent, result.world, steps, runs, seed) for name, result in agents.items()}


def neighbours(reading):
    """Readings one choice away from a reading, within the text or beyond it: {name: Reading}.

    The choices are those that matter here.
    """
    slow, quick = (min(reading.learning_rate * factor, 1.0) for factor in (0.05, 20))
    return changed(reading, {"maps by N": {"weighting": "resolution"}, "maps by N²": {"weighting": "cells"},
                             "bootstrapping": {"bootstrap": True}, "no bootstrapping": {"bootstrap": False},
                             "no memory": {"memory": 0.0},
                             f"α {slow:.3g}": {"learning_rate": slow}, f"α {quick:.3g}": {"learning_rate": quick},
                             "ε 0.02": {"exploration": 0.02}, "half the board": {"tiled_fraction": 0.5},
                             "own cell silent": {"own_cell": "silent"}})


def explorer_conditions(results):
    """The conditions that the page's Explorer offers: {name: Result}. results: as `live` returns them, by reading."""
    offered = {}
    for name, suffix in ((CALIBRATED, ""), (LETTER, ", to the letter")):
        offered[f"Paper A, figure 7: all three maps{suffix}"] = results[name]["layers"]
        offered |= {f"Paper A, figure 7: {n} alone{suffix}": result for n, result in layers(results[name]).items()}
        offered |= {f"Paper A, figure 6: {n}{suffix}": result for n, result in singles(results[name]).items()}
    return offered | {"Paper A, figure 6: Brownian motion": results[CALIBRATED][CONTROL]}
