"""A world as a Gymnasium environment.

**Actions**: the numbers of the world's `Actions`, idleness last. In WaterWorld and arenas N, S, E, W, and no-op.

**Observations**: `neorl.gym.observation`.

**Rewards**: those of the world, unchanged.

**Episodes**: for a neoRL agent the worlds of this package never end: the event that ends an episode, such as taking the
last green creep, pays and resets the board, and life goes on. A *continuing* environment does the same: it never
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

from neorl import checks
from neorl.extras import require
from neorl.gym.batch import Batch
from neorl.gym.observation import observation_space
from neorl.gym.rendering import Window, frame
from neorl.worlds.arena import Arena
from neorl.worlds.waterworld import WaterWorld
from neorl.worlds.world import World

gymnasium = require("gymnasium", extra="gym")


class WorldEnv(gymnasium.Env):
    """A world as a Gymnasium environment; see the module for its rules.

    world: a `neorl.World`. render_mode: None; "rgb_array": `render` returns a picture, uint8 (500, 500, 3); or "human",
    a window that shows every step at the world's frame rate. egocentric: whether things are relative to the agent,
    nearest first. continuing: whether an episode goes on when one of the world is over; by default only in WaterWorld.

    Raises ValueError for anything else.
    """

    metadata = {"render_modes": ["human", "rgb_array"]}

    def __init__(self, world: World, render_mode: str | None = None, egocentric: bool = True,
                 continuing: bool | None = None) -> None:
        continuing = isinstance(world, WaterWorld) if continuing is None else continuing
        self._batch = Batch(world, 1, egocentric, continuing)
        self.render_mode = checks.one_of("render_mode", render_mode, (None, *self.metadata["render_modes"]))
        self.metadata = {**self.metadata, "render_fps": world.fps}
        self.observation_space = observation_space(world, egocentric)
        self.action_space = gymnasium.spaces.Discrete(len(world.actions.all_names))
        self._begun = self._over = False
        self._window: Window | None = None

    @property
    def world(self) -> World:
        """The `neorl.World`."""
        return self._batch.world

    @property
    def world_state(self) -> Any:
        """The state of the world, as read-only views."""
        return self._batch.state_of(0)

    def reset(self, *, seed: int | None = None,
              options: Mapping[str, Any] | None = None) -> tuple[NDArray[np.float32], dict[str, Any]]:
        """Begin an episode.

        seed: an integer ≥ 0, or None to continue the random stream. options: None, or {"run": k}, k ≥ 0, with a seed.
        Returns (observation: float32 (numbers,), info). Raises ValueError for anything else.
        """
        seed, run = checked_seed(seed, options)
        super().reset(seed=seed)
        seed_row(self, self._batch, 0, seed, run, self._begun)
        self._batch.begin(True)
        self._begun, self._over = True, False
        return self._returned()[::4]

    def step(self, action: int) -> tuple[NDArray[np.float32], float, bool, bool, dict[str, Any]]:
        """Take an action.

        action: an integer in 0 … actions − 1.
        Returns (observation: float32 (numbers,), reward: float, terminated: bool, truncated: bool, info).
        Raises ValueError for any other action, `gymnasium.error.ResetNeeded` before `reset` and after the end.
        """
        if not self._begun or self._over:
            raise gymnasium.error.ResetNeeded("step() must follow reset(), but came before it, or after the end of an "
                                              "episode")
        slots = self._batch.slots
        slots.action[0] = checks.integer("action", action, at_least=0, at_most=int(self.action_space.n) - 1)
        slots.begins[0] = False
        self._batch.step()
        self._over = bool(slots.terminated[0] or slots.truncated[0])
        return self._returned()

    def _returned(self):
        slots = self._batch.slots
        if self.render_mode == "human":
            self.render()
        info = {"met": slots.met[0].copy(), "restarted": bool(slots.restarted[0])}
        return (slots.observation[0].copy(), float(slots.reward[0]), bool(slots.terminated[0]),
                bool(slots.truncated[0]), info)

    def render(self) -> NDArray[np.uint8] | None:
        """A picture of the world, uint8 (500, 500, 3), north up, if the mode is "rgb_array"; else None.

        Raises `gymnasium.error.ResetNeeded` before `reset`.
        """
        if not self._begun:
            raise gymnasium.error.ResetNeeded("render() must follow reset(), but came before it")
        if self.render_mode is None:
            gymnasium.logger.warn("render() was called without a render_mode, such as render_mode='rgb_array'")
            return None
        picture = frame(self.world, self.world_state.scene)
        if self.render_mode == "rgb_array":
            return picture
        self._window = self._window or Window(self.world.fps)
        self._window.show(picture)
        return None

    def close(self) -> None:
        """Close the window, if there is one."""
        if self._window is not None:
            self._window.close()
            self._window = None

    def __getstate__(self):
        return {**vars(self), "_window": None}  # a copy has a window of its own


class WaterWorldEnv(WorldEnv):
    """`neorl.WaterWorld` as an environment: "neorl/WaterWorld-v0".

    rules: the fields of `WaterWorld`. The others are those of `WorldEnv`.
    """

    def __init__(self, render_mode: str | None = None, egocentric: bool = True, continuing: bool = True,
                 **rules: Any) -> None:
        super().__init__(WaterWorld(**rules), render_mode, egocentric, continuing)


class ArenaEnv(WorldEnv):
    """`neorl.Arena` as an environment: "neorl/Arena-v0".

    rules: the fields of `Arena`. The others are those of `WorldEnv`.
    """

    def __init__(self, render_mode: str | None = None, egocentric: bool = True, continuing: bool = False,
                 **rules: Any) -> None:
        super().__init__(Arena(**rules), render_mode, egocentric, continuing)


def checked_seed(seed, options):
    """The seed, and the run number in the options, of a reset."""
    options = checks.instance("options", {} if options is None else options, Mapping)
    if set(options) - {"run"} or options and seed is None:
        raise checks.error("options", "None, or with a seed {'run': k}", options)
    seed = None if seed is None else checks.integer("seed", seed, at_least=0)
    return seed, checks.integer("run", options.get("run", 0), at_least=0)


def seed_row(env, batch, row, seed, run, begun):
    """Seed a row of a batch with run `run` of a seed; without one, continue, or draw the first seed from `env`."""
    if seed is None and not begun:
        seed = int(env.np_random.integers(2**63))
    if seed is not None:
        batch.seed(row, np.random.SeedSequence(seed, spawn_key=(run,)))
