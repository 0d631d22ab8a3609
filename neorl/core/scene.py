"""What an agent knows of a world: the `Scene` that it perceives, and the `Actions` that it can take."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from neorl import checks
from neorl.core.kernel import array

ABSENT = -1  # in place of the number of a kind


class Scene(NamedTuple):
    """What an agent perceives, in the world's units of length and in seconds."""

    position: array("float64", "axes")  # of the agent
    velocity: array("float64", "axes") = None
    things: array("float64", "things", "axes") = ()  # where they are
    kinds: array("int64", "things") = ()  # the number of each one's kind, or ABSENT
    met: array("int64", "things") = ()  # 0, or 1 + the kind of a thing met in this step, whose slot is a fresh one's


@dataclass(frozen=True)
class Actions(checks.Final):
    """What an agent can do in a world.

    names: one string or more, each once. pushes: for each the direction in which it pushes the agent, a number along
        every axis of the world; a node's desire vector is the sum of pushes times values (paper C, section 1).
    idle: the name of doing nothing, which is no event to learn from; None if the agent cannot.

    The kernels know an action by its place in `names`, and idleness by the number of names.
    Raises ValueError for anything else.
    """

    names: tuple[str, ...]
    pushes: tuple[tuple[float, ...], ...]
    idle: str | None = None

    def __post_init__(self):
        names = tuple(str(checks.instance("names", each, str)) for each in checks.several("names", self.names))
        pushes = tuple(tuple(checks.real("pushes", value) for value in checks.several("pushes", each))
                       for each in checks.several("pushes", self.pushes))
        if not names or len({*names, self.idle}) <= len(names):
            raise ValueError(f"names is {self.names!r}, allowed are one or more, each once, and others than idle, "
                             f"{self.idle!r}")
        if len(pushes) != len(names) or len({len(each) for each in pushes}) != 1 or not pushes[0]:
            raise ValueError(f"pushes is {self.pushes!r}, allowed are as many as names, all of as many axes")
        if self.idle is not None:
            checks.assign(self, idle=str(checks.instance("idle", self.idle, str)))
        checks.assign(self, names=names, pushes=pushes)

    @property
    def axes(self):
        """The number of axes of the world."""
        return len(self.pushes[0])

    @property
    def table(self):
        """The pushes of all actions in the order of their numbers, idleness last: float64 (actions, axes)."""
        return np.array([*self.pushes, *[(0.0,) * self.axes] * (self.idle is not None)], float)

    @property
    def all_names(self):
        """The names of all actions in the order of their numbers, idleness last."""
        return self.names if self.idle is None else (*self.names, self.idle)


# North is up on a page: towards a smaller y.
CARDINAL = Actions(("N", "S", "E", "W"), ((0, -1), (0, 1), (1, 0), (-1, 0)), "no-op")
