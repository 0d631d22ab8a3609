"""Excerpts of a computed notebook for other pages: its named figures and widgets, each saved as a file of its own."""

import json
import re

WIDGET_STATE = "application/vnd.jupyter.widget-state+json"
WIDGET_VIEW = "application/vnd.jupyter.widget-view+json"


def save_figures(notebook, folder):
    """Save each named figure as a file of its own, so that other pages can show it."""
    for cell in notebook.cells:
        name = cell.metadata.get("mystnb", {}).get("figure", {}).get("name")
        for output in cell.get("outputs", []):
            image = output.get("data", {}).get("image/svg+xml")
            if name and image:
                (folder / f"{name}.svg").write_text(image)


def save_widgets(notebook, folder):
    """Save each named widget as a file of its own, and keep in the notebook only the state of the widgets it shows."""
    stored = notebook.metadata.get("widgets", {}).get(WIDGET_STATE, {"state": {}})
    kept = {}
    for cell in notebook.cells:
        name, outputs = cell.metadata.get("widget", {}).get("name"), cell.get("outputs", [])
        views = [each.data[WIDGET_VIEW] for each in outputs if WIDGET_VIEW in each.get("data", {})]
        if name and len(views) != 1:
            raise ValueError(f"cell of widget {name} must show one widget, but shows {len(views)}")
        for view in views:
            records = reachable(stored["state"], view["model_id"])
            kept.update(records)
            if name:
                tags = [script(WIDGET_STATE, {**stored, "state": records}), script(WIDGET_VIEW, view)]
                (folder / f"{name}.html").write_text("\n".join(tags) + "\n")
    stored["state"] = kept


def reachable(state, model):
    """The records of a model and of all models that it refers to, directly or through others."""
    found, waiting = {}, [model]
    while waiting:
        model = waiting.pop()
        if model in state and model not in found:
            found[model] = state[model]
            waiting += re.findall(r'"(?:IPY_MODEL_|anywidget:)(\w+)"', json.dumps(state[model]["state"]))
    return found


def script(kind, content):
    """A tag that holds JSON. No "<" is left in it, so no string can end the tag."""
    text = json.dumps(content).replace("<", r"\u003c")
    return f'<script type="{kind}">{text}</script>'
