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
    weak = STATEMENTS["C1"].also["A / C"].high
    short = estimate(difference, weak * final["C"], final["A"])
    improves = rise.low > 0 and lead_of_a.low > 0
    c1 = judged("C1", rise, f"Finally it earns {estimate(np.mean, final['A'])}, {lead_of_a} more than Brownian motion, "
                f"which it has to exceed, and network C {estimate(np.mean, final['C'])}. Weak is read as less than "
                f"{weak:g} of C's.", runs,
                reproduced=improves and short.low > 0, partly=improves or short.low > 0,
                possible=rise.high > 0 and lead_of_a.high > 0 and short.high > 0)

    lead = estimate(difference, final["B"], final["A"])
    c2 = judged("C2", lead, "A run of B beats one of A with probability "
                f"{probability_of_improvement(final['B'], final['A'])}.", runs, reproduced=lead.low > 0, partly=False,
                possible=lead.high > 0)

    over = {name: estimate(difference, final["C"], final[name]) for name in "AB"}
    lead = estimate(lead_over_best, final["C"], final["A"], final["B"])
    c3 = judged("C3", lead, f"Over A it is {over['A']}, and over B {over['B']}. A run of C beats one of B with "
                f"probability {probability_of_improvement(final['C'], final['B'])}.", runs, reproduced=lead.low > 0,
                partly=any(each.low > 0 for each in over.values()), possible=lead.high > 0)

    drastic = STATEMENTS["C4"].bounds.low
    lead, beyond = (estimate(difference, final["D"], share * final["C"]) for share in (1.0, drastic))
    c4 = judged("C4", estimate(ratio, final["D"], final["C"]), f"D leads C by {lead}, and Brownian motion, which it "
                f"has to exceed, by {lead_of_d}. “Drastically” is read as {drastic:g} times as much. A run of D "
                f"beats one of C with probability {probability_of_improvement(final['D'], final['C'])}.", runs,
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
    return judged("C5", over[leader], f"The best alternative is {leader}, and the thesis's best agent is {best}, which "
                  f"earns {estimate(np.mean, thesis[best])}. Alternatives that fail, as they clearly earn less or take "
                  f"longer to compute a step than it lasts: {', '.join(n for n in fails if fails[n]) or 'none'}. "
                  f"Those that clearly earn at least as much, in time: {', '.join(succeeds) or 'none'}. “Partly” is "
                  "read as half of the alternatives failing.",
                  min(map(len, [*(final for final, _ in alternatives.values()), *thesis.values()])),
                  reproduced=all(fails.values()),
                  partly=sum(fails.values()) / len(fails) >= STATEMENTS["C5"].also["failing"].low,
                  possible=not succeeds,
                  testable=estimate(difference, thesis[best], brownian).low > 0)
