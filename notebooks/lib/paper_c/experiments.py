"""The experiments of paper C, under several readings of the text: four networks, and recursion in the last."""

from dataclasses import replace

from neorl.agents.papers import PRIMES
from lib.shared import side_by_side
from lib.shared.side_by_side import changed, few
from neorl.evidence.reading import LAYERS, conditions
from neorl.evidence.report import CALIBRATED, LETTER

NETWORKS = tuple("ABCD")
MANY_RUNS = 100  # with as many or more there are more `neighbours`


def live(readings, steps, runs, seed=0):
    """Results of networks A to D, and of Brownian motion, under each reading: {name: {key: Result}}.

    readings: {name: Reading}. steps, runs, seed: as in `reading.conditions`, which also has the keys.
    """
    return side_by_side.live({name: conditions(reading, steps, runs, seed, groups=("networks",))
                              for name, reading in readings.items()})


def networks(results):
    """Results of the networks under one reading: {"A": Result, …}."""
    return {name: results["network", name] for name in NETWORKS}


def recur(readings, weights, steps, runs, seed=0):
    """Results of network D by its weight of recursion: {name: [Result for each weight]}.

    readings: {name: Reading}. weights: numbers; with 0, D is C. steps, runs, seed: as in `reading.conditions`, except
    that conditions that `live` does not have are run at most 10 times.
    """
    made = {name: {} for name in readings}
    for name, reading in readings.items():
        for weight in weights:
            some = runs if weight in (0, reading.recursion) else few(runs)
            found = conditions(replace(reading, recursion=weight), steps, some, seed, groups=("networks",))
            made[name][weight] = found["network", "D" if weight else "C"]
    return {name: [*results.values()] for name, results in side_by_side.live(made).items()}


def neighbours(reading, runs):
    """Readings one choice away from a reading, within the text or beyond it: {name: Reading}.

    The choices are those that matter here. There are more of them if the networks have `MANY_RUNS` runs or more.
    """
    changes = {"maps N3, N7, N23": {"network_resolutions": LAYERS}, "maps of primes": {"network_resolutions": PRIMES},
               "no memory": {"memory": 0.0}, "places × 5": {"network_gain": 5.0},
               "valence in vectors": {"vectors": "signed"}}
    if runs >= MANY_RUNS:
        changes |= {"bootstrapping": {"bootstrap": True}, "no bootstrapping": {"bootstrap": False},
                    "ten times as far": {"scale": 10 * reading.scale}, "a tenth as far": {"scale": reading.scale / 10},
                    "ε 0.02": {"exploration": 0.02}, "own cell silent": {"own_cell": "silent"}}
    return changed(reading, changes)


def explorer_conditions(results):
    """The conditions that the page's Explorer offers: {name: Result}. results: as `live` returns them, by reading."""
    readings = ((CALIBRATED, ""), (LETTER, ", to the letter"))
    return {f"Paper C, figure 4e: network {name}{suffix}": result
            for reading, suffix in readings for name, result in networks(results[reading]).items()}
