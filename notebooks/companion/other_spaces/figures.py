"""Figures of the page "Is it general?": what an agent does in each world, and learning curves.

What an agent does is `seen` as `companion.other_spaces.trials.watch` records it.
"""

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.patches import Circle, Rectangle

from companion.page.panels import mark
from neorl.core.direction import TAU
from neorl.drawing.boards import as_board
from neorl.drawing.curves import draw_curves
from neorl.drawing.style import AGENT, CURVES, GREEN, INK, RED, TEXT, axes_or_new, letters, width_of_figures
from neorl.statistics import estimate, probability_of_improvement

SEEN = 12  # postures drawn on an arm's way to a target
MARGIN = 0.15  # around an arm and its targets, a little more than their radius
BIRD = 0.05  # half the length of a bird's body, as a share of the square
# Names of birds that do not fit above their body, where another bird or a path is: right, down, side.
ASIDE = {"gingerbread": (-0.03, 0.07, "right"), "sleigh": (-0.03, 0.15, "left")}
STRETCHES = 20  # of a run, for a point of a curve each
MULTIPLES = (1, 2, 5, 10, 20)  # ticks
FIRST_STEPS, ASIDE_OF_PATH = 10, 0.05  # a path's number stands beside its first steps, diameters of the pool from it


def pair(heights=(1, 0.8)):
    """Two panels, the upper one a board; side by side, their text would be too small on a phone."""
    width = width_of_figures()
    _, (above, below) = plt.subplots(2, 1, figsize=(width, 0.7 * width * sum(heights)), height_ratios=heights,
                                     layout="constrained")
    return as_board(above), below


def draw_arms(reached, seen):
    """An arm of two links on its way to two targets, and the reward per second of arms."""
    above, below = pair((0.6, 0.8))  # an arm on its way moves within a low part of its circle
    draw_reaching(seen, reached[2, "agent"].world.radius, above)
    minutes = curve(reached[2, "agent"])[0]
    curves = {f"{links} links{name}": curve(reached[links, key])[1]
              for links in (2, 3) for key, name in (("agent", ""), ("random", ", random"))}
    draw_curves(minutes, curves, "simulated minutes", "reward per second", below)


def curve(result):
    """Reward per second over `STRETCHES` of the runs of a `Result`: (minutes (stretches,), (runs, stretches))."""
    shares = np.linspace(0, 1, STRETCHES + 1)
    rates = [result.rate(*each) for each in zip(shares[:-1], shares[1:])]
    return shares[1:] * result.seconds / 60, np.stack(rates, axis=1)


def draw_reaching(seen, radius, axes):
    """Postures of an arm until it has met two targets, earlier ones fainter, with the targets and obstacles."""
    ends = [at for at, (_, met) in enumerate(seen) if met][:3]
    begin, end = (ends[0] + 1, ends[-1]) if len(ends) > 1 else (0, len(seen))
    shown = np.linspace(begin, end - 1, 2 * SEEN).astype(int)
    for rank, at in enumerate(shown):
        joints = joints_of(seen[at][0].scene.position)
        axes.plot(*joints.T, color=AGENT, alpha=0.15 + 0.6 * rank / len(shown), linewidth=1.8)
        axes.plot(*joints[-1], marker="o", markersize=3, color=AGENT)
    for last in ends[1:]:
        axes.add_patch(Circle(seen[last - 1][0].point[0], radius, facecolor=GREEN, alpha=0.5))
        axes.text(*seen[last - 1][0].point[0], "+", color=TEXT, ha="center", va="center", weight="bold")
    for obstacle in {tuple(seen[at][0].point[1]) for at in shown}:
        axes.add_patch(Circle(obstacle, radius, facecolor=RED, alpha=0.5))
        axes.text(*obstacle, "−", color=TEXT, ha="center", va="center", weight="bold")
    axes.plot(0, 0, marker="s", markersize=6, color=INK)
    places = np.concatenate([place for state, _ in (seen[at] for at in shown)
                             for place in (joints_of(state.scene.position), state.point)])
    axes.set(xlim=(-1.15, 1.15), ylim=(places[:, 1].max() + MARGIN, places[:, 1].min() - MARGIN))


def joints_of(posture):
    """Positions of the base, joints and hand of an arm with links of equal length: float64 (links + 1, 2)."""
    angles = TAU * np.cumsum(posture)
    ways = np.column_stack([np.cos(angles), np.sin(angles)]) / len(posture)
    return np.concatenate([np.zeros((1, 2)), np.cumsum(ways, axis=0)])


def draw_vessel(sailed, seen):
    """A vessel's track among others, and the reward per minute of pilots."""
    above, below = pair()
    draw_track(seen, sailed["radar"].world.radius, above)
    minutes = curve(sailed["radar"])[0]
    draw_curves(minutes, {name: 60 * curve(result)[1] for name, result in sailed.items()}, "simulated minutes",
                "reward per minute", below)


def draw_track(seen, radius, axes):
    """The track of a vessel, the waypoints that it reaches, and the tracks of the others."""
    axes.add_patch(Rectangle((0, 0), 1, 1, fill=False, edgecolor=INK, linewidth=1.4))
    things = np.array([state.scene.things for state, _ in seen])
    for track in things[:, 1:].swapaxes(0, 1):
        leaps = np.flatnonzero(np.abs(np.diff(track, axis=0)).max(axis=1) > 0.05) + 1
        for part in np.split(track, leaps):
            axes.plot(*part.T, color=RED, linewidth=0.8, linestyle="--")
            axes.plot(*part[-1], marker="D", markersize=4, color=RED)
    track = np.array([state.scene.position for state, _ in seen])
    axes.plot(*track.T, color=AGENT, linewidth=1.6)
    axes.annotate("", track[-1], track[-4], arrowprops={"arrowstyle": "-|>", "color": AGENT})
    for number, at in enumerate([at for at, (_, met) in enumerate(seen) if met and at > 0], 1):
        place = seen[at - 1][0].scene.things[0]
        axes.add_patch(Circle(place, radius, facecolor=GREEN, alpha=0.5))
        mark(axes, place, str(number), ha="center", va="center")


def draw_paths(paths, maze, axes):
    """The pool with the paths of trials, from the rim to the platform where the last one ends."""
    axes.add_patch(Circle((0.5, 0.5), 0.5, fill=False, edgecolor=INK, linewidth=1.4))
    for number, (path, colour) in enumerate(zip(paths, (INK, AGENT)), 1):
        axes.plot(*path.T, color=colour, linewidth=1.0 if number == 1 else 2.0)
        ahead = path[min(FIRST_STEPS, len(path) - 1)] - path[0]
        aside = path[0] + ASIDE_OF_PATH * np.array([ahead[1], -ahead[0]]) / max(np.hypot(*ahead), 1e-9)
        axes.text(*aside, str(number), color=letters(colour), weight="bold", ha="center", va="center")
    axes.add_patch(Circle(maze.places[-1], maze.radius, facecolor=GREEN, alpha=0.6))


def draw_birds(asked, paths, named, nameless):
    """The space of birds with paths to some of them, and the steps of questions."""
    above, below = pair((1, 0.5))
    draw_space(paths, named, nameless, above)
    draw_rows({name: estimate(np.mean, each.mean(axis=1)) for name, each in asked.items()},
              "steps, as a multiple of the fewest", below)
    below.set_xscale("log")
    below.set_xticks(MULTIPLES, MULTIPLES)
    below.minorticks_off()
    below.axvline(1, color=INK, linewidth=0.7)


def draw_space(paths, named, nameless, axes):
    """The space of birds: those with a name, some others, and paths between them."""
    axes.add_patch(Rectangle((0, 0), 1, 1, fill=False, edgecolor=INK, linewidth=1.4))
    for path in paths:
        axes.plot(*path.T, color=AGENT, linewidth=1.2)
    for name, bird in named.items():
        draw_bird(bird, axes, GREEN)
        right, down, side = ASIDE.get(name, (0.02, -0.04, "right"))
        axes.text(bird[0] + right, bird[1] + down, name, color=TEXT, ha=side, va="bottom", fontsize=9)
    for bird in nameless:
        draw_bird(bird, axes, INK)
    axes.text(0.5, 1.03, "neck →", color=TEXT, ha="center", va="top")
    axes.text(-0.03, 0.5, "legs →", color=TEXT, ha="right", va="center", rotation=270)


def draw_bird(bird, axes, colour):
    """A bird at its point in the space, with neck and legs of the lengths that the point stands for."""
    (x, y), (neck, legs) = bird, 0.02 + 0.08 * np.array(bird)
    axes.plot([x - BIRD / 2, x + BIRD / 2], [y, y], color=colour, linewidth=5, solid_capstyle="round")
    axes.plot([x + BIRD / 2, x + BIRD / 2 + neck / 3], [y, y - neck], color=colour, linewidth=1.6)
    axes.plot(x + BIRD / 2 + neck / 3, y - neck, marker="o", markersize=3, color=colour)
    for foot in (-0.01, 0.01):
        axes.plot([x + foot, x + foot], [y, y + legs], color=colour, linewidth=1.2)


def draw_car(driven, learner, decisions):
    """The pushes that a learner has learned, and steps per episode as drivers learn."""
    above, below = pair()
    draw_pushes(learner, above)
    points = driven["neoRL"].shape[1]
    draw_curves((np.arange(points) + 1) * decisions / points, driven, "decisions", "steps per episode", below)


def draw_pushes(learner, axes):
    """Whether a driver pushes left or right, by cell of place (rightward) and velocity (upward); empty if unknown."""
    places, velocities = learner.agent.nodes[0].modality.axes
    columns, rows = places.intervals, velocities.intervals
    goals = [columns - 1 + columns * row for row in range(rows)]
    value = learner.q(0)[:, :, goals].sum(axis=2)
    push = np.where(value.max(axis=1) > 0, value[:, 2] - value[:, 0], np.nan).reshape(rows, columns)
    axes.axis("on")
    axes.set(aspect="auto", xlim=(places.low, places.high), ylim=(velocities.low, velocities.high), xlabel="place",
             ylabel="velocity")
    for row, column in np.argwhere(np.isfinite(push)):
        right = push[row, column] > 0
        x = places.low + (column + 0.5) * (places.high - places.low) / columns
        y = velocities.low + (row + 0.5) * (velocities.high - velocities.low) / rows
        axes.plot(x, y, marker=">" if right else "<", markersize=5, color=CURVES[0] if right else CURVES[1])


def draw_worlds(scores):
    """Probability that a run of the agent beats a random agent's, by world."""
    axes = draw_rows({world: probability_of_improvement(*each) for world, each in scores.items()},
                     "probability of beating a random agent")
    axes.set_xlim(0, 1.04)
    axes.axvline(0.5, color=INK, linewidth=0.7)
    return axes


def draw_rows(estimates, label, ax=None):
    """Values with their intervals, a row for each. estimates: {name: `Estimate`}."""
    axes = axes_or_new(ax, figsize=(width_of_figures(), 0.4 * len(estimates) + 0.8))
    for row, (name, (value, low, high)) in enumerate(estimates.items()):
        axes.plot(value, row, marker="o", color=CURVES[0])
        axes.plot([low, high], [row, row], color=CURVES[0])
    axes.set(yticks=range(len(estimates)), yticklabels=list(estimates), ylim=(len(estimates) - 0.5, -0.5), xlabel=label)
    return axes
