"""A page with nothing but Explorers and the host that runs them, and what its reader does."""

import json
from pathlib import Path

from computing.excerpts import WIDGET_STATE, WIDGET_VIEW, script
from ipywidgets.embed import dependency_state, embed_data

BOOK = Path(__file__).parent.parent / "book"


def write_page(folder, explorers, change=None):
    """Write page.html into a folder. `change` may alter the stored record of the first Explorer."""
    data = embed_data(explorers, state=dependency_state(explorers, drop_defaults=False))  # not those of other tests
    state = json.loads(json.dumps(data["manager_state"], sort_keys=True))  # as in stored notebooks
    if change:
        change(state["state"][explorers[0].model_id])
    body = "\n".join([script(WIDGET_STATE, state), *(script(WIDGET_VIEW, view) for view in data["view_specs"])])
    (folder / "page.html").write_text(f'<!doctype html><meta charset="utf-8"><link rel="icon" href="data:,">'
                                      f'<body style="width: 700px">{body}<script src="widgets.js"></script>')
    (folder / "widgets.js").write_text((BOOK / "vendor" / "widgets.js").read_text())


def explorer_of(page, state="paused|running|ended"):
    explorer = page.locator(".neorl-explorer").first
    wait(page, state)
    return explorer


def wait(page, state):
    page.wait_for_function("""wanted => wanted.split("|").includes(
        document.querySelector(".neorl-explorer")?.dataset.state)""", arg=state)


def wait_for_score(page, steps, score):
    """Wait until a run has come to a step with a score."""
    page.wait_for_function("""([wanted, reward]) => {
        const { step, score } = document.querySelector(".neorl-explorer").dataset;
        return Number(step) === wanted && Number(score) === reward;
    }""", arg=[steps, float(score)])


def keep_states(page):
    """Let the page keep in `window.states` each state that its widget has from now on, however soon it passes."""
    page.evaluate("""() => {
        const widget = document.querySelector(".neorl-explorer");
        window.states = [];
        new MutationObserver(() => window.states.push(widget.dataset.state)).observe(
            widget, { attributeFilter: ["data-state"] });
    }""")


def wait_for_states(page, *states):
    """Wait until the last of these states is that of the widget, which has had the others since `keep_states`."""
    page.wait_for_function("""states => states.every((each) => window.states.includes(each))
        && window.states.at(-1) === states.at(-1)""", arg=states)


def wait_for_maps(page, names):
    page.wait_for_function("""names => names.join() ===
        Array.from(document.querySelector('[name="map"]').options, (option) => option.value).join()""", arg=names)


def picture(page, canvas=".arena canvas"):
    """What a canvas shows once all is drawn that the page has been told to draw.

    What the page asks of its worker it is told later: the data attributes of the Explorer say when.
    """
    return page.locator(canvas).evaluate(
        "canvas => new Promise((take) => requestAnimationFrame(() => take(canvas.toDataURL())))")


# The pixels of a canvas that have one of these colours, by name, each red, green and blue, at whatever opacity.
COUNT = """(canvas, colours) => new Promise((take) => requestAnimationFrame(() => {
    const copy = Object.assign(document.createElement("canvas"), { width: canvas.width, height: canvas.height });
    const context = copy.getContext("2d", { willReadFrequently: true });
    context.drawImage(canvas, 0, 0);
    const { data } = context.getImageData(0, 0, copy.width, copy.height);
    const counts = Object.fromEntries(Object.keys(colours).map((name) => [name, 0]));
    for (let at = 0; at < data.length; at += 4) {
        for (const [name, colour] of Object.entries(colours)) {
            counts[name] += data[at + 3] > 100 && colour.every((part, i) => Math.abs(part - data[at + i]) < 6);
        }
    }
    take(counts);
}))"""
COLOURS = {"agent": [0x3b, 0x8a, 0xd9], "green": [0x12, 0x94, 0x6d], "red": [0xd9, 0x62, 0x2b]}


def coloured(canvas, **colours):
    """The numbers of pixels of a canvas, a locator, in the colours of the agent and the creeps, or in others."""
    return canvas.evaluate(COUNT, colours or COLOURS)


def wait_for_frame_in_flight(page):
    """Choose a cell, and wait for that: the worker answers in order, so a frame requested before has then arrived."""
    page.locator(".arena canvas").first.press("Enter")
    page.wait_for_function("document.querySelector('.neorl-explorer').dataset.goal !== ''")


def press(page, action):
    """Press a button, and unfold the others before if it is one of them."""
    button = page.locator(f'.neorl-explorer [data-action="{action}"]').first
    if not button.is_visible():
        unfold(page)
    button.click()


def unfold(page):
    page.locator(".neorl-explorer details").first.evaluate("folded => { folded.open = true; }")


def drop_by_keyboard(page):
    page.locator('[data-action="drop"]').press("Enter")


def play_to_the_end(page):
    press(page, "play")
    wait(page, "ended")
    return float(page.locator(".neorl-explorer").first.get_attribute("data-score"))
