"""The two conclusions of the thesis (section 5.1), the claims behind them, and whether they are reproduced.

1. Each rests on some claims about agents, of which four *carry* it; all others about agents are the ground of both.
2. A conclusion *stands* if all that carry it are reproduced, *in part* if any is, wholly or partly, *does not stand* if
   all have failed, and is *open* otherwise. It is *not judged* while none of them has a verdict.

Records are as `companion.page.report.load` returns them.
"""

from dataclasses import replace

from companion.chapter_5.trials import TIMED
from companion.page import judging, opening, report
from companion.page.marks import leads
from companion.page.report import CLAIMS_OF, LEGEND, PART_OF
from companion.thesis import claims
from companion.thesis.reading import NAMES, additions
from companion.thesis.statements import AGENTS, APART, CLAIMS, DEMONSTRATIONS, STATEMENTS
from companion.thesis.verdict import FAILED, RUNS_FOR_A_VERDICT

SUPERPOSITION = ("A2", "A3", "A4", "A6", "A7", "A8", "A9", "A11", "B1", "B2", "B3", "B4", "B6", "T6")
SEPARATION = ("T1", "T7", "C1", "C2", "C3", "C4")
CARRYING = {"Superposition": ("A6", "B2", "B3", "B6"), "Learning apart from behaviour": ("C3", "C4", "T1", "T7")}
GROUND = tuple(name for name in AGENTS if name not in SUPERPOSITION + SEPARATION)
GROUPS = {"Superposition": SUPERPOSITION, "Learning apart from behaviour": SEPARATION, "What both rest on": GROUND,
          "Counted apart": APART, "Beside the claims": DEMONSTRATIONS}
OWN = CLAIMS_OF["chapter_5"]
TURNED = ("revalued", "frozen", "wanting")  # agents whose desires change, or that had the later ones from the start
WITHOUT_READING = [name for page in ("alternatives", "chapter_2", "chapter_3", "other_spaces")
                   for name in CLAIMS_OF[page]]  # claims of pages that run no reading


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


def of_reading(record, reading, judged):
    """A record of one reading, "calibrated" or "letter": what the other pages have found, and this one's claims."""
    free = {name: each for name, each in record["claims"].items() if name in WITHOUT_READING}
    others = {name: each for name, each in (free | record[PART_OF[reading]]).items() if name not in OWN}
    return {"claims": others | report.kept(judged), "letter": {}, "shares": record["shares"]}


def answer(record, reading):
    """The box that says whether the conclusions are reproduced. record: of one reading, see `of_reading`."""
    stand = [f"{name.lower()} {standing(record, names)}" for name, names in CARRYING.items()]
    lines = [f"**{NAMES[reading].capitalize()}: {'; '.join(stand)}.**"]
    for conclusion, names in CARRYING.items():
        found = {name: record["claims"][name] for name in names if leads(report.verdict(record, name))}
        words = opening.in_words({name: report.number(each) for name, each in found.items()})
        verdicts = opening.by_verdict({name: each["verdict"] for name, each in found.items()})
        lines += [f"*{conclusion}.* {words} {verdicts}."] if found else []
    if len(lines) == 1 and record["claims"]:
        lines = [f"**Quick look: no verdicts.** They need {RUNS_FOR_A_VERDICT} runs of full length."]
    return opening.box("**Are the conclusions reproduced?**", *lines, remedy(record))


def standing(record, names):
    """Whether what rests on some claims stands, see rule 2, in words."""
    verdicts = [report.verdict(record, name) for name in names]
    if not any(map(leads, verdicts)):
        return "is not judged"
    if all(verdict == "reproduced" for verdict in verdicts):
        return "stands"
    if any(verdict in ("reproduced", "partly") for verdict in verdicts):
        return "stands in part"
    return "does not stand" if all(verdict in FAILED for verdict in verdicts) else "is open"


def remedy(record):
    """A sentence that says which claims no page has judged, and what to do; "" if there are none."""
    missing = [name for name in STATEMENTS if name not in record["claims"]]
    if not missing:
        return ""
    which = "No claim has" if not record["claims"] else f"{', '.join(missing)} have not"
    return f"**{which} been judged yet: `make book` computes the pages that judge claims, and then this one.**"


def tables(record):
    """All claims that have been judged, a Markdown table for each of `GROUPS`, and one legend; "" if there are none."""
    judged = {group: [name for name in names if name in record["claims"]] for group, names in GROUPS.items()}
    parts = [f"**{group}**\n\n{report.rows(record, names)}" for group, names in judged.items() if names]
    return "\n\n".join([*parts, LEGEND]) if parts else ""


def failed(record):
    """The claims that have failed, a list item each, in Markdown; "" if there are none."""
    names = [name for name in CLAIMS if report.verdict(record, name) in FAILED]
    return "\n".join(f"- {opening.link(name)}: {STATEMENTS[name].text}. Thesis: {STATEMENTS[name].thesis}; here: "
                     f"{report.number(record['claims'][name])} ({report.verdict(record, name)})." for name in names)
