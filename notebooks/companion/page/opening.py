"""Claims by their names, which lead to their rows on the page of claims, and boxes of text, in Markdown."""

from html import escape

from companion.thesis.statements import STATEMENTS

CLAIMS_PAGE = "../book/claims.md"  # from a notebook; the build makes it the built page


def box(*paragraphs):
    """A box of paragraphs, in Markdown; empty ones are left out."""
    # A blank line ends the HTML, so that the text between the two tags is parsed as Markdown.
    return "\n\n".join(['<div class="found">', *filter(None, paragraphs), "</div>"])


def link(name, page=CLAIMS_PAGE):
    """The name of a claim as a link to its row on the page of claims, with its text as the link's title."""
    return f'<a href="{page}#{anchor(name)}" title="{escape(STATEMENTS[name].text)}">{name}</a>'


def anchor(name):
    """The fragment of the URL of a claim's row."""
    return f"claim-{name.lower()}"
