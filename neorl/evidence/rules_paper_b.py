"""The rules that judge the claims of paper B: two modalities.

`neorl.evidence.verdict` defines verdicts.
"""

import numpy as np

from neorl.evidence.statements import STATEMENTS
from neorl.evidence.statistics import (difference, estimate, lead_over_best, minutes_sooner, minutes_to_own_level,
                                       points, ratio, resets)
from neorl.evidence.verdict import AFTER_TURN, FINAL, fewest_runs, judged, learned


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
    comparable, no_loss = STATEMENTS["B1"].bounds, STATEMENTS["B1"].also["whole run"]
    b1 = judged("B1", level, f"Over the whole run the ratio is {efficiency}. “Comparable” is read as {comparable}, and "
                f"no loss in sample efficiency as {no_loss} over the whole run.", runs,
                reproduced=comparable.hold(level) and no_loss.hold(efficiency),
                partly=comparable.hold(level) or no_loss.hold(efficiency),
                possible=comparable.allow(level) and no_loss.allow(efficiency), testable=knows_place)

    reward, alone = estimate(np.mean, joint), estimate(np.mean, pc)
    near, near_alone = STATEMENTS["B3"].bounds, STATEMENTS["B3"].also["place cells"]
    b3 = judged("B3", reward, f"Place cells earn {alone}. The rule allows {near} for both and {near_alone} for place "
                "cells.", runs, reproduced=near.hold(reward) and near_alone.hold(alone),
                partly=near.hold(reward) or near_alone.hold(alone),
                possible=near.allow(reward) and near_alone.allow(alone))

    lead = estimate(lead_over_best, joint, pc, ovc)
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
    others = {"place cells": place, "object-vector cells": objects}
    took, slow = minutes_to_own_level(both), {name: minutes_to_own_level(each) for name, each in others.items()}
    ahead = {name: minutes_to_own_level(both, each, of=np.subtract) for name, each in others.items()}
    text = "; ".join(f"{name} take {slow[name]} (both, less these: {ahead[name]})" for name in others)
    quick, late, pc = STATEMENTS["B4"].bounds, STATEMENTS["B4"].also["place cells"], slow["place cells"]
    return judged("B4", took, f"{text[0].upper()}{text[1:]}. The rule allows {quick} for both, and {late} for place "
                  "cells.", fewest_runs(place, objects, both),
                  reproduced=quick.hold(took) and late.hold(pc) and all(each.high < 0 for each in ahead.values()),
                  partly=any(each.high < 0 for each in ahead.values()),
                  possible=quick.allow(took) and late.allow(pc) and all(each.low < 0 for each in ahead.values()),
                  testable=(learned(place, brownian) and learned(both, brownian)
                            and both.seconds >= 60 * late.number))


def judge_points(result):
    """Claim B5 of paper B, from the `Result` of an agent with an extra reward for the last green creep, not counted.

    The extra reward marks a reset of the board; the agent never sees it, so its runs are those of the paper.
    Returns a `Claim`.
    """
    boards = resets(result)
    brought, near = estimate(ratio, points(result), boards), STATEMENTS["B5"].bounds
    return judged("B5", brought, f"A run resets its board {estimate(np.mean, boards)} times. The rule allows {near}.",
                  result.runs, reproduced=near.hold(brought), partly=False, possible=near.allow(brought),
                  testable=boards.sum() > 0)


def judge_joining(joined, place, brownian):
    """Demonstration B7, from `Result`s of runs of the same length.

    joined: agents of place cells that gain object-vector cells at half-time. place: agents that keep place cells alone.
    brownian: Brownian motion on the same board.
    Returns a `Claim`.
    """
    gain = estimate(difference, joined.rate(*FINAL), place.rate(*FINAL))
    kept = estimate(ratio, joined.rate(*AFTER_TURN), place.rate(*AFTER_TURN))
    helps, nothing_lost = gain.low > 0, STATEMENTS["B7"].also["kept"]
    return judged("B7", gain, f"In the fortieth of the run after the change they earn {kept} times what agents without "
                  f"it earn; the rule allows {nothing_lost}.", fewest_runs(joined, place),
                  reproduced=helps and nothing_lost.hold(kept), partly=helps or nothing_lost.hold(kept),
                  possible=gain.high > 0 and nothing_lost.allow(kept), testable=learned(place, brownian))
