"""The page of all claims, and what the first page says of them, from the records of `companion.page.report`.

1. The page answers first (`answer.py`), and then has a line for each claim: the number that decides, here and in the
   thesis, and the verdict. A click opens what the verdict rests on.
2. The first page has the headline of the answer, and a small figure of the verdicts.
3. All of it shows the committed record, whatever a build has run.
4. Pages are MyST Markdown. Figures and lines are HTML, since they have a shape of their own.
"""

from html import escape

import numpy as np
from companion.page import counts, marks, recorded, report
from companion.page.opening import anchor
from companion.study import sensitivity
from companion.thesis.statements import AGENTS, STATEMENTS

from writing import base_rate, curves, levels
from writing.answer import BLOCKS, dependence, headline, sections, summary, turned

CAPTION = ("Each claim has a scale of its own, so that all bands lie below each other. Points are our numbers, with "
           "95\u00a0% intervals; one beyond its line is an arrow. A claim leads to its line below.")
CHAPTERS = {"A": "Paper A: maps of one space", "B": "Paper B: modalities", "C": "Paper C: networks of desires",
            "T": "The thesis as a whole"}


def page(record):
    """The answer and the claims, in MyST Markdown."""
    found = sensitivity.shipped()
    style = f'<style>{recorded.STYLE.read_text("utf-8")}</style>'
    parts = [headline(record), style + recorded.figure(record, BLOCKS),
             f"{CAPTION} Recorded on {record['date']} with commit {record['commit']}.",
             base_rate.section(), turned(record),
             "[Chapter 5](chapters/chapter_5.ipynb) has the figure of this turn, and a switch.",
             dependence(record, found), *sections(record, found),
             levels.section(record, found), "## Claim by claim"]
    groups = {title: [name for name in AGENTS if name[0] == letter] for letter, title in CHAPTERS.items()}
    for title, names in (groups | counts.by_kind(name for name in STATEMENTS if name not in AGENTS)).items():
        parts += [f"### {title}", recorded.boards(names), *(_claim(record, name, found) for name in names)]
    return "\n\n".join(filter(None, parts)) + "\n"


def front(record):
    """What was found, as HTML for the first page: the headline, its figure, and claim T1, which the star is about."""
    link = f'<a href="claims.html#{anchor("T1")}">claim T1</a>'
    verdict = report.verdict(record, "T1")
    runs = f", in {record['claims']['T1']['runs']:,} runs" if "T1" in record["claims"] else ""
    return "\n".join([
        f'<p class="result">{headline(record)}</p>', summary(record),
        f"<p>Above is one run. {STATEMENTS['T1'].text}: as {link} this is {marks.html(verdict)}\u00a0"
        f"{marks.explained(verdict)} in the calibrated reading{runs}.</p>"]) + "\n"


def _claim(record, name, of_table):
    """A claim in a line, which opens to the sentence that is judged and all that its verdict rests on."""
    statement, found, verdict = STATEMENTS[name], record["claims"].get(name), report.verdict(record, name)
    reason = f" <small>{marks.REASONS[verdict]}{_wanted(name, found)}</small>" if verdict in marks.REASONS else ""
    cells = [f"<b>{name}</b>", f"{escape(statement.text)} <small>{escape(_deciding(name, found))}</small>",
             f"{marks.html(verdict)}\u00a0{verdict}{reason}"]
    line = "".join(f"<span>{cell}</span>" for cell in cells)
    return "\n\n".join([f'<details class="claim"><summary>{line}</summary>\n<div id="{anchor(name)}">',
                        f"“{statement.quotation}” ({statement.place}).", *_evidence(record, name, of_table),
                        "</div>\n</details>"])


def _wanted(name, found):
    """The runs that would decide what is open in a claim, if the means stay, as text; "" if nothing is."""
    needed = runs_needed(name, found) if found else 0
    return f": some {float(f'{needed:.2g}'):,.0f} runs, if the means stay" if needed else ""


def runs_needed(name, found):
    """The runs of each condition with which no open interval of a claim would cross its bound, if the means stay.

    found: a claim of a record. An interval narrows with the root of the runs. Returns 0 if none is open.
    """
    needed = 0.0
    for what, (number, _, mark, _) in found["numbers"].items():
        value, low, high = report.estimate_of(number)
        if mark != "?" or not np.isfinite([value, low, high]).all():
            continue
        bounds = recorded.bounds_of(name, what)
        for end in (bounds.low, bounds.high):
            if low <= end <= high and end != value:
                half = value - low if end < value else high - value
                needed = max(needed, found["runs"] * (half / (value - end)) ** 2)
    return needed


def _deciding(name, found):
    """The number that decides a verdict, with what it is and what the claim needs, and the thesis's, as text."""
    statement = STATEMENTS[name]
    thesis = recorded.expected(name)
    if not found:
        return f"{statement.statistic}. {thesis}"
    deciding = recorded.decisive(name, found)
    if deciding is None:
        return f"{statement.statistic}: {report.number(found)}. {thesis}"
    what, number, bounds = deciding
    needed, _, _ = bounds.partition(" (")
    return f"{statement.statistic}; {what}: {report.number({'here': number})}, needed: {needed}. {thesis}"


def _evidence(record, name, of_table):
    """What a verdict rests on: the numbers of its rule, links to its figure and rule, and the readings that agree."""
    statement = STATEMENTS[name]
    parts = [report.numbers(record, name)]
    if name in record["claims"]:
        parts.append(f"Shown in {{ref}}`this figure <{statement.figure}>`, judged by "
                     f"{{ref}}`this rule <{report.label(statement.rule)}>`.")
    return [part for part in (*parts, curves.panels(of_table, name)) if part]
