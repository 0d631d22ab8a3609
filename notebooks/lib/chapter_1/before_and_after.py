"""An agent before and after learning, on the same boards: the worth of experience in the tank.

A *newborn* knows nothing. A *veteran* is a newborn with the values learned in an earlier run of its own. Both keep
learning. Trials begin on fresh boards, the same for both, which the veteran has never seen.
"""

from concurrent.futures import ThreadPoolExecutor

import numpy as np

from lib.chapter_1.steering import chase
from neorl import checks
from neorl.evidence.statistics import difference, estimate
from neorl.experiments.run import Run


def veteran(agent, world, steps, seed=0, run=0):
    """A run at its beginning, whose agent has the values learned in the first `steps` steps of run `run` of seed + 1.

    Raises ValueError for a bad argument.
    """
    teacher = Run(agent, world, seed + 1, run)
    teacher.advance(steps)
    learner = Run(agent, world, seed, run)
    learner.transfer(teacher)
    return learner


def trials(agent, world, *, lessons, steps, runs, seed=0):
    """The reward of newborns and of veterans in their first steps on the same boards: float64 (2, runs).

    lessons: steps of a veteran's earlier run. steps: of a trial. Raises ValueError for a bad argument.
    """
    def pair(k):
        return Run(agent, world, seed, k).advance(steps), veteran(agent, world, lessons, seed, k).advance(steps)

    with ThreadPoolExecutor() as pool:
        return np.array(list(pool.map(pair, range(checks.integer("runs", runs, at_least=1))))).T


def first_minutes(agent, world, *, lessons, runs, seed=0):
    """Rewards per second of newborns, veterans and the rule in the first minute on the same boards, (runs,) each.

    lessons: steps of a veteran's earlier run. Raises ValueError for a bad argument.
    """
    minute = 60 * world.fps
    newborns, veterans = trials(agent, world, lessons=lessons, steps=minute, runs=runs, seed=seed) / 60
    return newborns, veterans, chase(world, minute, runs, seed) / 60


def leads(agent, world, lives, *, steps, runs, seed=0):
    """The lead of veterans over newborns in their first steps, in reward per second: {lessons: `Estimate`}.

    lives: the values of ``lessons`` to compare, see `trials`. steps: of a trial, ≥ 1. Raises ValueError for a bad
    argument.
    """
    found = {}
    for lessons in lives:
        rewards = trials(agent, world, lessons=lessons, steps=steps, runs=runs, seed=seed)
        before, after = rewards / (steps / world.fps)
        found[lessons] = estimate(difference, after, before)
    return found
