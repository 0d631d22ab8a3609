"""The page "In your research": what its cells decode from the rates of simulated neurons."""

from types import SimpleNamespace

import numpy as np
import pytest
from page_cells import executed

pytestmark = pytest.mark.filterwarnings("ignore:invalid escape sequence")  # of RatInABox, where it is first compiled


@pytest.fixture(scope="module")
def page():
    return executed("your_research")


def cells(rates, **more):
    return SimpleNamespace(firingrate=np.array(rates, float), **more)


def test_a_place_is_the_mean_of_preferred_places_weighted_by_rates(page):
    centres = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]])
    assert page.decode_place(cells([0, 3, 1], place_cell_centres=centres)) == pytest.approx([1, 0.25])


def test_a_vector_is_decoded_from_distances_and_angles(page):
    tuning = {"tuning_distances": np.array([0.2, 0.4]), "tuning_angles": np.array([0.0, np.pi / 2])}
    assert page.decode_vector(cells([1, 1], **tuning)) == pytest.approx([0.1, 0.2])
    assert page.decode_vector(cells([0, 0], **tuning)) is None


def test_an_object_that_no_cell_signals_is_absent_from_the_scene(page):
    place = cells([1], place_cell_centres=np.array([[0.3, 0.6]]))
    tuning = {"tuning_distances": np.array([0.2]), "tuning_angles": np.array([0.0])}
    near, far = (page.scene_of(place, cells([rate], **tuning)) for rate in (1, 0))
    assert np.allclose(near.things, [[0.5, 0.6]]) and near.kinds == ["object"] and far.kinds == [None]


def test_an_animal_in_random_motion_is_the_same_for_the_same_seed(page):
    pytest.importorskip("ratinabox")
    one, again, other = (page.forage(None, 20, seed) for seed in (0, 0, 1))
    assert np.array_equal(one, again) and not np.array_equal(one, other)
