"""The table of contents in pictures: the first figure of each computed page, with the title of the page, as a grid."""

import re

import nbformat


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
        figure = f"{shown.get('figure', {}).get('name')}-small.svg"
        if (chapters / figure).exists():
            return "\n".join([":::{grid-item-card}", f":link: chapters/{name}", ":link-type: doc",
                              f":img-top: chapters/{figure}", f":img-alt: {shown['image']['alt']}", "", title, ":::"])
    return ""
