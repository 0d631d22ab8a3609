"""The coordinates that modalities compute from vectors and states, against NumPy and numbers worked out by hand."""

import hashlib
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from neorl import NresMap, Scene, WaterWorld, kernel
from neorl.custom import Axis, Modality
from neorl.core.coordinates import sense, tune
from neorl.core.direction import CIRCLE_TERMS, TAU, circle, heading, turn
from neorl.core.modality import (BORDER_CELL, BOUNDARY_VECTOR_CELL, CARTESIAN_OBJECT_VECTOR_CELL, HEAD_DIRECTION_CELL,
                                 LANDMARK_VECTOR_CELL, OBJECT_VECTOR_CELL, PLACE_CELL, SPEED_CELL, cartesian, polar)
from neorl.kernels.execution import execute
from neorl.kernels.kernel import function_of

EAST, SOUTH, WEST, NORTH = 0.0, 0.5 * math.pi, math.pi, 1.5 * math.pi
WORLD = WaterWorld(width=200, n_creeps=2)
components = st.floats(-10, 10)
finite = st.floats(allow_nan=False, allow_infinity=False)
reaches = st.floats(0, 0.5, exclude_min=True)


def turns_apart(a, b):
    return abs((a - b + 0.5) % 1.0 - 0.5)


@given(finite, finite)
def test_any_finite_vector_has_a_turn_from_0_to_1(x, y):
    assert 0 <= execute(turn, x, y) < 1
    assert turns_apart(execute(turn, x, y), np.arctan2(y, x) / TAU if x or y else 0.0) < 1e-15


@pytest.mark.parametrize("length", [5e-324, 0.3, 1.0, 1.7e308])
@pytest.mark.parametrize("zero", [0.0, -0.0])
def test_the_axes_are_exact_quarters_of_a_turn(length, zero):
    axes = [(length, zero), (zero, length), (-length, zero), (zero, -length)]
    assert [execute(turn, *vector) for vector in axes] == [0, 0.25, 0.5, 0.75]
    assert execute(turn, zero, zero) == execute(turn, -zero, zero) == execute(turn, 1.0, -1e-300) == 0


def headings(turns):
    return np.array([execute(heading, each) for each in turns])


def test_a_heading_equals_cosine_and_sine_of_numpy_and_has_the_length_1():
    turns = np.random.default_rng(0).uniform(-2, 2, 20_000)
    x, y = headings(turns).T
    np.testing.assert_allclose([x, y], [np.cos(TAU * turns), np.sin(TAU * turns)], rtol=0, atol=2e-15)
    np.testing.assert_allclose(x * x + y * y, 1, rtol=0, atol=1e-15)


@given(finite)
def test_any_number_has_a_heading_whose_turn_it_is(turns):
    x, y = execute(heading, turns)
    assert turns_apart(execute(turn, x, y), np.float64(turns) % 1.0) < 1e-15


def test_the_headings_of_quarters_are_the_axes():
    axes = [(1, 0), (0, 1), (-1, 0), (0, -1)]
    assert [execute(heading, quarter / 4) for quarter in range(-8, 8)] == axes * 4


def test_a_heading_has_the_same_bits_everywhere():
    """Compiled, as Python, and as printed when it was written: no function of a library takes part."""
    turns = np.random.default_rng(1).uniform(-1, 2, 2_000)
    bits = headings(turns).tobytes()
    assert bits == np.array([function_of(circle)(each, CIRCLE_TERMS) for each in turns]).tobytes()
    assert hashlib.sha256(bits).hexdigest()[:16] == "4c82b3f8093d2731"


@given(components, components, reaches, reaches)
def test_each_feature_equals_numpy(x, y, reach_x, reach_y):
    vector, reach = np.array([x, y]), np.array([reach_x, reach_y])
    margin = np.minimum(vector - reach, 0) + np.maximum(vector - (1 - reach), 0)
    margins = [Axis("position", "margin", along, -1, reach[along]) for along in (0, 1)]
    assert tune(Modality("margins", margins), vector) == pytest.approx(margin, rel=1e-14, abs=1e-150)
    length, direction = np.hypot(x, y), np.arctan2(y, x) / TAU % 1.0 if x or y else 0.0
    for of in ("position", "velocity", "objects", "boundaries"):
        components = Modality("components", cartesian(of, (-1, 1), (-1, 1)))
        assert tune(components, vector).tolist() == [x, y]
        got_length, got_direction = tune(Modality("radar", polar(of, 1)), vector)
        assert got_length == pytest.approx(length, rel=1e-14, abs=1e-150)
        assert turns_apart(got_direction / TAU, direction) < 1e-14


def scene_of(agent, velocity, creeps):
    state = WORLD.reset(0)
    state.scene.position[:], state.scene.velocity[:], state.scene.things[:] = agent, velocity, creeps
    return state.scene


# The agent is at (0.1, 0.95), creeps at (0.4, 0.55) and at the agent's place, the default landmark in the middle.
@pytest.mark.parametrize("modality, expected", [
    (PLACE_CELL, [(0.1, 0.95)]),
    (BORDER_CELL, [(-0.15, 0.2)]),
    (OBJECT_VECTOR_CELL, [(0.5, TAU - math.atan2(4, 3)), (0.0, EAST)]),
    (CARTESIAN_OBJECT_VECTOR_CELL, [(0.3, -0.4), (0.0, 0.0)]),
    (BOUNDARY_VECTOR_CELL, [(0.1, WEST), (0.95, NORTH), (0.9, EAST), (0.05, SOUTH)]),
    (LANDMARK_VECTOR_CELL, [(math.hypot(0.4, 0.45), TAU - math.atan2(45, 40))]),
    (HEAD_DIRECTION_CELL, [(math.pi - math.atan2(4, 3),)]),
    (SPEED_CELL, [(0.25,)]),
    (Modality("landmarks", cartesian("landmarks", (-1, 1), (-1, 1)), ((1, 0), (0.1, 0.95))),
     [(0.9, -0.95), (0.0, 0.0)]),
    (Modality("walls", cartesian("boundaries", (-1, 1), (-1, 1))), [(-0.1, 0), (0, -0.95), (0.9, 0), (0, 0.05)]),
    (Modality("velocity", cartesian("velocity", (-1, 1), (-1, 1))), [(-0.15, 0.2)]),
    (Modality("velocity", polar("velocity", 1)), [(0.25, math.pi - math.atan2(4, 3))]),
    (Modality("place × head direction", PLACE_CELL.axes + HEAD_DIRECTION_CELL.axes),
     [(0.1, 0.95, math.pi - math.atan2(4, 3))]),
    (Modality("object vector × velocity", OBJECT_VECTOR_CELL.axes + cartesian("velocity", (-1, 1), (-1, 1))),
     [(0.5, TAU - math.atan2(4, 3), -0.15, 0.2), (0.0, EAST, -0.15, 0.2)]),
    (Modality("object vector × place", CARTESIAN_OBJECT_VECTOR_CELL.axes + PLACE_CELL.axes[1:]),
     [(0.3, -0.4, 0.95), (0.0, 0.0, 0.95)]),
])
def test_coordinates_are_those_worked_out_by_hand(modality, expected):
    coordinates = sense(modality, scene_of((20, 190), (-30, 40), [(80, 110), (20, 190)]), WORLD.size)
    assert coordinates.dtype == float and coordinates.shape == (len(expected), len(modality.axes))
    np.testing.assert_allclose(coordinates, expected, atol=1e-12)


@kernel
def of_my_own(scene, point):
    return scene.position[0]


def test_a_subclass_of_axis_which_would_have_no_effect_is_refused():
    with pytest.raises(TypeError, match="Mine cannot be a subclass of Axis"):
        class Mine(Axis):
            pass


@pytest.mark.parametrize("axes, follows", [
    (PLACE_CELL.axes + HEAD_DIRECTION_CELL.axes, "position"), (polar("objects", 1) + PLACE_CELL.axes, "objects"),
    (polar("boundaries", 1) + SPEED_CELL.axes, "boundaries"), (SPEED_CELL.axes, "velocity"),
    ([Axis(of_my_own)], "position"), ([*HEAD_DIRECTION_CELL.axes, Axis(of_my_own)], "velocity"),
])
def test_a_conjunctive_cell_follows_things_before_places_and_places_before_velocities(axes, follows):
    assert Modality("X", axes).follows == follows


@pytest.mark.parametrize("position", [(0.5,), (0.5, 0.25, 0.75)])
def test_coordinates_in_worlds_of_any_number_of_axes(position):
    n, things = len(position), np.array([[1.0] * len(position), [0.0] * len(position)])
    scene = Scene(np.array(position), np.array([0.1] * n), things, np.array([0, 0]), np.array([0, 0]))
    along = [Axis("position", along=each) for each in range(n)]
    np.testing.assert_array_equal(sense(Modality("place", along), scene, 1.0), [position])
    objects = [Axis("objects", along=each, low=-1) for each in range(n)]
    np.testing.assert_array_equal(sense(Modality("objects", objects), scene, 1.0), things - position)
    walls = sense(Modality("walls", [Axis("boundaries", "length")]), scene, 1.0)[:, 0]
    np.testing.assert_allclose(walls, [*position, *1 - np.array(position)])
    speed = Modality("speed", [Axis("velocity", "length")])
    np.testing.assert_allclose(sense(speed, scene, 1.0), [[0.1 * np.sqrt(n)]])
    np.testing.assert_allclose(tune(speed, scene.velocity), [0.1 * np.sqrt(n)])


def test_a_direction_is_in_the_plane_of_the_first_two_axes():
    assert tune(HEAD_DIRECTION_CELL, [0.0, 1.0, 7.0]) == pytest.approx([SOUTH])
    assert tune(HEAD_DIRECTION_CELL, [0.0, 1e-300]) == pytest.approx([SOUTH])


def test_vectors_of_any_shape_are_tuned_and_those_that_do_not_fit_are_refused():
    assert tune(OBJECT_VECTOR_CELL, np.zeros((3, 4, 2))).shape == (3, 4, 2)
    assert tune(SPEED_CELL, [3, 4]).tolist() == [5.0]
    assert tune(HEAD_DIRECTION_CELL, np.zeros((0, 2))).shape == (0, 1)
    several = Modality("X'", PLACE_CELL.axes + HEAD_DIRECTION_CELL.axes)
    for modality, vectors, message in [
            (OBJECT_VECTOR_CELL, [np.nan, 0.0], r"vectors must be finite numbers from -1e\+30 to 1e\+30, but is "),
            (HEAD_DIRECTION_CELL, [0.1], r"vectors must have the shape \(…, 2\) or more, of 8 axes at most, but has "),
            (several, [0.1, 0.2], "vectors must be of one kind, but X's have axes of several")]:
        with pytest.raises(ValueError, match=message):
            tune(modality, vectors)


def test_coordinates_along_unequal_intervals_are_coordinates_which_a_map_encodes():
    modality = Modality("uneven", [Axis("position", boundaries=(0, 0.2, 0.5, 1))])
    assert tune(modality, [[0.3, 0.0], [0.1, 0.0], [0.9, 0.0]]).tolist() == [[0.3], [0.1], [0.9]]
    assert NresMap(3, modality).encode(tune(modality, [[0.3, 0.0], [0.1, 0.0], [0.9, 0.0]])).tolist() == [1, 0, 2]
    assert sense(modality, Scene((0.3, 0.7)), 1.0).tolist() == [[0.3]]
