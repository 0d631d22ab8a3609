"""The water maze (Morris 1984): a round pool with a submerged platform, which is moved every few trials.

1. The pool touches all sides of the unit square. An action adds `PUSH`, diameters per second, to the animal's velocity
   along an axis. The animal swims by velocity · dt, and keeps `DRAG` of its velocity. Along an axis on which it would
   enter the wall, it stays in place and stops.
2. A trial starts at rest at one of the four cardinal points of the rim, drawn at random. It ends when the animal is on
   the platform, within `radius` of its centre; that pays 1. A trial that is not over after `trial_seconds` ends without
   reward.
3. The platform stands at the first of `places` for `trials_a_day` trials, then at the second, and so on; after the last
   it returns to the first.
4. The platform is invisible. The thing in the scene is its remembered place: after a trial, that of the platform, since
   an animal that has not found it is put on it. No place is remembered during the first trial, nor after the animal has
   come within `radius` of the remembered place and found no platform there.
5. The state records how many seconds each trial took, for the trials of one pass through `places`.

The origin is the upper left corner.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Annotated, NamedTuple

import numpy as np

from neorl.common import checks
from neorl.common.checks import AtLeastOne, Within
from neorl.core.scene import ABSENT, CARDINAL, Scene
from neorl.core.stream import randint
from neorl.kernels.annotations import array
from neorl.kernels.kernel import kernel
from neorl.worlds.arena import STARTS
from neorl.worlds.world import Dynamics, World, squared_distance

PUSH = 0.02  # diameters per second that an action adds to the velocity
DRAG = 0.95  # share of the velocity that a step retains
PLATFORM = 0


class WaterMazeState(NamedTuple):
    """The state of the pool."""

    scene: Scene
    platform: array("float64", 2)
    trial: array("int64", 1)  # number of trials begun
    clock: array("int64", 1)  # steps since the trial began
    latency: array("float64", "trials")  # seconds that each trial took; 0 if it is not over
    stream: array("uint64", 4)


class WaterMazeRules(NamedTuple):
    """The constants of the pool, as the kernels take them."""

    dt: float  # seconds per step
    radius: float
    last_step: int
    trials_a_day: int
    place: array("float64", "places", 2)
    start: array("float64", 4, 2)
    push: array("float64", 5, 2)


@kernel
def reset(state: WaterMazeState, rules: WaterMazeRules) -> None:
    """Start a trial, at rest at the rim."""
    scene, start = state.scene, randint(state.stream, 4)
    if state.trial[0] == 0:
        scene.kinds[0] = ABSENT
    day = state.trial[0] // rules.trials_a_day % rules.place.shape[0]
    state.trial[0] += 1
    state.clock[0] = scene.met[0] = 0
    for axis in range(2):
        scene.position[axis], scene.velocity[axis] = rules.start[start, axis], 0.0
        state.platform[axis] = rules.place[day, axis]


@kernel
def step(state: WaterMazeState, rules: WaterMazeRules, action: int):
    """Advance the state by one step of the rules. Returns (reward, done)."""
    scene = state.scene
    swim(scene, rules, action)
    state.clock[0] += 1
    found = squared_distance(scene.position, state.platform) < rules.radius * rules.radius
    done = found or state.clock[0] >= rules.last_step
    scene.met[0] = 1 + PLATFORM if found else 0
    if done:
        scene.kinds[0] = PLATFORM
        scene.things[0, 0], scene.things[0, 1] = state.platform[0], state.platform[1]
        if state.trial[0] <= state.latency.shape[0]:
            state.latency[state.trial[0] - 1] = state.clock[0] * rules.dt
    elif (scene.kinds[0] == PLATFORM
          and squared_distance(scene.position, scene.things[0]) < rules.radius * rules.radius):
        scene.kinds[0] = ABSENT
    return 1.0 if found else 0.0, done


@kernel
def swim(scene, rules, action):
    """Move the animal, along one axis after the other."""
    for axis in range(2):
        scene.velocity[axis] += PUSH * rules.push[action, axis]
        before = scene.position[axis]
        scene.position[axis] += scene.velocity[axis] * rules.dt
        dx, dy = scene.position[0] - 0.5, scene.position[1] - 0.5
        if dx * dx + dy * dy > 0.25:
            scene.position[axis], scene.velocity[axis] = before, 0.0
        else:
            scene.velocity[axis] *= DRAG


@dataclass(frozen=True)
class WaterMaze(World, checks.Final):
    """A water maze, see the module for its rules. Lengths are fractions of the pool's diameter.

    places: positions of the platform, (x, y) each, one per day, one to 1,024, within the pool.
    trials_a_day: integer 1 … 1,024. radius: of the platform, 10⁻³ … 0.25.
    trial_seconds: the maximum duration of a trial, > 0. fps: steps per second, 1 … 2³¹.

    Raises ValueError for anything else.
    """

    places: Sequence[Sequence[float]] = ((0.65, 0.35),)
    trials_a_day: Annotated[int, Within(1, 1_024)] = 4
    radius: Annotated[float, Within(1e-3, 0.25)] = 0.06
    trial_seconds: Annotated[float, Within(1e-9, 1e9)] = 120.0
    fps: AtLeastOne = 10

    kinds = ("platform",)
    dynamics = Dynamics(reset, step)
    actions = CARDINAL
    size = 1.0
    things = 1

    def __post_init__(self):
        places = [checks.several("places", each) for each in checks.several("places", self.places)]
        checks.check_fields(self)
        checks.assign(self, places=tuple(tuple(checks.real("places", value, 0, 1) for value in each)
                                         for each in places))
        if not 1 <= len(self.places) <= 1_024 or any(
                len(each) != 2 or (each[0] - 0.5)**2 + (each[1] - 0.5)**2 > 0.25 for each in self.places):
            raise checks.error("places", "one to 1024 places (x, y) in the pool", self.places)

    @property
    def trials(self) -> int:
        """The number of trials of all days together."""
        return len(self.places) * self.trials_a_day

    @property
    def sizes(self) -> dict[str, int]:
        """The sizes of the arrays in a state and in the rules, by name."""
        return super().sizes | {"trials": self.trials, "places": len(self.places)}

    @property
    def rules(self) -> WaterMazeRules:
        """The rules as the kernels take them."""
        return WaterMazeRules(
            1.0 / self.fps, self.radius, max(1, round(self.trial_seconds * self.fps)), self.trials_a_day,
            np.array(self.places), np.array(STARTS), self.actions.table)

    def check_state(self, state: WaterMazeState) -> None:
        """Raise ValueError unless a state fits this world, is finite, and its trial has begun."""
        super().check_state(state)
        if not state.trial[0] >= 1:
            raise checks.error("state.trial", "an integer of at least 1", state.trial)
