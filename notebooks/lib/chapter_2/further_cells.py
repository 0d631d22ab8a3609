"""Grid cells, path integration and egocentric object cells: three kinds of navigation that the thesis's maps leave out.

1. *Grid cells*: the rate is a sum of three cosines, 60° apart, so that the fields form a hexagonal lattice. The cells
   of a module share its scale, the distance between fields, and differ in phase (Hafting et al. 2005; Stensola et al.
   2012).
2. *Path integration*: an animal sums its displacements, each with a random error. If it can, it corrects the sum at
   walls, one coordinate at a time, as border cells would allow (Hardcastle et al. 2015).
3. *Egocentric object cells* fire if an object is at a place in the animal's own frame (Wang et al. 2018).
"""

import numpy as np

from lib.chapter_2.tuning import egocentric, roam, spikes, tuning_curve
from neorl import checks
from neorl.core.geometry import TAU

# Two of the three axes of a lattice without rotation, which determine the third.
AXES = np.array([(0.0, 1.0), (np.sqrt(0.75), -0.5)])
FAR = 0.15  # box widths, beyond which two places are not neighbours
STEP = 0.02  # seconds between two positions of an animal


def phases(places, scale):
    """The phases of places in a module's lattice, along two of its axes: float64 (…, 2), in periods from 0 to 1.

    places: (…, 2), in box widths. scale: the distance between neighbouring fields, in box widths, above 0.
    Raises ValueError for anything else.
    """
    return np.asarray(places) @ AXES.T / (np.sqrt(0.75) * checks.real("scale", scale, 1e-9)) % 1


def grid_rate(places, scale, phase=(0.0, 0.0)):
    """The firing of a grid cell at places, from 0 to 1 in the middle of its fields: float64 (…). phase: of these."""
    one, other = TAU * np.moveaxis(phases(places, scale) - np.asarray(phase), -1, 0)
    return (np.cos(one) + np.cos(other) + np.cos(one + other) + 1.5) / 4.5


def grid_maps(trajectory, scales, seed=0, highest=20.0, bins=25):
    """Rate maps of a grid cell of each scale, from spikes at up to ``highest`` per second: {title: (bins, bins)}."""
    maps = {}
    for number, scale in enumerate(scales):
        rates = highest * grid_rate(trajectory.position, scale) * trajectory.step
        fired = np.random.default_rng([seed, number]).poisson(rates)
        maps[f"scale {scale:g}"] = tuning_curve(fired, trajectory.position, trajectory.step, 1.0, bins).rate
    return maps


def mistakable(scales, bins=30, tolerance=0.1):
    """The share of places of a box that modules of these scales do not distinguish from some distant place.

    Two of bins × bins places are indistinguishable if their phases differ by at most ``tolerance`` periods in every
    module, and distant if they are more than `FAR` apart.
    """
    side = (np.arange(bins) + 0.5) / bins
    places = np.stack(np.meshgrid(side, side), axis=-1).reshape(-1, 2)
    alike = np.linalg.norm(places[:, None] - places, axis=-1) > FAR
    for scale in scales:
        at = phases(places, scale)
        apart = np.abs(at[:, None] - at)
        alike &= np.all(np.minimum(apart, 1 - apart) <= tolerance, axis=-1)
    return alike.any(axis=1).mean()


def lose_track(runs, seconds, noise=0.05, reach=0.1, seed=0):
    """The errors of path integration, with and without correction: {name: (runs, steps)}, in box widths.

    Animals `roam` a box and know where they begin. Each second adds an error with the standard deviation ``noise``, in
    box widths, to either coordinate. At most ``reach`` from a wall, a corrected coordinate becomes that of the middle
    of this strip.
    """
    steps = round(checks.real("seconds", seconds, STEP) / STEP)
    found = {"sum alone": np.zeros((runs, steps)), "corrected at walls": np.zeros((runs, steps))}
    for run in range(runs):
        at = roam(steps, [seed, run], STEP).position
        drift = np.random.default_rng([seed, run, 1]).normal(0, noise * np.sqrt(STEP), (steps, 2))
        drift[0] = 0
        error = np.cumsum(drift, axis=0)
        near_low, near_high = at < reach, at > 1 - reach
        known = near_low | near_high
        last = np.maximum.accumulate(np.where(known, np.arange(steps)[:, None], -1), axis=0)
        off = np.where(near_low, reach / 2, 1 - reach / 2) - at  # of a coordinate when it is corrected
        at_last = np.maximum(last, 0)
        since = error + np.take_along_axis(off - error, at_last, 0)
        corrected = np.where(last >= 0, since, error)
        for name, each in zip(found, (error, corrected)):
            found[name][run] = np.linalg.norm(each, axis=1)
    return found


def object_maps(trajectory, thing, seed=0, centre=(0.2, -0.15), radius=0.1, bins=25):
    """Rates of two object cells over the vector to an object in two frames: {cell: {frame: (bins, bins)}}.

    Either cell fires while the object is within ``radius`` of ``centre``: (north, east) of the animal for the
    allocentric cell, (forward, starboard) for the egocentric one. Vectors reach from −0.5 to 0.5 box widths.
    thing: its place (x, y). The animal heads where it moves.
    """
    x, y = np.moveaxis(np.asarray(thing) - trajectory.position, -1, 0)
    outer = np.stack([-y, x], axis=-1)
    frames = {"allocentric": outer, "egocentric": egocentric(outer, trajectory.direction + np.pi / 2)}
    maps = {}
    for number, (cell, vectors) in enumerate(frames.items()):
        fired = spikes(np.linalg.norm(vectors - centre, axis=1) <= radius, trajectory.step, [seed, number])
        maps[f"{cell} cell"] = {frame: tuning_curve(fired, seen + 0.5, trajectory.step, 1.0, bins).rate
                                for frame, seen in frames.items()}
    return maps
