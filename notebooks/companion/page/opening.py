"""The box *What was found*, in Markdown: what was found in words, and the verdict on each claim with its symbol.

The words are those of `Statement.finding`, of the claims that have some. With too few runs for verdicts, or too short
ones, the box says so instead.
"""

from html import escape

from companion.page.marks import explained, html
from companion.thesis.reading import NAMES
from companion.thesis.statements import AGENTS, CLAIMS, STATEMENTS
from companion.thesis.verdict import RUNS_FOR_A_VERDICT, VERDICTS

CLAIMS_PAGE = "../book/claims.md"  # from a notebook; the build makes it the built page


def found(claims, reading=""):
    """The box of a page, or "" without claims, a list. reading: of a page, or ""."""
    if not claims:
        return ""
    lines = [in_words({claim.name: claim.here for claim in claims}, NAMES.get(reading, "")),
             _line({claim.name: claim.verdict for claim in claims})]
    runs = min(claim.runs for claim in claims)
    if runs < RUNS_FOR_A_VERDICT or not all(claim.full_length for claim in claims):
        shorter = ", some shorter" * any(not claim.full_length for claim in claims)
        lines = [f"**Quick look: no verdicts.** They need {RUNS_FOR_A_VERDICT} runs of full length; here are "
                 f"{runs}{shorter}."]
    return box("**What was found**", *lines)


def box(*paragraphs):
    """A box of paragraphs, in Markdown; empty ones are left out."""
    # A blank line ends the HTML, so that the text between the two tags is parsed as Markdown.
    return "\n\n".join(['<div class="found">', *filter(None, paragraphs), "</div>"])


def in_words(numbers, reading=""):
    """What was found under a reading, in a sentence; "" if no claim has words for it. numbers: {claim: its number}."""
    words = [STATEMENTS[name].finding.format(here=here) for name, here in numbers.items() if STATEMENTS[name].finding]
    sentence = "; ".join(words).replace("; and ", ", and ")
    text = f"{reading}: {sentence}" if reading and words else sentence
    return f"{text[:1].upper()}{text[1:]}." if words else ""


def _line(found):
    """Verdicts, each with the claims that have it: "● A2, A7 reproduced; ◐ A3 partly".

    Claims that are not about agents follow the others, and then demonstrations.
    """
    groups = {"": AGENTS, "Counted apart: ": CLAIMS, "Beside the claims: ": STATEMENTS}
    lines = [(title, by_verdict({name: found.pop(name) for name in [*found] if name in some}))
             for title, some in groups.items()]
    return ". ".join(f"{title}{verdicts}" for title, verdicts in lines if verdicts)


def by_verdict(found):
    """Claims with their verdicts, {name: verdict}, as "● A2, A7 reproduced; ◐ A3 partly"."""
    return "; ".join(f"{html(verdict)}\u00a0{', '.join(link(name) for name in found if found[name] == verdict)} "
                     f"{explained(verdict)}" for verdict in sorted({*found.values()}, key=VERDICTS.index))


def link(name, page=CLAIMS_PAGE):
    """The name of a claim as a link to its row on the page of claims, with its text as the link's title."""
    return f'<a href="{page}#{anchor(name)}" title="{escape(STATEMENTS[name].text)}">{name}</a>'


def anchor(name):
    """The fragment of the URL of a claim's row."""
    return f"claim-{name.lower()}"
