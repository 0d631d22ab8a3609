"""Findings of the page of paper A: verdicts, and numbers beside the thesis's.

Results are those of `neorl.chapters.paper_a.experiments.live`: {reading: {key: Result}}.
"""

import numpy as np

from neorl.chapters.shared import side_by_side
from neorl.chapters.shared.side_by_side import each_in_words, verdicts_in_words
from neorl.chapters.shared.wording import number
from neorl.evidence.claims import judge_multiple_layers
from neorl.evidence.priors import BEYOND
from neorl.evidence.reading import LAYERS, SINGLE
from neorl.evidence.statistics import Estimate, estimate, ratio, resets
from neorl.evidence.verdict import FINAL

REWARD, STATES = "reward, all three ÷ N7", "states, all three ÷ N7"
THESIS = {REWARD: 3.5, STATES: 5.9}  # Results, Multiple resolutions; 5.9 are its 290 states by 49


def beside_thesis(results):
    """Our numbers for `THESIS` under each reading: {name: {label: Estimate}}."""
    return {name: {REWARD: _gain(each), STATES: Estimate(_times_the_states(each), np.nan, np.nan)}
            for name, each in results.items()}


def in_words(results, judged):
    """The findings under each reading, as a Markdown list: verdicts, and the numbers behind them.

    judged: the claims of each reading, {name: [Claim, …]}.
    """
    return each_in_words({name: _found(results[name], claims) for name, claims in judged.items()})


def _found(results, claims):
    rate = {n: results["single", n].rate().mean() for n in SINGLE}
    order = ", ".join(f"N{n} ({number(rate[n])})" for n in sorted(rate, key=rate.get, reverse=True))
    control = results["brownian", 8]
    alone = [results["layer", n].rate(*FINAL).mean() for n in LAYERS]
    together = results["layers"].rate(*FINAL).mean()
    return (f"{verdicts_in_words(claims)}. By reward per second over the whole run, the order of single maps is "
            f"{order}; Brownian motion earns {number(control.rate().mean())} and resets the board "
            f"{number(resets(control).mean())} times in {control.steps:,} steps. N3, N7 and N23 together finally earn "
            f"{number(together)} per second, {_gain(results)} times as much as N7 (thesis: {THESIS[REWARD]}); alone "
            f"they earn {', '.join(map(number, alone))}, in total {number(sum(alone))}.")


def _gain(results):
    return estimate(ratio, results["layers"].rate(*FINAL), results["layer", 7].rate(*FINAL))


def _times_the_states(results):
    together, n7 = (sum(nres_map.cells for nres_map in results[key].agent.maps) for key in ("layers", ("layer", 7)))
    return together / n7


def judge_second_experiment(results):
    """Claims A6, A7 and A8 under each reading: {name: [Claim, …]}."""
    return {name: judge_multiple_layers({n: each["layer", n] for n in LAYERS}, each["layers"], each["brownian", 8])
            for name, each in results.items()}


def choices(readings):
    """The choices of readings for agents of place cells, as a Markdown table, and whether they are within the text.

    readings: {name: Reading}.
    """
    table = side_by_side.choices(readings, [field for field, choice in BEYOND.items() if "A" in choice.papers])
    broken = ([pin.choice for pin in reading.within_the_text.broken] for reading in readings.values())
    agreements = (f"breaks: {', '.join(dict.fromkeys(pins))}" if pins else "within the text" for pins in broken)
    return f"{table}\n| *all in all* | | {' | '.join(agreements)} |"
