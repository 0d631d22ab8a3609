"""The rollout of an agent in a world: choose, act, advance the world, perceive and learn, step after step.

The kernels of the world and the agent's user-defined functions are constants of the compiled code, so a user-defined
world or policy runs as fast as those of the package. Each combination is compiled once (`neorl.core.compile_cache`).
"""

import functools

import numpy as np

from neorl.core import life
from neorl.core.kernel import array, fields, inlined, kernel
from neorl.core.parameters import Parameters
from neorl.core.state import State


MOST_HITS = 32_767  # in a bin, the maximum of its type


@functools.cache
def rollout_in(dynamics, constants):
    """The kernel `rollout` of agents with given `neorl.core.constants.Constants` in a world of given `Dynamics`."""
    reset, step = dynamics.reset, inlined(dynamics.step)
    world_type, rules_type = fields(reset)["state"], fields(reset)["rules"]

    @kernel
    def rollout(parameters: Parameters, state: State, world_state: world_type, rules: rules_type,
                clock: array("int64", 1), last_step: int, total: float, bin_steps: int,
                rewards: array("float32", "bins"), hits: array("int16", "bins", "kinds")) -> float:
        """Take the steps clock[0] … last_step − 1, adding rewards and contacts to the bins of `rewards` and `hits`.

        total: the reward so far; the new total is returned. hits: things met of each kind, up to `MOST_HITS`.
        Stops early, after a step that met a thing of no kind.
        """
        scene = world_state.scene
        for now in range(clock[0], last_step):
            action = life.act(parameters, constants, state, scene)
            reward, done = step(world_state, rules, action)
            state.reward[0] = reward
            life.observe(parameters, constants, state, scene)
            total += reward
            interval = now // bin_steps
            rewards[interval] += np.float32(reward)
            for thing in range(scene.met.shape[0]):
                met = scene.met[thing]
                if met != 0:
                    if met < 0 or met > hits.shape[1]:
                        clock[0] = now + 1
                        return total
                    if hits[interval, met - 1] < MOST_HITS:
                        hits[interval, met - 1] += 1
            if done:
                reset(world_state, rules)
                life.begin(parameters, constants, state, scene)
        clock[0] = last_step
        return total

    return rollout
