"""Sentences of chapter 4 on walks, on series and on sums of functions of one variable, in Markdown."""

import numpy as np

from lib.chapter_4.superposition import DEGREE, exact_sums
from lib.chapter_4.walks import NEAR, first_arrivals, powers_of_time
from lib.shared.wording import scientific, table
from neorl.evidence.statistics import estimate


def in_short(school, agreed, load):
    """Which of the chapter's arguments hold, in a few sentences.

    school: the gain of learning at every step, in a sentence. agreed: the share of cells in which a sum of value
    functions takes one of a plan's best actions. load: shares of a core, float64 (windows,).
    """
    return (f"The thesis holds that an agent has to learn when it passes from one cell of its map to the next, and "
            f"that temporal difference at every step fails. {school} (A gain is the reward beyond that of random "
            f"motion.) A sum of value functions is not a plan: with three desired elements and one feared on a grid, "
            f"it takes one of the plan's best actions in {100 * agreed:.0f} % of cells. Learning in real time, with "
            f"twelve maps at 50 steps per second, takes {100 * load.mean():.1f} % of a core.")


def arrivals(unbiased, biased, goal):
    """How many walks reach the goal, and when: (runs, steps + 1, 3), without bias and with β = 0.25."""
    first = [first_arrivals(paths, goal) for paths in (unbiased, biased)]
    by_chance, on_purpose = (each[np.isfinite(each)] for each in first)
    after = f", after {on_purpose.mean():,.0f} steps on average" if len(on_purpose) else ""
    return (f"Within {unbiased.shape[1] - 1:,} steps, {len(by_chance)} of {len(unbiased)} unbiased walks come within "
            f"{NEAR} units of the goal, {np.linalg.norm(goal):.0f} units away, and {len(on_purpose)} of the "
            f"biased ones{after}. The draws are the same for both, so the walks differ in one step in four.")


def displacements(lags, squared):
    """Power of time with which walks spread under a constant drift: squared {β: (runs, lags)}, 0 among them."""
    slope = estimate(np.mean, np.polyfit(lags, squared[0.0].T, 1)[0])
    rows = []
    for strength, curves in squared.items():
        over = f"{(1 - strength**2) / strength**2:,.0f} steps" if strength else "never"
        rows.append([f"{strength:g}", over, *(estimate(np.mean, power) for power in powers_of_time(curves, lags))])
    return (f"Without a bias, the mean squared distance grows by {slope} per step, where 1 is expected. The table "
            "gives the power of time with which distance grows, at the shortest and longest times of the figure.\n\n"
            + table(["β", "Drift takes over after", "Power at first", "Power at last"], rows))


def decomposition(errors):
    """How well series are decomposed. errors: as `lib.chapter_4.wold.errors` returns them."""
    rows = [[f"{steps:,}", *(estimate(np.mean, each) for each in of_runs)] for steps, of_runs in errors.items()]
    (_, runs), *_ = (of_runs.shape for of_runs in errors.values())
    return ("Errors of the recovered parts, for series of different lengths (root mean squares, "
            "where the oscillation has an amplitude and the noise a standard deviation of 1; means over "
            f"{runs} series, with 95 % intervals):\n\n"
            + table(["Steps", "Error of u", "Error of y", "Largest error of b"], rows))


def sums_at_a_glance(x, y):
    """The functions of `exact_sums`, with their largest differences from the sums at points x, y, as a table."""
    rows = [[name, formula, scientific(np.abs(function - total).max())]
            for name, (function, formula, total) in exact_sums(x, y).items()]
    return table(["Function", "As a sum", "Largest difference"], rows)


def ridges(fits, along_axes):
    """Residuals of sums of ridges: fits {name: `Ridges` of ten terms}, the product of x and y among them.

    along_axes: the `Ridges` of the product with two terms, at the angles of the axes.
    """
    angles = np.sort(np.degrees(fits["product"].angles[:2]))
    left = {name: 100 * fit.errors for name, fit in fits.items() if name != "product"}
    return (f"The product takes two ridges, found at {angles[0]:.0f}° and {angles[1]:.0f}°, as in its formula. "
            f"Functions of x alone and of y alone, without inner sums, explain little of it: they leave "
            f"{100 * along_axes.errors[2]:.0f} % of its spread. Five ridges leave "
            + ", ".join(f"{each[5]:.1f} % of the {name}" for name, each in left.items())
            + "; ten leave " + ", ".join(f"{each[10]:.1f} %" for each in left.values())
            + f". The outer functions are polynomials of degree {DEGREE}, which cannot represent the kink of the "
              f"larger one or the tip of the distance, however many there are.")
