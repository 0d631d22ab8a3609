"""WaterWorld against recordings of the original, and its rules where the recordings are silent.

The recordings are 243 single steps of the PyGame Learning Environment's WaterWorld
(github.com/ntasfi/PyGame-Learning-Environment), chosen to cover contacts, walls and ends of episodes.
"""

import ast
import inspect
import re
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from neorl import WaterWorld
from neorl.kernels.annotations import arrays
from neorl.worlds import waterworld
from neorl.worlds.waterworld import GREEN, RED

RECORDINGS = dict(np.load(Path(__file__).with_name("waterworld_recordings.npz")))
FIELDS = {"scene.position": "agent_pos", "scene.velocity": "agent_vel", "scene.things": "creep_pos",
          "direction": "creep_dir", "speed": "creep_speed", "scene.kinds": "creep_good", "jitter": "creep_jitter"}


def recorded_field(recorded, field, key, step):
    value = recorded[key][step]
    return np.where(value, GREEN, RED) if field == "scene.kinds" else value


def test_every_kernel_says_which_rule_it_is():
    kernels = [ast.get_docstring(each) for each in ast.parse(inspect.getsource(waterworld)).body
               if isinstance(each, ast.FunctionDef)]
    stated = re.findall(r"^(\d)\. ", waterworld.__doc__, re.MULTILINE)
    cited = [re.findall(r"\d", re.search("rules? [^).:]*", each)[0]) for each in kernels]
    assert len(kernels) == 6 and {number for numbers in cited for number in numbers} == {*stated}


@pytest.mark.parametrize("name", sorted({key.split("/")[0] for key in RECORDINGS}))
def test_every_recorded_step_is_reproduced_exactly(name):
    recorded = {key.split("/")[1]: value for key, value in RECORDINGS.items() if key.startswith(name)}
    world = WaterWorld(int(recorded["width"]), recorded["hit"].shape[1], int(recorded["fps"]),
                       float(recorded["win_reward"]))
    assert world.radius == recorded["radius"]
    state = world.reset(0)
    for step, action in enumerate(recorded["action"]):
        for field, key in FIELDS.items():
            arrays(state)[field][...] = recorded_field(recorded, field, key + "0", step)
        reward, hits, done = world.step(state, int(action))
        np.testing.assert_array_equal(hits, recorded["hit"][step])
        before = recorded_field(recorded, "scene.kinds", "creep_good0", step)
        np.testing.assert_array_equal(state.scene.met, np.where(hits, 1 + before, 0))
        for field, key in FIELDS.items():
            new, old = arrays(state)[field], recorded_field(recorded, field, key + "1", step)
            kept = ~hits if key.startswith("creep") else slice(None)  # fresh creeps are drawn from another stream
            np.testing.assert_array_equal(new[kept], old[kept], err_msg=f"{field} at step {step}")
        if not hits.any():
            assert (reward, done) == (recorded["reward"][step], recorded["done"][step])


@given(seed=st.integers(0, 2**32), width=st.integers(11, 500), n_creeps=st.integers(1, 9))
def test_a_reset_draws_creeps_within_their_ranges_and_one_green(seed, width, n_creeps):
    world = WaterWorld(width, n_creeps)
    state = world.reset(seed)
    margin = 1.5 * world.radius
    assert (state.scene.kinds == GREEN).any() and set(state.scene.kinds) <= {GREEN, RED}
    assert np.all((state.scene.things >= margin) & (state.scene.things <= width - margin))
    assert np.all(np.linalg.norm(state.scene.things - state.scene.position, axis=1) >= 1.5)
    np.testing.assert_allclose(np.abs(state.direction), 1 / np.sqrt(2))
    assert np.all((state.speed >= 0) & (state.speed <= 0.25 * width))
    assert np.all((state.jitter >= 0) & (state.jitter < 1))


@given(seed=st.integers(0, 2**32), actions=st.lists(st.sampled_from(WaterWorld.actions.all_names), max_size=60))
def test_nothing_leaves_the_tank(seed, actions):
    world = WaterWorld(n_creeps=3)
    state = world.reset(seed)
    for action in actions:
        world.step(state, action)
        assert np.all((state.scene.position >= 0) & (state.scene.position <= world.width - 2 * world.radius))
        assert np.all((state.scene.things >= world.radius) & (state.scene.things <= world.width - world.radius))
        np.testing.assert_allclose(np.linalg.norm(state.direction, axis=1), 1)


def touching(kinds, win_reward=0.0):
    """A tank whose first creep lies on the agent."""
    world = WaterWorld(n_creeps=len(kinds), win_reward=win_reward)
    state = world.reset(0)
    state.scene.things[:] = 20.0
    state.scene.things[0] = state.scene.position
    state.scene.kinds[:] = kinds
    return world, state


def test_a_touched_creep_pays_by_its_colour_and_is_replaced():
    for kind in (GREEN, RED):
        world, state = touching([kind, GREEN])
        reward, hits, done = world.step(state, "no-op")
        assert reward == (1.0 if kind == GREEN else -1.0)
        assert state.scene.met.tolist() == [1 + kind, 0]  # the kind of the creep touched, not of its replacement
        assert hits.tolist() == [True, False]
        assert not done
        assert np.linalg.norm(state.scene.things[0] - state.scene.position) >= 1


def test_the_last_green_creep_ends_the_episode_and_pays_the_win():
    ends = []
    for seed in range(40):
        world, state = touching([GREEN, RED], win_reward=5.0)
        state.stream[:] = np.random.SFC64(seed).state["state"]["state"]
        reward, _, done = world.step(state, "no-op")
        assert reward == (6.0 if done else 1.0)
        assert done == (not (state.scene.kinds == GREEN).any())
        ends.append(done)
    assert 8 < sum(ends) < 32  # a fair coin decides the colour of the fresh creep


def test_a_bad_step_is_refused_and_changes_nothing():
    world = WaterWorld()
    state = world.reset(0)
    for action in (5, -1, 1.5, "north", None):
        with pytest.raises(ValueError, match="action must be .*, but is .*"):
            world.step(state, action)
    with pytest.raises(ValueError, match=r"state.scene.things must be float64 \(4, 2\), contiguous and writeable, but"):
        WaterWorld(n_creeps=4).step(state, 0)
    state.scene.kinds[1] = 2
    with pytest.raises(ValueError, match=r"state.scene.kinds must be −1 or the numbers of \('green', 'red'\), but"):
        world.step(state, 0)
    assert state.scene.position[0] == 125.0 and not state.scene.velocity.any()


def lonely(**fields):
    """A tank with an agent at rest and one creep far from it, except for the given fields."""
    world = WaterWorld(n_creeps=1)
    state = world.reset(0)
    for name, value in ({"things": 200.0, "speed": 0.0, "position": 50.0} | fields).items():
        (state._asdict() | state.scene._asdict())[name][...] = value
    return world, state


def test_an_agent_that_just_reaches_the_wall_is_stopped_in_x_and_glides_on_in_y():
    highest = 250.0 - 2 * 12
    world, state = lonely(position=[highest, highest], velocity=[0.0, 0.0])
    world.step(state, "no-op")
    assert state.scene.position.tolist() == [highest, highest]
    state.scene.position[:] = highest - 1.0
    state.scene.velocity[:] = 50.0
    world.step(state, "no-op")
    assert state.scene.velocity.tolist() == [0.0, 50.0 * 0.975]


def test_a_creep_bounces_with_its_jitter_where_it_just_reaches_the_low_wall_but_not_the_high_one():
    for wall, sign, bounces in [(12.0, -1.0, True), (238.0, 1.0, False)]:
        world, state = lonely(things=[wall - sign, 100.0], direction=[sign, 0.0], speed=50.0,
                              jitter=0.5)
        world.step(state, "no-op")
        assert state.scene.things[0].tolist() == [wall, 100.0]
        assert state.direction[0].tolist() == [-sign if bounces else sign, 0.0]
    world, state = lonely(things=[237.9, 100.0], direction=[0.6, 0.8], speed=50.0, jitter=0.5)
    world.step(state, "no-op")
    turned = np.array([-0.6 * 1.25, 0.8])
    np.testing.assert_allclose(state.direction[0], turned / np.linalg.norm(turned))


@pytest.mark.parametrize("contact, touched", [("rounded", False), ("truncated", True)])
def test_positions_are_compared_in_whole_pixels_by_either_rule(contact, touched):
    """Side by side at 100.4 and 123.5: 24 pixels apart if rounded, 23 if truncated, and two radii are 24."""
    world = WaterWorld(n_creeps=1, contact=contact)
    state = world.reset(0)
    state.scene.kinds[:] = GREEN
    state.scene.position[:], state.scene.things[:] = (100.4, 100.0), (123.5, 100.0)
    assert world.step(state, "no-op")[1].tolist() == [touched]
