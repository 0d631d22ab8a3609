"""The page "In your research": what it decodes from the rates of simulated neurons, and what it reports."""

from types import SimpleNamespace

import numpy as np
import pytest

from lib.your_research import rats, report


def cells(rates, **more):
    return SimpleNamespace(firingrate=np.array(rates, float), **more)


def test_a_place_is_the_mean_of_preferred_places_weighted_by_rates():
    centres = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]])
    assert rats.decode_place(cells([0, 3, 1], place_cell_centres=centres)) == pytest.approx([1, 0.25])


def test_a_vector_is_decoded_from_distances_and_angles():
    tuning = {"tuning_distances": np.array([0.2, 0.4]), "tuning_angles": np.array([0.0, np.pi / 2])}
    assert rats.decode_vector(cells([1, 1], **tuning)) == pytest.approx([0.1, 0.2])
    assert rats.decode_vector(cells([0, 0], **tuning)) is None


def test_an_object_that_no_cell_signals_is_absent_from_the_scene():
    place = cells([1], place_cell_centres=np.array([[0.3, 0.6]]))
    tuning = {"tuning_distances": np.array([0.2]), "tuning_angles": np.array([0.0])}
    near, far = (rats.scene_of(place, cells([rate], **tuning)) for rate in (1, 0))
    assert np.allclose(near.things, [[0.5, 0.6]]) and near.kinds == ["object"] and far.kinds == [None]


def test_an_animal_in_random_motion_is_the_same_for_the_same_seed():
    pytest.importorskip("ratinabox")
    one, again, other = (rats.forage(None, 20, seed) for seed in (0, 0, 1))
    assert np.array_equal(one, again) and not np.array_equal(one, other)


def test_curves_are_means_of_whole_stretches():
    middles, curves = rats.smoothed({"rat": np.arange(250.0)}, seconds=10)
    assert middles.tolist() == [5, 15] and curves["rat"].tolist() == [[49.5, 149.5]]


def test_reports_name_what_they_compare():
    assert report.same_bits("Values", np.ones(3), np.ones(3)) == "Values: the same to the last bit."
    assert report.same_bits("Values", np.ones(3), np.zeros(3)) == "Values: not the same."
    away = report.distances({"neoRL": np.full(10, 0.1), "random": np.full(10, 0.5)})
    assert "in one run each: neoRL 0.10\u00a0m, random 0.50\u00a0m" in away
    assert report.transfer([(9, 5), (40, 7), (2, 8)], 20_000) == (
        "In 20,000 steps, agents that began with the values of another earned 9 points (median over runs), and agents "
        "that began without earned 7; the former earned more in 2 of 3 runs.")


def test_the_box_has_transfer_checkpoint_and_steering():
    text = report.in_short([(3.0, 1.0), (2.0, 2.0)], 100, np.ones(2), np.ones(2), {"neoRL": np.full(10, 0.2)})
    assert text.startswith("In 100 steps, agents that began with the values of another earned 2 points (median over ")
    assert "without a break: the same to the last bit. In another simulator, an agent" in text
    assert text.endswith("neoRL 0.20\u00a0m.")
