"""The rules that judge the claims of papers A, B and C: one map and several, two modalities, networks.

`companion.thesis.verdict` defines verdicts.
"""

import numpy as np

from companion.thesis.statements import STATEMENTS
from neorl.statistics import (HALF_A_MINUTE, Estimate, difference, estimate, exact, lead_over_best, lead_over_sum,
                              least, minutes_sooner, minutes_to_own_level, most, points, probability_of_improvement,
                              quotient, rank_correlation, ratio, resets)
from companion.thesis.verdict import (AFTER_TURN, EARLY, FINAL, MIDDLE, all_of, any_of, fewest_runs, judged,
                                      lead_over_brownian, leads, learned, share_of_run)

LENGTH = 150_000  # of the runs of paper A, in steps
POINTS_PER_RESET = 24 / 7  # expected, whatever the agent does: points and twice the green creeps are a martingale


def judge_single_layer(by_resolution, brownian):
    """Claims A1–A5 and A11 of paper A, from its figure 6.

    by_resolution: {N: `Result`} for N 10, 30, 50, 70, 90. brownian: the `Result` of the control, in which the last
    green creep brings an extra reward.
    Returns a list of `Claim`s.
    """
    runs = fewest_runs(*by_resolution.values(), brownian)
    rate = {n: result.rate() for n, result in sorted(by_resolution.items())}

    share = LENGTH / brownian.steps
    scores = {"Brownian motion": brownian.totals * share,
              **{f"N{n}": by_resolution[n].totals * LENGTH / by_resolution[n].steps for n in rate}}
    scores = {name: estimate(np.mean, each) for name, each in scores.items()}
    a1 = judged("A1", scores["Brownian motion"], runs, {"resets": estimate(np.mean, resets(brownian) * share)})

    lead = {n: estimate(difference, values, brownian.rate()) for n, values in rate.items()}
    some_learned = any_of(map(leads, lead.values()))
    smallest = min(lead, key=lambda n: lead[n].low)
    chance = probability_of_improvement(rate[smallest], brownian.rate())
    a2 = judged("A2", least(lead.values()), runs, {"lead": _of_maps(lead)},
                {"score in 150,000 steps": scores,
                 "probability that a run beats one of the control": _of_maps({smallest: chance})})

    others = [values for n, values in rate.items() if n != 50]
    ends = estimate(lead_over_best, rate[50], rate[10], rate[90])
    a4 = judged("A4", estimate(lead_over_best, rate[50], *others), runs, shown={"reward per second": _of_maps(
        {n: estimate(np.mean, values) for n, values in rate.items()})},
        part={"over the better of N10 and N90": ends}, testable=some_learned)

    spread = minutes_to_own_level(*by_resolution.values(), share=0.5, of=_least_of_most)
    pair = minutes_to_own_level(by_resolution[70], by_resolution[10], share=0.5, of=quotient)
    took = {n: minutes_to_own_level(by_resolution[n], share=0.5) for n in rate}
    a5 = judged("A5", spread, runs, shown={"minutes": _of_maps(took)}, part={"N70 to N10": pair},
                testable=some_learned)

    a11 = judged("A11", estimate(rank_correlation, *rate.values()), runs, testable=some_learned)
    return [a1, a2, _judge_saturation(by_resolution, runs, some_learned), a4, a5, a11]


def _of_maps(found):
    return {f"N{n}": each for n, each in found.items()}


def _least_of_most(*times):
    return quotient(np.min(times, axis=0), np.max(times, axis=0))


def _judge_saturation(by_resolution, runs, some_learned):
    """Claim A3, that coarse maps lead early, and that of the maps whose rate has levelled off the coarser earn less.

    A map has levelled off if its reward per second rises from the middle of the run to the end by a tenth of its final
    level at most. While that is open for some maps, the number covers both cases.
    """
    early, middle, final = ({n: by_resolution[n].rate(*share) for n in sorted(by_resolution)}
                            for share in (EARLY, MIDDLE, FINAL))
    rise = {n: estimate(ratio, final[n] - middle[n], final[n]) for n in final}
    bounds = STATEMENTS["A3"].also["rise"]
    levelled = {n: bounds.decide(each) for n, each in rise.items()}
    sure, possible = ([n for n in final if levelled[n] in kept] for kept in ((True,), (True, None)))
    found = [estimate(rank_correlation, *(final[n] for n in maps)) if len(maps) > 1 else Estimate(0.0, -1.0, 1.0)
             for maps in (sure, possible)]
    last = Estimate(found[1].value, least(found).low, most(found).high)
    if len(possible) < 2:
        last = exact(0.0)  # no two maps have levelled off
    return judged("A3", last, runs, {"early": estimate(rank_correlation, *early.values())},
                  {"rise from the middle fifth of the run to the last, of the final level": _of_maps(rise)},
                  testable=some_learned)


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
    some_learned = any_of([learned(result, brownian) for result in (*alone, together)])

    surplus = estimate(lead_over_sum, all_final, *final.values())
    sooner = minutes_sooner(together, alone, 0.5 * sum(values.mean() for values in final.values()))
    a6 = judged("A6", surplus, runs, {"minutes sooner": sooner}, testable=some_learned)

    gain = estimate(ratio, all_final, final[7])
    sooner = minutes_sooner(together, by_resolution[7], 0.5 * final[7].mean())
    earned = {"3, 7 and 23 together": all_final, "N7": final[7], "Brownian motion": brownian.rate()}
    a7 = judged("A7", gain, runs, {"share of a run sooner": share_of_run(sooner, together)},
                {"final reward per second": {name: estimate(np.mean, rates) for name, rates in earned.items()},
                 "minutes sooner": sooner},
                {"lead over N7": estimate(difference, all_final, final[7])},
                testable=learned(by_resolution[7], brownian))

    level = 0.5 * final[best].mean()
    sooner = {n: minutes_sooner(together, result, level) for n, result in by_resolution.items()}
    lead = estimate(lead_over_best, all_final, *final.values())
    chance = probability_of_improvement(all_final, final[best])
    a8 = judged("A8", least(sooner.values()), runs, {"final lead": lead},
                {"minutes sooner": _of_maps(sooner), "probability of improvement": _of_maps({best: chance})},
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
    return judged("A9", share, fewest_runs(*by_resolution.values(), together), {"lead": gain}, part={"lead": gain},
                  testable=learned(together, brownian))


def _mean_gain(chance, *single, axis):
    return np.mean([each.mean(axis) for each in single], axis=0) - chance.mean(axis)


def _share_of_gain(together, chance, *single, axis):
    return quotient(_mean_gain(chance, *single, axis=axis), together.mean(axis) - chance.mean(axis))


def judge_exploration(together, alone, brownian):
    """Demonstration T9, from the number of squares of the board in which each run is in its first tenth, (runs,) each.

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

    as_quick = minutes_sooner(objects, place, 0.5 * pc.mean(), HALF_A_MINUTE)
    b1 = judged("B1", estimate(ratio, ovc, pc), runs,
                {"whole run": estimate(ratio, objects.rate(), place.rate()), "minutes sooner": as_quick},
                testable=knows_place)
    b3 = judged("B3", estimate(np.mean, joint), runs, {"place cells": estimate(np.mean, pc)})

    half = 0.5 * max(pc.mean(), ovc.mean())
    sooner = {name: minutes_sooner(both, alone, half, HALF_A_MINUTE)
              for name, alone in (("place cells", place), ("object-vector cells", objects))}
    b6 = judged("B6", least(sooner.values()), runs, {"final lead": estimate(lead_over_best, joint, pc, ovc)},
                {"minutes sooner": sooner}, testable=any_of([knows_place, knows_objects]))
    return [b1, b3, b6]


def judge_resolutions(place, objects, brownian):
    """Claim B2 of paper B, from its figure 4.

    place, objects: {N: `Result`} for single resolutions, and {"all": `Result`} for all of them together, of agents of
    place cells and of object-vector cells. brownian: the `Result` of Brownian motion on the same board.
    Returns a `Claim`.
    """
    runs = fewest_runs(*place.values(), *objects.values())
    lead = {}
    for name, results in (("place cells", place), ("object-vector cells", objects)):
        final = [result.rate(*FINAL) for n, result in results.items() if n != "all"]
        lead[name] = estimate(lead_over_best, results["all"].rate(*FINAL), *final)
    return judged("B2", least(lead.values()), runs, {"lead": lead},
                  testable=any_of([learned(result, brownian) for result in (*place.values(), *objects.values())]))


def judge_pace(place, both, brownian):
    """Claim B4 of paper B, from `Result`s of agents with all maps of place cells, and of both modalities.

    brownian: that of Brownian motion on the same board.
    Returns a `Claim`.
    """
    long_enough = both.seconds >= 60 * STATEMENTS["B4"].also["place cells"].number or None
    sooner = {"both, less place cells": minutes_to_own_level(both, place, of=np.subtract)}
    return judged("B4", minutes_to_own_level(both), fewest_runs(place, both),
                  {"place cells": minutes_to_own_level(place), **sooner}, part=sooner,
                  testable=all_of([learned(place, brownian), learned(both, brownian), long_enough]))


def judge_points(result):
    """Claim B5 of paper B, from the `Result` of an agent with an extra reward for the last green creep, not counted.

    The extra reward marks a reset of the board; the agent never sees it, so its runs are those of the paper.
    Returns a `Claim`.
    """
    boards = resets(result)
    return judged("B5", estimate(ratio, points(result), boards), result.runs,
                  shown={"by proof": exact(POINTS_PER_RESET),
                         "resets of a run": estimate(np.mean, boards)}, testable=bool(boards.sum() > 0))


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
                {"rise above Brownian motion": least([rise, lead_of_a]), "weak": short})

    c2 = judged("C2", estimate(difference, final["B"], final["A"]), runs, shown={
        "probability that a run beats one of A": probability_of_improvement(final["B"], final["A"])})

    over = {name: estimate(difference, final["C"], final[name]) for name in "AB"}
    c3 = judged("C3", estimate(lead_over_best, final["C"], final["A"], final["B"]), runs, {"over": over},
                {"probability that a run beats one of B": probability_of_improvement(final["C"], final["B"])})

    lead = estimate(difference, final["D"], final["C"])
    c4 = judged("C4", estimate(_over_other_or_chance, final["D"], final["C"], brownian.rate()), runs,
                {"lead over Brownian motion": lead_of_d},
                {"probability that a run beats one of C": probability_of_improvement(final["D"], final["C"])},
                {"lead over C and Brownian motion": least([lead, lead_of_d])})
    return [c1, c2, c3, c4]


def _over_other_or_chance(rate, other, chance, axis):
    """A rate divided by another, or by that of Brownian motion if this is greater: two failures have no ratio."""
    return quotient(rate.mean(axis), np.maximum(other.mean(axis), chance.mean(axis)))


def judge_untrained(learners, brownian):
    """Claim A10 of paper A, from the scores of the first runs of deep learners and of Brownian motion, (runs,) each.

    learners: {name: scores}. brownian: scores on the same board after the same number of steps.
    Returns a `Claim`.
    """
    over = {name: estimate(ratio, scores, brownian) for name, scores in learners.items()}
    farthest = max(over.values(), key=lambda each: abs(np.log(max(each.value, 1e-9))))
    scores = {name: estimate(np.mean, each) for name, each in {**learners, "Brownian motion": brownian}.items()}
    return judged("A10", farthest, min(map(len, (*learners.values(), brownian))), {"over Brownian motion": over},
                  {"score": scores})


def judge_alternatives(alternatives, thesis, brownian, real_time):
    """Claim C5, from final rewards per second on one board, (runs,) each, after the same number of steps.

    alternatives: {name: (final rewards, seconds to compute a step, what it sees)}, of learners that observe no more of
        the board than can be seen on it. thesis: {name: final rewards} of the thesis's agents.
    brownian: final rewards of Brownian motion. real_time: seconds that a step lasts; who takes longer fails.
    Returns a `Claim`.
    """
    best = max(thesis, key=lambda name: thesis[name].mean())
    over = {name: estimate(ratio, final, thesis[best]) for name, (final, *_) in alternatives.items()}
    in_time = [name for name, (_, seconds, _) in alternatives.items() if seconds < real_time]
    leader = max((over[name] for name in in_time), default=exact(0.0))
    return judged("C5", leader, min(map(len, [*(final for final, *_ in alternatives.values()), *thesis.values()])),
                  shown={f"final reward per second of the thesis's best, {best}": estimate(np.mean, thesis[best]),
                         "over it": {f"{name}, which sees {sees}{'' if name in in_time else ' (too slow)'}": over[name]
                                     for name, (_, _, sees) in alternatives.items()}},
                  testable=leads(estimate(difference, thesis[best], brownian)))
