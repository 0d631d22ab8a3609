"""The figures of the page: what agents know by what they wanted, where desires lead, and ten hours of learning."""

import numpy as np
from matplotlib import pyplot as plt

from companion.page.thesis_figures import mark_levels
from companion.wanted import findings, ten_hours
from companion.wanted.lessons import UNTRAINED, WANTED
from neorl.drawing.boards import new_boards
from neorl.drawing.curves import draw_curves
from neorl.drawing.style import CURVES, INK, SMALL, width_of_figures

HEIGHT = 3.4  # inches
APART, WIDTH = 0.3, 0.26  # of the two bars of a desire, and of each
PALE, ROOM = 0.3, 1.1
SHORT = {"a tenth of the learning rate": "slower", "1 minute in 10 without desire": "pauses"}  # names of ways


def draw_knowledge(reading, here):
    """Draw what agents catch a minute, told to want both colours, by what they wanted while they learned.

    For each the recorded mean and interval of the agent itself and of partners that had first moved at random, and over
    them the page's own runs as points: {(wanted, "own" or "wide"): (runs,)}.
    """
    axes = plt.figure(figsize=(width_of_figures(), HEIGHT)).add_subplot()
    for rank, (lesson, name) in enumerate({"own": "from all of it", "wide": "after ten minutes at random"}.items()):
        colour, shift = CURVES[rank], APART * (rank - 0.5)
        found = [findings.level(reading, wanted, lesson) for wanted in WANTED]
        at = np.arange(len(WANTED)) + shift
        axes.bar(at, [each.value for each in found], WIDTH, color=colour, alpha=PALE, label=name)
        axes.vlines(at, [each.low for each in found], [each.high for each in found], color=colour, linewidth=1.8)
        for place, wanted in zip(at, WANTED):
            runs = here[wanted, lesson]
            axes.plot(np.full(len(runs), place), runs, color=colour, linestyle="none", marker="o", markersize=4)
    axes.set_xticks(range(len(WANTED)), [wanted.replace(", ", ",\n") for wanted in WANTED])
    axes.set(xlabel="wanted while learning", ylabel="discs a minute", ylim=(0, None))
    mark_levels(axes, {"untrained": findings.level(reading, UNTRAINED).value})
    axes.legend(frameon=False, fontsize=SMALL, loc="lower left", bbox_to_anchor=(0, 1), ncols=2)


def draw_roads(paths, world):
    """Draw where agents have been, {what they want: positions (frames, 2)}, a board each."""
    for axes, (wanted, positions) in zip(new_boards(3, -(-len(paths) // 3)), paths.items()):
        axes.add_patch(plt.Rectangle((0, 0), 1, 1, fill=False, edgecolor=INK, linewidth=1.2))
        axes.plot(*((positions + world.radius) / world.size).T, color=CURVES[0], linewidth=0.6, alpha=0.7)
        axes.set_title(wanted, fontsize=SMALL)


def draw_hours(reading):
    """Draw what agents know over ten hours of learning, in each of both tasks, as recorded."""
    figure, panels = plt.subplots(2, 1, sharex=True, figsize=(width_of_figures(), 2 * HEIGHT), layout="constrained")
    hours = ten_hours.PIECE / 60 * (1 + np.arange(ten_hours.PIECES))
    for axes, (task, title) in zip(panels, findings.TASKS.items()):
        curves = {SHORT.get(way, way): known[:, 2] for (of, which, way), known in ten_hours.recorded().items()
                  if (of, which) == (reading, task)}
        axes.set_ylim(0, ROOM * max(known.mean(axis=0).max() for known in curves.values()))
        draw_curves(hours, curves, "hours" if task == "turned" else "", "discs a minute", axes)
        axes.set_title(title, fontsize=SMALL, loc="left")
    panels[1].axvline(ten_hours.TURN * ten_hours.PIECE / 60, color=INK, linewidth=0.7)
