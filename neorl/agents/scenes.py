"""Scenes of the user's, which are checked before kernels see them."""

from typing import NamedTuple

import numpy as np

from neorl.common import checks
from neorl.common.checks import LARGEST
from neorl.core.scene import Scene
from neorl.kernels.kernel import kernel


def offer(offered, scene, numbers, n_things):
    """Copy a scene of the user's into one of arrays. Raises ValueError for one that does not fit.

    numbers: of kinds, by name and by number. n_things: the greatest number of things.
    """
    try:
        position, velocity, things, kinds, met = (scene.position, scene.velocity, scene.things, scene.kinds,
                                                  scene.met)
    except AttributeError:
        raise checks.error("scene", "a neorl.Scene, or have its fields", scene) from None
    _put("position", offered.position, position)
    if velocity is None:
        offered.velocity[:] = 0.0
    else:
        _put("velocity", offered.velocity, velocity)
    if n_things or not _is_empty(things):
        _put("things", offered.things, things)
        try:
            if len(kinds) != len(offered.kinds):  # which may be too many to iterate over
                raise TypeError
            offered.kinds[:] = [numbers[each] for each in kinds]
        except (KeyError, TypeError, OverflowError):
            raise checks.error("scene.kinds", f"a list of {len(offered.kinds)}, each "
                               f"{checks.either(numbers)}", kinds) from None
        if _is_empty(met):
            offered.met[:] = 0
        else:
            _put("met", offered.met, met)


class Offer(NamedTuple):
    """A scene to be validated."""

    n_kinds: int
    scene: Scene


@kernel
def accept(offer: Offer, scene: Scene) -> bool:
    """Copy a scene if its numbers are finite, except those of absent things; returns whether they are."""
    offered = offer.scene
    for axis in range(offered.position.shape[0]):
        if not (abs(offered.position[axis]) <= LARGEST and abs(offered.velocity[axis]) <= LARGEST):
            return False
    for thing in range(offered.kinds.shape[0]):
        for axis in range(offered.position.shape[0]):
            if offered.kinds[thing] < 0:
                offered.things[thing, axis] = 0.0
            elif not abs(offered.things[thing, axis]) <= LARGEST:
                return False
    for axis in range(offered.position.shape[0]):
        scene.position[axis], scene.velocity[axis] = offered.position[axis], offered.velocity[axis]
    for thing in range(offered.kinds.shape[0]):
        for axis in range(offered.position.shape[0]):
            scene.things[thing, axis] = offered.things[thing, axis]
        was = max(scene.kinds[thing], 0)  # the kind as last seen
        scene.met[thing] = 1 + was if offered.met[thing] != 0 else 0
        scene.kinds[thing] = offered.kinds[thing]
    return True


def _is_empty(given):
    return given.size == 0 if isinstance(given, np.ndarray) else isinstance(given, tuple | list) and not given


def _put(name, mine, given):
    values = checks.as_array(f"scene.{name}", given)
    if values.shape != mine.shape or values.dtype.kind not in "fiub":
        raise checks.error(f"scene.{name}", f"numbers of the shape {mine.shape}", given)
    if values.dtype.itemsize > 8:
        values = checks.doubles(f"scene.{name}", values)  # so that no number is truncated
    if mine.dtype.kind == "i" and values.dtype.kind in "fu":
        values = checks.doubles(f"scene.{name}", values) != 0
    mine[...] = values
