"""Findings of the page on paper A, beside the thesis's numbers.

Results are those of `lib.paper_a.experiments.live`: {reading: {key: Result}}.
"""

import numpy as np

from lib.shared import side_by_side
from lib.shared.side_by_side import each_in_words
from lib.shared.wording import by_interval, number
from neorl.evidence import claims
from neorl.evidence.claims import judge_multiple_layers
from neorl.evidence.priors import BEYOND
from neorl.evidence.reading import LAYERS, SINGLE
from neorl.evidence.report import CALIBRATED, LETTER
from neorl.evidence.statements import STATEMENTS
from neorl.evidence.statistics import Estimate, estimate, lead_over_sum, ratio, resets
from neorl.evidence.verdict import FINAL

REWARD, STATES = "reward, all three ÷ N7", "states, all three ÷ N7"
THESIS = {REWARD: STATEMENTS["A7"].bounds.number, STATES: 5.9}  # 5.9 is its 290 states over 49


def beside_thesis(results):
    """Our numbers for `THESIS` under each reading: {name: {label: Estimate}}."""
    return {name: {REWARD: _gain(each), STATES: Estimate(_times_the_states(each), np.nan, np.nan)}
            for name, each in results.items()}


def in_short(results):
    """The findings in a few sentences, beside the thesis's numbers."""
    calibrated, letter = results[CALIBRATED], results[LETTER]
    together, alone = _finals(calibrated)
    surplus = estimate(lead_over_sum, together, *alone)
    beside = by_interval(surplus, "more than", "less than", "not distinguishable from")
    control = calibrated["brownian", 8]
    return (f"In the calibrated reading, N3, N7 and N23 together finally earn {estimate(np.mean, together)} per "
            f"second: {_gain(calibrated)} times as much as N7 alone (thesis: {THESIS[REWARD]}), and {beside} the sum "
            f"of what the three earn alone (difference {surplus}). To the letter the ratio to N7 is {_gain(letter)}. "
            f"Of single maps {_order(calibrated)[0]} earns most (thesis: N50). Random motion clears the board "
            f"{number(resets(control).mean())} times in {control.steps:,} steps (thesis: never). Brackets are 95 % "
            "intervals.")


def in_words(results):
    """The findings under each reading, as a Markdown list of numbers."""
    return each_in_words({name: _found(each) for name, each in results.items()})


def _found(results):
    control = results["brownian", 8]
    together, alone = (np.mean(each, axis=-1) for each in _finals(results))
    return (f"By reward per second over the whole run, the order of single maps is "
            f"{', '.join(_order(results))}; Brownian motion earns {number(control.rate().mean())} and resets the board "
            f"{number(resets(control).mean())} times in {control.steps:,} steps. N3, N7 and N23 together finally earn "
            f"{number(together)} per second, {_gain(results)} times as much as N7 (thesis: {THESIS[REWARD]}); alone "
            f"they earn {', '.join(map(number, alone))}, in total {number(sum(alone))}.")


def _order(results):
    """Single maps with their reward per second over the whole run, best first."""
    rate = {n: results["single", n].rate().mean() for n in SINGLE}
    return [f"N{n} ({number(rate[n])})" for n in sorted(rate, key=rate.get, reverse=True)]


def _finals(results):
    """Final reward per second of all three maps together, (runs,), and of each alone, [(runs,), …]."""
    return results["layers"].rate(*FINAL), [results["layer", n].rate(*FINAL) for n in LAYERS]


def _gain(results):
    return estimate(ratio, results["layers"].rate(*FINAL), results["layer", 7].rate(*FINAL))


def _times_the_states(results):
    together, n7 = (sum(nres_map.cells for nres_map in results[key].agent.maps) for key in ("layers", ("layer", 7)))
    return together / n7


def judge_second_experiment(results):
    """Claims A6, A7 and A8 under each reading: {name: [Claim, …]}."""
    return {name: judge_multiple_layers({n: each["layer", n] for n in LAYERS}, each["layers"], each["brownian", 8])
            for name, each in results.items()}


def judge_exploration(explored):
    """Claim T9 from the squares under one reading, as `experiments.explore` returns them."""
    control, *alone, together = (entered[:, -1].astype(float) for entered in explored.values())
    return claims.judge_exploration(together, alone, control)


def choices(readings):
    """What readings choose for agents of place cells, and whether they are within the text, as a Markdown table.

    readings: {name: Reading}.
    """
    table = side_by_side.choices(readings, [field for field, choice in BEYOND.items() if "A" in choice.papers])
    broken = ([pin.choice for pin in reading.within_the_text.broken] for reading in readings.values())
    agreements = (f"breaks: {', '.join(dict.fromkeys(pins))}" if pins else "within the text" for pins in broken)
    return f"{table}\n| *all in all* | | {' | '.join(agreements)} |"
