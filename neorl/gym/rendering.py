"""Pictures of a world, as arrays: the agent, the things coloured by kind, walls and obstacles.

A world of more than two axes is projected onto the first two; one of a single axis is drawn as a line.
"""

import numpy as np

from neorl.worlds.arena import Arena
from neorl.worlds.waterworld import WaterWorld

SIDE = 500  # pixels
FLOOR, WALL, AGENT = (247, 247, 247), (128, 128, 128), (59, 138, 217)
KINDS = ((18, 148, 109), (217, 98, 43), (172, 153, 15), (133, 72, 143), (1, 167, 191), (180, 100, 17))
SMALL = 0.02  # of the size: the radius of agents and things that have none


def frame(world, scene):
    """A picture of a `Scene` in a world: uint8 (500, 500, 3), north up."""
    picture = np.full((SIDE, SIDE, 3), FLOOR, np.uint8)
    agent, thing = (world.radius / world.size,) * 2 if isinstance(world, WaterWorld) else (SMALL, SMALL)
    if isinstance(world, Arena):
        thing = world.radius  # within which a place is met
        if world.shape == "round":
            picture[:] = WALL
            draw_disc(picture, 0.5, 0.5, 0.5, FLOOR)
        for left, top, right, bottom in world.obstacles:
            rows, columns = (slice(round(low * SIDE), round(high * SIDE))
                             for low, high in ((top, bottom), (left, right)))
            picture[rows, columns] = WALL
    for place, kind in zip(scene.things, scene.kinds):
        if kind >= 0:
            draw_disc(picture, *in_plane(place / world.size), thing, KINDS[kind % len(KINDS)])
    draw_disc(picture, *in_plane(scene.position / world.size), agent, AGENT)
    return picture


def in_plane(place):
    """(x, y) of a place."""
    return (place[0], place[1]) if len(place) > 1 else (place[0], 0.5)


def draw_disc(picture, x, y, radius, colour):
    """Draw a disc with a smooth edge; position and radius as fractions of the picture's side."""
    rows, columns = (slice(*np.clip([round((at - radius) * SIDE) - 1, round((at + radius) * SIDE) + 2], 0, SIDE))
                     for at in (y, x))
    across, down = np.arange(SIDE)[columns] + 0.5 - x * SIDE, np.arange(SIDE)[rows, None] + 0.5 - y * SIDE
    share = np.clip(radius * SIDE + 0.5 - np.hypot(across, down), 0, 1)[..., None]
    part = picture[rows, columns]
    part[...] = np.rint(part + share * (np.array(colour) - part))

