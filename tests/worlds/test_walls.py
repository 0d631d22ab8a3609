"""No motion passes a wall, however thin, and axes measure the distance to walls."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from neorl import (CARDINAL, Agent, Arena, Axis, Desire, Dynamics, Learning, Modality, Node, Policy, Run, Scene, World,
                   array, execute, kernel, uniform, walls)
from neorl.core.kernel import function_of

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
    on_the_way = np.concatenate([np.linspace(*ends, 50), np.clip(
        [(low + high) / 2 for *_, low, high in [(0, 0, each[axis], each[axis + 2]) for each in rectangles]], *ends),
        [np.clip(value, *ends) for each in rectangles for value in np.linspace(each[axis], each[axis + 2], 9)]])
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
            step_in(world, state, action)
            assert (state.scene.position[axis] < at + thickness / 2) == before


def step_in(world, state, action):
    """A step of the kernel, without the checks of `World.step`, which would take most of the time."""
    execute(world.dynamics.step, state, world.rules, action)


class RoomState(NamedTuple):
    scene: Scene
    stream: array("uint64", 4)


class RoomRules(NamedTuple):
    push: array("float64", 5, 2)
    walls: array("float64", "walls", 4)


@kernel
def enter(state: RoomState, rules: RoomRules) -> None:
    x, y = uniform(state.stream), uniform(state.stream)
    while walls.contain(rules.walls, x, y):
        x, y = uniform(state.stream), uniform(state.stream)
    state.scene.position[0], state.scene.position[1] = x, y


@kernel
def walk(state: RoomState, rules: RoomRules, action: int):
    scene = state.scene
    for axis in range(2):
        after = scene.position[axis] + 0.06 * rules.push[action, axis]
        if not walls.block(rules.walls, scene.position, axis, after):
            scene.position[axis] = after
    return 0.0, False


@dataclass(frozen=True)
class Room(World):
    walls: tuple = MAZE

    dynamics, actions = Dynamics(enter, walk), CARDINAL
    things, size, fps = 0, 1.0, 10

    @property
    def rules(self):
        return RoomRules(CARDINAL.table, walls.table(self.walls))


BORDER = Modality("border cell", [Axis(walls.distance(MAZE), high=0.3)])
WEST_AND_NORTH = Modality("boundary-vector cell", [Axis(walls.distance_along(MAZE, *push), high=0.8, name=name)
                                                   for name, push in (("west", (-2, 0)), ("north", (0, -3)))])


def seeker(distance):
    """An agent that wants to be at a distance from walls."""
    return Agent((Node("BC", BORDER, [6]),), (Desire((distance,), "BC", 1.0),), Learning(0.3), Policy(0.2))


def test_nothing_passes_the_walls_of_a_users_own_world():
    path = Run(seeker(0.1), Room(), seed=1).record(5_000).positions
    assert np.all((0 <= path) & (path <= 1))
    moves = np.diff(path, axis=0)
    crossing = (path[:-1, 0] < 0.455) != (path[1:, 0] < 0.455)
    assert crossing.any() and np.all(path[:-1][crossing, 1] >= 0.7) and np.abs(moves).max() < 0.061


def nearest(x, y, rectangles=MAZE):
    grid = [np.hypot(x - min(max(x, left), right), y - min(max(y, top), bottom))
            for left, top, right, bottom in rectangles]
    return min(grid)


@settings(max_examples=60)
@given(st.tuples(UNIT, UNIT))
def test_an_axis_measures_the_distance_to_the_nearest_wall(place):
    assert BORDER.coordinates(Scene(place), 1.0)[0, 0] == pytest.approx(nearest(*place), abs=1e-12)


@pytest.mark.parametrize("place, west, north", [
    ((0.3, 0.5), 0.3, 0.5), ((0.6, 0.5), 0.14, 0.5), ((0.6, 0.69), 0.14, 0.69), ((0.6, 0.7), 0.6, 0.7),
    ((0.455, 0.9), 0.455, 0.2), ((0.455, 0.3), 0.0, 0.0)])
def test_an_axis_measures_the_distance_to_the_first_wall_in_a_direction(place, west, north):
    np.testing.assert_allclose(WEST_AND_NORTH.coordinates(Scene(place), 1.0), [[west, north]], atol=1e-12)


def test_a_slanted_ray_meets_the_wall_where_it_should_and_an_open_side_is_infinitely_far():
    slanted = Modality("X", [Axis(walls.distance_along([(0.5, 0, 0.6, 1)], 3, 4)),
                             Axis(walls.distance_along([(0.5, 0, 0.6, 1)], -1, 0))])
    away, open_side = slanted.coordinates(Scene((0.2, 0.1)), 1.0)[0]
    assert away == pytest.approx(0.5) and open_side > 1e300
    assert slanted.coordinates(Scene((0.2, 0.7)), 1.0)[0, 0] > 1e300  # it passes below the wall
