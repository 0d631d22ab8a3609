"""The figures of chapter 1: paths through the tank, along a plan and by an agent's own knowledge."""

import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.patches import Circle

from companion.page.panels import UNDER_WHITE
from neorl.drawing.boards import inside
from neorl.drawing.style import AGENT, GREEN, INK, RED


def draw_walls(axes):
    """The border of the tank."""
    axes.plot([0, 1, 1, 0, 0], [0, 0, 1, 1, 0], color=INK, linewidth=1.2)


def draw_route(axes, path, waypoints):
    """A path (steps + 1, 2) and the waypoints (points, 2) that it follows, numbered; in board widths."""
    draw_walls(axes)
    _draw_path(axes, path, np.ones(len(path) - 1, bool))
    axes.plot(*path[0], "o", color=AGENT, markersize=9)
    for number, (x, y) in enumerate(waypoints, start=1):
        _draw_disc(axes, (x, y), 0.045, UNDER_WHITE, str(number))


def draw_recording(axes, recording):
    """The agent's path in a `Recording`, thinner with age, and the places where it caught creeps, with their signs.

    The path is interrupted where catching the last green creep has put the agent back in the middle.
    """
    draw_walls(axes)
    places = recording.agent[:, :2]
    put_back = np.all(recording.agent[1:] == (0.5, 0.5, 0, 0), axis=1)
    _draw_path(axes, places, ~put_back)
    taken = np.diff(recording.hits, axis=0) > 0
    met_at = np.where(put_back[:, None], places[:-1], places[1:])
    for kind, (colour, sign) in enumerate([(GREEN, "+"), (RED, "−")]):
        for place in met_at[taken[:, kind]]:
            _draw_disc(axes, place, recording.radius, colour, sign)
    _draw_disc(axes, places[-1], recording.radius, AGENT, "")
    axes.set_title(f"{recording.name}: {recording.hits[-1][0]} green, {recording.hits[-1][1]} red", fontsize=11)


def _draw_path(axes, path, shown):
    """Draw those steps of a path that are shown, in forty stretches or more of increasing width."""
    hidden = np.flatnonzero(~shown)
    cuts = np.unique([*np.linspace(0, len(shown), 41).astype(int), *hidden, *(hidden + 1)])
    ends = [(begin, end) for begin, end in zip(cuts, cuts[1:]) if shown[begin]]
    axes.add_collection(LineCollection([path[begin : end + 1] for begin, end in ends], colors=AGENT,
                                       linewidths=[0.7 + 1.7 * begin / len(shown) for begin, _ in ends]))


def _draw_disc(axes, place, radius, colour, sign):
    place = inside(place, radius)
    axes.add_patch(Circle(place, radius, facecolor=colour, edgecolor="none", zorder=3))
    axes.text(*place, sign, color="white", ha="center", va="center_baseline", weight="bold", zorder=4)
