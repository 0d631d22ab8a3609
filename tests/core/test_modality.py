"""Modalities: what they make of a vector and of a state, against NumPy and numbers worked out by hand."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from neorl import Modality, WaterWorld
from neorl.core.choices import Tuning
from neorl.core.geometry import TAU, into_margin, tuned, turn
from neorl.core.kernel import execute
from neorl.core.modality import (BORDER_CELL, BOUNDARY_VECTOR_CELL, CARTESIAN_OBJECT_VECTOR_CELL, HEAD_DIRECTION_CELL,
                                 LANDMARK_VECTOR_CELL, MODALITIES, OBJECT_VECTOR_CELL, PLACE_CELL, SPEED_CELL)

EAST, SOUTH, WEST, NORTH = 0.0, 0.5 * math.pi, math.pi, 1.5 * math.pi
WORLD = WaterWorld(width=200, n_creeps=2)
components = st.floats(-10, 10)
finite = st.floats(allow_nan=False, allow_infinity=False)
shares = st.floats(0, 1)
reaches = st.floats(0, 0.5, exclude_min=True)


def turns_apart(a, b):
    return abs((a - b + 0.5) % 1.0 - 0.5)


@pytest.mark.parametrize("scale", [1.0, 1e-300, 1e300])
def test_a_turn_equals_the_arctangent_of_numpy(scale):
    x, y = scale * np.random.default_rng(0).normal(size=(2, 20_000))
    turns = np.array([execute(turn, *pair) for pair in zip(x, y)])
    assert turns_apart(turns, np.arctan2(y, x) / TAU).max() < 1e-15
    assert np.all((0 <= turns) & (turns < 1))


@given(finite, finite)
def test_any_finite_vector_has_a_turn_from_0_to_1(x, y):
    assert 0 <= execute(turn, x, y) < 1
    assert turns_apart(execute(turn, x, y), np.arctan2(y, x) / TAU if x or y else 0.0) < 1e-15


@pytest.mark.parametrize("length", [5e-324, 0.3, 1.0, 1.7e308])
@pytest.mark.parametrize("zero", [0.0, -0.0])
def test_the_axes_are_exact_quarters_of_a_turn(length, zero):
    axes = [(length, zero), (zero, length), (-length, zero), (zero, -length)]
    assert [execute(turn, *vector) for vector in axes] == [0, 0.25, 0.5, 0.75]
    assert execute(turn, zero, zero) == execute(turn, -zero, zero) == 0


def test_a_turn_just_north_of_east_does_not_reach_1():
    assert execute(turn, 1.0, -1e-300) == 0
    assert execute(turn, 1.0, -1e-15) == pytest.approx(1.0)


@given(components, components, reaches, reaches)
def test_each_tuning_equals_numpy(x, y, reach_x, reach_y):
    vector, reach = np.array([x, y]), np.array([reach_x, reach_y])
    margin = np.minimum(vector - reach, 0) + np.maximum(vector - (1 - reach), 0)
    length, direction = np.hypot(x, y), np.arctan2(y, x) / TAU % 1.0 if x or y else 0.0
    expected = {"cartesian": vector, "proximal": margin, "polar": (length, direction), "angle": (length, direction),
                "length": (length, direction)}
    assert set(expected) == set(Tuning.__members__)
    for name, (u, v) in expected.items():
        got_u, got_v = execute(tuned, int(Tuning[name]), x, y, reach_x, reach_y)
        assert got_u == pytest.approx(u, rel=1e-14, abs=1e-150)
        assert (turns_apart(got_v, v) if name in ("polar", "angle", "length") else abs(got_v - v)) < 1e-14


@given(reaches, shares, shares)
def test_a_margin_reaches_from_either_wall_to_0_without_a_leap(reach, a, b):
    assert (execute(into_margin, 0.0, reach), execute(into_margin, 0.5, reach)) == (-reach, 0.0)
    assert execute(into_margin, 1.0, reach) == pytest.approx(reach)
    assert execute(into_margin, a, reach) == 0.0 or not reach <= a <= 1 - reach
    assert abs(execute(into_margin, a, reach) - execute(into_margin, b, reach)) <= abs(a - b) + 1e-15


def state_of(agent, velocity, creeps):
    state = WORLD.reset(0)
    state.agent_position, state.agent_velocity, state.creep_position = agent, velocity, creeps
    return state


# The agent is at (0.1, 0.95), creeps are at (0.4, 0.55) and where the agent is, the default landmark is in the middle.
@pytest.mark.parametrize("modality, expected", [
    (PLACE_CELL, [(0.1, 0.95)]),
    (BORDER_CELL, [(-0.15, 0.2)]),
    (OBJECT_VECTOR_CELL, [(0.5, TAU - math.atan2(4, 3)), (0.0, EAST)]),
    (CARTESIAN_OBJECT_VECTOR_CELL, [(0.3, -0.4), (0.0, 0.0)]),
    (BOUNDARY_VECTOR_CELL, [(0.1, WEST), (0.95, NORTH), (0.9, EAST), (0.05, SOUTH)]),
    (LANDMARK_VECTOR_CELL, [(math.hypot(0.4, 0.45), TAU - math.atan2(45, 40))]),
    (HEAD_DIRECTION_CELL, [(math.pi - math.atan2(4, 3),)]),
    (SPEED_CELL, [(0.25,)]),
    (Modality("landmarks", "landmarks", "cartesian", ((-1, 1), (-1, 1)), ((1, 0), (0.1, 0.95))),
     [(0.9, -0.95), (0.0, 0.0)]),
    (Modality("walls", "boundaries", "cartesian", ((-1, 1), (-1, 1))), [(-0.1, 0), (0, -0.95), (0.9, 0), (0, 0.05)]),
    (Modality("velocity", "velocity", "cartesian", ((-1, 1), (-1, 1))), [(-0.15, 0.2)]),
    (Modality("velocity", "velocity", "polar", ((0, 1),)), [(0.25, math.pi - math.atan2(4, 3))]),
])
def test_coordinates_are_those_worked_out_by_hand(modality, expected):
    coordinates = modality.coordinates(WORLD, state_of((20, 190), (-30, 40), [(80, 110), (20, 190)]))
    assert coordinates.dtype == float and coordinates.shape == (len(expected), len(modality.axes))
    np.testing.assert_allclose(coordinates, expected, atol=1e-12)


def test_an_agent_at_rest_heads_east_at_speed_0():
    state = state_of((100, 100), (0.0, -0.0), [(0, 0), (200, 200)])
    assert HEAD_DIRECTION_CELL.coordinates(WORLD, state).tolist() == [[EAST]]
    assert SPEED_CELL.coordinates(WORLD, state).tolist() == [[0.0]]


@pytest.mark.parametrize("corner", [(0, 0), (200, 0), (0, 200), (200, 200)])
def test_an_agent_in_a_corner_touches_two_walls(corner):
    state = state_of(corner, (0, 0), [(0, 0), (200, 200)])
    np.testing.assert_array_equal(BORDER_CELL.coordinates(WORLD, state), [np.where(corner, 0.25, -0.25)])
    assert BOUNDARY_VECTOR_CELL.coordinates(WORLD, state)[:, 0].tolist() == [*np.divide(corner, 200),
                                                                             *1 - np.divide(corner, 200)]


ALLOCENTRIC, SEEN = "allocentric", "centred on the agent, allocentric direction"
PLANE, RADAR = ("x", "y"), ("distance", "direction")


@pytest.mark.parametrize("modality, name, frame, axes, takes_places", [  # thesis table 2.1; speed from paper B, table 1
    (PLACE_CELL, "place cell", ALLOCENTRIC, PLANE, True),
    (BORDER_CELL, "border cell", ALLOCENTRIC, PLANE, True),
    (OBJECT_VECTOR_CELL, "object-vector cell", SEEN, RADAR, True),
    (CARTESIAN_OBJECT_VECTOR_CELL, "object-vector cell, Cartesian", SEEN, PLANE, True),
    (BOUNDARY_VECTOR_CELL, "boundary-vector cell", SEEN, RADAR, True),
    (LANDMARK_VECTOR_CELL, "landmark-vector cell", SEEN, RADAR, True),
    (HEAD_DIRECTION_CELL, "head-direction cell", "allocentric direction", ("direction",), True),
    (SPEED_CELL, "speed cell", "–", ("speed",), False),
])
def test_the_modalities_are_those_of_the_tables(modality, name, frame, axes, takes_places):
    assert modality in MODALITIES
    assert (modality.name, modality.axes, modality.takes_places) == (name, axes, takes_places)
    assert modality.has_direction == (axes[-1] == "direction")
    assert modality.frame == frame


def test_a_modality_is_a_value():
    again = Modality("place cell", "position", "cartesian", [[0, 1], np.array([0.0, 1.0])])
    assert again == PLACE_CELL and hash(again) == hash(PLACE_CELL)
    assert len(set(MODALITIES)) == 8


UNIT = (0, 1)


@pytest.mark.parametrize("arguments, message", [
    (("smell", "cartesian", (UNIT, UNIT)), "vector is 'smell', allowed are 'position', 'velocity', 'objects', 'bound"),
    (("position", "polar", (UNIT,)), "tuning is 'polar', allowed are 'cartesian', 'proximal'$"),
    (("velocity", "proximal", (UNIT, UNIT)), "tuning is 'proximal', allowed are 'cartesian', 'polar', 'angle', 'l"),
    (("objects", "angle", ()), "tuning is 'angle', allowed are 'cartesian', 'polar'$"),
    (("position", "cartesian", (UNIT,)), r"ranges is \(\(0, 1\),\), allowed are 2 pairs of numbers$"),
    (("objects", "polar", (UNIT, UNIT)), r"ranges is \(\(0, 1\), \(0, 1\)\), allowed are 1 pairs"),
    (("velocity", "angle", (UNIT,)), "ranges is .*, allowed are 0 pairs"),
    (("velocity", "length", ()), r"ranges is \(\), allowed are 1 pairs"),
    (("velocity", "length", UNIT), "ranges is 0, allowed are lists and tuples"),
    (("velocity", "length", ((0, 1, 2),)), "ranges is .*, allowed are 1 pairs"),
    (("velocity", "length", ((0, np.nan),)), "ranges is nan, allowed are finite numbers"),
    (("velocity", "length", ((0, np.inf),)), "ranges is inf, allowed are finite numbers"),
    (("velocity", "length", ((1, 1),)), "ranges is .*, allowed are pairs with the lower number first"),
    (("position", "cartesian", (UNIT, (1, 0))), "ranges is .*, allowed are pairs with the lower number first"),
    (("velocity", "length", (("0", 1),)), "ranges is '0', allowed are finite numbers"),
    (("position", "proximal", ((-1, 0.6), (-1, 0.5))), "ranges is .*, allowed are margins up to half a board width"),
    (("position", "proximal", ((-1, 0.5), (-1, 0))), "ranges is .*, allowed are margins up to half a board width"),
    (("landmarks", "polar", (UNIT,)), r"landmarks is \(\), allowed are 1 or more pairs"),
    (("landmarks", "polar", (UNIT,), ((0.5, np.nan),)), "landmarks is nan, allowed are finite numbers"),
    (("landmarks", "polar", (UNIT,), (0.5, 0.5)), "landmarks is 0.5, allowed are lists and tuples"),
    (("objects", "polar", (UNIT,), ((0.5, 0.5),)), r"landmarks is \(\(0.5, 0.5\),\), allowed are 0 pairs"),
])
def test_a_bad_modality_is_refused(arguments, message):
    with pytest.raises(ValueError, match=message):
        Modality("my cell", *arguments)


def test_a_name_is_text():
    with pytest.raises(ValueError, match="name is 5, allowed is a str"):
        Modality(5, "velocity", "angle")


def test_vectors_of_any_shape_are_tuned_and_those_that_are_not_finite_are_refused():
    assert OBJECT_VECTOR_CELL.tune(np.zeros((3, 4, 2))).shape == (3, 4, 2)
    assert SPEED_CELL.tune([3, 4]).tolist() == [5.0]
    assert HEAD_DIRECTION_CELL.tune(np.zeros((0, 2))).shape == (0, 1)
    for vector in ([np.nan, 0.0], [[0.0, -np.inf]]):
        with pytest.raises(ValueError, match="vectors is .*, allowed are finite numbers"):
            OBJECT_VECTOR_CELL.tune(vector)
    with pytest.raises(ValueError, match="vectors has the shape"):
        OBJECT_VECTOR_CELL.tune([0.1, 0.2, 0.3])
