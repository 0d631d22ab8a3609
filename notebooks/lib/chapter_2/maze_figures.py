"""Drawings of the maze, and of the animals' errors and knowledge."""

import numpy as np
from matplotlib import pyplot as plt

from neorl.drawing.curves import draw_curves
from neorl.drawing.style import AGENT, CURVES, GREEN, INK, RED, TEXT, letters, name_ends
from neorl.evidence.statistics import mean_band

NAMES = {"throughout": "throughout", "never": "never", "delayed": "from day {}"}


def draw_plan(maze):
    """The plan of a `Maze`: the true path from the start to the food box, the blinds, and the doors across the path."""
    path, places = maze.places[: maze.goal + 1], maze.places
    width, height = np.ptp(places, axis=0) + 1.2
    inches, _ = plt.rcParams["figure.figsize"]
    axes = plt.figure(figsize=(inches, inches * height / width)).add_subplot(aspect="equal")
    axes.axis("off")
    axes.invert_yaxis()
    for choice, blind in zip(maze.choice_points, maze.blinds):
        axes.plot(*places[[choice, blind]].T, color=RED, linewidth=7, solid_capstyle="butt", zorder=1)
        out = places[choice + 1] - places[choice]
        door, across = places[choice] + 0.5 / np.abs(out).sum() * out, 0.17 * out[::-1] / np.abs(out).sum()
        axes.plot(*np.stack([door - across, door + across]).T, color=INK, linewidth=2.5, zorder=3)
    axes.plot(*path.T, color=AGENT, linewidth=7, solid_joinstyle="miter", zorder=2)
    for state, neighbour, name, colour in ((0, 1, "start", INK), (-1, -2, "food box", GREEN)):
        axes.plot(*path[state], color=colour, marker="s", markersize=13, zorder=4)
        beyond = np.sign(path[state] - path[neighbour])
        axes.annotate(name, path[state], (38 * beyond[0], -17 * beyond[1]), textcoords="offset points",
                      color=letters(colour), ha="center", va="center")


def draw_errors(by_learner, first_reward):
    """Errors per day of the three groups, one panel per learner: {learner: {group: `Record`}}, with 95 % intervals."""
    width, _ = plt.rcParams["figure.figsize"]
    figure, grid = plt.subplots(len(by_learner), sharex=True, sharey=True, squeeze=False,
                                figsize=(width, 2.5 * len(by_learner)))
    for axes, (learner, groups) in zip(grid[:, 0], by_learner.items()):
        days = np.arange(next(iter(groups.values())).errors.shape[1]) + 1
        ends = []
        for (group, record), colour in zip(groups.items(), CURVES):
            mean = record.errors.mean(axis=0)
            axes.plot(days, mean, color=colour)
            axes.fill_between(days, *mean_band(record.errors), color=colour, alpha=0.25, linewidth=0)
            ends.append((mean[-1], NAMES[group].format(first_reward), colour))
        axes.axvline(first_reward, color=INK, linewidth=1, linestyle=":")
        axes.set(ylabel="errors per day", title=learner, ylim=(-3, None), xlim=(1, days[-1]))
        axes.title.set_color(TEXT)
        axes.ends = ends
    axes.set(xlabel="day", xticks=days[::2])
    for axes in grid[:, 0]:
        name_ends(axes, axes.ends)


def draw_known(known_by_learner, first_reward):
    """The share of choices known after each day: {learner: (animals, days)}, with 95 % intervals."""
    days = np.arange(next(iter(known_by_learner.values())).shape[1]) + 1
    axes = draw_curves(days, known_by_learner, "day", "share of choices known")
    axes.set(xlim=(1, days[-1]), xticks=days[::2])
    axes.axvline(first_reward, color=INK, linewidth=1, linestyle=":")


def draw_settings(rows, labels):
    """Results by setting, {setting: {learner: [Estimate for each of ``labels``]}}, one panel per label."""
    width, _ = plt.rcParams["figure.figsize"]
    figure, panels = plt.subplots(1, len(labels), sharey=True, squeeze=False, figsize=(width, 0.36 * len(rows) + 1.4))
    heights = np.arange(len(rows))
    learners = list(next(iter(rows.values())))
    for panel, (axes, label) in enumerate(zip(panels[0], labels)):
        axes.axvline(0, color=INK, linewidth=0.7)
        for number, (learner, colour) in enumerate(zip(learners, CURVES)):
            value, low, high = np.array([row[learner][panel] for row in rows.values()]).T
            at = heights + 0.22 * (number - (len(learners) - 1) / 2)
            axes.hlines(at, low, high, color=colour, linewidth=1.8)
            axes.plot(value, at, color=colour, linestyle="none", marker="osD"[number], markersize=4.5, label=learner)
        axes.set(xlabel=label, yticks=heights, yticklabels=rows)
        axes.tick_params(axis="y", length=0)
    axes.invert_yaxis()
    figure.legend(*axes.get_legend_handles_labels(), loc="outside upper center", ncols=len(learners), frameon=False,
                  labelcolor=TEXT, handletextpad=0.1, columnspacing=1.2)
