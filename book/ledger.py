"""The page of all claims, and what the first page says of them, from the records of `companion.shared.report`.

1. The headline counts the claims about agents, and apart from them those that a proof or a count settles, that are
   about this book's code, or that report attempts. It is the same wherever it stands.
2. A strip with a square for each claim and a tally come next, then a line for each claim: its number in the thesis and
   here, and the verdict. A click opens what the verdict rests on.
3. All of it shows the committed record (`record.py`). A build says in a sentence how its own verdicts compare.
4. Pages are MyST Markdown. The strip and the lines are HTML, since they have a shape of their own.
"""

from collections import Counter
from html import escape

from companion.shared import marks, report, wording
from companion.shared.opening import anchor
from companion.shared.priors import WITHIN
from companion.study.calibration_targets import CLAIMS as FITTED
from companion.thesis.reading import TO_THE_LETTER, Reading
from companion.thesis.statements import AGENTS, CLAIMS, DEMONSTRATIONS, STATEMENTS
from companion.thesis.verdict import RUNS_FOR_A_VERDICT

SHARES = {"reproduced": "Reproduce it, in short runs", "undecided": "Undecided, in short runs",
          "contradicted": "Contradict it, in short runs"}
# Verdicts of a build that do not contradict the record, in words.
OPEN = {"undecided": "undecided"} | dict.fromkeys(("no verdict", report.NOT_COMPUTED), "without a verdict")
CHAPTERS = {"A": "Paper A: maps of one space", "B": "Paper B: modalities", "C": "Paper C: networks of desires",
            "T": "The thesis as a whole"}
APART = tuple(name for name in CLAIMS if name not in AGENTS)
KINDS = {"proof": ("Decided by proof", ""), "report": ("The author’s report", ""),  # headings, and words in a sentence
         "counting": ("Decided by counting", " (by counting)"), "code": ("This book’s code", " (this book’s code)")}


def page(record, build):
    """The strips, the tallies and the claims, in MyST Markdown. record, build: see `headline` and `beside`."""
    parts = [f"{headline(record)} {beside(record, build)}", strip(record, AGENTS),
             tally(record, AGENTS, "claims about agents"), strip(record, APART),
             tally(record, APART, "claims counted apart")]
    groups = {title: [name for name in AGENTS if name[0] == letter] for letter, title in CHAPTERS.items()}
    groups |= {f"Counted apart: {title[0].lower()}{title[1:]}": _of_kind(kind) for kind, (title, _) in KINDS.items()}
    for title, names in (groups | {"Beside the claims: demonstrations": DEMONSTRATIONS}).items():
        parts += [f"## {title}", *(_claim(record, name) for name in names)]
    return "\n\n".join(parts) + "\n"


def front(record):
    """What was found, as HTML for the first page. record: see `headline`."""
    return f'<p class="result">{headline(record)}</p>\n'


def squares(record, build):
    """The strips of claims, the meaning of their symbols, and how a build compares, as HTML for the first page."""
    legend = " · ".join(f"{marks.html(verdict)}\u00a0{marks.explained(verdict)}" for verdict in counts(record, CLAIMS))
    strips = [strip(record, some, "claims.html") for some in (AGENTS, APART)]
    return "\n".join([*strips, f"<p>{legend}</p>", f"<p>{beside(record, build)}</p>" * (build is not record)]) + "\n"


def headline(record):
    """What was found, in a few sentences. record: as `report.load` returns it, or committed."""
    by_verdict = counts(record, AGENTS)
    if not {*by_verdict} - {"no verdict", report.NOT_COMPUTED}:
        return (f"This book judges the thesis’s {len(AGENTS)} claims about agents. Verdicts need {RUNS_FOR_A_VERDICT} "
                "runs of each condition, and this build has fewer.")
    held = {name for name in AGENTS if report.verdict(record, name) == "reproduced"}
    fitted, others = ([name for name in AGENTS if (name in FITTED) == used] for used in (True, False))
    letter, book = TO_THE_LETTER.choices, Reading().choices
    departing = sum(book[name] != letter[name] for name in WITHIN)
    to_the_letter = counts({"claims": record["letter"]}, AGENTS).get("reproduced", 0)
    return (f"Of the thesis’s {len(AGENTS)} claims about agents, {_listed(by_verdict)} ({runs(record)} runs of each "
            f"condition). {len(fitted)} of the {len(AGENTS)} were used to choose the reading, in which "
            f"{departing} of {len(WITHIN)} open choices depart from the letter: {len(held & {*fitted})} of these "
            f"{len(fitted)} claims and {len(held & {*others})} of the other {len(others)} are reproduced. To the "
            f"letter: {to_the_letter} reproduced. {_apart(record)}")


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


def counts(record, names):
    """The number of some claims with each verdict: {verdict: count}, without verdicts that none has."""
    found = Counter(report.verdict(record, name) for name in names)
    return {verdict: found[verdict] for verdict in marks.MARKS if found[verdict]}


def runs(record):
    """The number of runs of most claims about agents, 0 if none was judged."""
    found = Counter(record["claims"][name]["runs"] for name in AGENTS if name in record["claims"]).most_common(1)
    return found[0][0] if found else 0


def tally(record, names, what):
    """The number of some claims with each verdict, as a line of Markdown. what: they are."""
    return f"{len(names)} {what}: " + " · ".join(f"{marks.html(verdict)} {count} {marks.explained(verdict)}"
                                                 for verdict, count in counts(record, names).items()) + "."


def strip(record, names, address=""):
    """An HTML list with a square for each of some claims, its symbol in its colour, that links to the claim.

    address: of the page of claims, relative to the page with the strip.
    """
    squares = []
    for name in names:
        verdict = report.verdict(record, name)
        mark, text = marks.MARKS[verdict], escape(f"{name}, {verdict}: {STATEMENTS[name].text}")
        squares.append(f'<li><a class="{mark.css}" href="{address}#{anchor(name)}" title="{text}" aria-label="{text}">'
                       f"{name}<span>{mark.symbol}</span></a></li>")
    return f'<ul class="claims-strip" aria-label="Verdict of each claim">{"".join(squares)}</ul>'


def _of_kind(kind):
    return [name for name in APART if STATEMENTS[name].kind == kind]


def _apart(record):
    """The verdicts on the claims that are not about agents, in a sentence."""
    groups = {}
    for kind, (_, words) in KINDS.items():
        for name in _of_kind(kind):
            groups.setdefault((words, report.verdict(record, name)), []).append(name)
    parts = [f"{', '.join(names)}{words} {verdict}" for (words, verdict), names in groups.items()]
    return f"Counted apart: {'; '.join(parts)}."


def _listed(by_verdict):
    """Counts in words: "11 are reproduced, 4 partly and 3 undecided"."""
    parts = [f"{count} {verdict}" for verdict, count in by_verdict.items()]
    first, *between = parts[:-1] or parts
    count, verdict = first.split(" ", 1)
    listed = ", ".join([f"{count} {'is' if count == '1' else 'are'} {verdict}", *between])
    return listed + f" and {parts[-1]}" * (len(parts) > 1)


def _claim(record, name):
    """A claim in a line, which opens to the sentence that is judged and all that its verdict rests on."""
    statement, found, verdict = STATEMENTS[name], record["claims"].get(name), report.verdict(record, name)
    numbers = f"Thesis: {escape(statement.thesis)}" + (f" · Here: {report.number(found)}" if found else "")
    reason = f" <small>{marks.REASONS[verdict]}</small>" if verdict in marks.REASONS else ""
    cells = [f"<b>{name}</b>", f"{escape(statement.text)} <small>{numbers}</small>",
             f"{marks.html(verdict)}\u00a0{verdict}{reason}"]
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
        parts.append(wording.table(["Agree, in long runs", *SHARES.values()],
                                   [[agrees, *(_share(share[each], share["readings"]) for each in SHARES)]]))
    return parts


def _share(count, total):
    """A count of a total, from 20 on as a percentage, as text."""
    return f"{count} of {total}" if total < 20 else f"{100 * count / total:.0f}\u00a0% of {total}"
