"""Figures that compare results with the numbers that the thesis reports.

The thesis's numbers are in grey, with their values, the first with "thesis"; results have a colour.
"""

import numpy as np
from matplotlib.text import Annotation

from companion.page.panels import mark
from neorl.drawing.style import CURVES, INK, SMALL, axes_or_new, name_ends, width_of_figures

ROW = 0.62  # inches
ROOM = 0.06  # of the height of a panel, left beyond the marked levels
LIFTS = 4, -4, -12, 12, -20, 20  # points from a level to its name, tried in this order
CLEAR = 3  # points between the vertical axis and a name beside it
REACH = 0.5  # of the range of the numbers: intervals are cut off that far beyond them


def draw_against_thesis(thesis, found, xlabel, lines=()):
    """Draw numbers of the thesis beside the results, a row for each, with dots and 95 % intervals.

    thesis: {label: number, or None where it has none}. found: {label: Estimate}, with the same labels. lines: {name:
    number}, for all rows, at most two. An interval that reaches far beyond all numbers is cut off, with an arrow at the
    edge.
    """
    rows, colour = np.arange(len(thesis)), CURVES[0]
    axes = axes_or_new(None, figsize=(width_of_figures(), 1.1 + ROW * len(rows)))
    printed = {row: number for row, number in enumerate(thesis.values()) if number is not None}
    marked = np.array([*printed])
    axes.vlines([*printed.values()], marked - 0.36, marked + 0.36, color=INK, linewidth=2.2)
    names = [axes.annotate(f"{'thesis ' * (row == min(printed))}{number:g}".replace("-", "−"), (number, row - 0.38),
                           xytext=(0, 0), textcoords="offset points", fontsize=SMALL, ha="center", va="bottom")
             for row, number in printed.items()]
    value, low, high = np.array([found[label] for label in thesis]).T
    axes.plot(value, rows, color=colour, linestyle="none", marker="o", markersize=6)
    axes.hlines(rows, low, high, color=colour)
    for (name, number), dashes in zip(dict(lines).items(), ((0, (5, 3)), ":")):
        axes.axvline(number, color=INK, linewidth=1.1, linestyle=dashes, zorder=1)
        mark(axes, (number, 1), name, xycoords=("data", "axes fraction"), xytext=(0, 3), textcoords="offset points",
             ha="center", va="bottom")
    axes.set(yticks=rows, yticklabels=thesis, ylim=(len(rows) - 0.5, -0.75), xlabel=xlabel)
    values = [*printed.values(), *dict(lines).values(), *value]
    reach, (left, right) = REACH * (max(values) - min(values)) or np.inf, sorted(axes.get_xlim())
    left, right = axes.set_xlim(max(left, min(values) - reach), min(right, max(values) + reach))
    for height, begin, end in zip(rows, low, high):
        for cut, edge, sign in ((begin < left, left, "<"), (end > right, right, ">")):
            if cut:
                axes.plot(edge, height, color=colour, marker=sign, markersize=6, clip_on=False)
    _keep_right_of_the_axis(axes, names)
    return axes


def _keep_right_of_the_axis(axes, names):
    """Move names that cross the vertical axis, or come close to it, to its right."""
    axes.figure.canvas.figure.draw_without_rendering()  # lays the figure out
    point = axes.figure.dpi / 72
    for name in names:
        missing = axes.bbox.x0 + CLEAR * point - name.get_window_extent().x0
        if missing > 0:
            name.set_x(missing / point)


def mark_levels(axes, levels):
    """Draw levels of the thesis into a figure of curves, as dashed lines with their names: levels {name: height}.

    The axes are extended to the levels, and the names at the ends of curves are spaced again.
    """
    heights = [*levels.values()]
    bottom, top = axes.get_ylim()
    room = ROOM * (max([top, *heights]) - min([bottom, *heights]))
    axes.set_ylim(min([bottom, *(height - room for height in heights)]),
                  max([top, *(height + room for height in heights)]))
    for name, height in zip(levels, heights):
        axes.axhline(height, color=INK, linewidth=1.1, linestyle=(0, (5, 3)), zorder=1)
        name_level(axes, height, name)
    names = [text for text in axes.texts if isinstance(text, Annotation) and text.xy[0] > 1]
    for text in names:
        text.remove()
    name_ends(axes, [(text.xy[1], text.get_text(), text.get_color()) for text in names])


def name_level(axes, height, name):
    """Write the name of a level beside its line, at the place where it covers least of the curves drawn so far.

    Places are tried from left to right, at each distance of `LIFTS` from the line; the first of the best is taken.
    """
    label = mark(axes, (0.02, height), name, xycoords=("axes fraction", "data"), xytext=(0, LIFTS[0]),
                 textcoords="offset points")
    axes.figure.canvas.figure.draw_without_rendering()  # lays the figure out
    panel, box = axes.bbox, label.get_window_extent()
    _, level = axes.transData.transform((0, height))
    curves = [line.get_transform().transform(line.get_xydata()) for line in axes.lines]
    point, last = axes.figure.dpi / 72, max(0.02, 0.98 - box.width / panel.width)

    def covered(place):
        at, lift = place
        across = panel.x0 + at * panel.width + box.width * np.linspace(0, 1, 15)
        near, far = sorted([level + lift * point, level + lift * point + np.sign(lift) * box.height])
        if near < panel.y0 or far > panel.y1:
            return np.inf
        return sum(np.mean((near - 2 * point < passing) & (passing < far + 2 * point))
                   for passing in (np.interp(across, *curve.T) for curve in curves))

    at, lift = min(((at, lift) for lift in LIFTS for at in np.linspace(0.02, last, 13)), key=covered)
    label.set(position=(0, lift), va="bottom" if lift > 0 else "top")
    label.xy = at, height
