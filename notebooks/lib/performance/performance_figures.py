"""Figures of the page "Performance"."""

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.ticker import EngFormatter, LogLocator, NullFormatter

from neorl.drawing.style import AGENT, CURVES, INK, TEXT, name_ends

GIGA, NANO = 1e9, 1e-9
PARTS = {"starting": CURVES[4], "importing": CURVES[2], "computing": AGENT, "drawing": CURVES[1]}


def draw_bandwidths(bandwidths, loops):
    """Draw bytes per second by working set, both ways, and the working sets of two of the loops, {name: `Loop`}."""
    axes = plt.figure().add_subplot()
    ways = {"in order": (bandwidths.copied, CURVES[0]), "lone values": (bandwidths.scattered, CURVES[1])}
    for speeds, colour in ways.values():
        axes.plot(bandwidths.working_sets, speeds / GIGA, color=colour, marker="o", markersize=3)
    top = 1.5 * max(speeds.max() for speeds, _ in ways.values()) / GIGA  # names of lines stand above the curves
    axes.set(xscale="log", yscale="log", xlabel="working set", ylabel="gigabytes per second")
    axes.set_ylim(top=top)
    axes.yaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
    axes.yaxis.set_major_formatter(lambda value, place: f"{value:g}")
    axes.yaxis.set_minor_formatter(NullFormatter())
    axes.tick_params(axis="y", which="minor", length=0)
    for name, side in (("N23 (memory)", "left"), ("twelve maps (memory)", "right")):
        axes.axvline(loops[name].moved.working_set, color=INK, linewidth=0.8, linestyle="--")
        axes.annotate(name.split(" (")[0], (loops[name].moved.working_set, 1), xycoords=("data", "axes fraction"),
                      xytext=(4 if side == "left" else -4, 0), textcoords="offset points", ha=side, va="top")
    _bytes(axes)
    name_ends(axes, [(speeds[-1] / GIGA, name, colour) for name, (speeds, colour) in ways.items()])


def draw_bounds(loops, bandwidths):
    """Draw the loop of each agent above its bound: the world's step, and the time to move its bytes."""
    axes = plt.figure(figsize=(4.9, 3.8)).add_subplot()
    for place, (name, loop) in enumerate(loops.items()):
        world, moving, whole = (each / NANO for each in (loop.world.min(), loop.moving(bandwidths), loop.loop.min()))
        axes.barh(place - 0.18, whole, 0.32, color=AGENT)
        axes.barh(place + 0.18, world, 0.32, color=CURVES[2])
        axes.barh(place + 0.18, moving, 0.32, left=world, color=CURVES[1])
        axes.annotate(f"{loop.ratio(bandwidths).value:.1f} ×", (whole, place - 0.18), xytext=(4, 0),
                      textcoords="offset points", va="center")
    axes.set(yticks=range(len(loops)), yticklabels=[name.replace(" (", "\n(") for name in loops],
             xlabel="nanoseconds per step")
    axes.invert_yaxis()
    _legend(axes, {"loop": AGENT, "world": CURVES[2], "bytes": CURVES[1]})


def draw_contests(*contests):
    """Draw each implementation's time for a step, on one logarithmic axis."""
    bars = [(name, seconds.min() / NANO, place > 0)
            for each in contests for place, (name, seconds) in enumerate(each.seconds.items())]
    names = [f"{name}\n({each.what.split(' of ')[1]})" for each in contests for name in each.seconds]
    axes = plt.figure(figsize=(4.9, 0.6 * len(bars) + 0.8)).add_subplot()
    for place, (_, taken, other) in enumerate(bars):
        axes.plot(taken, place, color=INK if other else AGENT, marker="s" if other else "o", markersize=8)
        axes.annotate(f"{taken:,.0f}", (taken, place), xytext=(8, 0), textcoords="offset points", va="center")
    axes.set(yticks=range(len(bars)), yticklabels=names, xscale="log", xlabel="nanoseconds per step")
    axes.margins(x=0.2, y=0.15)
    axes.invert_yaxis()


def draw_growth(series):
    """Draw a panel for each series that was timed: costs as dots, a line of the predicted slope through the last."""
    timed = [each for each in series if each.unit == "seconds"]
    _, panels = plt.subplots(-(-len(timed) // 2), 2, figsize=(4.9, 1.9 * -(-len(timed) // 2)))
    for axes, each in zip(panels.flat, timed):
        line = each.costs[-1] * (each.xs / each.xs[-1]) ** each.predicted
        axes.plot(each.xs, line, color=INK, linewidth=1)
        axes.plot(each.xs, np.where(each.costs > 0, each.costs, np.nan), color=AGENT, linestyle="none",
                  marker="o", markersize=4)
        axes.set(xscale="log", yscale="log", xlabel=each.of)
        axes.set_title(each.cost, fontsize=9, color=TEXT)
        axes.set_xticks(each.xs, [f"{x:g}" for x in each.xs], fontsize=9)
        axes.yaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
        axes.yaxis.set_major_formatter(EngFormatter("s"))
        axes.tick_params(axis="y", labelsize=9)
        for axis in (axes.xaxis, axes.yaxis):
            axis.set_minor_formatter(NullFormatter())
            axis.set_tick_params(which="minor", length=0)


def draw_minutes(pages):
    """Draw the minutes of each page, by what they were spent on; without pages, a picture that says so."""
    axes = plt.figure(figsize=(4.9, 0.3 * max(3, len(pages)) + 1)).add_subplot()
    left = np.zeros(len(pages))
    for part, colour in PARTS.items():
        minutes = np.array([getattr(page, part) for page in pages]) / 60
        axes.barh(range(len(pages)), minutes, 0.65, left=left, color=colour)
        left += minutes
    axes.set(yticks=range(len(pages)), yticklabels=[page.page for page in pages], xlabel="minutes")
    axes.invert_yaxis()
    if pages:
        _legend(axes, PARTS)
    else:
        axes.axis("off")
        axes.annotate("no page has been computed here", (0.5, 0.5), xycoords="axes fraction", ha="center")


def _bytes(axes):
    ticks = [2.0**power for power in range(14, 29, 4)]
    axes.set_xticks(ticks, [f"{tick / 2**10:g} KiB" if tick < 2**20 else f"{tick / 2**20:g} MiB" for tick in ticks])
    axes.xaxis.set_minor_formatter(NullFormatter())
    axes.tick_params(axis="x", which="minor", length=0)


def _legend(axes, colours):
    handles = [plt.Rectangle((0, 0), 1, 1, color=colour) for colour in colours.values()]
    axes.legend(handles, colours, frameon=False, labelcolor=TEXT, loc="lower right", bbox_to_anchor=(1, 1),
                ncols=len(colours), handlelength=1, columnspacing=1, borderaxespad=0.2)  # names of bars leave room
