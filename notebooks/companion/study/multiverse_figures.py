"""The figures of the multiverse: the outcomes of all claims, the number of one claim under every reading, and the
choices that matter."""

import re

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.lines import Line2D
from matplotlib.patches import Rectangle
from scipy.stats import spearmanr

from companion.shared.priors import WITHIN
from companion.shared.style import FILL, mark
from neorl.drawing.style import AGENT, INK, RED, SMALL, TEXT, axes_or_new, width_of_figures
from companion.thesis.statements import STATEMENTS

GREY = "#8c8c8c"
# Each verdict has a fill and a marker of its own; agents that have learned too little leave the end of a bar empty.
BARS = {"reproduced": {"facecolor": AGENT, "edgecolor": AGENT},
        "partly": {"facecolor": (AGENT, FILL), "edgecolor": AGENT},
        "undecided": {"facecolor": (GREY, FILL), "edgecolor": GREY, "hatch": "////"},
        "contradicted": {"facecolor": "none", "edgecolor": RED},
        "not testable": {"facecolor": "none", "edgecolor": "none"}}
POINTS = {"reproduced": (AGENT, "o"), "partly": (AGENT, "P"), "undecided": (GREY, "D"), "contradicted": (RED, "."),
          "not testable": (INK, "_")}
DIAMOND = {"color": INK, "marker": "D", "markersize": 6, "linestyle": "none", "markeredgecolor": "white",
           "markeredgewidth": 0.8}  # the edge sets it off from bars
SHADES = LinearSegmentedColormap.from_list("shades", [AGENT + "10", AGENT + "ff"])
ROW = 0.2  # inches
SHOWN = ("reproduced", "undecided", "contradicted")  # beside verdicts
LEADING = 6  # choices below a specification curve


def draw_outcomes(claims):
    """How many readings give each outcome of each claim, as bars."""
    sizes = sorted({len(found) for found in claims.values()}, reverse=True)
    panels = [[name for name, found in claims.items() if len(found) == size] for size in sizes]
    figure = plt.figure(figsize=(width_of_figures(), 1.1 * ROW * len(claims) + 0.7 * len(sizes) + 0.3),
                        layout="constrained")
    grid = figure.subplots(len(sizes), 1, height_ratios=[len(names) for names in panels], squeeze=False).ravel()
    for axes, size, names in zip(grid, sizes, panels):
        left = np.zeros(len(names))
        for kind, look in BARS.items():
            count = np.array([sum(claim.outcome == kind for claim in claims[name]) for name in names])
            axes.barh(range(len(names)), count, 0.6, left=left, label=kind, **look)
            left += count
        axes.set_yticks(range(len(names)), names, fontsize=10)
        axes.set(xlim=(0, size), ylim=(len(names) - 0.4, -0.6), xlabel=f"of {size} readings")
        axes.xaxis.get_major_locator().set_params(integer=True)
        axes.tick_params(axis="y", length=0)
        axes.spines["left"].set_visible(False)
    bars, labels = grid[0].get_legend_handles_labels()
    figure.legend(bars[:-1], labels[:-1], loc="outside upper center", ncols=4, frameon=False, fontsize=SMALL,
                  labelcolor=TEXT)


def draw_specification(readings, claims, name):
    """The specification curve of a claim: its estimate under every reading, sorted, and the leading choices below.

    A number outside the middle 95 % is a triangle at the edge, pointing outward; a missing number is a cross at the
    lower edge. Below are the `LEADING` choices whose levels follow the order of the readings most closely, the closest
    first.

    Returns the axes of the curve and of the choices.
    """
    below = 1.7 * ROW * LEADING
    figure = plt.figure(figsize=(width_of_figures(), 2.6 + below), layout="constrained")
    curve, strips = panels = figure.subplots(2, 1, sharex=True, height_ratios=(2.0, below))
    order = _curve(curve, claims[name], name)
    outcomes = [claim.outcome for claim in claims[name]]
    handles = [Line2D([], [], linestyle="none", marker=marker, markersize=5, color=colour,
                      label=f"{kind} {outcomes.count(kind)}") for kind, (colour, marker) in POINTS.items()]
    curve.legend(handles=handles, frameon=False, labelcolor=TEXT, fontsize=SMALL, handlelength=0.6, ncols=3,
                 loc="lower center", bbox_to_anchor=(0.5, 1.0))
    curve.tick_params(labelbottom=False)
    ends = -0.5, len(order) - 0.5
    for row, (label, places) in enumerate(_leading([readings[i] for i in order], name)):
        strips.imshow([places], extent=(*ends, row + 0.85, row + 0.4), aspect="auto", cmap=SHADES, vmin=0, vmax=1,
                      interpolation="nearest")
        strips.text(ends[0], row + 0.32, label, fontsize=SMALL)
    strips.set(xlabel="readings, in order of the number above", xticks=[], yticks=[], xlim=ends, ylim=(LEADING, -0.1))
    strips.spines[:].set_visible(False)
    return panels


def _leading(readings, name):
    """The choices that lead for a claim: [(label and levels, places of levels), …]."""
    found = []
    for key, choice in WITHIN.items():
        if name[0] in choice.papers:
            places = [choice.place(reading.choices[key]) for reading in readings]
            varies = len(set(places)) > 1
            found.append((abs(spearmanr(places, range(len(places))).statistic) if varies else 0.0, choice, places))
    found.sort(key=lambda each: each[0], reverse=True)
    return [(f"{choice.label}: {_in_brief(choice.levels)}", places) for _, choice, places in found[:LEADING]]


def _in_brief(levels):
    """The levels of a choice, in words: their ends if there are more than three."""
    brief = re.sub(r"\{(\d+), [^}]*, (\d+)\}", r"{\1 … \2}", levels).split(", ")
    return f"{brief[0]} … {brief[-1]}" if len(brief) > 3 else ", ".join(brief)


def _curve(axes, claims, name):
    """Draw the number of a claim under every reading, sorted, and return the order."""
    here = np.array([claim.here for claim in claims])
    order = np.argsort(np.nan_to_num(here[:, 0], nan=-np.inf), kind="stable")
    borders = [end for end in (STATEMENTS[name].bounds.low, STATEMENTS[name].bounds.high) if np.isfinite(end)]
    low, high = _limits(here[:, 0], borders)
    at, value = np.arange(len(order)), here[order, 0]
    bottom, top = np.clip(np.nan_to_num(here[order, 1:], nan=low, posinf=high, neginf=low), low, high).T
    outcomes = np.array([claims[i].outcome for i in order])
    within = (value >= low) & (value <= high)
    for kind, (colour, shape) in POINTS.items():
        of_kind = outcomes == kind
        axes.vlines(at[of_kind], bottom[of_kind], top[of_kind], color=colour, alpha=0.3, linewidth=1)
        for places, heights, marker in ((of_kind & within, value, shape),
                                        (of_kind & (value > high), np.full(len(at), high), "^"),
                                        (of_kind & (value < low), np.full(len(at), low), "v"),
                                        (of_kind & np.isnan(value), np.full(len(at), low), "x")):
            if places.any():  # an empty unclipped artist would be as large as the figure
                axes.plot(at[places], heights[places], linestyle="none", marker=marker, color=colour, clip_on=False,
                          markersize=2.5 if marker == shape else 4)
    for border in borders:
        axes.axhline(border, color=INK, linewidth=0.8, linestyle="--")
    margin = 0.06 * (high - low)
    axes.set_ylim(low - margin, high + margin)
    return order


def _limits(values, borders):
    """The range of the middle 95 % of the finite values, and of the borders of the claim."""
    finite = values[np.isfinite(values)]
    low, high = np.quantile(finite, [0.025, 0.975]) if len(finite) else (0.0, 1.0)
    low, high = min(low, *borders), max(high, *borders)
    return (low, high) if low < high else (low - 0.5, high + 0.5)


def draw_standing(record, names):
    """The verdicts of claims, the share of readings under which they are reproduced, and at the right its counts.

    Bars are from short runs, points from runs as long as the papers', where there are any.
    """
    axes = axes_or_new(None, figsize=(width_of_figures(), 1.3 * ROW * len(names) + 0.9))
    for row, name in enumerate(names):
        share = record["shares"].get(name)
        if share:
            ends = np.cumsum([0, *(share[kind] / share["readings"] for kind in SHOWN)])
            for kind, left, right in zip(SHOWN, ends, ends[1:]):
                if right > left:
                    axes.barh(row, right - left, 0.55, left=left, **BARS[kind])
            axes.annotate(f"{share['reproduced']} of {share['readings']}", (1, row), xytext=(9, 0),
                          textcoords="offset points", fontsize=SMALL, va="center")
            if share.get("measured"):
                axes.plot(share["agrees"] / share["measured"], row, **DIAMOND, clip_on=False)
        else:
            axes.text(0.01, row, "not varied over readings", fontsize=SMALL, va="center")
    verdicts = {name: record["claims"].get(name, {"verdict": "not computed"})["verdict"] for name in names}
    axes.set_yticks(range(len(names)), [f"{name}  {verdicts[name]}" for name in names], fontsize=10)
    axes.set_xticks([0, 0.5, 1], ["none", "half", "all readings"])
    axes.set(xlim=(0, 1), ylim=(len(names) - 0.4, -0.6))
    axes.tick_params(axis="y", length=0, pad=8)  # a diamond at 0 reaches beyond the axis
    axes.spines["left"].set_visible(False)
    bars = [Rectangle((0, 0), 1, 1, **BARS[kind]) for kind in SHOWN]
    axes.figure.legend([*bars, Line2D([], [], **DIAMOND)], [*SHOWN, "agrees, in long runs"], loc="outside upper center",
                       ncols=2, frameon=False, fontsize=SMALL, labelcolor=TEXT, borderpad=0)


def draw_importance(importance):
    """Which choices matter, as areas of discs: {claim: {choice: importance}}."""
    keys = [*WITHIN] if any(importance.values()) else []
    axes = axes_or_new(None, figsize=(width_of_figures(), ROW * 1.25 * len(keys) + 0.5))
    for column, shares in enumerate(importance.values()):
        for key, share in shares.items():
            axes.plot(column, keys.index(key), marker="o", color=AGENT, markersize=13 * np.sqrt(np.clip(share, 0, 1)))
    if not any(importance.values()):
        mark(axes, (0.5, 0.5), "no claim's number is predicted", xycoords="axes fraction", ha="center", va="center")
    axes.set_xticks(range(len(importance)), importance, fontsize=SMALL, rotation=90)  # horizontal labels would touch
    axes.set_yticks(range(len(keys)), [WITHIN[key].label for key in keys], fontsize=SMALL)
    axes.set(xlim=(-0.6, len(importance) - 0.4), ylim=(len(keys) - 0.4, -0.6))
    axes.xaxis.tick_top()
    axes.tick_params(length=0)
    axes.grid(color=INK, alpha=0.2, linewidth=0.5)
    axes.set_axisbelow(True)
    axes.spines[:].set_visible(False)
