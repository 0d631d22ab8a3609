"""All that is chosen of an agent, as the flat arrays that the kernels take: its maps, nodes, desires, learning, policy.

Maps follow one another in the order of the agent's nodes. A *track* is one point that a map follows: the agent itself,
or one of the things that its modality is about. All tracks of a map share its values. Desires keep the agent's order.
What follows from other parameters is filled in by a kernel, so the browser can do it without Python.
"""

from typing import NamedTuple

import numpy as np

from neorl.core.choices import N_EVENTS, Source, Vector
from neorl.core.geometry import cell_at, tiling
from neorl.core.kernel import array, kernel


class MapParameters(NamedTuple):
    """The maps of all nodes. `first_…` arrays have one more entry, for the end of the last map's."""

    resolution: array("int64", "maps")
    # derived
    columns: array("int64", "maps")  # of its `Tiles`, and so are the next six
    rows: array("int64", "maps")
    low_u: array("float64", "maps")
    scale_u: array("float64", "maps")
    low_v: array("float64", "maps")
    scale_v: array("float64", "maps")
    closed: array("bool", "maps")
    cells: array("int64", "maps")
    contact: array("int64", "maps")  # the cell of the vector (0, 0)
    weight: array("float64", "maps")
    first_value: array("int64", "maps + 1")  # where in q the map begins
    first_cell: array("int64", "maps + 1")  # how many cells the maps before it have
    first_track: array("int64", "maps + 1")
    first_trace: array("int64", "maps + 1")  # where in what is remembered its tracks begin, each with all cells


class NodeParameters(NamedTuple):
    """The nodes. `first_…` arrays have one more entry, for the end of the last node's."""

    vector: array("int64", "nodes")  # see `choices.Vector`
    tuning: array("int64", "nodes")  # see `choices.Tuning`
    low: array("float64", "nodes", 2)  # the range of each axis, 0 to 1 if it has none
    high: array("float64", "nodes", 2)
    weighting: array("int64", "nodes")  # see `choices.Weighting`
    gain: array("float64", "nodes")
    first_map: array("int64", "nodes + 1")
    first_landmark: array("int64", "nodes + 1")
    order: array("int64", "nodes")  # nodes, each after those that it takes desires from
    landmark: array("float64", "landmarks", 2)
    # derived
    points: array("int64", "nodes")  # how many it follows
    first_input: array("int64", "nodes + 1")  # where in `inputs` its desires begin
    inputs: array("int64", "desires")  # desires, those of one node after those of the other


class DesireParameters(NamedTuple):
    """The desires."""

    source: array("int64", "desires")  # see `choices.Source`
    target: array("int64", "desires")  # the node
    valence: array("float64", "desires")
    sums_valence: array("bool", "desires")  # whether the valence is that of its elements instead
    scale: array("float64", "desires")
    signed: array("bool", "desires")
    elements: array("bool", "desires", "desires")  # which desires of its source its vector comes from
    at: array("float64", "desires", 2)  # of a point its coordinates, a direction in turns; of a place where it is
    # derived
    goal: array("int64", "desires", "maps")  # the cell of a point


class LearningParameters(NamedTuple):
    """How the Horde learns, see `neorl.agents.agent.Learning`."""

    learning_rate: np.float32
    discount: np.float32
    absent_decay: np.float32
    away: bool  # whether the value of an absent event sinks away from the target
    update_on: int  # see `choices.UpdateOn`
    credit: int  # see `choices.Credit`
    activity_retained: np.float32  # what a step leaves of the activity of an event
    terminal: bool
    trace: int
    memory_retained: np.float32  # what a change of cell, or a step, leaves of what is remembered; 0 without memory
    memory_by_time: bool
    memory_discounts: bool
    bootstrap: bool
    own_causes: bool
    capture: int  # see `choices.Capture`
    attention: int  # see `choices.Attention`


class PolicyParameters(NamedTuple):
    """How the agent chooses, see `neorl.agents.agent.Policy`."""

    exploration: float
    indifferent_is_no_op: bool


class Parameters(NamedTuple):
    """All that is chosen of an agent for one world."""

    width: float  # of the board, in pixels
    own_cell_counts: bool
    maps: MapParameters
    nodes: NodeParameters
    desires: DesireParameters
    learning: LearningParameters
    policy: PolicyParameters


@kernel
def derive(parameters: Parameters, n_things: int) -> None:
    """Fill in the parameters that follow from the chosen ones."""
    maps, nodes, desires = parameters.maps, parameters.nodes, parameters.desires
    for n in range(nodes.vector.shape[0]):
        points = 1
        if nodes.vector[n] == Vector.objects:
            points = n_things
        elif nodes.vector[n] == Vector.boundaries:
            points = 4
        elif nodes.vector[n] == Vector.landmarks:
            points = nodes.first_landmark[n + 1] - nodes.first_landmark[n]
        nodes.points[n] = points
        total = 0.0
        for m in range(nodes.first_map[n], nodes.first_map[n + 1]):
            tiles = tiling(maps.resolution[m], nodes.tuning[n], nodes.low[n, 0], nodes.high[n, 0], nodes.low[n, 1],
                           nodes.high[n, 1])
            cells = tiles.columns * tiles.rows
            maps.columns[m], maps.rows[m], maps.closed[m] = tiles.columns, tiles.rows, tiles.closed
            maps.low_u[m], maps.scale_u[m] = tiles.low_u, tiles.scale_u
            maps.low_v[m], maps.scale_v[m] = tiles.low_v, tiles.scale_v
            maps.cells[m] = cells
            maps.contact[m] = cell_at(0.0, 0.0, tiles)
            maps.weight[m] = 1.0
            for _ in range(nodes.weighting[n]):
                maps.weight[m] *= maps.resolution[m]
            total += maps.weight[m]
            maps.first_value[m + 1] = maps.first_value[m] + N_EVENTS * cells * cells
            maps.first_cell[m + 1] = maps.first_cell[m] + cells
            maps.first_track[m + 1] = maps.first_track[m] + points
            maps.first_trace[m + 1] = maps.first_trace[m] + points * cells
            for e in range(desires.source.shape[0]):
                if desires.source[e] == Source.point and desires.target[e] == n:
                    desires.goal[e, m] = cell_at(desires.at[e, 0], desires.at[e, 1], tiles)
        for m in range(nodes.first_map[n], nodes.first_map[n + 1]):
            maps.weight[m] /= total
        end = nodes.first_input[n]
        for e in range(desires.target.shape[0]):
            if desires.target[e] == n:
                nodes.inputs[end] = e
                end += 1
        nodes.first_input[n + 1] = end
