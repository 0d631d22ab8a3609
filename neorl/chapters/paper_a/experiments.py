"""The two experiments of paper A, under several readings of the text.

1. The first experiment has agents with one map, N10 to N90, the second agents with N3, N7, N23 and with all three.
2. The paper shows single runs of the first and the mean of many runs of the second. Here, too, the first has fewer
   runs: as many as a verdict needs.
"""

from dataclasses import replace

from neorl.agents.papers import brownian
from neorl.chapters.shared import side_by_side
from neorl.chapters.shared.side_by_side import by_resolution, changed, few
from neorl.evidence.reading import LAYERS, SINGLE, conditions
from neorl.evidence.report import CALIBRATED, LETTER

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
