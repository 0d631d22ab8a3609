"""Drawings of separate concerns, and of ensembles."""

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.patches import Circle, Wedge

from lib.chapter_3.ensembles import LEARNERS
from lib.chapter_3.hybrid_reward import settled_values
from lib.shared.grid_figures import draw_grid, draw_policy, new_grids
from neorl.drawing.style import AGENT, CURVES, GREEN, INK, RED, TEXT, letters
from neorl.evidence.statistics import estimate, mean_band


def draw_game(game):
    """The board as a game begins: fruits at the first of its places, rings at the others, the agent and the ghost."""
    (axes,) = new_grids(game.grid, size=3.4)
    draw_grid(axes, game.grid)
    for i, place in enumerate(game.places):
        axes.add_patch(Circle(game.grid.places[place], 0.24, edgecolor=GREEN, linewidth=1.6,
                              facecolor=GREEN if i < game.fruits else "none"))
    (agent,), (ghost,) = (game.grid.marked(mark) for mark in "ag")
    axes.add_patch(Wedge(game.grid.places[agent], 0.36, 35, 325, facecolor=AGENT, edgecolor="none"))
    x, y = game.grid.places[ghost]
    axes.add_patch(Circle((x, y), 0.36, facecolor=RED, edgecolor="none"))
    for eye in (-0.13, 0.13):
        axes.add_patch(Circle((x + eye, y - 0.08), 0.08, facecolor="white", edgecolor="none"))


def draw_scores(played):
    """Reward per 100 steps against steps on a logarithmic axis, with the interval of the mean: {name: `Played`}.

    Each curve has its name at its end: the first above it, the others below, the one that goes furthest beside it.
    """
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


def draw_junction(grid, discounts):
    """Where the sum of settled heads leads, a panel for each discount; a fruit lies at each "o" of the grid."""
    fruits = grid.marked("o")
    for axes, discount in zip(new_grids(grid, columns=len(discounts)), discounts):
        draw_grid(axes, grid)
        for fruit in fruits:
            axes.add_patch(Circle(grid.places[fruit], 0.24, facecolor=GREEN, edgecolor="none"))
        values = sum(settled_values(grid, fruit, discount) for fruit in fruits)
        values[fruits] = 0  # a fruit that is reached is gone
        draw_policy(axes, grid, values)
        axes.set_title(f"γ = {discount}", color=TEXT)


def draw_finals(rewards, best):
    """Final reward per step of each chooser, a dot with its interval, a panel for each maze.

    rewards: {maze: {chooser: (runs, parts)}}, of which the last part is drawn. best: {maze: the highest possible},
    a dashed line. Learners are grey, rules are blue.
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
