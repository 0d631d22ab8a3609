"""The rules that judge the claims of papers A, B and C: one map and several, two modalities, networks.

`neorl.evidence.verdict` defines verdicts.
"""

import numpy as np

from neorl.evidence.statements import STATEMENTS
from neorl.evidence.statistics import (difference, estimate, lead_over_best, lead_over_sum, minutes_sooner,
                                       minutes_to_own_level, points, probability_of_improvement, quotient,
                                       rank_correlation, ratio, resets)
from neorl.evidence.verdict import (AFTER_TURN, EARLY, FINAL, MIDDLE, fewest_runs, judged, lead_over_brownian, learned,
                                    share_of_run)

LENGTH = 150_000  # of the runs of paper A, in steps


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


def judge_modalities(place, objects, both, brownian):
    """Claims B1, B3 and B6 of paper B, from its figures 4 and 5.

    place, objects, both: `Result`s of the agents with all resolutions of place cells, of object-vector cells, and of
    both, in runs of the same length. brownian: that of Brownian motion on the same board.
    Returns a list of `Claim`s: B1, B3 and B6.
    """
    runs = fewest_runs(place, objects, both)
    pc, ovc, joint = (result.rate(*FINAL) for result in (place, objects, both))
    knows_place, knows_objects = (learned(result, brownian) for result in (place, objects))

    level, efficiency = estimate(ratio, ovc, pc), estimate(ratio, objects.rate(), place.rate())
    b1 = judged("B1", level, runs, {"whole run": efficiency}, testable=knows_place)
    b3 = judged("B3", estimate(np.mean, joint), runs, {"place cells": estimate(np.mean, pc)})

    lead = estimate(lead_over_best, joint, pc, ovc)
    half = 0.5 * max(pc.mean(), ovc.mean())
    sooner = {"place cells": minutes_sooner(both, place, half),
              "object-vector cells": minutes_sooner(both, objects, half)}
    quickest = min(sooner, key=lambda name: sooner[name].value)
    quicker = all(each.low > 0 for each in sooner.values())
    b6 = judged("B6", sooner[quickest], runs, {"minutes sooner": sooner, "final lead": lead},
                partly=quicker or lead.low > 0, testable=knows_place or knows_objects)
    return [b1, b3, b6]


def judge_resolutions(place, objects, brownian):
    """Claim B2 of paper B, from its figure 4.

    place, objects: {N: `Result`} for single resolutions, and {"all": `Result`} for all of them together, of agents of
    place cells and of object-vector cells. brownian: the `Result` of Brownian motion on the same board.
    Returns a `Claim`.
    """
    runs = fewest_runs(*place.values(), *objects.values())
    leads = {}
    for name, results in (("place cells", place), ("object-vector cells", objects)):
        final = [result.rate(*FINAL) for n, result in results.items() if n != "all"]
        leads[name] = estimate(lead_over_best, results["all"].rate(*FINAL), *final)
    return judged("B2", min(leads.values(), key=lambda lead: lead.value), runs, {"lead": leads},
                  testable=any(learned(result, brownian) for result in (*place.values(), *objects.values())))


def judge_pace(place, objects, both, brownian):
    """Claim B4 of paper B, from `Result`s of agents with all maps of place cells, of object-vector cells, and of both.

    brownian: that of Brownian motion on the same board.
    Returns a `Claim`.
    """
    others = {"place cells": place, "object-vector cells": objects}
    ahead = {name: minutes_to_own_level(both, each, of=np.subtract) for name, each in others.items()}
    return judged("B4", minutes_to_own_level(both), fewest_runs(place, objects, both),
                  {"place cells": minutes_to_own_level(place), "both, less": ahead},
                  {"object-vector cells": minutes_to_own_level(objects)},
                  partly=any(each.high < 0 for each in ahead.values()),
                  testable=(learned(place, brownian) and learned(both, brownian)
                            and both.seconds >= 60 * STATEMENTS["B4"].also["place cells"].number))


def judge_points(result):
    """Claim B5 of paper B, from the `Result` of an agent with an extra reward for the last green creep, not counted.

    The extra reward marks a reset of the board; the agent never sees it, so its runs are those of the paper.
    Returns a `Claim`.
    """
    boards = resets(result)
    return judged("B5", estimate(ratio, points(result), boards), result.runs,
                  shown={"resets of a run": estimate(np.mean, boards)}, partly=False, testable=boards.sum() > 0)


def judge_joining(joined, place, brownian):
    """Demonstration B7, from `Result`s of runs of the same length.

    joined: agents of place cells that gain object-vector cells at half-time. place: agents that keep place cells alone.
    brownian: Brownian motion on the same board.
    Returns a `Claim`.
    """
    gain = estimate(difference, joined.rate(*FINAL), place.rate(*FINAL))
    kept = estimate(ratio, joined.rate(*AFTER_TURN), place.rate(*AFTER_TURN))
    return judged("B7", gain, fewest_runs(joined, place), {"kept": kept}, testable=learned(place, brownian))


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
