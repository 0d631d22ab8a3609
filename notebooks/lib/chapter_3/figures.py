"""Drawings of decision processes, policies and learning curves, in the style of `neorl.drawing`."""

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.patches import FancyBboxPatch
from matplotlib.ticker import MultipleLocator

from lib.shared.grid import WALL
from lib.shared.grid_figures import draw_grid, draw_policy
from neorl.drawing.style import AGENT, CURVES, FILL, GREEN, INK, RED, letters, mark, name_ends
from neorl.evidence.statistics import mean_band


def draw_activations(inputs, step, relu, slope):
    """A step and a ReLU over their inputs, (n,) each, and the slope of the ReLU, (n − 1,), dotted on the step."""
    _, panels = plt.subplots(1, 2, figsize=(4.9, 2.3))
    for axes, title, activation in zip(panels, ("a: step", "b: ReLU"), (step, relu)):
        axes.plot(inputs, activation, color=AGENT)
        axes.set(xlabel="weighted input", title=title)
    panels[0].set_ylabel("output")
    panels[0].plot((inputs[1:] + inputs[:-1]) / 2, slope, color=RED, linestyle="none", marker="o", markersize=4)


def draw_pattern(points, labels, lines):
    """Points (n, 2) of two classes, labels −1 and 1, and lines {name: (weight, weight, bias)} between them."""
    axes = plt.figure(figsize=(4.9, 3.2)).add_subplot()
    for label, marker, colour in ((-1, "o", RED), (1, "P", GREEN)):
        axes.plot(*points[labels == label].T, linestyle="none", marker=marker, color=colour, alpha=0.8)
    axes.set(xlim=(-1, 1), ylim=(-1, 1), xlabel="first input", ylabel="second input", xticks=[-1, 0, 1],
             yticks=[-1, 0, 1])
    xs, ends = np.array([-1.0, 1.0]), []
    for (name, (w_x, w_y, bias)), colour in zip(lines.items(), CURVES):
        ys = -(w_x * xs + bias) / w_y
        axes.plot(xs, ys, color=colour)
        ends.append((np.clip(ys[1], -0.8, 1), name, colour))
    name_ends(axes, ends)


def draw_loop():
    """The agent and the environment of a decision process, and the signals between them at a step."""
    axes = plt.figure(figsize=(4.9, 2.7), layout="none").add_axes((0, 0, 1, 1))
    axes.set(xlim=(0, 4.9), ylim=(0, 2.7))
    axes.axis("off")
    for y, name, colour in ((1.95, "agent", AGENT), (0.15, "environment", GREEN)):
        axes.add_patch(FancyBboxPatch((1.75, y), 1.5, 0.6, boxstyle="round,pad=0.02,rounding_size=0.1",
                                      facecolor="none", edgecolor=colour, linewidth=1.8))
        axes.text(2.5, y + 0.3, name, color=letters(colour), ha="center", va="center", weight="bold")
    for begin, turn, end, low, high in ((3.27, 3.65, 3.3, 2.25, 0.45), (1.73, 1.35, 1.7, 0.45, 2.25)):
        axes.plot([begin, turn, turn, end], [low, low, high, high], color=INK)
        axes.annotate("", (end, high), (turn, high), arrowprops={"arrowstyle": "-|>", "color": INK, "linewidth": 1.8,
                                                                 "shrinkA": 0, "shrinkB": 0})
    axes.text(3.75, 1.35, "action $a_t$", va="center")
    axes.text(1.25, 1.35, "state $s_{t+1}$\nreward $R_{t+1}$", va="center", ha="right")


def draw_plans(panels, grid, plans):
    """The value of each state as the opacity of its fill, the best actions, and the marks of the grid.

    panels: axes, as many as plans. plans: {title: (values, q)}. values: (states,), shaded relative to the largest of
    all. q: (states, 4), whose best actions are drawn; None draws none.
    """
    largest = max(max(values.max() for values, _ in plans.values()), 1e-9)
    for axes, (title, (values, q)) in zip(panels, plans.items()):
        draw_grid(axes, grid, {state: (GREEN, FILL * max(value, 0) / largest) for state, value in enumerate(values)})
        if q is not None:
            draw_policy(axes, grid, q)
        for (x, y), letter in zip(grid.places, "".join(grid.rows).replace(WALL, "")):
            if letter != ".":
                mark(axes, (x - 0.28, y - 0.24), letter, ha="center", va="center")
        axes.set_title(title, fontsize=11)


def draw_alternation(value_errors, policy_losses):
    """Policy iteration by stage: how far the values are from the policy's own, and the policy from greedy.

    Distances are drawn as their fourth roots, so that small ones are visible.
    """
    axes = plt.figure(figsize=(4.9, 3.6)).add_subplot()
    xs, ys = np.power(value_errors, 0.25), np.power(policy_losses, 0.25)
    axes.plot(xs, ys, color=INK, linewidth=0.9)
    for first, colour, name, shift in ((1, CURVES[0], "after evaluation", (0, 8)),
                                       (2, CURVES[5], "after\nimprovement", (8, 2))):
        axes.plot(xs[first::2], ys[first::2], color=colour, linestyle="none", marker="o", markersize=5, clip_on=False)
        axes.annotate(name, (xs[first], ys[first]), color=letters(colour), xytext=shift, textcoords="offset points")
    axes.plot(xs[0], ys[0], color=INK, marker="o", markersize=5, clip_on=False)
    axes.annotate("start", (xs[0], ys[0]), (8, 0), textcoords="offset points", va="center")
    axes.set(xlabel="values: distance from the policy's own", ylabel="policy: distance from greedy", xlim=(0, None),
             ylim=(0, None))
    for axis, shown in ((axes.xaxis, [0, 0.01, 0.1, 0.5]), (axes.yaxis, [0, 0.001, 0.01, 0.1, 0.5])):
        axis.set_ticks(np.power(shown, 0.25), map(str, shown))


def draw_means(series, xlabel, ylabel, logs="", marks=False, guides=()):
    """Means over runs with their 95 % intervals, of series {name: (xs (points,), values (runs, points))}.

    logs: the axes that are logarithmic, a string of "x" and "y". marks: whether points are marked and joined by thin
    lines. guides: (xs, ys) of thin lines for comparison. Names are beside the axes, or above ends that lie apart.
    """
    axes = plt.figure().add_subplot()
    shown = {axis: np.log10 if axis in logs else np.asarray for axis in "xy"}
    ends = []
    for xs, ys in guides:
        axes.plot(shown["x"](xs), shown["y"](ys), color=INK, linewidth=0.8, zorder=1)
    for (name, (xs, values)), colour in zip(series.items(), CURVES):
        at, mean = shown["x"](xs), shown["y"](values.mean(axis=0))
        axes.plot(at, mean, color=colour, linewidth=0.8 if marks else 1.8, marker="o" if marks else "", markersize=4)
        if len(values) > 1:
            low, high = shown["y"](mean_band(values))
            if marks:
                axes.vlines(at, low, high, color=colour)
            else:
                axes.fill_between(at, low, high, color=colour, alpha=0.2, linewidth=0)
        ends.append((at[-1], mean[-1], name, colour))
    axes.set(xlabel=xlabel, ylabel=ylabel)
    for axis in logs:
        ticks = getattr(axes, f"{axis}axis")
        ticks.set_major_locator(MultipleLocator(1))
        ticks.set_major_formatter(lambda power, _: f"$10^{{{power:.0f}}}$")
    if len({x for x, *_ in ends}) == 1:
        name_ends(axes, [end for _, *end in ends])
    else:
        for x, y, name, colour in ends:
            axes.annotate(name, (x, y), xytext=(0, 8), textcoords="offset points", color=letters(colour), ha="center",
                          annotation_clip=False)


def draw_trend(years, counts, fitted):
    """Counts of transistors over years, on a logarithmic scale, and the trend that was fitted to them; each (n,)."""
    axes = plt.figure(figsize=(4.9, 3.2)).add_subplot()
    axes.semilogy(years, counts, color=AGENT, linestyle="none", marker="o", markersize=5)
    axes.semilogy(years, fitted, color=INK, linewidth=1.2)
    axes.set(xlabel="year", ylabel="transistors per processor")
