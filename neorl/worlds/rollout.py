"""The rollout of an agent in a world: choose, act, advance the world, perceive and learn, step after step.

In `notebooks/companion/one_file.py`, this is `simulate`. There are two: `rollout` adds up rewards and contacts, and
`recorded` writes down where the agent was as well. Both end early after a step or a reset that broke a rule of worlds;
clock[1] is then 1 for a reset.

The kernels of the world are compiled into the rollout, so a user-defined world runs as fast as those of the package.
The agent's kernels are called (`neorl.core.called`), so they are compiled once for all worlds.
"""

import functools

import numpy as np

from neorl.checks import LARGEST
from neorl.core.called import Life
from neorl.core.kernel import array, fields, inlined, inlined_kernel, kernel
from neorl.core.record import Memory, Record
from neorl.core.scene import ABSENT, Scene

MOST_HITS = 32_767  # in a bin, the maximum of its type
MOST_RECORDED = 2**63 - 1  # in a frame, likewise


@inlined_kernel
def is_placed(scene):
    """Whether the agent's place and velocity keep the rules of worlds."""
    for axis in range(scene.position.shape[0]):
        if not (abs(scene.position[axis]) <= LARGEST and abs(scene.velocity[axis]) <= LARGEST):
            return False
    return True


@inlined_kernel
def is_known(scene, thing, n_kinds):
    """Whether the numbers of a thing's kinds keep the rules of worlds."""
    return 0 <= scene.met[thing] <= n_kinds and ABSENT <= scene.kinds[thing] < n_kinds


@inlined_kernel
def observed(agent, memory, scene, life, reward, hits, interval, most):
    """Perceive the outcome of an action, learn from it, and add the things met to hits[interval], up to `most` each.

    Returns whether the scene keeps the rules; counting ends at the first thing that does not.
    """
    agent.reward = reward
    life.observe(agent, memory, scene, life.calls)
    if not is_placed(scene):  # at once, since a later step may put the agent back
        return False
    for thing in range(scene.met.shape[0]):
        met = scene.met[thing]
        if not is_known(scene, thing, hits.shape[1]):
            return False
        if met != 0 and hits[interval, met - 1] < most:
            hits[interval, met - 1] += 1
    return True


@inlined_kernel
def keeps_rules(scene, n_kinds):
    """Whether a scene keeps the rules of worlds."""
    for thing in range(scene.met.shape[0]):
        if not is_known(scene, thing, n_kinds):
            return False
    return is_placed(scene)


@inlined_kernel
def begun_again(agent, memory, scene, life, n_kinds):
    """Begin an episode in the scene that a reset has left; returns whether that keeps the rules."""
    if not keeps_rules(scene, n_kinds):
        return False
    if agent.notices_resets:
        life.begin(agent, memory, scene, life.calls)
    return True


@functools.cache
def rollout_in(dynamics):
    """The kernel `rollout` of agents in a world of given `Dynamics`."""
    reset, step = dynamics.reset, inlined(dynamics.step)
    world_type, rules_type = fields(reset)["state"], fields(reset)["rules"]

    @kernel
    def rollout(agent: Record, memory: Memory, scene: Scene, life: Life,
                world_state: world_type, rules: rules_type, clock: array("int64", 2), last_step: int, total: float,
                bin_steps: int, rewards: array("float32", "bins"), hits: array("int16", "bins", "kinds")) -> float:
        """Take the steps clock[0] … last_step − 1, adding rewards and contacts to the bins of `rewards` and `hits`.

        total: the reward so far; the new total is returned. hits: things met of each kind, up to `MOST_HITS`.
        Stops early after a step that broke a rule of worlds; a reward that did is returned in place of the total.
        """
        for now in range(clock[0], last_step):
            action = life.act(agent, memory, scene, life.calls)
            reward, done = step(world_state, rules, action)
            if not abs(reward) <= LARGEST:
                clock[0] = now + 1
                return reward
            total += reward
            interval = now // bin_steps
            rewards[interval] += np.float32(reward)
            if not observed(agent, memory, scene, life, reward, hits, interval, MOST_HITS):
                clock[0] = now + 1
                return total
            if done:
                reset(world_state, rules)
                if not begun_again(agent, memory, scene, life, hits.shape[1]):
                    clock[0], clock[1] = now + 1, 1
                    return total
        clock[0] = last_step
        return total

    return rollout


@functools.cache
def recorded_in(dynamics):
    """The kernel `recorded`, which takes the same steps as that of `rollout_in`, and records them."""
    reset, step = dynamics.reset, inlined(dynamics.step)
    world_type, rules_type = fields(reset)["state"], fields(reset)["rules"]

    @kernel
    def recorded(agent: Record, memory: Memory, scene: Scene, life: Life,
                 world_state: world_type, rules: rules_type, clock: array("int64", 2), last_step: int,
                 first_step: int, every: int, paid: array("float64", 2), positions: array("float64", "frames", "axes"),
                 actions: array("int64", "frames"), rewards: array("float64", "frames"),
                 hits: array("int64", "frames", "kinds"), ends: array("int64", "episodes"),
                 returns: array("float64", "episodes")) -> int:
        """Take the steps clock[0] … last_step − 1; frames have `every` steps each, from first_step on.

        paid: the reward so far, in all and in this episode. Returns the number of episodes that have ended.
        Stops early as `rollout` does, with a reward that broke a rule in paid[0].
        """
        episodes = 0
        for now in range(clock[0], last_step):
            frame = (now - first_step) // every
            actions[frame] = life.act(agent, memory, scene, life.calls)
            reward, done = step(world_state, rules, actions[frame])
            if not abs(reward) <= LARGEST:
                clock[0], paid[0] = now + 1, reward
                return episodes
            rewards[frame] += reward
            paid[0] += reward
            paid[1] += reward
            for axis in range(positions.shape[1]):
                positions[frame, axis] = scene.position[axis]
            if not observed(agent, memory, scene, life, reward, hits, frame, MOST_RECORDED):
                clock[0] = now + 1
                return episodes
            if done:
                ends[episodes], returns[episodes], paid[1] = now + 1, paid[1], 0.0
                episodes += 1
                reset(world_state, rules)
                if not begun_again(agent, memory, scene, life, hits.shape[1]):
                    clock[0], clock[1] = now + 1, 1
                    return episodes
        clock[0] = last_step
        return episodes

    return recorded
