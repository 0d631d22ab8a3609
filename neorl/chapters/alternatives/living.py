"""Learners and controllers in WaterWorld: one loop for all that are not agents of neorl.

A *contestant* is two kernels, ``act(setting, memory, state, rules)``, which returns the number of an action, and
``learn(setting, memory, state, rules, action, reward, restarted)``, called after the world has moved on. `state` is the
`WaterWorldState` and `rules` are its rules; a learner reads the scene in it alone, a controller all of it. When the
last green creep is taken the board is drawn anew before `learn` is called, with `restarted` true: life goes on.
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
    """How something lives: its kernels, its setting as they take it, and a function (world, stream) of its memory."""

    act: object
    learn: object
    setting: tuple
    new_memory: object


class Lived(NamedTuple):
    """What runs have earned: rewards, float64 (runs, bins); processor seconds of each, (runs,); bytes of its memory."""

    rewards: np.ndarray
    seconds: np.ndarray
    bytes: int


def live(contestant, world, *, steps, runs, bins, seed=0):
    """Let runs of a contestant live for so many steps in a `WaterWorld`, and return what they `Lived`.

    bins: equal parts of a run, as far as steps can be shared out. Run k has the world of
    ``neorl.Run(agent, world, seed, k)`` and draws for itself from a stream of its own.
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

    live_one(0, np.zeros_like(edges))  # compiles, which later calls do not
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
    """What a controller learns."""


BOARDS = {creeps: WaterWorld(n_creeps=creeps) for creeps in (3, 8)}
