"""Recorded animals, and pilots that find their way by the paths of these.

1. Lengths are in metres, and boxes a metre wide, so that a place is a point of the unit square.
2. A *pilot* is a function of a goal: it returns a function of the position, the push, (2,), whose largest component is
   1, or 0 where the pilot knows no way (`companion.recordings.pilots`).
3. A walker moves with `SPEED` times the push and some noise. Where its pilot knows no way it goes on as before; at a
   wall of the box, it slides along it. It has arrived when the goal is `NEAR`.
"""

from pathlib import Path
from typing import NamedTuple

import numpy as np
import ratinabox

from companion.page.wording import number
from neorl.statistics import FEWEST_RUNS, estimate

SECONDS = 0.1  # per step of a walker, and of a simulated animal
SPEED = 0.2  # metres per second
LIMIT = 600  # steps, after which a walker gives up
NEAR = 0.05  # metres from the goal
NOISE = 0.3  # standard deviation, of a push of 1
CLEAR = 1.1  # steps ahead, that must be free: RatInABox sees no wall that a step ends or begins on
LOST = 0.1  # seconds without a frame that end a stretch
MINUTE = 60.0


class Tour(NamedTuple):
    """What became of some ways: whether each arrived, its time as a multiple of the straight line's, path and goal."""

    arrived: np.ndarray
    times: np.ndarray
    paths: list
    goals: np.ndarray


def rat(minutes):
    """The path of a rat, (steps + 1, 2), its first minutes, and where frames are missing, as `Learner.watch` takes it.

    A rat in a box of 1 m × 1 m, 10 minutes at 50 frames a second: Sargolini et al. 2006, as RatInABox ships it.
    """
    with np.load(Path(ratinabox.__file__).parent / "data" / "sargolini.npz") as data:
        first = data["t"] - data["t"][0] <= minutes * MINUTE
        return data["pos"][first], np.diff(data["t"][first]) > LOST


def box(*walls):
    """A box of RatInABox with walls, each a pair of points."""
    made = ratinabox.Environment()
    for wall in walls:
        made.add_wall(np.array(wall, float))
    return made


def roam(environment, steps, seed):
    """The path of a simulated animal, (steps + 1, 2), that roams a box at random."""
    np.random.seed(seed)  # RatInABox draws from NumPy's global stream
    animal = ratinabox.Agent(environment, {"dt": SECONDS, "speed_mean": SPEED, "save_history": False})
    path = [np.clip(animal.pos, 0, 1)]
    for _ in range(steps):
        animal.update()
        path.append(np.clip(animal.pos, 0, 1))
    return np.array(path)


def walk(push, environment, start, goal, noise):
    """The path of a walker, (steps + 1, 2), to a goal or as long as there is noise, (steps, 2)."""
    place, ahead = np.asarray(start, float), noise[0]
    path = [place]
    for unsteady in noise:
        if np.linalg.norm(place - goal) <= NEAR:
            break
        pushed = push(place)
        ahead = np.clip((pushed if pushed.any() else ahead) + NOISE * unsteady, -1, 1)
        step = SPEED * SECONDS * ahead
        for part in (step, step * (1, 0), step * (0, 1)):
            if part.any() and is_free(environment, place, place + CLEAR * part):
                place = place + part
                break
        path.append(place)
    return np.array(path)


def is_free(environment, place, following):
    """Whether a step stays in a box and crosses no wall."""
    return bool(np.all((following > 0) & (following < 1))) and not environment.check_wall_collisions(
        np.array([place, following]))[1].any()


def tour(pilot, environment, runs, seed):
    """The `Tour` of a pilot between random places, the same for all pilots; runs: their number."""
    found = []
    for k in range(runs):
        rng = np.random.default_rng([seed, k])
        start, goal = rng.random((2, 2))
        path = walk(pilot(tuple(goal)), environment, start, goal, rng.normal(size=(LIMIT, 2)))
        straight = max(np.linalg.norm(goal - start) - NEAR, SPEED * SECONDS) / (SPEED * SECONDS)
        found.append((np.linalg.norm(path[-1] - goal) <= NEAR, (len(path) - 1) / straight, path, goal))
    arrived, times, paths, goals = zip(*found)
    return Tour(np.array(arrived), np.array(times), list(paths), np.array(goals))


def rows(tours):
    """A row of a table for each tour: its name, how many ways arrived, and the median time of these."""
    return [[name, *(shown(*each) for each in ((np.mean, tour.arrived.astype(float)),
                                               (np.median, tour.times[tour.arrived])))]
            for name, tour in tours.items()]


def shown(statistic, sample):
    """A statistic of ways as a text, with its interval if there are enough of them."""
    if len(sample) == 0:
        return "–"
    return str(estimate(statistic, sample)) if len(sample) >= FEWEST_RUNS else number(statistic(sample))
