"""The figures of chapter 2, in the order of its page: the maze, boxes and desires, the neuron, frames and cells."""

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.patches import Arc, Rectangle
from matplotlib.ticker import MaxNLocator

from companion.chapter_2.tuning import egocentric
from companion.shared.grid_figures import draw_grid, draw_policy, new_grids
from companion.page.panels import add_arrow, add_curves
from neorl.drawing.boards import new_boards
from neorl.drawing.curves import add_spread, draw_curves
from neorl.drawing.style import AGENT, CURVES, GREEN, INK, RED, TEXT, letters, name_ends, width_of_figures

LOW_PANEL = 0.17  # the room for a curve's name, as a share of the height of a low panel
NAMES = {"throughout": "throughout", "never": "never", "delayed": "from day {}"}


def draw_plan(maze):
    """The plan of a `Maze`: the true path from the start to the food box, the blinds, and the doors across the path."""
    path, places = maze.places[: maze.goal + 1], maze.places
    width, height = np.ptp(places, axis=0) + 1.2
    inches = width_of_figures()
    axes = plt.figure(figsize=(inches, inches * height / width)).add_subplot(aspect="equal")
    axes.axis("off")
    axes.invert_yaxis()
    for choice, blind in zip(maze.choice_points, maze.blinds):
        axes.plot(*places[[choice, blind]].T, color=RED, linewidth=7, solid_capstyle="butt", zorder=1)
        out = places[choice + 1] - places[choice]
        door, across = places[choice] + 0.5 / np.abs(out).sum() * out, 0.17 * out[::-1] / np.abs(out).sum()
        axes.plot(*np.stack([door - across, door + across]).T, color=INK, linewidth=2.5, zorder=3)
    axes.plot(*path.T, color=AGENT, linewidth=7, solid_joinstyle="miter", zorder=2)
    for state, neighbour, name, colour in ((0, 1, "start", INK), (-1, -2, "food box", GREEN)):
        axes.plot(*path[state], color=colour, marker="s", markersize=13, zorder=4)
        beyond = np.sign(path[state] - path[neighbour])
        axes.annotate(name, path[state], (38 * beyond[0], -17 * beyond[1]), textcoords="offset points",
                      color=letters(colour), ha="center", va="center")


def draw_errors(by_learner, first_reward):
    """Errors per day of the three groups, one panel per learner: {learner: {group: `Record`}}."""
    width = width_of_figures()
    figure, grid = plt.subplots(len(by_learner), sharex=True, sharey=True, squeeze=False,
                                figsize=(width, 1.9 * len(by_learner)))
    for axes, (learner, groups) in zip(grid[:, 0], by_learner.items()):
        days = np.arange(next(iter(groups.values())).errors.shape[1]) + 1
        ends = []
        for (group, record), colour in zip(groups.items(), CURVES):
            mean = record.errors.mean(axis=0)
            axes.plot(days, mean, color=colour)
            add_spread(axes, days, record.errors, colour)
            ends.append((mean[-1], NAMES[group].format(first_reward), colour))
        axes.axvline(first_reward, color=INK, linewidth=1, linestyle=":")
        axes.set(ylabel="errors per day", title=learner, ylim=(-3, None), xlim=(1, days[-1]))
        axes.title.set_color(TEXT)
        axes.ends = ends
    axes.set(xlabel="day", xticks=days[::2])
    for axes in grid[:, 0]:
        name_ends(axes, axes.ends, LOW_PANEL)


def draw_sessions(curves, phases, ylabel):
    """Curves over sessions, {name: (runs, sessions)}, with phases {name: the session it begins with, from 0}.

    The names of curves stand above them, in the middle of the phase that sets them furthest apart.
    """
    (_, sessions), *_ = (each.shape for each in curves.values())
    axes = draw_curves(np.arange(sessions) + 1, curves, "session", ylabel)
    ends = [*phases.values()][1:] + [sessions]
    means = np.array([each.mean(axis=0) for each in curves.values()])
    middle = max(((begin + end) // 2 for begin, end in zip(phases.values(), ends)), key=lambda at: np.ptp(means[:, at]))
    for name in axes.texts:  # written by `draw_curves` beside ends, where these curves are alike
        height = means[[*curves].index(name.get_text()), middle]
        name.set(position=(0, 3), va="bottom", ha="center")
        name.xy, name.xycoords, name.anncoords = (middle + 1, height), "data", "offset points"
    axes.set_ylim(0, 1.1 * means.max())
    for (name, begin), end in zip(phases.items(), ends):
        axes.text((begin + end + 1) / 2, 1.02, name, transform=axes.get_xaxis_transform(), ha="center")
        if begin:
            axes.axvline(begin + 0.5, color=INK, linewidth=0.8, linestyle=":")


def draw_motives(grid, values, marks):
    """The best actions in a grid under several desires, {name: values (states, 4)}."""
    for axes, (name, q) in zip(new_grids(grid, columns=len(values)), values.items()):
        draw_grid(axes, grid)
        draw_policy(axes, grid, np.where(np.isin(np.arange(grid.states), [*marks])[:, None], 0.0, q))
        axes.set_title(name, fontsize=11)
        for state, text in marks.items():
            axes.text(*grid.places[state], text, ha="center", va="center_baseline", color=RED, weight="bold")


def draw_action_potential(axon, reversals):
    """The potential of an axon, with reversal potentials {name: mV}, and its gates."""
    time, potential, *gates = axon
    width = width_of_figures()
    _, (top, bottom) = plt.subplots(2, sharex=True, figsize=(width, 1.05 * width), height_ratios=(3, 2))
    for name, level in reversals.items():
        top.axhline(level, color=INK, linewidth=0.8, linestyle=":")
    top.plot(time, potential, color=AGENT)
    top.set(ylabel="millivolts", ylim=(-90, 60))
    name_ends(top, [(level, name, INK) for name, level in reversals.items()])
    add_curves(bottom, time, dict(zip(("m: Na⁺ opens", "h: Na⁺ not shut", "n: K⁺ opens"), gates)),
               xlabel="milliseconds", ylabel="share open", ylim=(0, 1), xlim=(0, time[-1]))


def draw_parts(time, inflow, potential, spikes, answers, threshold):
    """The signals in the four parts of a neuron over time, one panel each."""
    width = width_of_figures()
    _, panels = plt.subplots(4, sharex=True, figsize=(width, 1.1 * width), height_ratios=(3, 3, 1, 3))
    dendrite, soma, axon, synapse = panels
    dendrite.plot(time, inflow, color=CURVES[5], linewidth=1.0)
    dendrite.axhline(0, color=INK, linewidth=0.7)
    soma.plot(time, potential, color=AGENT, linewidth=1.0)
    soma.axhline(threshold, color=INK, linewidth=0.8, linestyle=":")
    axon.vlines(time[spikes], 0, 1, color=RED, linewidth=1.4)
    axon.set(ylim=(0, 1.1), yticks=[])
    add_curves(synapse, time, answers, (GREEN, CURVES[4]), LOW_PANEL, linewidth=1.0)
    name_ends(soma, [(threshold, "threshold", INK)])
    titles = ("dendrite: current in, nA", "soma: potential, mV", "axon: spikes", "synapse: the next neuron, mV")
    for axes, title in zip(panels, titles):
        axes.set_title(title, fontsize=11, loc="left")
    synapse.set(xlabel="milliseconds", xlim=(0, time[-1]))


def draw_efficacies(minutes, efficacies):
    """The efficacy of a synapse over time after shocks to the animal: {name: (minutes,)}."""
    add_curves(plt.figure().add_subplot(), minutes, efficacies, xlabel="minutes", ylabel="efficacy of the synapse",
               ylim=(0, None), xlim=(0, minutes[-1]))


def draw_frames(point, heading, distance, bearing):
    """A point (north, east) in Cartesian coordinates of two frames, and one in polar coordinates (thesis figure 2.4).

    heading: radians from north by way of east. bearing: radians from the axis to the right, counter-clockwise.
    """
    width = width_of_figures()
    _, (left, right) = plt.subplots(1, 2, figsize=(width, 0.62 * width))
    reach = 1.15 * max(np.linalg.norm(point), distance)
    for axes in (left, right):
        axes.set(xlim=(-0.25 * reach, 1.1 * reach), ylim=(-0.35 * reach, 1.1 * reach), aspect="equal")
        axes.axis("off")
    north, east = point
    for tip, name, sides in (((0, reach), "North", ("center", "bottom")), ((reach, 0), "East", ("center", "top"))):
        add_arrow(left, (0, 0), tip, INK)
        left.annotate(name, tip, (0, 3 if tip[1] else -5), textcoords="offset points", ha=sides[0], va=sides[1])
    left.plot([0, east, east], [north, north, 0], color=INK, linestyle=":", linewidth=1.2)
    forward, starboard = egocentric(np.array(point, float), heading)
    ahead, aside = (np.array([np.sin(heading + turn), np.cos(heading + turn)]) for turn in (0, np.pi / 2))
    for axis, name in ((ahead, "Forward"), (aside, "Starboard")):
        add_arrow(left, (0, 0), 0.8 * reach * axis, AGENT)
        left.annotate(name, 0.8 * reach * axis, (0, 3 if axis[1] > 0 else -5), textcoords="offset points",
                      color=letters(AGENT), ha="center", va="bottom" if axis[1] > 0 else "top")
    for part in (forward * ahead, starboard * aside):
        left.plot(*np.transpose([part, (east, north)]), color=AGENT, linestyle=":", linewidth=1.2)
    left.plot(east, north, marker="o", color=RED)
    tip = distance * np.array([np.cos(bearing), np.sin(bearing)])
    add_arrow(right, (0, 0), (reach, 0), INK)
    right.plot(*np.transpose([(0, 0), tip]), color=AGENT)
    right.plot(*tip, marker="o", color=RED)
    right.add_patch(Arc((0, 0), 0.5 * reach, 0.5 * reach, theta1=0, theta2=np.degrees(bearing), color=INK))
    right.text(0.28 * reach * np.cos(bearing / 2), 0.28 * reach * np.sin(bearing / 2), f"{np.degrees(bearing):.0f}°")
    right.text(*(tip / 2), f"{distance:g} ", color=AGENT, ha="right", va="bottom")


def draw_landmark(seconds, places, heading, landmark, allocentric, seen):
    """An animal's path past a landmark, and the landmark's vector in both frames."""
    width = width_of_figures()
    figure = plt.figure(figsize=(width, 1.05 * width))
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
        axes.set_title(title, fontsize=11, loc="left")
        add_curves(axes, seconds, dict(zip(names, vectors.T)), line=LOW_PANEL, xlim=(0, seconds[-1]))
    outer.tick_params(labelbottom=False)
    inner.set_xlabel("seconds")


def draw_rate_maps(trajectory, spikes, maps, objects):
    """An animal's path with the spikes of one cell, and rate maps {name: rate}, x first."""
    path, *panels = new_boards(3, (len(maps) + 3) // 3)
    path.plot(*trajectory.position.T, color=INK, linewidth=0.4, alpha=0.6)
    path.plot(*trajectory.position[spikes > 0].T, color=RED, linestyle="none", marker=".", markersize=3)
    path.set_title(f"path, spikes\nof {next(iter(maps))}", fontsize=11)
    for axes, (name, rate) in zip(panels, maps.items()):
        _draw_rate(axes, rate.T, name.replace(" cell", f"\ncell, {np.nanmax(rate):.0f} Hz"))
    path.add_patch(Rectangle((0, 0), 1, 1, fill=False, edgecolor=INK, linewidth=1.4))
    for axes in (path, *panels):
        for x, y in objects:
            axes.plot(x, y, marker="s", markersize=7, markerfacecolor="white", markeredgecolor=RED, markeredgewidth=2)


def draw_grid_cells(maps):
    """Rate maps of grid cells, {title: rate (bins, bins)}, x first, side by side."""
    for axes, (title, rate) in zip(new_boards(len(maps), 1), maps.items()):
        _draw_rate(axes, rate.T, title)


def draw_object_maps(maps):
    """Rates of cells over the vector to an object, {cell: {frame: rate}}, upwards first."""
    panels = iter(new_boards(2, len(maps)))
    for cell, frames in maps.items():
        for frame, rate in frames.items():
            axes = next(panels)
            _draw_rate(axes, rate[::-1], f"{cell},\n{frame} map")
            axes.plot(0.5, 0.5, marker="+", color="white", markersize=10, markeredgewidth=2)


def _draw_rate(axes, image, title):
    axes.imshow(image, extent=(0, 1, 1, 0), cmap="viridis", vmin=0)
    axes.add_patch(Rectangle((0, 0), 1, 1, fill=False, edgecolor=INK, linewidth=1.4))
    axes.set_title(title, fontsize=11)


def draw_tuning_curves(direction, speed, fastest):
    """Rates over direction, as a polar plot, and over speed: {name: (bins,)} each; speeds up to ``fastest``."""
    width = width_of_figures()
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
    bins = len(next(iter(speed.values())))
    add_curves(along, fastest * (np.arange(bins) + 0.5) / bins, speed, (GREEN, INK), ylim=(0, None), xlim=(0, fastest),
               xlabel="speed, box widths per second", ylabel="spikes per second")
