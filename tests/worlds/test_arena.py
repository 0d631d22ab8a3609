"""The rules of the arena."""

import numpy as np
import pytest

from neorl.worlds import Arena

RIM = {(0.5, 0.05), (0.5, 0.95), (0.05, 0.5), (0.95, 0.5)}
FREE = {"places": (), "start": (0.5, 0.5), "trial_seconds": 1e6}


def walked(world, actions, seed=0):
    """The positions and velocities along a walk."""
    state, positions, velocities = world.reset(seed), [], []
    for action in actions:
        world.step(state, action)
        positions.append(state.scene.position.copy())
        velocities.append(state.scene.velocity.copy())
    return np.array(positions), np.array(velocities)


def test_a_trial_starts_at_rest_at_one_of_four_points_of_the_rim_or_at_the_start():
    states = [Arena().reset(seed) for seed in range(60)]
    assert {tuple(state.scene.position.tolist()) for state in states} == RIM
    assert not any(state.scene.velocity.any() for state in states)
    assert {tuple(Arena(start=(0.3, 0.4)).reset(seed).scene.position.tolist()) for seed in range(9)} == {(0.3, 0.4)}


def test_with_inertia_an_action_adds_to_the_velocity_and_a_step_keeps_most_of_it():
    positions, velocities = walked(Arena(**FREE), ["E", "no-op", "N"])
    assert positions[0].tolist() == [0.5 + 0.25 / 50, 0.5] and velocities[0].tolist() == [0.25 * 0.975, 0.0]
    np.testing.assert_allclose(velocities[1], [0.25 * 0.975**2, 0.0])
    np.testing.assert_allclose(velocities[2], [0.25 * 0.975**3, -0.25 * 0.975])
    np.testing.assert_allclose(positions[2] - positions[1], [0.25 * 0.975**2 / 50, -0.25 / 50])


def test_plain_steps_are_of_one_length_and_leave_no_velocity_behind():
    world = Arena(motion="steps", step_length=0.1, fps=10, **FREE)
    positions, velocities = walked(world, ["N", "S", "E", "W", "no-op"])
    np.testing.assert_allclose(positions, [[0.5, 0.4], [0.5, 0.5], [0.6, 0.5], [0.5, 0.5], [0.5, 0.5]])
    np.testing.assert_allclose(velocities, [[0, -1], [0, 1], [1, 0], [-1, 0], [0, 0]])


@pytest.mark.parametrize("motion", ["inertia", "steps"])
@pytest.mark.parametrize("shape", ["round", "square"])
def test_nothing_leaves_the_walls_or_enters_an_obstacle(shape, motion):
    obstacles = ((0.6, 0.35, 0.7, 0.65), (0.2, 0.2, 0.5, 0.3))
    world = Arena(shape=shape, motion=motion, step_length=0.07, obstacles=obstacles, fps=10, **FREE)
    rng = np.random.default_rng(0)
    actions = np.repeat(rng.integers(0, 4, 600), rng.integers(1, 12, 600))
    positions, _ = walked(world, actions.tolist())
    x, y = positions.T
    assert np.all((0 <= positions) & (positions <= 1))
    for left, top, right, bottom in obstacles:
        assert not np.any((left < x) & (x < right) & (top < y) & (y < bottom))
    away = np.hypot(x - 0.5, y - 0.5)
    assert np.all(away <= 0.5 + 1e-12) if shape == "round" else away.max() > 0.55
    assert x.max() > 0.75 and x.min() < 0.15  # it has reached both walls, and passed the obstacle


@pytest.mark.parametrize("arguments, stopped", [
    ({"shape": "square", "start": (0.997, 0.5)}, True), ({"start": (0.997, 0.5)}, True),
    ({"start": (0.5, 0.5), "obstacles": ((0.501, 0.4, 0.6, 0.6),)}, True), ({"start": (0.5, 0.5)}, False),
    ({"start": (0.5, 0.5), "obstacles": ((0.501, 0.51, 0.6, 0.6),)}, False),
])
def test_what_is_in_the_way_stops_the_agent_along_that_axis_alone(arguments, stopped):
    world = Arena(places=(), **arguments)
    state = world.reset(0)
    state.scene.velocity[1] = 0.02
    world.step(state, "E")
    x, y = world.start
    assert state.scene.position[0] == (x if stopped else x + 0.25 / 50)
    assert state.scene.velocity[0] == (0.0 if stopped else 0.25 * 0.975)
    assert state.scene.position[1] == y + 0.02 / 50 and state.scene.velocity[1] == 0.02 * 0.975


def steps_along(world, actions):
    state = world.reset(0)
    return [(*world.step(state, action), state.scene.met.tolist()) for action in actions]


def test_a_place_is_met_once_when_the_agent_comes_within_its_radius():
    world = Arena(places=(("food", 0.6, 0.5),), radius=0.06, ends=False, motion="steps", step_length=0.05,
                  start=(0.5, 0.5))
    came = steps_along(world, ["E", "E", "no-op", "W", "W", "E"])
    assert [reward for reward, *_ in came] == [1, 0, 0, 0, 0, 1]
    assert [met for *_, met in came] == [[1], [0], [0], [0], [0], [1]]
    assert [hits.tolist() for _, hits, *_ in came] == [[True], [False], [False], [False], [False], [True]]
    assert not any(done for _, _, done, _ in came)


def test_a_place_at_the_start_is_met_only_after_it_was_left():
    world = Arena(places=(("nest", 0.5, 0.5),), motion="steps", step_length=0.1, start=(0.5, 0.5), ends=False)
    assert [reward for reward, *_ in steps_along(world, ["no-op", "E", "W"])] == [0, 0, 1]


def test_each_kind_pays_its_own_and_those_left_out_pay_1():
    places = (("food", 0.6, 0.5), ("trap", 0.5, 0.6), ("food", 0.4, 0.5), ("nest", 0.5, 0.4))
    world = Arena(places=places, pay=(5.0, -2.0), motion="steps", step_length=0.1, start=(0.5, 0.5), radius=0.03,
                  ends=False)
    came = steps_along(world, ["E", "W", "S", "N", "W", "E", "N"])
    assert [reward for reward, *_ in came] == [5, 0, -2, 0, 5, 0, 1]
    assert [met for *_, met in came if any(met)] == [[1, 0, 0, 0], [0, 2, 0, 0], [0, 0, 1, 0], [0, 0, 0, 3]]
    both = Arena(places=(("food", 0.6, 0.5), ("trap", 0.6, 0.5)), pay=(5.0, -2.0), motion="steps", step_length=0.1,
                 start=(0.5, 0.5))
    assert steps_along(both, ["E"])[0][0] == 3.0


@pytest.mark.parametrize("seconds, fps, last", [(0.5, 10, 5), (0.01, 10, 1), (60.0, 1, 60)])
def test_a_trial_without_success_ends_without_pay(seconds, fps, last):
    world = Arena(trial_seconds=seconds, fps=fps, start=(0.3, 0.7))
    came = steps_along(world, ["no-op"] * last)
    assert [done for _, _, done, _ in came] == [False] * (last - 1) + [True]
    assert not any(reward for reward, *_ in came)
