"""The two conclusions of the thesis (section 5.1), the claims behind them, and whether they are reproduced.

1. Each rests on some claims about agents, of which four *carry* it; all others about agents are the ground of both.
2. All of it is said of the committed record; what the page itself runs is judged beside it.
"""

from dataclasses import replace

from companion.chapter_5.trials import TIMED
from companion.page import answers, counts, judging, opening, recorded, report
from companion.page.report import CLAIMS_OF
from companion.page.wording import table
from companion.thesis import claims
from companion.thesis.reading import additions
from companion.thesis.rules_chapters import MEASURED, PAST, THEN
from companion.thesis.statements import AGENTS, CLAIMS, STATEMENTS
from companion.thesis.verdict import FAILED
from companion.wanted import findings

SUPERPOSITION = ("A2", "A3", "A4", "A6", "A7", "A8", "A9", "A11", "B1", "B2", "B3", "B4", "B6", "T6", "T12")
SEPARATION = ("T1", "T7", "T10", "T11", "C1", "C2", "C3", "C4", "C6")
CARRYING = {"Superposition": ("A6", "B2", "B3", "B6"), "Learning apart from behaviour": ("C3", "C4", "T1", "T7")}
GROUND = tuple(name for name in AGENTS if name not in SUPERPOSITION + SEPARATION)
GROUPS = {"Superposition": SUPERPOSITION, "Learning apart from behaviour": SEPARATION, "What both rest on": GROUND,
          **counts.by_kind(name for name in STATEMENTS if name not in AGENTS)}
OWN = CLAIMS_OF["chapter_5"]
REQUIREMENTS = ("T10", "T11", "T12")  # of chapter 4, and what section 4.4 says of them, which the record alone judges
TURNED = ("revalued", "frozen", "wanting")  # agents whose desires change, or that had the later ones from the start


def judge(ran, reading, moved, costs):
    """The claims that the page itself judges, T1, T2 and T6, a list.

    ran: {key: `Result`}, of the groups "layers", "modal", "resolutions" and "revaluing" of a reading's conditions.
    moved: {"both": `trials.Moved`, "place cells": the same}. costs: a `trials.Costs`.
    """
    wanted = judging.papers_conditions(reading, "layers", "modal", "resolutions", "revaluing")
    place, both = wanted["place", "all"], wanted["both"]
    turned = {name: ran[name] for name in TURNED}
    near = {agents: each.means for agents, each in moved.items()}
    return [*judging.judge(lambda: [claims.judge_changes(turned, ran["brownian", 3], near)],
                           {**turned, "moved": [each.condition for each in moved.values()]},
                           {**{name: wanted[name] for name in TURNED}, "moved": [both, place]}),
            *judging.judge(lambda: [claims.judge_cost(costs.first[-1], costs.alone, costs.none)],
                           costs.condition, replace(both, steps=TIMED)),
            *judging.judge(lambda: [claims.judge_more_maps(additions(ran))], ran, wanted)]


def answer():
    """What agents do when their desires change, and how many claims that carry the conclusions hold, as HTML."""
    found, carried = of_reading("calibrated"), []
    for name, names in CARRYING.items():
        held, _ = counts.reproduced(found, names)
        carried.append(f"of the {len(names)} claims that carry the conclusion on {name.lower()}, {held} hold")
    carried = "; ".join(carried)
    rest = {"Of this chapter too": [name for name in (*OWN, *REQUIREMENTS) if name not in sum(CARRYING.values(), ())]}
    return recorded.shown(f"{answers.answer('chapter_5')} {carried[0].upper()}{carried[1:]}.", CARRYING | rest)


def all_claims():
    """All claims by the conclusion that rests on them, with their counts, as HTML."""
    return recorded.shown(counts.sentence(report.record(), STATEMENTS), GROUPS)


def pasts(reading):
    """What agents get of what they desire, by what they had desired while they learned, as recorded, in Markdown.

    Below it, what yoked agents tell of why.
    """
    record = report.record()[report.PART_OF[reading]]["T11"]
    measures = [f"{MEASURED[then]}, {THEN[then]}" for then in THEN]
    rows = [[past.capitalize(), *(report.number({"here": record["numbers"][f"{measure}, {past}"][0]})
                                  for measure in measures)] for past in PAST.values()]
    heads = [f"{measure[0].upper()}{measure[1:]}" for measure in measures]
    return (f"{table(['While learning', *heads], rows)}\n\nFrom the record, {record['runs']} runs of each. "
            f"{findings.in_chapter_5(reading)}")


def of_reading(reading):
    """The recorded claims under a reading, "calibrated" or "letter", with those that have none: {name: …}."""
    record = report.record()
    free = {name: found for name, found in record["claims"].items() if name not in record["letter"]}
    return free | record[report.PART_OF[reading]]


def failed(reading):
    """The claims that have failed under a reading, a list item each, in Markdown; "" if there are none."""
    found = of_reading(reading)
    return "\n".join(f"- {opening.link(name)}: {STATEMENTS[name].text}. {recorded.expected(name)}; here: "
                     f"{report.number(found[name])} ({found[name]['verdict']})."
                     for name in CLAIMS if name in found and found[name]["verdict"] in FAILED)
