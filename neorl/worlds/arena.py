"""An arena in the plane, with walls, obstacles and places of interest; by default the water maze of Morris (1984).

1. The agent moves with inertia, as in WaterWorld: an action adds a quarter of the size to its velocity along an axis,
   and each step retains 97.5 % of the velocity; or it moves in plain steps of one length. Along an axis on which it
   would leave the arena, or enter or cross an obstacle, however thin, it stays in place and stops
   (`neorl.worlds.walls`).
2. The places are the things of the scene, and do not move. A place is met when the agent comes within `radius` of it.
   That pays the reward of its kind and, if `ends`, ends the trial; otherwise the place can be met again once the agent
   has left it.
3. A trial that is not over after `trial_seconds` ends without reward.
4. A trial starts at one of the four cardinal points of the rim, drawn at random, or at `start`.

The origin is the upper left corner; the pool, if round, touches all four sides.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Annotated, NamedTuple

import numpy as np

from neorl.common import checks
from neorl.common.checks import LARGEST, AtLeastOne, OneOf, Within
from neorl.core.scene import CARDINAL, Scene
from neorl.core.stream import randint
from neorl.kernels.annotations import array
from neorl.kernels.kernel import function_of, inlined_kernel, kernel
from neorl.worlds import walls
from neorl.worlds.waterworld import DRAG
from neorl.worlds.world import Dynamics, World, squared_distance

STARTS = (0.5, 0.05), (0.5, 0.95), (0.95, 0.5), (0.05, 0.5)  # of trials, at the rim
PUSH = 0.25  # sizes per second that an action adds to the velocity


class ArenaState(NamedTuple):
    """The state of an arena."""

    scene: Scene
    inside: array("bool", "things")  # whether the agent is within the radius of a place
    clock: array("int64", 1)  # steps since the trial began
    stream: array("uint64", 4)  # random numbers for the starts


class ArenaRules(NamedTuple):
    """The constants of an arena, as the kernels take them."""

    size: float
    dt: float  # seconds per step
    round: bool
    stride: float  # of a plain step, as a share of the size; 0 with inertia
    radius: float
    ends: bool
    last_step: int
    n_starts: int
    start: array("float64", 4, 2)
    push: array("float64", 5, 2)
    place: array("float64", "things", 2)
    kind: array("int64", "things")
    pay: array("float64", "things")
    obstacle: array("float64", "obstacles", 4)  # see `neorl.worlds.walls`


@kernel
def reset(state: ArenaState, rules: ArenaRules) -> None:
    """Start a trial, at rest."""
    scene, start = state.scene, randint(state.stream, rules.n_starts)
    for axis in range(2):
        scene.position[axis], scene.velocity[axis] = rules.start[start, axis], 0.0
    state.clock[0] = 0
    for place in range(rules.place.shape[0]):
        scene.things[place, 0], scene.things[place, 1] = rules.place[place, 0], rules.place[place, 1]
        scene.kinds[place], scene.met[place] = rules.kind[place], 0
        state.inside[place] = squared_distance(scene.position, rules.place[place]) < rules.radius * rules.radius


@kernel
def step(state: ArenaState, rules: ArenaRules, action: int):
    """Advance the state by one step of the rules. Returns (reward, done)."""
    scene, reward, met = state.scene, 0.0, 0
    move(scene, rules, action)
    for place in range(rules.place.shape[0]):
        near = squared_distance(scene.position, rules.place[place]) < rules.radius * rules.radius
        meets = near and not state.inside[place]
        scene.met[place] = 1 + rules.kind[place] if meets else 0
        state.inside[place] = near
        if meets:
            met += 1
            reward += rules.pay[place]
    state.clock[0] += 1
    return reward, rules.ends and met > 0 or state.clock[0] >= rules.last_step


@inlined_kernel
def move(scene, rules, action):
    """Move the agent, along one axis after the other."""
    for axis in range(2):
        if rules.stride > 0.0:
            scene.velocity[axis] = rules.push[action, axis] * rules.stride / rules.dt
        else:
            scene.velocity[axis] += PUSH * rules.push[action, axis]
        before = scene.position[axis]
        after = before + scene.velocity[axis] * rules.dt
        blocked = walls.block(rules.obstacle, scene.position, axis, after)
        scene.position[axis] = after
        if blocked or is_outside(rules, scene.position[0], scene.position[1]):
            scene.position[axis], scene.velocity[axis] = before, 0.0
        elif rules.stride == 0.0:
            scene.velocity[axis] *= DRAG


@kernel
def is_outside(rules, x, y):
    """Whether (x, y) is beyond the walls of the arena."""
    if rules.round:
        return (x - 0.5) * (x - 0.5) + (y - 0.5) * (y - 0.5) > 0.25
    return x < 0.0 or y < 0.0 or x > 1.0 or y > 1.0


@dataclass(frozen=True)
class Arena(World, checks.Final):
    """An arena in the plane, see the module for its rules. Lengths are fractions of its size, its width and height.

    places: (kind, x, y) each, the kind a name, x and y in 0 … 1. pay: the reward for meeting a place of each kind, in
        the order in which kinds first appear in `places`; 1 for those left out.
    obstacles: (left, top, right, bottom) each, in 0 … 1. Those that meet must overlap, or an agent can pass along the
        seam between them.
    shape: of the walls, "round" or "square". motion: "inertia", or plain "steps" of `step_length`, 10⁻⁹ … 1.
    radius: the distance within which a place is met, > 0. ends: whether a meeting ends the trial.
    start: where trials start, (x, y) in 0 … 1; () stands for one of four points of the rim.
    trial_seconds: the maximum duration of a trial, > 0, at most 10⁹. fps: steps per second, 1 … 2³¹.

    Raises ValueError for anything else, and for a start in a wall or an obstacle.
    """

    places: Sequence[tuple[str, float, float]] = (("platform", 0.65, 0.35),)
    pay: Sequence[float] = ()
    obstacles: Sequence[tuple[float, float, float, float]] = ()
    shape: Annotated[str, OneOf(("round", "square"))] = "round"
    motion: Annotated[str, OneOf(("inertia", "steps"))] = "inertia"
    step_length: Annotated[float, Within(1e-9, 1)] = 0.02
    radius: Annotated[float, Within(1e-9, LARGEST)] = 0.06
    ends: bool = True
    start: Sequence[float] = ()
    trial_seconds: Annotated[float, Within(1e-9, 1e9)] = 60.0
    fps: AtLeastOne = 50

    actions = CARDINAL
    size = 1.0
    bounded = True
    dynamics = Dynamics(reset, step)

    def __post_init__(self):
        checks.check_fields(self)
        places = tuple(checks.several("places", each) for each in checks.several("places", self.places))
        if any(len(each) != 3 or not isinstance(each[0], str) for each in places):
            raise checks.error("places", "tuples (kind, x, y)", self.places)
        checks.assign(
            self, places=tuple((str(kind), checks.real("places", x, 0, 1), checks.real("places", y, 0, 1))
                               for kind, x, y in places),
            pay=tuple(checks.real("pay", each) for each in checks.several("pay", self.pay)),
            obstacles=walls.checked("obstacles", self.obstacles, 0, 1),
            start=tuple(checks.real("start", value, 0, 1) for value in checks.several("start", self.start)))
        if len(self.pay) > len(self.kinds):
            raise checks.error("pay", f"{len(self.kinds)} numbers, one for each kind", self.pay)
        if len(self.start) not in (0, 2):
            raise checks.error("start", "() or a place (x, y)", self.start)
        rules = self.rules
        if any(function_of(is_outside)(rules, x, y) or function_of(walls.contain)(rules.obstacle, x, y)
               for x, y in rules.start):
            raise checks.error("start", "outside of walls and obstacles", self.start)

    @property
    def kinds(self) -> tuple[str, ...]:
        """The kinds of its places."""
        return tuple(dict.fromkeys(kind for kind, *_ in self.places))

    @property
    def terminal(self) -> list[bool]:
        """For each kind, whether a meeting ends the trial."""
        return [self.ends] * len(self.kinds)

    @property
    def things(self) -> int:
        """The number of places."""
        return len(self.places)

    @property
    def sizes(self) -> dict[str, int]:
        """The sizes of the arrays in a state and in the rules, by name."""
        return super().sizes | {"obstacles": len(self.obstacles)}

    @property
    def rules(self) -> ArenaRules:
        """The rules as the kernels take them."""
        kinds = {kind: number for number, kind in enumerate(self.kinds)}
        pay = dict(zip(kinds, (*self.pay, *[1.0] * len(kinds))))
        obstacles = walls.table(self.obstacles)
        obstacles[:, :2] -= obstacles[:, :2] == 0.0  # those at a side reach beyond it, or an agent at
        obstacles[:, 2:] += obstacles[:, 2:] == 1.0  # the side could pass along their edge
        return ArenaRules(
            self.size, 1.0 / self.fps, self.shape == "round", self.step_length if self.motion == "steps" else 0.0,
            self.radius, self.ends, max(1, round(self.trial_seconds * self.fps)), 1 if self.start else 4,
            np.array([self.start] * 4 if self.start else STARTS, float), self.actions.table,
            np.array([at for _, *at in self.places], float).reshape(-1, 2),
            np.array([kinds[kind] for kind, *_ in self.places], np.int64),
            np.array([pay[kind] for kind, *_ in self.places], float), obstacles)
