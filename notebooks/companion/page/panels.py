"""Parts of pages' own figures: curves with their names at their ends, means over runs, arrows, and small letters."""

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.ticker import MultipleLocator

from neorl.drawing.curves import add_spread
from neorl.drawing.style import CURVES, INK, SMALL, letters, name_ends
from neorl.statistics import mean_band

FILL = 0.3  # the greatest opacity of a fill that arrows cross
UNDER_WHITE = "#5a5a5a"  # the background of white letters, which need more contrast than a sign such as +


def add_curves(axes, xs, curves, colours=CURVES, line=0.075, linewidth=1.8, **settings):
    """Draw curves into a panel, {name: (points,)}, or means over runs with their spread, {name: (runs, points)}.

    line: the room for a name, see `name_ends`. settings: of the axes.
    """
    ends = []
    for (name, curve), colour in zip(curves.items(), colours):
        mean = curve if curve.ndim == 1 else curve.mean(axis=0)
        axes.plot(xs, mean, color=colour, linewidth=linewidth)
        if curve.ndim == 2:
            add_spread(axes, xs, curve, colour)
        ends.append((mean[np.isfinite(mean)][-1], name, colour))
    axes.set(**settings)
    name_ends(axes, ends, line)


def draw_means(series, xlabel, ylabel, logs="", marks=False, guides=()):
    """Means over runs with their spread, of series {name: (xs (points,), values (runs, points))}.

    logs: the logarithmic axes, a string of "x" and "y". guides: (xs, ys) of thin lines for comparison.
    """
    axes = plt.figure().add_subplot()
    shown = {axis: np.log10 if axis in logs else np.asarray for axis in "xy"}
    ends = []
    for xs, ys in guides:
        axes.plot(shown["x"](xs), shown["y"](ys), color=INK, linewidth=0.8, zorder=1)
    for (name, (xs, values)), colour in zip(series.items(), CURVES):
        at, mean = shown["x"](xs), shown["y"](values.mean(axis=0))
        axes.plot(at, mean, color=colour, linewidth=0.8 if marks else 1.8, marker="o" if marks else "", markersize=4)
        if marks:
            axes.vlines(at, *shown["y"](mean_band(values)), color=colour)
        else:
            add_spread(axes, at, shown["y"](values), colour, lambda _: shown["y"](mean_band(values)))
        ends.append((at[-1], mean[-1], name, colour))
    axes.set(xlabel=xlabel, ylabel=ylabel)
    for axis in logs:
        ticks = getattr(axes, f"{axis}axis")
        ticks.set_major_locator(MultipleLocator(1))
        ticks.set_major_formatter(lambda power, _: f"$10^{{{power:.0f}}}$")
    if len({x for x, *_ in ends}) == 1:
        name_ends(axes, [end for _, *end in ends])
    else:
        for x, y, name, colour in ends:
            axes.annotate(name, (x, y), xytext=(0, 8), textcoords="offset points", color=letters(colour), ha="center",
                          annotation_clip=False)


def add_arrow(axes, start, end, colour, linewidth=1.4, style="->"):
    """Draw an arrow from a point to another."""
    axes.annotate("", end, start, arrowprops={"arrowstyle": style, "color": colour, "linewidth": linewidth,
                                              "shrinkA": 0, "shrinkB": 0})


def mark(axes, place, text, **options):
    """Write a few letters in white on a dark background, legible on any fill and over curves.

    place, options: as in `Axes.annotate`, whose annotation is returned.
    """
    ground = {"boxstyle": "round,pad=0.12", "facecolor": UNDER_WHITE, "edgecolor": "none"}
    return axes.annotate(text, place, color="white", fontsize=SMALL, bbox=ground, zorder=5, **options)
