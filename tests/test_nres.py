"""NRES maps: one active cell for any point, also at the edges."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from neorl import NresMap

coordinates = st.floats(-10, 10)


@given(st.integers(1, 90), coordinates, coordinates)
def test_exactly_one_receptive_field_holds_a_point(resolution, x, y):
    cell = int(NresMap(resolution).encode([x, y]))
    inside = np.clip([x, y], 0, 1)
    column, row = cell % resolution, cell // resolution
    assert 0 <= cell < resolution**2
    assert np.all(np.array([column, row]) <= inside * resolution + 1e-9)
    assert np.all(inside * resolution <= np.array([column, row]) + 1 + 1e-9)


@given(st.integers(1, 30))
def test_every_cell_is_active_somewhere(resolution):
    centres = (np.arange(resolution) + 0.5) / resolution
    points = np.stack(np.meshgrid(centres, centres), axis=-1)
    assert NresMap(resolution).encode(points).ravel().tolist() == list(range(resolution**2))


def test_a_border_belongs_to_the_cell_after_it_and_the_rim_to_the_last():
    n4 = NresMap(4)
    assert n4.encode([[0.25, 0.0], [0.5, 0.75], [1.0, 1.0], [1.0, 0.0]]).tolist() == [1, 14, 15, 3]


def test_a_point_beyond_the_extent_belongs_to_the_nearest_cell():
    middle = NresMap(3, extent=(0.25, 0.75))
    assert middle.encode([[0.1, 0.1], [0.9, 0.1], [0.5, 0.5], [7.0, -7.0]]).tolist() == [0, 2, 4, 2]


@pytest.mark.parametrize("arguments, message", [
    ({"resolution": 0}, "resolution is 0, allowed are integers ≥ 1"),
    ({"resolution": 2.5}, "resolution is 2.5"),
    ({"resolution": True}, "resolution is True"),
    ({"resolution": 3, "extent": (1.0, 0.0)}, "extent is"),
    ({"resolution": 3, "extent": (0.0, np.nan)}, "extent is"),
    ({"resolution": 3, "extent": (0.0,)}, "extent is"),
])
def test_a_bad_map_is_refused(arguments, message):
    with pytest.raises(ValueError, match=message):
        NresMap(**arguments)


@pytest.mark.parametrize("point", [[np.nan, 0.5], [0.5, np.inf]])
def test_a_point_that_is_not_finite_is_refused(point):
    with pytest.raises(ValueError, match="points is .*, allowed are finite numbers"):
        NresMap(3).encode(point)
