"""Figures of paper B: agents beside the thesis's numbers, states, cells of every modality, and results of trials."""

import numpy as np
from matplotlib.patches import Circle

from lib.paper_b.trials import SECONDS_A_MOVE, best_values, values_for_objects
from neorl.core.maps import NresMap
from neorl.core.modality import CARTESIAN_OBJECT_VECTOR_CELL, MODALITIES
from neorl.drawing.boards import as_board, draw_tank, new_boards
from neorl.drawing.curves import draw_curves, draw_sweep
from neorl.drawing.receptive_fields import draw_receptive_fields
from neorl.drawing.style import AGENT, FILL, GREEN, INK, mark
from neorl.drawing.thesis_figures import draw_against_thesis
from neorl.drawing.value_maps import draw_cells, draw_values
from neorl.evidence.reading import PRIMES
from neorl.evidence.statistics import estimate

OBJECT = (0.8, -0.4)  # where the object is as seen from the self, in board widths
DISC = 0.09  # radius of either, larger than in the tank
FIELDS = (7, 13)  # the maps whose values are drawn
LABELS = {"PC": "place cells", "OVC": "object-vector\ncells", "PC + OVC": "both"}


def draw_agents(thesis, found, xlabel):
    """Draw results of figure 5's agents beside the thesis's numbers, a row for each agent with such a number.

    thesis: {agent: number}. found: {reading: {agent: Estimate}}.
    """
    draw_against_thesis({LABELS[agent]: number for agent, number in thesis.items()},
                        {name: {LABELS[agent]: of_agents[agent] for agent in thesis}
                         for name, of_agents in found.items()}, xlabel)


def draw_states():
    """Draw the state and the goal of an N5 of object vectors under both readings, with an example of a transition."""
    n5, (x, y) = NresMap(5, CARTESIAN_OBJECT_VECTOR_CELL), OBJECT
    centre, of_object = (int(cell) for cell in n5.encode([(0, 0), OBJECT]))
    side = 2 / n5.resolution
    readings = {"the self": ("state", "goal", (0, 0), (side / 2, 0)),
                "the object's cell": ("goal", "state", OBJECT, (x - side, y))}
    for axes, (title, (of_centre, of_cell, start, end)) in zip(new_boards(2, 1), readings.items()):
        draw_cells(n5, fills={centre: (AGENT, FILL), of_object: (GREEN, FILL)}, ax=as_board(axes, -1))
        for place, colour, name in (((0, 0), AGENT, of_centre), (OBJECT, GREEN, of_cell)):
            axes.add_patch(Circle(place, DISC, facecolor=colour, edgecolor="none"))
            mark(axes, (place[0], place[1] + 0.31), name, ha="center", va="center")
        axes.annotate("", end, start, arrowprops={"arrowstyle": "->", "color": INK, "linewidth": 1.8, "shrinkA": 0,
                                                  "shrinkB": 0})
        axes.set_title(title)


def draw_object_values(learned):
    """Draw which way the values for an object in each cell would take the agent, in two maps of the first runs.

    learned: of agents of object-vector cells alone, {name: [`Run`, …]}.
    """
    boards = iter(new_boards(len(learned), len(FIELDS)))
    for n in FIELDS:
        for name, (run, *_) in learned.items():
            axes, m = as_board(next(boards), -1), [each.resolution for each in run.agent.maps].index(n)
            nres_map = run.agent.maps[m]
            draw_cells(nres_map, fills={int(nres_map.encode([0, 0])): (GREEN, FILL)}, width=0.6, ax=axes)
            draw_values(nres_map, values_for_objects(run, m), ax=axes)
            axes.set_title(f"{name}, N{n}")


def draw_best_values(learned):
    """Draw the mean best value of each map, see `trials.best_values`. learned: as in `draw_object_values`."""
    values = {name: np.array([best_values(run) for run in runs]).T for name, runs in learned.items()}
    axes = draw_sweep(PRIMES, {name: [estimate(np.mean, of_map) for of_map in each] for name, each in values.items()},
                      "N of the map", "mean best value")
    axes.set_xticks(PRIMES)


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
