"""Curves of reward: over a run, over several runs, and over a parameter that is varied.

Each function draws any number of curves by name into `ax`, or into a new figure, and returns the axes. Curves over a
run are drawn to scale: one of 2 minutes ends at 2 minutes, beside one of 20.
"""

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.transforms import offset_copy
from numpy.typing import ArrayLike

from neorl.common import checks
from neorl.drawing.style import INK, axes_or_new, by_name, looks, name_ends, numbers
from neorl.experiments.result import Result
from neorl.statistics import FEWEST_RUNS, Estimate, binned_rate, mean_band, tolerance_band

POINTS = 400  # per curve; more would not be visible
APART = 3  # points between intervals at one x


def draw_accumulated(results: Mapping[str, Result], control: Mapping[str, Result] | None = None,
                     ax: Axes | None = None) -> Axes:
    """Draw accumulated reward over steps with its tolerance band, or of fewer than ten runs each run.

    results: {name: `neorl.Result`}. control: another such dict, drawn in grey.
    Raises ValueError for anything else, or for an empty dict.

    >>> results = {"N7": neorl.simulate(neorl.place_cells([7]), neorl.WaterWorld(), steps=5_000, runs=4)}
    >>> axes = drawing.draw_accumulated(results)
    """
    results, control = _checked(results), {} if control is None else _checked(control, "control")
    curves = []
    for name, result in (*results.items(), *control.items()):
        points = np.linspace(0, result.rewards.shape[1] - 1, POINTS).astype(int)
        steps = result.time[points] * result.world.fps / 1000
        curves.append((name, steps, result.rewards.cumsum(axis=1, dtype=float)[:, points]))
    styles = looks(len(results)) + [(INK, "-")] * len(control)
    return _draw(curves, "steps, in thousands", "accumulated reward", styles, ax, tolerance_band, opacity=0.18)


def draw_proficiency(results: Mapping[str, Result], points: int = 50, ax: Axes | None = None) -> Axes:
    """Draw mean reward per second over the run with the 95 % interval of the mean, or of fewer than ten runs each run.

    results: {name: `neorl.Result`}. points: per curve, integer ≥ 1. Raises ValueError for anything else.

    >>> results = {"N7": neorl.simulate(neorl.place_cells([7]), neorl.WaterWorld(), steps=5_000, runs=4)}
    >>> axes = drawing.draw_proficiency(results, points=10)
    """
    points = checks.integer("points", points, at_least=1)
    return draw_sums([(name, [result]) for name, result in _checked(results).items()], looks(len(results)), points, ax)


def draw_sums(sums, styles, points=50, ax=None):
    """As `draw_proficiency`, for the sums of results, run by run: [(name, [`Result`, …]), …].

    styles: the colour and the dashes of each. Results of a sum are of as many runs and steps.
    """
    curves = []
    for name, results in sums:
        number = min(points, results[0].rewards.shape[1])
        minutes = (np.arange(number) + 0.5) / number * results[0].seconds / 60
        curves.append((name, minutes, sum(binned_rate(result, number) for result in results)))
    axes = _draw(curves, "simulated minutes", "reward per second", styles, ax)
    axes.set_xlim(0, max(results[0].seconds for _, results in sums) / 60)
    axes.axhline(0, color=INK, linewidth=0.7, zorder=1)
    return axes


def _checked(results, what="results"):
    for name, result in by_name(what, results).items():
        checks.instance(f"{what}[{name!r}]", result, Result)
    return results


def draw_curves(xs: ArrayLike, curves: Mapping[str, ArrayLike], xlabel: str = "", ylabel: str = "",
                ax: Axes | None = None) -> Axes:
    """Draw means over runs with their 95 % intervals, or where there are fewer than ten, each run.

    xs: (points,), from 0 on. curves: {name: (runs, points)}; NaN leaves a gap.
    xlabel, ylabel: of the axes.
    Raises ValueError for curves of other shapes, or without a finite number.

    >>> rng = np.random.default_rng(0)
    >>> axes = drawing.draw_curves(np.arange(20), {"luck": rng.random((8, 20)).cumsum(axis=1)}, "days", "gold")
    """
    xs, checked = checks.doubles("xs", xs), []
    for name, curve in by_name("curves", curves).items():
        curve = numbers(f"curves[{name!r}]", curve)
        checked.append((name, xs, curve))
        if xs.ndim != 1 or curve.ndim != 2 or not curve.size or curve.shape[1] != len(xs):
            raise ValueError(f"curves[{name!r}] must have the shape (runs, points), over xs of the shape {xs.shape}, "
                             f"but has {curve.shape}")
    return _draw(checked, xlabel, ylabel, looks(len(checked)), ax)


def _draw(curves, xlabel, ylabel, styles, ax, band=mean_band, opacity=0.2):
    """Axes with the means of curves, [(name, xs (points,), ys (runs, points))], and their spread."""
    axes, ends = axes_or_new(ax), []
    for (name, xs, curve), (colour, dashes) in zip(curves, styles):
        mean = curve.mean(axis=0)
        numbers = mean[np.isfinite(mean)]
        if not len(numbers):
            raise ValueError(f"curves[{name!r}] must have a finite number or more, but has none")
        axes.plot(xs, mean, color=colour, linestyle=dashes)
        add_spread(axes, xs, curve, colour, band, opacity)
        ends.append((numbers[-1], name, colour))
    axes.set(xlabel=xlabel, ylabel=ylabel, xlim=(0, max(xs[-1] for _, xs, _ in curves)))
    name_ends(axes, ends)
    return axes


def add_spread(axes, xs, curve, colour, band=mean_band, opacity=0.2):
    """Add what runs say of a mean: the band of curve (runs, points), or of fewer than ten runs each as a thin line."""
    if len(curve) >= FEWEST_RUNS:
        axes.fill_between(xs, *band(curve), color=colour, alpha=opacity, linewidth=0)
    elif len(curve) > 1:
        axes.add_collection(LineCollection([np.column_stack([xs, run]) for run in curve], colors=[colour],
                                           linewidths=0.7, alpha=0.5))


def draw_sweep(xs: ArrayLike, estimates_by_name: Mapping[str, Sequence[Estimate]], xlabel: str = "",
               ylabel: str = "reward per second", ax: Axes | None = None) -> Axes:
    """Draw reward against a parameter, with 95 % intervals.

    xs: (points,). estimates_by_name: {name: [`neorl.statistics.Estimate` for each of xs]}.
    xlabel, ylabel: of the axes.
    Raises ValueError for anything else.

    >>> from neorl.statistics import Estimate
    >>> axes = drawing.draw_sweep([3, 7], {"place cells": [Estimate(0.1, 0.0, 0.2), Estimate(0.3, 0.2, 0.5)]}, "N")
    """
    xs = checks.doubles("xs", xs)
    for name, estimates in by_name("estimates_by_name", estimates_by_name).items():
        shape = numbers(f"estimates_by_name[{name!r}]", estimates).shape
        if xs.ndim != 1 or shape != (len(xs), 3):
            raise ValueError(f"estimates_by_name[{name!r}] must have an Estimate for each of xs, of the shape "
                             f"{xs.shape}, but has the shape {shape}")
    axes = axes_or_new(ax)
    axes.axhline(0, color=INK, linewidth=0.7)
    axes.set(xlabel=xlabel, ylabel=ylabel)
    add_estimates(axes, xs, estimates_by_name, linewidth=0.8)
    return axes


def add_estimates(axes, xs, estimates_by_name, linewidth):
    """Add points with their 95 % intervals, joined by lines: {name: [Estimate for each of xs]}.

    Intervals at one x stand side by side, so that none hides the end of another.
    """
    ends, middle = [], (len(estimates_by_name) - 1) / 2
    styles = looks(len(estimates_by_name))
    for rank, ((name, estimates), (colour, dashes)) in enumerate(zip(estimates_by_name.items(), styles)):
        value, low, high = np.array(estimates).T
        (curve,) = axes.plot(xs, value, color=colour, linewidth=linewidth, linestyle=dashes, marker="o", markersize=5)
        intervals = axes.vlines(xs, low, high, color=colour, linewidth=1.8)
        for each in (curve, intervals):  # moved once the limits of the axes include them
            each.set_transform(offset_copy(axes.transData, axes.figure, (rank - middle) * APART, units="points"))
        ends.append((value[-1], name, colour))
    name_ends(axes, ends)
