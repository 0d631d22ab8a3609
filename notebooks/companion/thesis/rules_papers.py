"""The rules that judge the claims of papers A, B and C: one map and several, two modalities, networks.

`companion.thesis.verdict` defines verdicts.
"""

from itertools import combinations

import numpy as np

from companion.thesis.measures import (EARLY, FINAL, evenness, exact, later, lead_over_sum, learning_minutes, least,
                                       minutes_sooner, minutes_to_own_level, most, rank_correlation, share_over_sum)
from companion.thesis.statements import STATEMENTS
from companion.thesis.verdict import (AFTER_TURN, all_of, any_learned, any_of, fewest_runs, judged, lead_over_brownian,
                                      leads, learned)
from neorl.statistics import (difference, estimate, points, probability_of_improvement, quotient, ratio, resets)

LENGTH = 150_000  # of the runs of paper A, in steps
STANDS = 0.05  # reward per second in the last fifth: a run of paper C that earns less has come to stand, see the page
POINTS_PER_RESET = 24 / 7  # expected, whatever the agent does: points and twice the green creeps are a martingale


def judge_single_layer(by_resolution, brownian, long=None):
    """Claims A1–A5 and A11 of paper A, from its figure 6.

    by_resolution: {N: `Result`} for N 10, 30, 50, 70, 90. brownian: the `Result` of the control, in which the last
    green creep brings an extra reward. long: {N: `Result`} of longer runs of the same agents, which are only shown.
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
    some_learned = any_learned(by_resolution.values(), brownian)
    smallest = min(lead, key=lambda n: lead[n].low)
    chance = probability_of_improvement(rate[smallest], brownian.rate())
    a2 = judged("A2", (least, "lead"), runs, {"lead": _of_maps(lead)},
                shown={"score in 150,000 steps": scores,
                       "probability that a run beats one of the control": _of_maps({smallest: chance})})

    early, final = ({n: by_resolution[n].rate(*when) for n in rate} for when in (EARLY, FINAL))
    finer = {n: estimate(difference, final[n], final[10]) for n in rate if n > 10}
    a3 = judged("A3", estimate(rank_correlation, *final.values()), runs,
                {"rank correlation of N with early reward": estimate(rank_correlation, *early.values())},
                shown={"final reward per second, less that of N10": _of_maps(finer),
                       **{f"reward per second in the last of {round(each.steps / LENGTH)} blocks of 150,000 steps, "
                          f"N{n}": estimate(np.mean, each.rate(max(0, 1 - LENGTH / each.steps)))
                          for n, each in (long or {}).items()}},
                testable=some_learned)

    over = {n: estimate(difference, rate[50], rate[n]) for n in rate if n != 50}
    a4 = judged("A4", (least, "over"), runs, {"over": _of_maps(over)}, shown={"reward per second": _of_maps(
        {n: estimate(np.mean, values) for n, values in rate.items()})}, parts=(), testable=some_learned)

    a11 = judged("A11", estimate(rank_correlation, *rate.values()), runs, testable=some_learned)
    return [a1, a2, a3, a4, _judge_evenness(by_resolution, brownian, lead, runs), a11]


def _of_maps(estimates):
    return {f"N{n}": each for n, each in estimates.items()}


def _judge_evenness(by_resolution, brownian, lead, runs):
    """Claim A5, from the learning times of the maps that finally lead Brownian motion: any two compare."""
    final = {n: leads(lead_over_brownian(by_resolution[n], brownian)) for n in lead}
    learning = [n for n in final if final[n]]
    minutes = {n: learning_minutes(by_resolution[n], chance=brownian.rate()) for n in learning}
    pairs = {f"N{fine} and N{coarse}": evenness(learning_minutes(by_resolution[fine], by_resolution[coarse],
                                                                 chance=brownian.rate(), of=quotient))
             for coarse, fine in combinations(learning, 2)}
    return judged("A5", (least, "of two maps") if pairs else exact(0.0), runs, {"of two maps": pairs},
                  shown={"learning time in minutes": _of_maps(minutes)},
                  parts=[("of two maps, N70 and N10",)] if "N70 and N10" in pairs else (),
                  testable=None if not pairs and any_of(final.values()) is not False else bool(pairs))


def judge_multiple_layers(by_resolution, together, brownian):
    """Claims A6 and A7 of paper A, from its figure 7.

    by_resolution: {N: `Result`} for N 3, 7, 23. together: the `Result` of the agent with all three maps, in runs of the
    same length. brownian: that of Brownian motion on the same board.
    Returns a list of `Claim`s: A6 and A7.
    """
    alone = [*by_resolution.values()]
    runs = fewest_runs(*alone, together)
    final = {n: result.rate(*FINAL) for n, result in by_resolution.items()}
    all_final = together.rate(*FINAL)

    sooner = estimate(lead_over_sum, together.rate(0, FINAL[0]), *(each.rate(0, FINAL[0]) for each in alone))
    a6 = judged("A6", estimate(lead_over_sum, all_final, *final.values()), runs,
                {"surplus before the last fifth": sooner},
                shown={"surplus, as a share of what they earn together": estimate(share_over_sum, all_final,
                                                                                  *final.values())},
                testable=any_learned((*alone, together), brownian))

    sooner = minutes_sooner(together, by_resolution[7], 0.5)
    earned = {"3, 7 and 23 together": all_final, "N7": final[7], "Brownian motion": brownian.rate()}
    a7 = judged("A7", estimate(ratio, all_final, final[7]), runs,
                {"share of a run sooner": sooner / (together.seconds / 60)},
                {"lead over N7": estimate(difference, all_final, final[7])},
                {"final reward per second": {name: estimate(np.mean, rates) for name, rates in earned.items()},
                 "minutes sooner": sooner}, testable=learned(by_resolution[7], brownian))

    return [a6, a7]


def judge_several(by_resolution, single, together, brownian):
    """Claim A8, from paper A's figures 6 and 7.

    by_resolution: {N: `Result`} of the maps that the agent with several has. single: of other single maps on the same
    board, which it has to exceed finally as well. together, brownian: `Result`s of several maps and Brownian motion.
    Returns a `Claim`.
    """
    alone, all_final = [*by_resolution.values()], together.rate(*FINAL)
    sooner = {n: minutes_sooner(together, result, 0.5, *(each for each in alone if each is not result))
              for n, result in by_resolution.items()}
    final = {n: result.rate(*FINAL) for n, result in sorted((by_resolution | single).items())}
    best = max(final, key=lambda n: final[n].mean())
    return judged("A8", (least, "minutes sooner"), fewest_runs(*alone, *single.values(), together),
                  {"minutes sooner": _of_maps(sooner),
                   "final lead": _of_maps({n: estimate(difference, all_final, each) for n, each in final.items()})},
                  shown={"probability of improvement": _of_maps({best: probability_of_improvement(all_final,
                                                                                                  final[best])})},
                  parts=[("minutes sooner",), ("final lead",)],
                  testable=any_learned((*alone, *single.values(), together), brownian))


def judge_margin(by_resolution, brownian):
    """Claim A9, from agents with a single map on the board of paper A.

    by_resolution: {N: `Result`}. brownian: the `Result` of Brownian motion on the same board.
    Returns a `Claim`.
    """
    final = [result.rate(*FINAL) for result in by_resolution.values()]
    lead = estimate(_mean_gain, brownian.rate(), *final)
    return judged("A9", estimate(_gain_in_chances, brownian.rate(), *final), fewest_runs(*by_resolution.values()),
                  {"lead": lead}, parts=[("lead",)])


def _mean_gain(chance, *single, axis):
    return np.mean([each.mean(axis) for each in single], axis=0) - chance.mean(axis)


def _gain_in_chances(chance, *single, axis):
    return quotient(_mean_gain(chance, *single, axis=axis), chance.mean(axis))


def judge_exploration(together, alone, brownian):
    """Demonstration T9, from the number of squares of the board in which each run is in its first tenth, (runs,) each.

    together: of the agent with N3, N7 and N23. alone: {which: of those with one of these}. brownian: of Brownian
    motion.
    Returns a `Claim`.
    """
    over = {name: estimate(ratio, together, each) for name, each in alone.items()}
    return judged("T9", (least, "over one map"), min(map(len, (together, *alone.values(), brownian))),
                  {"over one map": over, "over Brownian motion": estimate(ratio, together, brownian)},
                  shown={"squares": estimate(np.mean, together)}, parts=[("over one map",), ("over Brownian motion",)])


def judge_modalities(place, objects, both, brownian):
    """Claims B1, B3 and B6 of paper B, from its figures 4 and 5.

    place, objects, both: `Result`s of the agents with all resolutions of place cells, of object-vector cells, and of
    both, in runs of the same length. brownian: that of Brownian motion on the same board.
    Returns a list of `Claim`s: B1, B3 and B6.
    """
    runs = fewest_runs(place, objects, both)
    pc, ovc, joint = (result.rate(*FINAL) for result in (place, objects, both))

    b1 = judged("B1", estimate(ratio, objects.rate(), place.rate()), runs,
                shown={"finally": estimate(ratio, ovc, pc)}, testable=learned(place, brownian))
    b3 = judged("B3", estimate(np.mean, joint), runs, {"place cells": estimate(np.mean, pc)})

    alone = {"place cells": place, "object-vector cells": objects}
    sooner = {name: minutes_to_own_level(result, both, of=later) for name, result in alone.items()}
    lead = {name: estimate(difference, joint, result.rate(*FINAL)) for name, result in alone.items()}
    b6 = judged("B6", (least, "minutes sooner"), runs, {"minutes sooner": sooner, "final lead": lead},
                shown={"minutes": {name: minutes_to_own_level(result)
                                   for name, result in {**alone, "both modalities": both}.items()}},
                parts=[("minutes sooner",), ("final lead",)], testable=any_learned((place, objects, both), brownian))
    return [b1, b3, b6]


def judge_resolutions(place, objects, brownian):
    """Claim B2 of paper B, from its figure 4.

    place, objects: {N: `Result`} for single resolutions, and {"all": `Result`} for all of them together, of agents of
    place cells and of object-vector cells. brownian: the `Result` of Brownian motion on the same board.
    Returns a `Claim`.
    """
    runs = fewest_runs(*place.values(), *objects.values())
    lead = {f"lead, {name}": {f"N{n}": estimate(difference, results["all"].rate(*FINAL), result.rate(*FINAL))
                              for n, result in results.items() if n != "all"}
            for name, results in (("place cells", place), ("object-vector cells", objects))}
    return judged("B2", (least, "lead"), runs, lead, parts=[(what,) for what in lead],
                  testable=any_learned((*place.values(), *objects.values()), brownian))


def judge_pace(place, both, brownian):
    """Claim B4 of paper B, from `Result`s of agents with all maps of place cells, and of both modalities.

    brownian: that of Brownian motion on the same board.
    Returns a `Claim`.
    """
    long_enough = both.seconds >= 60 * STATEMENTS["B4"].also["place cells"].number or None
    sooner = {"both, less place cells": minutes_to_own_level(both, place, of=later)}
    return judged("B4", minutes_to_own_level(both), fewest_runs(place, both),
                  {"place cells": minutes_to_own_level(place), **sooner}, parts=[tuple(sooner)],
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


def judge_networks(networks, nodes, brownian):
    """Claims C1–C4 and C6 of paper C, from its figure 4e and from the agents that it lacks.

    networks: {"A" to "D": `Result`}. nodes: {which: `Result`} of C's two nodes, each alone, and both in one layer.
    brownian: the `Result` of Brownian motion on the same board, which A and D have to exceed.
    Returns a list of `Claim`s: C1 to C4 and C6.
    """
    everyone = networks | nodes
    runs = fewest_runs(*everyone.values())
    final = {name: result.rate(*FINAL) for name, result in everyone.items()}
    leads_of = {name: lead_over_brownian(networks[name], brownian) for name in "AD"}

    def testable(*names):
        return any_learned([everyone[name] for name in names], brownian)

    c1 = judged("C1", estimate(np.mean, final["A"] - networks["A"].rate(*EARLY)), runs,
                {"half of C, less A": estimate(difference, 0.5 * final["C"], final["A"]),
                 "lead over Brownian motion": leads_of["A"]},
                shown={name: estimate(np.mean, final[name]) for name in "AC"},
                parts=[(STATEMENTS["C1"].statistic,), ("half of C, less A",)], testable=testable("A", "C"))

    c2 = judged("C2", estimate(difference, final["B"], final["A"]), runs, shown={
        "probability that a run beats one of A": probability_of_improvement(final["B"], final["A"])},
        testable=testable("A", "B"))

    over = {name: estimate(difference, final["C"], final[name]) for name in (*"AB", *nodes)}
    c3 = judged("C3", (least, "over"), runs, {"over": over}, shown={
        "final reward per second": {name: estimate(np.mean, rates) for name, rates in final.items()}},
        parts=[("over, A", "over, B")], testable=testable("C", *over))

    moving = [final[name][final[name] > STANDS] for name in "DC"]
    c4 = judged("C4", estimate(_over_other_or_chance, final["D"], final["C"], brownian.rate()), runs,
                {"lead over Brownian motion": leads_of["D"]},
                {"lead over C": estimate(difference, final["D"], final["C"])},
                {"among runs that do not stand": estimate(ratio, *moving) if all(map(len, moving)) else exact(np.nan),
                 "share of runs that stand": {name: estimate(np.mean, rates <= STANDS)
                                              for name, rates in final.items()}},
                [("lead over C", "lead over Brownian motion")], testable=testable("C", "D"))

    c6 = judged("C6", (least, "over"), runs,
                {"over": {name: estimate(_over_other_or_chance, final["D"], final[name], brownian.rate())
                          for name in nodes}},
                shown={"C over": {name: estimate(_over_other_or_chance, final["C"], final[name], brownian.rate())
                                  for name in nodes}}, parts=(), testable=testable("C", "D", *nodes))
    return [c1, c2, c3, c4, c6]


def _over_other_or_chance(rate, other, chance, axis):
    """A rate divided by another, or by that of Brownian motion if this is greater: two failures have no ratio."""
    return quotient(rate.mean(axis), np.maximum(other.mean(axis), chance.mean(axis)))


def judge_untrained(learners, brownian):
    """Claim A10 of paper A, from the scores of the first runs of deep learners and of Brownian motion, (runs,) each.

    learners: {name: scores}. brownian: scores on the same board after the same number of steps.
    Returns a `Claim`.
    """
    over = {name: estimate(ratio, scores, brownian) for name, scores in learners.items()}
    scores = {name: estimate(np.mean, each) for name, each in {**learners, "Brownian motion": brownian}.items()}
    return judged("A10", (_farthest, "over Brownian motion"), min(map(len, (*learners.values(), brownian))),
                  {"over Brownian motion": over}, shown={"score": scores})


def _farthest(estimates):
    return max(estimates, key=lambda each: abs(np.log(max(each.value, 1e-9))))


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
    seen = {name: f"{name}, which sees {sees}" for name, (_, _, sees) in alternatives.items()}
    return judged("C5", (most, {seen[name]: over[name] for name in in_time}) if in_time else exact(0.0),
                  min(map(len, [*(final for final, *_ in alternatives.values()), *thesis.values()])),
                  shown={f"final reward per second of the thesis's best, {best}": estimate(np.mean, thesis[best]),
                         "over it, but too slow": {seen[name]: over[name] for name in over if name not in in_time}},
                  testable=leads(estimate(difference, thesis[best], brownian)))
