"""Sphinx extension: the buttons that lead to the repository, and to its notebooks on Binder and Colab.

``Repository`` in pyproject.toml's ``[project.urls]`` is their only setting, shared with the package's metadata;
without it there are no buttons. The book shows notebooks as computed, in chapters/; readers run the originals,
in notebooks/, and the button to download a page gives them these too.
"""

import shutil
import tomllib
from pathlib import Path

ASKED = "% The repository is at <URL>."
UNNAMED = ("This copy of the book was built without the address of its repository: ask the person who gave it to "
           "you. The explorer runs every agent without an installation, on a phone, too.")
CLONE, FOR_URL = "git clone --depth 1 URL", ", with the address of the repository for `URL`"


def setup(app):
    app.connect("config-inited", follow_setting, priority=400)  # before the theme reads its options
    app.connect("source-read", name_repository)
    app.connect("html-page-context", lead_to_notebooks, priority=502)  # after the theme has made its buttons
    app.connect("build-finished", offer_notebooks)
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def follow_setting(app, config):
    """Show buttons if there is a repository, and none if there is not."""
    options, address = config.html_theme_options, repository(app)
    if address:
        options |= {"repository_url": address, "use_repository_button": True}
    else:
        options.pop("launch_buttons", None)


def name_repository(app, page, source):
    """Fill in the address that a page asks for, in a comment and in its commands, or say that there is none."""
    address = repository(app)
    source[0] = source[0].replace(ASKED, f"The repository is at <{address}>." if address else UNNAMED)
    if address:
        source[0] = source[0].replace(FOR_URL, "").replace(CLONE, CLONE.replace("URL", address))


def repository(app):
    """The address that is set, or None."""
    project = tomllib.loads((Path(app.srcdir).parent / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    return project.get("urls", {}).get("Repository")


def lead_to_notebooks(app, page, template, context, doctree):
    """Make the buttons of a computed notebook open the one that it was computed from."""
    for group in context.get("header_buttons", []):
        for button in group.get("buttons", []):
            if group.get("label") == "launch-buttons":
                button["url"] = button["url"].replace("book/chapters/", "notebooks/")


def offer_notebooks(app, exception):
    """Offer for download the notebook that a page was computed from, which runs from top to bottom."""
    for page in (Path(app.outdir) / "_sources" / "chapters").glob("*.ipynb"):
        notebook = Path(app.srcdir).parent / "notebooks" / page.name
        if notebook.exists():
            shutil.copy(notebook, page)
