"""A world as a Gymnasium environment.

**Actions**: the numbers of the world's `Actions`, idleness last. In WaterWorld and arenas N, S, E, W, and no-op.

**Observations**: `neorl.gym.observation`.

**Rewards**: those of the world, unchanged.

**Episodes**: for a neoRL agent the worlds of this package never end: the event that ends an episode, such as taking the
last green creep, pays and resets the board, and the run goes on. A *continuing* environment does the same: it never
terminates, and is truncated only by a step limit. One that is not continuing terminates when an episode of the world
is over, except that a trial in an arena that has run out of time is truncated. By default only WaterWorld is
continuing, since to an agent that ignores what follows the end of an episode, the last green creep would be worth less
than the others.

**Info**: "met", int64 (kinds,), the number of things of each kind met in the step; "restarted", whether the world has
begun an episode of its own in the step, so that the observation does not follow from the one before.

**Seeds**: ``reset(seed=5)`` begins the world of ``neorl.Run(agent, world, seed=5)``, and
``reset(seed=5, options={"run": 3})`` that of its run 3: the same actions lead to the same states, to the last bit.
Without a seed the next episode continues the same stream of random numbers, as a run does.
"""

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from neorl.common import checks
from neorl.common.alone import Alone
from neorl.common.extras import require
from neorl.gym.vector import REMEDY, VectorWorldEnv
from neorl.worlds.world import World

gymnasium = require("gymnasium", extra="gym")


class WorldEnv(gymnasium.Env):
    """A world as a Gymnasium environment; see the module for its rules.

    world: a `neorl.World`, or the name of one, "WaterWorld" or "module:name", with some of its fields. render_mode:
    None, or "rgb_array": `render` returns a picture, uint8 (500, 500, 3), which takes some 40 ms. egocentric: whether
    things are relative to the agent, nearest first. continuing: whether an episode goes on when one of the world is
    over; by default only in WaterWorld.

    Raises ValueError for anything else.
    """

    metadata = {"render_modes": ["rgb_array"]}

    def __init__(self, world: World | str, render_mode: str | None = None, egocentric: bool = True,
                 continuing: bool | None = None, **fields: Any) -> None:
        self._envs = VectorWorldEnv(world, 1, None, render_mode, egocentric, continuing, **fields)
        self.world, self.render_mode = self._envs.world, self._envs.render_mode
        self.metadata = {**self.metadata, "render_fps": self.world.fps}
        self.observation_space = self._envs.single_observation_space
        self.action_space = self._envs.single_action_space
        self._over, self._alone = True, Alone(REMEDY)

    @property
    def world_state(self) -> Any:
        """The state of the world, as read-only views."""
        return self._envs.world_states[0]

    def reset(self, *, seed: int | None = None,
              options: Mapping[str, Any] | None = None) -> tuple[NDArray[np.float32], dict[str, Any]]:
        """Begin an episode.

        seed: an integer ≥ 0, or None to continue the random stream. options: None, or {"run": k}, k ≥ 0, with a seed.
        Returns (observation: float32 (numbers,), info). Raises ValueError for anything else.
        """
        with self._alone.call("reset"):
            self._envs.reset(seed=[seed], options=options)
            super().reset(seed=None if seed is None else int(seed))
            self._over = False
            return self._returned()[::4]

    def step(self, action: int) -> tuple[NDArray[np.float32], float, bool, bool, dict[str, Any]]:
        """Take an action.

        action: an integer in 0 … actions − 1.
        Returns (observation: float32 (numbers,), reward: float, terminated: bool, truncated: bool, info).
        Raises ValueError for any other action, `gymnasium.error.ResetNeeded` before `reset` and after the end,
        RuntimeError while another thread's call is going on.
        """
        if self._over:
            raise gymnasium.error.ResetNeeded("step() must follow reset(), but came before it, or after the end of an "
                                              "episode")
        action = checks.integer("action", action, at_least=0, at_most=int(self.action_space.n) - 1)
        with self._alone.call("step"):
            self._envs.advance(action)
            returned = self._returned()
            self._over = returned[2] or returned[3]
            return returned

    def _returned(self):
        slots = self._envs.slots
        info = {"met": slots.met[0].copy(), "restarted": bool(slots.restarted[0])}
        return (slots.observation[0].copy(), float(slots.reward[0]), bool(slots.terminated[0]),
                bool(slots.truncated[0]), info)

    def render(self) -> NDArray[np.uint8] | None:
        """A picture of the world, uint8 (500, 500, 3), north up, if the mode is "rgb_array"; else None.

        Raises `gymnasium.error.ResetNeeded` before `reset`.
        """
        pictures = self._envs.render()
        return None if pictures is None else pictures[0]
