"""Claims by their names, which lead to their rows on the page of claims, and boxes of text, in Markdown."""

from html import escape

from companion.page.marks import explained, html
from companion.thesis.statements import STATEMENTS
from companion.thesis.verdict import VERDICTS

CLAIMS_PAGE = "../book/claims.md"  # from a notebook; the build makes it the built page


def box(*paragraphs):
    """A box of paragraphs, in Markdown; empty ones are left out."""
    # A blank line ends the HTML, so that the text between the two tags is parsed as Markdown.
    return "\n\n".join(['<div class="found">', *filter(None, paragraphs), "</div>"])


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
