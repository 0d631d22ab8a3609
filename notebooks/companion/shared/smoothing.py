"""Paper B's curves, which it smooths "by a Butterworth low-pass filter" (section 3)."""

import numpy as np
import scipy

from neorl import drawing
from neorl.drawing.curves import POINTS
from neorl.drawing.style import INK, looks
from neorl.statistics import binned_rate

# The thesis states neither of these.
FILTER_ORDER = 4
CUTOFF_PERIODS = 20  # per run: the filter removes higher frequencies


def low_passed(rates):
    """Low-pass filter curves (runs, points) forwards and backwards, so that nothing shifts in time.

    At either end a curve is extended by its point reflection, in the end point of a straight line fitted to its first
    or last cutoff period: its own end point is as noisy as an unfiltered curve. There must be more points than twice
    `CUTOFF_PERIODS`.
    """
    points = rates.shape[1]
    sections = scipy.signal.butter(FILTER_ORDER, 2 * CUTOFF_PERIODS / points, output="sos")
    near = points // CUTOFF_PERIODS
    first, last = (np.polynomial.polynomial.polyfit(np.arange(near) + 0.5, end.T, 1)[0][:, None]
                   for end in (rates[:, :near], rates[:, : -near - 1 : -1]))
    mirrored = rates[:, ::-1]
    longer = np.concatenate([2 * first - mirrored, rates, 2 * last - mirrored], axis=1)
    return scipy.signal.sosfiltfilt(sections, longer, axis=1)[:, points : 2 * points]


def draw_smoothed(results, ax=None):
    """Draw mean reward per second over the run, low-passed, with the 95 % interval of the mean.

    The unfiltered mean is a thin line behind the curve, clipped to the axes. results: {name: `Result`}, of one length.
    """
    first = next(iter(results.values()))
    points, minutes = min(POINTS, first.rewards.shape[1]), first.seconds / 60
    xs = (np.arange(points) + 0.5) / points * first.seconds / 60
    rates = {name: binned_rate(result, points) for name, result in results.items()}
    axes = drawing.draw_curves(xs, {name: low_passed(rate) for name, rate in rates.items()}, "simulated minutes",
                               "reward per second", ax)
    axes.set_xlim(0, minutes)
    axes.axhline(0, color=INK, linewidth=0.7, zorder=1)
    axes.set_ylim(axes.get_ylim())
    for rate, (colour, _) in zip(rates.values(), looks(len(rates))):
        axes.plot(xs, rate.mean(axis=0), color=colour, linewidth=0.5, alpha=0.4, zorder=1)
    return axes
