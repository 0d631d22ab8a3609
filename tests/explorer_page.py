"""A page with nothing but Explorers and the host that runs them."""

import json
import sys
from pathlib import Path

from ipywidgets.embed import embed_data

BOOK = Path(__file__).parent.parent / "book"
sys.path.insert(0, str(BOOK))
from excerpts import WIDGET_STATE, WIDGET_VIEW, script  # noqa: E402


def write_page(folder, explorers, change=None):
    """Write page.html into a folder. `change` may alter the stored record of the first Explorer."""
    data = embed_data(views=explorers, drop_defaults=False)
    state = json.loads(json.dumps(data["manager_state"], sort_keys=True))  # as in stored notebooks
    if change:
        change(state["state"][explorers[0].model_id])
    body = "\n".join([script(WIDGET_STATE, state), *(script(WIDGET_VIEW, view) for view in data["view_specs"])])
    (folder / "page.html").write_text(f'<!doctype html><meta charset="utf-8"><link rel="icon" href="data:,">'
                                      f'<body style="width: 700px">{body}<script src="widgets.js"></script>')
    (folder / "widgets.js").write_text((BOOK / "vendor" / "widgets.js").read_text())
