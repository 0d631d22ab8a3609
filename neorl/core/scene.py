"""The interface of agent and world: the `Scene` that an agent perceives, and the `Actions` that it can take."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from neorl.common import checks

from neorl.kernels.annotations import array, tabled

MOST_AXES, MOST_ACTIONS = 8, 1_024  # of a world; kernels are compiled for their numbers
ABSENT = -1  # instead of the number of a kind
HALF_SECOND = 0.5  # a velocity is shown at the place that the agent would reach in this time


@tabled
class Scene(NamedTuple):
    """What an agent perceives, in the world's units of length and in seconds."""

    position: array("float64", "axes")  # of the agent
    velocity: array("float64", "axes") = None  # of the agent; None at rest
    things: array("float64", "things", "axes") = ()  # their positions
    kinds: array("int64", "things") = ()  # the number of each one's kind, or ABSENT
    met: array("int64", "things") = ()  # 0, or 1 + the kind of a thing met in this step; its slot is now a fresh one's


def checked_scene(scene):
    """A scene as arrays for the kernels.

    A velocity of None means rest; things without kinds count as absent, and none are met unless `met` says so.
    Raises ValueError for a scene whose arrays are not numeric, or do not fit together.
    """
    checks.instance("scene", scene, Scene)
    position = checks.doubles("scene.position", scene.position)
    things, kinds, met = (checks.doubles(f"scene.{name}", getattr(scene, name)) for name in ("things", "kinds", "met"))
    if position.ndim != 1 or not 1 <= len(position) <= MOST_AXES:
        raise checks.error("scene.position", f"a number for each of 1 to {MOST_AXES} axes", scene.position)
    velocity = np.zeros(len(position)) if scene.velocity is None else checks.doubles("scene.velocity", scene.velocity)
    things = np.zeros((0, len(position))) if things.size == 0 else things
    if things.ndim != 2:
        raise checks.error("scene.things", "places, one in each row", scene.things)
    kinds = np.full(len(things), ABSENT) if kinds.size == 0 else np.clip(kinds, ABSENT, 2**31)
    met = np.zeros(len(things)) if met.size == 0 else met != 0
    for name, values, shape in (("velocity", velocity, position.shape), ("kinds", kinds, (len(things),)),
                                ("met", met, (len(things),)), ("things", things, (len(things), len(position)))):
        if values.shape != shape:
            raise ValueError(f"scene.{name} must have the shape {shape}, but has {values.shape}")
    return Scene(*map(np.ascontiguousarray, (position, velocity, things)), kinds.astype(np.int64), met.astype(np.int64))


@dataclass(frozen=True)
class Actions(checks.Final):
    """The actions that an agent can take in a world.

    names: one string or more, all different. pushes: for each action, the direction in which it pushes the agent, a
        number for every axis of the world; a node's desire vector is the sum of pushes times values (paper C,
        section 1).
    idle: the name of doing nothing, which is not an event to learn from; None if the agent cannot be idle.

    In kernels, an action is its place in `names`, and idleness is the number of names.
    Raises ValueError for anything else.
    """

    names: Sequence[str]
    pushes: Sequence[Sequence[float]]
    idle: str | None = None

    def __post_init__(self):
        names = tuple(str(checks.instance("names", each, str)) for each in checks.several("names", self.names))
        pushes = tuple(tuple(checks.real("pushes", value) for value in checks.several("pushes", each))
                       for each in checks.several("pushes", self.pushes))
        if self.idle is not None:
            checks.assign(self, idle=str(checks.instance("idle", self.idle, str)))
        if not names or len({*names, self.idle}) <= len(names):
            raise checks.error("names", f"one or more, all different, and other than idle, {self.idle!r}", self.names)
        if len(pushes) != len(names) or len({len(each) for each in pushes}) != 1 or not pushes[0]:
            raise checks.error("pushes", "as many as names, all of as many axes", self.pushes)
        if len(pushes[0]) > MOST_AXES or len(names) > MOST_ACTIONS:
            raise checks.error("pushes", f"of {MOST_AXES} axes and {MOST_ACTIONS} actions or fewer", self.pushes)
        checks.assign(self, names=names, pushes=pushes)

    @property
    def axes(self) -> int:
        """The number of axes of the world."""
        return len(self.pushes[0])

    @property
    def table(self) -> NDArray[np.float64]:
        """The pushes of all actions in the order of their numbers, idleness last: float64 (actions, axes)."""
        return np.array([*self.pushes, *[(0.0,) * self.axes] * (self.idle is not None)], float)

    @property
    def all_names(self) -> tuple[str, ...]:
        """The names of all actions in the order of their numbers, idleness last."""
        return tuple(self.names) if self.idle is None else (*self.names, self.idle)


# North is up on a page: towards a smaller y.
CARDINAL = Actions(("N", "S", "E", "W"), ((0, -1), (0, 1), (1, 0), (-1, 0)), "no-op")
