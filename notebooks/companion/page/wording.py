"""Tables and numbers in Markdown."""

import re

import numpy as np

NEVER = "never within the run"


def table(header, rows):
    """A Markdown table from a header and rows, each a sequence of cells of any type that converts to text."""
    first, *others = (f"| {' | '.join(map(str, cells))} |" for cells in (header, *rows))
    return "\n".join([first, "|---" * len(header) + "|", *others])


def filled(header, rows):
    """A header and rows without the columns that are empty in all rows."""
    kept = [at for at in range(len(header)) if any(row[at] for row in rows)]
    return [header[at] for at in kept], [[row[at] for at in kept] for row in rows]


def in_words(estimate):
    """An `Estimate` as text; an infinite time, or lead in time, is one to a level that is never reached in the run."""
    return NEVER if np.isinf(estimate.value) else re.sub(r"−?inf", "never", str(estimate))


def enumerated(words):
    """Words in a row: "a, b and c"; "" of none."""
    *first, last = [*words] or [""]
    return f"{', '.join(first)} and {last}" if first else last


def number(value, digits=2):
    """A number with `digits` decimals, and a minus sign in place of a hyphen."""
    return f"{value:z.{digits}f}".replace("-", "−")


def scientific(value, digits=0):
    """A number above 0 with `digits` decimals as a multiple of a power of ten, in Markdown; 0 as "0"."""
    factor, power = f"{value:.{digits}e}".split("e")
    return f"{factor} × 10<sup>{int(power)}</sup>".replace("-", "−") if value else "0"
