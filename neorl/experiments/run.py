"""One learner in a world of kernels, from its first step on, advanced by any number of steps.

Run k of a seed draws its world from ``SeedSequence(seed).spawn(k + 1)[k]`` and its choices from the first child of
that sequence, so it is the same run alone or among others, on one core or on several.

The state of the world is writable, and is validated at every `Run.advance`.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from neorl.agents.agent import Agent
from neorl.agents.embodiment import loop_of
from neorl.agents.individual import Individual
from neorl.agents.memory import kept_apart, on_lines_of_its_own
from neorl.common import checks
from neorl.core import loop
from neorl.core.stream import new_stream
from neorl.experiments.bins import bin_steps, checked_bins
from neorl.kernels.annotations import arrays, new_tuple
from neorl.kernels.execution import execute, in_table
from neorl.worlds.rollout import Log, rollout_in
from neorl.worlds.world import World, check_outcome, checked_rules

SLICE = 10_000  # steps between two checks for an interruption
MOST_STEPS = 2**63 - 1


@dataclass(frozen=True, eq=False)
class Trajectory:
    """What `Run.record` has recorded of a run, in frames of several steps.

    steps: int64 (frames + 1,), how many steps the run had taken at the beginning and at the end of each frame.
    positions: float64 (frames + 1, axes), of the agent then, in the world's units; where an episode ends, the place
        where it ended.
    actions: int64 (frames,), the number of the last action of each frame.
    rewards: float64 (frames,), summed over each frame.
    hits: int64 (frames, kinds), the number of things of each kind that were met in each frame.
    ends: int64 (episodes,), how many steps the run had taken when each episode ended.
    returns: float64 (episodes,), the total reward of each of these episodes; the first counts from where the recording
        began.
    """

    steps: NDArray[np.int64]
    positions: NDArray[np.float64]
    actions: NDArray[np.int64]
    rewards: NDArray[np.float64]
    hits: NDArray[np.int64]
    ends: NDArray[np.int64]
    returns: NDArray[np.float64]

    __eq__ = checks.equal_fields


class Run(Individual):
    """One learner in one world, from its first step on.

    agent: an `Agent`. world: a `neorl.WaterWorld`, or another `neorl.World`. seed, run: integers ≥ 0.
    after: a finished run, whose memory this one reuses if it is large enough; its values are overwritten.

    Raises ValueError for a bad argument, or if agent and world are incompatible, MemoryError if the agent's values do
    not fit into the free memory.
    """

    _kept = ("_record", "_memory", "_world_state")
    _remedy = "each must not advance the run; use run.copy()"
    _has_begun = True
    _surroundings = property(lambda self: self._world_state)

    def __init__(self, agent: Agent, world: World, seed: int = 0, run: int = 0, after: Self | None = None) -> None:
        checks.instance("agent", agent, Agent)
        checks.instance("world", world, World)
        sequence = np.random.SeedSequence(checks.integer("seed", seed, at_least=0),
                                          spawn_key=(checks.integer("run", run, at_least=0),))
        if after is not None:
            checks.instance("after", after, Run)
        self._world_state = kept_apart(world.reset(sequence))
        self._begin_untrained(agent, world, new_stream(sequence.spawn(1)[0]), after)
        self._progress = 0
        self._bind()
        execute(loop.begin, self._record, self._memory, self._scene, loop_of(agent).functions)
        self._check_faults()

    @classmethod
    def _of(cls, agent, world):
        return cls(agent, world)

    @property
    def _scene(self):
        return self._world_state.scene

    def _bind(self):
        self._loop = [in_table(each, self._record.dtype) for each in (
            self._record, self._memory, self._scene, loop_of(self.agent))]

    def _checked_progress(self, progress):
        return checks.integer("progress", progress, 0, MOST_STEPS)

    def _check_surroundings(self):
        self.world.check_state(self._world_state)

    @property
    def world_state(self) -> Any:
        """The state of the world, with writable arrays. An assigned state is copied."""
        return self._world_state

    @world_state.setter
    def world_state(self, state):
        self._alone.check("world_state", called_back=True)
        self.world.check_state(state)
        given = arrays(state)
        for name, mine in arrays(self._world_state).items():
            mine[...] = given[name]

    @property
    def step(self) -> int:
        """The number of steps that the run has taken."""
        return self._progress

    def advance(self, steps: int, rewards: NDArray[np.float32] | None = None,
                hits: NDArray[np.int16] | None = None, *, each: Callable[[Self], object] | None = None,
                every: int = SLICE) -> float:
        """Take `steps` more steps; returns their total reward.

        rewards: float32 (bins,); if given, receives the reward in each bin of about 0.2 s, see `edges` of a result.
        hits: int16 (bins, kinds), likewise the number of things of each kind that were met, at most 32,767.
        each: called with the run after every `every` steps and after the last one, to report progress, to save a
            checkpoint, or to measure; it must not advance the run itself, but may advance a copy of it. every: an
            integer ≥ 1. Neither changes what the run does, unless `each` changes the agent.

        After an interruption the run can continue from its `step`; so can a process that was killed, from a checkpoint
        with `Run.load`, and both bit for bit.
        Raises ValueError if they do not fit, if the world's state does not or is not finite, before or after a step,
        and for a kernel of the user's that has returned a reward, a credit or a coordinate which is not a number;
        RuntimeError within another call, of `each` or of another thread.

        >>> run = neorl.Run(neorl.place_cells([3]), neorl.WaterWorld())
        >>> paid = run.advance(3_000, each=lambda run: run.save("run.npz"), every=1_000)
        >>> paid += neorl.Run.load("run.npz").advance(1_000)
        """
        with self._alone.call("advance"):
            self.world.check_state(self._world_state)
            last = self.step + checks.integer("steps", steps, 0, MOST_STEPS - self.step)
            every = checks.integer("every", every, at_least=1)
            if each is not None and not callable(each):
                raise ValueError(f"each must be a function that takes the run, or None, but is {checks.shown(each)}")
            bin_length = bin_steps(self.world)
            if rewards is None and hits is None:
                bin_length = last + 1  # a single bin, which is discarded
            bins = -(-last // bin_length)
            rewards = checked_bins("rewards", rewards, np.float32, bins)
            hits = checked_bins("hits", hits, np.int16, bins, len(self.world.kinds))
            log, due = self._log(bin_length, rewards, hits), self.step + every
            while self.step < last:
                self._take(log, min(last, due, self.step + SLICE))
                if self.step == due or self.step == last:
                    due += every
                    if each is not None:
                        each(self)
            return float(log.paid[0])

    def record(self, steps: int, every: int = 1) -> Trajectory:
        """Take `steps` more steps, the same as `advance` takes, and return their `Trajectory`.

        every: the steps in a frame of the recording, an integer ≥ 1; the last frame may have fewer. steps: an
        integer ≥ 0. Raises what `advance` raises. After an interruption the run can continue from its `step`, but the
        recording is lost.

        >>> path = neorl.Run(neorl.place_cells([3]), neorl.WaterWorld(win_reward=5.0)).record(3_000, every=10)
        >>> x, y = path.positions.T
        >>> episodes, earned = len(path.returns), path.rewards.sum()
        """
        with self._alone.call("record"):
            self.world.check_state(self._world_state)
            first, every = self.step, checks.integer("every", every, 1, MOST_STEPS)
            last = first + checks.integer("steps", steps, 0, MOST_STEPS - first)
            at = np.append(np.arange(first, last, every), last)
            unread = np.zeros(1, np.float32), np.zeros((1, len(self.world.kinds)), np.int16)
            log = self._log(last + 1, *unread, len(at) - 1, every)
            start, episodes = self._scene.position[np.newaxis].copy(), [(log.ends, log.returns)]
            while self.step < last:
                until = min(last, self.step + SLICE)
                log = log._replace(ends=np.zeros(until - self.step, np.int64), returns=np.zeros(until - self.step))
                self._take(log, until)
                episodes.append((log.ends[: log.clock[2]], log.returns[: log.clock[2]]))
        return Trajectory(at, np.concatenate([start, log.positions]), log.actions, log.frame_rewards, log.frame_hits,
                          *map(np.concatenate, zip(*episodes)))

    def _log(self, bin_length, rewards, hits, frames=0, frame_steps=1):
        """A `Log` from the present step on."""
        sizes = {"recorded": frames, "episodes": 0, "axes": self.world.actions.axes, "kinds": len(self.world.kinds)}
        clock, paid = np.array([self.step, 0, 0]), np.zeros(2)
        return new_tuple(Log, sizes, {
            "clock": on_lines_of_its_own(clock), "paid": on_lines_of_its_own(paid), "bin_steps": bin_length,
            "rewards": rewards, "hits": hits, "first_step": self.step, "frame_steps": frame_steps})

    def _take(self, log, last):
        """Take the steps up to `last`. Raises ValueError for a kernel of the user's that has broken a rule in them."""
        dynamics, log.clock[2] = self.world.dynamics, 0
        try:
            execute(rollout_in(dynamics), *self._loop, self._world_state, checked_rules(self.world), log, last)
        finally:
            self._progress = int(log.clock[0])  # also if interrupted: Python handles that once the kernel returns
        check_outcome(self.world, dynamics.reset if log.clock[1] else dynamics.step, self._world_state, log.paid[0])
        self._check_faults()
