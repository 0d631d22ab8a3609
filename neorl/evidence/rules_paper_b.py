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
