"""Tables and sentences on the rewards of ensembles in two mazes, in Markdown, for the page of chapter 3.

``made`` is {maze: {chooser: reward per step (runs, parts)}}, from `lib.chapter_3.ensembles.run_ensemble`.
Choosers are ranked by their means over runs, either at the end (the last part) or over the run (all parts).
"""

import numpy as np

from lib.chapter_3.ensembles import LEARNERS, RULES, agreement
from lib.shared.wording import by_interval, number, table
from neorl.evidence.statistics import difference, estimate

ORDINALS = "first", "second", "third", "last"
COUNTS = {"at the end": lambda rewards: rewards[:, -1], "over the run": lambda rewards: rewards.mean(axis=1)}


def lifetime_table(made, chance):
    """The reward of each chooser over the run, and in the last row that of chance: {maze: (runs, parts)}."""
    choosers = list(next(iter(made.values())))
    rows = [(chooser, *(estimate(np.mean, rewards[chooser].mean(axis=1)) for rewards in made.values()))
            for chooser in choosers]
    return table(("Chosen by", *made), [*rows, ("chance", *(number(chance[maze].mean()) for maze in made))])


def order_of_rules(made):
    """Which rules are first and last in each maze, and whether the first is better than each learner alone."""
    return " ".join(_order(maze, rewards) for maze, rewards in made.items())


def places_of_rank_voting(made):
    """The place of rank voting among the rules, by both measures in each maze, and whether it is always the same."""
    places = {f"{when} in the {maze}": _ranked(rewards, RULES, when).index("rank voting") + 1
              for maze, rewards in made.items() for when in COUNTS}
    verdict = ("So the place of rank voting depends on the task and on the measure, as the footnote "
               "suggests." if len(set(places.values())) > 1 else
               "So rank voting has the same place in both mazes and by both measures.")
    text = ", ".join(f"{ORDINALS[place - 1]} {where}" for where, place in places.items())
    return f"Among the four rules rank voting is {text}. {verdict}"


def greediness_table(tempered):
    """The final reward of each rule by its greediness, from `final_by_greediness`."""
    return table(("Rule", "greediness halved", "as in the paper", "doubled"),
                 [(rule, *(estimate(np.mean, final) for final in finals)) for rule, finals in tempered.items()])


def order_by_greediness(tempered):
    """The first and last rules at each greediness, from `final_by_greediness`, and what it means in two of them."""
    ranked = [sorted(tempered, key=lambda rule: tempered[rule][level].mean(), reverse=True) for level in range(3)]
    tops, bottoms = zip(*((rules[0], rules[-1]) for rules in ranked))
    still = (" Still, neither more exploration nor less lifts rank voting from the last place in this maze."
             if set(bottoms) == {"rank voting"} else "")
    return (f"With greediness halved, unchanged and doubled, the first places go to {_listed(tops)}, the last to "
            f"{_listed(bottoms)}. Greediness also means something different in each rule: in the paper's setting, if "
            f"all five learners agree, majority voting follows them with probability "
            f"{agreement('majority voting'):.4f}, rank voting with {agreement('rank voting'):.2f}.{still}")


def readings_of_a_vote(rewards):
    """The difference of two readings of majority voting at the end, and the rules' range: {chooser: (runs, parts)}."""
    votes = estimate(difference, rewards["majority voting"][:, -1], rewards["majority of favourites"][:, -1])
    means = [rewards[rule][:, -1].mean() for rule in RULES]
    spread = max(means) - min(means)
    beside = (f"That exceeds the range between the best and the worst of the four rules, {spread:.2f}. The reading of "
              f"one word of a rule can thus matter more than the choice of the rule."
              if votes.low > spread else f"The range between the best and the worst of the four rules is {spread:.2f}.")
    return f"The first reading less the second, at the end in the small maze, is {votes}. {beside}"


def _order(maze, rewards):
    top, *_, bottom = _ranked(rewards, RULES, "at the end")
    first, *_ = _ranked(rewards, RULES, "over the run")
    alone, *_ = _ranked(rewards, LEARNERS, "at the end")
    ahead = estimate(difference, rewards[top][:, -1], rewards[alone][:, -1])
    than = by_interval(ahead, "better than", "worse than", "indistinguishable from")
    return (f"In the {maze}, {top} ends highest and {bottom} lowest of the four rules; over the whole run {first} is "
            f"first. At the end {top} is {than} the best single learner, {alone} (difference {ahead}).")


def _ranked(rewards, choosers, when):
    return sorted(choosers, key=lambda chooser: COUNTS[when](rewards[chooser]).mean(), reverse=True)


def _listed(names):
    return f"{names[0]} each time" if len(set(names)) == 1 else f"{', '.join(names[:-1])} and {names[-1]}"
