"""Kinds of cells, and their tuning, measured from their spikes while an animal roams a box.

1. The velocity of the animal is an Ornstein-Uhlenbeck process along each axis, and walls reflect it, so that it covers
   the box uniformly. The box is a unit square, of 1 m, say; y points south as everywhere in neorl.
2. A cell fires by Poisson at one rate inside its receptive field, that of a cell of an `NresMap`, and at another
   outside.
3. Tuning is spikes in each bin of a variable, divided by the time spent there, both smoothed by a Gaussian.
4. *Kinds* follow from the book's modalities. `THESIS` is the thesis's table 2.1, after Bicanski and Burgess (2020):
   whether the locality and the direction of a kind are allocentric, a distance or neither, and what the kind concerns.
"""

from typing import NamedTuple

import numpy as np
from scipy.ndimage import gaussian_filter1d
from scipy.signal import lfilter

from neorl.core.coordinates import tune
from neorl.core.direction import TAU
from neorl.core.modality import CARTESIAN_OBJECT_VECTOR_CELL, MODALITIES

SHIFTS = 99  # random shifts of the spikes in time
THESIS = {
    "head-direction cell": ("–", "allocentric", "head direction"),
    "place cell": ("allocentric", "–", "agent position"),
    "border cell": ("allocentric", "–", "location of borders"),
    "boundary-vector cell": ("[distance]", "allocentric", "location of boundaries"),
    "object-vector cell": ("[distance]", "allocentric", "location of objects"),
    "landmark-vector cell": ("[distance]", "allocentric", "location of landmarks"),
}
CONCERNS = {("position", "margin"): "location of borders", ("position", "component"): "agent position",
            ("velocity", "direction"): "head direction", ("velocity", "length"): "agent speed"}
# The arguments high, bins and closed of `tuning_curve` for each variable that spikes may be informative about.
VARIABLES = {"position": (1.0, 20, False), "direction": (TAU, 18, True), "speed": (0.5, 10, False)}


def kinds():
    """The entries of `THESIS` for each modality of the book but paper B's: {kind: entries}."""
    return {each.name: (_locality(each), "allocentric" if "direction" in each.names else "–",
                        CONCERNS.get((each.follows, each.axes[0].feature), f"location of {each.follows}"))
            for each in MODALITIES if each != CARTESIAN_OBJECT_VECTOR_CELL}


def _locality(modality):
    if modality.follows == "position":
        return "allocentric"
    return "[distance]" if "distance" in modality.names else "–"


class Trajectory(NamedTuple):
    """The positions and velocities of an animal over time."""

    position: np.ndarray  # float64 (steps, 2), box widths from the upper left
    velocity: np.ndarray  # float64 (steps, 2), box widths per second
    step: float  # seconds between two rows

    @property
    def direction(self):
        """The direction of movement, 0 … 2π from east by way of south: float64 (steps,)."""
        return np.arctan2(self.velocity[:, 1], self.velocity[:, 0]) % TAU

    @property
    def speed(self):
        """Speeds in box widths per second: float64 (steps,)."""
        return np.linalg.norm(self.velocity, axis=1)


def roam(steps, seed=0, step=0.02, speed=0.2, persistence=0.7):
    """Let an animal roam the box: a `Trajectory`.

    speed: mean, box widths per second. persistence: seconds until the velocity's autocorrelation is 1/e.
    """
    kept = np.exp(-step / persistence)
    rng = np.random.default_rng(seed)
    deviation = speed / np.sqrt(np.pi / 2)  # of each component: the speed is Rayleigh
    noise = rng.normal(0, deviation, (steps, 2))
    noise[1:] *= np.sqrt(1 - kept**2)
    velocity = lfilter([1.0], [1.0, -kept], noise, axis=0)
    # A walk through mirror images of the box, folded back, is a walk in the box that its walls reflect.
    path = (rng.random(2) + step * np.cumsum(velocity, axis=0)) % 2
    mirrored = path > 1
    return Trajectory(np.where(mirrored, 2 - path, path), np.where(mirrored, -velocity, velocity), step)


def in_field(nres_map, cell, trajectory, objects=()):
    """Whether a cell of a map is active, at each step of a trajectory: bool (steps,).

    If its modality follows several things, a cell is active while any of them is in its field.
    objects: (x, y) of each in the box, used only if the modality follows objects.
    """
    modality = nres_map.modality
    if modality.follows == "boundaries":
        vectors = [(wall - trajectory.position) * axis for wall in (0.0, 1.0) for axis in np.eye(2)]
    elif modality.follows in ("objects", "landmarks"):
        places = objects if modality.follows == "objects" else modality.landmarks
        vectors = [place - trajectory.position for place in places]
    else:
        vectors = [getattr(trajectory, modality.follows)]
    active = [nres_map.encode(tune(modality, each)) == cell for each in vectors]
    return np.any(np.reshape(active, (-1, len(trajectory.position))), axis=0)


def spikes(active, step, seed=0, inside=20.0, outside=0.2):
    """The number of Poisson spikes of a cell at each step: int16 (steps,)."""
    return np.random.default_rng(seed).poisson(np.where(active, inside, outside) * step).astype(np.int16)


class TuningCurve(NamedTuple):
    """The firing of a cell in each bin of a variable, with axes in the order of the variable's components."""

    rate: np.ndarray  # float64 (…, bins) or (…, bins, bins), spikes per second; NaN where the animal never was
    seconds: np.ndarray  # float64 (bins,) or (bins, bins), time spent there, smoothed as the spikes are


def tuning_curve(counts, values, step, high, bins, smoothing=1.0, closed=False):
    """The tuning of a cell to a variable: a `TuningCurve`.

    counts: (…, steps). values: (steps,) or (steps, 2), in bins from 0 to ``high``; those beyond are left out.
    smoothing: of spikes and of time, the standard deviation in bins, ≥ 0. closed: whether the axis is circular.
    """
    counts = np.asarray(counts)
    values = np.reshape(values, (counts.shape[-1], -1))
    at = np.floor(values / high * bins).astype(int)
    at[values == high] = bins - 1
    inside = np.all((0 <= at) & (at < bins), axis=1)
    shape = (bins,) * at.shape[1]
    index = np.ravel_multi_index(tuple(at[inside].T), shape)
    times = step * np.bincount(index, minlength=bins ** len(shape)).reshape(shape)
    trains = counts.reshape(-1, counts.shape[-1])[:, inside]
    fired = np.array([np.bincount(index, train, minlength=bins ** len(shape)).reshape(shape) for train in trains])
    mode = "wrap" if closed else "constant"
    seconds, fired = times, fired.reshape(*counts.shape[:-1], *shape)
    for axis in range(-len(shape), 0) if smoothing else ():
        seconds = gaussian_filter1d(seconds, smoothing, axis, mode=mode)
        fired = gaussian_filter1d(fired, smoothing, axis, mode=mode)
    with np.errstate(invalid="ignore", divide="ignore"):
        return TuningCurve(np.where(times > 0, fired / seconds, np.nan), seconds)


def information(tuned):
    """Bits that a spike carries about the variable of a `TuningCurve`: float64 (…), 0 for a cell that never fires.

    The sum over bins of p (λ/λ̄) log₂ (λ/λ̄), with the share p of the time spent in a bin, the rate λ there and the
    mean rate λ̄ (Skaggs et al. 1993). With few spikes it is biased upwards.
    """
    axes = tuple(range(-tuned.seconds.ndim, 0))
    visited = ~np.isnan(tuned.rate)
    rate = np.where(visited, tuned.rate, 0.0)
    share = np.where(visited, tuned.seconds, 0.0)
    share = share / share.sum(axis=axes, keepdims=True)
    mean = np.sum(share * rate, axis=axes, keepdims=True)
    ratio = np.divide(rate, mean, out=np.zeros_like(rate), where=mean > 0)
    return np.sum(share * ratio * np.log2(ratio, out=np.zeros_like(ratio), where=ratio > 0), axis=axes)


class Information(NamedTuple):
    """The information that the spikes of a cell carry about a variable."""

    bits: float  # per spike
    clear: bool  # whether that is more than with any of `SHIFTS` shifts of the spikes in time


def information_in_spikes(trains, trajectory, seed=0):
    """The information in spikes about an animal's position, direction and speed: {cell: {variable: `Information`}}.

    Shifts are circular, by 1,000 steps or more either way, or by a tenth of a shorter recording.
    """
    steps = len(trajectory.position)
    margin = min(1_000, steps // 10)
    shifts = np.random.default_rng(seed).integers(margin, steps - margin, size=SHIFTS)
    found = {}
    for cell, train in trains.items():
        shifted = np.stack([train, *(np.roll(train, shift) for shift in shifts)])
        found[cell] = {}
        for variable, (high, bins, closed) in VARIABLES.items():
            values = getattr(trajectory, variable)
            bits, *by_chance = information(tuning_curve(shifted, values, trajectory.step, high, bins, closed=closed))
            found[cell][variable] = Information(bits, bits > max(by_chance))
    return found


def egocentric(vectors, heading):
    """Vectors (North, East) in the animal's frame (Forward, Starboard): float64 (…, 2)."""
    north, east = np.moveaxis(vectors, -1, 0)
    cosine, sine = np.cos(heading), np.sin(heading)
    return np.stack([cosine * north + sine * east, cosine * east - sine * north], axis=-1)
