"""Sphinx extension: a link to a term of the glossary shows the term's definition when it is pointed at."""

import functools
import textwrap

from docutils import nodes
from sphinx import addnodes

GLOSSARY = "glossary"  # the page
LONGEST = 240  # characters; more is cut off


def setup(app):
    app.connect("doctree-resolved", define)
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def define(app, doctree, page):
    """Add the definition of its term to each link into the glossary."""
    known = definitions(app.env)
    for link in doctree.findall(nodes.reference):
        if text := known.get(link.get("refid") or link.get("refuri", "").partition(f"{GLOSSARY}.html#")[2]):
            link["reftitle"] = text


@functools.cache
def definitions(env):
    """The definitions of all terms, as plain text: {the term's id: text}. env: of the build, read once."""
    found = {}
    for listed in env.get_doctree(GLOSSARY).findall(addnodes.glossary) if GLOSSARY in env.found_docs else ():
        for item in listed.findall(nodes.definition_list_item):
            text = textwrap.shorten(item[-1].astext(), LONGEST, placeholder=" …")
            found |= {name: text for term in item.findall(nodes.term) for name in term["ids"]}
    return found
