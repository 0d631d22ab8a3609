"""What figures of several pages share, beyond the style of `neorl.drawing`."""

from neorl.drawing.style import SMALL

FILL = 0.3  # the greatest opacity of a fill that arrows cross
UNDER_WHITE = "#5a5a5a"  # the background of white letters, which need more contrast than a sign such as +


def mark(axes, place, text, **options):
    """Write a few letters in white on a dark background, legible on any fill and over curves.

    place, options: as in `Axes.annotate`, whose annotation is returned.
    """
    ground = {"boxstyle": "round,pad=0.12", "facecolor": UNDER_WHITE, "edgecolor": "none"}
    return axes.annotate(text, place, color="white", fontsize=SMALL, bbox=ground, zorder=5, **options)
