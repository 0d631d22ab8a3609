"""The curves behind a run in the page, of reward per second: the band of a condition's own runs, or a given curve."""

import math

import numpy as np

from neorl.common import checks
from neorl.experiments.bins import bin_steps
from neorl.statistics import tolerance_band

CURVE_BINS = 50


def band(result):
    """Reward per second in bins of the run: the tolerance band of the runs, and their mean."""
    each = math.ceil(result.rewards.shape[1] / CURVE_BINS)
    begins = np.arange(0, result.rewards.shape[1], each)
    edges = result.edges[[*begins, -1]]
    rates = np.add.reduceat(result.rewards, begins, axis=1, dtype=float) / np.diff(edges)
    low, high = tolerance_band(rates)
    return {**_in_page(edges, rates.mean(axis=0), low, high), "steps_per_bin": each * bin_steps(result.world),
            "has_all": bool(np.array_equal([low, high], [rates.min(axis=0), rates.max(axis=0)]))}


def behind(given, conditions):
    """The curves given to an Explorer, in the page's format. Raises ValueError for any that it cannot draw."""
    found = {}
    for name, curve in checks.instance("behind", given or {}, dict).items():
        checks.one_of("name of a curve behind", name, tuple(conditions))
        if len(curve := checks.several(f"behind of {name}", curve)) != 5:
            raise checks.error(f"behind of {name}", "(minutes, mean, low, high, what it is)", curve)
        minutes, *lines, words = curve
        mean, low, high = (checks.doubles(f"behind of {name}", line) for line in lines)
        if not mean.ndim == 1 <= len(mean) or not mean.shape == low.shape == high.shape:
            raise ValueError(f"behind of {name} must have as many means as lower and upper ends, one or more, but has "
                             f"{mean.size}, {low.size} and {high.size}")
        edges = np.linspace(0, 60 * checks.positive(f"minutes behind {name}", minutes), len(mean) + 1)
        found[name] = {**_in_page(edges, mean, low, high), "words": checks.instance(f"words on {name}", words, str)}
    return found


def _in_page(edges, middle, low, high):
    curves = {"edges": edges, "low": low, "middle": middle, "high": high}
    return {name: curve.round(4).tolist() for name, curve in curves.items()}
