"""NRES maps: one active cell for any point of any modality, including the edges, against NumPy."""

import math

import numpy as np
import pandas
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from neorl import Agent, Desire, Node, NresMap, Place, Run, WaterWorld
from neorl.custom import Axis, Modality
from neorl.core.coordinates import sense, tune
from neorl.core.direction import TAU
from neorl.core.modality import (HEAD_DIRECTION_CELL, MODALITIES, OBJECT_VECTOR_CELL, PLACE_CELL, SPEED_CELL,
                                 cartesian)

closed = pytest.mark.parametrize("modality", [each for each in MODALITIES if each.axes[-1].is_direction],
                                 ids=lambda modality: modality.name)
near_and_far = st.floats(-3, 3) | st.floats(-1e6, 1e6)

# Axes of every kind and division; those of the vector followed come before those of others, directions last.
PLACE_DIRECTION = Modality("place × head direction", PLACE_CELL.axes + HEAD_DIRECTION_CELL.axes)
OBJECT_VELOCITY = Modality("object vector × velocity",
                           OBJECT_VECTOR_CELL.axes + cartesian("velocity", (-1, 1), (-1, 1), intervals=2))
UNEQUAL = Modality("near and far", [Axis("objects", "length", boundaries=(0.0, 0.1, 0.15, 0.6)),
                                    Axis("objects", "direction", intervals=5), Axis("position", along=1, intervals=3)])
RING = Modality("ring", [Axis("position", closed=True, low=0.25, high=0.75),
                         Axis("position", along=1, closed=True, intervals=4)])
LINE, ROOM = (Modality(name, [Axis("position", along=along, low=-1, high=2) for along in range(axes)])
              for name, axes in (("line", 1), ("room", 3)))
ALL = (*MODALITIES, PLACE_DIRECTION, OBJECT_VELOCITY, UNEQUAL, RING, LINE, ROOM)
of_any_axes = pytest.mark.parametrize("modality", ALL, ids=lambda modality: modality.name)


@st.composite
def open_or_closed_axes(draw):
    """An axis that is a component of a position, divided in any way."""
    if draw(st.booleans()):
        return Axis("position", boundaries=sorted(draw(st.sets(st.floats(-2, 2), min_size=2, max_size=6))))
    low = draw(st.floats(-2, 2))
    return Axis("position", "component", 0, low, low + draw(st.floats(0.01, 3)), closed=draw(st.booleans()),
                intervals=draw(st.none() | st.integers(1, 7)))


def encoded_by_numpy(nres_map, points):
    """The active cell of each point (n, axes), computed axis by axis."""
    cells, stride = np.zeros(len(points), int), 1
    for axis, values in zip(nres_map.modality.axes, np.transpose(points)):
        n = axis.intervals or nres_map.resolution
        if axis.boundaries:
            interval = np.searchsorted(axis.boundaries[1:-1], values, side="right")
        elif axis.is_direction:
            interval = np.floor(values / TAU % 1.0 * n + 0.5) % n
        elif axis.closed:
            interval = np.floor((values - axis.low) % (axis.high - axis.low) / (axis.high - axis.low) * n)
        else:
            interval = np.floor((values - axis.low) / (axis.high - axis.low) * n)
        cells += stride * np.clip(interval, 0, n - 1).astype(int)
        stride *= n
    return cells


def interval(nres_map, cell, axis):
    return cell // math.prod(nres_map.intervals[:axis]) % nres_map.intervals[axis]


def near_a_boundary(nres_map, axis, value):
    """Whether rounding decides which of two intervals holds a coordinate."""
    axis = nres_map.modality.axes[axis]
    if axis.boundaries:
        return False  # a comparison, without rounding
    length, low = (TAU, 0.0) if axis.is_direction else (axis.high - axis.low, axis.low)
    away = (value - low) / length * (axis.intervals or nres_map.resolution) + (0.5 if axis.is_direction else 0.0)
    return abs(away - round(away)) < 1e-7


@of_any_axes
@given(st.integers(1, 9), st.lists(near_and_far, min_size=4, max_size=4))
def test_cells_equal_numpy(modality, resolution, point):
    nres_map, point = NresMap(resolution, modality), point[: len(modality.axes)]
    assume(not any(near_a_boundary(nres_map, axis, value) for axis, value in enumerate(point)))
    cell = nres_map.encode(point)
    assert cell.shape == () and 0 <= cell < nres_map.cells == math.prod(nres_map.intervals)
    assert [int(cell)] == encoded_by_numpy(nres_map, [point]).tolist()


@given(st.lists(open_or_closed_axes(), min_size=1, max_size=4), st.integers(1, 9), st.data())
def test_any_cut_of_any_number_of_axes_equals_numpy(axes, resolution, data):
    nres_map = NresMap(resolution, Modality("X", axes))
    point = [data.draw(near_and_far | st.sampled_from(axis.boundaries or (axis.low,))) for axis in axes]
    for i, axis in enumerate(axes):
        near = near_a_boundary(nres_map, i, point[i])
        assume(not near or axis.low == point[i])  # the lower end itself is exact
    assert [int(nres_map.encode(point))] == encoded_by_numpy(nres_map, [point]).tolist()


@of_any_axes
def test_every_cell_is_active_somewhere(modality):
    nres_map = NresMap(3, modality)
    middles = [middles_of(axis, n) for axis, n in zip(modality.axes, nres_map.intervals)]
    points = np.stack(np.meshgrid(*middles, indexing="ij"), axis=-1)
    assert nres_map.encode(points).ravel("F").tolist() == list(range(nres_map.cells))


def middles_of(axis, n):
    if axis.is_direction:
        return np.arange(n) / n * TAU
    ends = np.array(axis.boundaries or np.linspace(axis.low, axis.high, n + 1))
    return (ends[1:] + ends[:-1]) / 2


def test_unequal_intervals_hold_their_lower_end_and_all_that_is_beyond():
    near = NresMap(9, Modality("X", [Axis("position", boundaries=(0.0, 0.1, 0.15, 0.6))]))
    points = [-5.0, 0.0, 0.0999, 0.1, 0.1499, 0.15, 0.6, 1e300]
    assert near.encode(np.array(points)[:, None]).tolist() == [0, 0, 0, 1, 1, 2, 2, 2]


def test_an_axis_that_is_closed_goes_round():
    ring = NresMap(4, RING)
    along = np.array([0.25, 0.374, 0.375, 0.749, 0.75, 0.875, -0.25, 7.25 + 1e-9, 0.2499])
    points = np.stack([along, np.zeros_like(along)], axis=-1)
    assert ring.encode(points).tolist() == [0, 0, 1, 3, 0, 1, 0, 0, 3]
    assert ring.encode([[0.3, -0.1], [0.3, 1.1]]).tolist() == [12, 0]


@pytest.mark.parametrize("modality", [each for each in ALL if each != ROOM], ids=lambda modality: modality.name)
def test_the_cells_of_a_run_are_those_of_the_public_encoding(modality):
    run = Run(Agent((Node("X", modality, (2, 3)),)), WaterWorld(), seed=1)
    for _ in range(5):
        run.advance(150)
        coordinates = sense(modality, run.world_state.scene, run.world.size)
        expected = [nres_map.encode(coordinates).tolist() for nres_map in run.agent.maps]
        cells = run.memory.tracks.cell
        assert [cells[nres.first_track : nres.end_track].tolist() for nres in run.state.maps] == expected


def test_an_element_has_a_place_along_the_axes_of_what_is_followed_and_is_everywhere_along_others():
    """A place is desired in all five directions, so the values of five goals add up."""
    modality = Modality("X", PLACE_CELL.axes + (Axis("velocity", "direction", intervals=5),))
    run = Run(Agent((Node("X", modality, [3]),), (Desire(Place(0.5, 0.1), "X", 2.0),)), WaterWorld(), seed=0)
    values = run._memory.q
    values[:] = np.random.default_rng(0).random(values.size)
    before = int(run.memory.tracks.cell[0])
    run.advance(1)
    goals = 1 + 9 * np.arange(5)
    np.testing.assert_allclose(run.state.action_value, 2.0 * run.q()[before][:, goals].sum(axis=1), rtol=1e-5)


@pytest.mark.parametrize("modality", MODALITIES, ids=lambda modality: modality.name)
def test_a_boundary_belongs_to_the_cell_after_it_and_the_rim_to_the_last(modality):
    nres_map, point = NresMap(4, modality), np.zeros(len(modality.axes))
    for axis, (low, high) in enumerate((each.low, each.high) for each in modality.axes if not each.is_direction):
        point[axis] = high
        assert interval(nres_map, int(nres_map.encode(point)), axis) == 3
        for k in range(4):
            point[axis] = low + k * (high - low) / 4
            assert interval(nres_map, int(nres_map.encode(point)), axis) == k
            point[axis] -= 1e-12
            assert interval(nres_map, int(nres_map.encode(point)), axis) == max(k - 1, 0)


def test_a_point_beyond_the_range_belongs_to_the_cell_at_its_end():
    middle = NresMap(3, Modality("place cell", cartesian("position", (0.25, 0.75), (0.25, 0.75))))
    points = [[0.1, 0.1], [0.9, 0.1], [0.5, 0.5], [7.0, -7.0], [1e300, -1e300], [0.25, 0.75], [0.5, 0.76]]
    assert middle.encode(points).tolist() == [0, 2, 4, 2, 2, 6, 7]


@closed
@pytest.mark.parametrize("n", [1, 2, 3, 7, 30])
def test_the_first_sector_lies_on_both_sides_of_east(modality, n):
    for direction in (0.0, -0.0, 1e-300, -1e-300, np.nextafter(TAU, 0), TAU, 0.49 / n * TAU, -0.49 / n * TAU):
        assert NresMap(n, modality).encode([0.0, direction][-len(modality.axes):]) == 0


def test_the_sectors_of_n4_are_centred_on_east_south_west_and_north():
    compass = [[1, 0], [0, 1], [-1, 0], [0, -1]]
    heading, radar = NresMap(4, HEAD_DIRECTION_CELL), NresMap(4, OBJECT_VECTOR_CELL)
    assert heading.encode(tune(HEAD_DIRECTION_CELL, compass)).tolist() == [0, 1, 2, 3]
    assert radar.encode(tune(OBJECT_VECTOR_CELL, 0.3 * np.array(compass))).tolist() == [1, 5, 9, 13]
    assert heading.encode([[TAU / 8 - 1e-12], [TAU / 8], [TAU * 7 / 8 - 1e-12], [TAU * 7 / 8 + 1e-12]]).tolist() == [
        0, 1, 3, 0]


@pytest.mark.parametrize("modality, points, message", [
    (PLACE_CELL, [np.nan, 0.5], r"points must be finite numbers from -1.79769e\+308 to 1.79769e\+308, but is array\("),
    (PLACE_CELL, [[0.5, 0.5], [np.nan, 0.5], [0.1, np.inf]],
     r"(?s)points must be finite .*; 2 of its 3 rows are not, the first of them points\[1\], \[nan, 0.5\]"),
    (PLACE_CELL, np.full((1_000, 4, 2), -np.inf), r"(?s); 4,000 of its 4,000 rows .* points\[0, 0\], \[-inf, -inf\]"),
    (PLACE_CELL, [[0.5, 0.5], [0.5, pandas.NA]],
     r"points must be numbers, in .*; 1 of its 2 rows are not, the first of them points\[1\], \[0.5, <NA>\]"),
    (SPEED_CELL, [None, 0.5], r"points must be .*; 1 of its 2 numbers are not, the first of them points\[0\], None"),
    (PLACE_CELL, [[0.5, 0.5], [0.5]], r"points must be numbers, in lists of equal lengths, but is .*0.5\]\]$"),
    (PLACE_CELL, [0.1, 0.2, 0.3], r"points must have the shape \(…, 2\), for x, y, but has \(3,\)"),
    (SPEED_CELL, 0.5, r"points must have the shape \(…, 1\), for speed, but has \(\)")])
def test_points_of_another_space_are_refused(modality, points, message):
    with pytest.raises(ValueError, match=message):
        NresMap(3, modality).encode(points)


def test_the_shape_of_points_is_kept():
    assert NresMap(3).encode(np.zeros((2, 5, 2))).shape == (2, 5)
    assert NresMap(3, SPEED_CELL).encode(np.zeros((0, 1))).shape == (0,)
