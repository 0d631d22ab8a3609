"""What the papers' agents earn to the letter and calibrated, side by side on one axis, as an HTML table.

The readings may differ in much of which verdicts show only the end. Numbers are from the claims in the record.
"""

from html import escape

import scipy
from companion.page import report
from companion.page.wording import number
from companion.study import sensitivity
from companion.thesis.reading import NAMES, NODES
from companion.thesis.statements import STATEMENTS

PLACES = "B3 place"  # the number of the table of readings
ROWS = {  # {agents: (claim, its number; "" for the one that it is about)}
    "Paper A: N3, N7 and N23 together": ("A7", "final reward per second, 3, 7 and 23 together"),
    "Paper A: N7 alone": ("A7", "final reward per second, N7"),
    "Paper A: Brownian motion": ("A7", "final reward per second, Brownian motion"),
    "Paper B: places and objects": ("B3", ""),
    "Paper B: places alone": ("B3", "place cells"),
    **{f"Paper C: {name}": ("C3", f"final reward per second, {of_claim}") for name, of_claim in {
        **{f"network {each}": each for each in "ACD"}, **{each: each for each in NODES.values()}}.items()}}


def section(record, found):
    """The levels under both readings with a heading, in MyST Markdown; "" unless both have all of them.

    found: `companion.study.sensitivity.Findings`.
    """
    levels = {reading: [_level(record[part], *number) for number in ROWS.values()]
              for reading, part in report.PART_OF.items()}
    if not all(map(all, levels.values())):
        return ""
    times, both, place = (bounds.number for bounds in (STATEMENTS["A7"].bounds, STATEMENTS["B3"].bounds,
                                                        STATEMENTS["B3"].also["place cells"]))
    most = max(value for of_reading in levels.values() for value, *_ in of_reading)
    heads = "".join(f'<th scope="col">{NAMES[reading].capitalize()}</th>' for reading in ("letter", "calibrated"))
    rows = "".join(f'<tr><th scope="row">{escape(name)}</th>{_cell(letter, most)}{_cell(calibrated, most)}</tr>'
                   for name, letter, calibrated in zip(ROWS, levels["letter"], levels["calibrated"]))
    return ("## Two readings, two stories\n\nReward per second at the end of the runs, on one axis. In the thesis "
            f"three maps earn {times:g} times as much as N7, both modalities {both:g} a second beside {place:g} of "
            "places alone, and C more than A.\n\n"
            f'<table class="answer levels"><thead><tr><th scope="col">Agent</th>{heads}</tr></thead>'
            f"<tbody>{rows}</tbody></table>\n\n{why_places_earn_more(found)}")


def why_places_earn_more(found):
    """What lets agents with place cells alone earn more to the letter, as far as the table of readings tells."""
    without = sensitivity.setbacks(found.table, found.calibrated.reading)["memory"]
    drawn = [row for row in found.table if row.wave == 0 and PLACES in row.statistics]
    rank = scipy.stats.spearmanr([row.reading.choices["discount"] for row in drawn],
                                 [row.statistics[PLACES].value for row in drawn]).statistic
    earned, calibrated = (number(row.statistics[PLACES].value) for row in (without, found.calibrated))
    return ("Why do places alone earn so much more to the letter? That reading has no memory of cells left earlier, "
            f"and a shorter horizon. Calibrated but without memory, they earn {earned} in place of {calibrated}; and "
            "of readings drawn evenly within the text, those with a longer horizon let them earn less (rank "
            f"correlation {number(rank)}).")


def _level(claims, name, number):
    """The level as a number of a claim has it, with its interval, or None."""
    if name not in claims:
        return None
    return claims[name]["numbers"][number][0] if number else claims[name]["here"]


def _cell(level, most):
    width = 100 * max(level[0], 0) / most
    return (f'<td class="share"><span class="bar"><span style="width:{width:.1f}%"></span></span>'
            f"<span>{report.number({'here': level})}</span></td>")
