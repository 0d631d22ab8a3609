"""Figures of recorded paths and of the ways that were learned from them."""

import numpy as np

from neorl.drawing.boards import new_boards
from neorl.drawing.style import AGENT, CURVES, INK, TEXT

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
