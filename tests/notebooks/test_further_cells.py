"""Grid cells, path integration and egocentric object cells against their definitions."""

import numpy as np
import pytest
from matplotlib import pyplot as plt

from lib.chapter_2 import tuning_figures
from lib.chapter_2.further_cells import grid_maps, grid_rate, lose_track, mistakable, object_maps, phases
from lib.chapter_2.tuning import roam


def test_a_grid_cell_fires_most_at_the_nodes_of_a_hexagonal_lattice():
    angles = np.radians(60 * np.arange(6))
    nodes = 0.3 * np.stack([np.cos(angles), np.sin(angles)], axis=-1)
    np.testing.assert_allclose(grid_rate(np.vstack([(0, 0), nodes, 2 * nodes]), 0.3), 1.0, atol=1e-12)
    fine = np.random.default_rng(0).random((20_000, 2))
    rates = grid_rate(fine, 0.3)
    assert rates.min() == pytest.approx(0, abs=0.01) and rates.max() <= 1
    high = fine[rates > 0.99] @ np.linalg.inv(np.array([nodes[0], nodes[1]]))
    assert np.abs(high - np.round(high)).max() < 0.1


def test_cells_of_a_module_differ_in_phase():
    at = np.array([0.2, 0.7])
    assert grid_rate(at, 0.3, phases(at, 0.3)) == pytest.approx(1.0)


def test_one_module_mistakes_places_for_others_and_two_do_not():
    assert mistakable([0.3]) == 1.0 and mistakable([1.5], tolerance=0.05) == 0.0
    assert mistakable([0.3, 0.42]) < 0.1


def test_a_scale_is_positive():
    with pytest.raises(ValueError, match="scale must be .*, but is 0"):
        phases((0.5, 0.5), 0)


def test_the_error_of_a_sum_grows_with_the_root_of_time_and_that_corrected_stays():
    errors = lose_track(200, 20, noise=0.05, seed=1)
    alone, corrected = errors["sum alone"], errors["corrected at walls"]
    assert alone.shape == (200, 1000) and np.all(alone[:, 0] == 0)
    for second in (5, 20):
        assert np.mean(alone[:, 50 * second - 1] ** 2) == pytest.approx(2 * 0.05**2 * second, rel=0.2)
    assert corrected[:, -1].mean() < 0.7 * alone[:, -1].mean()


def test_without_noise_only_corrections_err_by_half_their_reach_at_most():
    errors = lose_track(20, 10, noise=0, reach=0.1)
    assert np.all(errors["sum alone"] == 0)
    assert 0 < errors["corrected at walls"].max() <= np.hypot(0.05, 0.05)


def test_an_object_cell_has_a_compact_field_in_its_own_frame_alone():
    maps = object_maps(roam(60_000, 0), (0.5, 0.5))
    for cell, frames in maps.items():
        share = {frame: np.mean(rate > np.nanmax(rate) / 3) for frame, rate in frames.items()}
        own, other = sorted(share, key=share.get)
        assert cell == f"{own} cell" and share[other] > 3 * share[own]
        peak = np.unravel_index(np.nanargmax(frames[own]), frames[own].shape)
        np.testing.assert_allclose((np.array(peak) + 0.5) / 25 - 0.5, (0.2, -0.15), atol=0.06)


def test_the_figures_show_every_map_and_curve():
    walk = roam(3_000, 0)
    maps = grid_maps(walk, (0.3, 0.6))
    assert list(maps) == ["scale 0.3", "scale 0.6"] and maps["scale 0.3"].shape == (25, 25)
    tuning_figures.draw_grid_cells(maps)
    assert [axes.get_title() for axes in plt.gcf().axes] == ["scale 0.3", "scale 0.6"]
    tuning_figures.draw_object_maps(object_maps(walk, (0.5, 0.5)))
    assert len(plt.gcf().axes) == 4 and plt.gcf().axes[0].get_title() == "allocentric cell,\nallocentric map"
    tuning_figures.draw_drift(lose_track(3, 4))
    assert {text.get_text() for text in plt.gca().texts} == {"sum alone", "corrected at walls"}
    plt.close("all")
