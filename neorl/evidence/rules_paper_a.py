"""The rules that judge the claims of paper A: one map, and several.

`neorl.evidence.verdict` defines verdicts.
"""

import numpy as np

from neorl.evidence.statements import STATEMENTS
from neorl.evidence.statistics import (difference, estimate, lead_over_best, lead_over_sum, minutes_sooner,
                                       minutes_to_own_level, probability_of_improvement, quotient, rank_correlation,
                                       ratio, resets)
from neorl.evidence.verdict import EARLY, FINAL, MIDDLE, fewest_runs, judged, learned, share_of_run

LENGTH = 150_000  # of the paper's runs, in steps


def judge_single_layer(by_resolution, brownian):
    """Claims A1–A5 of paper A, from its figure 6.

    by_resolution: {N: `Result`} for N 10, 30, 50, 70, 90. brownian: the `Result` of the control, in which the last
    green creep brings an extra reward.
    Returns a list of `Claim`s: A1 to A5.
    """
    runs = fewest_runs(*by_resolution.values(), brownian)
    rate = {n: result.rate() for n, result in sorted(by_resolution.items())}

    share = LENGTH / brownian.steps
    a1 = judged("A1", estimate(np.mean, brownian.totals * share), runs,
                {"resets": estimate(np.mean, resets(brownian) * share)})

    lead = {n: estimate(difference, values, brownian.rate()) for n, values in rate.items()}
    some_learned = any(each.low > 0 for each in lead.values())
    least = min(lead, key=lambda n: lead[n].low)
    chance = probability_of_improvement(rate[least], brownian.rate())
    a2 = judged("A2", lead[least], runs, {"lead": _of_maps(lead)},
                {"probability that a run beats one of the control": _of_maps({least: chance})})

    others = [values for n, values in rate.items() if n != 50]
    ahead = estimate(lead_over_best, rate[50], *others)
    ends = estimate(lead_over_best, rate[50], rate[10], rate[90])
    a4 = judged("A4", ahead, runs, shown={"over the better of N10 and N90": ends, "reward per second": _of_maps(
        {n: estimate(np.mean, values) for n, values in rate.items()})}, partly=ends.low > 0, testable=some_learned)

    spread = minutes_to_own_level(*by_resolution.values(), share=0.5, of=_least_of_most)
    pair = minutes_to_own_level(by_resolution[70], by_resolution[10], share=0.5, of=quotient)
    took = {n: minutes_to_own_level(by_resolution[n], share=0.5) for n in rate}
    a5 = judged("A5", spread, runs, shown={"N70 to N10": pair, "minutes": _of_maps(took)},
                partly=STATEMENTS["A5"].also["N70 to N10"].hold(pair), testable=some_learned)
    return [a1, a2, _judge_saturation(by_resolution, runs, some_learned), a4, a5]


def _of_maps(found):
    return {f"N{n}": each for n, each in found.items()}


def _least_of_most(*times):
    return quotient(np.min(times, axis=0), np.max(times, axis=0))


def _judge_saturation(by_resolution, runs, some_learned):
    """Claim A3, that coarse maps lead early and fine ones finally, and that the rate of the coarse ones levels off."""
    order = sorted(by_resolution)
    early, middle, final = ({n: by_resolution[n].rate(*share) for n in order} for share in (EARLY, MIDDLE, FINAL))
    first, last = (estimate(rank_correlation, *rates.values()) for rates in (early, final))
    rise = {n: final[n] - middle[n] for n in order}
    coarse, fine = (np.concatenate([rise[n] for n in some]) for some in (order[:2], order[-2:]))
    of_fine, of_own = (STATEMENTS["A3"].also[f"rise to {of}"].high for of in ("that of fine maps", "own level"))
    slower = estimate(difference, of_fine * fine, coarse)
    flat = estimate(np.mean, np.concatenate([of_own * final[n] - rise[n] for n in order[:2]]))
    levelled = slower.low > 0 or flat.low > 0
    rises = {f"N{order[0]} and N{order[1]}": coarse, f"N{order[-2]} and N{order[-1]}": fine}
    return judged("A3", last, runs, {"early": first},
                  {"rise from the middle fifth of the run to the last": {
                      maps: estimate(np.mean, rates) for maps, rates in rises.items()}},
                  reproduced=first.high < 0 < last.low and levelled,
                  partly=first.high < 0 or (last.low > 0 and levelled),
                  possible=first.low < 0 < last.high and (slower.high > 0 or flat.high > 0), testable=some_learned)


def judge_multiple_layers(by_resolution, together, brownian):
    """Claims A6–A8 of paper A, from its figure 7.

    by_resolution: {N: `Result`} for N 3, 7, 23. together: the `Result` of the agent with all three maps, in runs of the
    same length. brownian: that of Brownian motion on the same board.
    Returns a list of `Claim`s: A6 to A8.
    """
    alone = [*by_resolution.values()]
    runs = fewest_runs(*alone, together)
    final = {n: result.rate(*FINAL) for n, result in by_resolution.items()}
    all_final = together.rate(*FINAL)
    best = max(final, key=lambda n: final[n].mean())
    some_learned = any(learned(result, brownian) for result in (*alone, together))

    surplus = estimate(lead_over_sum, all_final, *final.values())
    sooner = minutes_sooner(together, alone, 0.5 * sum(values.mean() for values in final.values()))
    a6 = judged("A6", surplus, runs, {"minutes sooner": sooner}, testable=some_learned)

    gain = estimate(ratio, all_final, final[7])
    sooner = minutes_sooner(together, by_resolution[7], 0.5 * final[7].mean())
    a7 = judged("A7", gain, runs, {"share of a run sooner": share_of_run(sooner, together)},
                {"minutes sooner": sooner}, partly=gain.low > 1, testable=learned(by_resolution[7], brownian))

    level = 0.5 * final[best].mean()
    sooner = {n: minutes_sooner(together, result, level) for n, result in by_resolution.items()}
    quickest = min(sooner, key=lambda n: sooner[n].value)
    quicker = all(each.low > 0 for each in sooner.values())
    lead = estimate(lead_over_best, all_final, *final.values())
    chance = probability_of_improvement(all_final, final[best])
    a8 = judged("A8", sooner[quickest], runs, {"minutes sooner": _of_maps(sooner), "final lead": lead},
                {"probability of improvement": _of_maps({best: chance})}, partly=quicker or lead.low > 0,
                testable=some_learned)
    return [a6, a7, a8]


def judge_margin(by_resolution, together, brownian):
    """Claim A9, from agents with a single map and one with several, on the board of paper A.

    by_resolution: {N: `Result`} of agents with one map. together: the `Result` of the agent with N3, N7 and N23.
    brownian: that of Brownian motion on the same board.
    Returns a `Claim`.
    """
    final = [result.rate(*FINAL) for result in by_resolution.values()]
    gain = estimate(_mean_gain, brownian.rate(), *final)
    share = estimate(_share_of_gain, together.rate(*FINAL), brownian.rate(), *final)
    return judged("A9", share, fewest_runs(*by_resolution.values(), together), {"lead": gain}, partly=gain.low > 0,
                  testable=learned(together, brownian))


def _mean_gain(chance, *single, axis):
    return np.mean([each.mean(axis) for each in single], axis=0) - chance.mean(axis)


def _share_of_gain(together, chance, *single, axis):
    return quotient(_mean_gain(chance, *single, axis=axis), together.mean(axis) - chance.mean(axis))


def judge_exploration(together, alone, brownian):
    """Claim T9, from the number of squares of the board in which each run is in its first tenth, (runs,) each.

    together: of the agent with N3, N7 and N23. alone: a sequence, of those with one of these. brownian: of Brownian
    motion.
    Returns a `Claim`.
    """
    best = max(alone, key=np.mean)
    over_one, over_chance = (estimate(ratio, together, other) for other in (best, brownian))
    return judged("T9", over_one, min(map(len, (together, *alone, brownian))), {"over Brownian motion": over_chance},
                  {"squares": estimate(np.mean, together)})
