"""The coordinates of points in the space of a modality, as the kernels compute them.

For Python a direction is in radians, for the kernels in turns (`neorl.core.geometry`).
"""

from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from neorl.common import checks
from neorl.core.building import space_of
from neorl.core.direction import TAU
from neorl.core.functions import UserFunctions, features
from neorl.core.geometry import locate
from neorl.core.layout import Memory, Record
from neorl.core.modality import Modality
from neorl.core.scene import MOST_AXES, Scene, checked_scene
from neorl.kernels.annotations import array, new_tuple
from neorl.kernels.execution import execute
from neorl.kernels.kernel import full_name, kernel


def sense(modality: Modality, scene: Scene, size: float) -> NDArray[np.float64]:
    """The coordinates of the points that cells of a modality follow in a `Scene`: float64 (points, axes).

    modality: a `Modality`. size: of the world, its unit of length. Directions are in radians; a missing one is 0.
    Raises ValueError for a scene that does not fit.
    """
    checks.instance("modality", modality, Modality)
    scene, size = checked_scene(scene), checks.positive("size", size)
    n_axes = len(scene.position)
    modality.check_axes(n_axes)
    points = {"objects": len(scene.things), "boundaries": 2 * n_axes, "landmarks": len(modality.landmarks)}
    coordinates = np.zeros((points.get(modality.follows, 1), len(modality.axes)))
    _locate(modality, size, scene, False, np.zeros((len(coordinates), n_axes)), coordinates)
    return as_radians(modality, coordinates)


def tune(modality: Modality, vectors: ArrayLike) -> NDArray[np.float64]:
    """The coordinates of vectors (…, axes of the world) for cells of a modality: float64 (…, axes).

    Directions are in radians. Raises ValueError if a vector is not finite or has too few or too many components, or
    for conjunctive cells.
    """
    checks.instance("modality", modality, Modality)
    vectors = checks.doubles("vectors", vectors)
    if any(axis.of != modality.follows for axis in modality.axes):
        raise ValueError(f"vectors must be of one kind, but {modality.name}s have axes of several")
    if vectors.ndim == 0 or not modality.least_axes <= vectors.shape[-1] <= MOST_AXES:
        raise ValueError(f"vectors must have the shape (…, {modality.least_axes}) or more, of {MOST_AXES} axes at "
                         f"most, but has {vectors.shape}")
    n_axes = vectors.shape[-1]
    modality.check_axes(n_axes)
    coordinates = np.zeros((*vectors.shape[:-1], len(modality.axes)))
    scene = new_tuple(Scene, {"axes": n_axes, "things": 0}, {})
    _locate(modality, 1.0, scene, True, vectors.reshape(-1, n_axes), coordinates.reshape(-1, len(modality.axes)))
    return as_radians(modality, coordinates)


def _locate(modality, size, scene, from_vectors, vectors, coordinates):
    """Write the coordinates of all points into `coordinates`, from their vectors or from the scene."""
    uncut = replace(modality, axes=[replace(axis, boundaries=()) for axis in modality.axes])
    agent, memory = space_of(uncut, 1, len(scene.position), size)
    agent, functions = agent.copy(), modality.functions  # a copy, since other threads write to the record, too
    execute(locate_all, agent, memory, scene, UserFunctions(features(*functions)), from_vectors, vectors, coordinates)
    check_faults(agent["faults"], functions)


@kernel
def locate_all(agent: Record, memory: Memory, scene: Scene, user: UserFunctions, from_vectors: bool, vectors: array(
        "float64", "points", "axes"), coordinates: array("float64", "points", "coordinates")) -> None:
    """Write the coordinates of points of the only node into `coordinates`, see `neorl.core.geometry.locate`."""
    for point in range(coordinates.shape[0]):
        for axis in range(vectors.shape[1]):
            agent.offset[axis] = vectors[point, axis]
        locate(agent, memory, scene, user, agent.nodes[0], point, from_vectors)
        for i in range(coordinates.shape[1]):
            coordinates[point, i] = agent.coordinates[i]


def check_faults(faults, axes, credit=None):
    """Raise ValueError, which names the kernel, for a user-defined axis or credit rule that has returned NaN."""
    for fault, kind, kernels in zip(faults, ("an axis", "the credit"), (axes, (credit,))):
        if fault:
            raise ValueError(f"the kernel {full_name(kernels[fault - 1])} of {kind} must return numbers, but has "
                             "returned NaN: return a number in every case, also where there is nothing to measure")


def as_radians(modality, coordinates):
    """The kernels' coordinates (…, axes), with directions in radians; a missing direction counts as east."""
    scale = np.where([axis.is_direction for axis in modality.axes], TAU, 1.0)
    return np.nan_to_num(coordinates) * scale


def as_turns(modality, points):
    """Points (…, axes) for the kernels: float64 (points, axes), directions in turns."""
    directions = [axis.is_direction for axis in modality.axes]
    points = np.array(points, float).reshape(-1, len(directions))
    points[:, directions] = points[:, directions] / TAU % 1.0
    return points
