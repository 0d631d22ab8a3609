"""A vessel with a rudder in a current, which calls at waypoints among other vessels (thesis, figure 1.1).

1. The vessel moves through the water at a constant `speed` in the direction of its bow. The `current` carries it along,
   so it moves over the ground by (speed · heading + current) · dt. At the edge of the area it stops along that axis.
2. The rudder is to port, to starboard, or amidships when idle. The rate of turn follows it with a lag (Nomoto et al.
   1957): rate += (rudder · `turning` − rate) · dt / `lag`. The heading, a vector of length 1, then turns by rate · dt,
   to second order: by twice the angle whose tangent is rate · dt / 2.
3. The scene contains the position; the velocity through the water, as compass and log show it; and, as things, one
   waypoint and the other vessels. It shows neither the current nor the rate of turn.
4. A waypoint within `radius` pays 1, and a fresh one takes its place. Another vessel within `radius` is a collision: it
   pays −1, and a fresh one takes its place. Each is drawn uniformly over the area, and redrawn while it is within
   `CLEAR` of the vessel.
5. The other vessels keep their course, one of eight, and their speed over the ground, drawn uniformly from 0 to
   `speed`; at the edge they are reflected.
6. The vessel starts in the middle, heading east, its rudder amidships. The episode never ends.

The area is 1 wide and high; x points east and y points down, to the south.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Annotated, NamedTuple

import numpy as np

from neorl.common import checks
from neorl.common.checks import AtLeastOne, Within
from neorl.core.scene import Actions, Scene
from neorl.core.stream import randint, uniform
from neorl.kernels.annotations import array
from neorl.kernels.kernel import kernel
from neorl.worlds.world import Dynamics, World, squared_distance

HELM = Actions(("port", "starboard"), ((0.0, 0.0), (0.0, 0.0)), "amidships")
CLEAR = 0.25  # widths of the area
WAYPOINT, TRAFFIC = range(2)
PORT, STARBOARD = range(2)
DIAGONAL = math.sqrt(0.5)


class VesselState(NamedTuple):
    """The state of the vessel and its surroundings."""

    scene: Scene
    heading: array("float64", 2)  # of length 1
    rate: array("float64", 1)  # of turn, radians per second, positive to starboard
    course: array("float64", "things", 2)  # over the ground, widths per second
    stream: array("uint64", 4)


class VesselRules(NamedTuple):
    """The constants of the waters, as the kernels take them."""

    dt: float  # seconds per step
    speed: float
    turning: float
    lag: float
    radius: float
    current: array("float64", 2)


@kernel
def reset(state: VesselState, rules: VesselRules) -> None:
    """Start in the middle, heading east."""
    scene = state.scene
    state.heading[0], state.heading[1], state.rate[0] = 1.0, 0.0, 0.0
    for axis in range(2):
        scene.position[axis] = 0.5
        scene.velocity[axis] = rules.speed * state.heading[axis]
    for thing in range(scene.met.shape[0]):
        scene.kinds[thing] = WAYPOINT if thing == 0 else TRAFFIC
        scene.met[thing] = 0
        draw_thing(state, rules, thing)


@kernel
def step(state: VesselState, rules: VesselRules, action: int):
    """Advance the state by one step of the rules. Returns (reward, done)."""
    scene, reward = state.scene, 0.0
    steer(state, rules, action)
    for axis in range(2):
        at = scene.position[axis] + (scene.velocity[axis] + rules.current[axis]) * rules.dt
        scene.position[axis] = min(max(at, 0.0), 1.0)
    for thing in range(scene.met.shape[0]):
        meets = squared_distance(scene.things[thing], scene.position) < rules.radius * rules.radius
        scene.met[thing] = 1 + scene.kinds[thing] if meets else 0
        if meets:
            reward += 1.0 if scene.kinds[thing] == WAYPOINT else -1.0
            draw_thing(state, rules, thing)
        sail(state, rules, thing)
    return reward, False


@kernel
def steer(state, rules, action):
    """Turn the vessel by its rudder."""
    rudder = 1.0 if action == STARBOARD else -1.0 if action == PORT else 0.0
    state.rate[0] += (rudder * rules.turning - state.rate[0]) * rules.dt / rules.lag
    tangent = 0.5 * state.rate[0] * rules.dt
    square = tangent * tangent
    cosine, sine = (1.0 - square) / (1.0 + square), 2.0 * tangent / (1.0 + square)
    x, y = state.heading[0], state.heading[1]
    x, y = cosine * x - sine * y, sine * x + cosine * y
    length = math.sqrt(x * x + y * y)  # rounding would change it in the course of many turns
    state.heading[0], state.heading[1] = x / length, y / length
    for axis in range(2):
        state.scene.velocity[axis] = rules.speed * state.heading[axis]


@kernel
def sail(state, rules, thing):
    """Advance another vessel along its course; that of a waypoint is 0."""
    for axis in range(2):
        at = state.scene.things[thing, axis] + state.course[thing, axis] * rules.dt
        if at < 0.0:
            at, state.course[thing, axis] = -at, -state.course[thing, axis]
        elif at > 1.0:
            at, state.course[thing, axis] = 2.0 - at, -state.course[thing, axis]
        state.scene.things[thing, axis] = at


@kernel
def draw_thing(state, rules, thing):
    """Put a fresh waypoint or vessel into a slot."""
    scene = state.scene
    scene.things[thing, 0], scene.things[thing, 1] = uniform(state.stream), uniform(state.stream)
    while squared_distance(scene.things[thing], scene.position) < CLEAR * CLEAR:
        scene.things[thing, 0], scene.things[thing, 1] = uniform(state.stream), uniform(state.stream)
    state.course[thing, 0] = state.course[thing, 1] = 0.0
    if scene.kinds[thing] == TRAFFIC:
        east, south = randint(state.stream, 3) - 1.0, randint(state.stream, 3) - 1.0
        while east == 0.0 and south == 0.0:
            east, south = randint(state.stream, 3) - 1.0, randint(state.stream, 3) - 1.0
        speed = rules.speed * uniform(state.stream) * (DIAGONAL if east != 0.0 and south != 0.0 else 1.0)
        state.course[thing, 0], state.course[thing, 1] = speed * east, speed * south


@dataclass(frozen=True)
class Vessel(World, checks.Final):
    """A vessel among others, see the module for its rules. Lengths are in widths of the area.

    traffic: the number of other vessels, 0 … 64.
    current: (x, y), widths per second, each at most `speed` in magnitude.
    speed: widths per second through the water, 10⁻³ … 1. turning: the steady rate of turn with the rudder over, radians
        per second, 10⁻³ … 10. lag: the time constant of the rate of turn, seconds, at least one step.
    radius: the distance within which things are met, 10⁻³ … 0.1. fps: steps per second, 1 … 2³¹.

    Raises ValueError for anything else.
    """

    traffic: Annotated[int, Within(0, 64)] = 3
    current: Sequence[float] = (0.03, 0.0)
    speed: Annotated[float, Within(1e-3, 1)] = 0.1
    turning: Annotated[float, Within(1e-3, 10)] = 1.0
    lag: float = 0.5
    radius: Annotated[float, Within(1e-3, 0.1)] = 0.05
    fps: AtLeastOne = 10

    kinds = ("waypoint", "vessel")
    dynamics = Dynamics(reset, step)
    actions = HELM
    size = 1.0

    def __post_init__(self):
        checks.check_fields(self)
        checks.assign(self, lag=checks.real("lag", self.lag, 1 / self.fps, 1e6),
                      current=tuple(checks.real("current", each, -self.speed, self.speed)
                                    for each in checks.several("current", self.current)))
        if len(self.current) != 2:
            raise checks.error("current", "(x, y)", self.current)

    @property
    def things(self) -> int:
        """The number of things: the waypoint and the other vessels."""
        return 1 + self.traffic

    @property
    def rules(self) -> VesselRules:
        """The rules as the kernels take them."""
        return VesselRules(1.0 / self.fps, self.speed, self.turning, self.lag, self.radius, np.array(self.current))

    def check_state(self, state: VesselState) -> None:
        """Raise ValueError unless a state fits this world, is finite, and has a heading of length 1."""
        super().check_state(state)
        if not abs(np.linalg.norm(state.heading) - 1.0) < 1e-6:
            raise checks.error("state.heading", "a vector of length 1", state.heading)
