"""Drawings of grid worlds."""

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.patches import Rectangle

from companion.shared.grid import MOVES, WALL
from companion.page.panels import FILL, mark
from neorl.drawing.style import AGENT, GREEN, INK, width_of_figures


def new_grids(grid, columns=1, rows=1):
    """Axes for drawings of a grid, side by side in a figure: a list."""
    wide, high = len(grid.rows[0]), len(grid.rows)
    width = width_of_figures()
    figure, axes = plt.subplots(rows, columns, figsize=(width, width / columns * high / wide * rows + 0.3 * rows),
                                squeeze=False)
    for each in axes.flat:
        each.set(xlim=(-0.55, wide - 0.45), ylim=(high - 0.45, -0.55), aspect="equal")
        each.axis("off")
    return list(axes.flat)


def draw_grid(axes, grid, fills=None):
    """The walls and states of a grid, some of them filled: fills {state: (colour, opacity)}."""
    for y, row in enumerate(grid.rows):
        for x, letter in enumerate(row):
            wall = letter == WALL
            axes.add_patch(Rectangle((x - 0.5, y - 0.5), 1, 1, facecolor=INK if wall else "none",
                                     alpha=0.55 if wall else 0.5, edgecolor=INK, linewidth=0.6))
    for state, (colour, opacity) in (fills or {}).items():
        axes.add_patch(Rectangle(grid.places[state] - 0.5, 1, 1, facecolor=colour, alpha=opacity, edgecolor="none"))


def draw_policy(axes, grid, q):
    """Arrows for the best actions of q (states, 4), ties included; none in states where all four are equal."""
    best = np.isclose(q, q.max(axis=1, keepdims=True), rtol=1e-9, atol=1e-12)
    state, action = np.nonzero(best & ~best.all(axis=1, keepdims=True))
    start, step = grid.places[state], 0.38 * MOVES[action]
    axes.quiver(*start.T, *step.T, color=AGENT, angles="xy", scale_units="xy", scale=1, units="xy", width=0.05,
                headwidth=4.5)


def draw_plans(panels, grid, plans):
    """The value of each state as the opacity of its fill, the best actions, and the marks of the grid.

    plans: {title: (values (states,), q (states, 4) or None)}, the values shaded relative to the largest of all.
    """
    largest = max(max(values.max() for values, _ in plans.values()), 1e-9)
    for axes, (title, (values, q)) in zip(panels, plans.items()):
        draw_grid(axes, grid, {state: (GREEN, FILL * max(value, 0) / largest) for state, value in enumerate(values)})
        if q is not None:
            draw_policy(axes, grid, q)
        for (x, y), letter in zip(grid.places, "".join(grid.rows).replace(WALL, "")):
            if letter != ".":
                mark(axes, (x - 0.28, y - 0.24), letter, ha="center", va="center")
        axes.set_title(title, fontsize=11)
