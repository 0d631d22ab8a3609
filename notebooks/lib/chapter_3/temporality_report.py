"""Tables and sentences on the cost of remembering and of not remembering, in Markdown, for the page of chapter 3."""

import numpy as np

from lib.chapter_3.growth import growth_factor
from lib.chapter_3.temporality import RULES
from lib.shared.wording import table
from neorl.evidence.claims import judge_temporality
from neorl.evidence.statistics import difference, estimate


def in_short(needed, paid, memory, states, share):
    """The two curses and the price of a model, in three sentences.

    needed, paid, memory: as in `experience_factors` and `short_memory`. states: of a grid. share: of the entries of its
    full transition table that ever differ from 0, in %.
    """
    short, enough = (estimate(np.mean, paid["sum"][:, length]) for length in (memory - 1, memory))
    return (f"In a world that shows one of Ψ symbols at each step, each further step of the past that matters prolongs "
            f"Q-learning by a factor of {experience_factors(needed)}. No step can be "
            f"spared: agents that remember {memory - 1} of {memory} such steps earn {short} per step, where a guess "
            f"earns 0.50 and agents that remember all earn {enough}. A full transition table grows with the "
            f"square of the number of states, as the thesis says; but in a grid of {states} states only {share:.1f} % "
            "of its entries ever differ from 0.")


def states_met(met):
    """Whether every learner meets every history: met {Ψ: (memories (points,), states (runs, points))}."""
    full = all((states == alphabet**memories).all() for alphabet, (memories, states) in met.items())
    return ("Every learner meets all Ψ to the power of L states, in every world." if full else
            "Not every learner meets all Ψ to the power of L states in time.")


def judge(paid, memory):
    """Judge claim T3, on agents that remember all steps that matter and agents that remember one fewer."""
    above = {rule: rewards - 0.5 for rule, rewards in paid.items()}  # a guess earns 0.5
    return judge_temporality(*({rule: each[:, length] for rule, each in above.items()}
                               for length in (memory, memory - 1)))


def states_table(memories, least):
    """The number of states that each rule of two symbols needs, for every second memory: least {rule: [states, …]}."""
    rows = [(RULES[rule], *states[1::2]) for rule, states in least.items()]
    return table(("Outcome, Ψ = 2", *(f"L\xa0=\xa0{memory}" for memory in memories[1::2])),
                 [*rows, ("*all histories*", *(2**memory for memory in memories[1::2]))])


def experience_factors(needed):
    """The factors by which one more step prolongs learning: {name: (memories (points,), steps (runs, points))}."""
    return "; ".join(f"{growth_factor(*series)} with {name}" for name, series in needed.items())


def short_memory(paid, memory):
    """The reward of agents that remember one step fewer than matter.

    paid: {"sum", "table": reward per step (runs, lengths)}, for remembered lengths from 0 to `memory`.
    """
    short, enough, partial = (estimate(np.mean, paid[rule][:, length]) for rule, length
                              in (("sum", memory - 1), ("sum", memory), ("table", memory - 1)))
    guess = "Memory of all but one step is thus worth no more than a guess. " if short.high < 0.55 else ""
    return (f"With the sum, agents that remember {memory - 1} of the {memory} steps earn {short} per step, and agents "
            f"that remember all earn {enough}. {guess}With the table, {memory - 1} steps earn {partial}: there part "
            f"of the past determines part of the outcome, so the severity of the curse depends on the mechanism.")


def worth_of_last_action(curves, seen_states):
    """The cost and the benefit of remembering the last action, for certain and for sticky actions.

    curves: {"certain", "certain + last", "sticky", "sticky + last": (steps (checkpoints,), share of the best return
    (runs, checkpoints))}. seen_states: {the same: the number met}. The cost is taken when learners that need no
    memory first reach nine tenths on average, or at the end if they never do.
    """
    steps, certain = curves["certain"]
    _, remembering = curves["certain + last"]
    high = certain.mean(axis=0) >= 0.9
    early = high.argmax() if high.any() else -1
    price = estimate(difference, certain[:, early], remembering[:, early])
    gap = {kind: estimate(difference, curves[f"{kind} + last"][1][:, -1], curves[kind][1][:, -1])
           for kind in ("certain", "sticky")}
    behind = (": the agent without memory stays behind." if gap["sticky"].low > 0 else
              ", which is inconclusive with so few learners or steps.")
    return (f"The learners meet {seen_states['sticky']} states without the last action and "
            f"{seen_states['sticky + last']} with it. Where actions are certain, remembering costs {price} of the "
            f"best return after {steps[early]:,} steps, and finally changes the return by {gap['certain']}. Where they "
            f"are sticky, it finally changes the return by {gap['sticky']}{behind}")


def floors_table(shares):
    """The return of learners by the floor of their learning rate, from `shares_by_floor`."""
    return table(("Floor of α", "Without the last action", "With it"),
                 [(floor, *(estimate(np.mean, each) for each in both)) for floor, both in shares.items()])
