"""Figures of chapter 4: walks, parts of series, sums of functions, overlaps, policies, learned values, load."""

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.colors import LinearSegmentedColormap, to_rgb
from matplotlib.ticker import MaxNLocator, PercentFormatter

from lib.chapter_4.credit import ROLES
from lib.chapter_4.noise import expected_squared_displacement
from lib.chapter_4.superposition import misled
from lib.shared.grid_figures import draw_grid, draw_policy, new_grids
from lib.shared.panels import add_curves
from lib.shared.style import UNDER_WHITE
from neorl.drawing.curves import add_estimates
from neorl.drawing.style import AGENT, CURVES, GREEN, INK, RED, letters, name_ends
from neorl.evidence.statistics import mean_band


def draw_walks(paths_by_title, goal):
    """Draw walks in three dimensions, a panel per title, and the goal of the last: {title: (walks, steps + 1, 3)}."""
    width, _ = plt.rcParams["figure.figsize"]
    figure, panels = plt.subplots(1, len(paths_by_title), figsize=(width, 0.64 * width),
                                  subplot_kw={"projection": "3d", "computed_zorder": False})
    for axes, (title, paths) in zip(panels, paths_by_title.items()):
        for path, colour in zip(paths, CURVES):
            axes.plot(*path.T, color=colour, linewidth=0.7)
            axes.plot(*path[-1:].T, color=colour, marker="o", markersize=7, markeredgecolor="white", zorder=3)
        axes.plot(0, 0, 0, color=UNDER_WHITE, marker="X", markersize=11, markeredgecolor="white", zorder=4)
        for axis in (axes.xaxis, axes.yaxis, axes.zaxis):
            axis.set_pane_color((0.5, 0.5, 0.5, 0.08))
            axis.line.set_color(INK)
            axis.set_ticks([])
        axes.set_title(title, pad=10)
        low, high = paths.min(axis=(0, 1)), paths.max(axis=(0, 1))
        middle, reach = (low + high) / 2, (high - low).max() / 2
        axes.set(**dict(zip(("xlim", "ylim", "zlim"), zip(middle - reach, middle + reach))))
        axes.set_box_aspect((1, 1, 1), zoom=1.2)
        axes.text2D(0.5, -0.1, f"{2 * reach:.0f} steps wide", transform=axes.transAxes, ha="center", va="top")
    panels[-1].plot(*np.transpose([goal]), color=INK, marker="*", markersize=22, fillstyle="none", zorder=4)


def draw_displacements(lags, squared):
    """Draw root mean square distance over steps on logarithmic axes: squared {β: (runs, lags)}.

    Points are measured, with the 95 % interval of the mean; lines are expected under a constant drift.
    """
    axes = plt.figure().add_subplot()
    ends, fine = [], np.geomspace(lags[0], lags[-1], 100)
    for (strength, curves), colour in zip(squared.items(), CURVES):
        expected = np.log10(expected_squared_displacement(strength, fine)) / 2
        axes.plot(fine, expected, color=colour, linewidth=1.2)
        axes.plot(lags, np.log10(curves.mean(axis=0)) / 2, color=colour, linestyle="none", marker="o", markersize=5)
        axes.vlines(lags, *np.log10(mean_band(curves)) / 2, color=colour)
        ends.append((expected[-1], f"β = {strength:g}", colour))
    axes.set(xlabel="steps", ylabel="distance", xscale="log")
    _as_powers(axes.yaxis)
    name_ends(axes, ends)


def draw_parts(time, panels):
    """Draw series in stacked panels {title: {name: (points,)}} over time (points,), the last of each in a thin line."""
    width, _ = plt.rcParams["figure.figsize"]
    figure, grid = plt.subplots(len(panels), 1, sharex=True, sharey=True, figsize=(width, 1.4 * len(panels)))
    for axes, (title, curves) in zip(grid, panels.items()):
        for place, (name, values) in enumerate(curves.items()):
            wide = {"linewidth": 4.5, "alpha": 0.45} if place < len(curves) - 1 else {"linewidth": 1.2}
            axes.plot(time, values, color=CURVES[place], **wide)
            axes.annotate(name, (1.02, 0.7 - 0.3 * place), xycoords="axes fraction",
                          color=letters(CURVES[place]), va="center")
        axes.set_title(title, loc="left")
    grid[-1].set(xlabel="steps", xlim=(time[0], time[-1]))


def draw_errors(errors_by_name, terms):
    """Draw the residual of sums over their terms, on a logarithmic axis, a line at ``terms``: {name: (terms + 1,)}."""
    axes = plt.figure().add_subplot()
    ends = []
    for (name, errors), colour in zip(errors_by_name.items(), CURVES):
        shown = np.log10(np.maximum(errors, 1e-4))
        axes.plot(shown, color=colour, marker="o", markersize=4)
        ends.append((shown[-1], name, colour))
    axes.axvline(terms, color=INK, linewidth=1, linestyle="--")
    axes.set(xlabel="terms", ylabel="residual, share of the spread")
    axes.xaxis.set_major_locator(MaxNLocator(integer=True))
    _as_powers(axes.yaxis)
    name_ends(axes, ends)


def draw_overlaps(matrices):
    """Draw square matrices side by side, from 0, transparent, to 1, opaque: {title: (n, n)}."""
    width, _ = plt.rcParams["figure.figsize"]
    figure, panels = plt.subplots(1, len(matrices), figsize=(width, 0.62 * width))
    figure.get_layout_engine().set(wspace=0.12)
    opacity = LinearSegmentedColormap.from_list("", [(*to_rgb(AGENT), 0.0), (*to_rgb(AGENT), 1.0)])
    for axes, (title, matrix) in zip(panels, matrices.items()):
        axes.imshow(matrix, cmap=opacity, vmin=0, vmax=1)
        axes.set(title=title, xlabel="cell", xticks=[0, len(matrix) - 1], yticks=[0, len(matrix) - 1])
    panels[0].set_ylabel("cell")


def draw_policies(grid, q_by_title, valences):
    """Draw the best actions of two or more q (states, 4) side by side: {title: q}; valences {state: valence}.

    A state of the first panel is ringed if one of its best actions is not among those of the last panel.
    """
    colours = {state: (GREEN if valence > 0 else RED, 0.95) for state, valence in valences.items()}
    first, *_, last = q_by_title.values()
    panels = new_grids(grid, columns=len(q_by_title))
    for axes, (title, q) in zip(panels, q_by_title.items()):
        draw_grid(axes, grid, colours)
        shown = np.where(np.isin(np.arange(grid.states), list(valences))[:, None], 0.0, q)
        draw_policy(axes, grid, shown)
        axes.set_title(title)
        for state, valence in valences.items():
            axes.text(*grid.places[state], "+" if valence > 0 else "−", ha="center", va="center", weight="bold",
                      color="white", fontsize=14)
    for state in misled(first, last, valences):
        panels[0].plot(*grid.places[state], marker="o", markersize=25, fillstyle="none", color=RED)


def draw_roles(values_by_rule):
    """Draw the values of events, a panel for each rule: {title: (runs, visits, roles)}."""
    width, _ = plt.rcParams["figure.figsize"]
    figure, grid = plt.subplots(len(values_by_rule), 1, sharex=True, figsize=(width, 3.1 * len(values_by_rule)))
    for axes, (title, values) in zip(grid, values_by_rule.items()):
        visits = 1 + np.arange(values.shape[1])
        add_curves(axes, visits, {role: values[..., at] for at, role in enumerate(ROLES)}, title=title, ylabel="value",
                   xscale="log", xlim=(1, visits[-1]), ylim=(0, None))
    grid[-1].set_xlabel("visits")


def draw_estimates(xs, estimates_by_name, xlabel, ylabel, logarithmic=False):
    """Draw values with their 95 % intervals against xs: {name: [Estimate for each of xs]}."""
    axes = plt.figure().add_subplot()
    axes.set_xscale("symlog" if logarithmic and min(xs) == 0 else "log" if logarithmic else "linear")
    axes.set(xlabel=xlabel, ylabel=ylabel, xticks=xs, xticklabels=[f"{x:g}" for x in xs])
    axes.minorticks_off()
    add_estimates(axes, xs, estimates_by_name, linewidth=1.2)


def draw_load(load, seconds):
    """Draw the load of each window, in cores (windows,), on a logarithmic axis. seconds: length of a window."""
    axes = plt.figure(figsize=(plt.rcParams["figure.figsize"][0], 2.6)).add_subplot()
    axes.plot((np.arange(len(load)) + 0.5) * seconds, load, color=CURVES[0], marker="o", markersize=5)
    axes.set(xlabel="wall-clock seconds", ylabel="share of a core", yscale="log", ylim=(0.003, 1.5),
             xlim=(0, len(load) * seconds))
    axes.yaxis.set_major_formatter(PercentFormatter(1.0, decimals=0, symbol=" %"))
    axes.axhline(1.0, color=INK, linewidth=1, linestyle="--")
    axes.annotate("one core", (1, 1), (0, -3), xycoords=("axes fraction", "data"), textcoords="offset points",
                  ha="right", va="top")


def _as_powers(axis):
    """Label an axis of logarithms with the powers of ten."""
    axis.set_major_locator(MaxNLocator(integer=True))
    axis.set_major_formatter(lambda power, _: f"$10^{{{power:.0f}}}$")
