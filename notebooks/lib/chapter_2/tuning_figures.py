"""Drawings of reference frames, rate maps and tuning curves."""

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.patches import Arc, Rectangle
from matplotlib.ticker import MaxNLocator

from lib.chapter_2.further_cells import STEP
from lib.chapter_2.tuning import cartesian, egocentric
from neorl.drawing.boards import new_boards
from neorl.drawing.curves import draw_curves
from neorl.drawing.style import AGENT, CURVES, GREEN, INK, LOW_PANEL, RED, letters, name_ends


def draw_frames(point, heading, distance, bearing):
    """A point in Cartesian coordinates of two frames, and one in polar coordinates (compare thesis figure 2.4).

    point: (north, east) from the animal. heading: radians from north by way of east. distance, bearing: of the other
    point, the bearing in radians from the axis to the right, counter-clockwise.
    """
    width, _ = plt.rcParams["figure.figsize"]
    _, (left, right) = plt.subplots(1, 2, figsize=(width, 0.62 * width))
    reach = 1.15 * max(np.linalg.norm(point), distance)
    for axes in (left, right):
        axes.set(xlim=(-0.25 * reach, 1.1 * reach), ylim=(-0.35 * reach, 1.1 * reach), aspect="equal")
        axes.axis("off")
    north, east = point
    for tip, name, sides in (((0, reach), "North", ("center", "bottom")), ((reach, 0), "East", ("center", "top"))):
        _arrow(left, (0, 0), tip, INK)
        left.annotate(name, tip, (0, 3 if tip[1] else -5), textcoords="offset points", ha=sides[0], va=sides[1])
    left.plot([0, east, east], [north, north, 0], color=INK, linestyle=":", linewidth=1.2)
    forward, starboard = egocentric(np.array(point, float), heading)
    ahead, aside = (np.array([np.sin(heading + turn), np.cos(heading + turn)]) for turn in (0, np.pi / 2))
    for axis, name in ((ahead, "Forward"), (aside, "Starboard")):
        _arrow(left, (0, 0), 0.8 * reach * axis, AGENT)
        left.annotate(name, 0.8 * reach * axis, (0, 3 if axis[1] > 0 else -5), textcoords="offset points",
                      color=letters(AGENT), ha="center", va="bottom" if axis[1] > 0 else "top")
    for part in (forward * ahead, starboard * aside):
        left.plot(*np.transpose([part, (east, north)]), color=AGENT, linestyle=":", linewidth=1.2)
    left.plot(east, north, marker="o", color=RED)
    tip = cartesian(distance, bearing)
    _arrow(right, (0, 0), (reach, 0), INK)
    right.plot(*np.transpose([(0, 0), tip]), color=AGENT)
    right.plot(*tip, marker="o", color=RED)
    right.add_patch(Arc((0, 0), 0.5 * reach, 0.5 * reach, theta1=0, theta2=np.degrees(bearing), color=INK))
    right.text(0.28 * reach * np.cos(bearing / 2), 0.28 * reach * np.sin(bearing / 2), f"{np.degrees(bearing):.0f}°")
    right.text(*(tip / 2), f"{distance:g} ", color=AGENT, ha="right", va="bottom")


def _arrow(axes, start, end, colour):
    axes.annotate("", end, start, arrowprops={"arrowstyle": "->", "color": colour, "linewidth": 1.4,
                                              "shrinkA": 0, "shrinkB": 0})


def draw_landmark(seconds, places, heading, landmark, allocentric, seen):
    """An animal's path past a landmark, and the components of the landmark's vector in both frames over time.

    seconds: (steps,). places: (steps, 2), north first. heading: (steps,), radians from north by way of east.
    landmark: its place. allocentric: (steps, 2), north and east. seen: (steps, 2), forward and starboard.
    """
    width, _ = plt.rcParams["figure.figsize"]
    figure = plt.figure(figsize=(width, 1.25 * width))
    scene, outer, inner = figure.subplots(3, height_ratios=(4, 3, 3))
    every = max(1, len(seconds) // 16)
    scene.plot(places[:, 1], places[:, 0], color=INK, linewidth=1.0)
    scene.quiver(places[::every, 1], places[::every, 0], np.sin(heading[::every]), np.cos(heading[::every]),
                 color=AGENT, scale=14, width=0.008)
    scene.plot(landmark[1], landmark[0], marker="s", markersize=9, color=RED)
    scene.annotate("landmark", (landmark[1], landmark[0]), (8, 0), textcoords="offset points", color=RED, va="center")
    scene.set(aspect="equal", xlabel="east", ylabel="north")
    scene.margins(0.25)
    for axes, vectors, names, title in ((outer, allocentric, ("north", "east"), "allocentric"),
                                        (inner, seen, ("forward", "starboard"), "egocentric")):
        for component, colour in zip(vectors.T, CURVES):
            axes.plot(seconds, component, color=colour)
        axes.set_title(title, fontsize=11, loc="left")
        axes.set_xlim(0, seconds[-1])
        ends = [(component[-1], name, colour) for component, name, colour in zip(vectors.T, names, CURVES)]
        name_ends(axes, ends, line=LOW_PANEL)
    outer.tick_params(labelbottom=False)
    inner.set_xlabel("seconds")


def draw_rate_maps(trajectory, spikes, maps, objects):
    """An animal's path with the spikes of one cell, and rate maps of several {name: rate (bins, bins)}, x first.

    spikes: at each step of the trajectory. objects: their places in the box, drawn as squares.
    """
    path, *panels = new_boards(2, (len(maps) + 2) // 2)
    path.plot(*trajectory.position.T, color=INK, linewidth=0.4, alpha=0.6)
    path.plot(*trajectory.position[spikes > 0].T, color=RED, linestyle="none", marker=".", markersize=3)
    path.set_title(f"path, spikes of {next(iter(maps))}", fontsize=11)
    for axes, (name, rate) in zip(panels, maps.items()):
        axes.imshow(rate.T, extent=(0, 1, 1, 0), cmap="viridis", vmin=0)
        axes.set_title(f"{name}, {np.nanmax(rate):.0f} Hz", fontsize=11)
    for axes in (path, *panels):
        axes.add_patch(Rectangle((0, 0), 1, 1, fill=False, edgecolor=INK, linewidth=1.4))
        for x, y in objects:
            axes.plot(x, y, marker="s", markersize=7, markerfacecolor="white", markeredgecolor=RED, markeredgewidth=2)


def draw_grid_cells(maps):
    """Rate maps of grid cells, {title: rate (bins, bins)}, x first, side by side."""
    for axes, (title, rate) in zip(new_boards(len(maps), 1), maps.items()):
        _draw_rate(axes, rate.T, (0, 1, 1, 0), title)


def draw_object_maps(maps):
    """Rates of cells over the vector to an object, {cell: {frame: rate (bins, bins)}}, a row for each cell.

    A cross marks the animal; the first axis of a rate is upwards.
    """
    panels = iter(new_boards(2, len(maps)))
    for cell, frames in maps.items():
        for frame, rate in frames.items():
            axes = next(panels)
            _draw_rate(axes, rate[::-1], (0, 1, 1, 0), f"{cell},\n{frame} map")
            axes.plot(0.5, 0.5, marker="+", color="white", markersize=10, markeredgewidth=2)


def draw_drift(errors, step=STEP):
    """Errors of path integration over time: {name: (runs, steps)}, with a point every half second. step: seconds."""
    every = max(1, round(0.5 / step))
    curves = {name: each[:, ::every] for name, each in errors.items()}
    steps = next(iter(errors.values())).shape[1]
    axes = draw_curves(step * np.arange(0, steps, every), curves, "seconds", "error, box widths")
    axes.set_ylim(0, None)


def _draw_rate(axes, image, extent, title):
    axes.imshow(image, extent=extent, cmap="viridis", vmin=0)
    axes.add_patch(Rectangle((0, 0), 1, 1, fill=False, edgecolor=INK, linewidth=1.4))
    axes.set_title(title, fontsize=11)


def draw_tuning_curves(direction, speed, fastest):
    """Rates over direction, as a polar plot, and over speed: {name: (bins,)} each; speeds up to ``fastest``."""
    width, _ = plt.rcParams["figure.figsize"]
    figure = plt.figure(figsize=(width, 1.3 * width))
    around, along = figure.add_subplot(211, projection="polar"), figure.add_subplot(212)
    rim = 1.2 * np.nanmax([*direction.values()])
    peak = np.nanargmax(next(iter(direction.values())))
    for number, ((name, rate), colour) in enumerate(zip(direction.items(), (AGENT, INK))):
        angles = 2 * np.pi * (np.arange(len(rate) + 1) + 0.5) / len(rate)
        around.plot(angles, np.append(rate, rate[:1]), color=colour)
        # Names are outside the circle: the first where its curve is highest, the second opposite.
        at = (peak + number * len(rate) // 2) % len(rate)
        around.annotate(name, (angles[at], rate[at]), (angles[at], 1.1 * rim), color=letters(colour), va="center",
                        ha="left" if np.cos(angles[at]) > 0 else "right", annotation_clip=False,
                        arrowprops={"arrowstyle": "-", "color": colour, "linewidth": 0.8, "shrinkA": 0, "shrinkB": 0})
    # As on a map: y points south, so that angles run clockwise from east.
    around.set_theta_direction(-1)
    around.set_xticks(np.pi / 2 * np.arange(4), ["E", "S", "W", "N"])
    around.set_rlabel_position(-58)
    around.yaxis.set_major_locator(MaxNLocator(3, steps=[1, 2, 5, 10]))
    around.set_rmax(rim)
    around.grid(color=INK, alpha=0.4)
    around.spines["polar"].set_color(INK)
    ends = []
    for (name, rate), colour in zip(speed.items(), (GREEN, INK)):
        middles = fastest * (np.arange(len(rate)) + 0.5) / len(rate)
        along.plot(middles, rate, color=colour)
        ends.append((rate[~np.isnan(rate)][-1], name, colour))
    along.set(xlabel="speed, box widths per second", ylabel="spikes per second", ylim=(0, None), xlim=(0, fastest))
    name_ends(along, ends)
