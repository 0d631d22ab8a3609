"""Sentences of chapter 4 on the learning rules in the chamber with two levers, in Markdown.

Values are as `lib.chapter_4.credit.learn_by_each` returns them: {rule: (runs, visits, 4, 2)}.
"""

import numpy as np

from lib.chapter_4.credit import INVERSION, Chamber, by_role, lead_of_cause
from lib.shared.wording import table
from neorl.evidence.statistics import estimate, probability_of_improvement

SHOWN = [0, 9, 99]  # after 1, 10 and 100 visits
PSI = {"share": "its share of the steps of the stay", "happened": "1, however often it occurred",
       "count": "the number of steps on which it occurred", "last": "1 if it was the last, else 0"}


def rule_in_words(learning):
    """What distinguishes the rule of the book's agents, a `Learning` whose credit is in `PSI`, from the plainest."""
    absent = ("values of absent events stay as they are" if not learning.absent_decay else
              f"values of absent events move {'away from' if learning.absent_form == 'away' else 'towards'} "
              f"{'the target' if learning.absent_form == 'away' else 'zero'}, by ψ(0) = −{learning.absent_decay:.2g}")
    goals = "all goals learn" if learning.bootstrap else "only the goal that has been entered learns"
    cells = ("and those left before, which a memory holds" if learning.memory else "alone")
    return (f"By default the agents of this book credit an event that occurred with {PSI[learning.credit]}; {absent}. "
            f"At a change of cell {goals}, from the cell just left {cells}.")


def leads(values):
    """Lead of the cause under each rule, and that of the second rule less that of the third, after 1, 10, 100 visits.

    The first rule is the book's, the second plain inference inversion and the third temporal difference.
    """
    lead = {name: lead_of_cause(each)[:, SHOWN] for name, each in values.items()}
    right = {name: np.mean(each > 0, axis=0) for name, each in lead.items()}
    rows = [[name, estimate(np.mean, each[:, 1]), estimate(np.mean, each[:, 2]),
             ", ".join(f"{100 * share:.0f}" for share in right[name]) + " %"] for name, each in lead.items()]
    own, inversion, difference, *_ = lead.values()
    ahead = [estimate(np.mean, each) for each in (inversion - difference).T]
    after = [_finely(each) for each in ahead]
    chance = probability_of_improvement(inversion[:, 2], difference[:, 2])
    said = [f"The lead of plain inversion, less that of temporal difference on the same streams, is {after[0]} "
            f"after 1 visit, {after[1]} after 10 and {after[2]} after 100; by then a run of the former beats a run of "
            f"the latter with probability {chance}."]
    if ahead[2].low > 0:
        said.append("So in the end inversion has the larger lead, "
                    f"{inversion[:, 2].mean() / difference[:, 2].mean():.0f} times as large: for temporal difference, "
                    f"most steps lead from the chamber to the chamber, and these do not distinguish events.")
    _, by_inversion, by_difference, *_ = right.values()
    if np.abs(by_inversion - by_difference)[1:].max() <= 0.1:
        said.append("But *both* put the cause first about equally often, from the tenth visit on. A small lead "
                    "suffices as long as nothing else is added to it; an agent adds up the values of many cells and "
                    "several maps.")
    above = [estimate(np.mean, own[:, 2] - other[:, 2]) for other in (inversion, difference)]
    said.append("The lead of the book's rule after 100 visits, less that of plain inversion, is "
                f"{_finely(above[0])}, and less that of temporal difference {_finely(above[1])}.")
    return ("The *lead* of the cause is its value less that of the best of the other three. *Cause first* is the share "
            "of runs in which it is positive, so that a choice by value would be right.\n\n"
            + table(["Rule", "Lead after 10", "after 100", "Cause first after 1, 10, 100"], rows)
            + "\n\n" + " ".join(said))


def _finely(found):
    """An `Estimate` with three decimals, as text."""
    bounds = "" if np.isnan(found.low) else f" [{found.low:z.3f}, {found.high:z.3f}]"
    return f"{found.value:z.3f}{bounds}".replace("-", "−")


def longer_stays(efforts, sampled, lead):
    """How values and leads change with finer steps.

    efforts: steps to open an exit, in order. sampled, lead: values by role (runs, 4) and the lead of the cause, an
    `Estimate`, for each effort: {rule: […]}. The rules are inversion, temporal difference, and the latter with the same
    horizon.
    """
    at_first = sampled["inversion"][0][:, 0].mean()
    causes = [estimate(np.mean, groups[-1][:, 0]) for groups in sampled.values()]
    last = [estimates[-1].value for estimates in lead.values()]
    said = [f"From 1 step to {efforts[-1]}, the value of the cause goes from {at_first:.2f} to {causes[0]} with "
            f"inversion, and to {causes[1]} with temporal difference, or {causes[2]} with the same horizon. The lead "
            f"ends at {last[0]:.2f}, {last[1]:.3f} and {last[2]:.3f}."]
    if last[0] > 0.5 * lead["inversion"][0].value and last[0] > 2 * max(last[1:]):
        said.append("Inversion is thus nearly independent of the length of a step, and temporal difference is not. A "
                    "longer horizon restores the value but not the lead: the finer the steps, the less a single one "
                    "matters. This is the robustness in time that the thesis claims for its rule (section 4.1.3), and "
                    "it holds here. It also matters for superposition: a coarse map, with cells that take long to "
                    "cross, has values of the same size as a fine one.")
    return " ".join(said)


def late_effects(delays, first, brief, quick):
    """Which rules cope with exits that open late, with brief events, and with quick learning.

    first: {"inversion", "last event", "book's rule", "difference": [share of runs with the cause first, an Estimate,
    for each delay]}.
    brief: {hold: values} of the book's rule, inversion and temporal difference, with the default hold among them.
    quick: values of inversion and of temporal difference with α = 0.3.
    """
    share = {name: f"{100 * estimates[-1].value:.0f} %" for name, estimates in first.items()}
    own = share["book's rule"]
    said = [f"With a delay of {delays[-1]} steps the cause comes first in {share['inversion']} of the runs with credit "
            f"by share, in {share['last event']} with credit for the last event, in {own} with the book's rule "
            f"and in {share['difference']} with temporal difference."]
    lead = {hold: _final_leads(values) for hold, values in brief.items()}
    shortest, usual = (lead[hold][1] for hold in (min(lead), Chamber.hold))  # by inversion
    if shortest.high < usual.low:
        said.append("Credit by share has its own weakness: events that do not persist. The briefer they are, the more "
                    "both levers mix within a stay.")
    said.append(f"The table is for exits that open at once, after {Chamber.effort} presses in all.")
    rows = [[f"{hold} steps", *estimates] for hold, estimates in lead.items()]
    inversion, difference = _final_leads(quick)
    header = ["Events last", "Lead, the book's rule", "Lead, plain inversion", "Lead, temporal difference"]
    return (" ".join(said) + "\n\n" + table(header, rows)
            + f"\n\nAll this is with α = {INVERSION.learning_rate:g}. With α = 0.3, ten times as much, the lead after "
            f"100 visits is {inversion} with inversion and {difference} with temporal difference.")


def _final_leads(values):
    return [estimate(np.mean, lead_of_cause(each)[:, -1]) for each in values.values()]


def bright_light(values):
    """How often the cause comes first under each rule, and the values of cause and light, as a table."""
    rows = []
    for name, each in values.items():
        _, after_10, after_100 = np.mean(lead_of_cause(each)[:, SHOWN] > 0, axis=0)
        cause, _, light, _ = by_role(each)[:, -1].mean(axis=0)
        rows.append([name, f"{100 * after_10:.0f}, {100 * after_100:.0f} %", f"{cause:.2f}", f"{light:.2f}"])
    return table(["Rule", "Cause first after 10, 100 visits", "Value of the cause", "of the light"], rows)
