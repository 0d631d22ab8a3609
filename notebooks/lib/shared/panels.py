"""Parts of pages' own figures: curves with their names at their ends, and arrows."""

import numpy as np

from neorl.drawing.style import CURVES, name_ends
from neorl.evidence.statistics import mean_band


def add_curves(axes, xs, curves, colours=CURVES, line=0.075, linewidth=1.8, **settings):
    """Draw curves into a panel, {name: (points,)}, or means with their 95 % intervals, {name: (runs, points)}.

    line: the room for a name, see `name_ends`. settings: of the axes.
    """
    ends = []
    for (name, curve), colour in zip(curves.items(), colours):
        mean = curve if curve.ndim == 1 else curve.mean(axis=0)
        axes.plot(xs, mean, color=colour, linewidth=linewidth)
        if curve.ndim == 2:
            axes.fill_between(xs, *mean_band(curve), color=colour, alpha=0.2, linewidth=0)
        ends.append((mean[np.isfinite(mean)][-1], name, colour))
    axes.set(**settings)
    name_ends(axes, ends, line)


def add_arrow(axes, start, end, colour, linewidth=1.4, style="->"):
    """Draw an arrow from a point to another."""
    axes.annotate("", end, start, arrowprops={"arrowstyle": style, "color": colour, "linewidth": linewidth,
                                              "shrinkA": 0, "shrinkB": 0})
