"""The rollout of an agent in a world: choose, act, let the world move on, perceive and learn, step after step.

The kernels of the world and of the agent's own functions are constants of the compiled code, so a world or a policy of
one's own runs as fast as those of the package. Each combination is compiled once (`neorl.core.compile_cache`).
"""

import functools

import numpy as np

from neorl.core import life
from neorl.core.kernel import array, fields, inlined, kernel
from neorl.core.parameters import Parameters
from neorl.core.state import State


MOST_HITS = 32_767  # in a bin, that its type has room for


@functools.cache
def rollout_in(dynamics, constants):
    """The kernel `rollout` of agents with certain `neorl.core.constants.Constants` in a world of certain `Dynamics`."""
    reset, step = dynamics.reset, inlined(dynamics.step)
    world_type, rules_type = fields(reset)["state"], fields(reset)["rules"]

    @kernel
    def rollout(parameters: Parameters, state: State, world_state: world_type, rules: rules_type,
                clock: array("int64", 1), last_step: int, total: float, bin_steps: int,
                rewards: array("float32", "bins"), hits: array("int16", "bins", "kinds")) -> float:
        """Take the steps clock[0] … last_step − 1, adding what they pay to the bins of `rewards` and `hits`.

        total: reward so far, to which theirs is added and returned. hits: things met of each kind, up to `MOST_HITS`.
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
                if scene.met[thing] > 0 and hits[interval, scene.met[thing] - 1] < MOST_HITS:
                    hits[interval, scene.met[thing] - 1] += 1
            if done:
                reset(world_state, rules)
                life.begin(parameters, constants, state, scene)
        clock[0] = last_step
        return total

    return rollout
