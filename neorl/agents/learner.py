"""An agent in the user's own loop, step by step. Scenes are validated before they reach the kernels."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from neorl.agents.agent import Agent
from neorl.agents.embodiment import loop_of, own_axes
from neorl.agents.individual import Individual, Output
from neorl.agents.keeping import own_tracks
from neorl.agents.memory import kept_apart
from neorl.agents.recording import BEGINS, JUMPS, Watching, check_places, nearest_action, recorded, watch
from neorl.agents.scenes import Offer, accept, offer
from neorl.common import checks
from neorl.common.checks import LARGEST
from neorl.common.progress import progress_bar
from neorl.core import loop
from neorl.core.coordinates import check_faults
from neorl.core.functions import Loop
from neorl.core.layout import Memory, Record
from neorl.core.scene import ABSENT, CARDINAL, Actions, Scene
from neorl.core.stream import new_stream
from neorl.kernels.annotations import mapped, new_tuple, tabled
from neorl.kernels.execution import bound, execute, in_table
from neorl.kernels.kernel import kernel

UNBORN = "before the first scene"
OF_NUMBERS = f"of finite numbers from {-LARGEST:g} to {LARGEST:g}"
SLICE = 20_000  # steps watched between two checks for an interruption


@dataclass(frozen=True)
class Surroundings(checks.Final):
    """What an agent has to know of a world that is not made of kernels.

    things, kinds, actions, size, fps: as in `Learner`. Raises ValueError for anything else.
    """

    things: int
    kinds: Sequence[str]
    actions: Actions
    size: float
    fps: float

    def __post_init__(self):
        kinds = tuple(str(checks.instance("kinds", each, str)) for each in checks.several("kinds", self.kinds))
        if len(set(kinds)) < len(kinds):
            raise checks.error("kinds", "different names", kinds)
        checks.instance("actions", self.actions, Actions)
        checks.assign(self, things=checks.integer("things", self.things, at_least=0, at_most=2**20), kinds=kinds,
                     size=checks.positive("size", self.size),
                     fps=checks.positive("fps", self.fps))


class Learner(Individual):
    """An agent in the user's own loop: `begin` with a scene, then alternate `act` and `observe`.

    agent: an `Agent`. things: the greatest number of things at any time, 0 … 2²⁰. kinds: the names of their kinds, the
    one that an agent wants by default first. actions: the agent's actions, an `Actions`; by default N, S, E, W, and
    being idle. seed: integer ≥ 0, of the agent's random numbers. size: the world's unit of length, such as its width,
    > 0. fps: steps per second, > 0, on which memories in seconds depend.

    Raises ValueError for anything else, or if agent and world are incompatible, MemoryError if the agent's values do
    not fit into the free memory.
    """

    _kept = ("_record", "_memory", "_scene")
    _has_begun = property(lambda self: self._progress != UNBORN)
    _surroundings = property(lambda self: self._scene)

    def __init__(self, agent: Agent, things: int = 0, kinds: Sequence[str] = (), actions: Actions = CARDINAL,
                 seed: int = 0, size: float = 1.0, fps: float = 50) -> None:
        checks.instance("agent", agent, Agent)
        world = Surroundings(things, kinds, actions, size, fps)
        seed = checks.integer("seed", seed, at_least=0)
        sizes = {"things": world.things, "axes": actions.axes}
        self._scene = kept_apart(new_tuple(Scene, sizes, {}))
        self._begin_untrained(agent, world, new_stream(np.random.SeedSequence(seed)))
        self._progress = UNBORN
        self._bind()

    @classmethod
    def _of(cls, agent, world):
        return cls(agent, world.things, world.kinds, world.actions, 0, world.size, world.fps)

    def _bind(self):
        self._double = None  # made when it is first asked for
        self._offered = mapped(np.copy, self._scene)
        here = Here(self._record, self._memory, self._scene, loop_of(self.agent))
        self._calls = [bound(each, here) for each in (begin, act, observe)]
        self._accept = bound(accept, Offer(len(self.world.kinds), self._offered), self._scene)
        self._numbers = {None: ABSENT, **{name: number for number, name in enumerate(self.world.kinds)},
                         **{number: number for number in range(ABSENT, len(self.world.kinds))}}

    def begin(self, scene: Any) -> None:
        """Begin, or begin again after a discontinuity such as a new episode: nothing is learned across it.

        An agent whose resets are "unnoticed" only sees the new scene if it has begun before.

        scene: a `neorl.Scene`, as in `observe`. Raises ValueError for one that does not fit.
        """
        with self._alone.call("begin"):
            self._take(scene)
            if not self._has_begun or self.agent.resets == "noticed":
                self._calls[0]()
            self._progress = "to act"
            self._check_faults()

    def act(self) -> int:
        """Choose an action, and return its number, 0 … actions − 1, or the number of actions for being idle.

        ``actions.table[number]`` is its push, 0 when idle.

        Raises RuntimeError before the first scene, or if the outcome of the last action was not observed; ValueError
        for a kernel of an axis that has returned NaN.
        """
        with self._alone.call("act"):
            if self._progress != "to act":
                raise RuntimeError(f"act() must follow begin(scene) or observe(scene), but came {self._progress}")
            action = self._calls[1]()
            self._progress = "twice"
            self._check_faults()
            return action

    def observe(self, scene: Any, reward: float = 0.0, action: ArrayLike | None = None) -> None:
        """Perceive the outcome of the last action, and learn from it.

        scene: a `neorl.Scene` of numbers, or anything with its fields: position and velocity, (axes,), a velocity of
            None meaning at rest; things, (things, axes), their positions; kinds, the name or number of each thing's
            kind, or None while it is absent; met, for each whether it was met in this step, () if none was. A thing
            that was met may have moved, changed its kind or vanished: its slot then holds a new thing.
        reward: of the action, a finite number, from which desires with learned valence learn.
        action: what was done, if that was not chosen by `act`, or not as it was chosen: the number of an action, or a
            push, (axes,), which counts for the action with the nearest direction.

        Raises ValueError for a scene that does not fit or is not finite, and for a kernel of an axis or of the credit
        that has returned NaN; RuntimeError unless the agent has acted, or `action` says what was done instead.
        """
        with self._alone.call("observe"):
            if self._progress != "twice" and (action is None or not self._has_begun):
                raise RuntimeError(f"observe(scene) must follow {'begin' if action is not None else 'act'}(), but came "
                                   "before it")
            reward = checks.real("reward", reward)
            action = self._record["last_event"] if action is None else self._number_of(action)
            self._take(scene)
            self._record["reward"], self._record["last_event"] = reward, action
            self._calls[2]()
            self._progress = "to act"
            self._check_faults()

    def watch(self, positions: ArrayLike | Sequence[Any], actions: ArrayLike | None = None, *, ends: ArrayLike = (),
              rewards: ArrayLike | None = None, progress: bool | Callable[[int, int], object] = True) -> int:
        """Learn from a recording of what somebody did; returns the number of steps learned from.

        It learns in each step what `observe` with this action would teach it. A call whose first position is where the
        learner is goes on from there; any other begins a new stretch, as `begin` does.

        positions: (steps + 1, axes), in the world's units, of an agent that is at rest in a world without things; or a
            sequence of scenes, each as `observe` takes it. A position with NaN, where the animal was lost, ends a
            stretch.
        actions: (steps,), the numbers of the actions between them; or (steps, axes), pushes, such as velocities, each
            of which counts for the action with the nearest direction; or None: the displacements. A push of 0, and the
            number of actions, stand for none.
        ends: the indices of the positions after which the recording jumps, as between trials; or a truth value for each
            position or for each step.
        rewards: (steps,), from which desires with learned valence learn; None stands for 0.
        progress: as in `neorl.simulate`.

        After an interruption it has learned from what came before. Raises ValueError for anything else: for positions
        beyond the agent's maps of places, for numbers that are not finite, and for a kernel of the user's that has
        returned NaN.

        >>> learner = neorl.Learner(neorl.Agent([neorl.Node("PC", neorl.modality.PLACE_CELL, [9])]))
        >>> path = np.cumsum(np.random.default_rng(0).normal(0, 0.01, (5_000, 2)), axis=0) % 1.0
        >>> steps = learner.watch(path, ends=np.abs(np.diff(path, axis=0)).max(axis=1) > 0.5)
        """
        with self._alone.call("watch"):
            scenes = self._scenes(positions)
            here = self._progress == "to act" and bool(np.all(scenes.position[0] == self._scene.position)) and bool(
                np.all(scenes.things[0] == self._scene.things))
            jump = BEGINS if self.agent.resets == "noticed" else JUMPS
            recording = recorded(scenes, actions, rewards, ends, self.world.actions, jump)
            rows = len(recording.row)
            if not self._has_begun:
                recording.row[:1] = BEGINS
            watching = in_table(Watching(self._record, self._memory, self._scene, loop_of(self.agent), Offer(
                len(self.world.kinds), self._offered), recording), self._record.dtype)
            with progress_bar(rows, "watching", progress) as bar:
                for first in range(int(here), rows, SLICE):
                    end = min(first + SLICE, rows)
                    execute(watch, watching, first, end)
                    self._progress = "to act"
                    self._check_faults()
                    bar.update(end - first)
            return int(np.sum(recording.row[int(here):] == 0))

    def output(self, name: str, scene: Any = None, *, normalised: bool = False) -> Output:
        """The `Output` of a node, at the last choice that was not exploratory, or in a scene, without acting in it.

        name: of the node. scene: as in `observe`; recursion uses the desires of the last choice. normalised: scale the
        desire vector so that its largest component is 1, if any differs from 0.
        Raises ValueError for anything else.

        >>> learner.want((0.8, 0.8))
        >>> push = learner.output("PC", neorl.Scene((0.2, 0.2)), normalised=True).desire
        """
        checks.flag("normalised", normalised)
        found = self._output(name, self._record if scene is None else self._imagined(scene))
        longest = np.abs(found.desire).max(initial=0.0)
        return found._replace(desire=found.desire / longest) if normalised and longest > 0.0 else found

    def _imagined(self, scene):
        """The record of a double of the agent that has evaluated its desires in a scene."""
        with self._alone.call("output"):
            if self._double is None:
                there, double = mapped(np.copy, self._scene), self._record.copy()
                imagining = Imagining(self._record, double, own_tracks(self._memory), there, loop_of(self.agent))
                self._double = double, bound(imagine, imagining), bound(accept, Offer(
                    len(self.world.kinds), self._offered), there)
            double, evaluate_there, accept_there = self._double
            self._offer(scene)
            if not accept_there():
                raise checks.error("scene", OF_NUMBERS, scene)
            double[...] = self._record
            evaluate_there()
            check_faults(double["faults"], own_axes(self.agent))
            return double

    def _number_of(self, action):
        """The number of an action, given by its number or by a push."""
        push = checks.as_array("action", action)
        if push.shape == (self.world.actions.axes,) and push.dtype.kind in "fiub":
            return int(nearest_action(checks.doubles("action", push), self.world.actions))
        return checks.integer("action", action, 0, len(self.world.actions.names))

    def _scenes(self, positions):
        """A `Scene` of arrays with a row for each position or scene."""
        n_axes, things = self.world.actions.axes, self.world.things
        is_of_scenes = not isinstance(positions, np.ndarray) and isinstance(positions, Sequence) and any(
            hasattr(each, "position") for each in positions[:1])
        if is_of_scenes:
            rows = []
            for each in positions:
                self._offer(each)
                rows.append([np.copy(values) for values in self._offered])
            scenes = Scene(*map(np.array, zip(*rows)))
        else:
            array = checks.as_array("positions", positions)
            if array.ndim != 2 or array.shape[1] != n_axes or not len(array) or array.dtype.kind not in "fiub":
                raise ValueError(f"positions must be numbers of the shape (steps + 1, {n_axes}), a row for each time "
                                 f"without the time itself, but are {array.dtype} of the shape {array.shape}")
            scenes = Scene(array.astype(float), np.zeros((len(array), n_axes)), np.zeros((len(array), things, n_axes)),
                           np.full((len(array), things), ABSENT), np.zeros((len(array), things), np.int64))
        seen = ~np.isnan(scenes.position).any(axis=1)
        present = seen[:, np.newaxis] & (scenes.kinds >= 0)
        for name, values in (("positions", scenes.position[seen]), ("velocities", scenes.velocity[seen]),
                             ("things", scenes.things[present])):
            checks.finite(name, values)
        check_places(scenes.position, self.agent, self.world.size)
        return scenes

    def _checked_progress(self, progress):
        return checks.one_of("progress", progress, (UNBORN, "to act", "twice"))

    def _check_surroundings(self):
        scene, n_kinds = self._scene, len(self.world.kinds)
        for name in ("position", "velocity", "things"):
            checks.finite(f"scene.{name}", getattr(scene, name))
        for name, least, most in (("kinds", ABSENT, n_kinds - 1), ("met", 0, n_kinds)):
            for number in getattr(scene, name):
                checks.integer(f"scene.{name}", number, least, most)

    def _take(self, scene):
        """Check a scene, and copy it."""
        self._offer(scene)
        if not self._accept():
            raise checks.error("scene", OF_NUMBERS, scene)

    def _offer(self, scene):
        offer(self._offered, scene, self._numbers, self.world.things)


@tabled
class Here(NamedTuple):
    """An agent in a scene: all that its steps take, by one pointer, since Python takes long to pass a record."""

    agent: Record
    memory: Memory
    scene: Scene
    loop: Loop


@kernel
def begin(here: Here) -> None:
    """Begin at the scene."""
    here.loop.begin(here.agent, here.memory, here.scene, here.loop.functions)


@kernel
def act(here: Here) -> int:
    """Choose an action."""
    return here.loop.act(here.agent, here.memory, here.scene, here.loop.functions)


@kernel
def observe(here: Here) -> None:
    """Learn from the scene."""
    here.loop.observe(here.agent, here.memory, here.scene, here.loop.functions)


@tabled
class Imagining(NamedTuple):
    """An agent, and a double of it with tracks of its own in another scene."""

    agent: Record
    double: Record
    memory: Memory
    scene: Scene
    loop: Loop


@kernel
def imagine(imagining: Imagining) -> None:
    """Evaluate the desires of the double."""
    loop.imagine(imagining.agent, imagining.double, imagining.memory, imagining.scene, imagining.loop.functions)
