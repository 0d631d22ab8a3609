"""Figures of the page on the forager. A sample of rates is float64 (runs,)."""

import numpy as np
from matplotlib import pyplot as plt

from companion.beyond_agents import ideas
from companion.page.panels import add_curves
from neorl.drawing.style import CURVES, GREEN, INK, RED, axes_or_new, width_of_figures
from neorl.statistics import estimate


def draw_parts(way, without, whole, way_label="parts added in turn", ax=None):
    """Draw reward per second of a bare agent and with each part, and of the whole without each part: a row per part.

    way: {agent: rates}, first of the bare agent. without: {part: rates}, in the order of the rows. whole: its rates.
    """
    axes = axes_or_new(ax, figsize=(4.9, 4.2))
    added, left = ([estimate(np.mean, each) for each in rates.values()] for rates in (way, without))
    axes.errorbar([each.value for each in added], range(len(way)), xerr=_bars(added), fmt="o", color=CURVES[0],
                  label=way_label)
    axes.errorbar([each.value for each in left], range(1, len(way)), xerr=_bars(left), fmt="D", color=CURVES[5],
                  label="the whole without it")
    axes.axvline(np.mean(whole), color=INK, linewidth=0.7)
    axes.set_xlabel("reward per second, last third")
    _rows(axes, way)


def draw_ideas(boards):
    """Draw reward per second, over the last third, of the recorded foragers with ideas of after-states: a panel a tank.

    boards: the numbers of creeps.
    """
    _, panels = plt.subplots(len(boards), 1, figsize=(width_of_figures(), 2.7 * len(boards)), layout="constrained")
    for axes, creeps in zip(panels, boards):
        last = {name: ideas.thirds_of(name, creeps)[:, -1] for name in ideas.agents()}
        alone = {ideas.WITHOUT: last[ideas.WITHOUT]} | {idea: last[f"{idea} alone"] for idea in ideas.IDEAS}
        without = {idea: last[f"all but {idea}"] for idea in ideas.IDEAS}
        draw_parts(alone, without, last[ideas.ALL], "each alone", axes)
        axes.set_title(f"{creeps} creeps")
        axes.get_legend().remove()
    panels[0].legend(frameon=False, fontsize=9, loc="upper right")


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
