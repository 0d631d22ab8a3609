"""Many environments of one world side by side: their states, and the compiled step that advances them all.

The state of the batch is the `State` of the world with an additional first dimension; every environment is a row of it.
A single environment is a batch of one, so it runs bit-identically.
"""

import functools
from typing import NamedTuple

import numpy as np

from neorl import checks
from neorl.checks import LARGEST
from neorl.core.kernel import (arrays, execute, fields, inlined, inlined_kernel, is_tuple, kernel, kernel_maker,
                               mapped, new_tuple)
from neorl.core.stream import new_stream
from neorl.gym.observation import observe
from neorl.worlds.arena import Arena, ArenaRules, ArenaState
from neorl.worlds.world import World, check_outcome

MOST_NUMBERS = 2**28  # in the observations of a batch, 1 GiB


class Task(NamedTuple):
    """The constants of a batch of environments."""

    size: float
    n_kinds: int
    egocentric: bool
    continuing: bool  # when an episode of the world ends, another begins and the environment goes on
    same_step: bool  # an environment whose episode is over begins another in the same step
    last_step: int  # of an episode, after which it is truncated


class Slots(NamedTuple):
    """The inputs and outputs of a batch of environments."""

    action: np.ndarray  # int64 (environments,)
    begins: np.ndarray  # bool (environments,): whether an environment begins an episode instead of acting
    clock: np.ndarray  # int64 (environments,): steps since its episode began
    observation: np.ndarray  # float32 (environments, numbers)
    last_observation: np.ndarray  # the same, of an episode that ended in this step
    reward: np.ndarray  # float64 (environments,)
    terminated: np.ndarray  # bool (environments,)
    truncated: np.ndarray  # bool (environments,)
    met: np.ndarray  # int64 (environments, kinds): things met in this step
    restarted: np.ndarray  # bool (environments,): whether the world has begun an episode in this step
    distance: np.ndarray  # float64 (things,), working memory
    order: np.ndarray  # int64 (things,), working memory


class Batch:
    """Environments of one world side by side.

    world: a `neorl.World`. n: number of environments, ≥ 1. egocentric, continuing, same_step, last_step: see `Task`.
    Raises ValueError for anything else, and for more than 2²⁸ numbers in their observations.
    """

    def __init__(self, world, n, egocentric, continuing, same_step=False, last_step=None):
        checks.instance("world", world, World)
        n, self.world = checks.integer("num_envs", n, at_least=1), world
        axes, kinds = world.actions.axes, len(world.kinds)
        numbers = 2 * axes + world.things * (axes + kinds)
        if n * numbers > MOST_NUMBERS:
            raise checks.error("num_envs", f"at most {MOST_NUMBERS // numbers}, of {numbers} numbers each", n)
        last_step = 2**62 if last_step is None else checks.integer("max_episode_steps", last_step, at_least=1)
        self.task = Task(float(world.size), kinds, checks.flag("egocentric", egocentric),
                         checks.flag("continuing", continuing), same_step, last_step)
        self.step_kernel = batch_step(world.dynamics, time_is_up_in(world))
        self.states = mapped(lambda each: np.zeros((n, *each.shape), each.dtype),
                             new_tuple(world.State, world.sizes, {}))
        self.slots = Slots(np.zeros(n, np.int64), np.ones(n, bool), np.zeros(n, np.int64),
                           np.zeros((n, numbers), np.float32), np.zeros((n, numbers), np.float32), np.zeros(n),
                           np.zeros(n, bool), np.zeros(n, bool), np.zeros((n, kinds), np.int64), np.zeros(n, bool),
                           np.zeros(world.things), np.zeros(world.things, np.int64))

    def seed(self, row, sequence):
        """Seed the stream of an environment, from its next episode on, with a `numpy.random.SeedSequence`."""
        for each in arrays(self.states).values():
            each[row] = 0
        self.states.stream[row] = new_stream(sequence)

    def begin(self, rows):
        """Begin an episode in the environments that `rows` marks, bool (environments,), by the present rules."""
        self.rules = self.world.rules
        self.slots.begins[:] = rows
        self._run(False)

    def step(self):
        """Take the actions of `slots.action`, or begin an episode where `slots.begins` is True."""
        self._run(True)

    def _run(self, acts):
        row = execute(self.step_kernel, self.states, self.rules, self.task, self.slots, acts)
        if row >= 0:
            slots, dynamics = self.slots, self.world.dynamics
            has_begun = slots.clock[row] == 0 and (slots.terminated[row] or slots.truncated[row])
            check_outcome(self.world, dynamics.reset if has_begun or slots.restarted[row] else dynamics.step,
                          mapped(lambda each: each[row].copy(), self.states), float(slots.reward[row]))

    def state_of(self, row):
        """The state of one environment, as read-only views."""
        def view(each):
            each = each[row]
            each.flags.writeable = False
            return each

        return mapped(view, self.states)


@kernel
def never(state, rules):
    """For worlds without a time limit of their own."""
    return False


@kernel
def arena_time_is_up(state: ArenaState, rules: ArenaRules):
    """Whether a trial in an arena that is over ended by its time limit."""
    met = 0
    for place in range(state.scene.met.shape[0]):
        met += state.scene.met[place] > 0
    return not (rules.ends and met > 0)


def time_is_up_in(world):
    """The kernel (state, rules) that returns whether an episode that is over was truncated, not terminated."""
    return arena_time_is_up if isinstance(world, Arena) else never


@kernel_maker
def batch_step(dynamics, time_is_up):
    """The kernel that steps many environments of a world with given `Dynamics`.

    It returns −1, or the first environment whose step or reset broke a rule of worlds, and stops there.
    """
    reset, step, row_of = dynamics.reset, inlined(dynamics.step), rows_of(fields(dynamics.reset)["state"])

    @kernel
    def batch_step(states, rules, task, slots, acts):
        for i in range(slots.action.shape[0]):
            state = row_of(states, i)
            scene = state.scene
            if slots.begins[i] or acts:
                slots.reward[i], slots.terminated[i], slots.truncated[i] = 0.0, False, False
                slots.restarted[i] = slots.begins[i]
                for kind in range(task.n_kinds):
                    slots.met[i, kind] = 0
                if slots.begins[i]:
                    reset(state, rules)
                    slots.clock[i] = 0
                else:
                    slots.reward[i], done = step(state, rules, slots.action[i])
                    if not abs(slots.reward[i]) <= LARGEST:
                        return i
                    for thing in range(scene.met.shape[0]):
                        met = scene.met[thing]
                        if met < 0 or met > task.n_kinds:
                            return i
                        if met != 0:
                            slots.met[i, met - 1] += 1
                    if done and task.continuing:
                        reset(state, rules)
                        slots.restarted[i] = True
                    elif done:
                        slots.truncated[i] = time_is_up(state, rules)
                        slots.terminated[i] = not slots.truncated[i]
                    slots.clock[i] += 1
                    slots.truncated[i] = slots.truncated[i] or slots.clock[i] >= task.last_step
                    over = slots.terminated[i] or slots.truncated[i]
                    if over and task.same_step:
                        if not observe(scene, task.size, task.n_kinds, task.egocentric, slots.distance, slots.order,
                                       slots.last_observation[i]):
                            return i
                        reset(state, rules)
                        slots.clock[i] = 0
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
