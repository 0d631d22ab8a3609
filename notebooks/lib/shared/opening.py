"""The box *What was found*, in Markdown: the verdict on each claim of a page, with its symbol.

With too few runs for verdicts, or too short ones, the box says so instead.
"""

from html import escape

from lib.shared.marks import html
from neorl.evidence.statements import STATEMENTS
from neorl.evidence.verdict import RUNS_FOR_A_VERDICT, VERDICTS

CLAIMS_PAGE = "../book/claims.md"  # from a notebook; the build makes it the built page
REASONS = {"not testable": ", because the agents learned too little"}


def found(judged):
    """The box of a page, a line for each reading, or "" without claims. judged: {reading: [Claim, …]}."""
    claims = [claim for claims in judged.values() for claim in claims]
    if not claims:
        return ""
    lines = [_line(reading, {claim.name: claim.verdict for claim in claims}) for reading, claims in judged.items()
             if claims]
    runs = min(claim.runs for claim in claims)
    if runs < RUNS_FOR_A_VERDICT or not all(claim.full_length for claim in claims):
        shorter = ", some shorter" * any(not claim.full_length for claim in claims)
        lines = [f"**Quick look: no verdicts.** They need {RUNS_FOR_A_VERDICT} runs of full length; here are "
                 f"{runs}{shorter}."]
    # A blank line ends the HTML, so that the text between the two tags is parsed as Markdown.
    return "\n\n".join(['<div class="found">', "**What was found**", *lines, "</div>"])


def _line(reading, found):
    """One reading's verdicts, each with the claims that have it: "Calibrated: ● A2, A7 reproduced; ◐ A3 partly".

    Demonstrations follow the claims.
    """
    groups = {False: [], True: []}
    for demonstration, verdict in sorted({(STATEMENTS[name].demonstration, each) for name, each in found.items()},
                                         key=lambda group: (group[0], VERDICTS.index(group[1]))):
        names = [link(name) for name, each in found.items()
                 if (STATEMENTS[name].demonstration, each) == (demonstration, verdict)]
        groups[demonstration].append(f"{html(verdict)}\u00a0{', '.join(names)} {verdict}{REASONS.get(verdict, '')}")
    claims, beside = map("; ".join, groups.values())
    beside = f"Beside the claims: {beside}" if beside else ""
    return f"{reading.capitalize()}{': ' if reading else ''}{'. '.join(filter(None, [claims, beside]))}"


def link(name, page=CLAIMS_PAGE):
    """The name of a claim as a link to its row on the page of claims, with its text as the link's title."""
    return f'<a href="{page}#{anchor(name)}" title="{escape(STATEMENTS[name].text)}">{name}</a>'


def anchor(name):
    """The fragment of the URL of a claim's row."""
    return f"claim-{name.lower()}"
