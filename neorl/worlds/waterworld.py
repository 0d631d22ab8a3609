"""WaterWorld: a square tank, an agent with inertia, and creeps that drift and bounce.

Rules, as in the PyGame Learning Environment (Tasfi 2016; thesis section 4.2), for a side of `width` pixels:

1. An action adds a quarter of the width to one component of the agent's velocity (per step, not per second; north
   is −y), or nothing. Then the agent moves. A coordinate that stays inside [0, width − 2 radius] keeps 97.5 % of its
   velocity; one that leaves is clamped to the wall, and its velocity becomes 0.
2. A creep is touched when the positions, in whole pixels, differ by less than two radii along both axes: squares, not
   discs. Pygame rounds positions since version 2, and truncated them before. A touched creep pays +1 if green and −1 if
   red, and a fresh creep takes its place.
3. If no green creep is left, the step also pays `win_reward` and the episode is over.
4. Every creep, including fresh ones, moves at its own constant speed. At a wall it is clamped, and bounces: that
   component of its direction is multiplied by −(1 + jitter / 2), and the direction is normalised.
5. A fresh creep is green or red with equal probability, 1.5 radii or more from the walls and 1.5 pixels or more from
   the agent. It moves along a diagonal, at up to a quarter of the width per second.
6. An episode begins with the agent at rest in the centre and with fresh creeps, at least one of them green.

The tank is 250 pixels wide with 50 steps per second by default; the origin is the upper left corner.
"""

import math
from dataclasses import dataclass
from typing import Annotated, NamedTuple

import numpy as np

from neorl.common import checks
from neorl.common.checks import AtLeastOne, OneOf, Within
from neorl.core.choices import Action
from neorl.core.scene import CARDINAL, Scene
from neorl.core.stream import randint, uniform
from neorl.kernels.annotations import array
from neorl.kernels.kernel import inlined_kernel, kernel
from neorl.worlds.world import Dynamics, World

GREEN, RED = range(2)
CONTACTS = ("rounded", "truncated")
DRAG = 0.975
DIAGONAL = 1.0 / math.sqrt(2.0)


class WaterWorldState(NamedTuple):
    """The state of a tank of n creeps, in pixels and seconds. The things of the scene are the creeps."""

    scene: Scene
    direction: array("float64", "things", 2)  # of each creep, of length 1
    speed: array("float64", "things")
    jitter: array("float64", "things")  # in [0, 1]
    stream: array("uint64", 4)  # random numbers for fresh creeps


class Rules(NamedTuple):
    """The constants of a tank, as the kernels take them."""

    width: float
    radius: float
    dt: float  # seconds per step
    win_reward: float
    rounding: float  # added to a coordinate before it is truncated to whole pixels


@kernel
def draw_creep(state, rules, creep):
    """Put a fresh creep into a slot (rule 5)."""
    state.scene.kinds[creep] = GREEN if uniform(state.stream) < 0.5 else RED
    margin = 1.5 * rules.radius
    distance_squared = 0.0
    while distance_squared < 1.5 * 1.5:
        x = margin + uniform(state.stream) * (rules.width - 2.0 * margin)
        y = margin + uniform(state.stream) * (rules.width - 2.0 * margin)
        dx, dy = x - state.scene.position[0], y - state.scene.position[1]
        distance_squared = dx * dx + dy * dy
    state.scene.things[creep, 0] = x
    state.scene.things[creep, 1] = y
    state.direction[creep, 0] = DIAGONAL if randint(state.stream, 2) == 1 else -DIAGONAL
    state.direction[creep, 1] = DIAGONAL if randint(state.stream, 2) == 1 else -DIAGONAL
    state.speed[creep] = uniform(state.stream) * 0.25 * rules.width
    state.jitter[creep] = uniform(state.stream)


@kernel
def reset(state: WaterWorldState, rules: Rules) -> None:
    """Start an episode (rule 6)."""
    for axis in range(2):
        state.scene.position[axis] = 0.5 * rules.width
        state.scene.velocity[axis] = 0.0
    greens = 0
    while greens == 0:
        for creep in range(state.speed.shape[0]):
            draw_creep(state, rules, creep)
            greens += state.scene.kinds[creep] == GREEN


@kernel
def step(state: WaterWorldState, rules: Rules, action: int):
    """Advance the state by one step: rules 1 to 4, in this order. Returns (reward, done)."""
    move_agent(state.scene, rules, action)
    reward, done = touch_creeps(state, rules)
    for creep in range(state.speed.shape[0]):
        move_creep(state, rules, creep)
    return reward, done


@inlined_kernel
def move_agent(scene, rules, action):
    """Accelerate and move the agent (rule 1)."""
    if action != Action.no_op:
        axis = 1 if action <= Action.S else 0
        sign = -1.0 if action == Action.N or action == Action.W else 1.0
        scene.velocity[axis] += sign * 0.25 * rules.width
    highest = rules.width - 2.0 * rules.radius
    for axis in range(2):
        position = scene.position[axis] + scene.velocity[axis] * rules.dt
        # The original tests ≥ in x and > in y.
        if position > highest or (position == highest and axis == 0):
            scene.position[axis] = highest
            scene.velocity[axis] = 0.0
        elif position < 0.0:
            scene.position[axis] = 0.0
            scene.velocity[axis] = 0.0
        else:
            scene.position[axis] = position
            scene.velocity[axis] *= DRAG


@inlined_kernel
def touch_creeps(state, rules):
    """Take the creeps that the agent touches (rules 2 and 3). Returns (reward, done)."""
    agent_x = np.floor(state.scene.position[0] + rules.rounding)
    agent_y = np.floor(state.scene.position[1] + rules.rounding)
    reach = 2.0 * rules.radius
    reward, greens = 0.0, 0
    for creep in range(state.speed.shape[0]):
        dx = abs(agent_x - np.floor(state.scene.things[creep, 0] + rules.rounding))
        dy = abs(agent_y - np.floor(state.scene.things[creep, 1] + rules.rounding))
        state.scene.met[creep] = 0
        if dx < reach and dy < reach:
            state.scene.met[creep] = 1 + state.scene.kinds[creep]
            reward += 1.0 if state.scene.kinds[creep] == GREEN else -1.0
            draw_creep(state, rules, creep)
        greens += state.scene.kinds[creep] == GREEN
    if greens == 0:
        reward += rules.win_reward
    return reward, greens == 0


@inlined_kernel
def move_creep(state, rules, creep):
    """Move a creep, and let it bounce (rule 4)."""
    low, high = rules.radius, rules.width - rules.radius
    bounce = -(1.0 + 0.5 * state.jitter[creep])
    for axis in range(2):
        direction = state.direction[creep, axis]
        position = state.scene.things[creep, axis] + direction * state.speed[creep] * rules.dt
        if position > high:
            position, direction = high, direction * bounce
        elif position <= low:
            position, direction = low, direction * bounce
        state.scene.things[creep, axis] = position
        state.direction[creep, axis] = direction
    x, y = state.direction[creep, 0], state.direction[creep, 1]
    length = math.sqrt(x * x + y * y)
    if length != 1.0:  # as it mostly is: divisions are slow
        state.direction[creep, 0] = x / length
        state.direction[creep, 1] = y / length


@dataclass(frozen=True)
class WaterWorld(World, checks.Final):
    """The rules of one tank.

    width: pixels per side, 11 … 2³¹, so that the radius of 4.7 % rounds to a pixel or more.
    n_creeps: creeps in the tank at any time, 1 … 2²⁰.
    fps: steps per simulated second, 1 … 2³¹. An action acts per step, so this changes the task.
    win_reward: paid as well when the last green creep is taken: 5 in the original and in paper A, 0 in papers B and C.
        From −10³⁰ to 10³⁰, so that the rewards of a bin do not overflow.
    contact: whether positions are "rounded" to whole pixels before they are compared, as in pygame 2, or "truncated",
        as in pygame 1.9.

    Raises ValueError for anything else.
    """

    kinds = ("green", "red")
    dynamics = Dynamics(reset, step)
    actions = CARDINAL
    bounded = True

    width: AtLeastOne = 250
    n_creeps: Annotated[int, Within(1, 2**20)] = 3
    fps: AtLeastOne = 50
    win_reward: float = 0.0
    contact: Annotated[str, OneOf(CONTACTS)] = "rounded"

    def __post_init__(self):
        checks.check_fields(self)
        if self.radius < 1:
            raise checks.error("width", "11 pixels or more, since a creep's radius is 4.7 % of it", self.width)

    @property
    def size(self) -> int:
        """The width, which is the unit of length for agents."""
        return self.width

    @property
    def things(self) -> int:
        """The number of creeps."""
        return self.n_creeps

    @property
    def radius(self) -> int:
        """The radius of agent and creeps in whole pixels."""
        return round(0.047 * self.width)

    @property
    def rules(self) -> Rules:
        """The rules as the kernels take them."""
        return Rules(float(self.width), float(self.radius), 1.0 / self.fps, float(self.win_reward),
                     0.5 if self.contact == "rounded" else 0.0)

    def check_state(self, state: WaterWorldState) -> None:
        """Raise ValueError unless a state fits this world and is finite."""
        super().check_state(state)
        if not np.all(np.abs(np.linalg.norm(state.direction, axis=1) - 1.0) < 1e-6):
            raise checks.error("state.direction", "vectors of length 1", state.direction)
        if not np.all((0.0 <= state.jitter) & (state.jitter <= 1.0)):
            raise checks.error("state.jitter", "numbers from 0 to 1", state.jitter)
