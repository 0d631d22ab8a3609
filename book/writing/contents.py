"""The table of contents in pictures: the title of each computed page, its first figure, and a sentence.

It is the first of the page's recorded answer, or else of the figure's caption, which asks what the eye can find there.
"""

import re

import nbformat
from companion.page import answers

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
                              first(answers.answer(name)) or first(shown["figure"]["caption"]), ":::"])
    return ""


def first(text):
    """The first sentence of Markdown, without its links and terms; "" of none."""
    text = re.sub(r"\{\w+\}`([^`<]+?)(?: <[^>]*>)?`|\[([^]]+)\]\([^)]*\)", lambda link: link[1] or link[2], text)
    found = re.match(r".+?[.?!](?=\s|$)", text)
    return found[0] if found else ""
