"""The record behind a figure: what the recorded runs of the same agents earned, pale, below the few runs of a page.

1. `curves.json` has the mean reward per second of each recorded condition in `BINS` parts of its runs, with its 95 %
   interval, and that of the whole run and of its last fifth. `book/computing/record.py` computes it.
2. Where a page has fewer than `FEWEST_RUNS` runs of a condition that the record has, the record is drawn, and named
   with its number of runs; the page's own runs go over it. From there on a page's own intervals stand for themselves.
"""

import json
from functools import cache
from importlib import resources
from typing import NamedTuple

import numpy as np

from companion import thesis
from companion.page import judging, report
from companion.thesis.reading import LENGTHS, READINGS, conditions
from neorl import Condition, WaterWorld, forager
from neorl.agents.forager import AFTER_STATES
from neorl.drawing.style import INK, SMALL, looks
from neorl.statistics import FEWEST_RUNS, Estimate

CURVES = resources.files(thesis) / "curves.json"
FORAGERS = {name: Condition(agent, WaterWorld(n_creeps=3), LENGTHS["A"], 1) for name, agent in {  # of the page beyond
    "forager": forager(), "forager of after-states": forager(**AFTER_STATES)}.items()}
BINS = 50
PALE = 0.22  # opacity


class Recorded(NamedTuple):
    """What recorded runs of a condition earned per second."""

    runs: int
    minutes: float  # simulated, of a run
    curve: np.ndarray  # (3, BINS): mean and the ends of its interval
    whole: Estimate
    final: Estimate


def recorded(result):
    """What the record has of the agents of a `Result` or `Condition` in their world: `Recorded`, or None."""
    key = next((each for each, condition in _known().items() if judging.same(result, condition)), None)
    return key and recorded_runs(*key)


def recorded_runs(reading, name):
    """What the record has of a condition under a reading, by its name in `curves.json`: `Recorded`."""
    found = _curves()[reading][name]
    return Recorded(found["runs"], found["minutes"], np.array(found["curve"]),
                    *(report.estimate_of(found[share]) for share in ("whole", "final")))


def curves_of(conditions):
    """What the record has of those that an Explorer offers, {name: `Condition` or `Result`}, for its `behind`."""
    known = {name: recorded(condition) for name, condition in conditions.items()}
    return {name: (found.minutes, *found.curve, f"the record, {found.runs:,} runs")
            for name, found in known.items() if found}


def words(key):
    """The name of a condition in `curves.json`. key: see `companion.thesis.reading.conditions`."""
    return key if isinstance(key, str) else " ".join(map(str, key))


def few(results):
    """What the record has of those of some results that have too few runs for intervals: {name: `Recorded`}."""
    found = {name: recorded(result) for name, result in results.items() if result.runs < FEWEST_RUNS}
    return {name: each for name, each in found.items() if each}


def add_recorded_rates(axes, results, styles=None):
    """Draw the recorded reward per second behind curves of `draw_proficiency`, and return the axes.

    results: {name: `Result`}, as drawn. styles: as in `draw_sums`, where the curves have styles of their own.
    """
    known, end = few(results), axes.get_xlim()
    for name, (colour, _) in zip(results, styles or looks(len(results))):
        if name in known:
            runs = known[name]
            xs = (np.arange(BINS) + 0.5) / BINS * runs.minutes
            mean, low, high = runs.curve
            axes.fill_between(xs, low, high, color=colour, alpha=PALE, linewidth=0, zorder=1)
            axes.plot(xs, mean, color=colour, alpha=2 * PALE, linewidth=4, zorder=1)
    axes.set_xlim(end)
    return _named(axes, [runs.runs for runs in known.values()])


def add_recorded_totals(axes, results):
    """Draw the recorded mean reward so far behind curves of `draw_accumulated`, and return the axes.

    results: {name: `Result`}, as drawn.
    """
    known, end = few(results), axes.get_xlim()
    for (name, result), (colour, _) in zip(results.items(), looks(len(results))):
        if name in known:
            seconds = 60 * known[name].minutes * np.arange(BINS + 1) / BINS
            total = np.append(0, known[name].curve[0].cumsum()) * seconds[1]
            axes.plot(seconds * result.world.fps / 1_000, total, color=colour, alpha=2 * PALE, linewidth=4, zorder=1)
    axes.set_xlim(end)
    return _named(axes, [runs.runs for runs in known.values()])


def add_recorded_levels(axes, xs, results, share="final"):
    """Draw recorded levels behind the points of a sweep or of rows, and return the axes.

    xs: where each is; or, for rows, the rows from the top as a `range`. results: {name: `Result`}. share: "final" or
    "whole" run.
    """
    known = few(results)
    return _add_levels(axes, xs, {name: getattr(known[name], share) if name in known else None for name in results},
                       [runs.runs for runs in known.values()])


def add_recorded_numbers(axes, results, claim, what):
    """Draw the recorded numbers of a claim behind the rows of a figure of few runs, and return the axes.

    results: {row: arrays (runs, …)}, of what each row shows. what: the name of the numbers, before that of the row.
    """
    found = report.record()["claims"][claim]
    if min(len(each) for pair in results.values() for each in pair) >= FEWEST_RUNS:
        return axes
    numbers = {name: found["numbers"].get(f"{what}, {name}") for name in results}
    return _add_levels(axes, range(len(results)), {name: number and report.estimate_of(number[0])
                                                   for name, number in numbers.items()}, [found["runs"]])


def add_recorded_points(axes, points, result, claim):
    """Draw numbers of a recorded claim behind the curve of a `Result` of few runs, and return the axes.

    points: {name of the number: where on the axis}. Nothing is drawn unless the record has the result's condition.
    """
    found = report.record()["claims"][claim]
    if result.runs >= FEWEST_RUNS or not recorded(result):
        return axes
    numbers = {name: report.estimate_of(found["numbers"][name][0]) for name in points}
    return _add_levels(axes, [*points.values()], numbers, [found["runs"]])


def _add_levels(axes, xs, estimates, runs):
    rows, reached = isinstance(xs, range), []
    for at, estimate in zip(xs, estimates.values()):
        if estimate:
            value, low, high = estimate
            (axes.hlines if rows else axes.vlines)(at, low, high, color=INK, alpha=PALE, linewidth=8, zorder=1)
            point = (value, at) if rows else (at, value)
            axes.plot(*point, color=INK, alpha=2 * PALE, marker="o", markersize=9, zorder=1)
            reached += [low, high]
    if reached:
        begin, end = axes.get_xlim() if rows else axes.get_ylim()
        margin = 0.04 * (end - begin)
        limits = min(begin, min(reached) - margin), max(end, max(reached) + margin)
        axes.set(**{"xlim" if rows else "ylim": limits})
    return _named(axes, runs)


def _named(axes, runs):
    if runs:
        some = " to ".join(f"{number:,}" for number in dict.fromkeys((min(runs), max(runs))))
        axes.annotate(f"pale: the record, {some} runs", (0, 1), xycoords="axes fraction", xytext=(0, 4),
                      textcoords="offset points", fontsize=SMALL, color=INK, va="bottom")
    return axes


@cache
def _curves():
    return json.loads(CURVES.read_text("utf-8")) if CURVES.is_file() else {}


@cache
def _known():
    """The conditions that the record has curves of: {(reading, name): `Condition`}."""
    of_papers = {(name, words(key)): condition for name, reading in READINGS.items() if name in _curves()
                 for key, condition in conditions(reading, LENGTHS["B"], 1).items() if words(key) in _curves()[name]}
    return of_papers | (
        {("calibrated", name): each for name, each in FORAGERS.items()} if of_papers else {})
