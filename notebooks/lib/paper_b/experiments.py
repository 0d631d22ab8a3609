"""The experiments of paper B, and those of other claims about its agents, under any reading.

1. Figures 4 and 5 of the paper, and agents that change during a run, are conditions: runs whose rewards suffice.
2. Single resolutions, and conditions that the paper does not plot, have at most 10 runs.
"""

from dataclasses import replace

from neorl.agents.papers import brownian
from neorl.agents.rules import Policy
from lib.shared import side_by_side
from lib.shared.side_by_side import few
from neorl.evidence.priors import WITHIN
from neorl.evidence.reading import PRIMES, conditions
from neorl.evidence.report import CALIBRATED, LETTER
from neorl.experiments.cache import Condition

MAIN, GROUPS = ("modal", "pace"), ("layers", "resolutions", "revaluing")  # of `neorl.evidence.reading.GROUPS`
BEFORE = "object as state"  # the calibrated reading, but with the state of object vectors that the book had before
AGENTS = {"PC": ("place", "all"), "OVC": ("objects", "all"), "PC + OVC": "both"}  # of figure 5, and their keys
EXPLORING = Policy(0.05, "random")  # from the change on, of agents that otherwise never explore
CELLS = {"PC": "place", "OVC": "object-vector", "PC + OVC": "place + object-vector"}  # these in words


def live(readings, steps, runs, seed=0):
    """Results of `all_conditions` under each reading, {name: Reading}: {name: {key: `Result`}}."""
    return side_by_side.live({name: all_conditions(each, steps, runs, seed) for name, each in readings.items()})


def all_conditions(reading, steps, runs, seed=0):
    """The conditions of the page under a reading: {key: `Condition`}.

    steps, runs: as `neorl.evidence.reading.conditions` takes them. The keys are those of its conditions, and
    ("points", name): figure 5's agents and Brownian motion in a tank whose reward shows when a board was reset, all but
        the agent with both modalities for a quarter of the steps;
    ("revalued", "exploring"): "revalued", except that the agents explore from the change on;
    "joined": place cells that object-vector cells join at half-time.
    Raises ValueError for bad arguments.
    """
    main = conditions(reading, steps, runs, seed, MAIN)
    del main["brownian", 3]  # whose mean is precise with few runs
    made = conditions(reading, steps, few(runs), seed, (*MAIN, *GROUPS)) | main
    both = made["both"]
    shows_resets = replace(both.world, win_reward=1.0)
    agents = {name: made[key].agent for name, key in AGENTS.items()} | {"Brownian motion": brownian()}
    for name, agent in agents.items():
        length = both.steps if agent == both.agent else max(1, both.steps // 4)
        made["points", name] = Condition(agent, shows_resets, length, few(runs), seed)
    ((turn, desiring),) = made["revalued"].changes
    made["revalued", "exploring"] = replace(made["revalued"], changes=((turn, replace(desiring, policy=EXPLORING)),))
    made["joined"] = replace(made["place", "all"], runs=few(runs), changes=((both.steps // 2, both.agent),))
    return made


def live_with_objects_as_state(reading, steps, runs, seed=0):
    """Results of figure 5's agents if the state of an object vector is the object's cell: {`BEFORE`: {key: `Result`}}.

    The goal is then the cell at distance 0, and all else as in a `Reading`. Raises ValueError for bad arguments.
    """
    other = replace(reading, object_state="object", object_reach=0.0)
    return side_by_side.live({BEFORE: conditions(other, steps, runs, seed, ["modal"])})


def neighbours(reading, steps, runs, seed=0):
    """The conditions of B1, B3 and B6 in readings one choice away from a reading: {name: {key: `Condition`}}.

    The choices are what the state of an object vector is, its grid and range, and how the two modalities are weighted;
    each takes the other values that the text leaves open, the gain those next to its own.
    """
    made = {}
    for field in ("object_state", "object_tiled_fraction", "object_beyond", "object_centred", "place_gain"):
        choice = WITHIN[field]
        own = choice.prior.index(getattr(reading, field))
        for place, level in enumerate(choice.prior):
            if place != own and (field != "place_gain" or abs(place - own) == 1):
                other = replace(reading, **{field: level})
                made[f"{choice.label}: {choice.words(level)}"] = conditions(other, steps, runs, seed, ["modal"])
    return made


def of_figure_4(results, modality):
    """Results of figure 4's agents under one reading, "place" (4A) or "objects" (4B): {"N2": Result, …}."""
    return side_by_side.by_resolution(results, modality, (*PRIMES, "all"))


def of_figure_5(results):
    """Results of figure 5's agents under one reading: {"PC": Result, …}."""
    return {name: results[key] for name, key in AGENTS.items()}


def explorer_conditions(lived, moving):
    """The conditions that the page's Explorer offers: {name: Result}.

    lived: results by reading, as `live` returns them. moving: the result of
    `lib.paper_b.trials.live_with_moving_desire`.
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
