"""Figures of paper A: maps over one board, the field of elements of interest, and maps alone and together."""

import numpy as np

from lib.paper_a.experiments import layers
from lib.paper_a.findings import REWARD, THESIS
from neorl.core.horde import as_vectors
from neorl.core.scene import CARDINAL
from neorl.drawing.boards import new_board
from neorl.drawing.curves import draw_proficiency
from neorl.drawing.style import AGENT, FILL, GREEN, INK, RED, mark
from neorl.drawing.thesis_figures import mark_levels
from neorl.drawing.value_maps import draw_cells, draw_values
from neorl.evidence.verdict import FINAL


def draw_together(results):
    """Draw reward per second of N3, N7 and N23 alone, together, and summed. results: of one reading.

    A dashed line marks the thesis's level for all three together, a multiple of what N7 finally earns here.
    """
    alone = layers(results)
    axes = draw_proficiency(alone | {"all three": results["layers"]}, ("sum of the three", [*alone.values()]))
    level = THESIS[REWARD] * results["layer", 7].rate(*FINAL).mean()
    mark_levels(axes, {f"thesis: {THESIS[REWARD]} × N7": level})


def draw_elements(nres_map, places, valences, values):
    """Draw elements of interest in a map, their valences in corners that no arrow crosses, and the action values.

    places: (elements, 2), in board widths. valences: (elements,). values: (cells, 4), of the map for these elements.
    """
    fills = {goal: (GREEN if valence > 0 else RED, FILL * abs(valence))
             for goal, valence in zip(nres_map.encode(places), valences)}
    axes = draw_cells(nres_map, fills=fills)
    draw_values(nres_map, values, ax=axes)
    cells, side = nres_map.encode(places), 1 / nres_map.resolution
    for cell, (east, south), valence in zip(cells, as_vectors(np.asarray(values), CARDINAL)[cells], valences):
        left, top = side * (cell % nres_map.resolution), side * (cell // nres_map.resolution)
        falling = east * south > 0  # an arrow that leaves the upper right corner free
        mark(axes, (left + side * (0.92 if falling else 0.08), top + 0.08 * side), f"{valence:+g}".replace("-", "−"),
             ha="right" if falling else "left", va="top")


def draw_maps(maps):
    """Draw the receptive fields of three maps over one board, each in thinner lines than the one before."""
    axes = new_board()
    for nres_map, colour, width in zip(maps, (RED, AGENT, INK), (3.2, 1.8, 0.7)):
        draw_cells(nres_map, colour, width=width, ax=axes)
