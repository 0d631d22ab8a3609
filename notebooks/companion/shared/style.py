"""What figures of several pages share, beyond the style of `neorl.drawing`."""

from matplotlib.collections import LineCollection

from neorl.drawing.style import SMALL, letters, name_ends

FILL = 0.3  # the greatest opacity of a fill that arrows cross
UNDER_WHITE = "#5a5a5a"  # the background of white letters, which need more contrast than a sign such as +
LEADER = 0.08  # the width of the lines that lead to names, as a share of the width of the axes


def mark(axes, place, text, **options):
    """Write a few letters in white on a dark background, legible on any fill and over curves.

    place, options: as in `Axes.annotate`, whose annotation is returned.
    """
    ground = {"boxstyle": "round,pad=0.12", "facecolor": UNDER_WHITE, "edgecolor": "none"}
    return axes.annotate(text, place, color="white", fontsize=SMALL, bbox=ground, zorder=5, **options)


def name_distant_ends(axes, ends, line):
    """As `name_ends`, with a thin line from each end to its name, which may be far from it."""
    heights, ends = name_ends(axes, ends, line, beside=1.02 + LEADER), sorted(ends)
    lines = [[(1.01, height), (1 + LEADER, at)] for at, (height, *_) in zip(heights, ends)]
    axes.add_collection(LineCollection(lines, colors=[letters(colour) for *_, colour in ends], linewidths=0.7,
                                       transform=axes.get_yaxis_transform(), clip_on=False), autolim=False)
