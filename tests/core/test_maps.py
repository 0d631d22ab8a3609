"""NRES maps: one active cell for any point of any modality, also at the edges."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from neorl import Agent, Modality, Node, NresMap, Run, WaterWorld
from neorl.core.modality import (BOUNDARY_VECTOR_CELL, CARTESIAN_OBJECT_VECTOR_CELL, HEAD_DIRECTION_CELL, MODALITIES,
                                 OBJECT_VECTOR_CELL, PLACE_CELL, SPEED_CELL, TAU)

maps = st.builds(NresMap, st.integers(1, 30), st.sampled_from(MODALITIES))
of_any_modality = pytest.mark.parametrize("modality", MODALITIES, ids=lambda modality: modality.name)
closed = pytest.mark.parametrize("modality", [each for each in MODALITIES if each.has_direction],
                                 ids=lambda modality: modality.name)
near_and_far = st.floats(-3, 3) | st.floats(-1e6, 1e6)


def interval(nres_map, cell, axis):
    return cell // nres_map.resolution**axis % nres_map.resolution


@given(maps, st.tuples(near_and_far, near_and_far))
def test_the_active_cell_is_the_one_whose_intervals_hold_the_point(nres_map, point):
    n, modality = nres_map.resolution, nres_map.modality
    cell = nres_map.encode(point[: len(modality.axes)])
    assert cell.shape == () and cell.dtype == np.int64 and 0 <= cell < nres_map.cells
    for axis, value in enumerate(point[: len(modality.axes)]):
        k = interval(nres_map, int(cell), axis)
        if axis < len(modality.ranges):
            low, high = modality.ranges[axis]
            assert k - 1e-9 <= (np.clip(value, low, high) - low) / (high - low) * n <= k + 1 + 1e-9
        else:
            away = value / TAU * n - k
            assert abs(away - n * round(away / n)) <= 0.5 + 1e-7


@given(maps)
def test_every_cell_is_active_somewhere(nres_map):
    n, modality = nres_map.resolution, nres_map.modality
    centres = [low + (np.arange(n) + 0.5) / n * (high - low) for low, high in modality.ranges]
    centres += [np.arange(n) / n * TAU] * modality.has_direction
    points = np.stack(np.meshgrid(*centres), axis=-1)
    assert nres_map.cells == n ** len(modality.axes)
    assert nres_map.encode(points).ravel().tolist() == list(range(nres_map.cells))
    assert np.all(nres_map.covers(points))


@pytest.mark.parametrize("modality, end", [(HEAD_DIRECTION_CELL, TAU), (SPEED_CELL, 2.0)])
def test_a_map_of_one_axis_has_n_cells(modality, end):
    points = np.arange(7)[:, None] / 7 * end + 0.01
    assert NresMap(7, modality).cells == 7
    assert NresMap(7, modality).encode(points).tolist() == list(range(7))


@of_any_modality
def test_a_boundary_belongs_to_the_cell_after_it_and_the_rim_to_the_last(modality):
    nres_map, point = NresMap(4, modality), np.zeros(len(modality.axes))
    for axis, (low, high) in enumerate(modality.ranges):
        point[axis] = high
        assert interval(nres_map, int(nres_map.encode(point)), axis) == 3
        for k in range(4):
            point[axis] = low + k * (high - low) / 4
            assert interval(nres_map, int(nres_map.encode(point)), axis) == k
            point[axis] -= 1e-12
            assert interval(nres_map, int(nres_map.encode(point)), axis) == max(k - 1, 0)


def test_cells_are_counted_along_the_first_axis_first():
    points = [[0.25, 0.0], [0.5, 0.75], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]]
    assert NresMap(4).encode(points).tolist() == [1, 14, 15, 3, 12]
    assert NresMap(4) == NresMap(4, PLACE_CELL)


def test_a_point_beyond_the_range_belongs_to_the_cell_at_its_end_and_is_not_covered():
    middle = NresMap(3, Modality("place cell", "position", "cartesian", ((0.25, 0.75), (0.25, 0.75))))
    points = [[0.1, 0.1], [0.9, 0.1], [0.5, 0.5], [7.0, -7.0], [1e300, -1e300], [0.25, 0.75], [0.5, 0.76]]
    assert middle.encode(points).tolist() == [0, 2, 4, 2, 2, 6, 7]
    assert middle.covers(points).tolist() == [False, False, True, False, False, True, False]


def test_a_direction_is_covered_whatever_it_is():
    assert NresMap(3, HEAD_DIRECTION_CELL).covers([[0.0], [-9.0], [1e9]]).all()
    assert NresMap(3, OBJECT_VECTOR_CELL).covers([[1.0, -9.0], [1.01, 0.0], [0.0, 1e9]]).tolist() == [True, False, True]


@closed
@given(st.integers(1, 30), st.integers(0, 29), st.floats(-0.499, 0.499))
def test_a_direction_closes_on_itself(modality, n, sector, off_centre):
    nres_map = NresMap(n, modality)
    direction = (sector % n + off_centre) / n * TAU
    for turned in (direction - TAU, direction, direction + TAU, direction + 6 * TAU):
        cell = int(nres_map.encode([0.0, turned][-len(modality.axes):]))
        assert interval(nres_map, cell, len(modality.axes) - 1) == sector % n


@closed
@pytest.mark.parametrize("n", [1, 2, 3, 7, 30])
def test_the_first_sector_lies_on_both_sides_of_east(modality, n):
    for direction in (0.0, -0.0, 1e-300, -1e-300, np.nextafter(TAU, 0), TAU, 0.49 / n * TAU, -0.49 / n * TAU):
        assert NresMap(n, modality).encode([0.0, direction][-len(modality.axes):]) == 0


def test_the_sectors_of_n4_are_centred_on_east_south_west_and_north():
    compass = [[1, 0], [0, 1], [-1, 0], [0, -1]]
    heading, radar = NresMap(4, HEAD_DIRECTION_CELL), NresMap(4, OBJECT_VECTOR_CELL)
    assert heading.encode(HEAD_DIRECTION_CELL.tune(compass)).tolist() == [0, 1, 2, 3]
    assert radar.encode(OBJECT_VECTOR_CELL.tune(0.3 * np.array(compass))).tolist() == [1, 5, 9, 13]
    assert heading.encode([[TAU / 8 - 1e-12], [TAU / 8], [TAU * 7 / 8 - 1e-12], [TAU * 7 / 8 + 1e-12]]).tolist() == [
        0, 1, 3, 0]


@of_any_modality
def test_the_cells_of_a_run_are_those_of_the_public_encoding(modality):
    world = WaterWorld()
    agent = Agent((Node("X", modality, (2, 5)),))
    run = Run(agent, world, seed=1)
    run.advance(777)
    expected = [nres_map.encode(modality.coordinates(world, run.world_state)).tolist() for nres_map in agent.maps]
    first = run.parameters.maps.first_track
    assert [run.state.tracks.cell[first[m] : first[m + 1]].tolist() for m in range(2)] == expected


@pytest.mark.parametrize("arguments, message", [
    ((0,), "resolution is 0, allowed are integers ≥ 1"), ((2.5,), "resolution is 2.5"), ((True,), "resolution is True"),
    ((3, (0.0, 1.0)), r"modality is \(0.0, 1.0\), allowed is a Modality"),
])
def test_a_bad_map_is_refused(arguments, message):
    with pytest.raises(ValueError, match=message):
        NresMap(*arguments)


@pytest.mark.parametrize("modality, points, message", [
    (PLACE_CELL, [np.nan, 0.5], "points is .*nan.*, allowed are finite numbers"),
    (BOUNDARY_VECTOR_CELL, [0.5, np.inf], "points is .*inf.*, allowed are finite numbers"),
    (HEAD_DIRECTION_CELL, [[-np.inf]], "points is .*, allowed are finite numbers"),
    (PLACE_CELL, [0.1, 0.2, 0.3], r"points has the shape \(3,\), allowed are \(…, 2\): x, y"),
    (CARTESIAN_OBJECT_VECTOR_CELL, [[0.1], [0.2]], r"points has the shape \(2, 1\)"),
    (SPEED_CELL, 0.5, r"points has the shape \(\), allowed are \(…, 1\): speed"),
    (HEAD_DIRECTION_CELL, [0.5, 0.5], r"points has the shape \(2,\)"),
])
def test_points_of_another_space_are_refused(modality, points, message):
    with pytest.raises(ValueError, match=message):
        NresMap(3, modality).encode(points)
    with pytest.raises(ValueError, match=message):
        NresMap(3, modality).covers(points)


def test_the_shape_of_points_is_kept():
    assert NresMap(3).encode(np.zeros((2, 5, 2))).shape == (2, 5)
    assert NresMap(3, SPEED_CELL).encode(np.zeros((0, 1))).shape == (0,)
