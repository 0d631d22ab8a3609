"""A neoRL agent in RatInABox: its scenes are decoded from the rates of simulated place and object-vector cells.

RatInABox (George et al. 2024) simulates how an animal moves and how its neurons fire. A neuron's rate is a graded
measure of how well its preferred place, or the preferred vector to an object, fits; the mean of all preferred values,
weighted by the rates, is the population's estimate (Georgopoulos et al. 1986). A `neorl.Scene` made of such estimates
is all that an agent needs. Its actions become the drift that RatInABox adds to the animal's own random motion.
"""

import numpy as np

from neorl.agents.learner import Learner
from neorl.core.scene import Scene
from neorl.extras import require

STEP_SECONDS = 0.1
SPEED = 0.3  # metres per second, of the drift
OBJECT = (0.75, 0.3)


def decode_place(cells):
    """The place that `PlaceCells` signal, in metres: float64 (2,)."""
    return _weighted_mean(cells.firingrate, cells.place_cell_centres)


def decode_vector(cells):
    """The vector from the animal to an object, in metres: float64 (2,).

    It is what RatInABox's `ObjectVectorCells` signal; None while none fires.
    """
    angles, lengths = cells.tuning_angles, cells.tuning_distances
    if not np.any(cells.firingrate):
        return None
    along = np.column_stack([np.cos(angles), np.sin(angles)])
    return _weighted_mean(cells.firingrate, lengths[:, None] * along)


def scene_of(places, vectors):
    """The scene that the two populations signal.

    It has the animal's place, and the object's if its cells fire.
    """
    position, vector = decode_place(places), decode_vector(vectors)
    if vector is None:
        return Scene(position, things=[position], kinds=[None])
    return Scene(position, things=[position + vector], kinds=["object"])


def forage(agent, steps, seed=0, n_cells=200):
    """Distance from an object of an animal steered by a neoRL agent, in metres after each step: float64 (steps,).

    agent: a `neorl.Agent` that desires "object", or None for RatInABox's own random motion. n_cells: of each
        population.
    Raises ImportError if ratinabox is not installed.
    """
    require("ratinabox", extra="book")
    from ratinabox import Agent, Environment
    from ratinabox.Neurons import ObjectVectorCells, PlaceCells

    np.random.seed(seed)  # RatInABox draws from NumPy's global stream
    box = Environment()
    box.add_object(OBJECT)
    animal = Agent(box, params={"dt": STEP_SECONDS, "save_history": False})
    cells = [kind(animal, params={"n": n_cells, "save_history": False}) for kind in (PlaceCells, ObjectVectorCells)]
    learner = Learner(agent, things=1, kinds=["object"], seed=seed, fps=1 / STEP_SECONDS) if agent else None
    distances = np.empty(steps)
    for step in range(steps):
        for each in cells:
            each.update()
        if learner is None:
            animal.update()
        else:
            learner.begin(scene_of(*cells)) if step == 0 else learner.observe(scene_of(*cells))
            push = learner.world.actions.table[learner.act()]
            animal.update(drift_velocity=SPEED * push, drift_to_random_strength_ratio=3)
        distances[step] = np.linalg.norm(animal.pos - OBJECT)
    return distances


def smoothed(distances, seconds=10.0):
    """Means over stretches of time, as `neorl.drawing.draw_curves` takes them: (middles, {name: float64 (1, points)}).

    distances: {name: float64 (steps,)}. seconds: length of a stretch. The middles of stretches are in seconds.
    """
    stretch = round(seconds / STEP_SECONDS)
    curves = {name: each[: len(each) // stretch * stretch].reshape(-1, stretch).mean(axis=1)[None]
              for name, each in distances.items()}
    points = next(iter(curves.values())).shape[1]
    return seconds * (np.arange(points) + 0.5), curves


def _weighted_mean(rates, values):
    rates = np.asarray(rates)
    return (rates[:, None] * values).sum(axis=0) / rates.sum()
