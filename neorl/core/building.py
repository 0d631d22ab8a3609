"""An agent's record and memory, from its choices, which are those of `neorl.agents.embodiment.choices_in`.

They have a dict for each node, with its axes, and for each desire: rows of the record's tables. Lists of different
lengths in them become parts of one array, and the rows tell where each begins. ``engine.js`` does the same in a page,
by the tables below.
"""

import functools
import math

import numpy as np

from neorl.core.choices import Cut, Feature, MapState, Vector
from neorl.core.derived import begin_values, derive
from neorl.core.layout import DERIVED, KEEPING, Memory, Record, agent_type, rows_for
from neorl.core.learning import order_of, place_of, values_of
from neorl.kernels.annotations import fields, length, new_tuple
from neorl.kernels.execution import in_table, interpret
from neorl.kernels.kernel import kernel

TABLES = ("nodes", "maps", "axes", "desires")
# Lists in the rows of a table, by the name of one entry: ``first_…`` is where the row's begins among those of all rows.
LISTS = {"nodes": {"map": "resolutions", "axis": "axes", "landmark": "landmarks"}, "axes": {"boundary": "boundaries"},
         "desires": {"element": "elements", "coordinate": "point", "goal": "goals"}}
# Arrays of `Memory` that are such lists one after the other: of all rows of a table, or of the choices themselves.
JOINED = {"points": ("desires", "point"), "elements": ("desires", "elements"), "boundary": ("axes", "boundaries"),
          "landmark": ("nodes", "landmarks"), "frames": ("choices", "frames")}
# The sizes of what an agent learns and remembers, as products: of numbers of actions, of where the parts of its last
# map end, and of the trace and the after-states of contacts.
SIZES = {"values": ("end_value",), "cells": ("end_cell",), "scratch": ("actions", "end_cell"), "tracks": ("end_track",),
         "traces": ("end_trace",), "trace_weights": (2, "actions", "end_trace"), "passed": ("end_passed",),
         "after_states": ("after_states",), "left": ("trace",)}
WITHOUT_VALUES = tuple(name for name, keeping in KEEPING.items() if keeping is DERIVED)


def new_agent(choices, n_things):
    """The record of an agent in a world of `n_things` things, and its `Memory` as yet without values."""
    agent, memory = laid_out(choices)
    interpret(derive, agent, memory, n_things)
    return agent, memory


def laid_out(choices):
    """The same, before anything is derived."""
    nodes, push = choices["nodes"], choices["push"]
    tables = {
        "nodes": nodes, "axes": [axis for node in nodes for axis in node["axes"]],
        "maps": [{"resolution": resolution, "node": n} for n, node in enumerate(nodes)
                 for resolution in node["resolutions"]],
        "desires": [desire | {"goals": nodes[desire["target"]]["resolutions"] if desire["point"] else ()}
                    for desire in choices["desires"]]}
    agent = np.zeros((), agent_type(*push.shape, rows_for(max(map(len, tables.values())))))
    for name, rows in tables.items():
        agent["n_" + name] = len(rows)
        for record, row in zip(agent[name], with_places(rows, LISTS.get(name, {}))):
            fill(record, row)
    agent["order"][: len(nodes)] = choices["order"]
    fill(agent, {name: value for name, value in choices.items() if name not in (*TABLES, "order")})
    sizes = dict(zip(("actions", "axes"), push.shape)) | {
        "goals": sum(len(desire["goals"]) for desire in tables["desires"]),
        "cuts": sum(len(node["resolutions"]) * len(node["axes"]) for node in nodes)}
    lists = {name: [row[several] for row in (tables | {"choices": [choices]})[table]]
             for name, (table, several) in JOINED.items()}
    return agent, new_memory(sizes, {name: joined(name, each, sizes) for name, each in lists.items()})


def n_values(agent):
    """The number of values that an agent learns, by its record; in Python's integers, since it may be beyond int64."""
    maps = agent["maps"][: agent["n_maps"]]
    return sum(map(math.prod, zip(*(maps[name].tolist() for name in ("events", "cells", "goals")))))


def sizes_of(agent):
    """The sizes of all that an agent learns and remembers in its `Memory`, by name, from its record."""
    last, (actions, axes) = agent["maps"][agent["n_maps"] - 1], agent["push"].shape
    factors = dict(zip(last.dtype.names, last.item())) | {"actions": actions} | {
        name: int(agent["contacts"][name]) for name in ("trace", "after_states")}
    sizes = {name: math.prod(factors.get(each, each) for each in product) for name, product in SIZES.items()}
    return sizes | {"values": n_values(agent), "actions": actions, "axes": axes}


def n_bytes(agent):
    """The bytes that an agent needs for all that it learns and remembers, from its record."""
    sizes = sizes_of(agent)
    return sum(np.dtype(dtype).itemsize * math.prod(int(length(dimension, sizes)) for dimension in shape)
               for name, (dtype, shape) in fields(Memory).items() if name not in WITHOUT_VALUES)


def with_values(agent, memory, q=None):
    """The same memory with all that the agent learns, untrained. q: zeros to be used, as many as its values or more."""
    sizes, known = sizes_of(agent), {name: getattr(memory, name) for name in WITHOUT_VALUES}
    memory = new_memory(sizes, known if q is None else known | {"q": q[: sizes["values"]]})
    interpret(begin_values, agent, memory)
    return memory


def new_memory(sizes, arrays):
    """A `Memory` of arrays and of sizes, which are otherwise 0."""
    names = {size.partition(" + ")[0] for _, shape in fields(Memory).values() for size in shape if size != 2}
    return new_tuple(Memory, dict.fromkeys(names, 0) | sizes, arrays)


def fill(record, values):
    """Write the values that have the names of a record's fields into them."""
    for name in record.dtype.names:
        if isinstance(values.get(name), dict):
            fill(record[name], values[name])
        elif name in values:
            record[name] = values[name]


def with_places(rows, names):
    """Rows of a table with the length in place of each list, and where it begins and ends among those of all rows.

    names: of the lists, by that of one entry, as in `LISTS`.
    """
    begins = {one: np.cumsum([0, *(len(row[several]) for row in rows)]) for one, several in names.items()}
    return [row | {several: len(row[several]) for several in names.values()}
            | {f"first_{one}": begins[one][r] for one in names} | {f"end_{one}": begins[one][r + 1] for one in names}
            for r, row in enumerate(rows)]


def joined(name, lists, sizes):
    """An array of `Memory`: lists one after the other."""
    dtype, (_, *each) = fields(Memory)[name]
    return np.array([value for values in lists for value in values], dtype).reshape(-1, *(sizes[size] for size in each))


@functools.lru_cache(maxsize=64)
def space_of(modality, resolution, n_axes=None, size=1.0):
    """The record of an agent of a single map, and its memory as `execute` passes it on; kept for loops of points."""
    n_axes, (node,) = n_axes or modality.least_axes, choices_of([modality])
    agent, memory = new_agent({
        "nodes": [node | {"resolutions": [resolution]}], "order": [0], "desires": [], "size": size,
        "push": np.zeros((1, n_axes)), "frames": np.zeros((0, 1), np.int64)}, 0)
    return agent, in_table(memory)


def choices_of(modalities):
    """The choices of all nodes that depend on their modalities, a list of dicts.

    The others among them are those of `Node()`: a map never ends, and its state is the object.
    """
    own = [axis for modality in modalities for axis in modality.axes if callable(axis.of)]
    return [{"follows": Vector[modality.follows], "mirrored": modality.mirrored, "state": MapState.object,
             "ends": False, "reach": 0.0, "landmarks": modality.landmarks,
             "axes": [_choices_of_axis(axis, own) for axis in modality.axes]} for modality in modalities]


def _choices_of_axis(axis, own):
    """The choices of an axis. own: the axes with user-defined kernels."""
    cut = (Cut.boundaries if axis.boundaries else Cut.closed if axis.closed and not axis.is_direction else
           Cut.centred if axis.centred else Cut.equal)
    vector, along = (Vector.own, own.index(axis)) if callable(axis.of) else (Vector[axis.of], axis.along)
    return {"vector": vector, "feature": Feature[axis.feature], "along": along, "cut": cut,
            "intervals": axis.intervals or 0, "low": axis.low, "high": axis.high, "boundaries": axis.boundaries[1:-1]}


@kernel
def clear_q(agent: Record, memory: Memory) -> None:
    """Reset all values to zero that are not."""
    for m in range(agent.n_maps):
        nres = agent.maps[m]
        if agent.nodes[nres.node].learns_contacts:
            for i in range(nres.first_value, nres.end_value):
                memory.q[i] = 0.0
            continue
        values, order = values_of(agent, memory, nres), order_of(agent, nres)
        for row in range(nres.cells):
            for column in range(nres.cells):  # side by side
                cell, goal = (column, row) if order.action == 1 else (row, column)
                if values.goal_range[cell, 0] <= goal < values.goal_range[cell, 1]:
                    for event in range(values.actions):
                        values.q[place_of(values.first, order, cell, goal) + np.uint64(event) * order.action] = 0.0
