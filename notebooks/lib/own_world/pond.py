"""A pond with a lily pad.

An agent takes steps in a square, and restarts elsewhere when it finds the pad.
"""

from dataclasses import dataclass
from typing import NamedTuple

from neorl import CARDINAL, Scene, World, kernel
from neorl.core.kernel import array
from neorl.core.stream import uniform
from neorl.worlds.world import Dynamics

PAD_X, PAD_Y, REACH, STRIDE = 0.8, 0.3, 0.1, 0.04


class PondState(NamedTuple):
    """Everything that changes."""

    scene: Scene
    stream: array("uint64", 4)


class PondRules(NamedTuple):
    """Everything that stays the same: the pushes of actions, and of none."""

    push: array("float64", 5, 2)


@kernel
def reset(state: PondState, rules: PondRules) -> None:
    """Begin at a random place."""
    scene = state.scene
    for axis in range(2):
        scene.position[axis] = uniform(state.stream)
    scene.things[0, 0], scene.things[0, 1] = PAD_X, PAD_Y
    scene.kinds[0] = scene.met[0] = 0


@kernel
def step(state: PondState, rules: PondRules, action: int):
    """Take a step inside the pond. Returns (reward, done)."""
    scene = state.scene
    for axis in range(2):
        moved = scene.position[axis] + STRIDE * rules.push[action, axis]
        scene.position[axis] = min(max(moved, 0.0), 1.0)
    dx, dy = scene.position[0] - PAD_X, scene.position[1] - PAD_Y
    found = dx * dx + dy * dy < REACH * REACH
    scene.met[0] = 1 if found else 0
    return (1.0 if found else 0.0), found


@dataclass(frozen=True)
class Pond(World):
    """The pond, which has no parameters."""

    kinds = ("pad",)
    actions = CARDINAL
    dynamics = Dynamics(reset, step)
    things = 1
    size = 1.0
    fps = 10

    @property
    def rules(self):
        """The rules as the kernels take them."""
        return PondRules(CARDINAL.table)
