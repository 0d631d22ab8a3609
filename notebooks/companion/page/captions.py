"""What came out of a figure, in words with the numbers that it shows: the end of its caption.

A cell that draws a figure ends with `found`. Under JupyterLab the words stand below the figure; the book puts them at
the end of its caption (`book/computing/cells.py`).
"""

from html import escape

import numpy as np
from IPython.display import HTML

from companion.page.wording import enumerated
from companion.thesis.measures import FINAL
from neorl.statistics import Estimate, estimate


def found(words, numbers=None):
    """What a figure shows, to be the last expression of its cell: HTML.

    words: a sentence, or the beginning of one that numbers end: {name: `Estimate` or number}.
    """
    text = f"{words}: {listed(numbers)}." if numbers else words
    return HTML(f'<p class="found">{escape(text)}</p>', metadata={"found": text})


def listed(numbers):
    """Numbers by name in words: "N3 0.10, N7 0.15 [0.12, 0.18] and all 0.63". numbers: {name: `Estimate` or number}."""
    return enumerated(f"{name} {each if isinstance(each, Estimate) else Estimate(each, each, each)}"
                      for name, each in numbers.items())


def final_levels(results):
    """The reward per second in the last fifth of the runs of results by name, as `Estimate`s by name."""
    return {name: estimate(np.mean, result.rate(*FINAL)) for name, result in results.items()}
