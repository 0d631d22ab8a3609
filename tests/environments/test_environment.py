"""Worlds as Gymnasium environments pass Gymnasium's checks, and equal the worlds of runs to the bit."""

import copy
import sys
from concurrent.futures import ThreadPoolExecutor

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env
from pond import Pond
from same import assert_equal

from neorl import Agent, Run, Scene, WaterWorld, brownian, drawing
from neorl.worlds import Arena
from neorl.core.scene import ABSENT
from neorl.drawing import AGENT
from neorl.gym import VectorWorldEnv, WorldEnv
from neorl.gym.observation import observe
from neorl.kernels.annotations import mapped
from neorl.kernels.execution import execute

TANK = WaterWorld(width=60, n_creeps=2, win_reward=5.0)  # episodes end often
POOL = Arena(places=[("platform", 0.65, 0.35), ("trap", 0.3, 0.4)], pay=[2.0, -1.0], trial_seconds=1.5)
WALKER = Agent(brownian().nodes)


def lived(env, actions, **options):
    """Everything that an environment returns in response to actions."""
    returned = [env.reset(**options)]
    for action in actions:
        returned.append(env.step(action))
        if returned[-1][2] or returned[-1][3]:
            returned.append(env.reset())
    return returned


def random_actions(steps, seed=0):
    return np.random.default_rng(seed).integers(0, 5, steps)


@pytest.mark.parametrize("name, mode, rules", [
    ("WaterWorld-v0", None, {}), ("WaterWorld-v0", "rgb_array", {"continuing": False, "n_creeps": 1}),
    ("WaterWorld-v0", "rgb_array", {"egocentric": False}), ("Arena-v0", "rgb_array", {}),
    ("Arena-v0", None, {"places": []}), ("World-v0", "rgb_array", {"world": Pond()})])
def test_gymnasium_finds_nothing_to_warn_about(name, mode, rules):
    env = gymnasium.make(f"neorl.gym:neorl/{name}", render_mode=mode, **rules)
    check_env(env.unwrapped)
    env.reset(seed=1)
    env.step(env.action_space.sample())  # through Gymnasium's passive checker
    env.close()


@pytest.mark.parametrize("world", [TANK, POOL, Pond()], ids=["tank", "pool", "pond"])
def test_an_environment_is_the_world_of_a_run_to_the_bit(world):
    run, env, restarts = Run(WALKER, world, seed=3, run=2), WorldEnv(world, continuing=True), 0
    env.reset(seed=3, options={"run": 2})
    for step in range(2_000):
        paid = run.advance(1)
        _, reward, terminated, truncated, info = env.step(run.state.last_event)
        assert (reward, terminated, truncated) == (paid, False, False)
        restarts += info["restarted"]
        if info["restarted"] or step % 20 == 0:
            assert_equal(run.world_state, env.world_state)
    assert restarts


def test_a_seed_alone_means_its_run_0_and_without_one_the_stream_continues():
    env, state = WorldEnv(TANK), Run(WALKER, TANK, seed=8).world_state
    first, _ = env.reset(seed=8)
    np.testing.assert_array_equal(env.world_state.scene.things, state.scene.things)
    second, _ = env.reset()
    execute(TANK.dynamics.reset, state, TANK.rules)
    np.testing.assert_array_equal(env.world_state.scene.things, state.scene.things)
    assert (first != second).any()
    np.testing.assert_array_equal(env.reset(seed=8)[0], first)
    assert (WorldEnv(TANK).reset()[0] != WorldEnv(TANK).reset()[0]).any()  # without a seed


def as_written(world, scene, egocentric):
    """The observation, computed from its description."""
    found = [*scene.position / world.size, *scene.velocity / world.size]
    seen = [(np.hypot(*(place - scene.position)), (place - egocentric * scene.position) / world.size, kind)
            for place, kind in zip(scene.things, scene.kinds)]
    for _, place, kind in sorted(seen, key=lambda each: each[0]) if egocentric else seen:
        found += [*place, *np.eye(len(world.kinds))[kind]]
    return np.array(found, np.float32)


@pytest.mark.parametrize("egocentric", [True, False])
@pytest.mark.parametrize("world", [WaterWorld(n_creeps=9), POOL], ids=["tank", "pool"])
def test_an_observation_is_what_its_description_says(world, egocentric):
    env = WorldEnv(world, egocentric=egocentric, continuing=True)
    assert env.observation_space.shape == (4 + 4 * world.things,)
    env.reset(seed=0)
    for action in random_actions(500):
        observation = env.step(action)[0]
        np.testing.assert_allclose(observation, as_written(world, env.world_state.scene, egocentric), rtol=1e-6,
                                   atol=1e-12)
        assert observation in env.observation_space
    if world is not POOL:
        assert (observation.max(), observation.min() < 0) == (1.0, egocentric or observation[2:4].min() < 0)


def observed(scene, egocentric, size=2.0, n_kinds=2):
    things, axes = scene.things.shape
    numbers = np.full(2 * axes + things * (axes + n_kinds), np.nan, np.float32)
    finite = execute(observe, scene, size, n_kinds, egocentric, np.zeros(things), np.zeros(things, np.int64), numbers)
    return finite, numbers.tolist()


def test_absent_things_are_0_and_what_is_out_of_range_is_clipped():
    scene = Scene(np.array([1.0, 4.0, 0.5]), np.array([-90.0, 90.0, 1.0]),
                  np.array([[np.nan] * 3, [2.0, 4.0, -3.0], [1.0, 3.0, 0.5]]), np.array([ABSENT, 1, 0]),
                  np.zeros(3, np.int64))
    seen = [0.5, 1.0, 0.25, -10.0, 10.0, 0.5]
    far, near, absent = [0.5, 0.0, -1.0, 0, 1], [0.0, -0.5, 0.0, 1, 0], [0.0] * 5
    assert observed(scene, True) == (True, [*seen, *near, *far, *absent])
    assert observed(scene, False) == (True, [*seen, *absent, 1.0, 1.0, 0.0, 0, 1, 0.5, 1.0, 0.25, 1, 0])
    for name, index in [("position", 1), ("velocity", 2), ("things", (1, 2))]:
        broken = mapped(np.copy, scene)
        getattr(broken, name)[index] = np.nan
        assert not observed(broken, True)[0] and not observed(broken, False)[0]


def test_things_are_sorted_by_distance_and_ties_by_number():
    rng = np.random.default_rng(0)
    for things in (0, 1, 2, 3, 10, 100):
        places = rng.integers(0, 4, (things, 1)).astype(float)  # many are at equal distances
        scene = Scene(np.zeros(1), np.zeros(1), places, rng.integers(0, 2, things), np.zeros(things, np.int64))
        kinds = np.array(observed(scene, True, size=8.0)[1][2:]).reshape(-1, 3)[:, 2]
        np.testing.assert_array_equal(kinds, scene.kinds[np.argsort(places[:, 0], kind="stable")])


def test_an_environment_that_is_not_continuing_terminates_with_the_last_green_creep():
    env, ends = WorldEnv(TANK, continuing=False), 0
    env.reset(seed=1)
    for action in random_actions(6_000):
        _, reward, terminated, truncated, info = env.step(action)
        assert not truncated and not info["restarted"] and terminated == (reward >= TANK.win_reward - 1)
        if terminated:
            assert info["met"][0] >= 1 and not (env.world_state.scene.kinds == 0).any()
            with pytest.raises(gymnasium.error.ResetNeeded, match=r"step\(\) must follow reset\(\), but came before i"):
                env.step(0)
            env.reset()
            ends += 1
    assert ends > 5


def test_a_trial_in_an_arena_terminates_at_a_place_and_is_truncated_when_its_time_is_up():
    returned = lived(WorldEnv(POOL), random_actions(5_000), seed=0)
    over = [each for each in returned if len(each) == 5 and (each[2] or each[3])]
    assert {(terminated, truncated) for _, _, terminated, truncated, _ in over} == {(True, False), (False, True)}
    for _, reward, terminated, _, info in over:
        assert terminated == info["met"].any() and reward == info["met"] @ (2.0, -1.0)
    endless = lived(WorldEnv(Arena(ends=False, trial_seconds=1.0)), random_actions(5_000), seed=0)
    assert all(not each[2] for each in endless if len(each) == 5)
    assert sum(each[4]["met"].sum() for each in endless if len(each) == 5) > 0


def test_bad_actions_are_refused_and_steps_before_the_first_reset():
    env = WorldEnv(TANK, "rgb_array")
    for call in (lambda: env.step(0), env.render):
        with pytest.raises(gymnasium.error.ResetNeeded, match="must follow reset"):
            call()
    env.reset(seed=0)
    for action in (5, -1, "N", 1.0, None, np.array([1, 2])):
        with pytest.raises(ValueError, match="action must be .*, but is .*"):
            env.step(action)
    for action in (np.int64(4), np.array(3), np.uint8(0)):
        env.step(action)


def test_a_picture_can_be_drawn_in_the_book_s_style_of_figures():
    drawing.use_style()  # whose layout would warn, which fails a test
    env = gymnasium.make("neorl/WaterWorld-v0", render_mode="rgb_array")
    env.reset(seed=0)
    assert env.render().std() > 0


def test_a_picture_of_an_arena_shows_obstacles_places_and_the_agent():
    env = WorldEnv(Arena(obstacles=[(0.1, 0.45, 0.3, 0.55)], start=(0.5, 0.6)), "rgb_array")
    env.reset(seed=0)
    picture = env.render()
    assert picture.shape == (500, 500, 3) and picture.dtype == np.uint8
    at = [tuple((0.06 + np.array(place)) / 1.12 * 500) for place in [(0.2, 0.5), (0.65, 0.35), (0.5, 0.6), (0.5, 0.5)]]
    obstacle, platform, agent, floor = (picture[int(y), int(x)].tolist() for x, y in at)
    assert floor == [255] * 3 and len({tuple(each) for each in (obstacle, platform, agent, floor)}) == 4
    assert agent == [int(AGENT[digit:digit + 2], 16) for digit in (1, 3, 5)]


def test_a_picture_without_matplotlib_names_the_extra(monkeypatch):
    env = WorldEnv(TANK, "rgb_array")
    env.reset(seed=0)
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    with pytest.raises(ImportError, match=r"matplotlib must be installed for this.*neorl-companion\[gym\]"):
        env.render()


@pytest.mark.filterwarnings("ignore:.*You are trying to use .human. rendering")
def test_a_window_follows_every_step(monkeypatch):
    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")
    import pygame

    env = gymnasium.make("neorl/WaterWorld-v0", render_mode="human", fps=1_000)
    env.reset(seed=0)
    for action in random_actions(20):
        env.step(action)
    shown = pygame.surfarray.array3d(pygame.display.get_surface()).swapaxes(0, 1)
    other = WorldEnv(WaterWorld(fps=1_000), "rgb_array")
    lived(other, random_actions(20), seed=0)
    np.testing.assert_array_equal(shown, other.render())
    env.close()


@pytest.mark.parametrize("make", [lambda: WorldEnv(POOL), lambda: VectorWorldEnv(POOL, 2)])
def test_an_environment_takes_one_call_at_a_time_and_a_copy_of_it_too(make):
    env = make()
    env.reset(seed=0)
    with env._alone.call("step"), ThreadPoolExecutor(1) as other:
        for call in (lambda: env.step(env.action_space.sample()), env.reset):
            with pytest.raises(RuntimeError, match="must not be called while another thread's call is going on"):
                other.submit(call).result()
        copy.deepcopy(env).step(env.action_space.sample())
    env.step(env.action_space.sample())
