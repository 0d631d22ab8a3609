"""Vector environments equal, to the bit, single ones that Gymnasium vectorises."""

import copy
import hashlib
import json
import pickle

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import data_equivalence
from gymnasium.vector import AutoresetMode, SyncVectorEnv
from gymnasium.wrappers import TimeLimit
from pond import Pond
from subprograms import printed

from neorl import WaterWorld
from neorl.worlds import Arena
from neorl.gym import VectorWorldEnv, WorldEnv

WORLDS = {"tank": WaterWorld(width=60, n_creeps=2, win_reward=5.0), "pond": Pond(),
          "pool": Arena(places=[("platform", 0.65, 0.35), ("trap", 0.3, 0.4)], pay=[2.0, -1.0], trial_seconds=1.5)}


def both(world, n, limit, **choices):
    """Our vector environment, and single ones that Gymnasium steps one after the other."""
    def single():
        env = WorldEnv(world, **choices)
        return env if limit is None else TimeLimit(env, limit)

    return (VectorWorldEnv(world, n, limit, **choices),
            SyncVectorEnv([single] * n, autoreset_mode=AutoresetMode.NEXT_STEP))


@pytest.mark.parametrize("continuing, limit", [(True, 37), (False, None), (False, 37)])
@pytest.mark.parametrize("name", WORLDS)
def test_they_return_what_single_environments_do_to_the_bit(name, continuing, limit):
    n, rng, restarted = 5, np.random.default_rng(0), 0
    ours, theirs = both(WORLDS[name], n, limit, continuing=continuing)
    assert ours.observation_space == theirs.observation_space and ours.action_space == theirs.action_space
    assert ours.metadata["autoreset_mode"] == theirs.metadata["autoreset_mode"]
    returned = [envs.reset(seed=7, options={"run": 1}) for envs in (ours, theirs)]
    assert data_equivalence(*returned, exact=True)
    for _ in range(300):
        actions = rng.integers(0, 5, n)
        returned = [envs.step(actions) for envs in (ours, theirs)]
        assert data_equivalence(*returned, exact=True)
        restarted += returned[0][4]["restarted"].sum()
        assert returned[0][0] in ours.observation_space
    assert restarted > 0


def test_seeds_are_those_of_single_environments():
    ours, theirs = both(WORLDS["tank"], 3, None)
    assert data_equivalence(ours.reset(seed=[5, 9, 5]), theirs.reset(seed=[5, 9, 5]), exact=True)
    assert data_equivalence(ours.reset(seed=[None, 9, None]), theirs.reset(seed=[None, 9, None]), exact=True)
    assert data_equivalence(ours.reset(), theirs.reset(), exact=True)
    observations, _ = VectorWorldEnv(WORLDS["tank"], 3).reset()
    assert len({each.tobytes() for each in observations}) == 3


def test_gymnasium_makes_them_by_their_names():
    for mode in (None, "vector_entry_point"):
        envs = gymnasium.make_vec("neorl.gym:neorl/WaterWorld-v0", num_envs=64, vectorization_mode=mode, n_creeps=4)
        assert type(envs) is VectorWorldEnv and envs.num_envs == 64 and envs.world == WaterWorld(n_creeps=4)
    envs.reset(seed=0)
    for step in range(3_000):
        _, _, _, truncated, _ = envs.step(np.full(64, 4))
    assert truncated.all()  # after a minute
    pools = gymnasium.make_vec("neorl/Arena-v0", num_envs=2, motion="steps", render_mode="rgb_array")
    assert pools.world == Arena(motion="steps")
    pools.reset(seed=0)
    single = gymnasium.make("neorl/Arena-v0", motion="steps", render_mode="rgb_array")
    single.reset(seed=1)
    np.testing.assert_array_equal(pools.render()[1], single.render())
    assert gymnasium.make_vec("neorl/World-v0", num_envs=2, world=Pond()).world == Pond()
    for mode in ("sync", "vector_entry_point"):
        endless = gymnasium.make_vec("neorl/WaterWorld-v0", 1, mode, max_episode_steps=-1)
        endless.reset(seed=0)
        assert not any(endless.step(np.full(1, 4))[3].any() for _ in range(3_001))
        with pytest.raises(ValueError, match="max_episode_steps"):
            gymnasium.make_vec("neorl/WaterWorld-v0", 1, mode, max_episode_steps=0)
    singles = gymnasium.make_vec("neorl/WaterWorld-v0", num_envs=2, vectorization_mode="sync")
    assert data_equivalence(singles.reset(seed=3), VectorWorldEnv(WaterWorld(), 2).reset(seed=3), exact=True)


@pytest.mark.parametrize("again", [copy.deepcopy, lambda env: pickle.loads(pickle.dumps(env))], ids=["copy", "pickle"])
def test_a_copy_continues_independently_to_the_same_bits(again):
    envs = VectorWorldEnv(WORLDS["tank"], 3)
    envs.reset(seed=0)
    other, ways = again(envs), []
    for each in (envs, other):
        ways.append([each.step(np.full(3, step % 5))[0] for step in range(100)])
    np.testing.assert_array_equal(*ways)


def test_what_was_returned_is_not_written_to():
    envs = VectorWorldEnv(WORLDS["tank"], 3, 2)
    kept = [envs.reset(seed=0)] + [envs.step(np.zeros(3, int)) for _ in range(3)]
    copies = copy.deepcopy(kept)
    for _ in range(5):
        envs.step(np.ones(3, int))
    envs.reset(seed=1)
    assert data_equivalence(kept, copies, exact=True)
    with pytest.raises(ValueError, match="read-only"):
        envs.world_states[0].scene.position[0] = 3.0


def test_bad_actions_are_refused_and_steps_outside_of_episodes():
    envs = VectorWorldEnv(Pond(), 2, 1, "rgb_array")
    for call in (lambda: envs.step([0, 0]), envs.render):
        with pytest.raises(gymnasium.error.ResetNeeded, match="must follow reset"):
            call()
    envs.reset(seed=0)
    for actions in ([0, 5], [0, -1], [0], [[0, 1]], [0.0, 1.0], "NN", None, 3, [2**64 - 1, 0]):
        with pytest.raises(ValueError, match="actions must be .*, but is .*"):
            envs.step(actions)
    envs.step(np.array([4, 0], np.uint8))


def digest(name):
    envs, rng = VectorWorldEnv(WORLDS[name], 3, 50, continuing=False), np.random.default_rng(0)
    digest = hashlib.sha256(envs.reset(seed=0)[0].tobytes())
    for _ in range(200):
        returned = envs.step(rng.integers(0, 5, 3))
        for each in (*returned[:4], returned[4]["met"]):
            digest.update(each.tobytes())
    return digest.hexdigest()


def test_they_are_the_same_to_the_bit_without_the_compiler():
    assert printed(__file__) == {name: digest(name) for name in WORLDS}


if __name__ == "__main__":
    print(json.dumps({name: digest(name) for name in WORLDS}))
