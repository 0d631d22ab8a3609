"""Figures of the page on the forager. A sample of rates is float64 (runs,)."""

import numpy as np

from companion.page.panels import add_curves
from neorl.drawing.style import CURVES, GREEN, INK, RED, axes_or_new
from neorl.statistics import estimate


def draw_parts(way, without):
    """Draw reward per second as parts are added in turn, and of the whole without each part: a row per part.

    way: {agent: rates}, from the bare agent to the whole. without: {part: rates}, in the order of the rows.
    """
    axes = axes_or_new(None, figsize=(4.9, 4.2))
    added, left = ([estimate(np.mean, each) for each in rates.values()] for rates in (way, without))
    axes.errorbar([each.value for each in added], range(len(way)), xerr=_bars(added), fmt="o", color=CURVES[0],
                  label="parts added in turn")
    axes.errorbar([each.value for each in left], range(1, len(way)), xerr=_bars(left), fmt="D", color=CURVES[5],
                  label="the whole without it")
    axes.axvline(added[-1].value, color=INK, linewidth=0.7)
    axes.set_xlabel("reward per second, last third")
    _rows(axes, way)


def draw_oracles(boards):
    """Draw reward per second of foragers and planners: {creeps: {name: rates}}."""
    axes = axes_or_new(None, figsize=(4.9, 3.6))
    for (colour, shape), (creeps, rates) in zip(((CURVES[0], "o"), (CURVES[5], "D")), boards.items()):
        found = [estimate(np.mean, each) for each in rates.values()]
        axes.errorbar([each.value for each in found], range(len(found)), xerr=_bars(found), fmt=shape, color=colour,
                      label=f"{creeps} creeps")
    axes.set_xlabel("reward per second")
    _rows(axes, rates)


def _bars(estimates):
    """Lengths of the error bars of estimates: (2, rows)."""
    return np.array([[each.value - each.low, each.high - each.value] for each in estimates]).T


def _rows(axes, names):
    axes.set_yticks(range(len(names)), list(names))
    axes.invert_yaxis()
    axes.legend(frameon=False, fontsize=9, loc="lower left")


def draw_revalued(result):
    """Draw creeps met per second, by kind, with a line where red becomes worth as much as green."""
    minutes, rates = hits_per_second(result)
    axes = axes_or_new(None)
    add_curves(axes, minutes, rates, (GREEN, RED), xlabel="simulated minutes", ylabel="creeps per second",
               xlim=(0, minutes[-1]), ylim=(0, None))
    axes.axvline(result.seconds / 120, color=INK, linewidth=0.7)


def hits_per_second(result, stretches=30):
    """Minutes, and the creeps of each kind met per second over the run: {"green": (runs, stretches), "red": …}."""
    bins = np.array_split(np.arange(result.hits.shape[1]), min(stretches, result.hits.shape[1]))
    seconds = np.array([result.edges[each[-1] + 1] - result.edges[each[0]] for each in bins])
    middles = np.array([(result.edges[each[-1] + 1] + result.edges[each[0]]) / 120 for each in bins])
    counts = np.array([result.hits[:, each].sum(axis=1) for each in bins])  # (stretches, runs, kinds)
    rates = counts / seconds[:, None, None]
    return middles, {kind: rates[:, :, number].T for number, kind in enumerate(result.world.kinds)}
