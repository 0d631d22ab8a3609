"""The rules that judge the claims of paper C: networks, and alternatives to them.

`neorl.evidence.verdict` defines verdicts.
"""

import numpy as np

from neorl.evidence.statistics import difference, estimate, lead_over_best, probability_of_improvement, ratio
from neorl.evidence.verdict import EARLY, FINAL, fewest_runs, judged, learned


def judge_networks(a, b, c, d, brownian):
    """Claims C1–C4 of paper C, from its figure 4e and the `Result`s of its four agents.

    brownian: the `Result` of Brownian motion on the same board.
    Returns a list of `Claim`s: C1 to C4.
    """
    results = dict(zip("ABCD", (a, b, c, d)))
    runs = fewest_runs(*results.values())
    final = {name: result.rate(*FINAL) for name, result in results.items()}
    knows = {name: learned(result, brownian) for name, result in results.items()}

    rise = estimate(np.mean, final["A"] - a.rate(*EARLY))
    level = estimate(np.mean, final["A"])
    short = estimate(difference, 0.5 * final["C"], final["A"])
    c1 = judged("C1", rise, f"Finally it earns {level}, and network C {estimate(np.mean, final['C'])}. Weak is read "
                "as less than half of C's.", runs,
                reproduced=rise.low > 0 and short.low > 0, partly=rise.low > 0 or short.low > 0,
                possible=rise.high > 0 and short.high > 0, testable=knows["C"])

    lead = estimate(difference, final["B"], final["A"])
    c2 = judged("C2", lead, "A run of B beats one of A with probability "
                f"{probability_of_improvement(final['B'], final['A'])}.", runs, reproduced=lead.low > 0, partly=False,
                possible=lead.high > 0, testable=knows["A"] or knows["B"])

    over = {name: estimate(difference, final["C"], final[name]) for name in "AB"}
    lead = estimate(lead_over_best, final["C"], final["A"], final["B"])
    c3 = judged("C3", lead, f"Over A it is {over['A']}, and over B {over['B']}. A run of C beats one of B with "
                f"probability {probability_of_improvement(final['C'], final['B'])}.", runs, reproduced=lead.low > 0,
                partly=any(each.low > 0 for each in over.values()), possible=lead.high > 0,
                testable=any(knows[name] for name in "ABC"))

    gain = estimate(ratio, final["D"], final["C"])
    c4 = judged("C4", gain, "“Drastically” is read as by half or more. A run of D beats one of C with probability "
                f"{probability_of_improvement(final['D'], final['C'])}.", runs, reproduced=gain.low >= 1.5,
                partly=gain.low > 1, possible=gain.high >= 1.5, testable=knows["C"])
    return [c1, c2, c3, c4]


def judge_alternatives(alternatives, thesis, brownian, real_time):
    """Claim C5, from final rewards per second on one board, (runs,) each, after the same number of steps.

    alternatives: {name: (final rewards, seconds to compute a step)}, of learners that observe no more of the board
        than can be seen on it. thesis: {name: final rewards} of the thesis's agents.
    brownian: final rewards of Brownian motion. real_time: seconds that a step lasts.
    Returns a `Claim`.
    """
    best = max(thesis, key=lambda name: thesis[name].mean())
    over = {name: estimate(ratio, final, thesis[best]) for name, (final, _) in alternatives.items()}
    late = [name for name, (_, seconds) in alternatives.items() if seconds >= real_time]
    fails = {name: name in late or each.high < 1 for name, each in over.items()}
    leader = max([name for name in over if name not in late] or over, key=lambda name: over[name].value)
    succeeds = [name for name, each in over.items() if name not in late and each.low >= 1]
    return judged("C5", over[leader], f"The best alternative is {leader}, and the thesis's best agent is {best}, which "
                  f"earns {estimate(np.mean, thesis[best])}. Alternatives that fail, as they clearly earn less or take "
                  f"longer to compute a step than it lasts: {', '.join(n for n in fails if fails[n]) or 'none'}. "
                  f"Those that clearly earn at least as much, in time: {', '.join(succeeds) or 'none'}. “Partly” is "
                  "read as half of the alternatives failing.",
                  min(map(len, [*(final for final, _ in alternatives.values()), *thesis.values()])),
                  reproduced=all(fails.values()), partly=2 * sum(fails.values()) >= len(fails),
                  possible=not succeeds,
                  testable=estimate(difference, thesis[best], brownian).low > 0)
