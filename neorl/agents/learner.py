"""An agent in the user's own loop, step by step. Scenes are validated before they reach the kernels."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from neorl.agents.agent import Agent
from neorl.agents.embodiment import loop_of
from neorl.agents.individual import Individual
from neorl.agents.memory import kept_apart
from neorl.common import checks
from neorl.common.checks import LARGEST
from neorl.core.functions import Loop
from neorl.core.layout import Memory, Record
from neorl.core.scene import ABSENT, CARDINAL, Actions, Scene
from neorl.core.stream import new_stream
from neorl.kernels.annotations import mapped, new_tuple, tabled
from neorl.kernels.execution import bound
from neorl.kernels.kernel import kernel

UNBORN = "before the first scene"


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

    def observe(self, scene: Any, reward: float = 0.0) -> None:
        """Perceive the outcome of the last action, and learn from it.

        scene: a `neorl.Scene` of numbers, or anything with its fields: position and velocity, (axes,), a velocity of
            None meaning at rest; things, (things, axes), their positions; kinds, the name or number of each thing's
            kind, or None while it is absent; met, for each whether it was met in this step, () if none was. A thing
            that was met may have moved, changed its kind or vanished: its slot then holds a new thing.
        reward: of the action, a finite number, from which desires with learned valence learn.

        Raises ValueError for a scene that does not fit or is not finite, and for a kernel of an axis or of the credit
        that has returned NaN; RuntimeError unless the agent has acted.
        """
        with self._alone.call("observe"):
            if self._progress != "twice":
                raise RuntimeError("observe(scene) must follow act(), but came before it")
            reward = checks.real("reward", reward)
            self._take(scene)
            self._record["reward"] = reward
            self._calls[2]()
            self._progress = "to act"
            self._check_faults()

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
        try:
            position, velocity, things, kinds, met = (scene.position, scene.velocity, scene.things, scene.kinds,
                                                      scene.met)
        except AttributeError:
            raise checks.error("scene", "a neorl.Scene, or have its fields", scene) from None
        offered = self._offered
        _put("position", offered.position, position)
        if velocity is None:
            offered.velocity[:] = 0.0
        else:
            _put("velocity", offered.velocity, velocity)
        if self.world.things or not _is_empty(things):
            _put("things", offered.things, things)
            try:
                if len(kinds) != len(offered.kinds):  # which may be too many to iterate over
                    raise TypeError
                offered.kinds[:] = [self._numbers[each] for each in kinds]
            except (KeyError, TypeError, OverflowError):
                raise checks.error("scene.kinds", f"a list of {len(offered.kinds)}, each "
                                   f"{checks.either(self._numbers)}", kinds) from None
            if _is_empty(met):
                offered.met[:] = 0
            else:
                _put("met", offered.met, met)
        if not self._accept():
            raise checks.error("scene", f"of finite numbers from {-LARGEST:g} to {LARGEST:g}", scene)


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


class Offer(NamedTuple):
    """A scene to be validated."""

    n_kinds: int
    scene: Scene


@kernel
def accept(offer: Offer, scene: Scene) -> bool:
    """Copy a scene if its numbers are finite, except those of absent things; returns whether they are."""
    offered = offer.scene
    for axis in range(offered.position.shape[0]):
        if not (abs(offered.position[axis]) <= LARGEST and abs(offered.velocity[axis]) <= LARGEST):
            return False
    for thing in range(offered.kinds.shape[0]):
        for axis in range(offered.position.shape[0]):
            if offered.kinds[thing] < 0:
                offered.things[thing, axis] = 0.0
            elif not abs(offered.things[thing, axis]) <= LARGEST:
                return False
    for axis in range(offered.position.shape[0]):
        scene.position[axis], scene.velocity[axis] = offered.position[axis], offered.velocity[axis]
    for thing in range(offered.kinds.shape[0]):
        for axis in range(offered.position.shape[0]):
            scene.things[thing, axis] = offered.things[thing, axis]
        was = max(scene.kinds[thing], 0)  # the kind as last seen
        scene.met[thing] = 1 + was if offered.met[thing] != 0 else 0
        scene.kinds[thing] = offered.kinds[thing]
    return True


def _is_empty(given):
    return given.size == 0 if isinstance(given, np.ndarray) else isinstance(given, tuple | list) and not given


def _put(name, mine, given):
    values = checks.as_array(f"scene.{name}", given)
    if values.shape != mine.shape or values.dtype.kind not in "fiub":
        raise checks.error(f"scene.{name}", f"numbers of the shape {mine.shape}", given)
    if values.dtype.itemsize > 8:
        values = checks.doubles(f"scene.{name}", values)  # so that no number is truncated
    if mine.dtype.kind == "i" and values.dtype.kind in "fu":
        values = checks.doubles(f"scene.{name}", values) != 0
    mine[...] = values
