"""WaterWorld against recordings of the original, and its rules where the recordings are silent.

The recordings are 243 single steps of the PyGame Learning Environment's WaterWorld
(github.com/ntasfi/PyGame-Learning-Environment), chosen for contacts, walls and ends of episodes.
"""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from neorl import WaterWorld
from neorl.worlds.waterworld import ACTIONS

RECORDINGS = dict(np.load(Path(__file__).with_name("waterworld_recordings.npz")))
FIELDS = {"agent_position": "agent_pos", "agent_velocity": "agent_vel", "creep_position": "creep_pos",
          "creep_direction": "creep_dir", "creep_speed": "creep_speed", "creep_is_green": "creep_good",
          "creep_jitter": "creep_jitter"}


@pytest.mark.parametrize("name", sorted({key.split("/")[0] for key in RECORDINGS}))
def test_every_recorded_step_is_reproduced_exactly(name):
    recorded = {key.split("/")[1]: value for key, value in RECORDINGS.items() if key.startswith(name)}
    world = WaterWorld(int(recorded["width"]), recorded["hit"].shape[1], int(recorded["fps"]),
                       float(recorded["win_reward"]))
    assert world.radius == recorded["radius"]
    state = world.reset(0)
    for step, action in enumerate(recorded["action"]):
        for field, key in FIELDS.items():
            setattr(state, field, recorded[key + "0"][step])
        reward, hits, done = world.step(state, int(action))
        np.testing.assert_array_equal(hits, recorded["hit"][step])
        for field, key in FIELDS.items():
            new, old = getattr(state, field), recorded[key + "1"][step]
            kept = ~hits if field.startswith("creep") else slice(None)  # fresh creeps are drawn from another stream
            np.testing.assert_array_equal(new[kept], old[kept], err_msg=f"{field} at step {step}")
        if not hits.any():
            assert (reward, done) == (recorded["reward"][step], recorded["done"][step])


@given(seed=st.integers(0, 2**32), width=st.integers(11, 500), n_creeps=st.integers(1, 9))
def test_a_reset_draws_creeps_within_their_ranges_and_one_green(seed, width, n_creeps):
    world = WaterWorld(width, n_creeps)
    state = world.reset(seed)
    margin = 1.5 * world.radius
    assert state.creep_is_green.any()
    assert np.all((state.creep_position >= margin) & (state.creep_position <= width - margin))
    assert np.all(np.linalg.norm(state.creep_position - state.agent_position, axis=1) >= 1.5)
    np.testing.assert_allclose(np.abs(state.creep_direction), 1 / np.sqrt(2))
    assert np.all((state.creep_speed >= 0) & (state.creep_speed <= 0.25 * width))
    assert np.all((state.creep_jitter >= 0) & (state.creep_jitter < 1))


@given(seed=st.integers(0, 2**32), actions=st.lists(st.sampled_from(ACTIONS), max_size=60))
def test_nothing_leaves_the_tank(seed, actions):
    world = WaterWorld(n_creeps=3)
    state = world.reset(seed)
    for action in actions:
        world.step(state, action)
        assert np.all((state.agent_position >= 0) & (state.agent_position <= world.width - 2 * world.radius))
        assert np.all((state.creep_position >= world.radius) & (state.creep_position <= world.width - world.radius))
        np.testing.assert_allclose(np.linalg.norm(state.creep_direction, axis=1), 1)


def touching(colours, win_reward=0.0):
    """A tank whose first creep lies on the agent."""
    world = WaterWorld(n_creeps=len(colours), win_reward=win_reward)
    state = world.reset(0)
    state.creep_position = 20.0
    state.creep_position[0] = state.agent_position
    state.creep_is_green = colours
    return world, state


def test_a_touched_creep_pays_by_its_colour_and_is_replaced():
    for green in (True, False):
        world, state = touching([green, True])
        reward, hits, done = world.step(state, "no-op")
        assert reward == (1.0 if green else -1.0)
        assert hits.tolist() == [True, False]
        assert not done
        assert np.linalg.norm(state.creep_position[0] - state.agent_position) >= 1


def test_the_last_green_creep_ends_the_episode_and_pays_the_win():
    ends = []
    for seed in range(40):
        world, state = touching([True, False], win_reward=5.0)
        state.stream = np.random.SFC64(seed).state["state"]["state"]
        reward, _, done = world.step(state, "no-op")
        assert reward == (6.0 if done else 1.0)
        assert done == (not state.creep_is_green.any())
        ends.append(done)
    assert 8 < sum(ends) < 32  # a fair coin decides the colour of the fresh creep


def test_a_field_of_the_state_can_be_written_in_place_and_assigned():
    state = WaterWorld().reset(0)
    state.agent_position[0] = 3.0
    array = state.agent_velocity
    state.agent_velocity = [1, 2]
    assert state.agent_position[0] == 3.0
    assert array.tolist() == [1.0, 2.0]


@pytest.mark.parametrize("argument, value", [
    ("width", 10), ("width", 0), ("width", 250.5), ("n_creeps", 0), ("n_creeps", 2.5), ("fps", 0), ("fps", -50),
    ("win_reward", np.nan), ("win_reward", "5"),
])
def test_a_bad_rule_is_refused(argument, value):
    with pytest.raises(ValueError, match=f"{argument} is {value!r}, allowed are"):
        WaterWorld(**{argument: value})


def test_a_bad_step_is_refused_and_changes_nothing():
    world = WaterWorld()
    state = world.reset(0)
    for action in (5, -1, 1.5, "north", None):
        with pytest.raises(ValueError, match="action is .*, allowed are"):
            world.step(state, action)
    with pytest.raises(ValueError, match=r"state.creep_position is float64 \(3, 2\), allowed with n_creeps = 4"):
        WaterWorld(n_creeps=4).step(state, 0)
    state.agent_position[1] = np.nan
    with pytest.raises(ValueError, match="state.agent_position is .*nan"):
        world.step(state, 0)
    for seed in (-1, 0.5, None):
        with pytest.raises(ValueError, match="seed is"):
            world.reset(seed)


def lonely(**fields):
    """A tank whose only creep is far from an agent at rest, but for the given fields."""
    world = WaterWorld(n_creeps=1)
    state = world.reset(0)
    state.creep_position = [200.0, 200.0]
    state.creep_speed = 0.0
    state.agent_position = [50.0, 50.0]
    for name, value in fields.items():
        setattr(state, name, value)
    return world, state


def test_an_agent_that_just_reaches_the_wall_is_stopped_in_x_and_glides_on_in_y():
    highest = 250.0 - 2 * 12
    world, state = lonely(agent_position=[highest, highest], agent_velocity=[0.0, 0.0])
    world.step(state, "no-op")
    assert state.agent_position.tolist() == [highest, highest]
    state.agent_position = highest - 1.0
    state.agent_velocity = 50.0
    world.step(state, "no-op")
    assert state.agent_velocity.tolist() == [0.0, 50.0 * 0.975]


def test_contact_begins_one_rounded_pixel_inside_two_radii():
    for distance, touched in [(24, False), (23.6, False), (23.4, True), (-24, False), (-23.6, False), (-23.5, True)]:
        world, state = lonely(creep_position=[100.0 + distance, 90.0], agent_position=[100.0, 100.0])
        assert world.step(state, "no-op")[1].tolist() == [touched], distance


def test_a_creep_bounces_with_its_jitter_where_it_just_reaches_the_low_wall_but_not_the_high_one():
    for wall, sign, bounces in [(12.0, -1.0, True), (238.0, 1.0, False)]:
        world, state = lonely(creep_position=[wall - sign, 100.0], creep_direction=[sign, 0.0], creep_speed=50.0,
                              creep_jitter=0.5)
        world.step(state, "no-op")
        assert state.creep_position[0].tolist() == [wall, 100.0]
        assert state.creep_direction[0].tolist() == [-sign if bounces else sign, 0.0]
    world, state = lonely(creep_position=[237.9, 100.0], creep_direction=[0.6, 0.8], creep_speed=50.0, creep_jitter=0.5)
    world.step(state, "no-op")
    turned = np.array([-0.6 * 1.25, 0.8])
    np.testing.assert_allclose(state.creep_direction[0], turned / np.linalg.norm(turned))


@pytest.mark.parametrize("contact, touched", [("rounded", False), ("truncated", True)])
def test_positions_are_compared_in_whole_pixels_by_either_rule(contact, touched):
    """Side by side at 100.4 and 123.5: 24 pixels apart if rounded, 23 if truncated, and two radii are 24."""
    world = WaterWorld(n_creeps=1, contact=contact)
    state = world.reset(0)
    state.creep_is_green = True
    state.agent_position, state.creep_position = (100.4, 100.0), (123.5, 100.0)
    assert world.step(state, "no-op")[1].tolist() == [touched]


def test_an_unknown_contact_rule_is_refused():
    with pytest.raises(ValueError, match="contact is 'near', allowed are 'rounded', 'truncated'"):
        WaterWorld(contact="near")
