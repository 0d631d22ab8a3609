"""The rules that judge Kaelbling's properties, from agents in worlds of other spaces.

`neorl.evidence.verdict` defines verdicts. Each sample has one number per run.
"""

from neorl.evidence.statements import STATEMENTS
from neorl.evidence.statistics import difference, estimate, probability_of_improvement, ratio
from neorl.evidence.verdict import AFTER_TURN, FINAL, fewest_runs, judged


def judge_efficiency(agent, table, chance):
    """Demonstration G1, from the duration of the second trial at a new place, in seconds (runs,).

    agent: of agents. table: of Q-learning on the same cells. chance: of animals that swim at random.
    Returns a `Claim`.
    """
    share, gain = estimate(ratio, agent, table), estimate(difference, chance, agent)
    few, partly = STATEMENTS["G1"].bounds, STATEMENTS["G1"].also["partly"]
    return judged("G1", share, f"They take {gain} seconds less than at random. “Efficient” is read as {few} of "
                  "Q-learning's time.", min(map(len, (agent, table, chance))),
                  reproduced=few.hold(share) and gain.low > 0, partly=share.high < partly.high and gain.low > 0,
                  possible=few.allow(share) and gain.high > 0)


def judge_generality(scores):
    """Demonstration G2, from {world: (agent (runs,), chance (runs,))}, of agents with one learning rule and at random.

    Returns a `Claim`.
    """
    better = {world: probability_of_improvement(*pair) for world, pair in scores.items()}
    least = min(better, key=lambda world: better[world].value)
    chance = STATEMENTS["G2"].bounds.low
    text = "; ".join(f"{world} {each}" for world, each in better.items())
    runs = min(len(each) for pair in scores.values() for each in pair)
    return judged("G2", better[least], f"By world: {text}.", runs,
                  reproduced=all(each.low > chance for each in better.values()),
                  partly=any(each.low > chance for each in better.values()),
                  possible=all(each.high > chance for each in better.values()))


def judge_composition(apart, whole, chance):
    """Demonstration G3, from the steps to a point of a space of two features.

    Steps are multiples of the fewest possible, (runs,).

    apart: of agents with a map for each feature. whole: with one map of both. chance: at random.
    Returns a `Claim`.
    """
    cost, gain = estimate(ratio, apart, whole), estimate(ratio, chance, apart)
    few, partly = STATEMENTS["G3"].bounds, STATEMENTS["G3"].also["partly"]
    return judged("G3", cost, f"Random agents take {gain} times as long as those with a map for each. “Compositional” "
                  f"is read as {few}, and in part as {partly}.", min(map(len, (apart, whole, chance))),
                  reproduced=few.hold(cost) and gain.low > 1, partly=partly.hold(cost) and gain.low > 1,
                  possible=few.allow(cost) and gain.high > 1)


def judge_extension(joined, alone, chance):
    """Demonstration G4, from `Result`s of runs of the same length.

    joined: agents that gain a second map at half-time. alone: agents that do not. chance: at random.
    Returns a `Claim`.
    """
    gain = estimate(difference, 60 * joined.rate(*FINAL), 60 * alone.rate(*FINAL))
    kept = estimate(ratio, joined.rate(*AFTER_TURN), alone.rate(*AFTER_TURN))
    helps, nothing_lost = gain.low > 0, STATEMENTS["G4"].also["kept"]
    return judged("G4", gain, f"In the fortieth of the run after the change they earn {kept} times what agents without "
                  f"it earn; the rule allows {nothing_lost}.", fewest_runs(joined, alone, chance),
                  reproduced=helps and nothing_lost.hold(kept), partly=helps or nothing_lost.hold(kept),
                  possible=gain.high > 0 and nothing_lost.allow(kept),
                  testable=estimate(difference, alone.rate(*FINAL), chance.rate(*FINAL)).low > 0)
