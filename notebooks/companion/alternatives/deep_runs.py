"""Deep reinforcement learning in WaterWorld with Stable-Baselines3: the script that makes the stored tables.

1. Methods: DQN and PPO of Stable-Baselines3, and QR-DQN of its contributed package, with two layers of 64 units, on one
   thread. Each is one agent that learns from one stream of experience without episodes.
2. Observation: that of `neorl.gym`, with positions relative to the agent and the nearest creep first, followed by the
   velocity of every creep in that order. The other learners of the page do not observe the creeps' velocities.
   Positions of creeps are multiplied by a tuned factor.
3. Search: the same number of settings is drawn for each method (`companion.alternatives.search`), and each is tried
   once with 3 creeps on a seed of its own. The one that earned most in the last third is used for all runs.
4. Exploration ends after a number of steps, not after a share of a run, so a long run begins like a short one.
5. Claim A10 has first runs of its own, on the board of paper A to the letter, with the libraries' defaults: no setting,
   network or scale of positions is chosen.
6. The first three runs of a method on a board have 600,000 steps, since they take ten minutes each; the others have
   150,000. The arithmetic of PyTorch depends on the processor: on another one, a run may differ from its row after some
   minutes.

The tables are made by ``python -m companion.alternatives.deep_runs search deep_search.csv``, ``… run deep_runs.csv``
and ``… defaults deep_defaults.csv``, which resume when rerun. A run takes minutes, the tables hours; they need
stable-baselines3 and sb3-contrib, which no extra includes.
"""

import sys
import time
from pathlib import Path

import numpy as np

from companion.alternatives.contests import BOARDS, MINUTE, PAPER_A, Row, read, write
from companion.alternatives.search import (DEEP, DEEP_SETTINGS, DEEP_STEPS, SEED, WITH_DEFAULTS, append, best_settings,
                                           setting_of)
from companion.alternatives.search import read as read_search
from companion.thesis.reading import LENGTHS
from neorl.common.extras import require

gymnasium = require("gymnasium", extra="gym")

LAYERS = (64, 64)
FASTEST_CREEP = 0.25  # sizes of the world per second
# (creeps, steps, runs) in the order of computation; the methods take turns.
PLAN = ((3, 600_000, 3), (8, 600_000, 3), (3, 150_000, 10), (8, 150_000, 10))
DEFAULT_RUNS = 10  # of each method with defaults, as long as those of paper A


class Sight(gymnasium.Wrapper):
    """The environment with creeps' velocities in its observations, and a record of the reward of each minute.

    Its world is that of ``neorl.Run(agent, world, seed, run)``. scale: factor on creeps' positions.
    """

    def __init__(self, env, steps, seed, run, scale=1.0):
        super().__init__(env)
        self._scale = np.ones(env.observation_space.shape, np.float32)
        for axis in range(2):
            self._scale[4 + axis::4] = scale  # after the agent's place and velocity: place and kind of each creep
        self._start = {"seed": seed, "options": {"run": run}}
        self.rewards, self._now = np.zeros(-(-steps // MINUTE)), 0
        creeps = env.unwrapped.world.n_creeps
        low, high = (np.append(self._scale * end, np.full(2 * creeps, sign, np.float32)) for end, sign in
                     ((env.observation_space.low, -1), (env.observation_space.high, 1)))
        self.observation_space = gymnasium.spaces.Box(low, high)

    def reset(self, **_):
        """Reset to the run's own world, whatever seed the library draws."""
        observation, info = self.env.reset(**self._start)
        return self._with_velocities(observation), info

    def step(self, action):
        """Take a step of the world, and add its reward to that of the current minute."""
        observation, reward, *others = self.env.step(int(action))
        if self._now // MINUTE < len(self.rewards):
            self.rewards[self._now // MINUTE] += reward
        self._now += 1
        return self._with_velocities(observation), reward, *others

    def _with_velocities(self, observation):
        state, size = self.env.unwrapped.world_state, self.env.unwrapped.world.size
        nearest_first = np.argsort(((state.scene.things - state.scene.position) ** 2).sum(axis=1), kind="stable")
        velocity = (state.direction * state.speed[:, None])[nearest_first] / size / FASTEST_CREEP
        return np.concatenate([self._scale * observation, velocity.ravel()], dtype=np.float32)


def train(method, settings, board, steps, seed, run):
    """Train a deep learner: (reward of each minute; processor seconds; kB of networks, optimiser and experience).

    settings: of the search, or {} for the library's defaults.
    """
    import torch
    torch.set_num_threads(1)
    env = gymnasium.make("neorl.gym:neorl/WaterWorld-v0", world=board, max_episode_steps=-1)
    settings = dict(settings)
    sight = Sight(env, steps, seed, run, settings.pop("position_scale", 1.0))
    model = _model(method, _chosen(method, settings, steps) if settings else {}, sight, seed * 1_000 + run)
    began = time.process_time()
    model.learn(steps)
    return sight.rewards, time.process_time() - began, _kilobytes(model)


def _model(method, chosen, env, seed):
    import sb3_contrib
    import stable_baselines3
    kind = {"DQN": stable_baselines3.DQN, "PPO": stable_baselines3.PPO, "QR-DQN": sb3_contrib.QRDQN}[method]
    return kind("MlpPolicy", env, seed=seed, device="cpu", **chosen)


def _chosen(method, settings, steps):
    """The arguments by which a model of the library departs from its defaults."""
    network = {"net_arch": list(LAYERS)}
    if method != "PPO":
        settings["exploration_fraction"] = settings.pop("exploration_steps") / steps  # above 1 if the run ends first
        settings["learning_starts"] = 1_000
    if method == "QR-DQN":
        network["n_quantiles"] = 25
    return {"policy_kwargs": network, **settings}


def _kilobytes(model):
    import torch
    tensors = list(model.policy.state_dict().values())
    tensors += [value for of in model.policy.optimizer.state.values() for value in of.values()
                if isinstance(value, torch.Tensor)]
    buffer = getattr(model, "replay_buffer", None) or model.rollout_buffer
    arrays = [value for value in vars(buffer).values() if isinstance(value, np.ndarray)]
    return (sum(each.element_size() * each.nelement() for each in tensors) + sum(each.nbytes for each in arrays)) / 1e3


def search(path):
    """Try `DEEP_SETTINGS` settings of each method, and append their rewards to the table at `path`."""
    done = {row[:2] for row in read_search(path)} if Path(path).exists() else set()
    for number in range(DEEP_SETTINGS):
        for method in DEEP:
            if (method, number) not in done:
                rewards, _, _ = train(method, setting_of(method, number), BOARDS[3], DEEP_STEPS, SEED, number)
                third = rewards[-len(rewards) // 3:]
                append(path, method, number, third.sum() / (60 * len(third)))


def run_all(path):
    """Compute the runs of `PLAN` that the table at `path` does not have at that length, with the settings found."""
    for creeps, steps, runs in PLAN:
        _compute(path, {method: best_settings()[method] for method in DEEP}, BOARDS[creeps], steps, runs)


def run_defaults(path):
    """Compute the runs on the board of paper A that the table at `path` does not have, with defaults."""
    _compute(path, dict.fromkeys(WITH_DEFAULTS, {}), PAPER_A, LENGTHS["A"], DEFAULT_RUNS)


def _compute(path, settings, board, steps, runs):
    done = {(row.method, row.creeps, row.run): row.steps for row in read(path)} if Path(path).exists() else {}
    for run in range(runs):
        for method in settings:
            if done.get((method, board.n_creeps, run), 0) < steps:
                write(path, [row_of(method, settings[method], board, steps, run)])


def row_of(method, settings, board, steps, run):
    """Compute one run: a `Row`."""
    rewards, seconds, kilobytes = train(method, settings, board, steps, 0, run)
    return Row(method, board.n_creeps, steps, run, seconds, kilobytes, rewards)


if __name__ == "__main__":
    {"search": search, "run": run_all, "defaults": run_defaults}[sys.argv[1]](*sys.argv[2:])
