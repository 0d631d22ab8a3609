"""Sphinx extension: what a page says of itself, to search engines, to shared links and to screen readers.

The description of a page is its first paragraph, shortened, and its picture for shared links is the book's card.
Names and roles that the theme, or those who write HTML for it, leave out or get wrong are put right.
"""

import html
import re
import textwrap
from pathlib import Path

from docutils import nodes

LONGEST = 200  # characters; more is cut off where descriptions are shown
CARD = "card.png"
NAMELESS = re.compile(r"<summary>(?=<span class=\"toctree-toggle\")")
IN_BODIES = (
    # A fold's name is what stands on it.
    (r'<summary aria-label="Toggle hidden content">', "<summary>"),
    # Entries of a list are its items; their own role is deprecated.
    (r'role="doc-biblioentry"', 'role="listitem"'),
    # The corner of a table is no header.
    (r"<th([^>]*)>\s*(?:<p></p>)?\s*</th>", r"<td\1></td>"))
IN_PAGES = (
    # The button's name is what stands on it, the keys included.
    (r'(<button class="btn search-button-field [^>]*?) aria-label="Search"', r"\1"),
    # All of a page lies in a landmark.
    (r'(<div id="pst-primary-sidebar" class="bd-sidebar-primary bd-sidebar[^"]*")>',
     r'\1 role="complementary" aria-label="Book">'))


def setup(app):
    app.connect("html-page-context", describe, priority=503)  # after the theme has made its functions
    app.connect("build-finished", finish)
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def describe(app, page, template, context, doctree):
    """Add the description of a page to its head, and names and roles to its body and its sidebar."""
    if doctree is not None:
        address = app.config.html_baseurl.rstrip("/") or context["content_root"].rstrip("/")
        context["metatags"] = context.get("metatags", "") + tags(context.get("title", ""), description(doctree),
                                                                 f"{address}/_static/{CARD}")
    make = context.get("generate_toctree_html")
    if make:
        context["generate_toctree_html"] = lambda kind, **choices: named(make(kind, **choices))
    if "body" in context:
        context["body"] = mended(context["body"], IN_BODIES)


def description(doctree):
    """The first paragraph of a page as plain text of at most `LONGEST` characters, "" without one."""
    texts = (" ".join(each.astext().split()) for each in doctree.findall(nodes.paragraph))
    return textwrap.shorten(next(filter(None, texts), ""), LONGEST, placeholder=" …")


def tags(title, text, card):
    """The tags that a head has for a title, a description, and the address of a picture."""
    title, text = (html.escape(re.sub(r"<[^>]+>", "", each)) for each in (html.unescape(title), text))
    written = f'<meta name="description" content="{text}" />\n<meta property="og:description" content="{text}" />\n'
    return (f'\n<meta property="og:title" content="{title}" />\n<meta property="og:type" content="article" />\n'
            f'<meta property="og:image" content="{card}" />\n'
            f'<meta name="twitter:card" content="summary_large_image" />\n{written if text else ""}')


def named(sidebar):
    """A table of contents as HTML, with a name for each summary that has none."""
    return NAMELESS.sub('<summary aria-label="Pages of this part">', str(sidebar))


def mended(text, changes):
    """HTML with changes, pairs of a pattern and what takes its place."""
    for pattern, new in changes:
        text = re.sub(pattern, new, text)
    return text


def finish(app, error):
    """Put right what lies outside the bodies of pages."""
    if error or app.builder.format != "html":
        return
    for path in Path(app.outdir).rglob("*.html"):
        text = path.read_text(encoding="utf-8")
        path.write_text(mended(text, IN_PAGES), encoding="utf-8")
