"""The cells of the forager, and of the simpler agents that it is compared with."""

from neorl.agents.forager import FASTEST
from neorl.core.modality import Axis, Modality


def foveated_cells(foveated=True, velocity=True, mirrored=True):
    """Conjunctive cells of an object vector and the agent's velocity in the plane.

    foveated: whether receptive fields grow with distance. velocity: whether cells are also tuned to the velocity.
    mirrored: whether mirror images share a cell. If not, ranges are twice as wide, so that a map of 2N − 1 has the
        receptive fields of a mirrored map of N.
    """
    feature, low = ("foveated" if foveated else "component"), (0.0 if mirrored else -1.0)
    reach = FASTEST if mirrored else 2 * FASTEST
    axes = [Axis("objects", feature, along, low, 1.0) for along in (0, 1)]
    axes += [Axis("velocity", "component", along, -reach, reach) for along in (0, 1)] if velocity else []
    return Modality("foveated object-vector cell", axes, mirrored=mirrored)
