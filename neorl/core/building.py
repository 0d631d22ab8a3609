"""An agent's record and memory, from its choices: {name: value, or {name: column of a table}}.

The choices are those of `neorl.agents.compile.chosen`, in which lists of different lengths follow one another, with the
places where each begins, and where the last ends; ``engine.js`` does the same in a page.
"""

import numpy as np

from neorl.core.calls import interpret
from neorl.core.choices import Source
from neorl.core.derived import begin_values, derive
from neorl.core.kernel import fields, kernel, new_tuple
from neorl.core.learning import order_of, place_of, values_of
from neorl.core.record import Memory, Record, agent_type, rows_for

TABLES = ("nodes", "maps", "axes", "desires")
WITHOUT_VALUES = ("cuts", "points", "goals", "elements", "boundary", "landmark", "frames")
OF_AN_AXIS = ("vector", "feature", "along", "cut", "intervals")  # the columns of choices["axes"]["what"]


def new_agent(choices, n_things):
    """The record of an agent in a world of `n_things` things, and its `Memory` as yet without values."""
    agent, memory = laid_out(choices)
    interpret(derive, agent, memory, n_things)
    return agent, memory


def laid_out(choices):
    """The same, before anything is derived."""
    nodes, axes, desires, push = (choices[name] for name in ("nodes", "axes", "desires", "push"))
    first_map, first_axis = nodes["first_map"], nodes["first_axis"]
    source, target = desires["source"], desires["target"]
    elements = [np.flatnonzero(row) for row in desires["elements"]]
    coordinates = (source == Source.point) * np.diff(first_axis)[target]
    goals = (source == Source.point) * np.diff(first_map)[target]
    tables = {
        "nodes": nodes | begins_and_ends("map", first_map) | {
            "first_axis": first_axis[:-1], "axes": np.diff(first_axis),
            "first_landmark": nodes["first_landmark"][:-1], "landmarks": np.diff(nodes["first_landmark"])},
        "maps": choices["maps"] | {"node": np.repeat(np.arange(len(nodes["follows"])), np.diff(first_map))},
        "axes": axes | begins_and_ends("boundary", axes["first_boundary"]) | dict(zip(OF_AN_AXIS, axes["what"].T)),
        "desires": desires | begins_and_ends("element", firsts(map(len, elements))) | {
            "place": desires["at"][:, : push.shape[1]], "first_coordinate": firsts(coordinates)[:-1],
            "first_goal": firsts(goals)[:-1]}}
    counts = [len(nodes["follows"]), first_map[-1], first_axis[-1], len(source)]
    agent = np.zeros((), agent_type(*push.shape, rows_for(max(counts))))
    for table, count in zip(TABLES, counts):
        agent["n_" + table] = count
        fill(agent[table][:count], tables[table])
    agent["order"][: counts[0]] = nodes["order"]
    fill(agent, {name: value for name, value in choices.items() if name not in TABLES})
    sizes = {"goals": goals.sum(), "cuts": (np.diff(first_map) * np.diff(first_axis)).sum()}
    return agent, new_memory(sizes | dict(zip(("actions", "axes"), push.shape)), {
        "points": np.array([x for row, n in zip(desires["at"], coordinates) for x in row[:n]], float),
        "elements": np.concatenate([np.zeros(0, np.int64), *elements]), "frames": choices["frames"],
        "boundary": axes["boundary"], "landmark": nodes["landmark"]})


def with_values(agent, memory, q=None):
    """The same memory with all that the agent learns, untrained. q: zeros to be used, as many as its values or more."""
    last, (actions, axes) = agent["maps"][agent["n_maps"] - 1], agent["push"].shape
    sizes = {"values": last["end_value"], "cells": last["end_cell"], "scratch": actions * last["end_cell"],
             "tracks": last["end_track"], "traces": last["end_trace"], "trace_weights": 2 * actions * last["end_trace"],
             "passed": last["end_passed"], "left": agent["contacts"]["trace"], "actions": actions, "axes": axes}
    known = {name: getattr(memory, name) for name in WITHOUT_VALUES}
    memory = new_memory(sizes, known if q is None else known | {"q": q[: last["end_value"]]})
    interpret(begin_values, agent, memory)
    return memory


def new_memory(sizes, arrays):
    """A `Memory` of arrays and of sizes, which are otherwise 0."""
    names = {size.partition(" + ")[0] for _, shape in fields(Memory).values() for size in shape if size != 2}
    return new_tuple(Memory, dict.fromkeys(names, 0) | sizes, arrays)


def fill(record, columns):
    """Write the columns of a table, or the values of a record, that have the names of its fields."""
    for name in record.dtype.names:
        if isinstance(columns.get(name), dict):
            fill(record[name], columns[name])
        elif name in columns:
            record[name] = columns[name]


def begins_and_ends(name, begins):
    """The columns of where each of several lists begins and ends. begins: also where the last one ends."""
    return {f"first_{name}": begins[:-1], f"end_{name}": begins[1:]}


def firsts(counts):
    """The start of each of several lists of given lengths, one after the other, and the end of the last: int64."""
    return np.concatenate([[0], np.cumsum(np.array(list(counts), np.int64))]).astype(np.int64)


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
