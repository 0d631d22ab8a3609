"""The table of contents in pictures: the title of each computed page, its first figure, a question and its answer.

The question is the first sentence of the figure's caption, and says what the eye can find in the picture. The answer is
the recorded one, on pages that have claims.
"""

import re

import nbformat
from companion.page import recorded, report

MOST_BYTES = 40_000  # of a picture


def pictures(toc, chapters):
    """A grid of cards in MyST Markdown, one for each computed page that has a figure, in the order of the contents.

    toc: the text of the table of contents. chapters: the folder of the computed pages and of their figures.
    """
    grid = ["::::{grid} 2 2 3 4", ":gutter: 2", ":class-container: pictures", ""]
    cards = (card(name, nbformat.read(chapters / f"{name}.ipynb", 4), chapters)
             for name in re.findall(r"file: chapters/(\w+)", toc) if (chapters / f"{name}.ipynb").exists())
    return "\n".join([*grid, *filter(None, cards), "::::", ""])


def card(name, page, chapters):
    """The card of a page, or "" if the page has no figure."""
    title = re.match(r"# (.+)", page.cells[0].source)[1]
    for cell in page.cells:
        shown = cell.metadata.get("mystnb", {})
        figure = chapters / f"{shown.get('figure', {}).get('name')}-small.svg"
        if figure.exists():
            picture = [f":img-top: chapters/{figure.name}", f":img-alt: {shown['image']['alt']}"]
            return "\n".join([":::{grid-item-card}", f":link: chapters/{name}", ":link-type: doc",
                              *(picture if figure.stat().st_size <= MOST_BYTES else []), "", f"**{title}**", "",
                              question(shown["figure"]["caption"]), "", answer(name), ":::"])
    return ""


def answer(page):
    """The recorded answer of a page, "" if it has no claims."""
    return recorded.sentence(report.record(), recorded.SHOWN.get(page, ()))


def question(caption):
    """The first sentence of a caption, without its links and terms."""
    text = re.sub(r"\{\w+\}`([^`<]+?)(?: <[^>]*>)?`|\[([^]]+)\]\([^)]*\)", lambda link: link[1] or link[2], caption)
    return re.match(r".+?[.?!](?=\s|$)", text)[0]
