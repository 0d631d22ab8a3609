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

from neorl.statistics import Estimate, estimate, probability_of_improvement, time_to_final_level
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


def judge_modalities(place, objects, both):
    """Claims B1–B4 of paper B, from its figures 4 and 5.

    place, objects: {N: `Result`} for single resolutions, and {"all": `Result`} for all of them together, of agents of
    place cells and of object-vector cells. both: the `Result` of the agent with all maps of both.
    """
    runs = min(result.runs for result in [*place.values(), *objects.values(), both])
    pc, ovc, joint = (result.rate(*FINAL) for result in (place["all"], objects["all"], both))
    learned = min(estimate(np.mean, values).low for values in (pc, ovc, joint)) > 0
    figure_4, figure_5 = "paper B, section 3.1 and figure 4", "paper B, section 3.2 and figure 5"

    ratio = estimate(_ratio, ovc, pc)
    early = estimate(_difference, objects["all"].rate(*EARLY), place["all"].rate(*EARLY))
    b1 = Claim("B1", figure_4, "Object-vector agents match place-cell agents",
               "Final reward per second of object-vector cells, divided by that of place cells", "comparable", ratio,
               f"Comparable is read as between a half and two, with no loss early, where the lead is {early}.", runs,
               verdict(runs, 0.5 <= ratio.low and ratio.high <= 2 and early.high >= 0,
                       ratio.high >= 0.5 and ratio.low <= 2, learned))

    leads, best = {}, {}
    for name, results in (("place cells", place), ("object-vector cells", objects)):
        final = {n: result.rate(*FINAL) for n, result in results.items() if n != "all"}
        best[name] = max(final, key=lambda n: final[n].mean())
        leads[name] = estimate(_lead_over_best, results["all"].rate(*FINAL), *final.values())
    least = min(leads, key=lambda name: leads[name].value)
    b2 = Claim("B2", figure_4, "Several resolutions beat each one, in both modalities",
               "Lead of all maps over the best single one in final reward per second, in the modality where it is less",
               "> 0", leads[least], "It is " + "; ".join(f"{lead} with {name}, over N{best[name]}"
                                                         for name, lead in leads.items()) + ".", runs,
               verdict(runs, all(lead.low > 0 for lead in leads.values()),
                       any(lead.low > 0 for lead in leads.values()), learned))

    gain = estimate(_ratio, joint, pc)
    lead = estimate(_lead_over_best, joint, pc, ovc)
    b3 = Claim("B3", figure_5, "Both modalities make 0.55 a second, place cells alone 0.29",
               "Final reward per second of both, divided by that of place cells", "1.9", gain,
               f"Both make {joint.mean():.2f}, place cells {pc.mean():.2f}, object-vector cells {ovc.mean():.2f}. The "
               f"lead over the better one is {lead}; a run of both beats one of place cells with probability "
               f"{probability_of_improvement(joint, pc):.2f}.", runs,
               verdict(runs, gain.high >= 0.55 / 0.29 and lead.low > 0, gain.low > 1, learned))

    minutes = {name: time_to_final_level(result) / 60 for name, result in (("both", both), ("place", place["all"]))}
    quick, slow = (estimate(np.mean, values) for values in minutes.values())
    ahead = estimate(_difference, minutes["both"], minutes["place"])
    b4 = Claim("B4", figure_5, "Both make their final level after 15 minutes, place cells after more than 160",
               "Simulated minutes that both take", "15", quick,
               f"Place cells take {slow}; the difference is {ahead}. The rule allows twice the thesis's time for both, "
               "and half of it for place cells.", runs,
               verdict(runs, quick.high <= 30 and slow.low >= 80, ahead.high < 0, learned and both.seconds >= 60 * 160))
    return [b1, b2, b3, b4]


def judge_networks(a, b, c, d):
    """Claims C1–C4 of paper C, from its figure 4e and the `Result`s of its four agents."""
    runs = min(result.runs for result in (a, b, c, d))
    final = {name: result.rate(*FINAL) for name, result in zip("ABCD", (a, b, c, d))}
    learned = {name: estimate(np.mean, values).low > 0 for name, values in final.items()}
    place = "paper C, section 3 and figure 4e"

    rise = estimate(np.mean, final["A"] - a.rate(*EARLY))
    level = estimate(np.mean, final["A"])
    c1 = Claim("C1", place, "Network A improves over time but stays weak",
               "Final reward per second of A, less its early one", "> 0", rise,
               f"Finally it makes {level}. Weak is read as less than half of what network C makes, "
               f"{final['C'].mean():.2f}.", runs,
               verdict(runs, rise.low > 0 and level.high < 0.5 * final["C"].mean(),
                       rise.low > 0 or level.high < 0.5 * final["C"].mean(), learned["C"]))
    leads = []
    for name, better, worse, text in (("C2", "B", "A", "A desire for each colour (B) beats one for all (A)"),
                                      ("C3", "C", "B", "Values from both nodes (C) beat those of the last one (B)")):
        lead = estimate(_difference, final[better], final[worse])
        chance = probability_of_improvement(final[better], final[worse])
        leads.append(Claim(name, place, text, f"Lead of {better} over {worse} in final reward per second", "> 0", lead,
                           f"A run of {better} beats one of {worse} with probability {chance:.2f}.", runs,
                           verdict(runs, lead.low > 0, lead.high > 0, learned[better])))
    gain = estimate(_ratio, final["D"], final["C"])
    c4 = Claim("C4", place, "Recursion (D) improves on C drastically",
               "Final reward per second of D, divided by that of C", "≫ 1", gain,
               "Drastically is read as by half or more. A run of D beats one of C with probability "
               f"{probability_of_improvement(final['D'], final['C']):.2f}.", runs,
               verdict(runs, gain.low >= 1.5, gain.low > 1, learned["C"]))
    return [c1, *leads, c4]


def judge_revaluing(revalued, throughout):
    """Claim T1, from `Result`s of agents that want red creeps too, from half-time on and from the start."""
    runs = min(revalued.runs, throughout.runs)
    turned, always = (_red_a_minute(result, 0.5, 0.525) for result in (revalued, throughout))
    before, after = (estimate(np.mean, _red_a_minute(revalued, *share)) for share in ((0.475, 0.5), (0.5, 0.525)))
    lead = estimate(_difference, turned, always)
    return Claim("T1", "thesis, section 4.1.2", "Moving or revaluing elements needs no retraining",
                 "Red creeps a minute in the fortieth of the run after they come to be wanted, less what agents take "
                 "that have wanted them from the start", "≥ 0", lead,
                 f"Before the turn it is {before}, after it {after}.", runs,
                 verdict(runs, lead.low >= 0 and after.low > before.high, after.low > before.high))


def judge_cost(together, alone, none):
    """Claim T2: what an agent's maps cost together and each alone; each (repetitions,), in the same unit a step.

    together: with all maps. alone: a sequence, with each map alone. none: without any.
    """
    ratio = estimate(_cost_ratio, together, none, *alone)
    return Claim("T2", "thesis, section 4.4", "Cost grows linearly with maps",
                 "What all maps cost together, divided by the sum of what each costs alone", "1", ratio,
                 "The rule allows a tenth more.", len(together),
                 verdict(len(together), ratio.high <= 1.1, ratio.low <= 1.1))


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


def summary(judged):
    """Where each claim is reproduced, and which readings come closest, in Markdown: judged {reading: [Claim, …]}."""
    by_reading = {reading: {claim.name: claim.verdict for claim in claims} for reading, claims in judged.items()}
    texts = {claim.name: claim.text for claims in judged.values() for claim in claims}
    if any("no verdict" in verdicts.values() for verdicts in by_reading.values()):
        return "With so few runs there is nothing to sum up."
    lines = ["Each claim, and where it is reproduced:", ""]
    for name, text in texts.items():
        where = [reading for reading, verdicts in by_reading.items() if verdicts.get(name) == "reproduced"]
        lines.append(f"- **{name}** {text}: *{'; '.join(where) or 'none of these readings'}*.")
    score = {reading: tuple([*verdicts.values()].count(kind) for kind in ("reproduced", "partly"))
             for reading, verdicts in by_reading.items()}
    closest = [reading for reading in score if score[reading] == max(score.values())]
    return "\n".join([*lines, "", "Closest to the paper comes *{}*: {} of its claims are reproduced and {} partly. In "
                      "the default reading they are {} and {}.".format("*, *".join(closest), *max(score.values()),
                                                                   *score["default"])])


def store(page, claims):
    """Keep the claims of a page as JSON, with the digest of the source that they were computed with.

    A bound that does not exist, as with a single run, is null.
    """
    kept = [{**asdict(claim), "here": [each if np.isfinite(each) else None for each in claim.here]} for claim in claims]
    content = {"page": page, "source": source_digest(), "claims": kept}
    write_whole(folder() / "claims" / f"{page}.json", json.dumps(content, indent=1, allow_nan=False).encode())


def _red_a_minute(result, begin, end):
    return 60 * result.hit_rate(begin, end)[:, 1]


def _difference(a, b):
    return a.mean() - b.mean()


def _ratio(a, b):
    return a.mean() / b.mean()


def _cost_ratio(together, none, *alone):
    base = np.median(none)
    return (np.median(together) - base) / sum(np.median(each) - base for each in alone)


def _lead_over_best(a, *others):
    return a.mean() - max(other.mean() for other in others)


def _lead_over_sum(a, *others):
    return a.mean() - sum(other.mean() for other in others)


def _rank_correlation(*samples):
    group = np.repeat(np.arange(len(samples)), [len(sample) for sample in samples])
    ranks = stats.rankdata([group, np.concatenate(samples)], axis=1)
    return np.corrcoef(ranks)[0, 1]  # Spearman's; scipy's own takes ten times as long, thousands of times over
