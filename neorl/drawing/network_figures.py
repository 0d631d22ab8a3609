"""Diagrams of networks, drawn from an agent: elements of interest at the left, nodes by depth, the agent's value Q.

Lengths are in ems, the height of a letter, and y runs downward. Every node has a row to itself, and a desire leaves its
node downward in a lane that later nodes leave free, so no line runs through a node.
"""

from dataclasses import dataclass
from textwrap import wrap
from typing import NamedTuple

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.font_manager import FontProperties
from matplotlib.patches import Circle, FancyArrowPatch, FancyBboxPatch
from matplotlib.path import Path
from matplotlib.textpath import TextPath

from neorl.agents.agent import Agent, Desire, Place
from neorl.common import checks
from neorl.drawing.boards import desire_colour
from neorl.drawing.style import AGENT, INK, TEXT, axes_or_new, width_of_figures

LARGEST = 11  # points per em
SMALL = 0.92  # of an em: all letters except those of names
LINE, PORT, LOOP, LANE = 1.25, 1.5, 1.7, 0.85  # distances between lines of text, inputs, loops, outgoing desires
GAP = 1.0  # between boxes
ARROW = 1.7  # the length of an arrow beyond its label
RADIUS = 0.65  # of an element
CORNER = 0.45
Q_WIDTH = 1.7
BOX = "0f"  # the opacity of a box, low so that letters in it stay legible
HEAD = 0.4  # space above a network, and below it


@dataclass
class _Box:
    """A node: its text, incoming desires (from the top), desires for itself, and outgoing desires (from the left)."""

    lines: list[str]
    inputs: list[Desire]
    loops: list[Desire]
    leaving: list[Desire]
    left: float = 0.0
    middle: float = 0.0

    @property
    def width(self):
        name, *others = self.lines
        return 1.0 + max(_width(name, "bold"), *map(_width, others), LANE * len(self.leaving),
                         *(_width(_label(loop)) + ARROW + 0.5 * len(self.loops) for loop in self.loops))

    @property
    def height(self):
        return 0.6 + max(LINE * len(self.lines), PORT * len(self.inputs))

    @property
    def right(self):
        return self.left + self.width

    @property
    def top(self):
        return self.middle - self.height / 2

    @property
    def bottom(self):
        return self.middle + self.height / 2

    def lane(self, desire):
        """The x at which a desire leaves."""
        return self.left + LANE * (0.8 + self.leaving.index(desire))

    def port(self, desire):
        """The y at which a desire arrives."""
        return self.middle + PORT * (self.inputs.index(desire) - (len(self.inputs) - 1) / 2)


class _Drawing(NamedTuple):
    """The layout of a network: its boxes from the top, and the labels of gains, by name of the node."""

    boxes: dict[str, _Box]
    gains: dict[str, str]

    @property
    def q_left(self):
        gain_width = max(map(_width, self.gains.values()), default=0.0)
        return max(box.right for box in self.boxes.values()) + ARROW + gain_width

    @property
    def width(self):
        return self.q_left + Q_WIDTH

    @property
    def height(self):
        return max(box.bottom for box in self.boxes.values())


def draw_network(agent: Agent, ax: Axes | None = None) -> Axes:
    """Draw an agent as a network: nodes with their maps, desires with their valences, and the gains of nodes.

    A desire without a valence of its own is labelled with the sum that it stands for, such as "green: Σ w".
    Returns the axes, `ax` or those of a new figure; in the user's own axes the letters are as large as fits.
    Raises ValueError unless it is a `neorl.Agent`.

    >>> axes = drawing.draw_network(neorl.network_d())
    """
    drawing = laid_out(checks.instance("agent", agent, Agent))
    if ax is None:
        inches, high = width_of_figures(), drawing.height + 2 * HEAD
        em = min(LARGEST, 72 * inches / (drawing.width + 1))
        figure = plt.figure(figsize=(inches, em * high / 72), layout="none")
        return draw_into(figure.add_axes((0, 0, 1, 1)), em, drawing, 72 * inches / em, high, HEAD)
    axes_or_new(ax).axis("off")
    ax.figure.canvas.figure.draw_without_rendering()  # so that the axes get their final size
    wide, high = 72 / ax.figure.dpi * np.array(ax.get_window_extent().size)
    em = min(LARGEST, wide / (drawing.width + 1), high / (drawing.height + 2 * HEAD))
    return draw_into(ax, em, drawing, wide / em, high / em, head=(high / em - drawing.height) / 2)


def draw_into(axes, em, drawing, width, height, head):
    """Draw a laid-out network into the middle of axes of this width and height in ems, `head` of them above it.

    em: in points. Returns the axes.
    """
    margin = (width - drawing.width) / 2
    axes.set(xlim=(-margin, drawing.width + margin), ylim=(height - head, -head))
    axes.axis("off")
    for name, box in drawing.boxes.items():
        _draw_box(axes, em, box.left, box.top, box.width, box.height)
        for i, line in enumerate(box.lines):
            y = box.middle + LINE * (i - (len(box.lines) - 1) / 2)
            write(axes, em, box.left + box.width / 2, y, line, weight="normal" if i else "bold")
        for desire in box.inputs:
            _draw_input(axes, em, desire, box, drawing.boxes)
        for i, desire in enumerate(box.loops):
            inset, top = 0.6 + 0.5 * (len(box.loops) - 1 - i), box.top - LOOP * (i + 1)
            end, start = box.left + inset, box.right - inset
            _draw_arrow(axes, em, [(start, box.top), (start, top), (end, top), (end, box.top)], desire_colour(desire))
            write(axes, em, (start + end) / 2, top + LOOP / 2, _label(desire), desire_colour(desire))
    heights = [drawing.boxes[name].middle for name in drawing.gains] or [drawing.height / 2]
    top, bottom = min(heights) - 1.2, max(heights) + 1.2
    _draw_box(axes, em, drawing.q_left, top, Q_WIDTH, bottom - top)
    write(axes, em, drawing.q_left + Q_WIDTH / 2, (top + bottom) / 2, "Q", weight="bold")
    for name, label in drawing.gains.items():
        box = drawing.boxes[name]
        _draw_arrow(axes, em, [(box.right, box.middle), (drawing.q_left, box.middle)], INK)
        write(axes, em, drawing.q_left - 1.0, box.middle - 0.65, label, ha="right")
    return axes


def laid_out(agent):
    """Where the parts of a network lie, with their labels, for `draw_into`."""
    nodes = {node.name: node for node in agent.nodes}
    depth = {}
    for name in agent.evaluation_order:
        depth[name] = 1 + max((depth[desire.source] for desire in agent.desires if desire.target == name
                               and desire.source in nodes and desire.source != name), default=0)
    order = sorted(depth, key=depth.get)
    boxes, y = {}, 0.0
    for name in order:
        loops = [desire for desire in agent.desires if desire.source == desire.target == name]
        inputs = [desire for desire in agent.desires if desire.target == name and desire not in loops]
        leaving = [desire for desire in agent.desires if desire.source == name and desire not in loops]
        # The lower the target, the further left, and the first of several to one node last: so no lines cross.
        leaving = sorted(reversed(leaving), key=lambda desire: -order.index(desire.target))
        boxes[name] = box = _Box(_lines(nodes[name]), inputs, loops, leaving)
        y += LOOP * len(loops)
        box.middle = y + box.height / 2
        y += box.height + GAP
    outside = [_width(_label(desire)) for desire in agent.desires if desire.source not in nodes]
    column = following = 2 * RADIUS + ARROW + max(outside) if outside else 0.0
    for before, name in zip([order[0], *order], order):
        box = boxes[name]
        if depth[name] > depth[before]:
            column = following
        # The rightmost lane arrives at the top, elements from outside at the bottom: again no lines cross.
        box.inputs.sort(key=lambda desire: -boxes[desire.source].lane(desire) if desire.source in nodes else 0.0)
        box.left = max([column, *(boxes[desire.source].lane(desire) + _width(_label(desire)) + ARROW
                                  for desire in box.inputs if desire.source in nodes)])
        column = box.lane(box.leaving[-1]) + LANE if box.leaving else box.left
        following = max(following, box.right + GAP)
    return _Drawing(boxes, {node.name: f"× {_number(node.gain)}" for node in agent.nodes if node.gain})


def _draw_input(axes, em, desire, box, boxes):
    """Draw the input at one port of a node: an element from outside, or the desire of another node."""
    y, label, colour = box.port(desire), _label(desire), desire_colour(desire)
    if desire.source in boxes:
        x = boxes[desire.source].lane(desire)
        _draw_arrow(axes, em, [(x, boxes[desire.source].bottom), (x, y), (box.left, y)], colour)
        write(axes, em, box.left - 0.9, y - 0.65, label, colour, ha="right")
    else:
        axes.add_patch(Circle((RADIUS, y), RADIUS, facecolor=colour, edgecolor="none"))
        write(axes, em, RADIUS, y, {"green": "+", "red": "−"}.get(desire.source, "×"), "white", weight="bold")
        _draw_arrow(axes, em, [(2 * RADIUS, y), (box.left, y)], colour)
        write(axes, em, 2 * RADIUS + 0.4, y - 0.65, label, colour, ha="left")


def _draw_box(axes, em, left, top, width, height):
    axes.add_patch(FancyBboxPatch((left, top), width, height, boxstyle=f"round,pad=0,rounding_size={CORNER}",
                                  facecolor=AGENT + BOX, edgecolor=INK, linewidth=0.11 * em))


def _draw_arrow(axes, em, points, colour):
    """Draw an arrow along the lines between points, with round corners."""
    path, codes = [points[0]], [Path.MOVETO]
    for before, corner, after in zip(points, points[1:], points[2:]):
        path += [_near(corner, before), corner, _near(corner, after)]
        codes += [Path.LINETO, Path.CURVE3, Path.CURVE3]
    path = Path([*path, points[-1]], [*codes, Path.LINETO])
    axes.add_patch(FancyArrowPatch(path=path, arrowstyle="-|>", color=colour, mutation_scale=0.8 * em,
                                   linewidth=0.11 * em, capstyle="butt"))


def _near(corner, point):
    """The point at `CORNER` from a corner towards another on the same row or column."""
    share = CORNER / (abs(point[0] - corner[0]) + abs(point[1] - corner[1]))
    return tuple(at + share * (to - at) for at, to in zip(corner, point))


def write(axes, em, x, y, text, colour=TEXT, ha="center", weight="normal"):
    """Write a text at a place, in letters of `em` points if they are bold, and a little smaller otherwise."""
    axes.text(x, y, text, color=TEXT if colour == INK else colour, ha=ha, va="center_baseline", weight=weight,
              fontsize=em if weight == "bold" else SMALL * em)


def _width(text, weight="normal"):
    path = TextPath((0, 0), text, size=1 if weight == "bold" else SMALL, prop=FontProperties(weight=weight))
    return path.get_extents().width


def _lines(node):
    """Name, modality and resolutions of a node."""
    maps = [f"N{n}" for n in node.resolutions]
    few = ", ".join(maps) if len(maps) <= 3 else f"{maps[0]} … {maps[-1]}"
    return [node.name, *wrap(node.modality.name, 15), few]


def _label(desire):
    """The valence of a desire, preceded by its source if that is a point or some of a node's elements."""
    valence = "Σ w" if desire.valence is None else _number(desire.valence, "+")
    if desire.source == desire.target:
        valence = f"r = {valence.removeprefix('+')}"
    origin = ", ".join(desire.of)
    if not isinstance(desire.source, str):
        point = desire.source.coordinates if isinstance(desire.source, Place) else desire.source
        origin = f"({', '.join(map(_number, point))})"
    return f"{origin}: {valence}" if origin else valence


def _number(value, sign=""):
    return f"{value:{sign}g}".replace("-", "−")
