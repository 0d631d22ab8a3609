"""The figures and tables of the page on paper B, and the conditions that its Explorer offers.

1. The results under one reading are {key: `Result`}, with the keys ("place", N), ("objects", N), "both" and
   ("brownian", 3); N is a resolution, or "all" for the agent with all of them. `AGENTS` names those of figure 5.
2. A reading is called calibrated only with the book's gain of place cells. The thesis's numbers, and the names of its
   figures, go only with what the paper ran.
"""

import numpy as np
from matplotlib.patches import Circle

from companion.paper_b.receptive_fields import draw_receptive_fields
from companion.paper_b.trials import SECONDS_A_MOVE, best_values, values_for_objects
from companion.shared.panels import add_arrow
from companion.shared.report import CALIBRATED
from companion.shared.style import FILL, mark
from companion.shared.thesis_figures import draw_against_thesis, mark_levels
from neorl.core.maps import NresMap
from neorl.core.modality import CARTESIAN_OBJECT_VECTOR_CELL, MODALITIES
from neorl.drawing.boards import as_board, draw_tank, new_boards
from neorl.drawing.curves import draw_curves, draw_sweep
from neorl.drawing.style import AGENT, GREEN, INK
from neorl.drawing.value_maps import draw_cells, draw_values
from companion.thesis.reading import Reading
from companion.thesis.statements import STATEMENTS
from neorl.statistics import estimate

OBJECT = (0.8, -0.4)  # where the object is as seen from the self, in board widths
DISC = 0.09  # radius of either, larger than in the tank
AGENTS = {"PC": ("place", "all"), "OVC": ("objects", "all"), "PC + OVC": "both"}  # of figure 5, and their keys
CELLS = {"PC": "place", "OVC": "object-vector", "PC + OVC": "place + object-vector"}  # these in words
LABELS = {"PC": "place cells", "OVC": "object-vector\ncells", "PC + OVC": "both"}
B3, B4 = STATEMENTS["B3"], STATEMENTS["B4"]
PC = B3.also["place cells"].number  # per second, and of object-vector cells too: "no loss", section 3.1
THESIS_LEVELS = {"PC": PC, "OVC": PC, "PC + OVC": B3.bounds.number}
THESIS_MINUTES = {"PC": B4.also["place cells"].number, "PC + OVC": B4.bounds.number}
STRETCHES = 100  # intervals of a run in which red creeps are counted


def named(place_gain):
    """The name of the book's reading with some gain of place cells: "calibrated" with its own."""
    return CALIBRATED if place_gain == Reading.place_gain else f"{CALIBRATED}, PC × {place_gain:g}"


def of_figure_4(results, modality):
    """Results of figure 4's agents under one reading, "place" (4A) or "objects" (4B): {"N2": Result, …, "all": …}."""
    found = {key[1]: result for key, result in results.items() if key[0] == modality}
    return {f"N{n}": found[n] for n in found if n != "all"} | {"all": found["all"]}


def of_figure_5(results):
    """Results of figure 5's agents under one reading: {"PC": Result, …}."""
    return {name: results[key] for name, key in AGENTS.items()}


def draw_agents(thesis, found, xlabel, of_paper):
    """Draw results {reading: {agent: Estimate}}, and beside the paper's own the thesis's numbers {agent: number}."""
    draw_against_thesis({LABELS[agent]: number if of_paper else None for agent, number in thesis.items()},
                        {name.replace(", ", ",\n"): {LABELS[agent]: of_agents[agent] for agent in thesis}
                         for name, of_agents in found.items()}, xlabel)  # in two lines, a long name has room


def draw_states():
    """Draw the state and the goal of an N5 of object vectors, with an example of a transition."""
    n5, (x, y) = NresMap(5, CARTESIAN_OBJECT_VECTOR_CELL), OBJECT
    centre, of_object = (int(cell) for cell in n5.encode([(0, 0), OBJECT]))
    side = 2 / n5.resolution
    readings = {"the self, also per object": ("state", "goal", (0, 0), (side / 2, 0)),
                "the object's cell": ("goal", "state", OBJECT, (x - side, y))}
    for axes, (title, (of_centre, of_cell, start, end)) in zip(new_boards(2, 1), readings.items()):
        draw_cells(n5, fills={centre: (AGENT, FILL), of_object: (GREEN, FILL)}, ax=as_board(axes, -1))
        for place, colour, name in (((0, 0), AGENT, of_centre), (OBJECT, GREEN, of_cell)):
            axes.add_patch(Circle(place, DISC, facecolor=colour, edgecolor="none"))
            mark(axes, (place[0], place[1] + 0.31), name, ha="center", va="center")
        add_arrow(axes, start, end, INK, 1.8)
        axes.set_title(title)


def draw_object_values(learned):
    """Draw where values for an object would take agents: {name: [`Run`, …]}."""
    maps = _resolutions(learned)
    drawn = dict.fromkeys((maps[len(maps) // 2], maps[-1]))
    boards = iter(new_boards(len(learned), len(drawn)))
    for n in drawn:
        for name, (run, *_) in learned.items():
            axes, m = as_board(next(boards), -1), maps.index(n)
            nres_map = NresMap(n, CARTESIAN_OBJECT_VECTOR_CELL)  # drawn as wide as the board, whatever its range
            draw_cells(nres_map, fills={int(nres_map.encode([0, 0])): (GREEN, FILL)}, width=0.6, ax=axes)
            draw_values(nres_map, values_for_objects(run, m), ax=axes)
            axes.set_title(f"{name}, N{n}")


def draw_best_values(learned):
    """Draw the mean best value of each map, see `trials.best_values`. learned: as in `draw_object_values`."""
    values = {name: np.array([best_values(run) for run in runs]).T for name, runs in learned.items()}
    maps = _resolutions(learned)
    axes = draw_sweep(maps, {name: [estimate(np.mean, of_map) for of_map in each] for name, each in values.items()},
                      "N of the map", "mean best value")
    axes.set_xticks(maps)


def draw_modalities(world, state):
    """Draw the receptive fields of a map of each modality over a tank, those of its active cells filled."""
    for axes, modality in zip(new_boards(2, 4), MODALITIES):
        draw_receptive_fields(NresMap(7, modality), world, state, axes)
        draw_tank(world, state, axes)
        axes.set_title(modality.name)


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


def draw_levels(axes, agents):
    """Mark the levels of the thesis in a figure of curves. agents: {name of a line: agent of `THESIS_LEVELS`}."""
    mark_levels(axes, {f"thesis, {name}: {THESIS_LEVELS[agent]}": THESIS_LEVELS[agent]
                       for name, agent in agents.items()})


def explorer_conditions(calibrated, letter, paper, others):
    """The conditions that the page's Explorer offers, of those under two readings: {name: `Result`}."""
    offered = {f"{paper}, figure 5: place + object-vector cells": calibrated["both"]}
    for figure, modality in (("4A: place", "place"), ("4B: object-vector", "objects")):
        offered |= {f"{paper}, figure {figure} cells, {n}": result
                    for n, result in of_figure_4(calibrated, modality).items()}
    offered |= {f"{paper}, figure 5, to the letter: {CELLS[name]} cells": result
                for name, result in of_figure_5(letter).items()}
    return offered | {f"{paper}: {what}": result for what, result in others.items()}


def _resolutions(learned):
    return [each.resolution for each in next(iter(learned.values()))[0].agent.maps]
