"""Sphinx extension: what a page says of itself, to search engines, to shared links and to screen readers.

The description of a page is its first paragraph, shortened. Summaries that open a part of the sidebar get a name,
which the theme leaves out.
"""

import html
import re
import textwrap

from docutils import nodes

LONGEST = 200  # characters; more is cut off where descriptions are shown
NAMELESS = re.compile(r"<summary>(?=<span class=\"toctree-toggle\")")


def setup(app):
    app.connect("html-page-context", describe, priority=503)  # after the theme has made its functions
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def describe(app, page, template, context, doctree):
    """Add the description of a page to its head, and names to the summaries of its sidebar."""
    if doctree is not None:
        context["metatags"] = context.get("metatags", "") + tags(context.get("title", ""), description(doctree))
    make = context.get("generate_toctree_html")
    if make:
        context["generate_toctree_html"] = lambda kind, **choices: named(make(kind, **choices))


def description(doctree):
    """The first paragraph of a page as plain text of at most `LONGEST` characters, "" without one."""
    texts = (" ".join(each.astext().split()) for each in doctree.findall(nodes.paragraph))
    return textwrap.shorten(next(filter(None, texts), ""), LONGEST, placeholder=" …")


def tags(title, text):
    """The tags that a head has for a title and a description."""
    title, text = (html.escape(re.sub(r"<[^>]+>", "", each)) for each in (html.unescape(title), text))
    written = f'<meta name="description" content="{text}" />\n<meta property="og:description" content="{text}" />\n'
    return f'\n<meta property="og:title" content="{title}" />\n{written if text else ""}'


def named(sidebar):
    """A table of contents as HTML, with a name for each summary that has none."""
    return NAMELESS.sub('<summary aria-label="Pages of this part">', str(sidebar))
