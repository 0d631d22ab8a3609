"""The sidebar's contents (`book/sidebar.py`) are the ones that Sphinx makes of everything that the pages contain."""

import sys
from pathlib import Path

from sphinx.application import Sphinx
from sphinx.environment.adapters.toctree import global_toctree_for_doc

sys.path.insert(0, str(Path(__file__).parents[2] / "book"))
import sidebar  # noqa: E402

PAGES = {
    "index": "# Book\n\n```{toctree}\n:caption: First\none\n```\n\n```{toctree}\n:caption: Second\ntwo\n```\n",
    "one": "# One\n\n## A heading\n\n### And one below it\n",
    "two": "# Two, with *pages* below\n\n## A heading before\n\n```{toctree}\nthree\nfour\n```\n\n## A heading after\n",
    "three": "# Three\n\n```{py:function} three()\n```\n",
    "four": "# Four\n",
}


def test_titles_alone_give_the_same_contents_for_every_page(tmp_path):
    for name, text in PAGES.items():
        (tmp_path / f"{name}.md").write_text(text)
    app = Sphinx(tmp_path, None, tmp_path / "html", tmp_path / "trees", "html", status=None, warning=None,
                 confoverrides={"extensions": ["myst_parser", "sidebar"]})
    app.build()
    choices = {"titles_only": True, "includehidden": True, "maxdepth": 4}
    for page in PAGES:
        whole = global_toctree_for_doc(app.env, page, app.builder, **choices)
        alone = global_toctree_for_doc(app.titles, page, app.builder, **choices)
        assert str(alone) == str(whole)
        assert all(title in alone.astext() for title in ("First", "One", "Second", "Two", "Three", "Four"))
    assert "heading" not in sidebar.titles(app.env.tocs["two"]).astext()
    assert "three()" in app.env.tocs["three"].astext()  # the contents beside a page are as they were
