"""The figures of the multiverse: for one claim the effect under every reading; for all, under how many readings they
hold, and which choices matter."""

from textwrap import fill

import numpy as np
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.lines import Line2D
from matplotlib.patches import Rectangle

from neorl.drawing.style import AGENT, INK, RED, axes_or_new, figure_or_new, width_of_figures
from neorl.evidence.multiverse import outcome
from neorl.evidence.priors import WITHIN
from neorl.evidence.statements import STATEMENTS

COLOURS = {"holds": AGENT, "undecided": RED, "fails": INK}
SHADES = LinearSegmentedColormap.from_list("shades", [AGENT + "10", AGENT + "ff"])
ROW = 0.2  # inches


def draw_specification(readings, judged, name, choices=WITHIN, figure=None):
    """The specification curve of a claim: its number under every reading in order of size, and the choices below.

    readings: [Reading, …]. judged: {name: `Claim`} for each of them. choices: what is shown of them, as `design` takes
    it. Where a number is not finite, or off the middle 95 % of them, it stands at the edge.
    figure: a figure or a part of one to fill, by default a new one. Returns the axes of the curve and of the choices.
    """
    claims = [each[name] for each in judged]
    here = np.array([claim.here for claim in claims])
    order = np.argsort(np.nan_to_num(here[:, 0], nan=-np.inf), kind="stable")
    shown = {key: choice for key, choice in choices.items() if name[0] in choice.papers}
    below = ROW * len(shown)
    figure = figure_or_new(figure, (width_of_figures(), 2.4 + below))
    curve, strips = panels = figure.subplots(2, 1, sharex=True, height_ratios=(1.9, below))
    low, high = _limits(here[:, 0], STATEMENTS[name].borders)
    at = np.arange(len(order))
    value, bottom, top = np.clip(np.nan_to_num(here[order], nan=low, posinf=high, neginf=low), low, high).T
    outcomes = np.array([outcome(claims[i]) for i in order])
    for kind, colour in COLOURS.items():
        of_kind = outcomes == kind
        curve.vlines(at[of_kind], bottom[of_kind], top[of_kind], color=colour, alpha=0.3, linewidth=1)
        curve.plot(at[of_kind], value[of_kind], linestyle="none", marker="o", markersize=2.5, color=colour,
                   label=f"{kind} {of_kind.mean():.0%}".replace("%", " %"))
    for border in STATEMENTS[name].borders:
        curve.axhline(border, color=INK, linewidth=0.8, linestyle="--")
    margin = 0.03 * (high - low)
    curve.set_ylim(low - margin, high + margin)
    figure.suptitle(fill(f"{name}: {STATEMENTS[name].text}", 58), size=11, color=INK)
    curve.legend(frameon=False, labelcolor="linecolor", fontsize=9, handlelength=0.6, ncols=3, loc="lower center",
                 bbox_to_anchor=(0.5, 1.0))
    places = [[choice.place(getattr(readings[i], key)) for i in order] for key, choice in shown.items()]
    strips.imshow(places, aspect="auto", cmap=SHADES, vmin=0, vmax=1, interpolation="nearest")
    strips.set_yticks(range(len(shown)), [choice.label for choice in shown.values()], fontsize=9)
    strips.set(xlabel="readings, in order of the number above", xticks=[])
    ends = strips.secondary_yaxis("right")
    ends.set_yticks(range(len(shown)), [choice.levels for choice in shown.values()], fontsize=8)
    for axes in (strips, ends):
        axes.tick_params(length=0)
        axes.spines[:].set_visible(False)
    return panels


def _limits(values, borders):
    """The range of the middle 95 % of the finite values, and of the borders of the claim."""
    finite = values[np.isfinite(values)]
    low, high = np.quantile(finite, [0.025, 0.975]) if len(finite) else (0.0, 1.0)
    low, high = min(low, *borders), max(high, *borders)
    return (low, high) if low < high else (low - 0.5, high + 0.5)


def draw_standing(record, names, ax=None):
    """The verdicts of claims, and the share of readings that they hold under: record as `neorl.evidence.report.load`
    has it.

    names: of the claims, from the top. Bars are short runs: what is undecided comes after what holds, in another
    colour. Points are runs as long as the papers', where there are any.
    Returns the axes, `ax` or those of a new figure.
    """
    axes = axes_or_new(ax, figsize=(width_of_figures(), 1.3 * ROW * len(names) + 0.7))
    for row, name in enumerate(names):
        share = record["shares"].get(name)
        if share:
            holds, undecided = (100 * share[kind] / share["readings"] for kind in ("holds", "undecided"))
            axes.barh(row, holds, 0.55, color=COLOURS["holds"])
            axes.barh(row, undecided, 0.55, left=holds, color=COLOURS["undecided"], alpha=0.45)
            if share.get("measured"):
                axes.plot(100 * share["agrees"] / share["measured"], row, "D", color=INK, markersize=5, clip_on=False)
        else:
            axes.text(1, row, "not varied over readings", fontsize=9, va="center")
    verdicts = {name: record["claims"].get(name, {"verdict": "not computed"})["verdict"] for name in names}
    axes.set_yticks(range(len(names)), [f"{name}  {verdicts[name]}" for name in names], fontsize=10)
    axes.set(xlim=(0, 100), ylim=(len(names) - 0.4, -0.6), xlabel="% of readings")
    axes.tick_params(axis="y", length=0)
    axes.spines["left"].set_visible(False)
    handles = [Rectangle((0, 0), 1, 1, color=COLOURS[kind], alpha=alpha)
               for kind, alpha in (("holds", 1.0), ("undecided", 0.45))]
    handles.append(Line2D([], [], color=INK, marker="D", markersize=5, linestyle="none"))
    axes.legend(handles, ["holds", "undecided", "agrees, in long runs"], frameon=False, fontsize=9, ncols=3,
                labelcolor=INK, loc="lower left", bbox_to_anchor=(0, 1.0), borderpad=0)
    return axes


def draw_importance(importance, choices=WITHIN, ax=None):
    """Which choices matter for which claim: {name of the claim: {name of the choice: importance}}, areas of discs.

    choices: what was varied, as `design` takes it. Returns the axes, `ax` or those of a new figure.
    """
    axes = axes_or_new(ax, figsize=(width_of_figures(), ROW * 1.25 * len(choices) + 0.5))
    keys = list(choices)
    for column, shares in enumerate(importance.values()):
        for key, share in shares.items():
            axes.plot(column, keys.index(key), marker="o", color=AGENT, markersize=13 * np.sqrt(np.clip(share, 0, 1)))
    axes.set_xticks(range(len(importance)), importance, fontsize=9)
    axes.set_yticks(range(len(keys)), [choices[key].label for key in keys], fontsize=9)
    axes.set(xlim=(-0.6, len(importance) - 0.4), ylim=(len(keys) - 0.4, -0.6))
    axes.xaxis.tick_top()
    axes.tick_params(length=0)
    axes.grid(color=INK, alpha=0.2, linewidth=0.5)
    axes.set_axisbelow(True)
    axes.spines[:].set_visible(False)
    return axes
