"""Many environments of one world in one compiled step.

They equal those of `neorl.gym.environment`, to the last bit, and follow Gymnasium's rules for `VectorEnv`s: environment
i of a seed is that of seed + i; an environment whose episode is over begins the next one in the following step, in
which its action is ignored (mode `NEXT_STEP`).
"""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from neorl.agents.memory import read_only
from neorl.common import checks
from neorl.common.alone import Alone
from neorl.common.extras import require
from neorl.common.warn import warn
from neorl.core.stream import new_stream
from neorl.description import restored
from neorl.gym.batch import Slots, Task, batch_step
from neorl.gym.observation import observation_space
from neorl.kernels.annotations import arrays, mapped, new_tuple
from neorl.kernels.execution import execute
from neorl.worlds.waterworld import WaterWorld
from neorl.worlds.world import World, check_outcome, checked_rules

gymnasium = require("gymnasium", extra="gym")
REMEDY = "use another environment"  # instead of a call within a call
MOST_NUMBERS = 2**28  # in the observations of all environments, 1 GiB


class VectorWorldEnv(gymnasium.vector.VectorEnv):
    """Many environments of one world in one compiled step; see the module.

    world, render_mode, egocentric, continuing, fields: as in `neorl.gym.environment.WorldEnv`. num_envs: the number of
    environments, ≥ 1. max_episode_steps: after which an episode is truncated, ≥ 1; or None or −1, as Gymnasium writes
    it, for no limit.

    Raises ValueError for anything else, and for more than 2²⁸ numbers in all observations.
    """

    metadata = {"render_modes": ["rgb_array"], "autoreset_mode": gymnasium.vector.AutoresetMode.NEXT_STEP}

    def __init__(self, world: World | str, num_envs: int = 1, max_episode_steps: int | None = None,
                 render_mode: str | None = None, egocentric: bool = True, continuing: bool | None = None,
                 **fields: Any) -> None:
        if isinstance(world, str):
            world = restored({"is": world, **fields}, World, "world")
        elif fields:
            raise ValueError(f"fields must be left out beside a World, which has its own, but are {', '.join(fields)}")
        self.world = world = checks.instance("world", world, World)
        self.num_envs = n = checks.integer("num_envs", num_envs, at_least=1)
        axes, kinds = world.actions.axes, len(world.kinds)
        numbers = 2 * axes + world.things * (axes + kinds)
        if n * numbers > MOST_NUMBERS:
            raise checks.error("num_envs", f"at most {MOST_NUMBERS // numbers}, of {numbers} numbers each", n)
        is_endless = max_episode_steps is None or isinstance(max_episode_steps, int) and max_episode_steps == -1
        last_step = 2**62 if is_endless else checks.integer("max_episode_steps", max_episode_steps, at_least=1)
        continuing = isinstance(world, WaterWorld) if continuing is None else checks.flag("continuing", continuing)
        self.render_mode = checks.one_of("render_mode", render_mode, (None, *self.metadata["render_modes"]))
        self.metadata = {**self.metadata, "render_fps": world.fps}
        batch_space = gymnasium.vector.utils.batch_space
        self.single_observation_space = observation_space(world, checks.flag("egocentric", egocentric))
        self.single_action_space = gymnasium.spaces.Discrete(len(world.actions.all_names))
        self.observation_space = batch_space(self.single_observation_space, n)
        self.action_space = batch_space(self.single_action_space, n)
        self._task = Task(float(world.size), kinds, egocentric, continuing, world.terminal is not None, last_step)
        self._step = batch_step(world.dynamics)
        self._states = mapped(lambda each: np.zeros((n, *each.shape), each.dtype),
                              new_tuple(world.State, world.sizes, {}))
        sizes = {"environments": n, "numbers": numbers, "kinds": kinds, "things": world.things}
        self.slots = new_tuple(Slots, sizes, {})
        self.slots.terminal[:] = world.terminal or False
        self._begun, self._alone = False, Alone(REMEDY)

    @property
    def world_states(self) -> tuple[Any, ...]:
        """The states of the worlds, one for each environment, as read-only views: a tuple."""
        return tuple(mapped(lambda each: read_only(each[row]), self._states)  # noqa: B023, called at once
                     for row in range(self.num_envs))

    def reset(self, *, seed: int | Sequence[int | None] | None = None,
              options: Mapping[str, Any] | None = None) -> tuple[NDArray[np.float32], dict[str, Any]]:
        """Begin an episode in every environment.

        seed: an integer ≥ 0, with seed + i for environment i; a list of one for each; or None to continue the streams.
        options: None, or with a seed {"run": k}, k ≥ 0, as in `WorldEnv.reset`.
        Returns (observations: float32 (num_envs, numbers), infos). Raises ValueError for anything else.
        """
        single = None if seed is None or isinstance(seed, list | tuple) else checks.integer("seed", seed, at_least=0)
        seeds = seed if isinstance(seed, list | tuple) else [None if single is None else single + row
                                                             for row in range(self.num_envs)]
        if len(seeds) != self.num_envs:
            raise checks.error("seed", f"an integer of at least 0, None, or a list of {self.num_envs} of them", seed)
        seeds = [None if each is None else checks.integer("seed", each, at_least=0) for each in seeds]
        options = {} if options is None else options
        if not isinstance(options, Mapping) or set(options) - {"run"} or options and None in seeds:
            raise checks.error("options", "None, or with a seed {'run': k}", options)
        run = checks.integer("run", options.get("run", 0), at_least=0)
        super().reset(seed=single)
        for row, each in enumerate(seeds):
            if each is None and not self._begun:
                each = int(self.np_random.integers(2**63))
            if each is not None:
                for array in arrays(self._states).values():
                    array[row] = 0
                self._states.stream[row] = new_stream(np.random.SeedSequence(each, spawn_key=(run,)))
        with self._alone.call("reset"):
            self._rules, self._begun, self.slots.truncated[:] = checked_rules(self.world), True, True
            self.advance(0)
            return self.slots.observation.copy(), self._infos()

    def step(self, actions: ArrayLike) -> tuple[NDArray[np.float32], NDArray[np.float64], NDArray[np.bool],
                                                NDArray[np.bool], dict[str, Any]]:
        """Take an action in every environment.

        actions: integers (num_envs,), each in 0 … actions − 1.
        Returns (observations: float32 (num_envs, numbers), rewards: float64 (num_envs,), terminated: bool (num_envs,),
        truncated: bool (num_envs,), infos).
        Raises ValueError for other actions, `gymnasium.error.ResetNeeded` before `reset`, RuntimeError while another
        thread's call is going on.
        """
        if not self._begun:
            raise gymnasium.error.ResetNeeded("step() must follow reset(), but came before it")
        given = checks.as_array("actions", actions)
        if (given.shape != (self.num_envs,) or given.dtype.kind not in "iu"
                or not 0 <= given.min() <= given.max() < self.single_action_space.n):
            raise checks.error("actions", f"integers ({self.num_envs},) from 0 to {self.single_action_space.n - 1}",
                               actions)
        with self._alone.call("step"):
            self.advance(given)
            return *(each.copy() for each in self.slots[2:6]), self._infos()

    def advance(self, actions):
        """`step` without its checks; the outcome is in `slots`."""
        slots, dynamics = self.slots, self.world.dynamics
        slots.action[:] = actions
        row = execute(self._step, self._states, self._rules, self._task, slots)
        if row >= 0:
            check_outcome(self.world, dynamics.reset if slots.restarted[row] else dynamics.step,
                          mapped(lambda each: each[row].copy(), self._states), float(slots.reward[row]))

    def _infos(self):
        infos = {"met": self.slots.met.copy(), "restarted": self.slots.restarted.copy()}
        return infos | {f"_{name}": np.ones(self.num_envs, bool) for name in infos}

    def render(self) -> tuple[NDArray[np.uint8], ...] | None:
        """A picture of every world, uint8 (500, 500, 3), north up, if the mode is "rgb_array": a tuple; else None.

        Raises `gymnasium.error.ResetNeeded` before `reset`.
        """
        if not self._begun:
            raise gymnasium.error.ResetNeeded("render() must follow reset(), but came before it")
        if self.render_mode is None:
            warn("render() was called without a render_mode, such as render_mode='rgb_array'")
            return None
        return tuple(_picture(self.world, mapped(np.copy, state)) for state in self.world_states)


def _picture(world, state):
    """A picture of a world: uint8 (500, 500, 3), north up."""
    require("matplotlib", extra="gym")
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    from neorl.drawing import draw_world

    canvas = FigureCanvasAgg(Figure((5, 5), dpi=100, facecolor="white", layout="none"))
    draw_world(world, state, canvas.figure.add_axes((0, 0, 1, 1)))
    canvas.draw()
    return np.array(canvas.buffer_rgba())[..., :3]
