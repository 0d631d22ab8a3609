"""An agent as the kernels take it: a `Plan` of flat arrays for what is chosen, a `Memory` of them for what changes.

Maps follow one another in the order of the agent's nodes. A *track* is one point that a map follows: the agent itself,
or one of the things that its modality is about. All tracks of a map share its values. Desires keep the agent's order.
The fields of a plan that follow from others are filled in by a kernel, so that whoever has no Python can have a plan.
"""

from typing import NamedTuple

import numpy as np

from neorl.core.choices import Source
from neorl.core.horde import N_EVENTS
from neorl.core.kernel import array, kernel, zeros
from neorl.core.maps import cell_at, tiling
from neorl.core.modality import BOUNDARIES, LANDMARKS, OBJECTS
from neorl.core.traces import N_ROWS


class Plan(NamedTuple):
    """All that is chosen of an agent for one world. `first_…` arrays have one more entry, for the end of the last."""

    width: float  # of the board, in pixels
    # of each map
    resolution: array("int64", "maps")
    columns: array("int64", "maps")
    rows: array("int64", "maps")
    low_u: array("float64", "maps")  # where the first column begins
    scale_u: array("float64", "maps")  # columns a unit
    low_v: array("float64", "maps")
    scale_v: array("float64", "maps")
    closed: array("bool", "maps")  # whether the last row borders on the first
    cells: array("int64", "maps")
    contact: array("int64", "maps")  # the cell of the vector (0, 0)
    weight: array("float64", "maps")
    first: array("int64", "maps + 1")  # where in q the map begins
    first_cell: array("int64", "maps + 1")  # how many cells the maps before it have
    first_track: array("int64", "maps + 1")
    first_trace: array("int64", "maps + 1")  # where in what is remembered its tracks begin, each with all cells
    # of each node
    vector: array("int64", "nodes")  # see `modality.Vector`
    tuning: array("int64", "nodes")  # see `modality.Tuning`
    low: array("float64", "nodes", 2)  # the range of each axis, 0 to 1 if it has none
    high: array("float64", "nodes", 2)
    weighting: array("int64", "nodes")  # see `choices.Weighting`
    gain: array("float64", "nodes")
    points: array("int64", "nodes")  # how many it follows
    first_map: array("int64", "nodes + 1")
    first_landmark: array("int64", "nodes + 1")
    first_input: array("int64", "nodes + 1")  # where in `inputs` its desires begin
    order: array("int64", "nodes")  # nodes, each after those that it takes desires from
    landmark: array("float64", "landmarks", 2)
    inputs: array("int64", "desires")  # desires, those of one node after those of the other
    # of each desire
    source: array("int64", "desires")  # see `choices.Source`
    target: array("int64", "desires")  # the node
    valence: array("float64", "desires")
    sums_valence: array("bool", "desires")  # whether the valence is that of its elements instead
    scale: array("float64", "desires")
    signed: array("bool", "desires")
    elements: array("bool", "desires", "desires")  # which desires of its source its vector comes from
    at: array("float64", "desires", 2)  # of a POINT its coordinates, a direction in turns; of a PLACE where it is
    goal: array("int64", "desires", "maps")  # the cell of a POINT
    # learning and policy, as in `Learning` and `Policy`
    own_cell_counts: bool
    learning_rate: np.float32
    discount: np.float32
    absent_decay: np.float32
    away: bool  # whether what is absent sinks away from the target
    update_on: int  # see `choices.UpdateOn`
    credit: int  # see `choices.Credit`
    activity: np.float32  # what a step leaves of the activity of an event
    terminal: bool
    trace: int
    memory_fade: np.float32  # what a change of cell, or a step, leaves of what is remembered; 0 without memory
    memory_by_time: bool
    memory_discounts: bool
    bootstrap: bool
    own_causes: bool
    capture: int  # see `choices.Capture`
    attention: int  # see `choices.Attention`
    exploration: float
    indifferent_is_no_op: bool


class Memory(NamedTuple):
    """All that changes in an agent."""

    q: array("float32", "values")  # q[state, action, goal] of one map after the other
    known: array("int64", "cells", 2)  # of all maps: the goals, from and to, that a cell may know anything of
    cell: array("int64", "tracks")  # the active cell
    events: array("int64", "tracks", 5)  # steps on which each action was taken since the cell was entered
    last_event: array("int64", 1)
    trace_cell: array("int64", "tracks", "trace")  # cells left, a ring
    trace_rates: array("float32", "tracks", "trace", 4)  # the rates of their events
    trace_count: array("int64", "tracks")  # cells left since the point appeared
    remembered: array("int64", "traces")  # the cells that a track remembers, see `neorl.core.traces`
    remembered_at: array("int64", "traces")
    remembered_count: array("int64", "tracks")
    strength: array("float32", "traces")
    trace_weight: array("float32", "trace_rows")
    trace_worth: array("float32", "trace_rows")
    activity: array("float32", 4)  # of each event
    seen: array("float64", "creeps", 2)  # where the things were after the last step, in pixels
    attended: array("int64", 1)  # which of them is learned about
    target: array("float32", "cells")  # working memory
    # as of the last choice that was not drawn
    pull: array("float64", "desires", 4)  # what each desire adds to the value of each action in its node
    landing: array("float64", "desires", 3)  # where a node's desire lands, seen from the agent, and with what valence
    worth: array("float64", "desires")  # its valence, all its elements together
    value: array("float64", 4)  # of each action
    stream: array("uint64", 4)  # the random numbers of the policy


@kernel
def lay_out(plan: Plan, n_creeps: int) -> None:
    """Fill in the fields of a plan that follow from the chosen ones."""
    for n in range(plan.vector.shape[0]):
        points = 1
        if plan.vector[n] == OBJECTS:
            points = n_creeps
        elif plan.vector[n] == BOUNDARIES:
            points = 4
        elif plan.vector[n] == LANDMARKS:
            points = plan.first_landmark[n + 1] - plan.first_landmark[n]
        plan.points[n] = points
        total = 0.0
        for m in range(plan.first_map[n], plan.first_map[n + 1]):
            tiles = tiling(plan.resolution[m], plan.tuning[n], plan.low[n, 0], plan.high[n, 0], plan.low[n, 1],
                           plan.high[n, 1])
            cells = tiles[0] * tiles[1]
            plan.columns[m], plan.rows[m], plan.low_u[m], plan.scale_u[m] = tiles[0], tiles[1], tiles[2], tiles[3]
            plan.low_v[m], plan.scale_v[m], plan.closed[m] = tiles[4], tiles[5], tiles[6]
            plan.cells[m] = cells
            plan.contact[m] = cell_at(0.0, 0.0, *tiles)
            plan.weight[m] = 1.0
            for _ in range(plan.weighting[n]):
                plan.weight[m] *= plan.resolution[m]
            total += plan.weight[m]
            plan.first[m + 1] = plan.first[m] + N_EVENTS * cells * cells
            plan.first_cell[m + 1] = plan.first_cell[m] + cells
            plan.first_track[m + 1] = plan.first_track[m] + points
            plan.first_trace[m + 1] = plan.first_trace[m] + points * cells
            for e in range(plan.source.shape[0]):
                if plan.source[e] == Source.point and plan.target[e] == n:
                    plan.goal[e, m] = cell_at(plan.at[e, 0], plan.at[e, 1], *tiles)
        for m in range(plan.first_map[n], plan.first_map[n + 1]):
            plan.weight[m] /= total
        end = plan.first_input[n]
        for e in range(plan.target.shape[0]):
            if plan.target[e] == n:
                plan.inputs[end] = e
                end += 1
        plan.first_input[n + 1] = end


def new_memory(plan, stream, n_creeps, old=None):
    """The `Memory` of an agent that has learned nothing, in a tank of so many creeps.

    old: a memory of the same plan that nobody needs any more, whose room for values is used again: to get a gigabyte
    from the system, page by page, takes longer than to live in it.
    """
    traces = plan.first_trace[-1] if plan.memory_fade > 0 else 0
    sizes = {"values": 0 if old else plan.first[-1], "cells": plan.first_cell[-1], "tracks": plan.first_track[-1],
             "trace": plan.trace, "traces": traces, "trace_rows": N_ROWS * traces, "desires": len(plan.source),
             "creeps": n_creeps}
    memory = Memory(**zeros(Memory, sizes) | {"stream": stream})
    if old:
        forget(plan, old)
        memory = memory._replace(q=old.q)
    know_nothing(plan, memory)
    return memory


@kernel
def forget(plan: Plan, memory: Memory) -> None:
    """Set all values to zero that are not."""
    for m in range(plan.cells.shape[0]):
        cells = plan.cells[m]
        for cell in range(cells):
            begin, end = memory.known[plan.first_cell[m] + cell, 0], memory.known[plan.first_cell[m] + cell, 1]
            for event in range(N_EVENTS):
                row = plan.first[m] + (cell * N_EVENTS + event) * cells
                for goal in range(begin, end):
                    memory.q[row + goal] = 0.0


@kernel
def know_nothing(plan: Plan, memory: Memory) -> None:
    """Let no cell know of any goal."""
    for m in range(plan.cells.shape[0]):
        for cell in range(plan.first_cell[m], plan.first_cell[m + 1]):
            memory.known[cell, 0], memory.known[cell, 1] = plan.cells[m], 0
