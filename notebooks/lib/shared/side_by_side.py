"""Readings of the thesis side by side, on the pages of the papers: their variants and their choices."""

from dataclasses import replace

from lib.shared.priors import BEYOND, WITHIN
from lib.shared.wording import table


def changed(reading, changes):
    """Variants of a reading, {name: {field: value}}, except those equal to it."""
    made = {name: replace(reading, **change) for name, change in changes.items()}
    return {name: each for name, each in made.items() if each != reading}


def choices(readings, fields):
    """A Markdown table of the choices of readings in some fields, pinned or open."""
    return table(["Choice", "The text", *readings], [
        [BEYOND[field].label, "open" if field in WITHIN else "pinned",
         *(BEYOND[field].words(getattr(reading, field)) for reading in readings.values())] for field in fields])
