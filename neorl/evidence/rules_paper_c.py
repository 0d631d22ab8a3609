"""The rules that judge the claims of paper C: networks, and alternatives to them.

`neorl.evidence.verdict` defines verdicts.
"""

import numpy as np

from neorl.evidence.statements import STATEMENTS
from neorl.evidence.statistics import difference, estimate, lead_over_best, probability_of_improvement, ratio
from neorl.evidence.verdict import EARLY, FINAL, fewest_runs, judged, lead_over_brownian


def judge_networks(a, b, c, d, brownian):
    """Claims C1–C4 of paper C, from its figure 4e and the `Result`s of its four agents.

    brownian: the `Result` of Brownian motion on the same board, which A has to exceed to have improved, and D to have
    done so drastically.
    Returns a list of `Claim`s: C1 to C4.
    """
    results = dict(zip("ABCD", (a, b, c, d)))
    runs = fewest_runs(*results.values())
    final = {name: result.rate(*FINAL) for name, result in results.items()}
    lead_of_a, lead_of_d = (lead_over_brownian(results[name], brownian) for name in "AD")

    rise = estimate(np.mean, final["A"] - a.rate(*EARLY))
    short = estimate(difference, STATEMENTS["C1"].also["A / C"].high * final["C"], final["A"])
    c1 = judged("C1", rise, runs, {"lead over Brownian motion": lead_of_a, "half of C, less A": short},
                {name: estimate(np.mean, final[name]) for name in "AC"},
                partly=rise.low > 0 and lead_of_a.low > 0 or short.low > 0)

    c2 = judged("C2", estimate(difference, final["B"], final["A"]), runs, partly=False, shown={
        "probability that a run beats one of A": probability_of_improvement(final["B"], final["A"])})

    over = {name: estimate(difference, final["C"], final[name]) for name in "AB"}
    c3 = judged("C3", estimate(lead_over_best, final["C"], final["A"], final["B"]), runs, shown={
        "over": over, "probability that a run beats one of B": probability_of_improvement(final["C"], final["B"])},
        partly=any(each.low > 0 for each in over.values()))

    drastic = STATEMENTS["C4"].bounds.low
    lead, beyond = (estimate(difference, final["D"], share * final["C"]) for share in (1.0, drastic))
    c4 = judged("C4", estimate(ratio, final["D"], final["C"]), runs,
                {"D, less the bound times C": beyond, "lead over Brownian motion": lead_of_d},
                {"lead over C": lead,
                 "probability that a run beats one of C": probability_of_improvement(final["D"], final["C"])},
                reproduced=min(beyond.low, lead_of_d.low) > 0, partly=min(lead.low, lead_of_d.low) > 0,
                possible=min(beyond.high, lead_of_d.high) > 0)
    return [c1, c2, c3, c4]


def judge_alternatives(alternatives, thesis, brownian, real_time):
    """Claim C5, from final rewards per second on one board, (runs,) each, after the same number of steps.

    alternatives: {name: (final rewards, seconds to compute a step)}, of learners that observe no more of the board
        than can be seen on it. thesis: {name: final rewards} of the thesis's agents.
    brownian: final rewards of Brownian motion. real_time: seconds that a step lasts.
    Returns a `Claim`.
    """
    best = max(thesis, key=lambda name: thesis[name].mean())
    as_much = STATEMENTS["C5"].bounds.high
    over = {name: estimate(ratio, final, thesis[best]) for name, (final, _) in alternatives.items()}
    late = [name for name, (_, seconds) in alternatives.items() if seconds >= real_time]
    fails = {name: name in late or each.high < as_much for name, each in over.items()}
    leader = max([name for name in over if name not in late] or over, key=lambda name: over[name].value)
    succeeds = [name for name, each in over.items() if name not in late and each.low >= as_much]
    return judged("C5", over[leader], min(map(len, [*(final for final, _ in alternatives.values()), *thesis.values()])),
                  shown={f"final reward per second of the thesis's best, {best}": estimate(np.mean, thesis[best]),
                         "over it": {f"{name} (too slow)" if name in late else name: each
                                     for name, each in over.items()}},
                  reproduced=all(fails.values()),
                  partly=sum(fails.values()) / len(fails) >= STATEMENTS["C5"].also["failing"].low,
                  possible=not succeeds,
                  testable=estimate(difference, thesis[best], brownian).low > 0)
