"""Sphinx extension: a page loads what it needs, and no more.

1. The theme's icons come from its fonts. The script that draws them a second time, 1.5 MB on every page, is left out.
2. A page without formulas does not load the script that typesets them.
3. Images have their sizes, so that nothing shifts when they arrive, and are loaded lazily.
4. A search over file:// shows titles alone, since a page there cannot fetch excerpts of others.
"""

import re
from pathlib import Path

from docutils import nodes

ICONS = "_static/scripts/fontawesome.js"
IMAGE = re.compile(r'<img (?![^>]*\bloading=)([^>]*?\bsrc="(?:\.\./)*_images/([^"]+)"[^>]*?)(/?)>')
SIZE = re.compile(rb'<svg [^>]*?\bwidth="([\d.]+)pt" height="([\d.]+)pt"')
PIXELS = 96 / 72  # of a point
TITLES_ALONE = 'if (location.protocol === "file:") DOCUMENTATION_OPTIONS.SHOW_SEARCH_SUMMARY = false;'


def setup(app):
    app.connect("html-page-context", lighten, priority=900)  # after all others have added their scripts
    app.connect("build-finished", leave_out_icons)
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def lighten(app, page, template, context, doctree):
    """Remove from a page the scripts that it does not need, and give its images sizes."""
    if page == "search":
        app.add_js_file(None, body=TITLES_ALONE)  # to the list of the context, which the next lines replace
    if doctree is None or not any(doctree.findall(is_math)):
        context["script_files"] = [each for each in context["script_files"] if "mathjax" not in str(each).lower()]
    sources = {name: Path(app.srcdir, path) for path, name in app.builder.images.items()}
    if "body" in context:
        context["body"] = IMAGE.sub(lambda tag: sized(tag, sources), context["body"])


def is_math(node):
    return isinstance(node, nodes.math | nodes.math_block)


def sized(tag, sources):
    """The tag of an image that is loaded lazily, with its drawn size if it is an SVG in points."""
    attributes, name, end = tag.groups()
    found = SIZE.search(sources[name].read_bytes()[:2000]) if name.endswith(".svg") and name in sources else None
    if not found or "width=" in attributes:
        return f'<img loading="lazy" {attributes}{end}>'
    width, height = (round(float(each) * PIXELS) for each in found.groups())
    return f'<img loading="lazy" width="{width}" height="{height}" {attributes}{end}>'


def leave_out_icons(app, error):
    """Remove the theme's icon script from the built pages."""
    if error or app.builder.format != "html":
        return
    for path in Path(app.outdir).rglob("*.html"):
        text = path.read_text(encoding="utf-8")
        lighter = re.sub(rf'\s*<script src="[^"]*{re.escape(ICONS)}[^"]*"></script>', "", text)
        if lighter != text:
            path.write_text(lighter, encoding="utf-8")
    for path in Path(app.outdir, ICONS).parent.glob("fontawesome.js*"):
        path.unlink()
