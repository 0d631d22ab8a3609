"""The figures of the calibration: the thesis's figures as predicted by readings, which claims hold together, the
posterior of each choice and of pairs, and how the search converged.
"""

from textwrap import fill

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, Rectangle

from companion.shared.priors import WITHIN
from companion.shared.smoothing import low_passed
from companion.study.calibration_results import INTERVALS, marginal, progress
from companion.study.calibration_targets import TARGETS
from companion.study.multiverse import binned
from companion.study.multiverse_figures import SHADES
from neorl.drawing.style import (AGENT, CURVES, INK, RED, SMALL, TEXT, axes_or_new, name_ends,
                                 width_of_figures)
from neorl.statistics import binned_rate

ROW = 0.15  # inches, for a bar with its name
NARROW = 12  # letters per line
ROOMY = 4  # most levels whose labels do not touch in a pair's panel
POINTS = 100  # of a predicted curve
COLUMNS = 2  # of panels


def draw_marginals(remaining, nearest):
    """Each choice before (outlines), after (bars) and in the nearest readings (points)."""
    each = [marginal(name, remaining) for name in WITHIN]
    rows = [each[i : i + COLUMNS] for i in range(0, len(each), COLUMNS)]
    heights = [max(len(found.levels) for found in row) for row in rows]
    figure = plt.figure(figsize=(width_of_figures(), sum(ROW * high + 0.42 for high in heights)),
                        layout="constrained")
    grid = figure.subplots(len(rows), COLUMNS, height_ratios=heights, squeeze=False)
    for axes, name, found in zip(grid.flat, WITHIN, each):
        at = np.arange(len(found.levels))
        axes.barh(at, found.posterior, 0.8, color=AGENT, alpha=0.75)
        axes.barh(at, found.prior, 0.8, fill=False, edgecolor=INK, linewidth=0.8)
        axes.plot(marginal(name, nearest).posterior, at, linestyle="none", marker="o", markersize=2.5, color=RED)
        axes.set_yticks(at, [level.replace(" … ", "…") for level in found.levels], fontsize=SMALL)
        axes.set_title(WITHIN[name].label, size=SMALL, color=TEXT, pad=2)
        axes.set(ylim=(len(at) - 0.4, -0.6), xlim=(0, None), xticks=[])
        axes.tick_params(length=0)
        axes.spines["bottom"].set_visible(False)
    for axes in grid.flat[len(each):]:
        axes.set_visible(False)
    handles = [Patch(facecolor="none", edgecolor=INK), Patch(color=AGENT, alpha=0.75),
               Line2D([], [], linestyle="none", marker="o", markersize=3, color=RED)]
    figure.legend(handles, ["before", "after", "nearest readings"], loc="outside upper center", ncols=3, frameon=False,
                  fontsize=SMALL)


def draw_pairs(remaining, names):
    """The joint posterior of pairs of choices, and on the diagonal the marginal of each."""
    size = width_of_figures()
    grid = plt.figure(figsize=(size, size), layout="constrained").subplots(len(names), len(names), squeeze=False)
    cut = [binned(name, remaining.readings, INTERVALS) for name in names]
    for i, (below, _, down) in enumerate(cut):
        for j, (beside, _, across) in enumerate(cut):
            axes = grid[i, j]
            if j > i:
                axes.set_visible(False)
                continue
            shares = np.zeros((len(below), len(beside)))
            np.add.at(shares, (down, across), remaining.weights)
            if i == j:
                axes.bar(np.arange(len(below)), np.diag(shares), 0.8, color=AGENT, alpha=0.75)
                axes.spines["left"].set_visible(False)
            else:
                axes.imshow(shares, aspect="auto", cmap=SHADES, vmin=0, interpolation="nearest")
            axes.set(xticks=[], yticks=[])
            if j == 0 and i > 0:
                axes.set_yticks(*_spaced(below), fontsize=SMALL)
                axes.set_ylabel(fill(WITHIN[names[i]].label, NARROW), fontsize=SMALL)
            if i == len(names) - 1:
                axes.set_xticks(*_spaced(beside), fontsize=SMALL, rotation=90)
                axes.set_xlabel(fill(WITHIN[names[j]].label, NARROW), fontsize=SMALL)
            axes.tick_params(length=0)


def _spaced(levels):
    """Positions and labels of ticks: the lower ends of intervals, every second one if there are many levels."""
    every = slice(None, None, 2 if len(levels) > ROOMY else 1)
    return range(len(levels))[every], [level.split(" … ")[0] for level in levels[every]]


def draw_together(together):
    """Which claims hold together: % of the readings with both measured in which both hold, on the diagonal each alone.

    A cross marks pairs that never hold together, although by chance some readings would.
    """
    axes = axes_or_new(None, figsize=(width_of_figures(), width_of_figures()))
    share = np.divide(together.both, together.rows, out=np.zeros(together.both.shape), where=together.rows > 0)
    never = set(together.never)
    for i, below in enumerate(together.claims):
        for j, beside in enumerate(together.claims[: i + 1]):
            crossed = (beside, below) in never
            axes.text(j, i, "×" if crossed else f"{100 * share[i, j]:.0f}", ha="center", va="center", fontsize=SMALL,
                      color=RED if crossed else TEXT, weight="bold" if crossed or i == j else "normal")
            axes.barh(i + 0.36, share[i, j] * 0.84, 0.14, left=j - 0.42, color=AGENT)
    axes.set_xticks(range(len(share)), together.claims, fontsize=SMALL)
    axes.set_yticks(range(len(share)), together.claims, fontsize=SMALL)
    axes.set(xlim=(-0.5, len(share) - 0.5), ylim=(len(share) - 0.4, -0.5))
    axes.tick_params(length=0)
    axes.spines[:].set_visible(False)


def draw_conflicts(found, row):
    """What each target that a row misses goes together with least: all readings that were run, by both statistics.

    Shaded is where both targets are met; the row is a ring, and 96 % of the readings are shown.
    """
    high = -(-len(found) // COLUMNS)
    figure = plt.figure(figsize=(width_of_figures(), 2.1 * high), layout="constrained")
    grid = figure.subplots(high, COLUMNS, squeeze=False)
    for axes, conflict in zip(grid.flat, found):
        names = conflict.missed, conflict.met
        limits = []
        for values, name in zip(conflict.found.T, names):
            target, here = TARGETS[name], row.statistics[name].value
            ends = [*np.quantile(values, [0.02, 0.98]), here, *(end for end in (target.low, target.high)
                                                                if np.isfinite(end))]
            room = 0.08 * (max(ends) - min(ends))
            limits.append((min(ends) - room, max(ends) + room))
        (left, right), (bottom, top) = limits
        (low, high_end), (under, over) = ((max(TARGETS[name].low, begin), min(TARGETS[name].high, end))
                                          for name, (begin, end) in zip(names, limits))
        axes.add_patch(Rectangle((low, under), high_end - low, over - under, color=AGENT, alpha=0.25, linewidth=0))
        axes.plot(*conflict.found.T, linestyle="none", marker="o", markersize=1.5, alpha=0.4, color=AGENT)
        axes.plot(*(row.statistics[name].value for name in names), marker="o", markersize=6, markerfacecolor="none",
                  markeredgecolor=RED)
        axes.set(xlim=(left, right), ylim=(bottom, top))
        across, up = (fill(f"{TARGETS[name].claim}: {TARGETS[name].label}", 2 * NARROW) for name in names)
        axes.set_xlabel(across, fontsize=SMALL)
        axes.set_ylabel(up, fontsize=SMALL)
        axes.set_title(f"{conflict.both:,} meet both, by chance {conflict.expected:,.0f}", size=SMALL, color=TEXT,
                       loc="right")  # a heading is wider than its panel, and there is room on the left
        axes.tick_params(labelsize=SMALL)
    for axes in grid.flat[len(found):]:
        axes.set_visible(False)


def draw_along(values, rows, names):
    """Statistics of targets over the values of one choice, a panel each, with the band in which each agrees.

    rows: for each of the values, a `Row` with these targets. names: of `TARGETS`.
    """
    figure = plt.figure(figsize=(width_of_figures(), 1.3 * len(names)), layout="constrained")
    for axes, name in zip(figure.subplots(len(names), 1, sharex=True), names):
        found, errors = np.transpose([row.statistics[name] for row in rows])
        axes.errorbar(values, found, errors, color=AGENT, marker="o", markersize=3.5, linewidth=1.2)
        ends = [end for end in (TARGETS[name].low, TARGETS[name].high) if np.isfinite(end)]
        low, high = min([axes.get_ylim()[0], *ends]), max([axes.get_ylim()[1], *ends])
        axes.axhspan(max(TARGETS[name].low, low), min(TARGETS[name].high, high), color=AGENT, alpha=0.15, linewidth=0)
        axes.set(xscale="log", ylim=(low, high))
        axes.set_title(f"{TARGETS[name].claim}: {TARGETS[name].label}", size=SMALL, color=TEXT, loc="left")
        axes.tick_params(labelsize=SMALL)
    axes.set_xticks(values, [f"{value:g}" for value in values])
    axes.minorticks_off()
    axes.set_xlabel("memory, cells")


def draw_distances(table):
    """The distance of readings to all targets, wave by wave: those with all groups measured, and the nearest so far."""
    axes = axes_or_new(None)
    complete = [row for row in table if row.complete]
    shift = np.random.default_rng(0).uniform(-0.3, 0.3, len(complete))  # so that points do not overlap
    axes.plot([row.wave for row in complete] + shift, [row.distance for row in complete], linestyle="none", marker="o",
              markersize=3, alpha=0.5, color=AGENT)
    nearest = {wave: least for wave, least in progress(table).items() if np.isfinite(least)}
    axes.step(list(nearest), list(nearest.values()), where="mid", color=RED)
    axes.set(xlabel="wave", ylabel="distance to all targets", ylim=(0, None))
    axes.xaxis.get_major_locator().set_params(integer=True)
    name_ends(axes, [(list(nearest.values())[-1], "nearest", RED)])


def draw_accumulated(results, keys):
    """Accumulated reward of conditions, the mean over runs. results, keys: see `draw_rates`."""
    def accumulated(result):
        edges = np.linspace(0, result.rewards.shape[1] - 1, POINTS).astype(int)
        return result.rewards.mean(axis=0).cumsum(dtype=float)[edges]

    axes = _draw_curves({name: [accumulated(each[key]) for each in results] for name, key in keys.items()},
                        _minutes(results, keys))
    axes.set_ylabel("accumulated reward")


def draw_rates(results, keys, total=()):
    """Reward per second of conditions under several readings, low-passed means over runs.

    results: {key: `Result`} of each reading, the first drawn thick. total: names whose sum is grey.
    """
    curves = {name: [low_passed(binned_rate(each[key], POINTS).mean(axis=0, keepdims=True))[0] for each in results]
              for name, key in keys.items()}
    colours = CURVES[:len(curves)]
    if total:
        curves["sum"], colours = [sum(alone) for alone in zip(*(curves[name] for name in total))], (*colours, INK)
    return _draw_curves(curves, _minutes(results, keys), colours)


def mark_minutes(axes, minutes):
    """Mark times as dotted lines with their names, if they lie within the axes. minutes: of simulated time."""
    for minute in minutes:
        if minute <= axes.get_xlim()[1]:
            axes.axvline(minute, color=INK, linewidth=0.9, linestyle=":")
            axes.annotate(f"{minute:g} min", (minute, 0.99), xycoords=("data", "axes fraction"), color=TEXT,
                          fontsize=SMALL, va="top")


def _minutes(results, keys):
    """The minutes of the runs of each reading, which are the same for all of `keys`."""
    key, *_ = keys.values()
    return [each[key].seconds / 60 for each in results]


def _draw_curves(curves, lengths, colours=CURVES):
    """Axes with curves {name: [(POINTS,) of each reading]}, the first of each thick. lengths: in minutes, of each."""
    axes, ends = axes_or_new(None), []
    middles = (np.arange(POINTS) + 0.5) / POINTS
    for (name, (first, *others)), colour in zip(curves.items(), colours):
        for other, minutes in zip(others, lengths[1:]):
            axes.plot(middles * minutes, other, color=colour, linewidth=0.6, alpha=0.45, zorder=2)
        axes.plot(middles * lengths[0], first, color=colour, linewidth=2.0, zorder=3)
        ends.append((first[-POINTS // 10:].mean(), name, colour))
    axes.axhline(0, color=INK, linewidth=0.7, zorder=1)
    axes.set(xlabel="simulated minutes", ylabel="reward per second", xlim=(0, max(lengths)), ylim=axes.get_ylim())
    name_ends(axes, ends)
    return axes
