"""What JupyterLab saves of a page: its source, so that running and viewing it changes no file that git has.

`make lab` names `keep_source` as the hook that Jupyter calls before it saves a notebook. Outputs stay in the open
notebook. A notebook that git does not have is saved with them.
"""

import subprocess
from pathlib import Path

import nbformat

PAGES = Path(__file__).resolve().parents[2]
METADATA = "mystnb", "tags", "widget"  # of cells; all else belongs to a view or a run


def keep_source(model, path, contents_manager, **_):
    """Remove from the content of a page, which is about to be saved, what running and viewing have added.

    model, path, contents_manager: those of Jupyter's ``ContentsManager.pre_save_hook``.
    """
    file = Path(contents_manager.root_dir, path.strip("/")).resolve()
    if model["type"] != "notebook" or file.parent != PAGES or (committed := _committed(file)) is None:
        return
    content = model["content"]
    folded = {cell.id: cell.metadata.jupyter for cell in committed.cells if "jupyter" in cell.metadata}
    for cell in content["cells"]:
        kept = {name: value for name, value in cell["metadata"].items() if name in METADATA}
        cell["metadata"] = kept | ({"jupyter": folded[cell["id"]]} if cell["id"] in folded else {})
        if cell["cell_type"] == "code":
            cell["outputs"], cell["execution_count"] = [], None
    content.update({name: value for name, value in committed.items() if name != "cells"})


def _committed(file):
    """The notebook as git has it, or None."""
    shown = subprocess.run(["git", "show", f":./{file.name}"], cwd=file.parent, capture_output=True)
    return None if shown.returncode else nbformat.reads(shown.stdout.decode(), 4)
