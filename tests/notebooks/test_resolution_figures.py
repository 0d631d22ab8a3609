"""The numbers shown by the figures of paper A."""

import numpy as np
import pytest
from matplotlib import pyplot as plt
from matplotlib.colors import to_hex

from neorl import NresMap, Result, WaterWorld, place_cells
from lib.paper_a import resolution_figures
from neorl.drawing.style import AGENT, GREEN, INK, RED
from neorl.evidence.reading import LAYERS


def steady(rate):
    """A result in which every run earns `rate` per second throughout."""
    rewards = np.full((2, 500), 0.2 * rate, np.float32)
    return Result(place_cells([2]), WaterWorld(), 5_000, 2, 0, rewards, np.zeros((2, 500, 2), np.int16))


def test_three_maps_together_are_drawn_beside_each_alone_their_sum_and_the_level_of_the_thesis():
    results = {("layer", n): steady(rate) for n, rate in zip(LAYERS, (0.1, 0.2, 0.3))} | {"layers": steady(0.9)}
    resolution_figures.draw_together(results)
    axes = plt.gca()
    np.testing.assert_allclose([line.get_ydata()[-1] for line in axes.lines[:5]], [0.1, 0.2, 0.3, 0.9, 0.6], rtol=1e-5)
    assert axes.lines[-1].get_ydata()[0] == pytest.approx(3.5 * 0.2)
    assert {text.get_text() for text in axes.texts} == {"N3", "N7", "N23", "all three", "sum of the three",
                                                        "thesis: 3.5 × N7"}


def test_an_element_fills_its_cell_by_the_sign_and_the_size_of_its_valence():
    n2 = NresMap(2)
    values = np.zeros((4, 4))
    values[3] = [0.0, 0.0, 1.0, 0.0]
    resolution_figures.draw_elements(n2, [(0.7, 0.7), (0.2, 0.7)], [0.5, -1.0], values)
    axes = plt.gca()
    filled = {patch.get_xy(): (to_hex(patch.get_facecolor()), patch.get_alpha()) for patch in axes.patches
              if patch.get_alpha()}
    assert filled == {(0.5, 0.5): (GREEN, 0.15), (0.0, 0.5): (RED, 0.3)}
    assert [text.get_text() for text in axes.texts] == ["+0.5", "−1"]
    assert [text.get_ha() for text in axes.texts] == ["left", "left"]  # the upper left corner, which no arrow crosses
    (arrows,) = axes.collections
    assert len(arrows.U) == 1 and arrows.U[0] > 0


def test_finer_maps_have_thinner_lines():
    resolution_figures.draw_maps([NresMap(n) for n in (1, 2, 3)])
    lines = [(to_hex(patch.get_edgecolor()), patch.get_linewidth()) for patch in plt.gca().patches]
    assert lines == [(RED, 3.2)] + 4 * [(AGENT, 1.8)] + 9 * [(INK, 0.7)]


def test_a_valence_stands_in_a_corner_that_its_arrow_does_not_cross():
    values = np.zeros((4, 4))
    values[0], values[1] = [0, 1, 1, 0], [1, 0, 1, 0]  # to the south-east, to the north-east
    resolution_figures.draw_elements(NresMap(2), [(0.2, 0.2), (0.7, 0.2)], [1.0, 1.0], values)
    assert [(text.get_ha(), round(text.get_position()[0], 3)) for text in plt.gca().texts] == [
        ("right", 0.46), ("left", 0.54)]
