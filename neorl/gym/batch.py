"""The compiled step of many environments of one world.

The state of the batch is the `State` of the world with an additional first dimension; every environment is a row of it.
"""

import functools
from typing import NamedTuple

from neorl.common.checks import LARGEST
from neorl.gym.observation import observe
from neorl.kernels.annotations import array, fields, is_tuple
from neorl.kernels.kernel import inlined, inlined_kernel, kernel, kernel_maker
from neorl.worlds.rollout import keeps_rules


class Task(NamedTuple):
    """The constants of a batch of environments."""

    size: float
    n_kinds: int
    egocentric: bool
    continuing: bool  # when an episode of the world ends, another begins and the environment goes on
    timed: bool  # an episode of the world in which nothing terminal is met ends by a limit of time
    last_step: int  # of an episode, after which it is truncated


class Slots(NamedTuple):
    """The inputs and outputs of a batch of environments."""

    action: array("int64", "environments")  # ignored if the episode was over
    clock: array("int64", "environments")  # steps since the episode began
    observation: array("float32", "environments", "numbers")
    reward: array("float64", "environments")
    terminated: array("bool", "environments")
    truncated: array("bool", "environments")
    met: array("int64", "environments", "kinds")  # things met in this step
    restarted: array("bool", "environments")  # whether the world has begun an episode in this step
    terminal: array("bool", "kinds")  # see `World.terminal`
    distance: array("float64", "things")  # working memory
    order: array("int64", "things")  # working memory


@kernel_maker
def batch_step(dynamics):
    """The kernel that steps many environments of a world with given `Dynamics`, or begins episodes where one is over.

    It returns −1, or the first environment whose step or reset broke a rule of worlds, and stops there.
    """
    reset, step, row_of = dynamics.reset, inlined(dynamics.step), rows_of(fields(dynamics.reset)["state"])

    @kernel
    def batch_step(states, rules, task, slots):
        for i in range(slots.action.shape[0]):
            state = row_of(states, i)
            scene = state.scene
            slots.restarted[i] = slots.terminated[i] or slots.truncated[i]
            slots.reward[i], slots.terminated[i], slots.truncated[i] = 0.0, False, False
            for kind in range(task.n_kinds):
                slots.met[i, kind] = 0
            if slots.restarted[i]:
                reset(state, rules)
                slots.clock[i] = 0
            else:
                slots.reward[i], done = step(state, rules, slots.action[i])
                if not abs(slots.reward[i]) <= LARGEST:
                    return i
                at_goal = not task.timed
                if not keeps_rules(scene, task.n_kinds):
                    return i
                for thing in range(scene.met.shape[0]):
                    met = scene.met[thing]
                    if met != 0:
                        slots.met[i, met - 1] += 1
                        at_goal = at_goal or slots.terminal[met - 1]
                if done and task.continuing:
                    reset(state, rules)
                    slots.restarted[i] = True
                slots.clock[i] += 1
                slots.terminated[i] = done and at_goal and not task.continuing
                slots.truncated[i] = (done and not at_goal and not task.continuing
                                      or slots.clock[i] >= task.last_step)
            if slots.restarted[i] and not keeps_rules(scene, task.n_kinds):
                return i
            if not observe(scene, task.size, task.n_kinds, task.egocentric, slots.distance, slots.order,
                           slots.observation[i]):
                return i
        return -1

    return batch_step


@functools.cache
def rows_of(kind):
    """The kernel (states, i) that returns the state of environment i, of a given type, from those of all."""
    scope = {"__name__": __name__}
    exec(f"def row_of(states, i):\n    return {_row(kind, 'states', scope)}", scope)
    return inlined_kernel(scope["row_of"])


def _row(kind, path, scope):
    """The expression for a row of a named tuple of arrays."""
    made = f"kind_{len(scope)}"
    scope[made] = kind
    rows = (_row(each, f"{path}.{name}", scope) if is_tuple(each) else f"{path}.{name}[i]"
            for name, each in fields(kind).items())
    return f"{made}({', '.join(rows)})"
