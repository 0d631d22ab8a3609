"""Agents of neorl in Gymnasium environments are bit-identical to runs in neorl's worlds, and learn other tasks."""

from dataclasses import replace

import gymnasium
import numpy as np
import pytest
from same import assert_equal

from neorl import (CARDINAL, Actions, Agent, Desire, Learner, Learning, Node, Place, Policy, Run, Scene, WaterWorld,
                   network_d, place_cells)
from neorl.custom import Axis, Modality
from neorl.worlds import Arena
from neorl.core.stream import new_stream
from neorl.gym import WorldEnv, play

TANK = WaterWorld(width=60, n_creeps=2, win_reward=5.0)
MOVES = Actions(("up", "right", "down", "left"), ((0, -1), (1, 0), (0, 1), (-1, 0)))
GRID = Modality("place cell", [Axis("position", along=0, intervals=12), Axis("position", along=1, intervals=4)])
LEARNING = Learning(learning_rate=0.2, memory=3.0)
GOAL = Desire(Place(11.5 / 12, 3.5 / 4), "PC", 1.0)


def square(observation, info):
    """The scene of CliffWalking: the agent's position."""
    row, column = divmod(observation, 12)
    return Scene(((column + 0.5) / 12, (row + 0.5) / 4))


@pytest.mark.parametrize("resets", ["noticed", "unnoticed"])
@pytest.mark.parametrize("world", [TANK, Arena(trial_seconds=2.0)], ids=["tank", "arena"])
def test_an_agent_in_our_environments_repeats_a_run_to_the_bit(world, resets):
    agent = network_d([2, 5]) if world is TANK else Agent(place_cells([5]).nodes, [Desire("platform", "PC", 1.0)])
    agent = replace(agent, resets=resets)
    run = Run(agent, world, seed=4)
    learner = Learner(agent, world.things, world.kinds, world.actions, size=world.size, fps=world.fps)
    learner._record["stream"] = new_stream(np.random.SeedSequence(4, spawn_key=(0,)).spawn(1)[0])
    env = WorldEnv(world, continuing=False)
    played = play(learner, env, lambda observation, info: env.world_state.scene, steps=5_000, seed=4)
    paid = run.advance(5_000)
    assert played.learner is learner and played.rewards.sum() == paid and len(played.returns) > 0
    assert_equal(learner, run)


def test_an_agent_learns_to_walk_beside_a_cliff():
    env = gymnasium.make("CliffWalking-v1")
    agent = Agent([Node("PC", GRID, [12])], [GOAL], LEARNING, Policy(0.05))
    played = play(agent, env, square, steps=10_000, actions=MOVES)
    aimless = play(Agent(agent.nodes, learning=LEARNING), env, square, steps=10_000, actions=MOVES)
    assert played.rewards[-2_000:].sum() / 2 > -3_000 > -6_000 > aimless.rewards[-2_000:].sum()
    assert played.returns.max() > -20  # the shortest path has 13 steps
    assert played.terminated.sum() == len(played.returns) == len(played.lengths) and not played.truncated.any()
    np.testing.assert_array_equal(played.returns, [each.sum() for each in np.split(played.rewards, played.ends)[:-1]])


def test_a_learner_keeps_what_it_knows_when_a_desire_is_added():
    env = gymnasium.make("CliffWalking-v1")
    latent = play(Agent([Node("PC", GRID, [12])], learning=LEARNING), env, square, steps=20_000, actions=MOVES)
    latent.learner.change(Agent(latent.learner.agent.nodes, [GOAL], LEARNING, Policy(0.05)))
    played = play(latent.learner, env, square, steps=1_000)
    assert played.learner is latent.learner and len(played.lengths) > 20 and played.lengths[0] < 60


class Cart(gymnasium.Env):
    """A cart on a line, moved by a continuous action; an episode terminates at the right end."""

    observation_space, action_space = gymnasium.spaces.Box(0, 1, (1,)), gymnasium.spaces.Box(-1, 1, (1,))

    def reset(self, *, seed=None, options=None):
        super().reset(seed=seed)
        self.x, self.clock = 0.15, 0
        return np.array([self.x]), {}

    def step(self, action):
        self.x, self.clock = min(max(self.x + 0.1 * action[0], 0.0), 1.0), self.clock + 1
        return np.array([self.x]), -1.0, self.x > 0.9, self.clock == 100, {}


LINE = Agent([Node("PC", Modality("place cell", [Axis("position")]), [10])], [Desire(Place(0.95, 0.5), "PC", 1.0)],
             LEARNING, Policy(0.1))
# Actions of the tank, for which agents are compiled already; only those along the line move the cart.
COMMANDS = {"actions": CARDINAL, "commands": [np.array([push]) for push in CARDINAL.table[:, 0]]}


def along(observation, info):
    return Scene((*observation, 0.5))


def test_commands_are_what_the_environment_takes_for_actions():
    played = play(LINE, Cart(), along, steps=5_000, **COMMANDS)
    assert played.lengths[-50:].mean() < 15 and played.learner.world.actions == CARDINAL
    mirrored = play(LINE, Cart(), along, steps=1_000, **COMMANDS | {"commands": [[0.0]] * 5})
    assert mirrored.truncated.sum() == 10 and not mirrored.terminated.any()


@pytest.mark.parametrize("reward", [None, np.array([1.0]), np.nan, "1"])
def test_a_reward_that_is_no_number_is_refused(reward):
    env = gymnasium.wrappers.TransformReward(Cart(), lambda _: reward)
    with pytest.raises(ValueError, match="the reward that env.step returns must be a finite number from .*, but is "):
        play(LINE, env, along, steps=2, **COMMANDS)


def test_a_truth_counts_as_a_reward():
    env = gymnasium.wrappers.TransformReward(Cart(), lambda _: True)
    assert play(LINE, env, along, steps=2, **COMMANDS).rewards.tolist() == [1.0, 1.0]


def test_actions_have_the_numbers_of_the_environment_unless_mapped_otherwise():
    unnamed = play(Agent([Node("PC", GRID, [12])]), gymnasium.make("CliffWalking-v1"), square, steps=100)
    assert unnamed.learner.world.actions == Actions(("0", "1", "2", "3"), ((0, 0),) * 4)
    counted = gymnasium.wrappers.TransformAction(gymnasium.make("CliffWalking-v1"), lambda action: int(action) - 3,
                                                 gymnasium.spaces.Discrete(4, start=3))
    named = play(Agent([Node("PC", GRID, [12])]), counted, square, steps=100, actions=MOVES)
    np.testing.assert_array_equal(named.rewards, unnamed.rewards)


def test_an_episode_that_is_cut_off_counts_in_no_total():
    still = COMMANDS | {"commands": [[0.0]] * 5}
    played = play(LINE, Cart(), along, steps=0, **still)
    assert (played.returns.size, played.lengths.size, played.ends.size) == (0, 0, 0)
    played = play(LINE, Cart(), along, steps=250, **still)
    assert played.truncated.nonzero()[0].tolist() == [99, 199] and played.ends.tolist() == [100, 200]
    assert played.returns.tolist() == [-100.0, -100.0] and played.lengths.tolist() == [100, 100]
