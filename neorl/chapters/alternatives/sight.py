"""What tabular learners distinguish: the cells that a creep's position from the agent and the agent's velocity lie in.

All are chosen by a `Setting`: how many cells there are along each axis of a position, how far they reach to either side
and whether they are equally wide or the wider the farther they are; and how many cells along each axis of the velocity,
and how wide. The outermost cells take what lies beyond.
"""

import math
from typing import NamedTuple

import numpy as np

from neorl.core.kernel import array, inlined_kernel
from neorl.worlds.waterworld import GREEN

ACTIONS = 5  # N, S, E, W and no-op


class Setting(NamedTuple):
    """What is chosen of a tabular learner."""

    cells: int  # along each axis of where a creep is
    reach: float  # board widths to either side
    warped: bool  # cells grow with distance
    speeds: int  # cells along each axis of the velocity
    speed_width: float  # of such a cell, in board widths a second
    places: int  # cells along each axis of the board, of the agent's own position
    learning_rate: float  # α
    discount: float  # γ a step
    exploration: float  # ε
    first: float  # value before anything is learned


class Memory(NamedTuple):
    """All that changes in a tabular learner."""

    table: array("float64", "rows", "columns")
    rows: array("int64", "things")  # of the table, before the step; the first alone where there is one state
    codes: array("int64", "things")  # to work in
    value: array("float64", ACTIONS)
    weights: array("float64", 2)  # what a contact of each kind is worth, where that is learned
    stream: array("uint64", 4)


def new_memory(world, stream, rows, columns, first):
    """A memory in which nothing has been learned."""
    things = world.things
    return Memory(np.full((rows, columns), first), np.zeros(things, int), np.zeros(things, int), np.zeros(ACTIONS),
                  np.zeros(2), stream)


@inlined_kernel
def object_cell(setting, scene, width, thing):
    """The cell that the position of a thing from the agent lies in, below cells²."""
    cell = 0
    for axis in range(2):
        offset = (scene.things[thing, axis] - scene.position[axis]) / (width * setting.reach)
        share = min(abs(offset), 1.0)
        if setting.warped:
            share = math.sqrt(share)
        share = 0.5 + (0.5 * share if offset >= 0.0 else -0.5 * share)
        cell = cell * setting.cells + min(int(share * setting.cells), setting.cells - 1)
    return cell


@inlined_kernel
def velocity_cell(setting, scene, width):
    """The cell that the agent's velocity lies in, below speeds²."""
    cell = 0
    for axis in range(2):
        at = np.floor(scene.velocity[axis] / (width * setting.speed_width) + 0.5 * setting.speeds)
        cell = cell * setting.speeds + int(min(max(at, 0.0), setting.speeds - 1.0))
    return cell


@inlined_kernel
def place_cell(setting, scene, width):
    """The cell of the board that the agent is in, below places²."""
    cell = 0
    for axis in range(2):
        cell = cell * setting.places + min(int(scene.position[axis] / width * setting.places), setting.places - 1)
    return cell


@inlined_kernel
def nearest_cells(setting, scene, width):
    """The cell of the nearest green creep and that of the nearest red one, below (cells² + 1)² together."""
    none = setting.cells * setting.cells
    green, red, green_distance, red_distance = none, none, np.inf, np.inf
    for thing in range(scene.kinds.shape[0]):
        dx = scene.things[thing, 0] - scene.position[0]
        dy = scene.things[thing, 1] - scene.position[1]
        distance = dx * dx + dy * dy
        if scene.kinds[thing] == GREEN and distance < green_distance:
            green, green_distance = object_cell(setting, scene, width, thing), distance
        elif scene.kinds[thing] != GREEN and distance < red_distance:
            red, red_distance = object_cell(setting, scene, width, thing), distance
    return green * (none + 1) + red
