"""The drawings of the book, on a transparent ground and in colours that serve a light page and a dark one.

Colours keep apart for colour-blind readers, and never stand alone: a curve carries its name, a creep its sign.
"""

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.collections import LineCollection
from matplotlib.patches import Circle, Rectangle
from matplotlib_inline.backend_inline import set_matplotlib_formats
from scipy.optimize import isotonic_regression

from neorl.core.geometry import TAU
from neorl.core.horde import as_vectors
from neorl.evidence.curves import binned_rate, low_passed
from neorl.evidence.statistics import mean_band, tolerance_band
from neorl.worlds import waterworld
from neorl.worlds.probe import HALF_SECOND

INK = "#808080"
AGENT, GREEN, RED = "#3b8ad9", "#12946d", "#d9622b"
CURVES = ("#3e6ad1", "#b02d45", "#ac990f", "#01a7bf", "#85488f", "#b46411", "#9c86fd")
POINTS = 400  # of a curve; more cannot be seen
LOW_PANEL = 0.17  # of the height of a panel, for the name of a curve
RASTER = 121  # places a side at which receptive fields are looked up


def use_style():
    """Set matplotlib and the notebook to the style of the book."""
    set_matplotlib_formats("svg")
    plt.rcParams.update({
        "figure.facecolor": "none", "axes.facecolor": "none", "savefig.facecolor": "none", "figure.figsize": (4.9, 3.5),
        "font.size": 11, "text.color": INK, "axes.labelcolor": INK, "axes.edgecolor": INK, "xtick.color": INK,
        "ytick.color": INK, "axes.spines.top": False, "axes.spines.right": False, "lines.linewidth": 1.8,
        "figure.constrained_layout.use": True, "svg.hashsalt": "neorl",
    })


def new_board(size=3.6, low=0.0):
    """Axes over the unit board, or from `low` to 1 on either side, y downward as in WaterWorld."""
    return _as_board(plt.figure(figsize=(size, size), layout="none").add_axes((0.01, 0.01, 0.98, 0.98)), low)


def new_boards(columns, rows):
    """Axes over that many unit boards, row by row."""
    width, _ = plt.rcParams["figure.figsize"]
    figure, grid = plt.subplots(rows, columns, figsize=(width, 1.1 * width * rows / columns))
    return [_as_board(axes, 0.0) for axes in grid.flat]


def _as_board(axes, low):
    margin = 0.06 * (1 - low)
    axes.set(xlim=(low - margin, 1 + margin), ylim=(1 + margin, low - margin), aspect="equal")
    axes.axis("off")
    return axes


def draw_cells(axes, nres_map, colour=INK, fills=None, width=1.0):
    """The receptive fields of a Cartesian map, some of them filled: fills {cell: (colour, opacity)}."""
    for cell, (corner, sides) in enumerate(zip(*_rectangles(nres_map))):
        axes.add_patch(Rectangle(corner, *sides, fill=False, edgecolor=colour, linewidth=width))
        if fills and cell in fills:
            fill, opacity = fills[cell]
            axes.add_patch(Rectangle(corner, *sides, facecolor=fill, alpha=opacity, edgecolor="none"))


def draw_values(axes, nres_map, values):
    """Arrows for the action values in every cell, values (cells, 4): the vector (E − W, S − N)."""
    vector = as_vectors(values)
    length = np.linalg.norm(vector, axis=1, keepdims=True)
    corners, sides = _rectangles(nres_map)
    arrow = sides.min() * 0.8 * vector / np.where(length > 0, length, 1) * (length / max(length.max(), 1e-30)) ** 0.25
    shown = length[:, 0] > 0
    start = (corners + sides / 2 - arrow / 2)[shown]
    axes.quiver(start[:, 0], start[:, 1], arrow[shown, 0], arrow[shown, 1], color=AGENT, angles="xy",
                scale_units="xy", scale=1, width=0.009)


def _rectangles(nres_map):
    """The upper left corners and the sides of the receptive fields of a map, (cells, 2) each."""
    # What lies beyond the range of a map belongs to the cell at its end, as far as things can be.
    nearest, furthest = (0, 1) if nres_map.modality.follows == "position" else (-1, 1)
    x, y = (np.array(axis.boundaries or np.linspace(axis.low, axis.high, n + 1))
            for axis, n in zip(nres_map.modality.axes, nres_map.intervals))
    for borders in (x, y):
        borders[0], borders[-1] = min(borders[0], nearest), max(borders[-1], furthest)
    rows, columns = np.divmod(np.arange(nres_map.cells), nres_map.intervals[0])
    begin, end = (np.stack([x[columns + i], y[rows + i]], axis=1) for i in (0, 1))
    return begin, end - begin


def draw_receptive_fields(axes, nres_map, world, state):
    """The receptive fields of a map of any modality over the arena, those of its active cells filled.

    A place stands for itself, for a thing there as the agent would see it, or for the velocity that takes the agent
    there in half a second.
    """
    modality = nres_map.modality
    agent = state.scene.position / world.size
    side = np.linspace(0, 1, RASTER)
    places = np.stack(np.meshgrid(side, side), axis=-1)
    vectors = {"position": places, "velocity": (places - agent) / HALF_SECOND}.get(modality.follows, places - agent)
    at = _in_intervals(nres_map, modality.tune(vectors))
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
    for cell in np.unique(nres_map.encode(modality.coordinates(state.scene, world.size))):
        intervals = np.unravel_index(cell, nres_map.intervals, order="F")
        inside = np.min([_depth(at[..., i], interval, nres_map.intervals[i], modality.axes[i].closed)
                         for i, interval in enumerate(intervals)], axis=0)
        axes.contourf(side, side, inside, [0, np.inf], colors=[AGENT], alpha=0.35, zorder=-2)


def _in_intervals(nres_map, coordinates):
    """Coordinates (…, axes) in intervals of a map: on each axis interval i spans i … i + 1."""
    intervals = np.array(nres_map.intervals)
    low, high = np.array([(-0.5 * TAU / n, TAU - 0.5 * TAU / n) if axis.is_direction else (axis.low, axis.high)
                          for axis, n in zip(nres_map.modality.axes, intervals)]).T
    # An interval holds its lower end, a contour leaves to those below what lies on it: what lies there has to move.
    return intervals * (coordinates - low) / (high - low) + 1e-9


def _depth(at, interval, n, closed):
    """How deep inside one of n intervals each coordinate lies, in intervals; negative outside."""
    if closed and n > 1:
        return 0.5 - np.abs((at - interval - 0.5 + n / 2) % n - n / 2)
    above = at - interval if interval > 0 else np.ones_like(at)
    below = interval + 1 - at if interval < n - 1 else np.ones_like(at)
    return np.minimum(above, below)


def draw_tank(axes, world, state):
    """Agent and creeps of a tank, each with its velocity over the coming half second; creeps carry their sign."""
    radius = world.radius / world.width
    scene, creep_velocity = state.scene, state.direction * state.speed[:, None]
    movers = [(scene.position, scene.velocity, AGENT, "")]
    movers += [(position, velocity, GREEN if green else RED, "+" if green else "−") for position, velocity, green
               in zip(scene.things, creep_velocity, scene.kinds == waterworld.GREEN)]
    for position, velocity, colour, sign in movers:
        x, y = position / world.width
        axes.add_patch(Circle((x, y), radius, facecolor=colour, edgecolor="none"))
        axes.text(x, y, sign, color="white", ha="center", va="center_baseline", weight="bold")
        dx, dy = HALF_SECOND * velocity / world.width
        axes.annotate("", (x + dx, y + dy), (x, y), zorder=0,
                      arrowprops={"arrowstyle": "->", "color": INK, "linewidth": 1.4, "shrinkA": 0, "shrinkB": 0})


def draw_desires(axes, run):
    """Where the desires between the nodes of a run's agent land, as seen from its agent."""
    start = run.world_state.scene.position / run.world.size
    for desire, landing in zip(run.agent.desires, run.state.desires.target[:, :2]):
        if run.agent.comes_from_node(desire):
            colour = desire_colour(desire)
            axes.annotate("", start + landing, start, annotation_clip=False, arrowprops={
                "arrowstyle": "->", "color": colour, "linestyle": "--", "linewidth": 1.6, "shrinkA": 8, "shrinkB": 3})
            axes.plot(*(start + landing), marker="s", markersize=7, color=colour, clip_on=False)


def desire_colour(desire):
    """The colour of the creeps that a desire comes from, if it comes from those of one colour alone."""
    (source,) = desire.of if len(desire.of) == 1 else (desire.source,)
    return {"green": GREEN, "red": RED}.get(source, INK)


def draw_accumulated(results, control):
    """Accumulated reward over steps with its tolerance band: results {name: Result}, and a control."""
    axes = plt.figure().add_subplot()
    ends = []
    for (name, result), colour in zip([*results.items(), *control.items()], [*CURVES[:len(results)], INK]):
        points = np.linspace(0, result.rewards.shape[1] - 1, POINTS).astype(int)
        curves = result.rewards.cumsum(axis=1, dtype=float)[:, points]
        steps = result.time[points] * result.world.fps / 1000
        axes.plot(steps, curves.mean(axis=0), color=colour)
        axes.fill_between(steps, *tolerance_band(curves), color=colour, alpha=0.18, linewidth=0)
        ends.append((curves[:, -1].mean(), name, colour))
    axes.set(xlabel="steps, in thousands", ylabel="accumulated reward", xlim=(0, steps[-1]))
    name_ends(axes, ends)


def draw_proficiency(results, total=None, points=50):
    """Mean reward per second over the run with the 95 % interval of the mean: results {name: Result}.

    total: (name, [Result, …]), drawn as the sum of the rewards of its results, run by run.
    """
    curves = {name: binned_rate(result, points) for name, result in results.items()}
    if total:
        curves[total[0]] = sum(binned_rate(result, points) for result in total[1])
    _draw_rates(curves, results, [*CURVES[: len(results)], INK])


def draw_smoothed(results):
    """Mean reward per second over the run as paper B shows it, low-passed, with the 95 % interval of the mean.

    results: {name: Result}, at most as many as there are `CURVES`. The mean before the filter lies thin behind it, cut
    off where it leaves the picture.
    """
    rates = {name: binned_rate(result, min(POINTS, result.rewards.shape[1])) for name, result in results.items()}
    curves = {name: low_passed(rate) for name, rate in rates.items()}
    axes = _draw_rates(curves, results)
    axes.set_ylim(axes.get_ylim())
    for rate, line in zip(rates.values(), axes.lines):
        axes.plot(line.get_xdata(), rate.mean(axis=0), color=line.get_color(), linewidth=0.5, alpha=0.4, zorder=1)


def _draw_rates(curves, results, colours=CURVES):
    """Axes with curves {name: reward per second (runs, points)} over the runs of results {name: Result}."""
    seconds = next(iter(results.values())).seconds
    (_, points), *_ = (curve.shape for curve in curves.values())
    minutes = (np.arange(points) + 0.5) / points * seconds / 60
    axes = _draw_means(minutes, curves, "simulated minutes", "reward per second", colours)
    axes.set_xlim(0, seconds / 60)
    axes.axhline(0, color=INK, linewidth=0.7, zorder=1)
    return axes


def draw_curves(xs, curves, xlabel, ylabel):
    """Means over runs with their 95 % intervals, of curves {name: (runs, points)} over xs (points,)."""
    _draw_means(xs, curves, xlabel, ylabel, CURVES)


def _draw_means(xs, curves, xlabel, ylabel, colours):
    axes = plt.figure().add_subplot()
    ends = []
    for (name, curve), colour in zip(curves.items(), colours):
        mean = curve.mean(axis=0)
        axes.plot(xs, mean, color=colour)
        if len(curve) > 1:
            axes.fill_between(xs, *mean_band(curve), color=colour, alpha=0.2, linewidth=0)
        ends.append((mean[-max(1, len(xs) // 10):].mean(), name, colour))
    axes.set(xlabel=xlabel, ylabel=ylabel, xlim=(0, xs[-1]))
    name_ends(axes, ends)
    return axes


def draw_sweep(xs, estimates_by_name, xlabel, ylabel="reward per second"):
    """A reward against a number: {name: [Estimate for each of xs]}, with their 95 % intervals."""
    axes = plt.figure().add_subplot()
    axes.axhline(0, color=INK, linewidth=0.7)
    axes.set(xlabel=xlabel, ylabel=ylabel)
    add_estimates(axes, xs, estimates_by_name, linewidth=0.8)


def add_estimates(axes, xs, estimates_by_name, linewidth):
    """Points with their 95 % intervals, joined by lines of that width: {name: [Estimate for each of xs]}."""
    ends = []
    for (name, estimates), colour in zip(estimates_by_name.items(), CURVES):
        value, low, high = np.array(estimates).T
        axes.plot(xs, value, color=colour, linewidth=linewidth, marker="o", markersize=5)
        axes.vlines(xs, low, high, color=colour, linewidth=1.8)
        ends.append((value[-1], name, colour))
    name_ends(axes, ends)


def draw_costs(labels, measured, predicted):
    """Microseconds a step of an agent that gets one map (label) after the other, and the sum of what each costs."""
    axes = plt.figure().add_subplot()
    axes.plot(labels, predicted, color=INK, linewidth=1.2)
    axes.plot(labels, measured, color=CURVES[0], linestyle="none", marker="o", markersize=5)
    axes.set(ylabel="microseconds a step", ylim=(0, None))
    axes.tick_params(axis="x", rotation=60)
    name_ends(axes, [(measured[-1], "measured", CURVES[0]), (predicted[-1], "sum", INK)])


def name_ends(axes, ends, line=0.075):
    """Write the names of curves beside their ends (height, name, colour), moved apart where they would overlap.

    line: the room that a name needs, as a share of the height of the axes; more in a low panel.
    """
    low, high = axes.get_ylim()
    ends = sorted(ends)
    apart = line * (high - low) * np.arange(len(ends))
    heights = apart + isotonic_regression([height for height, *_ in ends] - apart).x
    for at, (_, name, colour) in zip(heights, ends):
        axes.annotate(name, (1.02, at), xycoords=("axes fraction", "data"), color=colour, va="center",
                      annotation_clip=False)
