"""No motion passes a wall, however thin, and axes measure the distance to walls."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from neorl import Scene
from neorl.custom import Axis, Modality, execute
from neorl.worlds import Arena, walls
from neorl.core.coordinates import sense
from neorl.kernels.kernel import function_of

UNIT = st.floats(0, 1)
THIN = st.sampled_from([1e-12, 1e-6, 1e-3, 0.05])
WALLS = st.lists(st.tuples(UNIT, UNIT, st.floats(1e-9, 1), st.floats(1e-9, 1)).map(
    lambda each: (each[0], each[1], each[0] + each[2], each[1] + each[3])), min_size=1, max_size=4)
BOX = ((-0.1, -0.1, 0.0, 1.1), (1.0, -0.1, 1.1, 1.1), (-0.1, -0.1, 1.1, 0.0), (-0.1, 1.0, 1.1, 1.1))
MAZE = (*BOX, (0.45, -0.1, 0.46, 0.7))


@settings(max_examples=400)
@given(WALLS, st.tuples(UNIT, UNIT), st.integers(0, 1), UNIT)
def test_a_move_is_blocked_if_any_point_on_its_way_is_inside_a_wall(rectangles, position, axis, after):
    table, position = walls.table(rectangles), np.array(position)
    if function_of(walls.contain)(table, *position):
        return
    ends = sorted((position[axis], after))
    within = [value for each in rectangles for value in np.linspace(each[axis], each[axis + 2], 9)]
    on_the_way = np.concatenate([np.linspace(*ends, 50), np.clip(within, *ends)])
    points = np.repeat(position[None], len(on_the_way), axis=0)
    points[:, axis] = on_the_way
    touched = any(function_of(walls.contain)(table, *point) for point in points)
    assert function_of(walls.block)(table, position, axis, after) == touched


@settings(max_examples=150)
@given(at=st.floats(0.1, 0.7), thickness=THIN, across=st.booleans(), shape=st.sampled_from(["square", "round"]),
       motion=st.sampled_from(["inertia", "steps"]), step_length=st.floats(0.01, 1), fps=st.integers(1, 60),
       start=st.tuples(st.sampled_from([0.2, 0.4, 0.5, 0.6, 0.8]), st.sampled_from([0.5, 0.25])),
       actions=st.lists(st.tuples(st.integers(0, 3), st.integers(1, 20)), min_size=1, max_size=12))
def test_nothing_ends_beyond_a_wall(at, thickness, across, shape, motion, step_length, fps, start, actions):
    """A wall from side to side, which an agent can neither jump nor pass along the side of the arena."""
    wall = (at, 0.0, at + thickness, 1.0)
    if across:
        wall, start = (wall[1], wall[0], wall[3], wall[2]), start[::-1]
    if at <= start[across] <= at + thickness:
        return
    world = Arena(places=(), obstacles=(wall,), shape=shape, motion=motion, step_length=step_length, fps=fps,
                  start=start, trial_seconds=1e6)
    state = world.reset(0)
    axis, before = int(across), start[across] < at + thickness / 2
    for action, times in actions:
        for _ in range(times):
            execute(world.dynamics.step, state, world.rules, action)  # the checks of `World.step` would take long
            assert (state.scene.position[axis] < at + thickness / 2) == before


BORDER = Modality("border cell", [Axis(walls.distance(MAZE), high=0.3)])
WEST_AND_NORTH = Modality("boundary-vector cell", [Axis(walls.distance_along(MAZE, *push), high=0.8, name=name)
                                                   for name, push in (("west", (-2, 0)), ("north", (0, -3)))])


@settings(max_examples=60)
@given(st.tuples(UNIT, UNIT))
def test_an_axis_measures_the_distance_to_the_nearest_wall(place):
    table = np.array(MAZE)
    nearest = np.hypot(*(place - np.clip(place, table[:, :2], table[:, 2:])).T).min()
    assert sense(BORDER, Scene(place), 1.0)[0, 0] == pytest.approx(nearest, abs=1e-12)


@pytest.mark.parametrize("place, west, north", [
    ((0.3, 0.5), 0.3, 0.5), ((0.6, 0.5), 0.14, 0.5), ((0.6, 0.69), 0.14, 0.69), ((0.6, 0.7), 0.6, 0.7),
    ((0.455, 0.9), 0.455, 0.2), ((0.455, 0.3), 0.0, 0.0)])
def test_an_axis_measures_the_distance_to_the_first_wall_in_a_direction(place, west, north):
    np.testing.assert_allclose(sense(WEST_AND_NORTH, Scene(place), 1.0), [[west, north]], atol=1e-12)


def test_a_slanted_ray_meets_the_wall_where_it_should_and_an_open_side_is_infinitely_far():
    slanted = Modality("X", [Axis(walls.distance_along([(0.5, 0, 0.6, 1)], 3, 4)),
                             Axis(walls.distance_along([(0.5, 0, 0.6, 1)], -1, 0))])
    away, open_side = sense(slanted, Scene((0.2, 0.1)), 1.0)[0]
    assert away == pytest.approx(0.5) and open_side > 1e300
    assert sense(slanted, Scene((0.2, 0.7)), 1.0)[0, 0] > 1e300  # it passes below the wall
