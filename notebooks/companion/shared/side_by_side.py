"""Readings of the thesis side by side, on the pages of the papers: their variants and their choices."""

from companion.shared.priors import BEYOND, PINNED, WITHIN
from companion.shared.wording import table


def changed(reading, changes):
    """Variants of a reading, {name: {choice: value}}, except those equal to it."""
    made = {name: reading.varied(**change) for name, change in changes.items()}
    return {name: each for name, each in made.items() if each != reading}


def choices(readings, names):
    """A Markdown table of some choices of readings, which the text leaves open or pins to a value."""
    return table(["Choice", "The text", *readings], [
        [BEYOND[name].label, "open" if name in WITHIN else f"pinned to {BEYOND[name].words(PINNED[name])}",
         *(BEYOND[name].words(reading.choices[name]) for reading in readings.values())] for name in names])
