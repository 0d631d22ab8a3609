"""An agent as one record, its parameters and its small state, and its `Memory`, a few flat arrays of what has no bound.

A kernel takes the record as one pointer, and knows every offset in it when it is compiled; so it is compiled for a
number of actions and of axes, and for the rows of the tables (`rows_for`), which small agents share. Rows are in the
order of the agent's nodes, and desires in the agent's. ``first_…`` is where a part of a table or of an array begins,
``end_…`` where it ends. A *track* is one point that a map follows: the agent itself, or one of the things that its
modality represents. All tracks of a map share its values.

What is *derived* is filled in by `neorl.core.derived`, everything before it by `neorl.agents.embodiment`. What is
*state* goes on when the agent changes, in a copy and in a file (`neorl.agents.keeping`): of the record, the fields
`of_desire` and `of_agent`; of the memory, the arrays that are `kept`, each of which has a part for every map.
"""

import functools
from enum import Enum
from typing import Annotated, NamedTuple

import numpy as np

from neorl.kernels.annotations import Record as Record
from neorl.kernels.annotations import array, marks, tabled

INT, REAL, SINGLE, FLAG = np.int64, np.float64, np.float32, np.bool_
INDEX = np.uint64  # never negative: an index that might be would have to be tested
FEWEST_ROWS, MORE = 32, 16
OF_AXIS, OF_CREDIT = range(2)  # places in `faults`
ENTRIES = 3  # values of an action in a cell of a map of contacts, see `neorl.core.contacts`


def rows_for(count):
    """The rows of an agent's tables, of which the longest has `count`: 32, 512, 8,192 …"""
    rows = FEWEST_ROWS
    while rows < count:
        rows *= MORE
    return rows


def record_of(*fields):
    """The dtype of a record that compiled code and NumPy lay out alike."""
    return np.dtype(list(fields), align=True)


NODE = record_of(
    ("follows", INT),  # see `choices.Vector`: the one in which an element has a place
    ("state", INT),  # see `choices.MapState`
    ("ends", FLAG),  # whether no cell represents what lies beyond the range of its maps
    ("reach", REAL),  # half the side of the square around the self that counts as contact
    ("weighting", INT),  # see `choices.Weighting`
    ("gain", REAL),
    ("first_map", INDEX), ("end_map", INDEX), ("first_axis", INDEX), ("axes", INDEX),
    ("first_landmark", INT), ("landmarks", INT),
    ("learns_contacts", FLAG),  # see `neorl.core.contacts`
    ("mirrored", FLAG),
    # derived
    ("points", INT),  # number of points that it follows
    ("is_cartesian", FLAG),  # whether its coordinates are the components of the vector it follows
    ("first_input", INT), ("end_input", INT),  # its desires in `inputs`
    ("receives", FLAG))  # whether any of them comes from a node
MAP = record_of(
    ("node", INT), ("resolution", INT),
    # derived
    ("cells", INT),
    ("placed", INT),  # number of cells along the axes on which a contact determines the place
    ("events", INT),  # that a cell has values for: all actions, or 1 if it is of after-states
    ("goals", INT),  # that a cell has values for: all cells, or 1 if a cell is itself a goal
    ("contact", INT),  # the first cell at distance 0
    ("followed", INT),  # number of cells along the axes of the vector that the node follows
    ("weight", REAL),
    ("first_cut", INDEX), ("first_value", INT), ("end_value", INT), ("first_track", INT), ("end_track", INT),
    ("first_cell", INT), ("end_cell", INT),  # none of a map of contacts, whose cells have no range of goals
    ("first_trace", INT), ("end_trace", INT),  # its tracks' memory, which holds all cells
    ("passed", INT),  # the most places that a track of the self remembers
    ("first_passed", INT), ("end_passed", INT))  # its tracks' passed places
AXIS = record_of(
    ("vector", INT), ("feature", INT),  # see `choices`
    ("along", INT),  # the axis of the world, or the number of a user-defined feature
    ("cut", INT),  # see `choices.Cut`
    ("intervals", INT),  # its own number of intervals, or 0 for the resolution of the map
    ("low", REAL), ("high", REAL),
    ("first_boundary", INDEX), ("end_boundary", INDEX))  # between unequal intervals
CUT = record_of(  # how a map cuts an axis
    ("low", REAL),  # where the first interval begins
    ("scale", REAL),  # intervals per unit
    ("last", REAL),  # the number of the last interval
    ("beyond", REAL),  # of the interval beyond the range: the last, or the first if the axis closes
    ("stride", REAL))  # the step in cell number per interval
TRACK = record_of(
    ("cell", INT),  # the active cell, or ABSENT
    ("remembered", INT),  # number of cells in its memory
    ("passed", INT),  # number of places passed since it started
    ("frame", INT),  # the mirror image in which the active cell is seen
    ("left", INT))  # number of cells left since it started
LEARNING = record_of(  # see `neorl.agents.rules.Learning`
    ("learning_rate", SINGLE), ("discount", SINGLE), ("absent_decay", SINGLE),
    ("away", FLAG),  # whether the value of an absent event sinks away from the target
    ("update_on", INT), ("credit", INT),  # see `choices`
    ("activity_retained", SINGLE),  # share of an event's activity that a step retains
    ("terminal", FLAG),
    ("memory_retained", SINGLE),  # share that a change of cell retains; 0 without memory
    ("bootstrap", FLAG))
CONTACTS = record_of(  # see `neorl.agents.rules.Contacts`
    ("discount", REAL),  # per step
    ("learning_rate", REAL), ("familiarity", REAL), ("first_value", REAL),
    ("trace", INT),  # steps back over which a contact is credited
    ("trace_rate", REAL), ("caution", REAL), ("flees", FLAG), ("rivals", REAL), ("efference", REAL),
    ("after_states", INT),  # that a track follows: one for each action, or 0 if values are of actions
    ("lookahead", INT), ("step", REAL))  # steps of coasting; seconds of one
POLICY = record_of(  # see `neorl.agents.rules.Policy`
    ("exploration", REAL), ("indifferent_is_no_op", FLAG),
    ("is_greedy", FLAG),  # the usual policy, which is compiled into the kernels instead of being called
    ("last", INT))  # the highest number that may be chosen: that of idleness, if the agent can be idle


def of_desire(actions=1, axes=1):
    """The state of a desire, at the last choice that was not random: fields of a record."""
    return (
        ("q", REAL, actions),  # the contribution to the action values of its node
        ("target_at", REAL, axes),  # where a node's desire lands relative to the agent
        ("target_valence", REAL), ("total_valence", REAL),  # of all its elements together
        ("worth", REAL),  # of one of them; constant unless it is learned
        ("meetings", INT))  # from which the worth was learned


def of_agent(actions=1):
    """The state of an agent besides: fields of its record."""
    return (
        ("last_event", INT), ("reward", REAL),  # of the last step
        ("activity", SINGLE, actions),  # of each event
        ("action_value", REAL, actions),  # at the last choice that was not random
        ("stream", INDEX, 4),  # the random numbers of the policy
        ("evaluation", INT),  # the number of evaluations of desires
        ("learns", FLAG))


@functools.cache
def agent_type(actions, axes, rows):
    """The dtype of the record of an agent in a world of so many actions and axes, with so many rows in its tables."""
    desire = record_of(
        ("source", INT),  # see `choices.Source`
        ("kind", INT),  # of the things that it is for
        ("target", INT),  # the node
        ("valence", REAL), ("learned", FLAG),  # whether the valence is only the initial one
        ("sums_valence", FLAG),  # whether the valence is the sum of its elements' instead
        ("scale", REAL), ("signed", FLAG),
        ("first_element", INT), ("end_element", INT),  # the desires of its source that its vector comes from
        ("place", REAL, axes),
        ("first_coordinate", INT),  # in `Memory.points`, of a point
        ("first_goal", INT),  # derived: in `Memory.goals`, its cell in each map of the node
        ("worth_of", INT),  # derived: the desire whose worth it has, the first that learns that of its kind, or itself
        *of_desire(actions, axes))
    return record_of(
        ("nodes", NODE, rows), ("maps", MAP, rows), ("axes", AXIS, rows), ("desires", desire, rows),
        ("n_nodes", INT), ("n_maps", INT), ("n_axes", INT), ("n_desires", INT),
        ("order", INT, rows),  # nodes, each after those whose desires it receives
        ("inputs", INT, rows),  # desires, node by node; derived
        ("size", REAL),  # of the world, in its own units of length
        ("own_cell_counts", FLAG), ("shared_cell_counts_once", FLAG), ("notices_resets", FLAG),
        ("push", REAL, (actions, axes)),  # of each action that is an event
        ("learning", LEARNING), ("contacts", CONTACTS), ("policy", POLICY),
        *of_agent(actions),
        ("faults", INT, 2),  # 1 + the number of a user-defined axis, and 1 for the credit rule, that has returned NaN
        # working memory
        ("rates", SINGLE, actions),  # of the events in the cell that a track leaves
        ("here", REAL, axes),  # where the agent is, in units of the world's size
        ("efferent", REAL, axes),  # what the pushes in question add to its velocity, in the same units
        ("ahead", REAL, axes),  # how far it would move until the moment in question
        ("offset", REAL, rows), ("coordinates", REAL, rows),  # of an element of interest from the agent; of a point
        ("seen", INT, rows),  # the cells of a point, for each map
        ("rival", REAL, actions), ("favourite", REAL, actions))  # what a thing, and the best, adds to action values


class Keeping(Enum):
    """What becomes of an array of `Memory` as the agent changes, and in a file."""

    values = "kept with the map"  # also where its tracks begin afresh
    tracks = "kept with the map and its kind of memory"
    places = "the same, of indices in q"
    working = "0, or written before it is read"
    derived = "made of the agent and its world"


def kept(keeping, dtype, *shape):
    """The annotation of an array, and its `Keeping`."""
    return Annotated[array(dtype, *shape), keeping]


VALUES, TRACKS, PLACES, WORKING, DERIVED = Keeping


@tabled
class Memory(NamedTuple):
    """What of an agent grows with its cells, or has no bound: its values, tracks and traces, map after map."""

    q: kept(VALUES, "float32", "values")  # see `learning.Order`
    goal_range: kept(VALUES, "int64", "cells", 2)  # for each cell, the range of goals whose values may differ from 0
    counted: kept(WORKING, "int64", "cells")  # the last evaluation in which an element in the cell has counted
    scratch: kept(WORKING, "float32", "scratch")
    tracks: kept(TRACKS, TRACK, "tracks")
    events: kept(TRACKS, "int64", "tracks", "actions + 1")  # steps in the cell with each action, idleness last
    remembered: kept(TRACKS, "int64", "traces")  # the fields of a `learning.Trace`, one track after the other
    remembered_at: kept(TRACKS, "int64", "traces")
    strength: kept(TRACKS, "float32", "traces")
    trace_weight: kept(TRACKS, "float32", "trace_weights")
    trace_worth: kept(TRACKS, "float32", "trace_weights")
    passed_at: kept(TRACKS, "float64", "passed", "axes")  # where the self has left a cell, a ring buffer for each track
    passed_rates: kept(TRACKS, "float32", "passed", "actions")  # the rates of the events until it left the next
    seen_from: kept(WORKING, "float64", "passed")  # the cell of the self as seen from each place passed
    after: kept(TRACKS, "int64", "tracks", "after_states")  # the cell that each action leads to at once
    left: kept(PLACES, "int64", "tracks", "left")  # of the actions taken last, a ring buffer for each track
    cuts: kept(DERIVED, CUT, "cuts")  # of each map along each axis of its node
    points: kept(DERIVED, "float64", "coordinates")  # of the desires for points
    goals: kept(DERIVED, "int64", "goals")  # their cells
    elements: kept(DERIVED, "int64", "elements")  # desires
    boundary: kept(DERIVED, "float64", "boundaries")
    landmark: kept(DERIVED, "float64", "landmarks", "axes")
    frames: kept(DERIVED, "int64", "frames", "actions")  # what each action becomes in each mirror image of the world


KEEPING = marks(Memory)
PART_OF = {"values": "value", "cells": "cell", "tracks": "track", "traces": "trace", "trace_weights": "trace",
           "passed": "passed"}  # of a map, which begins at ``first_…`` and ends at ``end_…``, by the first dimension
