"""Sphinx extension: the contents in the sidebar are made from the titles of pages alone.

Sphinx makes them for each page, and for each listing of a module. Of every page it then copies all headings and all
documented names, only to remove them again, which took half of the time of building the pages.
"""

import copy

from docutils import nodes
from sphinx.addnodes import toctree
from sphinx.environment.adapters.toctree import global_toctree_for_doc


def setup(app):
    app.connect("env-updated", keep_titles)
    app.connect("html-page-context", use_titles, priority=400)  # before the theme draws the sidebar
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def keep_titles(app, env):
    """Keep, besides the environment, a copy of it in which the contents of a page are its title and its subpages."""
    app.titles = copy.copy(env)
    app.titles.tocs = {page: titles(contents) for page, contents in env.tocs.items()}


def titles(contents):
    """The contents of a page, a bullet list of one item, without its headings and documented names."""
    alone = contents.deepcopy()
    for item in alone.children:
        subpages = [each for listed in item.children[1:] for each in listed.findall(toctree)]
        item.children[1:] = [nodes.bullet_list("", *subpages)] if subpages else []
    return alone


def use_titles(app, page, template, context, doctree):
    """Make the theme's function ``toctree`` of a page read titles alone."""
    def contents(**choices):
        return app.builder.render_partial(global_toctree_for_doc(app.titles, page, app.builder, **choices))["fragment"]

    context["toctree"] = contents
