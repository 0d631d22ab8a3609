"""State features of tabular learners: the cells of a creep's position relative to the agent, and of its velocity.

A `Setting` has the number of cells along each axis of a position, their reach to either side, and whether they are
equally wide or grow with distance; and the number and width of the cells along each axis of the agent's velocity. The
outermost cells include everything beyond.
"""

import math
from typing import NamedTuple

import numpy as np

from neorl.core.kernel import array, inlined_kernel
from neorl.worlds.waterworld import GREEN

ACTIONS = 5  # N, S, E, W and no-op


class Setting(NamedTuple):
    """Parameters of a tabular learner."""

    cells: int  # along each axis of a creep's position relative to the agent
    reach: float  # board widths to either side
    warped: bool  # cells grow with distance
    speeds: int  # cells along each axis of the velocity
    speed_width: float  # of such a cell, in board widths per second
    places: int  # cells along each axis of the agent's position on the board
    learning_rate: float  # α
    discount: float  # γ per step
    exploration: float  # ε
    first: float  # initial value of every action


class Memory(NamedTuple):
    """The mutable state of a tabular learner."""

    table: array("float64", "rows", "columns")
    rows: array("int64", "things")  # of the table, before the step; only the first where there is one state
    codes: array("int64", "things")  # scratch space
    value: array("float64", ACTIONS)
    weights: array("float64", 2)  # worth of a contact of each kind, where that is learned
    stream: array("uint64", 4)


def new_memory(world, stream, rows, columns, first):
    """A `Memory` before learning, with a table of (rows, columns) that all have the value `first`."""
    things = world.things
    return Memory(np.full((rows, columns), first), np.zeros(things, int), np.zeros(things, int), np.zeros(ACTIONS),
                  np.zeros(2), stream)


@inlined_kernel
def object_cell(setting, scene, width, thing):
    """The cell of a thing's position relative to the agent, below cells²."""
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
    """The cell of the agent's velocity, below speeds²."""
    cell = 0
    for axis in range(2):
        at = np.floor(scene.velocity[axis] / (width * setting.speed_width) + 0.5 * setting.speeds)
        cell = cell * setting.speeds + int(min(max(at, 0.0), setting.speeds - 1.0))
    return cell


@inlined_kernel
def place_cell(setting, scene, width):
    """The cell of the agent's position on the board, below places²."""
    cell = 0
    for axis in range(2):
        cell = cell * setting.places + min(int(scene.position[axis] / width * setting.places), setting.places - 1)
    return cell


@inlined_kernel
def nearest_cells(setting, scene, width):
    """The cells of the nearest green creep and the nearest red one as one number, below (cells² + 1)²."""
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
