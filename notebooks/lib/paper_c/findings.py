"""Findings of the page on paper C.

The paper shows an order of four curves and no numbers, so ours are compared with Brownian motion and one another.
Results are those of `lib.paper_c.experiments.live`: {reading: {key: Result}}.
"""

import numpy as np

from lib.paper_c.experiments import NETWORKS, networks
from lib.shared.side_by_side import each_in_words
from lib.shared.wording import number
from neorl.evidence.report import CALIBRATED, LETTER
from neorl.evidence.statements import STATEMENTS
from neorl.evidence.statistics import difference, estimate, ratio
from neorl.evidence.verdict import FINAL

DRASTIC = STATEMENTS["C4"].bounds.low  # times as much as C


def in_short(results):
    """The findings in three sentences, beside the thesis's order."""
    calibrated, letter = results[CALIBRATED], results[LETTER]
    lead = estimate(ratio, calibrated["network", "D"].rate(*FINAL), calibrated["network", "C"].rate(*FINAL))
    orders = _order(calibrated), _order(letter)
    unclear = "; the 95 % interval of a lead marked ≈ includes 0" if any("≈" in each for each in orders) else ""
    return (f"The thesis has A < B < C ≪ D: each network earns more than the one before, and D far more. Here, by "
            f"final reward per second, the order is {orders[0]} in the calibrated reading, and {orders[1]} to the "
            f"letter{unclear}. Calibrated, recursion brings D to {lead} times as much as C, with the 95 % interval "
            f"in brackets; random motion earns {_control(calibrated)}.")


def in_words(results):
    """The findings under each reading, as a Markdown list of numbers."""
    return each_in_words({name: f"By reward per second in the last fifth of a run the order is {_order(each)}, where "
                                f"the thesis has A < B < C ≪ D; Brownian motion earns {_control(each)}."
                          for name, each in results.items()})


def _order(results):
    """Networks with their final reward per second, in ascending order; ≈ where the interval of a lead includes 0."""
    final = {name: result.rate(*FINAL) for name, result in networks(results).items()}
    first, *others = names = sorted(final, key=lambda name: final[name].mean())
    text = f"{first} ({number(final[first].mean())})"
    for below, name in zip(names, others):
        sign = "≈" if estimate(difference, final[name], final[below]).low <= 0 else "<"
        text += f" {sign} {name} ({number(final[name].mean())})"
    return text


def _control(results):
    return number(results["brownian", 3].rate().mean())


def drastic_level(results):
    """The level that D has to exceed under one reading, {name: reward per second}; at least 0."""
    level = DRASTIC * results["network", "C"].rate(*FINAL).mean()
    return {f"thesis: D beyond {DRASTIC} × C": max(level, 0.0)}


def final_rates(by_reading):
    """Final reward and hits of the networks, as a Markdown table. by_reading: {name: results}, as from `live`."""
    rows = ["| Network | Reading | Reward per second | Green per minute | Red per minute |", "|---|---|---|---|---|"]
    for network in NETWORKS:
        for name, results in by_reading.items():
            result = results["network", network]
            green, red = 60 * result.hit_rate(*FINAL).mean(axis=0)
            rows.append(f"| {network} | {name} | {estimate(np.mean, result.rate(*FINAL))} | {green:.1f} | {red:.1f} |")
    return "\n".join(rows)


def finals(recurring):
    """Final reward per second for each weight: {name: [Estimate, …]}. recurring: as `recur` returns it."""
    return {name: [estimate(np.mean, result.rate(*FINAL)) for result in results] for name, results in recurring.items()}


def recursion_in_words(weights, found):
    """The best weight of recursion under each reading, and the reward without. found: as `finals` returns it."""
    lines = []
    for name, estimates in found.items():
        best, weight = max(zip(estimates, weights))
        without = estimates[weights.index(0.0)]
        lines.append(f"Under the reading *{name}* the best weight is r\u00a0=\u00a0{weight:g}, which earns {best}; "
                     f"without recursion it is {without}.")
    return " ".join(lines).replace("=\u00a0-", "=\u00a0−")
