"""The Turn: a widget that runs, in the page, an agent whose desires change, with learning on or off from there."""

from pathlib import Path

from neorl.browser.explorer import parameters_in_page, world_in_page
from neorl.browser.figure import beginning
from neorl.browser.living import Living, text_of, traitlets

SCRIPTS = ("elements.js", "simulator.js", "drawing.js", "movers.js", "curve.js", "waiting.js")


class Turn(Living):
    """An agent that avoids red creeps for a while and then wants them.

    on, off: two `neorl.Condition` in WaterWorld with one change each, the same but for learning after it.
    """

    _esm = text_of(*SCRIPTS, Path(__file__).with_name("turn.js"))
    _css = text_of("widget.css")
    MODULES = ("plane",)
    _runs = traitlets.Dict().tag(sync=True)

    def __init__(self, on, off):
        super().__init__(_runs={"on": _run(on), "off": _run(off)})
        self._drawn = lambda: beginning(on.world, on.seed)

    def _sentence(self):
        return "An agent that avoids red creeps for a while and then wants them, with learning on or off from there."


def _run(condition):
    world, ((turn, later),) = condition.world, condition.changes
    return {"world": world_in_page(world), "parameters": parameters_in_page(condition.agent, world),
            "changes": [{"step": turn, "parameters": parameters_in_page(later, world)}],
            "seed": condition.seed, "steps": condition.steps}
