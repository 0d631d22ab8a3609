"""WaterWorld: a square tank, an agent with inertia, and creeps that drift and bounce.

Rules, as in the PyGame Learning Environment (Tasfi 2016; thesis section 4.2), for a side of `width` pixels:

1. The agent's action adds a quarter of the width to one component of its velocity (per step, not per second; north
   is −y), or nothing. Then it moves. A component that stays inside [0, width − 2 radius] keeps 97.5 % of its
   velocity, one that leaves is clamped to the wall and stopped.
2. A creep is touched where the positions, in whole pixels, differ by less than two radii in both axes: squares, not
   discs. Pygame rounds positions since version 2, and cut off what is behind the point before. A creep that is touched
   pays +1 if green and −1 if red, and a fresh creep takes its place.
3. If no green creep is left, the step also pays `win_reward` and the episode is over.
4. Every creep, fresh ones too, moves at its own constant speed. At a wall it is clamped and turns back with a jitter.

The tank is 250 pixels wide with 50 steps a second unless told otherwise; the origin is the upper left corner.
"""

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from neorl import checks
from neorl.core.choices import Action
from neorl.core.kernel import array, execute, fields, kernel, length, new_tuple
from neorl.core.stream import new_stream, randint, uniform

ACTIONS = ("N", "S", "E", "W", "no-op")
CONTACTS = ("rounded", "truncated")
DRAG = 0.975
DIAGONAL = 1.0 / math.sqrt(2.0)


class WaterWorldState(NamedTuple):
    """All that changes in a tank of n creeps, in pixels and seconds.

    Every field is an array that can be written to; assigning to a field copies into it.
    """

    agent_position: array("float64", 2)  # x, y
    agent_velocity: array("float64", 2)
    creep_position: array("float64", "things", 2)
    creep_direction: array("float64", "things", 2)  # of length 1
    creep_speed: array("float64", "things")
    creep_is_green: array("bool", "things")
    creep_jitter: array("float64", "things")  # in [0, 1]
    stream: array("uint64", 4)  # the random numbers of fresh creeps

    def __setattr__(self, name, value):
        getattr(self, name)[...] = value


class Rules(NamedTuple):
    """All that stays the same in a tank, as the kernels take it."""

    width: float
    radius: float
    dt: float  # seconds a step
    win_reward: float
    rounding: float  # what is added to a coordinate before it is cut to whole pixels


@dataclass(frozen=True)
class WaterWorld:
    """The rules of one tank.

    width: pixels a side, 11 … 2³¹, so that the radius of 4.7 % rounds to a pixel or more.
    n_creeps: creeps in the tank at any time, 1 … 2²⁰.
    fps: steps in a simulated second, 1 … 2³¹. An action works per step, so this changes the task.
    win_reward: paid on top when the last green creep is taken: 5 in the original and in paper A, 0 in papers B and C.
    contact: whether positions are "rounded" to whole pixels before they are compared, as in pygame 2, or "truncated",
        as in pygame 1.9.

    Raises ValueError for anything else.
    """

    width: int = 250
    n_creeps: int = 3
    fps: int = 50
    win_reward: float = 0.0
    contact: str = "rounded"

    def __post_init__(self):
        checks.assign(self, width=checks.integer("width", self.width, at_least=1, at_most=2**31))
        if self.radius < 1:
            raise ValueError(f"width is {self.width}, allowed are 11 pixels or more: a creep's radius is 4.7 % of it")
        checks.assign(self, n_creeps=checks.integer("n_creeps", self.n_creeps, at_least=1, at_most=2**20),
                     fps=checks.integer("fps", self.fps, at_least=1, at_most=2**31),
                     win_reward=checks.real("win_reward", self.win_reward),
                     contact=checks.one_of("contact", self.contact, CONTACTS))

    @property
    def radius(self):
        """The radius of agent and creeps in whole pixels."""
        return round(0.047 * self.width)

    @property
    def rules(self):
        """The rules as the kernels take them."""
        return Rules(float(self.width), float(self.radius), 1.0 / self.fps, float(self.win_reward),
                     0.5 if self.contact == "rounded" else 0.0)

    def reset(self, seed):
        """A fresh state: the agent at rest in the centre, creeps drawn until one is green.

        seed: an integer ≥ 0 or a `numpy.random.SeedSequence`.
        """
        if not isinstance(seed, np.random.SeedSequence):
            seed = np.random.SeedSequence(checks.integer("seed", seed, at_least=0))
        state = new_tuple(WaterWorldState, {"things": self.n_creeps}, {"stream": new_stream(seed)})
        execute(reset_board, state, self.rules)
        return state

    def step(self, state, action):
        """Advance `state` in place by one step.

        action: 0 … 4 for N, S, E, W and no-op, or one of those names.
        Returns (reward: float, hits: bool (n_creeps,), done: bool). After `done` the state holds the last board;
        `reset` gives the next one.
        Raises ValueError for an unknown action, a state of another number of creeps, or one that is not finite.
        """
        action = ACTIONS.index(checks.one_of("action", action, ACTIONS)) if isinstance(action, str) else action
        action = checks.integer("action", action, at_least=0, at_most=Action.no_op)
        check_state(state, self)
        contacts = np.zeros(self.n_creeps, np.int8)
        reward, done = execute(step_board, state, self.rules, action, contacts)
        return float(reward), contacts != 0, bool(done)


def check_state(state, world):
    """Raise ValueError unless a state has the creeps of the world, and is finite."""
    checks.instance("state", state, WaterWorldState)
    for name, (dtype, shape) in fields(WaterWorldState).items():
        value = getattr(state, name)
        expected = tuple(length(each, {"things": world.n_creeps}) for each in shape)
        if not isinstance(value, np.ndarray) or (value.dtype, value.shape) != (np.dtype(dtype), expected):
            found = f"{value.dtype} {value.shape}" if isinstance(value, np.ndarray) else repr(value)
            raise ValueError(f"state.{name} is {found}, allowed with n_creeps = {world.n_creeps} is {dtype} {expected}")
        checks.finite(f"state.{name}", value)
    if not np.any(state.creep_direction, axis=1).all():
        raise ValueError(f"state.creep_direction is {state.creep_direction!r}, allowed are vectors of length 1")


@kernel
def draw_creep(board, rules, creep):
    """Put a fresh creep into a slot: anywhere but within 1.5 pixels of the agent."""
    board.creep_is_green[creep] = uniform(board.stream) < 0.5
    margin = 1.5 * rules.radius
    distance_squared = 0.0
    while distance_squared < 1.5 * 1.5:
        x = margin + uniform(board.stream) * (rules.width - 2.0 * margin)
        y = margin + uniform(board.stream) * (rules.width - 2.0 * margin)
        dx, dy = x - board.agent_position[0], y - board.agent_position[1]
        distance_squared = dx * dx + dy * dy
    board.creep_position[creep, 0] = x
    board.creep_position[creep, 1] = y
    board.creep_direction[creep, 0] = DIAGONAL if randint(board.stream, 2) == 1 else -DIAGONAL
    board.creep_direction[creep, 1] = DIAGONAL if randint(board.stream, 2) == 1 else -DIAGONAL
    board.creep_speed[creep] = uniform(board.stream) * 0.25 * rules.width
    board.creep_jitter[creep] = uniform(board.stream)


@kernel
def reset_board(board: WaterWorldState, rules: Rules) -> None:
    """Start an episode: the agent at rest in the centre, fresh creeps, at least one of them green."""
    for axis in range(2):
        board.agent_position[axis] = 0.5 * rules.width
        board.agent_velocity[axis] = 0.0
    greens = 0
    while greens == 0:
        for creep in range(board.creep_speed.shape[0]):
            draw_creep(board, rules, creep)
            greens += board.creep_is_green[creep]


@kernel
def step_board(board, rules, action, contacts):
    """One step of the rules. Returns (reward, done); `contacts` takes what each creep paid, 0 if untouched."""
    move_agent(board, rules, action)
    reward, done = touch_creeps(board, rules, contacts)
    for creep in range(contacts.shape[0]):
        move_creep(board, rules, creep)
    return reward, done


@kernel
def move_agent(board, rules, action):
    if action != Action.no_op:
        axis = 1 if action <= Action.S else 0
        sign = -1.0 if action == Action.N or action == Action.W else 1.0
        board.agent_velocity[axis] += sign * 0.25 * rules.width
    highest = rules.width - 2.0 * rules.radius
    for axis in range(2):
        position = board.agent_position[axis] + board.agent_velocity[axis] * rules.dt
        # The original tests ≥ in x and > in y.
        if position > highest or (position == highest and axis == 0):
            board.agent_position[axis] = highest
            board.agent_velocity[axis] = 0.0
        elif position < 0.0:
            board.agent_position[axis] = 0.0
            board.agent_velocity[axis] = 0.0
        else:
            board.agent_position[axis] = position
            board.agent_velocity[axis] *= DRAG


@kernel
def touch_creeps(board, rules, contacts):
    agent_x = np.floor(board.agent_position[0] + rules.rounding)
    agent_y = np.floor(board.agent_position[1] + rules.rounding)
    reach = 2.0 * rules.radius
    reward, greens = 0.0, 0
    for creep in range(contacts.shape[0]):
        dx = abs(agent_x - np.floor(board.creep_position[creep, 0] + rules.rounding))
        dy = abs(agent_y - np.floor(board.creep_position[creep, 1] + rules.rounding))
        contacts[creep] = 0
        if dx < reach and dy < reach:
            contacts[creep] = 1 if board.creep_is_green[creep] else -1
            reward += contacts[creep]
            draw_creep(board, rules, creep)
        greens += board.creep_is_green[creep]
    if greens == 0:
        reward += rules.win_reward
    return reward, greens == 0


@kernel
def move_creep(board, rules, creep):
    low, high = rules.radius, rules.width - rules.radius
    bounce = -(1.0 + 0.5 * board.creep_jitter[creep])
    for axis in range(2):
        direction = board.creep_direction[creep, axis]
        position = board.creep_position[creep, axis] + direction * board.creep_speed[creep] * rules.dt
        if position > high:
            position, direction = high, direction * bounce
        elif position <= low:
            position, direction = low, direction * bounce
        board.creep_position[creep, axis] = position
        board.creep_direction[creep, axis] = direction
    x, y = board.creep_direction[creep, 0], board.creep_direction[creep, 1]
    length = math.sqrt(x * x + y * y)
    board.creep_direction[creep, 0] = x / length
    board.creep_direction[creep, 1] = y / length
