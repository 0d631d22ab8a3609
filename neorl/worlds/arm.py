"""A robot arm of two or three links, whose hand reaches for targets and avoids obstacles, in the space of its joints.

1. The base is fixed. The angle of the first joint is that of the first link to the x axis, the angle of every other
   joint that of its link to the previous link; angles are in turns, 0 ≤ angle < 1, and close on themselves. The total
   length of the links is 1.
2. An action adds `PUSH` turns per second to the velocity of one joint, or subtracts as much. Then each joint turns by
   velocity · dt, and keeps `DRAG` of its velocity. Idleness adds nothing.
3. A target, or an obstacle, is the point that the hand reaches in some posture. The scene contains postures: the arm's
   own as the position, that of each point as the place of a thing. The hand can reach a point in other postures, too.
4. A point is met when the hand is within `radius` of it. That pays 1 for a target and −1 for an obstacle, and a fresh
   point of the same kind takes its place: that of a posture whose angles are drawn uniformly, and redrawn while the
   point is within two radii of the hand.
5. The arm starts at rest, stretched along the x axis, among fresh points. The episode never ends.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Annotated, NamedTuple

import numpy as np

from neorl.common import checks
from neorl.common.checks import AtLeastOne, Within
from neorl.core.direction import circle
from neorl.core.scene import Actions, Scene
from neorl.core.stream import uniform
from neorl.kernels.annotations import array
from neorl.kernels.kernel import kernel
from neorl.worlds.world import Dynamics, World, squared_distance

PUSH = 0.05  # turns per second
DRAG = 0.9  # share of the velocity that a step retains
TERMS = 10  # of the series of sine and cosine, exact to the last few bits
TARGET, OBSTACLE = range(2)


class ArmState(NamedTuple):
    """The state of an arm."""

    scene: Scene
    hand: array("float64", 2)
    point: array("float64", "things", 2)  # position of the hand in the posture of each thing
    stream: array("uint64", 4)


class ArmRules(NamedTuple):
    """The constants of an arm, as the kernels take them."""

    dt: float  # seconds per step
    radius: float
    targets: int
    length: array("float64", "axes")


@kernel
def reset(state: ArmState, rules: ArmRules) -> None:
    """Start at rest, stretched along the x axis."""
    scene = state.scene
    for joint in range(rules.length.shape[0]):
        scene.position[joint] = scene.velocity[joint] = 0.0
    find_hand(scene.position, rules.length, state.hand)
    for thing in range(scene.met.shape[0]):
        scene.kinds[thing] = TARGET if thing < rules.targets else OBSTACLE
        scene.met[thing] = 0
        draw_point(state, rules, thing)


@kernel
def step(state: ArmState, rules: ArmRules, action: int):
    """Advance the state by one step of the rules. Returns (reward, done)."""
    scene, reward = state.scene, 0.0
    if action < 2 * rules.length.shape[0]:
        scene.velocity[action // 2] += PUSH if action % 2 == 0 else -PUSH
    for joint in range(rules.length.shape[0]):
        angle = scene.position[joint] + scene.velocity[joint] * rules.dt
        angle -= np.floor(angle)
        scene.position[joint] = angle if angle < 1.0 else 0.0
        scene.velocity[joint] *= DRAG
    find_hand(scene.position, rules.length, state.hand)
    for thing in range(scene.met.shape[0]):
        meets = squared_distance(state.point[thing], state.hand) < rules.radius * rules.radius
        scene.met[thing] = 1 + scene.kinds[thing] if meets else 0
        if meets:
            reward += 1.0 if scene.kinds[thing] == TARGET else -1.0
            draw_point(state, rules, thing)
    return reward, False


@kernel
def draw_point(state, rules, thing):
    """Put a fresh point into a slot."""
    posture = state.scene.things[thing]
    near = 4.0 * rules.radius * rules.radius
    while True:
        for joint in range(rules.length.shape[0]):
            posture[joint] = uniform(state.stream)
        find_hand(posture, rules.length, state.point[thing])
        if squared_distance(state.point[thing], state.hand) >= near:
            return


@kernel
def find_hand(posture, length, hand):
    """Compute the position of the hand in a posture, in `hand`: (x, y), the base at the origin, y downward."""
    along_x, along_y = 1.0, 0.0  # the direction of the link
    hand[0] = hand[1] = 0.0
    for joint in range(length.shape[0]):
        cosine, sine = circle(posture[joint], TERMS)
        along_x, along_y = along_x * cosine - along_y * sine, along_x * sine + along_y * cosine
        hand[0] += length[joint] * along_x
        hand[1] += length[joint] * along_y


@dataclass(frozen=True)
class Arm(World, checks.Final):
    """A robot arm, see the module for its rules. Lengths are fractions of the total length of the links.

    lengths: of the links, two or three numbers > 0 in any unit.
    targets, obstacles: their numbers at any time, integers 0 … 64, one or more together.
    radius: the distance within which a point is met, 10⁻³ … 0.2. fps: steps per second, 1 … 2³¹.

    Raises ValueError for anything else.
    """

    lengths: Sequence[float] = (0.5, 0.5)
    targets: Annotated[int, Within(0, 64)] = 1
    obstacles: Annotated[int, Within(0, 64)] = 1
    radius: Annotated[float, Within(1e-3, 0.2)] = 0.1
    fps: AtLeastOne = 20

    kinds = ("target", "obstacle")
    size = 1.0
    dynamics = Dynamics(reset, step)

    def __post_init__(self):
        checks.check_fields(self)
        checks.assign(self, lengths=tuple(checks.real("lengths", each, 1e-6, 1e6)
                                          for each in checks.several("lengths", self.lengths)))
        if not 2 <= len(self.lengths) <= 3:
            raise checks.error("lengths", "two or three numbers, one for each link", self.lengths)
        if self.things == 0:
            raise ValueError("targets and obstacles must be one or more together, but are 0")

    @property
    def actions(self):
        """An `Actions`: each joint forward and backward, "1+", "1−", "2+" and so on."""
        joints = range(len(self.lengths))
        return Actions([f"{joint + 1}{sign}" for joint in joints for sign in "+−"],
                       [[sign * (axis == joint) for axis in joints] for joint in joints for sign in (1.0, -1.0)],
                       "no-op")

    @property
    def things(self) -> int:
        """The number of targets and obstacles."""
        return self.targets + self.obstacles

    @property
    def rules(self) -> ArmRules:
        """The rules as the kernels take them."""
        return ArmRules(1.0 / self.fps, self.radius, self.targets, np.array(self.lengths) / sum(self.lengths))
