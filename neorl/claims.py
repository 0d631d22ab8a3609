"""The claims of the thesis as data, and the rules by which the numbers here decide them.

A verdict is *reproduced*, *partly* or *not reproduced*, by a rule that stands in the code below and is the same for
every reading of the thesis. A claim that compares agents is *not testable* where they have learned nothing to compare,
and with fewer than 10 runs a condition there is no verdict at all. Rewards are per simulated second and means over
runs; early is the first tenth of a run, final the last fifth.
"""

import json
from dataclasses import asdict, dataclass

import numpy as np
from scipy import stats

from neorl.statistics import Estimate, estimate, probability_of_improvement
from neorl.store import folder, source_digest, write_whole

RUNS_FOR_A_VERDICT = 10
EARLY, FINAL = (0.0, 0.1), (0.8, 1.0)


@dataclass(frozen=True)
class Claim:
    """One claim: where it stands, what it says, the thesis's number, ours with its interval, and the verdict."""

    name: str
    place: str
    text: str
    statistic: str
    thesis: str
    here: Estimate
    detail: str
    runs: int
    verdict: str


def judge_single_layer(by_resolution, brownian):
    """Claims A1–A5 of paper A, from its figure 6.

    by_resolution: {N: `Result`} for N 10, 30, 50, 70, 90. brownian: the `Result` of the control.
    """
    runs = min(result.runs for result in [*by_resolution.values(), brownian])
    rate = {n: result.rate() for n, result in by_resolution.items()}
    mean = {n: values.mean() for n, values in rate.items()}
    best = max(mean, key=mean.get)
    place = "paper A, Results, single layer, and figure 6"

    control = estimate(np.mean, brownian.rate())
    a1 = Claim("A1", place, "Brownian motion scores about 0", "Reward per second of the control", "about 0", control,
               f"The best agent, N{best}, makes {mean[best]:.2f}.", runs,
               verdict(runs, control.low <= 0 <= control.high, max(-control.low, control.high) < 0.1 * mean[best]))

    lead = {n: estimate(_difference, values, brownian.rate()) for n, values in rate.items()}
    learned = any(each.low > 0 for each in lead.values())
    least = min(lead, key=lambda n: lead[n].low)
    chance = probability_of_improvement(rate[least], brownian.rate())
    a2 = Claim("A2", place, "Every single resolution beats Brownian motion",
               "Smallest lead over the control in reward per second", "> 0", lead[least],
               f"It is that of N{least}, whose runs beat one of the control with probability {chance:.2f}.",
               runs, verdict(runs, lead[least].low > 0, learned))

    early = estimate(_rank_correlation, *(by_resolution[n].rate(*EARLY) for n in sorted(by_resolution)))
    final = estimate(_rank_correlation, *(by_resolution[n].rate(*FINAL) for n in sorted(by_resolution)))
    a3 = Claim("A3", place, "Coarse maps learn faster at first and saturate lower",
               "Rank correlation of N with the final reward per second", "> 0, and < 0 early", final,
               f"Early it is {early}.", runs,
               verdict(runs, early.high < 0 < final.low, early.high < 0 or final.low > 0, learned))

    others = [values for n, values in rate.items() if n != 50]
    ahead = estimate(_lead_over_best, rate[50], *others)
    a4 = Claim("A4", place, "N50 accumulates most in 150,000 steps",
               "Lead of N50 over the best other in reward per second", "> 0", ahead, f"N{best} accumulates most.",
               runs, verdict(runs, ahead.low > 0, ahead.high > 0, learned))

    ratio = estimate(_ratio, rate[70], rate[10])
    a5 = Claim("A5", place, "N70 learns about as fast as N10, with 49 times the states",
               "Reward accumulated by N70, divided by that of N10", "comparable", ratio,
               "Comparable is read as between a half and two.", runs,
               verdict(runs, 0.5 <= ratio.low and ratio.high <= 2, ratio.high >= 0.5 and ratio.low <= 2, learned))
    return [a1, a2, a3, a4, a5]


def judge_multiple_layers(by_resolution, together):
    """Claims A6 and A7 of paper A, from its figure 7.

    by_resolution: {N: `Result`} for N 3, 7, 23. together: the `Result` of the agent with all three maps.
    """
    runs = min(result.runs for result in [*by_resolution.values(), together])
    final = {n: result.rate(*FINAL) for n, result in by_resolution.items()}
    best = max(final, key=lambda n: final[n].mean())
    learned = {n: estimate(np.mean, values).low > 0 for n, values in final.items()}
    place = "paper A, Results, multiple resolutions, and figure 7"

    surplus = estimate(_lead_over_sum, together.rate(*FINAL), *final.values())
    lead = estimate(_difference, together.rate(*FINAL), final[best])
    chance = probability_of_improvement(together.rate(*FINAL), final[best])
    a6 = Claim("A6", place, "3, 7 and 23 together beat the sum of the three alone",
               "Final reward per second together, less the sum of the three alone", "> 0", surplus,
               f"Over the best alone, N{best}, the lead is {lead}; the probability of improvement {chance:.2f}.", runs,
               verdict(runs, surplus.low > 0, lead.low > 0, learned[best]))

    ratio = estimate(_ratio, together.rate(*FINAL), final[7])
    early = estimate(_difference, together.rate(*EARLY), by_resolution[7].rate(*EARLY))
    a7 = Claim("A7", place, "Together they make 3.5 times as much as N7, and learn at least as fast",
               "Final reward per second together, divided by that of N7", "3.5", ratio,
               f"Early the lead over N7 is {early}.", runs,
               verdict(runs, 1 < ratio.low and ratio.high >= 3.5 and early.high >= 0, ratio.low > 1, learned[7]))
    return [a6, a7]


def verdict(runs, reproduced, partly, testable=True):
    if runs < RUNS_FOR_A_VERDICT:
        return "no verdict"
    if not testable:
        return "not testable"
    return "reproduced" if reproduced else "partly" if partly else "not reproduced"


def table(claims):
    """The claims as a Markdown table."""
    rows = ["| Claim | Thesis, and here with 95 % interval | Verdict |", "|---|---|---|"]
    rows += [f"| **{claim.name}** {claim.text} | {claim.statistic}. Thesis: {claim.thesis}. Here: {claim.here}. "
             f"{claim.detail} | **{claim.verdict}** |" for claim in claims]
    return "\n".join(rows)


def comparison(judged):
    """Verdicts under several readings as a Markdown table: judged {reading: [Claim, …]}."""
    signs = {"reproduced": "●", "partly": "◐", "not reproduced": "○", "not testable": "–", "no verdict": "–"}
    names = sorted({claim.name for claims in judged.values() for claim in claims})
    rows = ["| Reading | " + " | ".join(names) + " |", "|---" * (len(names) + 1) + "|"]
    for reading, claims in judged.items():
        cells = {claim.name: f"{signs[claim.verdict]}\u00a0{claim.here.value:z.2f}" for claim in claims}
        rows.append(f"| {reading} | " + " | ".join(cells.get(name, "") for name in names).replace("-", "−") + " |")
    return "\n".join(rows)


def store(page, claims):
    """Keep the claims of a page as JSON, with the digest of the source that they were computed with.

    A bound that does not exist, as with a single run, is null.
    """
    kept = [{**asdict(claim), "here": [each if np.isfinite(each) else None for each in claim.here]} for claim in claims]
    content = {"page": page, "source": source_digest(), "claims": kept}
    write_whole(folder() / "claims" / f"{page}.json", json.dumps(content, indent=1, allow_nan=False).encode())


def _difference(a, b):
    return a.mean() - b.mean()


def _ratio(a, b):
    return a.mean() / b.mean()


def _lead_over_best(a, *others):
    return a.mean() - max(other.mean() for other in others)


def _lead_over_sum(a, *others):
    return a.mean() - sum(other.mean() for other in others)


def _rank_correlation(*samples):
    group = np.repeat(np.arange(len(samples)), [len(sample) for sample in samples])
    ranks = stats.rankdata([group, np.concatenate(samples)], axis=1)
    return np.corrcoef(ranks)[0, 1]  # Spearman's; scipy's own takes ten times as long, thousands of times over
