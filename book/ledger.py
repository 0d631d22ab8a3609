"""The page of all claims, and what the first page says of them, from the records of `lib.shared.report`.

1. A strip with a square for each claim and a tally come first, then a line for each claim: its number in the thesis and
   here, and the verdict. A click opens what the verdict rests on.
2. Pages are MyST Markdown. The strip and the lines are HTML, since they have a shape of their own.
"""

from collections import Counter
from functools import partial
from html import escape

from lib.shared import marks, report, wording
from lib.shared.opening import anchor, link
from neorl.evidence.statements import CLAIMS, DEMONSTRATIONS, STATEMENTS
from neorl.evidence.verdict import RUNS_FOR_A_VERDICT, VERDICTS

SHARES = ("Agree, in long runs", "Reproduce it, in short runs", "Undecided, in short runs")
CHAPTERS = {"A": "Paper A: maps of one space", "B": "Paper B: modalities", "C": "Paper C: networks of desires",
            "T": "The thesis as a whole"}


def page(record):
    """The strip, the tally and the claims, in MyST Markdown. record: as `report.load` returns it."""
    parts = [strip(record), tally(record)]
    groups = {title: [name for name in CLAIMS if name[0] == letter] for letter, title in CHAPTERS.items()}
    for title, names in (groups | {"Beside the claims: demonstrations": DEMONSTRATIONS}).items():
        parts += [f"## {title}", *(_claim(record, name) for name in names)]
    return "\n\n".join(parts) + "\n"


def front(record):
    """What was found, in a sentence, as HTML for the first page. record: as `report.load` returns it."""
    return f'<p class="result">{sentence(record, partial(link, page="claims.html"))}</p>\n'


def squares(record):
    """The strip of claims and the meaning of its symbols, as HTML for the first page. record: as in `front`."""
    legend = " · ".join(f"{marks.html(verdict)} {verdict}" for verdict in counts(record))
    return f'{strip(record, "claims.html")}\n<p>{legend}</p>\n'


def counts(record):
    """The number of claims with each verdict: {verdict: count}, without verdicts that no claim has."""
    found = [report.verdict(record, name) for name in CLAIMS]
    return {verdict: found.count(verdict) for verdict in marks.MARKS if verdict in found}


def sentence(record, named=str):
    """How many claims, and which, are reproduced, with the number of runs: a sentence. named: a name to its text."""
    runs = Counter(found["runs"] for found in record["claims"].values()).most_common(1)
    groups = {verdict: [named(name) for name in CLAIMS if report.verdict(record, name) == verdict]
              for verdict in VERDICTS[:3]}
    if not any(groups.values()):
        return (f"This book judges {len(CLAIMS)} claims of P. R. Leikanger’s thesis. Verdicts need "
                f"{RUNS_FOR_A_VERDICT} runs of each condition, and this build has fewer.")
    parts = [f"{len(names)} {verdict} ({', '.join(names)})" for verdict, names in groups.items() if names]
    left = [named(name) for name in CLAIMS if report.verdict(record, name) not in groups]
    parts += [f"{len(left)} not judged ({', '.join(left)})"] if left else []
    return (f"We reran P. R. Leikanger’s thesis with {runs[0][0]} runs of each condition. Of its {len(CLAIMS)} claims "
            f"we found {'; '.join(parts)}.")


def tally(record):
    """The number of claims with each verdict, as a line of Markdown."""
    return f"{len(CLAIMS)} claims: " + " · ".join(f"{marks.html(verdict)} {count} {verdict}"
                                                  for verdict, count in counts(record).items()) + "."


def strip(record, address=""):
    """An HTML list with a square for each claim, its symbol in its colour, that links to the claim.

    address: of the page of claims, relative to the page with the strip.
    """
    squares = []
    for name in CLAIMS:
        verdict = report.verdict(record, name)
        mark, text = marks.MARKS[verdict], escape(f"{name}, {verdict}: {STATEMENTS[name].text}")
        squares.append(f'<li><a class="{mark.css}" href="{address}#{anchor(name)}" title="{text}" aria-label="{text}">'
                       f"{name}<span>{mark.symbol}</span></a></li>")
    return f'<ul class="claims-strip" aria-label="Verdict of each claim">{"".join(squares)}</ul>'


def _claim(record, name):
    """A claim in a line, which opens to the sentence that is judged and all that its verdict rests on."""
    statement, found, verdict = STATEMENTS[name], record["claims"].get(name), report.verdict(record, name)
    numbers = f"Thesis: {escape(statement.thesis)}" + (f" · Here: {report.number(found)}" if found else "")
    cells = [f"<b>{name}</b>", f"{escape(statement.text)} <small>{numbers}</small>",
             f"{marks.html(verdict)}\u00a0{report.decided(record, name)}"]
    line = "".join(f"<span>{cell}</span>" for cell in cells)
    return "\n\n".join([f'<details class="claim"><summary>{line}</summary>\n<div id="{anchor(name)}">',
                        f"“{statement.quotation}” ({statement.place}).", *_evidence(record, name),
                        "</div>\n</details>"])


def _evidence(record, name):
    """What a verdict rests on: the numbers of its rule, links to its figure and rule, and the readings that agree."""
    statement, share = STATEMENTS[name], record["shares"].get(name)
    parts = [numbers] if (numbers := report.numbers(record, name)) else []
    if name in record["claims"]:
        parts.append(f"Shown in {{ref}}`this figure <{statement.figure}>`, judged by "
                     f"{{ref}}`this rule <{report.label(statement.rule)}>`.")
    if share:
        agrees = _share(share["agrees"], share["measured"]) if share.get("measured") else ""
        parts.append(wording.table(SHARES, [[agrees, *(_share(share[each], share["readings"])
                                                       for each in ("reproduced", "undecided"))]]))
    return parts


def _share(count, total):
    """A count of a total, from 20 on as a percentage, as text."""
    return f"{count} of {total}" if total < 20 else f"{100 * count / total:.0f}\u00a0% of {total}"
