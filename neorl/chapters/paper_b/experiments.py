"""The experiments of paper B, and those of other claims about its agents, under any reading.

1. Figures 4 and 5 of the paper, and agents that change while they live, are conditions: runs whose rewards are enough.
2. Single resolutions, and what the paper does not plot, have a fifth of the runs, but 10 where there are as many.
"""

from dataclasses import replace

from neorl.agents.papers import brownian
from neorl.chapters.shared import side_by_side
from neorl.chapters.shared.side_by_side import few
from neorl.evidence.priors import WITHIN
from neorl.evidence.reading import PRIMES, conditions
from neorl.evidence.report import CALIBRATED, LETTER
from neorl.experiments.cache import Condition

MAIN, GROUPS = ("modal", "pace"), ("layers", "resolutions", "revaluing")  # of `neorl.evidence.reading.GROUPS`
AGENTS = {"PC": ("place", "all"), "OVC": ("objects", "all"), "PC + OVC": "both"}  # of figure 5, by key
CELLS = {"PC": "place", "OVC": "object-vector", "PC + OVC": "place + object-vector"}  # these in words


def live(readings, steps, runs, seed=0):
    """The results of `all_conditions` under each reading, {name: Reading}: {name: {key: `Result`}}."""
    return side_by_side.live({name: all_conditions(each, steps, runs, seed) for name, each in readings.items()})


def all_conditions(reading, steps, runs, seed=0):
    """The conditions of the page under a reading: {key: `Condition`}.

    steps, runs: as `neorl.evidence.reading.conditions` takes them, whose keys these have, and
    ("points", name): figure 5's agents and Brownian motion in a tank whose reward shows when a board was reset, for a
        quarter of the time but for both modalities;
    "joined": place cells that get object-vector cells too at half-time.
    Raises ValueError for bad arguments.
    """
    main = conditions(reading, steps, runs, seed, MAIN)
    del main["brownian", 3]  # whose mean is known well from as many runs as the others need
    made = conditions(reading, steps, few(runs), seed, (*MAIN, *GROUPS)) | main
    both = made["both"]
    shows_resets = replace(both.world, win_reward=1.0)
    agents = {name: made[key].agent for name, key in AGENTS.items()} | {"Brownian motion": brownian()}
    for name, agent in agents.items():
        length = both.steps if agent == both.agent else max(1, both.steps // 4)
        made["points", name] = Condition(agent, shows_resets, length, few(runs), seed)
    made["joined"] = replace(made["place", "all"], runs=few(runs), changes=((both.steps // 2, both.agent),))
    return made


def neighbours(reading, steps, runs, seed=0):
    """The conditions of B1, B3 and B6 in readings that differ from a reading in one choice: {name: {key: `Condition`}}.

    The choices are those that make an object vector a state and weigh the two modalities; each takes the other values
    that the text leaves open.
    """
    made = {}
    for field in ("causes", "capture", "attention", "object_tiled_fraction", "place_gain"):
        choice = WITHIN[field]
        for level in choice.prior:
            if level != getattr(reading, field):
                other = replace(reading, **{field: level})
                made[f"{choice.label}: {choice.words(level)}"] = conditions(other, steps, runs, seed, ["modal"])
    return made


def of_figure_4(results, modality):
    """The agents of figure 4 among the results of one reading, "place" (4A) or "objects" (4B): {"N2": Result, …}."""
    return side_by_side.by_resolution(results, modality, (*PRIMES, "all"))


def of_figure_5(results):
    """The agents of figure 5 among the results of one reading: {"PC": Result, …}."""
    return {name: results[key] for name, key in AGENTS.items()}


def explorer_conditions(lived, moving):
    """The conditions that the Explorer of the page offers: {name: Result}.

    lived: results by reading, as `live` has them. moving: that of `neorl.chapters.paper_b.trials`, whose desire moves.
    """
    calibrated = lived[CALIBRATED]
    offered = {"Paper B, figure 5: place + object-vector cells": calibrated["both"]}
    for figure, modality in (("4A: place", "place"), ("4B: object-vector", "objects")):
        offered |= {f"Paper B, figure {figure} cells, {n}": result
                    for n, result in of_figure_4(calibrated, modality).items()}
    offered |= {f"Paper B, figure 5, to the letter: {CELLS[name]} cells": result
                for name, result in of_figure_5(lived[LETTER]).items()}
    return offered | {"Paper B: red revalued half-way": calibrated["revalued"], "Paper B: a desire that moves": moving,
                      "Paper B: object-vector cells join": calibrated["joined"]}
