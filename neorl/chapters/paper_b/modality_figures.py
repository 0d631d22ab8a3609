"""Figures of paper B: agents beside the thesis's numbers, the cells of every modality, and results of the trials."""

import numpy as np

from neorl.chapters.paper_b.trials import SECONDS_A_MOVE
from neorl.core.maps import NresMap
from neorl.core.modality import MODALITIES
from neorl.drawing.boards import draw_tank, new_boards
from neorl.drawing.curves import draw_curves, draw_sweep
from neorl.drawing.receptive_fields import draw_receptive_fields
from neorl.drawing.style import INK
from neorl.drawing.thesis_figures import draw_against_thesis
from neorl.evidence.reading import PRIMES
from neorl.evidence.statistics import estimate

LABELS = {"PC": "place cells", "OVC": "object-vector\ncells", "PC + OVC": "both"}


def draw_agents(thesis, found, xlabel):
    """Draw results of figure 5's agents beside the thesis's numbers, a row for each agent with such a number.

    thesis: {agent: number}. found: {reading: {agent: Estimate}}.
    """
    draw_against_thesis({LABELS[agent]: number for agent, number in thesis.items()},
                        {name: {LABELS[agent]: of_agents[agent] for agent in thesis}
                         for name, of_agents in found.items()}, xlabel)


def draw_modalities(world, state):
    """Draw the receptive fields of a map of each modality over a tank, those of its active cells filled."""
    for axes, modality in zip(new_boards(2, 4), MODALITIES):
        draw_receptive_fields(NresMap(7, modality), world, state, axes)
        draw_tank(world, state, axes)
        axes.set_title(modality.name)


def draw_revaluing(minutes, curves):
    """Draw red creeps per minute over the run, {name: (runs, stretches)}, and a line where they are revalued."""
    axes = draw_curves(minutes, curves, "simulated minutes", "red creeps per minute")
    axes.axvline((minutes[0] + minutes[-1]) / 2, color=INK, linewidth=0.7)


def draw_distances(watched):
    """Draw the distance of agents from a desired place over all its moves. watched: a `Watched`."""
    starts = SECONDS_A_MOVE * np.arange(watched.moved["experienced"].shape[1])
    draw_curves((starts[:, None] + watched.seconds).ravel(),
                {name: each.reshape(len(each), -1) for name, each in watched.moved.items()},
                "seconds", "distance, board widths")


def draw_time_scale(watched):
    """Draw seconds in a cell over the width of its receptive field, on logarithmic axes: {name: `Watched`}."""
    finest_first = PRIMES[::-1]
    widths = [1 / n for n in finest_first]
    stays = {name: [estimate(np.mean, stay) for stay in each.stays.T[::-1]] for name, each in watched.items()}
    axes = draw_sweep(widths, stays, "width of a receptive field, share of the range", "seconds in a cell")
    axes.set(xscale="log", yscale="log", ylim=(None, None))
    axes.set_xticks(widths, ["" if n == 11 else f"1/{n}" for n in finest_first])
    axes.minorticks_off()
