"""Figures of recorded paths, of the ways that were learned from them, and of what decides how many arrive."""

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.patches import Rectangle

from neorl.drawing.boards import new_boards
from neorl.drawing.style import AGENT, CURVES, INK, RED, TEXT, width_of_figures

FEW = 8  # ways that are drawn


def draw_ways(environment, path, ends, tour):
    """Draw what was recorded in a box, and beside it the first ways of a `Tour`, from dots to rings.

    ends: where frames are missing, as `Learner.watch` takes it. A way that did not arrive ends in a cross, and its goal
    is a ring that nothing leads to. Returns both axes.
    """
    boards = new_boards(columns=2, rows=1)
    for axes in boards:
        for wall in environment.walls:
            axes.plot(*wall.T, color=INK, linewidth=2.4, solid_capstyle="round")
    seen = np.insert(path, np.flatnonzero(ends) + 1, np.nan, axis=0)
    boards[0].plot(*seen.T, color=AGENT, linewidth=0.5)
    boards[0].set_title("what was recorded", fontsize=10)
    for way, goal, arrived, colour in zip(tour.paths[:FEW], tour.goals, tour.arrived, (*CURVES, INK)):
        boards[1].plot(*way.T, color=colour, linewidth=1.4)
        boards[1].plot(*way[0], "o", color=colour, markersize=4)
        boards[1].plot(*goal, "o", color=colour, markersize=9, fillstyle="none")
        if not arrived:
            boards[1].plot(*way[-1], "x", color=colour, markersize=8)
    boards[1].set_title(f"ways learned: {np.sum(tour.arrived)} of {len(tour.arrived)} arrive", fontsize=10, color=TEXT)
    return boards


def draw_maze(walls, ways, side=4.0):
    """Draw the walls of a maze, squares by their middles, (walls, 2), and ways with their goals. Returns the axes."""
    width, height = np.ptp(walls, axis=0) + side
    figure = plt.figure(figsize=(width_of_figures(), width_of_figures() * height / width), layout="none")
    axes = figure.add_axes((0, 0, 1, 1))
    for middle in walls:
        axes.add_patch(Rectangle(middle - side / 2, side, side, color=INK, alpha=0.35, linewidth=0))
    for (way, goal), colour in zip(ways, CURVES):
        axes.plot(*way.T, color=colour, linewidth=1.4)
        axes.plot(*way[0], "o", color=colour, markersize=4)
        axes.plot(*goal, "o", color=colour, markersize=9, fillstyle="none")
    axes.set(xlim=walls[:, 0].min() + np.array([-side / 2, width - side / 2]), aspect="equal",
             ylim=walls[:, 1].max() + np.array([side / 2, side / 2 - height]))
    axes.axis("off")
    return axes


def draw_offsets(scans):
    """Draw success against the offset of the grid, a panel for each data set; returns their axes.

    scans: {data set: {name of a pilot: (offsets, successes)}}.
    """
    columns = 3
    figure, grid = plt.subplots(-(-len(scans) // columns), columns, squeeze=False, sharex=True, sharey=True,
                                figsize=(width_of_figures(), 3.6), layout="constrained")
    for axes, (name, scan) in zip(grid.flat, scans.items()):
        for (pilot, (offsets, successes)), colour, style in zip(scan.items(), (AGENT, RED), ("-o", "--s")):
            axes.plot(offsets, successes, style, color=colour, markersize=3.5, linewidth=1.4, label=pilot)
        axes.set_title(name, fontsize=9, color=TEXT)
        axes.set(ylim=(-3, 105))
    figure.supxlabel("offset of the grid, units", fontsize=10, color=TEXT)
    figure.supylabel("success, %", fontsize=10, color=TEXT)
    figure.legend(*grid.flat[0].get_legend_handles_labels(), loc="outside upper center", ncols=2, frameon=False,
                  fontsize=10)
    return grid
