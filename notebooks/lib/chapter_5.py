"""The claims behind the two conclusions of the thesis (section 5.1), and the verdicts on them as a table.

Each conclusion rests on some claims, and claims on other worlds and agents on none; all others are the ground of both.
"""

from lib.shared import report
from lib.shared.marks import html
from lib.shared.report import CALIBRATED, LETTER
from lib.shared.wording import filled, table
from neorl.evidence.statements import CLAIMS
from neorl.evidence.verdict import VERDICTS

SUPERPOSITION = ("A2", "A3", "A4", "A6", "A7", "A8", "A9", "B1", "B2", "B3", "B4", "B6", "T6", "T9")
SEPARATION = ("T1", "T7", "C1", "C2", "C3", "C4")
BEYOND = ("C5",)  # judged by the pages beyond the thesis
GROUND = tuple(name for name in CLAIMS if name not in SUPERPOSITION + SEPARATION + BEYOND)
GROUPS = {"Superposition": SUPERPOSITION, "Learning apart from behaviour": SEPARATION, "What both rest on": GROUND,
          "Beyond the thesis": BEYOND}


def verdicts(record):
    """The claims with each verdict that any has, in each of `GROUPS` and under both readings, as a Markdown table.

    A claim that was not computed, or is judged under one reading only, is in the last column.

    record: as `lib.shared.report.load` returns it.
    """
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
