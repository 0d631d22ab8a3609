"""The figures of chapter 5: trials that ask whether the conclusions of the thesis stand."""

import numpy as np
from matplotlib import pyplot as plt

from companion import page
from companion.chapter_5.trials import SECONDS_A_MOVE
from companion.page.thesis_figures import draw_against_thesis, mark_levels
from companion.thesis.rules_chapters import MINUTES
from neorl.drawing.curves import draw_curves
from neorl.drawing.style import CURVES, INK, name_ends


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


def draw_revaluing(turned, chance):
    """Draw discs caught per minute from 10 minutes before red is wanted too, marked by a line, to 40 minutes after it.

    turned: {name: `Result`}, of runs that change at half-time, the first of which the record has. chance: what Brownian
    motion catches per minute.
    """
    minutes, curves = caught_around(turned)
    axes = draw_curves(minutes, curves, "simulated minutes since red discs are wanted, too", "discs caught per minute")
    axes.set_xlim(minutes[0], minutes[-1])
    mark_levels(axes, {"Brownian motion": chance})
    axes.axvline(0, color=INK, linewidth=0.7)
    first = next(iter(turned.values()))
    middles = {f"caught a minute, {when}": (np.mean(shares) - 0.5) * first.seconds / 60
               for when, shares in MINUTES.items()}
    page.add_recorded_points(axes, {name: at for name, at in middles.items() if at < minutes[-1]}, first, "T1")


def caught_around(turned):
    """Discs of either colour caught per minute around half-time: their minutes since then, and {name: (runs, minutes)}.

    Runs last 200 minutes; in shorter ones the stretches are shorter, and at least a bin.
    """
    results = [*turned.values()]
    edges = np.linspace(0.45, 0.7, 1 + min(50, min(result.rewards.shape[1] for result in results) // 5))
    curves = {name: np.stack([60 * result.hit_rate(*pair).sum(axis=1) for pair in zip(edges[:-1], edges[1:])], axis=1)
              for name, result in turned.items()}
    return ((edges[:-1] + edges[1:]) / 2 - 0.5) * results[0].seconds / 60, curves


def draw_distances(moved):
    """Draw the distance of agents from a desired place over all its moves. moved: {agents: `trials.Moved`}."""
    first = next(iter(moved.values()))
    starts = SECONDS_A_MOVE * np.arange(first.distances["experienced"].shape[1])
    curves = {f"{agents}, {name}": each.reshape(len(each), -1) for agents, of_agents in moved.items()
              for name, each in of_agents.distances.items()}
    draw_curves((starts[:, None] + first.seconds).ravel(), curves, "seconds", "distance, board widths")
