"""The state of an agent, as flat arrays for the kernels: its values, tracks, desires and policy."""

from typing import NamedTuple

import numpy as np

from neorl.core.calls import execute, interpret, tabled
from neorl.core.kernel import array, kernel, new_tuple
from neorl.core.learning import order_of, place_of, values_of
from neorl.core.parameters import ENTRIES, Parameters


class ValueState(NamedTuple):
    """The values of all maps, one map after the other. See `learning.MapValues` for one map's."""

    q: array("float32", "values")  # see `learning.Order`
    goal_range: array("int64", "cells", 2)
    scratch: array("float32", "scratch")


class TrackState(NamedTuple):
    """The tracks of all maps, one map after the other."""

    cell: array("int64", "tracks")  # the active cell, or ABSENT
    events: array("int64", "tracks", "actions + 1")  # steps in the cell on which each action was taken, idleness last
    passed_at: array("float64", "passed", "axes")  # where the self has left a cell, a ring buffer for each track
    passed_rates: array("float32", "passed", "actions")  # the rates of the events until it left the next
    passed_count: array("int64", "tracks")  # since the track started
    remembered: array("int64", "traces")  # the fields of a `learning.Trace`, one track after the other
    remembered_at: array("int64", "traces")
    remembered_count: array("int64", "tracks")
    strength: array("float32", "traces")
    trace_weight: array("float32", "trace_weights")
    trace_worth: array("float32", "trace_weights")


class ContactState(NamedTuple):
    """What the tracks of maps of contacts have in addition."""

    frame: array("int64", "tracks")  # the mirror image in which the active cell is seen
    left: array("int64", "tracks", "left")  # indices in q of the actions taken last, a ring buffer
    count: array("int64", "tracks")  # of them, since the track started


class DesireState(NamedTuple):
    """The desires at the last choice that was not random."""

    q: array("float64", "desires", "actions")  # the contribution of each to the action values of its node
    target: array("float64", "desires", "axes + 1")  # where a node's desire lands relative to the agent; valence
    valence: array("float64", "desires")  # of all its elements together
    worth: array("float64", "desires")  # of one of them; constant unless it is learned
    meetings: array("int64", "desires")  # from which the worth was learned


@tabled
class State(NamedTuple):
    """The state of an agent."""

    values: ValueState
    tracks: TrackState
    contacts: ContactState
    desires: DesireState
    last_event: array("int64", 1)
    activity: array("float32", "actions")  # of each event
    rates: array("float32", "actions")  # working memory: of the events in the cell that a track leaves
    reward: array("float64", 1)  # of the last step
    faults: array("int64", 2)  # 1 + the number of a user-defined axis, and 1 for the credit rule, that has returned NaN
    action_value: array("float64", "actions")  # at the last choice that was not random
    stream: array("uint64", 4)  # the random numbers of the policy
    here: array("float64", "axes")  # working memory: where the agent is, in units of the world's size
    coordinates: array("float64", "coordinates")  # working memory: of the point being located
    offset: array("float64", "axes")  # working memory: of an element of interest from the agent
    counted: array("int64", "cells")  # working memory: the last evaluation in which an element in the cell has counted
    evaluation: array("int64", 1)  # working memory: the number of evaluations of desires for kinds of things
    seen: array("int64", "maps")  # working memory: the cells of a point
    seen_from: array("float64", "passed")  # working memory: the cell of the self as seen from each place passed
    rival: array("float64", "actions")  # working memory: a thing's contribution to the action values
    favourite: array("float64", "actions")  # working memory: that of the best of all things


def new_state(parameters, stream, n_things, old=None):
    """The initial `State` of an agent in a world of `n_things` things.

    old: the parameters and the state of an agent no longer needed, with at least as many values, whose memory is
    reused: getting a gigabyte from the system, page by page, takes longer than a run.
    """
    maps, (actions, axes) = parameters.maps, parameters.push.shape
    traces = maps.first_trace[-1]
    sizes = {"values": maps.first_value[-1], "cells": maps.first_cell[-1], "tracks": maps.first_track[-1],
             "scratch": actions * maps.first_cell[-1],
             "traces": traces, "trace_weights": 2 * actions * traces, "passed": maps.first_passed[-1],
             "desires": len(parameters.desires.source), "actions": actions, "axes": axes,
             "coordinates": parameters.desires.at.shape[1], "maps": len(maps.cells),
             "left": parameters.contacts.trace}
    values = {}
    if old:
        execute(clear_q, *old)
        values["q"] = old[1].values.q[: sizes["values"]]
    state = new_tuple(State, sizes, {"stream": stream, "values": values})
    interpret(begin_values, parameters, state)
    return state


@kernel
def clear_q(parameters: Parameters, state: State) -> None:
    """Reset all non-zero values to zero."""
    maps, nodes = parameters.maps, parameters.nodes
    for n in range(nodes.follows.shape[0]):
        for m in range(nodes.first_map[n], nodes.first_map[n + 1]):
            values, order = values_of(parameters, state, m), order_of(parameters, m)
            if nodes.learns_contacts[n]:
                for i in range(values.first, maps.first_value[m + 1]):
                    values.q[i] = 0.0
                continue
            for row in range(maps.cells[m]):
                for column in range(maps.cells[m]):  # side by side
                    cell, goal = (column, row) if order.action == 1 else (row, column)
                    if values.goal_range[cell, 0] <= goal < values.goal_range[cell, 1]:
                        for event in range(values.actions):
                            values.q[place_of(values, order, cell, goal) + np.uint64(event) * order.action] = 0.0


@kernel
def begin_values(parameters: Parameters, state: State) -> None:
    """Set the goal ranges to empty, the approach of contacts to its first value, and worths to the chosen valences.

    All values of the state must be zero.
    """
    maps, nodes = parameters.maps, parameters.nodes
    for n in range(nodes.follows.shape[0]):
        for m in range(nodes.first_map[n], nodes.first_map[n + 1]):
            state.values.goal_range[maps.first_cell[m] : maps.first_cell[m + 1], 0] = maps.cells[m]
            state.values.goal_range[maps.first_cell[m] : maps.first_cell[m + 1], 1] = 0
            if nodes.learns_contacts[n]:
                first_value = np.float32(parameters.contacts.first_value)
                state.values.q[maps.first_value[m] : maps.first_value[m + 1] : ENTRIES] = first_value
    for e in range(parameters.desires.valence.shape[0]):
        state.desires.worth[e] = parameters.desires.valence[e]
