"""What came out of a figure, in words with the numbers that it shows: the end of its caption.

A cell that draws a figure ends with `found`. Under JupyterLab the words stand below the figure; the book puts them at
the end of its caption (`book/computing/cells.py`).
"""

import re
from html import escape

import numpy as np
from IPython.display import HTML

from companion.page.wording import enumerated
from companion.thesis.measures import FINAL
from neorl.statistics import Estimate, estimate

SETTING = re.compile(r"[=≥]| \d[\d.]*$")  # in a name that a number could be taken for a part of


def found(words, numbers=None):
    """What a figure shows, to be the last expression of its cell: HTML.

    words: a sentence, or the beginning of one that numbers end: {name: `Estimate` or number}.
    """
    text = f"{words}: {listed(numbers)}." if numbers else words
    return HTML(f'<p class="found">{escape(text)}</p>', metadata={"found": text})


def listed(numbers):
    """Numbers by name in words: "N3 0.10, all 0.6 [0.5, 0.7] and r = 1: 0.7". numbers: {name: `Estimate` or number}."""
    return enumerated(f"{name}{':' if SETTING.search(name) else ''} {as_estimate(number)}"
                      for name, number in numbers.items())


def as_estimate(number):
    return number if isinstance(number, Estimate) else Estimate(number, number, number)


def final_levels(results):
    """The reward per second in the last fifth of the runs of results by name, as `Estimate`s by name."""
    return {name: estimate(np.mean, result.rate(*FINAL)) for name, result in results.items()}


def last_levels(curves):
    """The means over runs of the last points of curves by name, each (runs, points), as `Estimate`s by name."""
    return {name: estimate(np.mean, np.asarray(curve)[:, -1]) for name, curve in curves.items()}
