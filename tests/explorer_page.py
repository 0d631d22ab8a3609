"""A page that holds nothing but Explorers and the host that brings them to life."""

import json
from pathlib import Path

from ipywidgets.embed import embed_data

HOST = Path(__file__).parent.parent / "book" / "vendor" / "widgets.js"


def write_page(folder, explorers, change=None):
    """Write page.html into a folder. `change` may spoil the stored record of the first Explorer."""
    data = embed_data(views=explorers, drop_defaults=False)
    state = json.loads(json.dumps(data["manager_state"], sort_keys=True))  # as notebooks are stored
    if change:
        change(state["state"][explorers[0].model_id])
    scripts = [("state", state), *(("view", view) for view in data["view_specs"])]
    body = "\n".join('<script type="application/vnd.jupyter.widget-{}+json">{}</script>'.format(
        kind, json.dumps(content).replace("<", r"\u003c")) for kind, content in scripts)
    (folder / "page.html").write_text(f'<!doctype html><meta charset="utf-8"><link rel="icon" href="data:,">'
                                      f'<body style="width: 700px">{body}<script src="widgets.js"></script>')
    (folder / "widgets.js").write_text(HOST.read_text())
