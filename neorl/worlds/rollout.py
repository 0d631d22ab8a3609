"""The rollout of an agent in a world: choose, act, advance the world, perceive and learn, step after step.

In `notebooks/companion/one_file.py`, this is `simulate`. A rollout ends early after a step or a reset that broke a rule
of worlds; its `Log` says so.

The kernels of the world are compiled into the rollout, so a user-defined world runs as fast as those of the package.
The agent's kernels are called (`neorl.core.functions`), so they are compiled once for all worlds.
"""

import functools
from typing import NamedTuple

import numpy as np

from neorl.common.checks import LARGEST
from neorl.core.functions import Loop
from neorl.core.layout import Memory, Record
from neorl.core.scene import ABSENT, Scene
from neorl.kernels.annotations import array, fields, tabled
from neorl.kernels.kernel import inlined, inlined_kernel, kernel

MOST_HITS = 32_767  # in a bin, the maximum of its type


@tabled
class Log(NamedTuple):
    """What a rollout writes down: rewards and hits in bins, and in a recording also in frames, with all episodes."""

    clock: array("int64", 3)  # steps taken; 1 after a reset that broke a rule of worlds; episodes ended
    paid: array("float64", 2)  # the reward so far, in all and in this episode
    bin_steps: int
    rewards: array("float32", "bins")
    hits: array("int16", "bins", "kinds")  # things met of each kind, up to `MOST_HITS`
    first_step: int  # of the first frame
    frame_steps: int
    positions: array("float64", "recorded", "axes")  # at the end of a frame
    actions: array("int64", "recorded")  # the last one of a frame, or no frames without a recording
    frame_rewards: array("float64", "recorded")
    frame_hits: array("int64", "recorded", "kinds")
    ends: array("int64", "episodes")  # the step after an episode's last
    returns: array("float64", "episodes")


@inlined_kernel
def is_placed(scene):
    """Whether the agent's place and velocity keep the rules of worlds."""
    for axis in range(scene.position.shape[0]):
        if not (abs(scene.position[axis]) <= LARGEST and abs(scene.velocity[axis]) <= LARGEST):  # NaN too
            return False
    return True


@inlined_kernel
def is_known(scene, thing, n_kinds):
    """Whether the numbers of a thing's kinds keep the rules of worlds."""
    return 0 <= scene.met[thing] <= n_kinds and ABSENT <= scene.kinds[thing] < n_kinds


@inlined_kernel
def count_hits(scene, log, now):
    """Add the things met to the bin and the frame of a step; returns whether the kinds of all keep the rules."""
    for thing in range(scene.met.shape[0]):
        met = scene.met[thing]
        if not is_known(scene, thing, log.hits.shape[1]):
            return False
        if met != 0:
            interval = now // log.bin_steps
            if log.hits[interval, met - 1] < MOST_HITS:
                log.hits[interval, met - 1] += 1
            if log.actions.shape[0] > 0:
                log.frame_hits[(now - log.first_step) // log.frame_steps, met - 1] += 1
    return True


@inlined_kernel
def record_frame(scene, log, now, action, reward):
    """Write a step into its frame."""
    frame = (now - log.first_step) // log.frame_steps
    log.actions[frame] = action
    log.frame_rewards[frame] += reward
    for axis in range(log.positions.shape[1]):
        log.positions[frame, axis] = scene.position[axis]


@inlined_kernel
def keeps_rules(scene, n_kinds):
    """Whether a scene keeps the rules of worlds."""
    for thing in range(scene.met.shape[0]):
        if not is_known(scene, thing, n_kinds):
            return False
    return is_placed(scene)


@inlined_kernel
def begun_again(agent, memory, scene, loop, n_kinds):
    """Begin an episode in the scene that a reset has left; returns whether that keeps the rules."""
    if not keeps_rules(scene, n_kinds):
        return False
    if agent.notices_resets:
        loop.begin(agent, memory, scene, loop.functions)
    return True


@functools.cache
def rollout_in(dynamics):
    """The kernel `rollout` of agents in a world of given `Dynamics`."""
    reset, step = dynamics.reset, inlined(dynamics.step)  # a reset is rare, so it is not inlined
    world_type, rules_type = fields(reset)["state"], fields(reset)["rules"]

    @kernel
    def rollout(agent: Record, memory: Memory, scene: Scene, loop: Loop, world_state: world_type, rules: rules_type,
                log: Log, last_step: int) -> None:
        """Take the steps clock[0] … last_step − 1. A reward that broke a rule takes the place of paid[0]."""
        for now in range(log.clock[0], last_step):
            log.clock[0] = now + 1
            action = loop.act(agent, memory, scene, loop.functions)
            reward, done = step(world_state, rules, action)
            if not abs(reward) <= LARGEST:  # also if it is NaN
                log.paid[0] = reward
                return
            log.paid[0] += reward
            log.paid[1] += reward
            log.rewards[now // log.bin_steps] += np.float32(reward)
            if log.actions.shape[0] > 0:
                record_frame(scene, log, now, action, reward)
            agent.reward = reward
            loop.observe(agent, memory, scene, loop.functions)
            if not is_placed(scene):  # at once, since a later step may put the agent back
                return
            if not count_hits(scene, log, now):
                return
            if done:
                if log.clock[2] < log.ends.shape[0]:
                    log.ends[log.clock[2]], log.returns[log.clock[2]] = now + 1, log.paid[1]
                log.clock[2] += 1
                log.paid[1] = 0.0
                reset(world_state, rules)
                if not begun_again(agent, memory, scene, loop, log.hits.shape[1]):
                    log.clock[1] = 1
                    return

    return rollout
