"""Sphinx extension: how pages look while they load, or without scripts, and where their lines break."""

from pathlib import Path

from docutils import nodes
from sphinx.util.images import get_image_size

MARKS = ".,;:?!)’"
VIEW = '<script type="application/vnd.jupyter.widget-view+json">'
UNSCRIPTED = """<div class="unscripted"><img src="{}" width="480" height="252" loading="lazy"
alt="A board of 7 × 7 cells, each with an arrow towards a goal, and an agent among green and red discs">
<p>A picture of what runs here in a browser with JavaScript.</p></div>
"""


def setup(app):
    app.add_node(nodes.image, override=True, html=(visit_image, None))
    app.connect("doctree-resolved", keep_marks)
    app.connect("html-page-context", lighten, priority=900)  # after all others have added their scripts
    app.connect("html-page-context", picture_widgets)
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def visit_image(translator, node):
    """Load an image when it is about to be seen, into a place of its size."""
    path = Path(translator.builder.srcdir, node["uri"])
    type(translator).visit_image(translator, node)
    size = path.is_file() and "width" not in node and get_image_size(path)
    given = 'width="{}" height="{}" '.format(*size) if size else ""
    translator.body[-1] = translator.body[-1].replace("<img ", f'<img loading="lazy" {given}', 1)


def keep_marks(app, doctree, page):
    """Put each formula in the text and the marks behind it into one element, which does not break (book.css)."""
    for formula in list(doctree.findall(nodes.math)):
        text = formula.next_node(descend=False, siblings=True)
        marks = text[:len(text) - len(text.lstrip(MARKS))] if isinstance(text, nodes.Text) else ""
        if marks:
            formula.parent.replace(text, nodes.Text(text.removeprefix(marks)))
            unbroken = nodes.inline(classes=["unbroken"])
            formula.replace_self(unbroken)
            unbroken += [formula, nodes.Text(marks)]


def lighten(app, page, template, context, doctree):
    """Remove the script for formulas from a page without any; Sphinx leaves it where a page below has some."""
    if doctree is None or not any(doctree.findall(lambda node: isinstance(node, nodes.math | nodes.math_block))):
        context["script_files"] = [each for each in context["script_files"] if "mathjax" not in str(each)]


def picture_widgets(app, page, template, context, doctree):
    """Put a picture and a sentence before each widget, for readers without scripts and on paper (book.css)."""
    if "body" in context:
        picture = UNSCRIPTED.format(context["pathto"]("_static/card.png", 1))
        context["body"] = context["body"].replace(VIEW, picture + VIEW)
