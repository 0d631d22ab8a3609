"""The Changes: a widget that steps through the changes of cell of an agent with one map, and learns from each."""

from pathlib import Path

import numpy as np

from neorl import NresMap
from neorl.browser.explorer import text_of, traitlets
from neorl.browser.figure import Figure, discs


def changes_of(run, steps):
    """The changes of cell in the next steps of a run of an agent with one map of the whole board.

    Each is [cell left, cell entered, steps in the cell left, …how many of them took each action].
    """
    ((resolution,),) = [node.resolutions for node in run.agent.nodes]
    path = run.record(steps)
    cells = NresMap(resolution).encode(path.positions / run.world.size)
    made, begun = [], 0
    for t in np.flatnonzero(np.diff(cells) | np.isin(np.arange(steps), path.ends)):
        changes = t not in path.ends  # a reset of the board begins a new stay, and changes no cell
        if changes:
            counts = np.bincount(path.actions[begun:t + 1], minlength=4)
            made.append([int(cells[t]), int(cells[t + 1]), int(t + 1 - begun), *counts.tolist()])
        begun = t + changes
    return made


class Changes(Figure):
    """The changes of cell of a run, as `changes_of` has them; the agent learns by shares of a stay, without memory."""

    _esm = text_of("elements.js", "drawing.js", Path(__file__).with_name("changes.js"))
    _css = text_of("widget.css")
    _run = traitlets.Dict().tag(sync=True)

    def __init__(self, run, steps):
        ((side,),), rule = [node.resolutions for node in run.agent.nodes], run.agent.learning
        super().__init__(_run={"changes": changes_of(run, steps), "side": side, "rate": rule.learning_rate,
                               "discount": rule.discount})

    def _sentence(self):
        number, side = len(self._run["changes"]), self._run["side"]
        return (f"The changes of cell in a run, {number} in all, on a board of {side} × {side} cells, from each of "
                "which the agent learns.")

    def _drawn(self):
        side = self._run["side"]
        cells = {cell for change in self._run["changes"] for cell in change[:2]}
        return discs([((cell % side + 0.5) / side, (cell // side + 0.5) / side) for cell in cells],
                     ["agent"] * len(cells), 0.2 / side)
