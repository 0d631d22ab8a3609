"""Many environments of one world in one compiled step.

They equal those of `neorl.gym.environment`, to the last bit, and follow Gymnasium's rules for `VectorEnv`s: environment
i of a seed is that of seed + i; an environment whose episode is over begins the next one in the following step (mode
`NEXT_STEP`, which ignores its action in that step), in the same step (`SAME_STEP`, with the last observation of the
episode in ``infos["final_obs"]``), or on ``reset(options={"reset_mask": mask})`` (`DISABLED`).
"""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from neorl import checks
from neorl.extras import require
from neorl.gym.batch import Batch
from neorl.gym.environment import checked_seed, seed_row
from neorl.gym.observation import observation_space
from neorl.gym.rendering import frame
from neorl.worlds.arena import Arena
from neorl.worlds.waterworld import WaterWorld
from neorl.worlds.world import World

gymnasium = require("gymnasium", extra="gym")
Mode = gymnasium.vector.AutoresetMode


class VectorWorldEnv(gymnasium.vector.VectorEnv):
    """Many environments of one world in one compiled step; see the module.

    world: a `neorl.World`. num_envs: the number of environments, ≥ 1. max_episode_steps: after which an episode is
    truncated, ≥ 1, or None. autoreset_mode: a `gymnasium.vector.AutoresetMode`, or its value. render_mode: None, or
    "rgb_array". egocentric, continuing: as in `neorl.gym.environment.WorldEnv`.

    Raises ValueError for anything else.
    """

    metadata = {"render_modes": ["rgb_array"]}

    def __init__(self, world: World, num_envs: int = 1, max_episode_steps: int | None = None,
                 autoreset_mode: Any = Mode.NEXT_STEP, render_mode: str | None = None, egocentric: bool = True,
                 continuing: bool | None = None) -> None:
        continuing = isinstance(world, WaterWorld) if continuing is None else continuing
        try:
            self._mode = Mode(autoreset_mode)
        except ValueError:
            raise checks.error("autoreset_mode", checks.either(mode.value for mode in Mode), autoreset_mode) from None
        self._batch = Batch(world, num_envs, egocentric, continuing, self._mode is Mode.SAME_STEP, max_episode_steps)
        self.render_mode = checks.one_of("render_mode", render_mode, (None, *self.metadata["render_modes"]))
        self.metadata = {**self.metadata, "render_fps": world.fps, "autoreset_mode": self._mode}
        batch_space = gymnasium.vector.utils.batch_space
        self.num_envs = len(self._batch.slots.action)
        self.single_observation_space = observation_space(world, egocentric)
        self.single_action_space = gymnasium.spaces.Discrete(len(world.actions.all_names))
        self.observation_space = batch_space(self.single_observation_space, self.num_envs)
        self.action_space = batch_space(self.single_action_space, self.num_envs)
        self._begun = np.zeros(self.num_envs, bool)

    @property
    def world(self) -> World:
        """The `neorl.World`."""
        return self._batch.world

    @property
    def world_states(self) -> tuple[Any, ...]:
        """The states of the worlds, one for each environment, as read-only views: a tuple."""
        return tuple(map(self._batch.state_of, range(self.num_envs)))

    def reset(self, *, seed: int | Sequence[int] | None = None,
              options: Mapping[str, Any] | None = None) -> tuple[NDArray[np.float32], dict[str, Any]]:
        """Begin an episode in every environment.

        seed: an integer ≥ 0, with seed + i for environment i; a list of one for each; or None to continue the streams.
        options: None, or {"run": k} as in `WorldEnv.reset`, and "reset_mask": bool (num_envs,), if not all begin.
        Returns (observations: float32 (num_envs, numbers), infos). Raises ValueError for anything else.
        """
        if not isinstance(options, Mapping | None):
            raise checks.error("options", "None or a dict", options)
        options = dict(options or {})
        chosen = self._mask(options.pop("reset_mask", np.ones(self.num_envs, bool)))
        if isinstance(seed, list | tuple):
            seeds = seed
        else:
            first, _ = checked_seed(seed, options)
            seeds = [None if seed is None else first + i for i in range(self.num_envs)]
            super().reset(seed=first)
        if len(seeds) != self.num_envs:
            raise checks.error("seed", f"an integer of at least 0, None, or a list of {self.num_envs} of them", seed)
        checked = [checked_seed(each, options) for each in seeds]
        for i in np.flatnonzero(chosen):
            its_seed, run = checked[i]
            seed_row(self, self._batch, i, its_seed, run, self._begun[i])
        self._batch.begin(chosen)
        self._begun |= chosen
        return self._batch.slots.observation.copy(), self._infos(chosen)

    def _mask(self, mask):
        if not isinstance(mask, np.ndarray) or mask.dtype != bool or mask.shape != (self.num_envs,) or not mask.any():
            raise checks.error("reset_mask", f"an array of bool ({self.num_envs},), not all False", mask)
        return mask

    def step(self, actions: ArrayLike) -> tuple[NDArray[np.float32], NDArray[np.float64], NDArray[np.bool],
                                                NDArray[np.bool], dict[str, Any]]:
        """Take an action in every environment.

        actions: integers (num_envs,), each in 0 … actions − 1.
        Returns (observations: float32 (num_envs, numbers), rewards: float64 (num_envs,), terminated: bool (num_envs,),
        truncated: bool (num_envs,), infos).
        Raises ValueError for other actions, `gymnasium.error.ResetNeeded` before `reset`, and when an episode is over
        and is not reset automatically.
        """
        slots, mode = self._batch.slots, self._mode
        over = slots.terminated | slots.truncated
        if not self._begun.all() or mode is Mode.DISABLED and over.any():
            raise gymnasium.error.ResetNeeded("step() must follow reset(), but came before it")
        checks.unmasked("actions", actions)
        try:
            given = np.asarray(actions)
        except ValueError:  # lists of unequal lengths
            given = np.array(None)
        if (given.shape != (self.num_envs,) or given.dtype.kind not in "iu"
                or not 0 <= given.min() <= given.max() < self.single_action_space.n):
            raise checks.error("actions", f"integers ({self.num_envs},) from 0 to {self.single_action_space.n - 1}",
                               actions)
        slots.action[:] = given
        slots.begins[:] = over if mode is Mode.NEXT_STEP else False
        self._batch.step()
        infos = {}
        if mode is Mode.SAME_STEP:
            infos = self._final_infos(slots.terminated | slots.truncated)
        return (slots.observation.copy(), slots.reward.copy(), slots.terminated.copy(), slots.truncated.copy(),
                infos | self._infos(np.ones(self.num_envs, bool)))

    def _infos(self, about):
        """The infos of the environments that `about` marks: bool (num_envs,)."""
        slots = self._batch.slots
        return {"met": np.where(about[:, None], slots.met, 0), "_met": about.copy(),
                "restarted": slots.restarted & about, "_restarted": about.copy()}

    def _final_infos(self, over):
        """The last observations and infos of the episodes that are over; the next ones have begun in the same step."""
        if not over.any():
            return {}
        slots, observations = self._batch.slots, np.full(self.num_envs, None, object)
        for i in np.flatnonzero(over):
            observations[i] = slots.last_observation[i].copy()
        final = {"final_obs": observations, "_final_obs": over, "final_info": self._infos(over), "_final_info": over}
        slots.met[over], slots.restarted[over] = 0, True
        return final

    def render(self):
        """A picture of every world, uint8 (500, 500, 3), if the mode is "rgb_array": a tuple; else None.

        Raises `gymnasium.error.ResetNeeded` before `reset`.
        """
        if not self._begun.all():
            raise gymnasium.error.ResetNeeded("render() must follow reset(), but came before it")
        if self.render_mode is None:
            gymnasium.logger.warn("render() was called without a render_mode, such as render_mode='rgb_array'")
            return None
        return tuple(frame(self.world, state.scene) for state in self.world_states)


def vector_waterworld(num_envs: int = 1, max_episode_steps: int | None = None, autoreset_mode: Any = Mode.NEXT_STEP,
                      render_mode: str | None = None, egocentric: bool = True, continuing: bool = True,
                      **rules: Any) -> VectorWorldEnv:
    """Many environments of `neorl.WaterWorld`: "neorl/WaterWorld-v0" of `gymnasium.make_vec`.

    rules: the fields of `WaterWorld`. The others are those of `VectorWorldEnv`, which it returns.
    """
    return VectorWorldEnv(WaterWorld(**rules), num_envs, max_episode_steps, autoreset_mode, render_mode, egocentric,
                          continuing)


def vector_arena(num_envs: int = 1, max_episode_steps: int | None = None, autoreset_mode: Any = Mode.NEXT_STEP,
                 render_mode: str | None = None, egocentric: bool = True, continuing: bool = False,
                 **rules: Any) -> VectorWorldEnv:
    """Many environments of `neorl.Arena`: "neorl/Arena-v0" of `gymnasium.make_vec`.

    rules: the fields of `Arena`. The others are those of `VectorWorldEnv`, which it returns.
    """
    return VectorWorldEnv(Arena(**rules), num_envs, max_episode_steps, autoreset_mode, render_mode, egocentric,
                          continuing)
