"""Observations: a scene as one flat array of single-precision numbers.

1. The agent's position, in units of the world's size: one number per axis, in [0, 1].
2. Its velocity, in sizes per second: one number per axis, in [−10, 10], a range that no velocity exceeds in WaterWorld
   or in an arena with inertia.
3. For every thing, its place and its kind: one number per axis, then one per kind, 1 for its own and 0 for the others.
   If *egocentric*, the place is relative to the agent, in sizes, in [−1, 1], and the nearest thing comes first;
   otherwise it is a position in [0, 1], and things keep their order in the scene. All numbers of an absent thing are 0;
   if egocentric, it comes last.

A neoRL agent perceives the same: the velocities of things, for example, are missing. Values beyond a range are clipped
to it.
"""

import numpy as np

from neorl.common.extras import require
from neorl.kernels.kernel import inlined_kernel, kernel

gymnasium = require("gymnasium", extra="gym")

FASTEST = 10.0  # sizes per second; in WaterWorld drag limits velocities to 9.75


def observation_space(world, egocentric):
    """The `gymnasium.spaces.Box` of the observations of a world."""
    axes, kinds = world.actions.axes, len(world.kinds)
    least = [0] * axes + [-FASTEST] * axes + ([-1 if egocentric else 0] * axes + [0] * kinds) * world.things
    most = [1] * axes + [FASTEST] * axes + [1] * (axes + kinds) * world.things
    return gymnasium.spaces.Box(np.array(least, np.float32), np.array(most, np.float32))


@kernel
def observe(scene, size, n_kinds, egocentric, distance, order, numbers):
    """Write the observation of a scene into `numbers`, and return whether everything observed is finite.

    distance: float64 (things,) and order: int64 (things,), working memory.
    """
    finite, axes = True, scene.position.shape[0]
    for axis in range(axes):
        finite = finite and abs(scene.position[axis]) < np.inf and abs(scene.velocity[axis]) < np.inf
        numbers[axis] = clipped(scene.position[axis] / size, 0.0, 1.0)
        numbers[axes + axis] = clipped(scene.velocity[axis] / size, -FASTEST, FASTEST)
    for thing in range(order.shape[0]):
        order[thing] = thing
    if egocentric:
        sort_by_distance(scene, distance, order)
    at = 2 * axes
    for rank in range(order.shape[0]):
        thing = order[rank]
        kind = scene.kinds[thing]
        for axis in range(axes):
            place = scene.things[thing, axis]
            finite = finite and (kind < 0 or abs(place) < np.inf)
            if kind < 0:
                numbers[at + axis] = 0.0
            elif egocentric:
                numbers[at + axis] = clipped((place - scene.position[axis]) / size, -1.0, 1.0)
            else:
                numbers[at + axis] = clipped(place / size, 0.0, 1.0)
        for each in range(n_kinds):
            numbers[at + axes + each] = 1.0 if each == kind else 0.0
        at += axes + n_kinds
    return finite


@inlined_kernel
def clipped(number, least, most):
    return np.float32(min(max(number, least), most))


@inlined_kernel
def sort_by_distance(scene, distance, order):
    """Order the things by their squared distance from the agent, ties by their number, absent ones last.

    Shellsort: it needs no memory, and sorting thousands of things takes no longer than observing them a few times.
    """
    things = order.shape[0]
    for thing in range(things):
        distance[thing] = 0.0 if scene.kinds[thing] >= 0 else np.inf
        for axis in range(scene.position.shape[0] if scene.kinds[thing] >= 0 else 0):
            way = scene.things[thing, axis] - scene.position[axis]
            distance[thing] += way * way
    gap = things // 2
    while gap > 0:
        for start in range(gap, things):
            moved, at = order[start], start
            while at >= gap:
                other = order[at - gap]
                if distance[other] < distance[moved] or distance[other] == distance[moved] and other < moved:
                    break
                order[at] = other
                at -= gap
            order[at] = moved
        gap //= 2
