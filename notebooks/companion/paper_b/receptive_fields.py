"""Receptive fields of maps of any modality, drawn over a board for a given position of the agent."""

import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.patches import Rectangle

from neorl.core.coordinates import sense, tune
from neorl.core.direction import TAU
from neorl.drawing.boards import board_or_new
from neorl.drawing.style import AGENT, INK
from neorl.core.scene import HALF_SECOND

RASTER = 121  # places along each side at which receptive fields are evaluated


def draw_receptive_fields(nres_map, world, state, ax=None):
    """Draw the receptive fields of a map of one vector over the board, those of active cells filled; returns the axes.

    By modality, a place stands for itself, for a thing there as the agent would perceive it, or for the velocity that
    takes the agent there in half a second.
    """
    modality = nres_map.modality
    agent = state.scene.position / world.size
    side = np.linspace(0, 1, RASTER)
    places = np.stack(np.meshgrid(side, side), axis=-1)
    vectors = {"position": places, "velocity": (places - agent) / HALF_SECOND}.get(modality.follows, places - agent)
    at = _in_intervals(nres_map, tune(modality, vectors))
    axes = board_or_new(ax)
    arena = axes.add_patch(Rectangle((0, 0), 1, 1, fill=False, edgecolor=INK, linewidth=1.4))
    thin = {"linewidths": 0.8, "colors": INK, "zorder": -1}
    for i, (axis, n) in enumerate(zip(modality.axes, nres_map.intervals)):
        borders = np.arange(1, n)
        borders = borders[(at[..., i].min() < borders) & (borders < at[..., i].max())]
        if axis.is_direction and n > 1:
            directions = TAU * (np.arange(n) - 0.5) / n
            beyond = agent + 2 * np.stack([np.cos(directions), np.sin(directions)], axis=1)
            rays = axes.add_collection(LineCollection([(agent, end) for end in beyond], **thin), autolim=False)
            rays.set_clip_path(arena)
        elif len(borders):
            axes.contour(side, side, at[..., i], borders, **thin)
    for cell in np.unique(nres_map.encode(sense(modality, state.scene, world.size))):
        intervals = np.unravel_index(cell, nres_map.intervals, order="F")
        inside = np.min([_depth(at[..., i], interval, nres_map.intervals[i], modality.axes[i].closed)
                         for i, interval in enumerate(intervals)], axis=0)
        axes.contourf(side, side, inside, [0, np.inf], colors=[AGENT], alpha=0.35, zorder=-2)
    return axes


def _in_intervals(nres_map, coordinates):
    """Coordinates (…, axes) in units of a map's intervals: on each axis interval i spans i … i + 1."""
    at = np.empty(coordinates.shape)
    for i, (axis, n) in enumerate(zip(nres_map.modality.axes, nres_map.intervals)):
        low, high = (-0.5 * TAU / n, TAU - 0.5 * TAU / n) if axis.is_direction else (axis.low, axis.high)
        if axis.boundaries:
            within = np.interp(coordinates[..., i], axis.boundaries, np.arange(n + 1))
            beyond = coordinates[..., i] - np.clip(coordinates[..., i], low, high)
            at[..., i] = within + n * beyond / (high - low)
        else:
            at[..., i] = n * (coordinates[..., i] - low) / (high - low)
    return at + 1e-9  # An interval includes its lower end, but a contour assigns points on it to the region below.


def _depth(at, interval, n, closed):
    """The depth of each coordinate inside one of n intervals, in intervals; negative outside."""
    if closed and n > 1:
        return 0.5 - np.abs((at - interval - 0.5 + n / 2) % n - n / 2)
    above = at - interval if interval > 0 else np.ones_like(at)
    below = interval + 1 - at if interval < n - 1 else np.ones_like(at)
    return np.minimum(above, below)
