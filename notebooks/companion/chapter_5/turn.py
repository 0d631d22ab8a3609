"""The Turn: a widget that runs, in the page, an agent whose desires change, with learning on or off from there."""

from pathlib import Path

from neorl.browser.explorer import AnyWidget, Explorer, text_of, traitlets

SCRIPTS = ("simulator.js", "drawing.js", "movers.js", "curve.js")


class Turn(AnyWidget):
    """An agent that avoids red creeps for a while and then wants them.

    on, off: two `neorl.Condition` in WaterWorld with one change each, the same but for learning after it.
    """

    _esm = text_of(*SCRIPTS, Path(__file__).with_name("turn.js"))
    _css = text_of("widget.css")
    _engine = traitlets.Unicode(Explorer._engine.default_value).tag(sync=True)
    _wasm = traitlets.Dict().tag(sync=True)
    _layout = traitlets.Dict().tag(sync=True)
    _runs = traitlets.Dict().tag(sync=True)

    def __init__(self, on, off):
        explorer = Explorer({"on": on, "off": off})
        used = {name: {"plane": getattr(explorer, name)["plane"]} for name in ("_wasm", "_layout")}
        runs = {name: {part: explorer._presets[name][part]
                       for part in ("parameters", "changes", "world", "seed", "steps")} for name in ("on", "off")}
        super().__init__(_runs=runs, **used)
        explorer.close()
