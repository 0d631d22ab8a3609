"""The box that opens a page of the book, *What was found*, in Markdown: verdicts with symbols, and a few sentences.

The box stands at the top of its page, before all evidence, so it states what a figure cannot: which claims hold, and
the numbers to remember. With too few runs for verdicts it says so instead.
"""

from html import escape

from lib.shared.marks import html
from neorl.evidence.statements import STATEMENTS
from neorl.evidence.verdict import RUNS_FOR_A_VERDICT, VERDICTS

CLAIMS_PAGE = "../book/claims.md"  # from a notebook; the build makes it the built page
REASONS = {"not testable": ", because the agents learned too little"}


def what_was_found(sentences, runs, verdicts=None):
    """The box of a page.

    sentences: Markdown with computed numbers. runs: of each condition, the parameter of the page. verdicts: {reading:
    {name of a claim: its verdict}}, a line for each reading, whose name may be empty; None if the page judges no claim.
    """
    lines = ["**What was found**"]
    if runs >= RUNS_FOR_A_VERDICT:
        lines += [_line(reading, found) for reading, found in (verdicts or {}).items()]
    elif verdicts:
        lines.append(f"**Quick look: no verdicts.** A verdict needs {RUNS_FOR_A_VERDICT} runs of each condition; this "
                     f"page was computed with {runs}.")
    else:
        lines.append(f"**Quick look.** This page was computed with few runs of each condition, {runs} at most.")
    # A blank line ends the HTML, so that the text between the two tags is parsed as Markdown.
    return "\n\n".join(['<div class="found">', *lines, sentences, "</div>"])


def found(judged, runs):
    """The box of a page whose numbers stand in its tables: verdicts alone.

    judged: {reading: [Claim, …]}. runs: of each condition, the parameter of the page.
    """
    return what_was_found("", runs, verdicts_of(judged))


def verdicts_of(judged):
    """The verdicts on claims, {reading: {name: verdict}}. judged: {reading: [Claim, …]}."""
    return {reading: {claim.name: claim.verdict for claim in claims} for reading, claims in judged.items()}


def _line(reading, found):
    """One reading's verdicts, each with the claims that have it: "Calibrated: ● A2, A7 reproduced; ◐ A3 partly".

    Demonstrations follow the claims.
    """
    groups = []
    for demonstration, verdict in sorted({(STATEMENTS[name].demonstration, each) for name, each in found.items()},
                                         key=lambda group: (group[0], VERDICTS.index(group[1]))):
        names = [_link(name) for name, each in found.items()
                 if (STATEMENTS[name].demonstration, each) == (demonstration, verdict)]
        beside = "beside the claims, " if demonstration else ""
        groups.append(f"{beside}{html(verdict)}\u00a0{', '.join(names)} {verdict}{REASONS.get(verdict, '')}")
    return f"{reading.capitalize()}{': ' if reading else ''}{'; '.join(groups)}"


def _link(name):
    """The name of a claim as a link to its row on the page of claims, with its text as the link's title."""
    return f'<a href="{CLAIMS_PAGE}#{anchor(name)}" title="{escape(STATEMENTS[name].text)}">{name}</a>'


def anchor(name):
    """The fragment of the URL of a claim's row."""
    return f"claim-{name.lower()}"
