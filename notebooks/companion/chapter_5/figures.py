"""The figures of chapter 5: the claims behind the conclusions, and trials that ask whether these stand."""

import numpy as np
from matplotlib import pyplot as plt

from companion.chapter_5.trials import SECONDS_A_MOVE
from companion.page.thesis_figures import draw_against_thesis
from companion.study import multiverse_figures
from neorl.drawing.curves import draw_curves
from neorl.drawing.style import CURVES, INK, axes_or_new, name_ends

STRETCHES = 100  # intervals of a run in which red creeps are counted


def draw_standing(record, names):
    """As `companion.study.multiverse_figures.draw_standing`, of the claims among some that have been judged."""
    judged = [name for name in names if name in record["claims"]]
    if judged:
        return multiverse_figures.draw_standing(record, judged)
    axes = axes_or_new(None, figsize=(3, 0.4))
    axes.axis("off")
    axes.text(0.5, 0.5, "no claims judged", ha="center", va="center")


def draw_leads(sooner):
    """Draw how much sooner agents with more maps learn, {what is added: `Estimate` in minutes}."""
    draw_against_thesis(dict.fromkeys(sooner), sooner, "minutes sooner with more maps", {"thesis: 0 or more": 0.0})


def draw_costs(costs):
    """Draw the cost of agents with one more map at each point, and the sum of separate costs: a `trials.Costs`."""
    axes = plt.figure().add_subplot()
    axes.plot(costs.labels, costs.predicted, color=INK, linewidth=1.2)
    axes.plot(costs.labels, costs.measured, color=CURVES[0], linestyle="none", marker="o", markersize=5)
    axes.set(ylabel="microseconds per step", ylim=(0, None))
    axes.tick_params(axis="x", rotation=60)
    name_ends(axes, [(costs.measured[-1], "measured", CURVES[0]), (costs.predicted[-1], "sum", INK)])


def draw_revaluing(revalued):
    """Draw red creeps taken per minute over the run, and a line where they are revalued. revalued: {name: `Result`}."""
    minutes, curves = red_a_minute(revalued)
    axes = draw_curves(minutes, curves, "simulated minutes", "red creeps per minute")
    axes.axvline((minutes[0] + minutes[-1]) / 2, color=INK, linewidth=0.7)


def red_a_minute(revalued):
    """The midpoints of `STRETCHES` of a run, in minutes, and red creeps taken per minute."""
    edges = np.linspace(0, 1, STRETCHES + 1)
    curves = {name: np.stack([60 * result.hit_rate(*pair)[:, 1] for pair in zip(edges[:-1], edges[1:])], axis=1)
              for name, result in revalued.items()}
    return (edges[:-1] + edges[1:]) / 2 * next(iter(revalued.values())).seconds / 60, curves


def draw_distances(moved):
    """Draw the distance of agents from a desired place over all its moves. moved: a `trials.Moved`."""
    starts = SECONDS_A_MOVE * np.arange(moved.distances["experienced"].shape[1])
    curves = {name: each.reshape(len(each), -1) for name, each in moved.distances.items()}
    draw_curves((starts[:, None] + moved.seconds).ravel(), curves, "seconds", "distance, board widths")
