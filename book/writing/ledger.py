"""The page of all claims, and what the first page says of them, from the records of `companion.page.report`.

1. The page answers first (`answer.py`), and then has a line for each claim: the number that decides, here and in the
   thesis, and the verdict. A click opens what the verdict rests on.
2. The first page has the headline of the answer, and a small figure of the verdicts.
3. All of it shows the committed record (`record.py`). A build says in a sentence how its own verdicts compare.
4. Pages are MyST Markdown. Figures and lines are HTML, since they have a shape of their own.
"""

from collections import Counter
from html import escape

from companion.page import marks, report
from companion.page.opening import anchor
from companion.study import sensitivity
from companion.thesis.statements import AGENTS, CLAIMS, DEMONSTRATIONS, STATEMENTS
from companion.thesis.verdict import belongs

from writing import curves, levels
from writing.answer import APART, CAPTION, counts, dependence, figure, headline, runs, sections, summary

# Verdicts of a build that do not contradict the record, in words.
OPEN = {"undecided": "undecided"} | dict.fromkeys(("no verdict", report.NOT_COMPUTED), "without a verdict")
CHAPTERS = {"A": "Paper A: maps of one space", "B": "Paper B: modalities", "C": "Paper C: networks of desires",
            "T": "The thesis as a whole"}
KINDS = {"proof": "Counted apart: decided by proof", "report": "Counted apart: the author’s report",
         "counting": "Counted apart: decided by counting", "code": "Counted apart: this book’s code"}
DECIDES = {"undecided": "?", "not testable": "?"}  # the mark of the number that a verdict rests on, else ✗ or ✓


def page(record, build):
    """The answer and the claims, in MyST Markdown. record, build: see `headline` and `beside`."""
    found = sensitivity.shipped()
    parts = [headline(record), dependence(record, found), figure(record),
             f"Verdicts: {legend(record)}. {CAPTION} {beside(record, build)}".rstrip(), *sections(record, found),
             levels.section(record), "## Claim by claim"]
    groups = {title: [name for name in AGENTS if name[0] == letter] for letter, title in CHAPTERS.items()}
    groups |= {title: [name for name in APART if STATEMENTS[name].kind == kind] for kind, title in KINDS.items()}
    for title, names in (groups | {"Beside the claims: demonstrations": DEMONSTRATIONS}).items():
        parts += [f"### {title}", *(_claim(record, name, found) for name in names)]
    return "\n\n".join(filter(None, parts)) + "\n"


def legend(record):
    """The symbols of the verdicts that some claim of a record has, with their meaning, as HTML."""
    return " · ".join(f"{marks.html(verdict)}\u00a0{marks.explained(verdict)}" for verdict in counts(record, CLAIMS))


def front(record):
    """What was found, as HTML for the first page: the headline, its figure, and claim T1, which the star is about."""
    link = f'<a href="claims.html#{anchor("T1")}">claim T1</a>'
    verdict = report.verdict(record, "T1")
    return "\n".join([
        f'<p class="result">{headline(record)}</p>', summary(record), f"<p>{legend(record)}</p>",
        f"<p>One run in a page decides nothing. {STATEMENTS['T1'].text}: as {link} this is {marks.html(verdict)}\u00a0"
        f"{marks.explained(verdict)} in the calibrated reading.</p>"]) + "\n"


def beside(record, build):
    """How the verdicts of a build compare with the record, in a sentence; "" if the build is the record."""
    if build is record:
        return ""
    here = {name: report.verdict(build, name) for name in CLAIMS}
    different = {name: verdict for name, verdict in here.items() if verdict != report.verdict(record, name)}
    groups = Counter(OPEN[verdict] for verdict in different.values() if verdict in OPEN)
    parts = [f"{len(here) - len(different)} the same", *(f"{count} {verdict}" for verdict, count in groups.items())]
    if others := [f"{name} {verdict}" for name, verdict in different.items() if verdict not in OPEN]:
        parts.append(f"{len(others)} different ({', '.join(others)})")
    return (f"Recorded on {record['date']} with commit {record['commit']}. This build, {runs(build)} runs: "
            f"{', '.join(parts)}.")


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
    statement, needed = STATEMENTS[name], 0.0
    for what, (number, _, mark, _) in found["numbers"].items():
        if mark != "?" or None in number:
            continue
        bounds = next((each for part, each in statement.also.items() if belongs(what, part)), statement.bounds)
        value, low, high = number
        for end in (bounds.low, bounds.high):
            if low <= end <= high and end != value:
                half = value - low if end < value else high - value
                needed = max(needed, found["runs"] * (half / (value - end)) ** 2)
    return needed


def _deciding(name, found):
    """The number that decides a verdict, with what it is and what the claim needs, and the thesis's, as text."""
    statement = STATEMENTS[name]
    thesis = f"Thesis: {statement.thesis}"
    if not found:
        return f"{statement.statistic}. {thesis}"
    wanted = DECIDES.get(found["verdict"], "✓" if found["verdict"] == "reproduced" else "✗")
    deciding = [(what, number, bounds) for what, (number, bounds, mark, _) in found["numbers"].items()
                if mark == wanted and not bounds.startswith("partly")]
    if any(what == statement.statistic or number == found["here"] for what, number, _ in deciding) or not deciding:
        return f"{statement.statistic}: {report.number(found)}. {thesis}"
    what, number, bounds = deciding[0]
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
