"""The rules that judge the claims of paper B: two modalities.

`neorl.evidence.verdict` defines verdicts.
"""

import numpy as np

from neorl.evidence.statistics import (difference, estimate, lead_over_best, minutes_sooner, points,
                                       probability_of_improvement, ratio, resets, time_to_final_level)
from neorl.evidence.verdict import AFTER_TURN, FINAL, fewest_runs, judged, learned

COMPARABLE = (0.8, 1.25)
BOTH, PLACE = (0.44, 0.69), (0.23, 0.36)  # reward per second: the paper's 0.55 and 0.29 within a factor of 1.25
PER_BOARD = (1.35, 1.65)  # the paper's 1.5 points, a tenth more or less


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
    comparable, no_loss = _within(level, COMPARABLE), efficiency.low >= COMPARABLE[0]
    b1 = judged("B1", level, f"Over the whole run the ratio is {efficiency}. “Comparable” is read as from 0.8 to "
                "1.25, and no loss in sample efficiency as 0.8 or more over the whole run.", runs,
                reproduced=comparable and no_loss, partly=comparable or no_loss,
                possible=_touches(level, COMPARABLE) and efficiency.high >= COMPARABLE[0], testable=knows_place)

    reward, alone = estimate(np.mean, joint), estimate(np.mean, pc)
    lead = estimate(lead_over_best, joint, pc, ovc)
    chance = probability_of_improvement(joint, pc)
    b3 = judged("B3", reward, f"Place cells earn {alone}, object-vector cells {estimate(np.mean, ovc)}; the lead over "
                f"the better one is {lead}. A run of both beats one of place cells with probability {chance}. The rule "
                "allows a factor of 1.25.", runs,
                reproduced=_within(reward, BOTH) and _within(alone, PLACE) and lead.low > 0, partly=lead.low > 0,
                possible=_touches(reward, BOTH) and _touches(alone, PLACE) and lead.high > 0, testable=knows_place)

    half = 0.5 * max(pc.mean(), ovc.mean())
    sooner = {"place cells": minutes_sooner(both, place, half),
              "object-vector cells": minutes_sooner(both, objects, half)}
    quickest = min(sooner, key=lambda name: sooner[name].value)
    quicker = all(each.low > 0 for each in sooner.values())
    b6 = judged("B6", sooner[quickest], f"It is that over {quickest}, at half the final level of the better one. The "
                f"final lead is {lead}.", runs, reproduced=quicker and lead.low > 0, partly=quicker or lead.low > 0,
                possible=all(each.high > 0 for each in sooner.values()) and lead.high > 0,
                testable=knows_place or knows_objects)
    return [b1, b3, b6]


def judge_resolutions(place, objects, brownian):
    """Claim B2 of paper B, from its figure 4.

    place, objects: {N: `Result`} for single resolutions, and {"all": `Result`} for all of them together, of agents of
    place cells and of object-vector cells. brownian: the `Result` of Brownian motion on the same board.
    Returns a `Claim`.
    """
    runs = fewest_runs(*place.values(), *objects.values())
    leads, best = {}, {}
    for name, results in (("place cells", place), ("object-vector cells", objects)):
        final = {n: result.rate(*FINAL) for n, result in results.items() if n != "all"}
        best[name] = max(final, key=lambda n: final[n].mean())
        leads[name] = estimate(lead_over_best, results["all"].rate(*FINAL), *final.values())
    least = min(leads, key=lambda name: leads[name].value)
    found = "; ".join(f"{lead} with {name}, over N{best[name]}" for name, lead in leads.items())
    return judged("B2", leads[least], f"It is {found}.", runs, reproduced=all(lead.low > 0 for lead in leads.values()),
                  partly=any(lead.low > 0 for lead in leads.values()),
                  possible=all(lead.high > 0 for lead in leads.values()),
                  testable=any(learned(result, brownian) for result in (*place.values(), *objects.values())))


def judge_pace(place, objects, both, brownian):
    """Claim B4 of paper B, from `Result`s of agents with all maps of place cells, of object-vector cells, and of both.

    brownian: that of Brownian motion on the same board.
    Returns a `Claim`.
    """
    minutes = {name: time_to_final_level(result) / 60
               for name, result in (("place cells", place), ("object-vector cells", objects))}
    quick = time_to_final_level(both) / 60
    ahead = {name: estimate(difference, quick, slow) for name, slow in minutes.items()}
    took, slow = estimate(np.mean, quick), {name: estimate(np.mean, each) for name, each in minutes.items()}
    text = "; ".join(f"{name} take {slow[name]} (both, less these: {ahead[name]})" for name in minutes)
    pc = slow["place cells"]
    return judged("B4", took, f"{text[0].upper()}{text[1:]}. The rule allows twice the thesis's time for both, and "
                  "half of it for place cells.", fewest_runs(place, objects, both),
                  reproduced=took.high <= 30 and pc.low >= 80 and all(each.high < 0 for each in ahead.values()),
                  partly=any(each.high < 0 for each in ahead.values()),
                  possible=took.low <= 30 and pc.high >= 80 and all(each.low < 0 for each in ahead.values()),
                  testable=learned(place, brownian) and learned(both, brownian) and both.seconds >= 60 * 160)


def judge_points(result):
    """Claim B5 of paper B, from the `Result` of an agent with an extra reward for the last green creep, not counted.

    The extra reward marks a reset of the board; the agent never sees it, so its runs are those of the paper.
    Returns a `Claim`.
    """
    boards = resets(result)
    brought = estimate(ratio, points(result), boards)
    return judged("B5", brought, f"A run resets its board {estimate(np.mean, boards)} times. The rule allows a tenth "
                  "more or less.", result.runs, reproduced=_within(brought, PER_BOARD), partly=False,
                  possible=_touches(brought, PER_BOARD), testable=boards.sum() > 0)


def judge_joining(joined, place, brownian):
    """Claim B7 of paper B, from `Result`s of runs of the same length.

    joined: agents of place cells that gain object-vector cells at half-time. place: agents that keep place cells alone.
    brownian: Brownian motion on the same board.
    Returns a `Claim`.
    """
    gain = estimate(difference, joined.rate(*FINAL), place.rate(*FINAL))
    kept = estimate(ratio, joined.rate(*AFTER_TURN), place.rate(*AFTER_TURN))
    helps, costs_nothing = gain.low > 0, kept.low >= 0.9
    return judged("B7", gain, f"In the fortieth of the run after the change they earn {kept} times what agents without "
                  "it earn; the rule allows a tenth less.", fewest_runs(joined, place),
                  reproduced=helps and costs_nothing, partly=helps or costs_nothing,
                  possible=gain.high > 0 and kept.high >= 0.9, testable=learned(place, brownian))


def _within(found, borders):
    return borders[0] <= found.low and found.high <= borders[1]


def _touches(found, borders):
    return borders[0] <= found.high and found.low <= borders[1]
