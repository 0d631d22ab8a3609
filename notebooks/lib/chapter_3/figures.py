"""The figures of chapter 3, in the order of its page: processes and policies, learning curves, heads, ensembles."""

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.patches import Circle, FancyBboxPatch, Wedge
from matplotlib.ticker import MultipleLocator

from lib.chapter_3.ensembles import LEARNERS
from lib.shared.grid import WALL
from lib.shared.grid_figures import draw_grid, draw_policy
from lib.shared.panels import add_arrow
from lib.shared.style import FILL, mark
from neorl.drawing.style import AGENT, CURVES, GREEN, INK, RED, TEXT, letters, name_ends
from neorl.evidence.statistics import estimate, mean_band


def draw_activations(inputs, step, relu, slope):
    """A step and a ReLU over their inputs, (n,) each, and the slope of the ReLU, (n − 1,), dotted on the step."""
    _, panels = plt.subplots(1, 2, figsize=(4.9, 2.3))
    for axes, title, activation in zip(panels, ("a: step", "b: ReLU"), (step, relu)):
        axes.plot(inputs, activation, color=AGENT)
        axes.set(xlabel="weighted input", title=title)
    panels[0].set_ylabel("output")
    panels[0].plot((inputs[1:] + inputs[:-1]) / 2, slope, color=RED, linestyle="none", marker="o", markersize=4)


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
        add_arrow(axes, (turn, high), (end, high), INK, 1.8, "-|>")
    axes.text(3.75, 1.35, "action $a_t$", va="center")
    axes.text(1.25, 1.35, "state $s_{t+1}$\nreward $R_{t+1}$", va="center", ha="right")


def draw_plans(panels, grid, plans):
    """The value of each state as the opacity of its fill, the best actions, and the marks of the grid.

    plans: {title: (values (states,), q (states, 4) or None)}, the values shaded relative to the largest of all.
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


def draw_means(series, xlabel, ylabel, logs="", marks=False, guides=()):
    """Means over runs with their 95 % intervals, of series {name: (xs (points,), values (runs, points))}.

    logs: the logarithmic axes, a string of "x" and "y". guides: (xs, ys) of thin lines for comparison.
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


def draw_game(axes, game, places):
    """The board as a game begins: fruits at the first of these places, rings at the others, the agent and the ghost."""
    draw_grid(axes, game.grid)
    for i, place in enumerate(places):
        axes.add_patch(Circle(game.grid.places[place], 0.24, edgecolor=GREEN, linewidth=1.6,
                              facecolor=GREEN if i < game.fruits else "none"))
    (agent,), (ghost,) = (game.grid.marked(mark) for mark in "ag")
    axes.add_patch(Wedge(game.grid.places[agent], 0.36, 35, 325, facecolor=AGENT, edgecolor="none"))
    x, y = game.grid.places[ghost]
    axes.add_patch(Circle((x, y), 0.36, facecolor=RED, edgecolor="none"))
    for eye in (-0.13, 0.13):
        axes.add_patch(Circle((x + eye, y - 0.08), 0.08, facecolor="white", edgecolor="none"))


def draw_scores(played):
    """Reward per 100 steps over steps on a logarithmic axis: {name: `Played`}."""
    axes = plt.figure().add_subplot()
    furthest = max(each.edges[-1] for each in played.values())
    for i, ((name, each), colour) in enumerate(zip(played.items(), CURVES)):
        steps, mean = each.edges[1:], each.rewards.mean(axis=0)
        axes.plot(steps, mean, color=colour)
        axes.fill_between(steps, *mean_band(each.rewards), color=colour, alpha=0.2, linewidth=0)
        at_the_edge = steps[-1] == furthest
        axes.annotate(name, (steps[-1], mean[-1]), (6, 0 if at_the_edge else 7 if i == 0 else -9),
                      color=letters(colour), textcoords="offset points", va="center", annotation_clip=False)
    axes.axhline(0, color=INK, linewidth=0.7, zorder=1)
    axes.set(xscale="log", xlabel="steps", ylabel="reward per 100 steps", xlim=(None, furthest))


def draw_finals(rewards, best):
    """Final reward per step of each chooser, a dot with its interval, a panel for each maze.

    A dashed line is the highest possible; learners are grey, rules are blue.
    """
    names = list(next(iter(rewards.values())))
    width, _ = plt.rcParams["figure.figsize"]
    _, panels = plt.subplots(1, len(rewards), figsize=(width, 0.3 * len(names) + 0.8), sharey=True)
    for axes, (maze, by_name) in zip(panels, rewards.items()):
        axes.axvline(best[maze], color=INK, linewidth=0.9, linestyle="--")
        for row, (name, made) in enumerate(by_name.items()):
            value, low, high = estimate(np.mean, made[:, -1])
            colour = INK if name in LEARNERS else CURVES[0]
            axes.hlines(row, low, high, color=colour, linewidth=2)
            axes.plot(value, row, marker="o", markersize=6, color=colour)
        axes.set_title(maze, size=11, color=TEXT)
        axes.set_xlabel("reward per step")
        axes.grid(axis="y", color=INK, alpha=0.2, linewidth=0.5)
        axes.locator_params(axis="x", nbins=3)
    panels[0].set_yticks(range(len(names)), names)
    panels[0].invert_yaxis()
