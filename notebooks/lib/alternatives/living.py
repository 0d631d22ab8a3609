"""The run loop for learners and controllers in WaterWorld that are not agents of neorl.

A *contestant* is two kernels, ``act(setting, memory, state, rules)``, which returns the number of an action, and
``learn(setting, memory, state, rules, action, reward, restarted)``, called after the world's step. `state` is the
`WaterWorldState` and `rules` are its rules; a learner reads only the scene in it, a controller all of it. When the last
green creep is captured the board is reset before ``learn`` is called, with `restarted` true, and learning continues.
"""

import functools
from concurrent.futures import ThreadPoolExecutor
from time import thread_time
from typing import NamedTuple

import numpy as np

from neorl.core.kernel import arrays, execute, inlined, kernel
from neorl.core.stream import new_stream
from neorl.worlds import waterworld
from neorl.worlds.waterworld import WaterWorld

THREADS = 2


class Contestant(NamedTuple):
    """A learner or controller: its kernels, their setting, and a function (world, stream) that makes its memory."""

    act: object
    learn: object
    setting: tuple
    new_memory: object


class Lived(NamedTuple):
    """Results of runs: rewards, float64 (runs, bins); processor seconds of each, (runs,); bytes of a memory."""

    rewards: np.ndarray
    seconds: np.ndarray
    bytes: int


def live(contestant, world, *, steps, runs, bins, seed=0):
    """Run a contestant in a `WaterWorld`: `Lived`.

    steps: of each run. bins: parts of a run, as equal as whole steps allow. Run k has the world of
    ``neorl.Run(agent, world, seed, k)``; the contestant draws from a random stream of its own.
    """
    kernel_of_life = _life_of(contestant.act, contestant.learn)
    edges = np.linspace(0, steps, bins + 1).round().astype(int)
    rewards, seconds, sizes = np.zeros((runs, bins)), np.zeros(runs), np.zeros(runs, int)

    def live_one(run, edges=edges):
        state = world.reset(np.random.SeedSequence(seed, spawn_key=(run,)))
        memory = contestant.new_memory(world, new_stream(np.random.SeedSequence(seed, spawn_key=(run, 1))))
        sizes[run] = sum(each.nbytes for each in arrays(memory).values())
        began = thread_time()
        execute(kernel_of_life, contestant.setting, memory, state, world.rules, edges, rewards[run])
        seconds[run] = thread_time() - began

    live_one(0, np.zeros_like(edges))  # compiles the kernel before calls are timed
    with ThreadPoolExecutor(THREADS) as pool:
        list(pool.map(live_one, range(runs)))
    return Lived(rewards, seconds, int(sizes[0]))


@functools.cache
def _life_of(act, learn):
    act, learn, step = inlined(act), inlined(learn), inlined(waterworld.step)

    @kernel
    def life(setting, memory, state, rules, edges, rewards):
        for part in range(rewards.shape[0]):
            for _ in range(edges[part], edges[part + 1]):
                action = act(setting, memory, state, rules)
                reward, done = step(state, rules, action)
                if done:
                    waterworld.reset(state, rules)
                learn(setting, memory, state, rules, action, reward, done)
                rewards[part] += reward

    return life


@kernel
def learn_nothing(setting, memory, state, rules, action, reward, restarted):
    """Do nothing: a controller does not learn."""


BOARDS = {creeps: WaterWorld(n_creeps=creeps) for creeps in (3, 8)}
