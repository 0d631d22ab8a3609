"""A small world of a user's own, for tests: steps in a square pond, whose lily pad ends an episode."""

from dataclasses import dataclass
from typing import NamedTuple

from neorl import CARDINAL, Dynamics, Scene, World, array, kernel, uniform


class PondState(NamedTuple):
    scene: Scene
    stream: array("uint64", 4)


class PondRules(NamedTuple):
    push: array("float64", 5, 2)


@kernel
def reset(state: PondState, rules: PondRules) -> None:
    scene = state.scene
    for axis in range(2):
        scene.position[axis] = uniform(state.stream)
    scene.things[0, 0], scene.things[0, 1] = 0.8, 0.3
    scene.kinds[0] = scene.met[0] = 0


@kernel
def step(state: PondState, rules: PondRules, action: int):
    scene = state.scene
    for axis in range(2):
        scene.position[axis] = min(max(scene.position[axis] + 0.04 * rules.push[action, axis], 0.0), 1.0)
    dx, dy = scene.position[0] - scene.things[0, 0], scene.position[1] - scene.things[0, 1]
    found = dx * dx + dy * dy < 0.01
    scene.met[0] = 1 if found else 0
    return (1.0 if found else 0.0), found


@dataclass(frozen=True)
class Pond(World):
    kinds, actions, things, size, fps = ("pad",), CARDINAL, 1, 1.0, 10
    dynamics = Dynamics(reset, step)

    @property
    def rules(self):
        return PondRules(CARDINAL.table)
