"""The contestants of the page on alternatives, by name, and what those earn that are not agents of neoRL."""

from lib.alternatives.controllers import PLANNED, nearest_green, pd, planner
from lib.alternatives.living import bins_of, live
from lib.alternatives.tabular_learners import TABULAR
from neorl import multimodal
from neorl.evidence.reading import PRIMES, networks

INFORMED = {"nearest green": lambda gains: nearest_green(), "PD": pd, "planner": planner}  # given the physics


def of_thesis(readings):
    """The thesis's agents under some readings, {name: `Reading`}: {"agent, reading": `Agent`}."""
    return {f"{agent}, {name}": made for name, each in readings.items() for agent, made in {
        "PC + OVC": multimodal(PRIMES, place_gain=each.place_gain, **each.agents),
        "network D": networks(each)["D"]}.items()}


def of_others(settings, board, steps, runs, seed):
    """What contestants that are not agents of neoRL earn on a board: {name: `Earned`}."""
    others = {name: make(settings[name]) for name, make in TABULAR.items()}
    others |= {name: make(settings["PD"]) for name, make in INFORMED.items()}
    length = {"planner": max(bins_of(steps), round(PLANNED * steps))}
    return {name: live(each, board, steps=length.get(name, steps), runs=runs, bins=bins_of(steps), seed=seed)
            for name, each in others.items()}
