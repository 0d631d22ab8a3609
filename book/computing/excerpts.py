"""Excerpts of a computed notebook for other pages: its named figures and widgets, each saved as a file of its own."""

import json
import re
from xml.etree import ElementTree

WIDGET_STATE = "application/vnd.jupyter.widget-state+json"
WIDGET_VIEW = "application/vnd.jupyter.widget-view+json"
STILL = 'class="neorl-still"'  # of `neorl.browser.figure`
SVG = "http://www.w3.org/2000/svg"
LETTERED = ("text_", "legend_", "matplotlib.axis_")  # parts of matplotlib's figures, by their ids


def save_figures(notebook, folder):
    """Save each named figure as a file of its own, so that other pages can show it, and the first one small too."""
    first = True
    for cell in notebook.cells:
        name = cell.metadata.get("mystnb", {}).get("figure", {}).get("name")
        for output in cell.get("outputs", []):
            image = output.get("data", {}).get("image/svg+xml")
            if name and image:
                (folder / f"{name}.svg").write_text(image)
                if first:
                    (folder / f"{name}-small.svg").write_text(small(image))
                first = False


def without_ground(figure):
    """A figure of matplotlib's, SVG, without its ground, the first patch: the book's style sheet knows the page."""
    return re.sub(r'<g id="patch_1">.*?</g>\s*', "", figure, count=1, flags=re.DOTALL)


def small(figure):
    """A figure of matplotlib's for a small picture: its first panel, cut at the axes, without letters.

    figure: SVG. One in which no axes clip anything keeps its size.
    """
    root = ElementTree.fromstring(figure)
    for parent in list(root.iter()):
        for part in list(parent):
            name = part.get("id", "")
            if name.startswith(LETTERED) or name.startswith("axes_") and name != "axes_1":
                parent.remove(part)
    frame = root.find(f".//{{{SVG}}}clipPath/{{{SVG}}}rect")  # clips what is drawn first
    if frame is not None:
        x, y, width, height = (float(frame.get(each)) for each in ("x", "y", "width", "height"))
        root.set("viewBox", f"{x:g} {y:g} {width:g} {height:g}")
        root.attrib |= {"width": f"{width:g}pt", "height": f"{height:g}pt"}
    for path in root.iterfind(f".//{{{SVG}}}path[@d]"):  # one that draws nothing, as a band of one run, has none
        path.set("d", re.sub(r"\d+\.\d+", lambda number: f"{float(number[0]):.1f}", path.get("d")))
    ElementTree.register_namespace("", SVG)
    return ElementTree.tostring(root, encoding="unicode")


def save_widgets(notebook, folder):
    """Save each named widget as a file of its own, and keep in the notebook only the state of the widgets it shows.

    Still pictures beside widgets are left out: the book has its own, and its widgets live.
    """
    stored = notebook.metadata.get("widgets", {}).get(WIDGET_STATE, {"state": {}})
    kept = {}
    for cell in notebook.cells:
        outputs = [each for each in cell.get("outputs", []) if STILL not in each.get("data", {}).get("text/html", "")]
        if "outputs" in cell:
            cell.outputs = outputs
        name = cell.metadata.get("widget", {}).get("name")
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
