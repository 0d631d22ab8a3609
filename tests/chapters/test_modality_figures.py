"""The numbers shown by the figures of paper B."""

import numpy as np
import pytest
from matplotlib import pyplot as plt

from neorl import WaterWorld
from neorl.chapters.paper_b import modality_figures
from neorl.chapters.paper_b.trials import SECONDS_A_MOVE, Watched
from neorl.core.modality import MODALITIES
from neorl.evidence.reading import PRIMES
from neorl.evidence.statistics import Estimate


def test_agents_stand_beside_the_numbers_that_the_thesis_has():
    found = {"calibrated": {"PC": Estimate(100, 90, 110), "OVC": Estimate(50, 40, 60),
                            "PC + OVC": Estimate(20, 10, 30)}}
    modality_figures.draw_agents({"PC": 160, "PC + OVC": 15}, found, "minutes")
    axes = plt.gca()
    assert [label.get_text() for label in axes.get_yticklabels()] == ["place cells", "both"]
    assert list(axes.lines[0].get_xdata()) == [100, 20] and axes.get_xlabel() == "minutes"
    assert [text.get_text() for text in axes.texts] == ["thesis 160", "thesis 15"]


def test_every_modality_has_a_board_with_the_tank():
    world = WaterWorld()
    modality_figures.draw_modalities(world, world.reset(0))
    assert [axes.get_title() for axes in plt.gcf().axes] == [modality.name for modality in MODALITIES]
    assert all(len(axes.patches) >= 4 for axes in plt.gcf().axes)


def test_the_turn_is_marked_at_half_time():
    minutes = (np.arange(100) + 0.5) / 10
    modality_figures.draw_revaluing(minutes, {"one": np.ones((3, 100)), "other": np.zeros((3, 100))})
    *curves, turn = plt.gca().lines
    assert [line.get_ydata()[0] for line in curves] == [1.0, 0.0]
    assert turn.get_xdata() == pytest.approx([5.0, 5.0])


def test_moves_follow_one_another():
    moved = {"experienced": np.arange(24.0).reshape(2, 3, 4), "ignorant": np.zeros((2, 3, 4))}
    modality_figures.draw_distances(Watched(moved, np.array([1.0, 2.0, 3.0, 4.0]), None, None, None))
    experienced, _ = plt.gca().lines
    assert list(experienced.get_xdata()) == [s + SECONDS_A_MOVE * move for move in range(3) for s in (1, 2, 3, 4)]
    np.testing.assert_array_equal(experienced.get_ydata(), np.arange(12) + 6.0)


def test_stays_are_drawn_over_the_widths_of_fields_the_finest_first():
    stays = np.tile([1.0 / n for n in PRIMES], (3, 1))
    modality_figures.draw_time_scale({"calibrated": Watched(None, None, stays, None, None)})
    axes = plt.gca()
    line = axes.lines[1]
    np.testing.assert_allclose(line.get_xdata(), [1 / n for n in PRIMES[::-1]])
    np.testing.assert_allclose(line.get_ydata(), line.get_xdata())
    assert axes.get_xscale() == axes.get_yscale() == "log"
    assert [label.get_text() for label in axes.get_xticklabels()] == ["1/13", "", "1/7", "1/5", "1/3", "1/2"]
