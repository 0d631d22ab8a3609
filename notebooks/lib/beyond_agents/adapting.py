"""Gains and recursion weights that adapt to reward while the agent learns: future work of paper C.

Simultaneous perturbation (Spall 1992): a run is divided into pairs of segments. In one segment of a pair each parameter
is raised or lowered at random, all at once; in the other, each moves the opposite way. Their order is random, since a
learning agent earns more later. Each parameter then moves in proportion to the difference in reward. Only reward is
observed, and nothing learned is forgotten. Without this move the parameters are merely *shaken*; the gain from shaking
alone has to be subtracted from the gain from adapting.
"""

from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

import numpy as np

from neorl.agents.papers import multimodal, network_d
from neorl.experiments.run import Run
from neorl.worlds.waterworld import WaterWorld

SEGMENT = 1_000  # steps
SPREAD, RATE = 0.5, 0.5  # of a perturbation; of a move, for a slope of 1: reward per second per unit of the parameter
HIGHEST = 4.0  # bound on the magnitude of a parameter
THREADS = 2
FIXED, SHAKEN, ADAPTED = "fixed", "shaken", "adapted"


@dataclass(frozen=True)
class Adaptable:
    """An agent with parameters that can adapt.

    agent_of: function from the parameters, numbers, to an `Agent`. names: of the parameters. start: their first values.
    """

    agent_of: object
    names: tuple[str, ...]
    start: tuple[float, ...]


def _gains(octaves):
    """Gains of places and objects, whose ratio is 4 to the power of `octaves`."""
    return {"place_gain": 2.0**octaves, "object_gain": 2.0**-octaves}


RATIO = "log₄ of the ratio of place gain to object gain"
ADAPTABLE = {
    "paper B, places and objects": Adaptable(lambda octaves: multimodal(**_gains(octaves)), (RATIO,), (-1.0,)),
    "paper C, network D": Adaptable(lambda octaves, weight: network_d(**_gains(octaves), recursion=weight),
                                    (RATIO, "recursion weight"), (0.0, -1.0))}


def adapt(adaptable, steps, seed=0, run=0, rate=RATE):
    """One run with adapting parameters: their path, and the reward per second of each segment.

    Returns the parameters before each pair of segments and at the end, float64 (pairs + 1, parameters), and the
    rewards, (2 · pairs,); see `pairs_in`.
    """
    now, rng = np.array(adaptable.start), np.random.default_rng([seed, run])
    life = Run(adaptable.agent_of(*now), WaterWorld(), seed, run)
    path, rewards, seconds = [now], [], SEGMENT / life.world.fps
    for _ in range(pairs_in(steps)):
        signs, gained = rng.choice([-1.0, 1.0], len(now)), 0.0
        for way in rng.permutation([1.0, -1.0]):
            life.change(adaptable.agent_of(*_within(now + way * SPREAD * signs)))
            rewards.append(life.advance(SEGMENT) / seconds)
            gained += way * rewards[-1]
        now = _within(now + rate * gained / (2 * SPREAD) * signs)
        path.append(now)
    return np.array(path), np.array(rewards)


def pairs_in(steps):
    """Number of pairs of segments in a run of about `steps` steps, at least one."""
    return max(1, round(steps / (2 * SEGMENT)))


def _within(parameters):
    return np.clip(parameters, -HIGHEST, HIGHEST)


def lives(steps, runs, seed=0):
    """Runs of every `ADAPTABLE` agent with fixed, shaken and adapted parameters.

    Returns {name: {way: (paths, float64 (runs, pairs + 1, parameters), rewards, float64 (runs, 2 · pairs))}}.
    """
    ways = {FIXED: None, SHAKEN: 0.0, ADAPTED: RATE}

    def live_one(adaptable, rate, run):
        return _fixed(adaptable, steps, seed, run) if rate is None else adapt(adaptable, steps, seed, run, rate)

    with ThreadPoolExecutor(THREADS) as pool:
        begun = {(name, way): [pool.submit(live_one, adaptable, rate, run) for run in range(runs)]
                 for name, adaptable in ADAPTABLE.items() for way, rate in ways.items()}
        found = {key: [np.array(each) for each in zip(*(future.result() for future in futures))]
                 for key, futures in begun.items()}
    return {name: {way: tuple(found[name, way]) for way in ways} for name in ADAPTABLE}


def _fixed(adaptable, steps, seed, run):
    """The same as `adapt`, of an agent with fixed parameters."""
    life, pairs = Run(adaptable.agent_of(*adaptable.start), WaterWorld(), seed, run), pairs_in(steps)
    rewards = [life.advance(SEGMENT) * life.world.fps / SEGMENT for _ in range(2 * pairs)]
    return np.tile(np.array(adaptable.start), (pairs + 1, 1)), np.array(rewards)


def last_third(rewards):
    """Reward per second of each run in the last third: float64 (runs,). rewards: float64 (runs, segments)."""
    return rewards[:, -max(1, rewards.shape[1] // 3):].mean(axis=1)
