"""The page of all claims, and what the first page says of them, from the records of `lib.shared.report`.

1. A strip with a square for each claim and a tally come first, then a row for each, then the evidence for its verdict.
2. A row has the estimates under both readings, the verdict, and the shares of readings in separate columns.
3. Pages are MyST Markdown. The strip is HTML, since its squares are links with a shape of their own.
"""

from collections import Counter
from functools import partial
from html import escape

from lib.shared import marks, report, wording
from lib.shared.opening import anchor, link
from neorl.evidence.statements import CLAIMS, DEMONSTRATIONS, STATEMENTS
from neorl.evidence.verdict import RUNS_FOR_A_VERDICT, VERDICTS

COLUMNS = ("Claim", "Thesis", "To the letter", "Calibrated", "Verdict", "Agrees", "Reproduced", "Undecided")
CHAPTERS = {"A": "Paper A: maps of one space", "B": "Paper B: modalities", "C": "Paper C: networks of desires",
            "T": "The thesis as a whole"}


def page(record):
    """The strip, the tally, the tables and the evidence, in MyST Markdown. record: as `report.load` returns it."""
    parts = [strip(record), tally(record), _table(record, CLAIMS), "## Beside the claims: demonstrations",
             _table(record, DEMONSTRATIONS), "## What each verdict rests on",
             "The sentence that is judged, what was measured, and what was found."]
    groups = {title: [name for name in CLAIMS if name[0] == letter] for letter, title in CHAPTERS.items()}
    for title, names in (groups | {"Demonstrations": DEMONSTRATIONS}).items():
        parts.append("\n".join([f":::{{dropdown}} {title}", *report.evidence(record, names), ":::"]))
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
    left = len(CLAIMS) - sum(map(len, groups.values()))
    parts += [f"{left} not judged"] if left else []
    return (f"We reran P. R. Leikanger’s thesis with {runs[0][0]} runs of each condition. Of its {len(CLAIMS)} claims "
            f"we found {'; '.join(parts)}.")


def tally(record):
    """The number of claims with each verdict, as a line of Markdown."""
    return f"{len(CLAIMS)} claims: " + " · ".join(f"{marks.html(verdict)} {count} {verdict}"
                                                  for verdict, count in counts(record).items()) + "."


def strip(record, address=""):
    """An HTML list with a square for each claim, its symbol in its colour, that links to the claim's row.

    address: of the page of claims, relative to the page with the strip.
    """
    squares = []
    for name in CLAIMS:
        verdict = report.verdict(record, name)
        mark, text = marks.MARKS[verdict], escape(f"{name}, {verdict}: {STATEMENTS[name].text}")
        squares.append(f'<li><a class="{mark.css}" href="{address}#{anchor(name)}" title="{text}" aria-label="{text}">'
                       f"{name}<span>{mark.symbol}</span></a></li>")
    return f'<ul class="claims-strip" aria-label="Verdict of each claim">{"".join(squares)}</ul>'


def _table(record, names):
    return f":::{{div}} claims\n{wording.table(COLUMNS, [_row(record, name) for name in names])}\n:::"


def _row(record, name):
    statement, found, share = STATEMENTS[name], record["claims"].get(name), record["shares"].get(name)
    verdict = report.verdict(record, name)
    judged = f"{marks.html(verdict)}\u00a0{verdict}"
    if found:
        judged += f" {{ref}}`figure <{statement.figure}>`, {{ref}}`rule <{report.label(statement.rule)}>`"
    return [f'<span id="{anchor(name)}"></span>**{name}** {statement.text} <small>{statement.statistic}</small>',
            statement.thesis,
            *(_marked(record[part].get(name)) for part in ("letter", "claims")), judged, *_shares(share)]


def _marked(found):
    """A number, after the symbol of its verdict."""
    if not found:
        return ""
    mark = f"{marks.html(found['verdict'])}\u00a0" if marks.leads(found["verdict"]) else ""
    return f"{mark}{report.number(found)}"


def _shares(share):
    """The shares of readings whose numbers agree at the papers' lengths, and for which the rule holds or cannot decide.
    """
    if not share:
        return "", "", ""
    agrees = _share(share["agrees"], share["measured"]) if share.get("measured") else ""
    return agrees, _share(share["holds"], share["readings"]), _share(share["undecided"], share["readings"])


def _share(count, total):
    """A count of a total, from 20 on as a percentage, as text."""
    return f"{count} of {total}" if total < 20 else f"{100 * count / total:.0f}\u00a0% of {total}"
