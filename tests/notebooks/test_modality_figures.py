"""The numbers shown by the figures of paper B."""

import numpy as np
import pytest
from matplotlib import pyplot as plt

from neorl import WaterWorld, object_vector_cells
from lib.paper_b import modality_figures
from lib.paper_b.trials import SECONDS_A_MOVE, Watched, best_values, learn
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


def test_state_and_goal_change_places_between_the_readings():
    modality_figures.draw_states()
    for axes, at_centre, start in zip(plt.gcf().axes, ("state", "goal"), ((0, 0), modality_figures.OBJECT)):
        named = {text.get_text(): text.xyann for text in axes.texts}
        arrow = named.pop("")
        assert {name: place[0] for name, place in named.items()} == {
            at_centre: 0, ({"state", "goal"} - {at_centre}).pop(): modality_figures.OBJECT[0]}
        assert arrow == start


@pytest.fixture(scope="module")
def learned():
    """Runs of agents with two small maps, whose state is the self or the object's cell."""
    return learn({state: object_vector_cells([2, 5], object_state=state) for state in ("self", "object")},
                 WaterWorld(), 4_000, 2)


def test_the_values_for_objects_are_drawn_map_by_map(learned, monkeypatch):
    monkeypatch.setattr(modality_figures, "FIELDS", (5,))
    modality_figures.draw_object_values(learned)
    assert [axes.get_title() for axes in plt.gcf().axes] == ["self, N5", "object, N5"]
    for axes in plt.gcf().axes:
        assert len(axes.patches) == 26 and axes.get_xlim()[0] < -1 and len(axes.collections[0].U) <= 25


def test_the_best_values_of_each_map_are_means_over_runs(learned, monkeypatch):
    monkeypatch.setattr(modality_figures, "PRIMES", (2, 5))
    modality_figures.draw_best_values(learned)
    axes = plt.gca()
    of_self = np.mean([best_values(run) for run in learned["self"]], axis=0)
    assert any(np.allclose(line.get_ydata(), of_self) for line in axes.lines if len(line.get_ydata()) == 2)
    assert {"self", "object"} <= {text.get_text() for text in axes.texts}


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
