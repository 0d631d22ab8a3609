"""The drawings of the book, on a transparent ground and in colours that serve a light page and a dark one.

Colours keep apart for colour-blind readers, and never stand alone: a curve carries its name, a creep its sign.
"""

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.patches import Circle, Rectangle
from matplotlib_inline.backend_inline import set_matplotlib_formats

from neorl.simulation import bin_steps
from neorl.statistics import band, mean_band

INK = "#808080"
AGENT, GREEN, RED = "#3b8ad9", "#12946d", "#d9622b"
CURVES = ("#d9622b", "#b98a14", "#12946d", "#3b8ad9", "#b565b8")
POINTS = 300  # of an accumulated curve; more cannot be seen


def use_style():
    """Set matplotlib and the notebook to the style of the book."""
    set_matplotlib_formats("svg")
    plt.rcParams.update({
        "figure.facecolor": "none", "axes.facecolor": "none", "savefig.facecolor": "none", "figure.figsize": (4.9, 3.5),
        "font.size": 11, "text.color": INK, "axes.labelcolor": INK, "axes.edgecolor": INK, "xtick.color": INK,
        "ytick.color": INK, "axes.spines.top": False, "axes.spines.right": False, "lines.linewidth": 1.8,
        "figure.constrained_layout.use": True, "svg.hashsalt": "neorl",
    })


def new_board(size=3.6):
    """Axes over the unit board, y downward as in WaterWorld."""
    axes = plt.figure(figsize=(size, size), layout="none").add_axes((0.01, 0.01, 0.98, 0.98))
    axes.set(xlim=(-0.06, 1.06), ylim=(1.06, -0.06), aspect="equal")
    axes.axis("off")
    return axes


def draw_cells(axes, nres_map, colour=INK, fills=None, width=1.0):
    """The receptive fields of a map; `fills` gives cells a colour and an opacity: {cell: (colour, opacity)}."""
    corners, side = _squares(nres_map)
    for cell, corner in enumerate(corners):
        axes.add_patch(Rectangle(corner, side, side, fill=False, edgecolor=colour, linewidth=width))
        if fills and cell in fills:
            fill, opacity = fills[cell]
            axes.add_patch(Rectangle(corner, side, side, facecolor=fill, alpha=opacity, edgecolor="none"))


def draw_values(axes, nres_map, values):
    """Arrows for the action values in every cell, values (cells, 4): the vector (E − W, S − N)."""
    vector = np.stack([values[:, 2] - values[:, 3], values[:, 1] - values[:, 0]], axis=1)
    length = np.linalg.norm(vector, axis=1, keepdims=True)
    corners, side = _squares(nres_map)
    arrow = side * 0.8 * vector / np.where(length > 0, length, 1) * (length / max(length.max(), 1e-30)) ** 0.25
    shown = length[:, 0] > 0
    start = (corners + side / 2 - arrow / 2)[shown]
    axes.quiver(start[:, 0], start[:, 1], arrow[shown, 0], arrow[shown, 1], color=AGENT, angles="xy",
                scale_units="xy", scale=1, width=0.009)


def _squares(nres_map):
    """The upper left corners (cells, 2) of the receptive fields of a map, and the length of their sides."""
    low, high = nres_map.extent
    side = (high - low) / nres_map.resolution
    rows, columns = np.divmod(np.arange(nres_map.cells), nres_map.resolution)
    return low + side * np.stack([columns, rows], axis=1), side


def draw_tank(axes, world, state):
    """Agent and creeps of a tank, each with its velocity over the coming half second; creeps carry their sign."""
    radius = world.radius / world.width
    creep_velocity = state.creep_direction * state.creep_speed[:, None]
    movers = [(state.agent_position, state.agent_velocity, AGENT, "")]
    movers += [(position, velocity, GREEN if green else RED, "+" if green else "−") for position, velocity, green
               in zip(state.creep_position, creep_velocity, state.creep_is_green)]
    for position, velocity, colour, sign in movers:
        x, y = position / world.width
        axes.add_patch(Circle((x, y), radius, facecolor=colour, edgecolor="none"))
        axes.text(x, y, sign, color="white", ha="center", va="center_baseline", weight="bold")
        dx, dy = 0.5 * velocity / world.width
        axes.annotate("", (x + dx, y + dy), (x, y), zorder=0,
                      arrowprops={"arrowstyle": "->", "color": INK, "linewidth": 1.4, "shrinkA": 0, "shrinkB": 0})


def draw_accumulated(results, control):
    """Accumulated reward over steps with the band of 95 % of the runs: results {name: Result}, and a control."""
    axes = plt.figure().add_subplot()
    ends = []
    for (name, result), colour in zip([*results.items(), *control.items()], [*CURVES, INK]):
        points = np.linspace(0, result.rewards.shape[1] - 1, POINTS).astype(int)
        curves = result.rewards.cumsum(axis=1, dtype=float)[:, points]
        steps = result.time[points] * result.world.fps / 1000
        axes.plot(steps, curves.mean(axis=0), color=colour)
        axes.fill_between(steps, *band(curves), color=colour, alpha=0.18, linewidth=0)
        ends.append((curves[:, -1].mean(), name, colour))
    axes.set(xlabel="steps, in thousands", ylabel="accumulated reward", xlim=(0, steps[-1]))
    name_ends(axes, ends)


def draw_proficiency(results, total=None, points=50):
    """Mean reward per second over the run with the 95 % interval of the mean: results {name: Result}.

    total: (name, [Result, …]), drawn as the sum of the rewards of its results, run by run.
    """
    axes = plt.figure().add_subplot()
    curves = {name: binned_rate(result, points) for name, result in results.items()}
    if total:
        curves[total[0]] = sum(binned_rate(result, points) for result in total[1])
    world, steps = next((result.world, result.steps) for result in results.values())
    centre = (np.arange(points) + 0.5) / points * steps / world.fps / 60
    ends = []
    for (name, curve), colour in zip(curves.items(), [*CURVES[:len(results)], INK]):
        axes.plot(centre, curve.mean(axis=0), color=colour)
        axes.fill_between(centre, *mean_band(curve), color=colour, alpha=0.2, linewidth=0)
        ends.append((curve.mean(axis=0)[-points // 10:].mean(), name, colour))
    axes.axhline(0, color=INK, linewidth=0.7)
    axes.set(xlabel="simulated minutes", ylabel="reward per second", xlim=(0, steps / world.fps / 60))
    name_ends(axes, ends)


def binned_rate(result, points):
    """Reward per second (runs, points) over equal stretches of the run."""
    edges = np.linspace(0, result.rewards.shape[1], points + 1).astype(int)
    sums = np.add.reduceat(result.rewards, edges[:-1], axis=1)
    return sums / (np.diff(edges) * bin_steps(result.world) / result.world.fps)


def name_ends(axes, ends):
    """Write the names of curves beside their ends (height, name, colour), moved apart where they would overlap."""
    low, high = axes.get_ylim()
    gap = 0.075 * (high - low)
    at = -np.inf
    for height, name, colour in sorted(ends):
        at = max(height, at + gap)
        axes.annotate(name, (1.02, at), xycoords=("axes fraction", "data"), color=colour, va="center",
                      annotation_clip=False)
