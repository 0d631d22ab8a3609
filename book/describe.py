"""Sphinx extension: metadata of pages for search engines, shared links and screen readers.

The description of a page is its first paragraph, shortened, and its picture for shared links is the book's card.
Accessible names and roles that the theme or other extensions omit or get wrong are corrected, and so are the places
where names and numbers may break.
"""

import html
import re
import textwrap
from pathlib import Path

from docutils import nodes

LONGEST = 200  # characters; more is cut off where descriptions are shown
CARD = "card.png"
NAMELESS = re.compile(r"<summary>(?=<span class=\"toctree-toggle\")")


def breakable(found):
    """A name that has been found, as HTML that may break between its parts."""
    return re.sub(r"(?<=[._])(?=\w)", "<wbr>", found[0])


IN_BODIES = (
    # A fold is named by its own text.
    (r'<summary aria-label="Toggle hidden content">', "<summary>"),
    # Entries of the bibliography are items of a list; their special role is deprecated.
    (r'role="doc-biblioentry"', 'role="listitem"'),
    # The empty corner of a table is not a header.
    (r"<th([^>]*)>\s*(?:<p></p>)?\s*</th>", r"<td\1></td>"),
    # A per cent sign stays on the line of its number; code is left as it is.
    (r"(?s)<pre.*?</pre>|(?<=\d) (?=%)", lambda found: "\u00a0" if found[0] == " " else found[0]),
    # A mark of punctuation stays on the line of the formula before it.
    (r'(<span class="math notranslate nohighlight">[^<]*</span>[.,;:?!)’]+)', r'<span class="unbroken">\1</span>'),
    # A long name breaks between its parts.
    (r'(?<=<span class="pre">)neorl\.[\w.]+', breakable))
IN_PAGES = (
    # So does one in the index, whether at the end of an entry or as the whole of it.
    (r'(?<=[( ]|>)neorl\.[\w.]+(?=[^<>]*\)</a>|</code></a></td>)', breakable),
    # The button is named by its own text, including the keys.
    (r'(<button class="btn search-button-field [^>]*?) aria-label="Search"', r"\1"),
    # Every part of a page lies in a landmark.
    (r'(<div id="pst-primary-sidebar" class="bd-sidebar-primary bd-sidebar[^"]*")>',
     r'\1 role="complementary" aria-label="Book">'))


def setup(app):
    app.connect("html-page-context", describe, priority=503)  # after the theme has made its functions
    app.connect("build-finished", finish)
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def describe(app, page, template, context, doctree):
    """Add metadata to the head of a page, and correct names and roles in its body and its sidebar."""
    if doctree is not None:
        address = app.config.html_baseurl.rstrip("/") or context["content_root"].rstrip("/")
        context["metatags"] = context.get("metatags", "") + tags(context.get("title", ""), description(doctree),
                                                                 f"{address}/_static/{CARD}")
    make = context.get("generate_toctree_html")
    if make:
        context["generate_toctree_html"] = lambda kind, **choices: named(make(kind, **choices))
    if "body" in context:
        context["body"] = mended(context["body"], IN_BODIES)
    if page == "genindex":
        context["genindexentries"] = without_modules(context["genindexentries"])


def without_modules(index):
    """The index, [(letter, [(name, (links, parts, key)), …]), …], without modules, which have an index of their own."""
    kept = [(letter, [(name, entry) for name, entry in entries
                      if entry[0] or name != "module" and [part for part, _ in entry[1]] != ["module"]])
            for letter, entries in index]
    return [(letter, entries) for letter, entries in kept if entries]


def description(doctree):
    """The first paragraph of a page as plain text of at most `LONGEST` characters, "" without one."""
    texts = (" ".join(each.astext().split()) for each in doctree.findall(nodes.paragraph))
    return textwrap.shorten(next(filter(None, texts), ""), LONGEST, placeholder=" …")


def tags(title, text, card):
    """The meta tags for a title, a description, and the address of a picture."""
    title, text = (html.escape(re.sub(r"<[^>]+>", "", each)) for each in (html.unescape(title), text))
    written = f'<meta name="description" content="{text}" />\n<meta property="og:description" content="{text}" />\n'
    return (f'\n<meta property="og:title" content="{title}" />\n<meta property="og:type" content="article" />\n'
            f'<meta property="og:image" content="{card}" />\n'
            f'<meta name="twitter:card" content="summary_large_image" />\n{written if text else ""}')


def named(sidebar):
    """A table of contents as HTML, with a name for each summary that has none."""
    return NAMELESS.sub('<summary aria-label="Pages of this part">', str(sidebar))


def mended(text, changes):
    """HTML after changes, each a pair of a pattern and its replacement."""
    for pattern, new in changes:
        text = re.sub(pattern, new, text)
    return text


def finish(app, error):
    """Correct what lies outside the bodies of pages."""
    if error or app.builder.format != "html":
        return
    for path in Path(app.outdir).rglob("*.html"):
        text = path.read_text(encoding="utf-8")
        path.write_text(mended(text, IN_PAGES), encoding="utf-8")
