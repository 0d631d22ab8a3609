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
    return judged("G1", share, min(map(len, (agent, table, chance))), {"seconds less than at random": gain},
                  partly=STATEMENTS["G1"].also["partly"].hold(share) and gain.low > 0)


def judge_generality(scores):
    """Demonstration G2, from {world: (agent (runs,), chance (runs,))}, of agents with one learning rule and at random.

    Returns a `Claim`.
    """
    better = {world: probability_of_improvement(*pair) for world, pair in scores.items()}
    return judged("G2", min(better.values(), key=lambda each: each.value),
                  min(len(each) for pair in scores.values() for each in pair), {"world": better})


def judge_composition(apart, whole, chance):
    """Demonstration G3, from the steps to a point of a space of two features.

    Steps are multiples of the fewest possible, (runs,).

    apart: of agents with a map for each feature. whole: with one map of both. chance: at random.
    Returns a `Claim`.
    """
    cost, gain = estimate(ratio, apart, whole), estimate(ratio, chance, apart)
    return judged("G3", cost, min(map(len, (apart, whole, chance))), {"random agents": gain},
                  partly=STATEMENTS["G3"].also["partly"].hold(cost) and gain.low > 1)


def judge_extension(joined, alone, chance):
    """Demonstration G4, from `Result`s of runs of the same length.

    joined: agents that gain a second map at half-time. alone: agents that do not. chance: at random.
    Returns a `Claim`.
    """
    gain = estimate(difference, 60 * joined.rate(*FINAL), 60 * alone.rate(*FINAL))
    kept = estimate(ratio, joined.rate(*AFTER_TURN), alone.rate(*AFTER_TURN))
    return judged("G4", gain, fewest_runs(joined, alone, chance), {"kept": kept},
                  testable=estimate(difference, alone.rate(*FINAL), chance.rate(*FINAL)).low > 0)
