"""Whether learning requires persistence: agents that learn at changes of cell, or at every step (claim T7).

1. The agents are those of paper A with maps N3, N7 and N23, in the tank of that paper, and those of paper B with object
   vectors. They differ only in their temporal driver, except that with learning at every step the state of an object
   vector is the object's cell, since within a step the self stays in the centre.
2. Agents that learn at every step have one of three discounts: γ itself, and the roots of γ with the same horizon in
   time if a stay in a cell lasts 10 or 50 steps.
3. They have at most as many runs as a verdict needs. The best of the three counts.
"""

from dataclasses import replace

import numpy as np

from lib.shared.wording import table
from neorl.evidence import claims
from neorl.evidence.reading import conditions
from neorl.evidence.statistics import estimate
from neorl.experiments.sweeping import sweep

CHANGES, BROWNIAN = "changes of cell", "Brownian motion"
PLACES = "place cells"
AGENTS = {PLACES: ("layers", ("brownian", 8)), "object-vector cells": (("objects", "all"), ("brownian", 3)),
          "both": ("both", ("brownian", 3))}  # the keys of their conditions
GROUPS = ("layers", "modal")
STAYS = (1, 10, 50)  # steps


def live(readings, steps, runs, seed=0):
    """Results under each reading, of each of `AGENTS`: {name: {which: {label: Result}}}.

    The labels are `CHANGES`, `BROWNIAN`, and discounts.
    readings: {name: Reading}. steps, runs, seed: as in `reading.conditions`, except that agents that learn at every
    step have at most 10 runs.
    """
    return {name: _live(reading, steps, runs, seed) for name, reading in readings.items()}


def _live(reading, steps, runs, seed):
    made = conditions(reading, steps, runs, seed, groups=GROUPS)
    chosen = {which: {CHANGES: made[key], BROWNIAN: made[control]} for which, (key, control) in AGENTS.items()}
    for stay in STAYS:
        rule = replace(reading, credit="step", discount=reading.discount ** (1 / stay))
        made = conditions(rule, steps, min(runs, claims.RUNS_FOR_A_VERDICT), seed, groups=GROUPS)
        for which, (key, _) in AGENTS.items():
            chosen[which][f"γ = {rule.discount:.4g}"] = made[key]
    results = iter(sweep([each for of_agent in chosen.values() for each in of_agent.values()]))
    return {which: {label: next(results) for label in of_agent} for which, of_agent in chosen.items()}


def judge(results):
    """Judge claim T7 under one reading. results: {which: {label: Result}}, as `live` returns them for it."""
    return claims.judge_persistence({which: (
        each[CHANGES], {label: result for label, result in each.items() if label not in (CHANGES, BROWNIAN)},
        each[BROWNIAN]) for which, each in results.items()})


def in_words(lived, judged):
    """Final reward under each reading, and the share of the gain that learning at every step keeps, in Markdown.

    lived: as `live` returns it. judged: {name: `Claim`}, of the same readings.
    """
    learns_at = {CHANGES: CHANGES, BROWNIAN: f"nothing: {BROWNIAN}"}
    rows = []
    for which in next(iter(lived.values())):
        for of_readings in zip(*(results[which].items() for results in lived.values())):
            rows.append([which, learns_at.get(of_readings[0][0], "every step")])
            for label, result in of_readings:
                rate = result.rate() if label == BROWNIAN else result.rate(*claims.FINAL)
                rows[-1].append(f"{estimate(np.mean, rate)}" + ("" if label in learns_at else f" ({label})"))
    return ("Reward per second in the last fifth of a run; for Brownian motion, over the whole run:\n\n"
            + table(["Agent", "Learns at", *lived], rows) + f"\n\n{share_in_words(judged)}")


def share_in_words(judged):
    """Greatest gain of learning at every step as a multiple of that at changes of cell, in a sentence: {name: `Claim`}.
    """
    return "; ".join(f"{name}, {_share_that_is_kept(claim)}" for name, claim in judged.items()).capitalize() + "."


def _share_that_is_kept(claim):
    if claim.outcome == "not testable":
        return "agents that learn at changes of cell show no gain to compare with"
    return f"learning at every step gains up to {claim.here} times as much as learning at changes of cell"
