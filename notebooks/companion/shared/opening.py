"""The box *What was found*, in Markdown: the verdict on each claim of a page, with its symbol.

With too few runs for verdicts, or too short ones, the box says so instead.
"""

from html import escape

from companion.shared.marks import explained, html
from companion.thesis.statements import AGENTS, CLAIMS, STATEMENTS
from companion.thesis.verdict import RUNS_FOR_A_VERDICT, VERDICTS

CLAIMS_PAGE = "../book/claims.md"  # from a notebook; the build makes it the built page


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

    Claims that are not about agents follow the others, and then demonstrations.
    """
    groups = {"": [], "Counted apart: ": [], "Beside the claims: ": []}
    for title, some in zip(groups, (AGENTS, CLAIMS, STATEMENTS)):
        of_group = {name: found.pop(name) for name in [*found] if name in some}
        for verdict in sorted({*of_group.values()}, key=VERDICTS.index):
            names = ", ".join(link(name) for name, each in of_group.items() if each == verdict)
            groups[title].append(f"{html(verdict)}\u00a0{names} {explained(verdict)}")
    lines = [f"{title}{'; '.join(verdicts)}" for title, verdicts in groups.items() if verdicts]
    return f"{reading.capitalize()}{': ' if reading else ''}{'. '.join(lines)}"


def link(name, page=CLAIMS_PAGE):
    """The name of a claim as a link to its row on the page of claims, with its text as the link's title."""
    return f'<a href="{page}#{anchor(name)}" title="{escape(STATEMENTS[name].text)}">{name}</a>'


def anchor(name):
    """The fragment of the URL of a claim's row."""
    return f"claim-{name.lower()}"
