"""The recorded answer, which opens a page and the page of all claims: what was found in words, and a figure of numbers.

1. All of it is from the committed record, so that it is the same on every page, in every build and in JupyterLab.
2. In the figure each claim is a line with a scale of its own, on which the band, the numbers that agree with the
   thesis, lies where it does in all other lines. An interval is inside the band, across its edge, or outside.
3. Figures are HTML tables with SVG in their cells, so that their words wrap on a narrow page.
"""

import re
import unicodedata
from dataclasses import replace
from functools import cache
from html import escape
from importlib import resources

import numpy as np
from IPython.display import HTML

from companion.page import answers, counts, marks, report
from companion.page.opening import CLAIMS_PAGE, link
from companion.page.wording import in_words
from companion.thesis.reading import NAMES, READINGS, conditions
from companion.thesis.statements import STATEMENTS
from companion.thesis.verdict import belongs
from neorl.statistics import Estimate

STYLE = resources.files(__package__) / "recorded.css"
SHOWN = report.CLAIMS_OF | {  # of pages that judge none
    "beyond_agents": ("C5",), "calibration": (*report.record()["shares"],), "chapter_1": ("T1",),
    "performance": ("T2", "T5"), "wanted": ("T10", "T11")}
EDGES = 100 / 3, 200 / 3  # of the band, in percent of a line
FARTHEST = 28.0, 60.0  # percent between the only edge of a band and the farthest number, outside and inside
PLACES = {True: "inside", None: "across the edge", False: "outside"}
MEANINGS = "what-the-verdicts-mean"  # the anchor of a section on the page of claims
OPEN = "undecided", "not testable"
PAPERS = ("Paper A", "A", 8), ("Papers B and C", "BC", 3)  # letters of their claims, and creeps
NUMBER = r"\d+(?:\.\d+)?"


def answer(page):
    """The answer of a page and the figure of its claims, as HTML. page: name of a notebook."""
    groups, record = counts.by_kind(SHOWN[page]), report.record()
    words = answers.answer(page) or counts.sentence(record, SHOWN[page])
    return shown(words, groups if len(groups) > 1 else {"": SHOWN[page]})


def shown(sentence, groups):
    """A sentence and the figure of some claims below it, as HTML for a notebook. groups: see `figure`."""
    record = report.record()
    names = [name for names in groups.values() for name in names]
    counted = counts.sentence(record, names)
    two = TWO if any(name in record["letter"] for name in names) else ""
    note = " ".join(filter(None, [counted if counted != sentence else "", NOTE, two, boards(names)]))
    words = f'<p class="sentence">{sentence}</p>' * bool(sentence)
    return HTML(f'<div class="recorded"><style>{STYLE.read_text("utf-8")}</style>{words}'
                f'{figure(record, groups, CLAIMS_PAGE)}<p class="note">{note}</p></div>',
                metadata={"findings": by_figure(record)})  # the book has them in its captions


def finding(record, name):
    """What was found on a claim, in words with its numbers; "" if it has none."""
    claim, words = record["claims"].get(name), STATEMENTS[name].finding
    if not claim:
        return ""
    return said(claim, words if isinstance(words, str) else words.get(claim["verdict"], ""))


def by_figure(record):
    """What was found on the claims that figures show, {label of a figure: words}."""
    found = {}
    for name, statement in STATEMENTS.items():
        if words := finding(record, name):
            found.setdefault(statement.figure, []).append(words)
    return {label: joined(findings) for label, findings in found.items()}


def joined(findings):
    """Findings in words as one text."""
    return "; ".join(findings).replace("; and ", ", and ").removeprefix("and ")


def said(claim, words):
    """Words with the numbers of a recorded claim, see `statements.toml`."""
    numbers = {what: number for what, (number, *_) in claim["numbers"].items()}
    where = next((what.split(", ")[1] for what, number in reversed(numbers.items())
                  if number == claim["here"] and ", " in what), "")
    here = _value(claim["here"]).removesuffix(".00")
    return words.format(here=here, size=here.lstrip("−"), where=where,
                        of={what: _value(number) for what, number in numbers.items()})


def figure(record, groups, claims_page=""):
    """Claims, a line each: the thesis's number, and ours under both readings, within or beyond what agrees.

    groups: {title or "": names of claims}. claims_page: the address of the page of claims, "" on this page.
    """
    known = {name for names in groups.values() for name in names}
    columns = {"letter": "To the letter", "calibrated": "Calibrated"} if known & {*record["letter"]} else {
        "calibrated": "Here"}
    heads = "".join(f'<th scope="col">{head}</th>' for head in (
        "Claim", LEGEND, "Thesis", *(f"{MARKERS[each]} {head}" for each, head in columns.items())))
    bodies = "".join(
        f"<tbody>{_title(title)}{''.join(_line(record, name, columns, claims_page) for name in names)}</tbody>"
        for title, names in groups.items() if names)
    return f'<table class="numbers"><thead><tr>{heads}</tr></thead>{bodies}</table>'


def decisive(name, found):
    """The first number that decides a recorded verdict, other than the claim's own: (what, number, bounds), or None.

    None also if the claim's own number is among those that decide.
    """
    own = STATEMENTS[name].statistic
    wanted = "?" if found["verdict"] in OPEN else "✓" if found["verdict"] == "reproduced" else "✗"
    deciding = [(what, number, bounds) for what, (number, bounds, mark, _) in found["numbers"].items()
                if mark == wanted and not bounds.startswith("partly")]
    if not deciding or any(what == own or number == found["here"] for what, number, _ in deciding):
        return None
    return deciding[0]


def bounds_of(name, what):
    """The `Bounds` of a number that the rule of a claim compares, by its name."""
    statement = STATEMENTS[name]
    return next((each for part, each in statement.also.items() if belongs(what, part)), statement.bounds)


def prints(statement, words):
    """Whether all numbers in some words are printed in the sentence that is judged; others are bounds of this book."""
    printed = re.findall(NUMBER, unicodedata.normalize("NFKC", statement.quotation))  # ² is a 2
    return all(number in printed for number in re.findall(NUMBER, words))


def expected(name):
    """What a claim is compared with, as text: the thesis's number or words, or else the bound of this book."""
    statement = STATEMENTS[name]
    printed = prints(statement, statement.thesis)
    return f"Thesis: {statement.thesis}" if printed else f"Bound of this book: {statement.bounds}"


def boards(names):
    """The boards of the papers that some claims are from, a sentence each; "" if they are from none.

    What the reading to the letter does not judge has another board, or none.
    """
    papers = {name[0] for name in names if name in report.record()["letter"]}
    return " ".join(f"{of}: {_board(creeps)}." for of, letters, creeps in PAPERS if papers & {*letters})


@cache
def _board(creeps):
    """The board of the papers with so many creeps under both readings, in words."""
    boards = {NAMES[name]: conditions(reading, 1, 1, groups=["layers", "modal"])["brownian", creeps].world
              for name, reading in READINGS.items()}
    rates = {f"{board.fps} steps per second" for board in boards.values()}
    rate = rates.pop() if len(rates) == 1 else ", ".join(
        f"{board.fps} steps per second {name}" for name, board in boards.items())
    reward = next(iter(boards.values())).win_reward
    last = f"{reward:+g} for the last green one" if reward else "nothing for the last green one"
    return f"{creeps} creeps, {last}, {rate}"


def _value(number):
    """A number as a record has it, without its interval, as text."""
    return in_words(Estimate(report.estimate_of(number).value, np.nan, np.nan))


def _title(title):
    return f'<tr><th colspan="5" scope="rowgroup">{escape(title)}</th></tr>' if title else ""


def _line(record, name, columns, claims_page):
    statement = STATEMENTS[name]
    found = {reading: record[part][name] for reading, part in report.PART_OF.items() if name in record[part]}
    compared = next((what for each in found.values() for what, (number, bounds, *_) in each["numbers"].items()
                     if bounds and number == each["here"]), statement.statistic)
    bounds, other = bounds_of(name, compared), found and decisive(name, found.get("calibrated") or found["letter"])
    rests = (f"<small>decided by another number, {escape(other[0])}: {report.number({'here': other[1]})}, which must "
             f"be {escape(other[2].partition(' (')[0])}</small>" if other else "")
    cells = "".join(f"<td>{_ours(found.get(reading), claims_page)}</td>" for reading in columns)
    words = statement.thesis if bounds.number is None else f"{bounds.number:g}"
    printed = prints(statement, words)
    bounds = bounds if printed else replace(bounds, number=None)
    thesis = escape(words) * printed + f"<small>ours: {bounds}</small>" * (bounds.number is None)
    return (f'<tr><th scope="row" title="{escape(statement.text)}">{escape(statement.short)} '
            f"({link(name, claims_page)})<small>{escape(statement.statistic)}</small>{rests}</th>"
            f"<td>{_scale(bounds, found)}</td><td>{thesis}</td>{cells}</tr>")


def _ours(found, claims_page):
    if not found:
        return ""
    verdict = f'<a href="{claims_page}#{MEANINGS}">{found["verdict"]}</a>'
    return (f'<span title="{report.number(found)}, {found["runs"]} runs or more">{_value(found["here"])}</span>'
            f'<small class="{marks.MARKS[found["verdict"]].css}">{verdict}</small>')


def _scale(bounds, found):
    """A line of the figure, as SVG. found: {reading: a recorded claim}."""
    numbers = {reading: [end for end in report.estimate_of(each["here"]) if not np.isnan(end)]
               for reading, each in found.items()}
    place = _places(bounds, [end for each in numbers.values() for end in each if np.isfinite(end)])
    left, right = (0 if np.isinf(bounds.low) else EDGES[0]), (100 if np.isinf(bounds.high) else EDGES[1])
    parts = [f'<rect class="band" x="{left:.1f}%" width="{right - left:.1f}%" height="100%"/>']
    if bounds.number is not None:
        at = place(bounds.number)
        parts.append(f'<line class="thesis" x1="{at:.1f}%" x2="{at:.1f}%" y2="100%"/>')
    for reading, (value, *interval) in numbers.items():
        parts.append(_point(reading, place(value), *map(place, interval or (value, value))))
    decided = {reading: bounds.decide(report.estimate_of(each["here"])) for reading, each in found.items()}
    words = "; ".join(f"{NAMES[reading]}: {report.number(each)}, {PLACES[decided[reading]]}"
                      for reading, each in found.items())
    return (f'<svg role="img" aria-label="{words}; agrees: {bounds}"><title>Agrees: {bounds}. {words}</title>'
            f'{"".join(parts)}</svg>')


def _places(bounds, numbers):
    """The function from numbers to percent of a line, in which the band of the bounds has its place."""
    if np.isfinite([bounds.low, bounds.high]).all():
        return lambda number: EDGES[0] + (EDGES[1] - EDGES[0]) * (number - bounds.low) / (bounds.high - bounds.low)
    edge, at, inwards = (bounds.low, EDGES[0], 1) if np.isfinite(bounds.low) else (bounds.high, EDGES[1], -1)
    known = [*numbers, *([] if bounds.number is None else [bounds.number])]
    outside, inside = FARTHEST
    unit = max([1e-9, *(inwards * (number - edge) / inside for number in known),
                *(inwards * (edge - number) / outside for number in known)])
    return lambda number: at + (number - edge) / unit


def _point(reading, at, low, high):
    """Our number and its interval; beyond the line, an arrow at its end."""
    y = {"calibrated": 6, "letter": 16}[reading]
    if not 1 <= at <= 99:
        end, tip = (100, 92) if at > 99 else (0, 8)
        return f'<g class="{reading}">{_arrow(end, tip, y)}</g>'
    low, high = np.clip([low, high], 0, 100)
    return (f'<g class="{reading}"><line x1="{low:.1f}%" x2="{high:.1f}%" y1="{y}" y2="{y}"/>'
            f"{_marker(reading, f'{at:.1f}%', y)}</g>")


def _arrow(end, tip, y):
    return f'<text x="{end}%" y="{y + 4}" text-anchor="{"end" if end else "start"}">{"→" if end else "←"}</text>'


def _marker(reading, x, y):
    if reading == "calibrated":
        return f'<circle cx="{x}" cy="{y}" r="4"/>'
    return f'<svg x="{x}" y="{y}" overflow="visible"><rect x="-3.5" y="-3.5" width="7" height="7"/></svg>'


MARKERS = {reading: f'<svg class="key" role="presentation"><g class="{reading}">{_marker(reading, "50%", 6)}</g></svg>'
           for reading in report.PART_OF}
NOTE = "From the committed record, with 95\u00a0% intervals; an arrow points beyond the end of its line."
TWO = ("To the letter: all gaps in the thesis’s text filled by the plainest choices. Calibrated: by those that fit its "
       "numbers best.")
LEGEND = ('<span class="key band"></span> agrees with the thesis, <span class="key thesis"></span> its number')
