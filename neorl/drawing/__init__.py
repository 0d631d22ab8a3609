"""Figures of agents, networks, boards and curves, on matplotlib alone: ``pip install 'neorl-companion[plot]'``.

>>> from neorl import drawing
>>> axes = drawing.draw_world(neorl.WaterWorld(), neorl.WaterWorld().reset(seed=0))

A figure of one panel is drawn into ``ax``, or into a new figure if that is None, and its axes are returned.

- curves: `draw_accumulated`, `draw_proficiency`, `draw_curves`, `draw_sweep`;
- boards: `new_board`, `new_boards`, `draw_world`, `draw_walls`, `draw_tank`;
- maps: `draw_cells`, `draw_values`, `draw_value_map`;
- networks: `draw_network`;
- style: `use_style`, `STYLE` and the colours.
"""

from neorl.common.extras import require

require("matplotlib", extra="plot")

# ruff: noqa: E402
from neorl.drawing.boards import draw_tank, draw_walls, draw_world, new_board, new_boards
from neorl.drawing.curves import draw_accumulated, draw_curves, draw_proficiency, draw_sweep
from neorl.drawing.network_figures import draw_network
from neorl.drawing.style import AGENT, CURVES, GREEN, INK, RED, STYLE, use_style
from neorl.drawing.value_maps import draw_cells, draw_value_map, draw_values

__all__ = ["AGENT", "CURVES", "GREEN", "INK", "RED", "STYLE", "draw_accumulated", "draw_cells", "draw_curves",
           "draw_network", "draw_proficiency", "draw_sweep", "draw_tank", "draw_value_map", "draw_values", "draw_walls",
           "draw_world", "new_board", "new_boards", "use_style"]
