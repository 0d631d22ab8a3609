"""What the page of paper A computes and reports: its two experiments, under several readings of the text.

1. The first experiment has agents with one map, N10 to N90, the second agents with N3, N7, N23 and with all three.
2. The paper shows single runs of the first and the mean of many of the second. Here, too, the first has fewer: as many
   as a verdict needs.
3. Numbers stand beside the thesis's own, whatever they are.
"""

from dataclasses import replace

import numpy as np

from neorl.agents.papers import brownian
from neorl.evidence.priors import BEYOND, WITHIN
from neorl.evidence.reading import LAYERS, SINGLE, conditions
from neorl.evidence.report import SIGNS
from neorl.evidence.statistics import Estimate, estimate, ratio, resets
from neorl.evidence.verdict import FINAL, RUNS_FOR_A_VERDICT, VERDICTS
from neorl.experiments.sweep import sweep

CONTROL = "control"
REWARD, STATES = "reward, all three ÷ N7", "states, all three ÷ N7"
THESIS = {REWARD: 3.5, STATES: 5.9}  # Results, Multiple resolutions; 5.9 are its 290 states by 49


def live(readings, steps, runs, seed=0, groups=("layers", "single")):
    """The results of both experiments under each reading: {name: {key: Result}}, with the keys of `conditions`.

    readings: {name: Reading}. steps, runs, seed: as in `conditions`, but that the group "single" has 10 runs at most.
    groups: of `conditions`, "layers" and "single". With the latter comes the key `CONTROL`, Brownian motion for as many
    steps and runs.
    """
    made = {}
    for name, reading in readings.items():
        for group in groups:
            some = min(runs, RUNS_FOR_A_VERDICT) if group == "single" else runs
            found = conditions(reading, steps, some, seed, groups=(group,))
            made |= {(name, key): condition for key, condition in found.items()}
            if group == "single":
                made[name, CONTROL] = replace(found["single", SINGLE[0]], agent=brownian())
    results = dict(zip(made, sweep(list(made.values()))))
    return {name: {key: result for (of, key), result in results.items() if of == name} for name in readings}


def beside_thesis(results):
    """Our numbers for `THESIS`, as an `Estimate` each. results: of one reading, as `live` has them."""
    layers, n7 = results["layers"], results["layer", 7]
    states = [sum(each.cells for each in result.agent.maps) for result in (layers, n7)]
    return {REWARD: estimate(ratio, layers.rate(*FINAL), n7.rate(*FINAL)),
            STATES: Estimate(states[0] / states[1], np.nan, np.nan)}


def in_words(results, judged):
    """What was found under one reading, in Markdown: verdicts, and the numbers behind them.

    results: of the reading, as `live` has them. judged: its claims.
    """
    by_verdict = {verdict: ", ".join(claim.name for claim in judged if claim.verdict == verdict)
                  for verdict in VERDICTS}
    verdicts = "; ".join(f"{SIGNS[verdict]} {verdict}: {names}" for verdict, names in by_verdict.items() if names)
    rate = {n: results["single", n].rate().mean() for n in SINGLE}
    order = ", ".join(f"N{n} ({_number(rate[n])})" for n in sorted(rate, key=rate.get, reverse=True))
    control = results["brownian", 8]
    alone = {n: results["layer", n].rate(*FINAL).mean() for n in LAYERS}
    together = results["layers"].rate(*FINAL).mean()
    return (f"{verdicts}. By reward per second in the whole run, the order of single maps is {order}; Brownian motion "
            f"earns {_number(control.rate().mean())} and resets the board {_number(resets(control).mean())} times in "
            f"{control.steps:,} steps. N3, N7 and N23 together finally earn {_number(together)} per second, "
            f"{beside_thesis(results)[REWARD]} times as much as N7 (thesis: {THESIS[REWARD]}); alone they earn "
            f"{', '.join(_number(each) for each in alone.values())}, in all {_number(sum(alone.values()))}.")


def _number(value):
    return f"{value:z.2f}".replace("-", "−")


def choices(readings):
    """What readings choose for agents of place cells, in Markdown, and whether the text pins or leaves open the choice.

    readings: {name: Reading}.
    """
    rows = ["| Choice | The text | " + " | ".join(readings) + " |", "|---" * (len(readings) + 2) + "|"]
    for field, choice in BEYOND.items():
        if "A" in choice.papers:
            chosen = (choice.words(getattr(reading, field)) for reading in readings.values())
            rows.append(f"| {choice.label} | {'open' if field in WITHIN else 'pinned'} | {' | '.join(chosen)} |")
    broken = ([pin.choice for pin in reading.within_the_text.broken] for reading in readings.values())
    agreements = (f"breaks: {', '.join(dict.fromkeys(pins))}" if pins else "within the text" for pins in broken)
    return "\n".join([*rows, f"| *all in all* | | {' | '.join(agreements)} |"])
