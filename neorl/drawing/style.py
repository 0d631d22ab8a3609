"""The style of all figures: colours on a white ground, so that they are legible on a page of any colour.

1. Lines and discs have a contrast of at least 3 : 1, letters of 4.5 : 1: as drawn on white, and as brightened by the
   book's style sheet on its dark page, for which the build takes the ground away. No colour has 4.5 : 1 with both.
2. Colours are distinct for colour-blind readers, and never alone: a curve carries its name, a creep its sign.
3. Letters have at least 9 points in a figure of the usual width, which is 9 pixels on a phone.
"""

from typing import Any

import numpy as np
import scipy
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.colors import is_color_like, to_hex, to_rgb

from neorl.common import checks

INK, TEXT = "#808080", "#6e6e6e"  # lines, letters
AGENT, GREEN, RED = "#3175b9", "#0e825f", "#ba5323"
CURVES = ("#3d6ad1", "#ae2c47", "#b68f0c", "#00a1c0", "#85498f", "#ae6411", "#af77ff")
LIGHT_OF_LETTERS = 0.165  # relative luminance
DASHES = ("-", "--", ":", "-.")  # of curves: one for each cycle through the colours
SMALL, CROWDED = 9, 6  # points: the least size of letters, and the size of the names of more than a dozen curves
STYLE: dict[Any, Any] = {
    "figure.facecolor": "white", "axes.facecolor": "none", "savefig.facecolor": "auto", "figure.figsize": (4.9, 3.5),
    "font.size": 11, "text.color": TEXT, "axes.labelcolor": TEXT, "axes.edgecolor": INK, "xtick.color": INK,
    "ytick.color": INK, "xtick.labelcolor": TEXT, "ytick.labelcolor": TEXT, "axes.spines.top": False,
    "axes.spines.right": False, "lines.linewidth": 1.8,
    "figure.constrained_layout.use": True, "svg.hashsalt": "neorl",
}


def use_style() -> None:
    """Set matplotlib's style to the book's; for some figures only, use ``with plt.rc_context(drawing.STYLE):``."""
    plt.rcParams.update(STYLE)


def axes_or_new(ax, figsize=None, **options):
    """`ax`, or the axes of a new figure with these options if it is None. Raises ValueError for anything else."""
    if ax is None:
        return plt.figure(figsize=figsize, layout="constrained").add_subplot(**options)
    return checks.instance("ax", ax, Axes)


def width_of_figures():
    """The usual width of a figure in inches."""
    return plt.rcParams["figure.figsize"][0]


def by_name(name, values):
    """`values`, if they are a non-empty dict. Raises ValueError for anything else."""
    if isinstance(values, dict) and values:
        return values
    found = repr(values) if isinstance(values, dict) else f"of type {type(values).__name__}"
    raise ValueError(f"{name} must be a dict of one entry or more, by name, but is {found}")


def numbers(name, values):
    """`values` as an array of doubles within ±1e30, or NaN for gaps. Raises ValueError otherwise."""
    array = checks.as_array(name, values)
    if array.dtype.kind not in "fiub" or not np.all(np.isnan(array) | (np.abs(array) <= checks.LARGEST)):
        raise checks.error(name, f"numbers up to {checks.LARGEST:g}, in lists of equal lengths", values)
    return array.astype(float)


def colour_like(name, value):
    """`value`, if it is a matplotlib colour. Raises ValueError for anything else."""
    if isinstance(value, str | tuple) and is_color_like(value):
        return value
    raise checks.error(name, "a colour of matplotlib's", value)


def linear_light(colour):
    """The light of a matplotlib colour in red, green and blue, and in all, its relative luminance (WCAG 2)."""
    channels = np.array(to_rgb(colour))
    linear = np.where(channels <= 0.04045, channels / 12.92, ((channels + 0.055) / 1.055) ** 2.4)
    return linear, linear @ [0.2126, 0.7152, 0.0722]


def letters(colour):
    """A matplotlib colour, darkened or lightened so that letters in it are legible: "#rrggbb"."""
    linear, light = linear_light(colour)
    if light > LIGHT_OF_LETTERS:
        linear = linear * LIGHT_OF_LETTERS / light
    else:
        linear = linear + (1 - linear) * (LIGHT_OF_LETTERS - light) / (1 - light)
    return to_hex(np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055))


def looks(count):
    """Colours and dashes of `count` curves: 28 are distinct, by colour first."""
    return [(CURVES[i % len(CURVES)], DASHES[i // len(CURVES) % len(DASHES)]) for i in range(count)]


def name_ends(axes, ends, line=0.075):
    """Write the names of curves beside their ends (height, name, colour), moved apart within the height of the axes.

    line: the height that a name needs, as a share of the height of the axes; more in a low panel. Many names are
    written in smaller letters to fit. Returns their heights, from the lowest end to the highest.
    """
    scale = axes.yaxis.get_transform()  # names are spread on the page, so on a logarithmic axis by logarithms
    low, high = scale.transform(np.array(axes.get_ylim(), float))
    ends = sorted(ends)
    share = min(1.0, 1.0 / (line * len(ends))) if ends else 1.0
    apart = share * line * (high - low) * np.arange(len(ends))
    lowest = scipy.optimize.isotonic_regression(scale.transform(np.array([height for height, *_ in ends])) - apart).x
    heights = scale.inverted().transform(apart + np.clip(lowest, low, high - apart.max(initial=0.0)))
    size = max(CROWDED, share * plt.rcParams["font.size"])
    for at, (_, name, colour) in zip(heights, ends):
        axes.annotate(name, (1.02, at), xycoords=("axes fraction", "data"), color=letters(colour), va="center",
                      fontsize=size, annotation_clip=False)
    return heights
