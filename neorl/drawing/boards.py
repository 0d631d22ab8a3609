"""Boards from above: the unit square with an agent and things in it, y downward, as in every world of the package.

Each function draws into `ax`, or into a new board, in units of the world's size, and returns the axes. Axes without set
limits become a board.
"""

from typing import Any

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.patches import Circle, Rectangle

from neorl.common import checks
from neorl.drawing.style import AGENT, CURVES, GREEN, INK, RED, axes_or_new, width_of_figures
from neorl.worlds import waterworld
from neorl.worlds.arena import Arena
from neorl.core.scene import HALF_SECOND
from neorl.worlds.waterworld import WaterWorld
from neorl.worlds.world import World

MARGIN = 0.06  # around a board
RADIUS = 0.025  # of an agent, where the world defines none


def new_board(size: float = 3.6, low: float = 0.0) -> Axes:
    """Axes of a new figure, `size` inches wide, over the unit board, or from `low` to 1 along both axes.

    size: from 0.1 to 100. low: from −1000 to 0.9. Raises ValueError for anything else.

    >>> axes = drawing.new_board(low=-1)
    """
    size, low = checks.real("size", size, 0.1, 100), checks.real("low", low, -1000, 0.9)
    figure = plt.figure(figsize=(size, size), layout="none")
    return as_board(figure.add_axes((0.01, 0.01, 0.98, 0.98)), low)


def new_boards(columns: int, rows: int) -> list[Axes]:
    """A grid of unit boards: a list of their axes, row by row.

    columns, rows: integers from 1 to 20. Raises ValueError for anything else.

    >>> left, right = drawing.new_boards(columns=2, rows=1)
    """
    columns, rows = (checks.integer(name, each, 1, 20) for name, each in (("columns", columns), ("rows", rows)))
    width = width_of_figures()
    figure, grid = plt.subplots(rows, columns, squeeze=False, figsize=(width, 1.1 * width * rows / columns),
                                layout="constrained")
    return [as_board(axes) for axes in grid.flat]


def as_board(ax, low=0.0):
    """Turn any axes into a board, from `low` to 1 along both axes, y downward, without ticks. Returns them."""
    margin = MARGIN * (1 - low)
    axes = axes_or_new(ax)
    axes.set(xlim=(low - margin, 1 + margin), ylim=(1 + margin, low - margin), aspect="equal")
    axes.axis("off")
    return axes


def board_or_new(ax, low=0.0):
    """`ax`, or a new board if it is None. Axes without set limits become a board."""
    if ax is None:
        return new_board(low=low)
    return as_board(ax, low) if axes_or_new(ax).get_autoscalex_on() else ax


def draw_world(world: World, state: Any, ax: Axes | None = None) -> Axes:
    """Draw a world from above, within its walls: a `neorl.WaterWorld` as `draw_tank` does, any other with its agent,
    the agent's velocity over the next half second, and its things. Only the first two axes are drawn; one is a line.

    state: of that world. Raises ValueError if it is not.

    >>> arena = neorl.worlds.Arena()
    >>> axes = drawing.draw_world(arena, arena.reset(seed=0))
    """
    checks.instance("world", world, World).check_state(state)
    axes = draw_walls(world, ax)
    if isinstance(world, WaterWorld):
        return draw_tank(world, state, axes)
    radius = world.radius if isinstance(world, Arena) else RADIUS
    for place, kind in zip(state.scene.things, state.scene.kinds):
        if kind >= 0:
            axes.add_patch(Circle(_in_plane(place / world.size, 0.5), radius, facecolor=(GREEN, *CURVES)[kind % 8],
                                  alpha=0.75, edgecolor="none"))
    place = inside(_in_plane(state.scene.position / world.size, 0.5), RADIUS)
    axes.add_patch(Circle(place, RADIUS, facecolor=AGENT, edgecolor="none"))
    _draw_velocity(axes, place, _in_plane(state.scene.velocity / world.size, 0.0))
    return axes


def draw_walls(world: World, ax: Axes | None = None) -> Axes:
    """Draw the walls and obstacles of a `neorl.worlds.Arena`, or the border of another world's board.

    world: a `neorl.World`. Raises ValueError for an `ax` that is not axes.

    >>> axes = drawing.draw_walls(neorl.worlds.Arena(obstacles=[(0.4, 0.4, 0.6, 0.5)]))
    """
    axes = board_or_new(ax)
    border: dict[str, Any] = {"fill": False, "edgecolor": INK, "linewidth": 1.4}
    is_round = isinstance(world, Arena) and world.shape == "round"
    axes.add_patch(Circle((0.5, 0.5), 0.5, **border) if is_round else Rectangle((0, 0), 1, 1, **border))
    for left, top, right, bottom in world.obstacles if isinstance(world, Arena) else ():
        axes.add_patch(Rectangle((left, top), right - left, bottom - top, facecolor=INK, alpha=0.55, edgecolor=INK))
    return axes


def draw_tank(world: WaterWorld, state: Any, ax: Axes | None = None) -> Axes:
    """Draw the agent and the creeps of a `neorl.WaterWorld`, each with its velocity over the next half second; creeps
    carry their sign.

    world: a `WaterWorld`. state: of that tank. Raises ValueError for anything else.

    >>> tank = neorl.WaterWorld()
    >>> axes = drawing.draw_tank(tank, tank.reset(seed=0))
    """
    checks.instance("world", world, WaterWorld).check_state(state)
    axes, radius = board_or_new(ax), world.radius / world.width
    scene, creep_velocity = state.scene, state.direction * state.speed[:, None]
    movers = [(scene.position, scene.velocity, AGENT, "")]
    movers += [(position, velocity, GREEN if green else RED, "+" if green else "−") for position, velocity, green
               in zip(scene.things, creep_velocity, scene.kinds == waterworld.GREEN)]
    for position, velocity, colour, sign in movers:
        x, y = inside(position / world.width, radius)
        axes.add_patch(Circle((x, y), radius, facecolor=colour, edgecolor="none"))
        axes.text(x, y, sign, color="white", ha="center", va="center_baseline", weight="bold")
        _draw_velocity(axes, (x, y), velocity / world.width)
    return axes


def _in_plane(vector, missing):
    return (vector[0], vector[1] if len(vector) > 1 else missing)


def inside(places, radius):
    """Places shifted so that discs of that radius lie within the board: in some worlds a centre can reach the wall."""
    return np.clip(places, radius, 1 - radius)


def _draw_velocity(axes, place, velocity):
    (x, y), (dx, dy) = place, HALF_SECOND * np.asarray(velocity)
    axes.annotate("", (x + dx, y + dy), (x, y), zorder=0,
                  arrowprops={"arrowstyle": "->", "color": INK, "linewidth": 1.4, "shrinkA": 0, "shrinkB": 0})


def desire_colour(desire):
    """The colour of the creeps from which a desire is computed, if they are all of one colour."""
    (source,) = desire.of if len(desire.of) == 1 else (desire.source,)
    return {"green": GREEN, "red": RED}.get(source, INK)
