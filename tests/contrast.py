"""Contrast of colours as WCAG 2 defines it, and the backgrounds of the book's pages."""

import re
from pathlib import Path

STYLE_SHEET = Path(__file__).parents[1] / "book" / "vendor" / "book.css"
# The backgrounds of the theme: the page, and boxes on it.
GROUNDS = {"light": ("#ffffff", "#f3f4f5"), "dark": ("#121212", "#29313d")}


def luminance(colour):
    """The relative luminance of a colour "#rrggbb": 0 … 1."""
    parts = [int(colour[at : at + 2], 16) / 255 for at in (1, 3, 5)]
    linear = [part / 12.92 if part <= 0.04045 else ((part + 0.055) / 1.055) ** 2.4 for part in parts]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def contrast(first, second):
    """The contrast of two colours "#rrggbb": 1 … 21."""
    dark, light = sorted(map(luminance, (first, second)))
    return (light + 0.05) / (dark + 0.05)


def variables(prefix):
    """The style sheet's colour variables with a given prefix: {"light": {name: "#rrggbb"}, "dark": …}."""
    found = {}
    for mode, block in (("light", r"\nhtml \{([^}]*)\}"), ("dark", r'\nhtml\[data-theme="dark"\] \{([^}]*)\}')):
        text = "".join(re.findall(block, STYLE_SHEET.read_text()))
        found[mode] = dict(re.findall(rf"--({prefix}[\w-]*): (#[0-9a-f]{{6}});", text))
    return found
