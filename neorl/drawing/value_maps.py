"""Maps from above: their cells, the action values in each, and the learned values of goals.

A map of two components is drawn as rectangles over the board, or over the surroundings of the agent. A polar map, of
distance and direction, is drawn as sectors of rings around the agent, and a map of directions as sectors. Each function
draws into `ax`, or into a new board, and returns the axes.
"""

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Patch, Rectangle, Wedge
from numpy.typing import ArrayLike

from neorl.agents.agent import Place
from neorl.agents.individual import Individual
from neorl.common import checks
from neorl.core.coordinates import tune
from neorl.core.direction import TAU
from neorl.core.horde import as_vectors
from neorl.core.maps import NresMap
from neorl.core.modality import SEVERAL
from neorl.core.scene import CARDINAL, Actions
from neorl.drawing.boards import board_or_new
from neorl.drawing.style import AGENT, GREEN, INK, RED, colour_like

MOST_CELLS = 20_000  # more would not be visible
OPACITY = 0.45  # of the cell of the greatest value


class _Fields(NamedTuple):
    """The receptive fields of a map in the plane."""

    patches: list[Patch]
    middles: np.ndarray  # float64 (cells, 2)
    breadth: np.ndarray  # float64 (cells, 1): space for an arrow
    low: float  # where their board begins


def draw_cells(nres_map: NresMap, colour: Any = INK, fills: Mapping[int, tuple[Any, float]] | None = None,
               width: float = 1.0, ax: Axes | None = None) -> Axes:
    """Draw the receptive fields of a map, some of them filled.

    nres_map: a `neorl.NresMap` of two components of one vector, of its length and direction, or of the direction alone.
    fills: {cell: (colour, opacity)}. width: of the lines, in points.
    Raises ValueError for anything else.

    >>> axes = drawing.draw_cells(neorl.NresMap(5), fills={12: (drawing.GREEN, 0.5)})
    """
    fields = _fields(nres_map)
    colour, width = colour_like("colour", colour), checks.real("width", width, 0, 1000)
    fills = checks.instance("fills", {} if fills is None else fills, dict)
    for cell, fill in fills.items():
        checks.integer("cell of fills", cell, at_least=0, at_most=nres_map.cells - 1)
        if len(checks.several("fills", fill)) != 2:
            raise checks.error("fills", "pairs of a colour and an opacity", fill)
        colour_like("colour of fills", fill[0]), checks.real("opacity of fills", fill[1], 0, 1)
    axes = board_or_new(ax, fields.low)
    for cell, patch in enumerate(fields.patches):
        patch.set(facecolor="none", edgecolor=colour, linewidth=width)
        axes.add_patch(patch)
    inside = _fields(nres_map).patches if fills else ()
    for cell, (fill, opacity) in fills.items():
        inside[cell].set(facecolor=fill, alpha=opacity, edgecolor="none")
        axes.add_patch(inside[cell])
    return axes


def draw_values(nres_map: NresMap, values: ArrayLike, actions: Actions = CARDINAL, ax: Axes | None = None) -> Axes:
    """Draw an arrow in every cell for its action values: the sum of the actions' pushes times their values.

    Arrows grow with the fourth root of the values, so that small ones are visible.

    nres_map: as in `draw_cells`. values: float (cells, actions). actions: the world's `neorl.Actions`, of two axes.
    Raises ValueError for anything else.

    >>> values = np.array([[0.0, 0.0, 1.0, 0.0]] * 9)  # east is best everywhere
    >>> axes = drawing.draw_values(neorl.NresMap(3), values, ax=drawing.draw_cells(neorl.NresMap(3)))
    """
    fields, values = _fields(nres_map), checks.doubles("values", values)
    checks.instance("actions", actions, Actions)
    if values.shape != (nres_map.cells, len(actions.names)) or actions.axes != 2:
        raise ValueError(f"values must have the shape {(nres_map.cells, len(actions.names))}, with actions along two "
                         f"axes, but has {values.shape}, with {actions.axes}")
    axes = board_or_new(ax, fields.low)
    vector = as_vectors(values, actions)
    length = np.linalg.norm(vector, axis=1, keepdims=True)
    arrow = fields.breadth * 0.8 * vector / np.where(length > 0, length, 1)
    arrow *= (length / max(length.max(), 1e-30)) ** 0.25
    shown = length[:, 0] > 0
    start = (fields.middles - arrow / 2)[shown]
    axes.quiver(start[:, 0], start[:, 1], arrow[shown, 0], arrow[shown, 1], color=AGENT, angles="xy",
                scale_units="xy", scale=1, width=0.009)
    return axes


def draw_value_map(run: Individual, goals: ArrayLike | None = None, valences: Sequence[float] | None = None,
                   index: int = 0, ax: Axes | None = None) -> Axes:
    """Draw the learned values of goals: each cell the more opaque the greater the value of its best action, red where
    it is negative, with an arrow for the values of all actions. The cells of the goals have a bold edge.

    run: a `neorl.Run` or a `neorl.Learner` in a world of two axes. goals: (goals, coordinates), points of the map's
    modality, such as places in board widths, or distances and directions in radians; by default what the agent desires
    now, with its valences, or in a map of things their contact. valences: of goals, by default 1.
    index: of the map in `Agent.maps`, one that `draw_cells` can draw.
    Raises ValueError for anything else.

    >>> run = neorl.Run(neorl.place_cells([5]), neorl.WaterWorld())
    >>> paid = run.advance(20_000)
    >>> axes = drawing.draw_value_map(run, goals=[(0.7, 0.7)])
    """
    if checks.instance("run", run, Individual).world.actions.axes != 2:
        raise ValueError(f"world of run must have two axes to be drawn, but has {run.world.actions.axes}")
    q = run.q(index)
    nres_map = run.agent.maps[index]
    if goals is None:
        if valences is not None:
            raise checks.error("valences", "None without goals", valences)
        goals, valences = _desired(run, index)
    cells = np.atleast_1d(nres_map.encode(goals))
    valences = [1.0] * len(cells) if valences is None else [
        checks.real("valences", each) for each in checks.several("valences", valences)]
    if cells.ndim != 1 or not len(cells) or len(valences) != len(cells):
        raise ValueError(f"valences must have a value for each of the goals, one or more, but has {len(valences)} for "
                         f"{cells.size}")
    values = q[:, :, cells].astype(float) @ np.array(valences)
    best = values.max(axis=1)
    most = max(np.abs(best).max(), 1e-30)
    fills = {cell: (AGENT if worth > 0 else RED, OPACITY * abs(worth) / most) for cell, worth in enumerate(best)}
    axes = draw_cells(nres_map, width=0.6, fills=fills, ax=ax)
    patches = _fields(nres_map).patches
    for cell, valence in dict(zip(cells.tolist(), valences)).items():
        patches[cell].set(facecolor="none", edgecolor=GREEN if valence > 0 else RED, linewidth=2.5, zorder=3)
        axes.add_patch(patches[cell])
    return draw_values(nres_map, values, run.world.actions, axes)


def _desired(run, index):
    """What the agent desires in a map, with its valences: two lists, of the map's coordinates and of numbers."""
    agent, scene = run.agent, run._scene
    node = [node for node in agent.nodes for _ in node.resolutions][index]
    if node.modality.follows in SEVERAL:
        return [tune(node.modality, (0.0, 0.0))], [1.0]
    here, found = scene.position / run.world.size, []
    start = 0.0 if node.modality.follows == "position" else here
    for desire, state in zip(agent.desires, run.state.desires):
        if desire.target != node.name:
            continue
        if isinstance(desire.source, tuple):
            found.append((desire.source, state.worth))
        elif agent.comes_from_node(desire):
            found.append((tune(node.modality, here + state.target_at - start), state.target_valence))
        else:
            places = [desire.source.coordinates] if isinstance(desire.source, Place) else (
                scene.things[scene.kinds == run.world.kinds.index(desire.source)] / run.world.size)
            found += [(tune(node.modality, place - start), state.worth) for place in np.asarray(places)]
    if not found:
        raise ValueError(f"goals must be given, since the node {node.name!r} of this map desires nothing now")
    return map(list, zip(*found))


def _fields(nres_map):
    axes = checks.instance("nres_map", nres_map, NresMap).modality.axes
    if nres_map.cells > MOST_CELLS:
        raise ValueError(f"nres_map must have {MOST_CELLS} cells or fewer to be drawn, but has {nres_map.cells}")
    vectors, features = {axis.of for axis in axes}, [axis.feature for axis in axes]
    if len(vectors) == 1 and not callable(axes[0].of):
        if features == ["component"] * 2 and (axes[0].along, axes[1].along) == (0, 1):
            return _rectangles(nres_map)
        if features in (["length", "direction"], ["direction"]):
            return _sectors(nres_map)
    raise ValueError("nres_map must be of the components x and y of one vector, of its length and direction, or of its "
                     f"direction, but is of {nres_map.modality.name}s")


def _borders(axis, n, nearest, furthest):
    """The borders of the n intervals of an axis; the outermost include all positions that things can have."""
    borders = np.array(axis.boundaries or np.linspace(axis.low, axis.high, n + 1))
    borders[0], borders[-1] = min(borders[0], nearest), max(borders[-1], furthest)
    return borders


def _rectangles(nres_map):
    low = 0 if nres_map.modality.follows == "position" else -1
    x, y = (_borders(axis, n, low, 1) for axis, n in zip(nres_map.modality.axes, nres_map.intervals))
    rows, columns = np.divmod(np.arange(nres_map.cells), nres_map.intervals[0])
    begin, end = (np.stack([x[columns + i], y[rows + i]], axis=1) for i in (0, 1))
    sides = end - begin
    patches = [Rectangle(corner, *each) for corner, each in zip(begin, sides)]
    return _Fields(patches, begin + sides / 2, np.full((len(sides), 1), sides.min()), low)


def _sectors(nres_map):
    *length, directions = nres_map.intervals
    rings = _borders(nres_map.modality.axes[0], *length, 0, 1) if length else np.array([0.0, 1.0])
    number, ring = np.divmod(np.arange(nres_map.cells), len(rings) - 1)
    inner, outer, angle = rings[ring], rings[ring + 1], TAU * number / directions
    half = TAU / directions / 2
    patches = [Wedge((0, 0), r, *np.degrees((at - half, at + half)), width=r - hole)
               for hole, r, at in zip(inner, outer, angle)]
    middle = (inner + outer) / 2
    middles = middle[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    return _Fields(patches, middles, np.minimum(outer - inner, 2 * half * middle)[:, None], -1)
