"""The rules that judge Kaelbling's properties, from agents in worlds of other spaces.

`neorl.evidence.verdict` defines verdicts. Each sample has one number per run.
"""

from neorl.evidence.statistics import difference, estimate, probability_of_improvement, ratio
from neorl.evidence.verdict import AFTER_TURN, FINAL, fewest_runs, judged


def judge_efficiency(agent, table, chance):
    """Claim G1, from the duration of the second trial at a new place, in seconds (runs,).

    agent: of agents. table: of Q-learning on the same cells. chance: of animals that swim at random.
    Returns a `Claim`.
    """
    share, gain = estimate(ratio, agent, table), estimate(difference, chance, agent)
    return judged("G1", share, f"They take {gain} seconds less than at random. “Efficient” is read as half of "
                  "Q-learning's time or less.", min(map(len, (agent, table, chance))),
                  reproduced=share.high <= 0.5 and gain.low > 0,
                  partly=share.high < 1 and gain.low > 0, possible=share.low <= 0.5 and gain.high > 0)


def judge_generality(scores):
    """Claim G2, from {world: (agent (runs,), chance (runs,))}, of agents with one learning rule and at random.

    Returns a `Claim`.
    """
    better = {world: probability_of_improvement(*pair) for world, pair in scores.items()}
    least = min(better, key=lambda world: better[world].value)
    text = "; ".join(f"{world} {each}" for world, each in better.items())
    runs = min(len(each) for pair in scores.values() for each in pair)
    return judged("G2", better[least], f"By world: {text}.", runs,
                  reproduced=all(each.low > 0.5 for each in better.values()),
                  partly=any(each.low > 0.5 for each in better.values()),
                  possible=all(each.high > 0.5 for each in better.values()))


def judge_composition(apart, whole, chance):
    """Claim G3, from the steps to a point of a space of two features, as multiples of the fewest possible (runs,).

    apart: of agents with a map for each feature. whole: with one map of both. chance: at random.
    Returns a `Claim`.
    """
    cost, gain = estimate(ratio, apart, whole), estimate(ratio, chance, apart)
    return judged("G3", cost, f"Random agents take {gain} times as long as those with a map for each. “Compositional” "
                  "is read as at most a quarter more steps, and in part as at most twice as many.",
                  min(map(len, (apart, whole, chance))),
                  reproduced=cost.high <= 1.25 and gain.low > 1, partly=cost.high <= 2 and gain.low > 1,
                  possible=cost.low <= 1.25 and gain.high > 1)


def judge_extension(joined, alone, chance):
    """Claim G4, from `Result`s of runs of the same length.

    joined: agents that gain a second map at half-time. alone: agents that do not. chance: at random.
    Returns a `Claim`.
    """
    gain = estimate(difference, 60 * joined.rate(*FINAL), 60 * alone.rate(*FINAL))
    kept = estimate(ratio, joined.rate(*AFTER_TURN), alone.rate(*AFTER_TURN))
    helps, costs_nothing = gain.low > 0, kept.low >= 0.9
    return judged("G4", gain, f"In the fortieth of the run after the change they earn {kept} times what agents without "
                  "it earn; the rule allows a tenth less.", fewest_runs(joined, alone, chance),
                  reproduced=helps and costs_nothing, partly=helps or costs_nothing,
                  possible=gain.high > 0 and kept.high >= 0.9,
                  testable=estimate(difference, alone.rate(*FINAL), chance.rate(*FINAL)).low > 0)
