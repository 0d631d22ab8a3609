"""The claims behind the two conclusions of the thesis (section 5.1), and the verdicts that other pages have saved.

1. Each conclusion rests on some claims about agents; all others about agents are the ground of both. Claims that are
   not about agents are counted apart.
2. A claim that no page has judged has no row. One sentence says which these are, and how to have them judged.

Records are as `companion.shared.report.load` returns them.
"""

from companion.shared import report
from companion.shared.marks import html
from companion.shared.report import CALIBRATED, LETTER
from companion.shared.wording import filled, table
from companion.study import multiverse_figures
from neorl.drawing.style import axes_or_new
from companion.thesis.statements import AGENTS, CLAIMS, STATEMENTS
from companion.thesis.verdict import VERDICTS

SUPERPOSITION = ("A2", "A3", "A4", "A6", "A7", "A8", "A9", "A11", "B1", "B2", "B3", "B4", "B6", "T6")
SEPARATION = ("T1", "T7", "C1", "C2", "C3", "C4")
GROUND = tuple(name for name in AGENTS if name not in SUPERPOSITION + SEPARATION)
APART = tuple(name for name in CLAIMS if name not in AGENTS)
GROUPS = {"Superposition": SUPERPOSITION, "Learning apart from behaviour": SEPARATION, "What both rest on": GROUND,
          "Counted apart": APART}


def verdicts(record):
    """The claims with each verdict that any has, in each of `GROUPS` and under both readings, as a Markdown table.

    A claim that was not computed, or is judged under one reading only, is in the last column. "" if there are none.
    """
    if not record["claims"]:
        return ""
    of_readings = {LETTER: record["letter"], CALIBRATED: record["claims"]}
    rows = []
    for group, names in GROUPS.items():
        for reading, found in of_readings.items():
            by_verdict = {verdict: [] for verdict in (*VERDICTS, report.NOT_COMPUTED)}
            for name in names:
                by_verdict[report.verdict({"claims": found}, name)].append(name)
            rows.append([group, reading, *(" ".join(each) for each in by_verdict.values())])
    headings = [f"{html(verdict)}\u00a0{verdict}" for verdict in VERDICTS]
    return table(*filled(["Claims", "Reading", *headings, "not judged"], rows))


def remedy(record):
    """A sentence that says which claims no page has judged, and what to do; "" if there are none."""
    missing = [name for name in STATEMENTS if name not in record["claims"]]
    if not missing:
        return ""
    which = "No claim has" if not record["claims"] else f"{', '.join(missing)} have not"
    return f"**{which} been judged yet: `make book` computes the pages that judge claims, and then this one.**"


def extract(record, names):
    """Some claims, those that have been judged, as `report.extract` shows them; "" if there are none."""
    judged = [name for name in names if name in record["claims"]]
    return report.extract(record, judged) if judged else ""


def draw_standing(record, names):
    """As `companion.study.multiverse_figures.draw_standing`, of the claims among some that have been judged."""
    judged = [name for name in names if name in record["claims"]]
    if judged:
        return multiverse_figures.draw_standing(record, judged)
    axes = axes_or_new(None, figsize=(3, 0.4))
    axes.axis("off")
    axes.text(0.5, 0.5, "no claims judged", ha="center", va="center")
