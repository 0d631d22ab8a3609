"""Nodes whose only goals are contacts: how they learn, and how they value actions among things. Beyond the thesis.

The maps of such a node hold no value for each goal cell. For each action in a cell they hold two general value
functions, discounted by time and learned off-policy, the same for every thing, whatever its worth:

- *approach*, the value of a contact to an agent that seeks one: max over the next actions (eq. 4.6);
- *fear*, its value to an agent that would flee: min over the next actions. It stays near 0 while there is a way out.

1. After every step, the two values of the action taken move towards the value of the cell entered, or 1 for a contact,
   at the rate (n + 2)^(−3/4) after n visits, or at the learning rate if that is higher.
2. The maps of a node learn together, coarsest first. The value of an action is that of the coarsest map, which each
   finer map in turn moves towards its own by the fraction n / (n + familiarity). All maps bootstrap from this value,
   and an action that a finer map has not seen yet starts from it.
3. A contact is credited backwards: if the approach of an action on the way to it is below the value that the contact
   had at that step, it moves there at the trace rate; none is lowered (section 4.1.3: occurrence affects learning
   positively).
4. Cells may be *mirrored*, that is, invariant under reflections along the axes of the world and exchanges of two axes.
   The actions of a cell are then those of the mirrored world. Each mirror image is called a *frame*.
5. Of all things of positive worth, only the one whose approach is worth most counts. Fears add up.

`scene` is what the agent perceives of its world (`neorl.core.scene.Scene`).
"""

import math

import numpy as np

from neorl.core.choices import Source
from neorl.core.geometry import cell_of, locate, maps_of
from neorl.core.kernel import inlined_kernel, kernel
from neorl.core.parameters import ENTRIES
from neorl.core.scene import ABSENT

APPROACH, FEAR, VISITS = range(3)
MOST_VISITS = 1e6  # counted at most; a count is a float32


@inlined_kernel
def mirror(parameters, constants, n, coordinates):
    """Mirror coordinates in place so that those of the first vector are ≥ 0 and descending; return the frame's number.

    Vectors follow one another in `coordinates`, with a component along every axis of the world. Where a component is 0,
    that of the next vector decides the sign.
    """
    n_axes, end = len(constants.axes), parameters.nodes.first_axis[n + 1] - parameters.nodes.first_axis[n]
    frame, flips, orders = 0, 1, 1
    for axis in range(n_axes):
        sign, place = 0.0, axis
        while place < end and sign == 0.0:
            sign = coordinates[place]
            place += n_axes
        if sign < 0.0:
            frame += flips
            for place in range(axis, end, n_axes):
                coordinates[place] = -coordinates[place]
        flips *= 2
    for axis in range(n_axes - 1):
        longest = axis
        for other in range(axis + 1, n_axes):
            if coordinates[other] > coordinates[longest]:
                longest = other
        for place in range(0, end, n_axes):
            held = coordinates[place + axis]
            coordinates[place + axis] = coordinates[place + longest]
            coordinates[place + longest] = held
        frame += flips * orders * (longest - axis)
        orders *= n_axes - axis
    return frame


@inlined_kernel
def seen_cells(parameters, constants, state, n):
    """Find the cell of state.coordinates in every map of a node, into state.seen; return the frame."""
    frame = 0
    if parameters.nodes.mirrored[n]:
        frame = mirror(parameters, constants, n, state.coordinates)
    for m in maps_of(parameters.nodes, n):
        state.seen[m] = cell_of(parameters, state.coordinates, n, m)
    return frame


@inlined_kernel
def entry_of(parameters, constants, m, cell, event):
    """The index in q of the values of an event in a cell of a map."""
    return np.uint64(parameters.maps.first_value[m] + (cell * len(constants.actions) + event) * ENTRIES)


@kernel
def blended(parameters, constants, state, n, event, which):
    """The approach or fear of an event in the cells of state.seen, blended over all maps of a node."""
    q, first = state.values.q, parameters.nodes.first_map[n]
    value = np.float64(q[entry_of(parameters, constants, first, state.seen[first], event) + which])
    for m in range(np.uint64(first + 1), np.uint64(parameters.nodes.first_map[n + 1])):
        entry = entry_of(parameters, constants, m, state.seen[m], event)
        visits = np.float64(q[entry + np.uint64(VISITS)])
        if visits > 0.0:
            own = np.float64(q[entry + which])
            value += visits / (visits + parameters.contacts.familiarity) * (own - value)
    return value


@inlined_kernel
def see_track(parameters, state, n, point):
    """Copy the cells that a point of a node is in to state.seen; return the frame, or -1 if it is in none.

    A user may make an absent thing present between two steps.
    """
    maps, track = parameters.maps, np.uint64(0)
    for m in maps_of(parameters.nodes, n):
        track = np.uint64(maps.first_track[m] + point)
        state.seen[m] = state.tracks.cell[track]
    return state.contacts.frame[track] if state.tracks.cell[track] >= 0 else -1


@inlined_kernel
def follow(parameters, state, n, point, frame, absent):
    """Move the tracks of a point to the cells of state.seen, or to none if it is absent."""
    for m in maps_of(parameters.nodes, n):
        track = np.uint64(parameters.maps.first_track[m] + point)
        state.tracks.cell[track], state.contacts.frame[track] = ABSENT if absent else state.seen[m], frame


@kernel
def begin_contacts(parameters, constants, state, scene, n, point):
    """Start the tracks of a point at its present place, without a history."""
    locate(parameters, constants, scene, n, point, False, state.offset, state.coordinates, state.faults)
    follow(parameters, state, n, point, seen_cells(parameters, constants, state, n), scene.kinds[point] < 0)
    for m in maps_of(parameters.nodes, n):
        state.contacts.count[np.uint64(parameters.maps.first_track[m] + point)] = 0


@kernel
def observe_contacts(parameters, constants, state, scene, n, point):
    """Learn, in the maps of a node, from the effect of the last step on one thing, and follow the thing."""
    maps, contacts, event = parameters.maps, parameters.contacts, state.last_event[0]
    first_track = np.uint64(maps.first_track[parameters.nodes.first_map[n]] + point)
    met, absent = scene.met[point] != 0, scene.kinds[point] < 0
    locate(parameters, constants, scene, n, point, False, state.offset, state.coordinates, state.faults)
    frame = seen_cells(parameters, constants, state, n)
    if event < len(constants.actions) and state.tracks.cell[first_track] >= 0 and (met or not absent):
        approach, fear = 1.0, 1.0
        if not met:
            approach, fear = 0.0, np.inf
            for each in range(len(constants.actions)):
                approach = max(approach, blended(parameters, constants, state, n, each, np.uint64(APPROACH)))
                fear = min(fear, blended(parameters, constants, state, n, each, np.uint64(FEAR)))
            approach, fear = contacts.discount * approach, contacts.discount * fear
        frame_tm1 = state.contacts.frame[first_track]
        learn_step(parameters, constants, state, n, point, parameters.frames[frame_tm1, event], approach, fear)
        if met:
            for m in maps_of(parameters.nodes, n):
                remember_back(contacts, state, np.uint64(maps.first_track[m] + point))
    follow(parameters, state, n, point, frame, absent)
    if met or absent:
        for m in maps_of(parameters.nodes, n):
            state.contacts.count[np.uint64(maps.first_track[m] + point)] = 0


@inlined_kernel
def learn_step(parameters, constants, state, n, point, event, approach, fear):
    """Move the values of an event, in the cells that a thing was in, towards its outcome."""
    q, contacts = state.values.q, parameters.contacts
    coarser, feared = 0.0, 0.0
    for m in maps_of(parameters.nodes, n):
        track = np.uint64(parameters.maps.first_track[m] + point)
        entry = entry_of(parameters, constants, m, state.tracks.cell[track], event)
        old, old_fear = np.float64(q[entry + np.uint64(APPROACH)]), np.float64(q[entry + np.uint64(FEAR)])
        visits = np.float64(q[entry + np.uint64(VISITS)])
        if m == parameters.nodes.first_map[n]:
            coarser, feared = old, old_fear
        elif visits == 0.0:
            old, old_fear = coarser, feared
        else:
            known = visits / (visits + contacts.familiarity)
            coarser, feared = coarser + known * (old - coarser), feared + known * (old_fear - feared)
        root = math.sqrt(abs(visits + 2.0))  # abs(): see `neorl.core.geometry.locate`
        rate = max(contacts.learning_rate, 1.0 / (root * math.sqrt(abs(root))))
        q[entry + np.uint64(APPROACH)] = np.float32(old + rate * (approach - old))
        q[entry + np.uint64(FEAR)] = np.float32(old_fear + rate * (fear - old_fear))
        if visits < MOST_VISITS:
            q[entry + np.uint64(VISITS)] = np.float32(visits + 1.0)
        slot = state.contacts.count[track] % state.contacts.left.shape[1]
        state.contacts.left[track, slot] = entry
        state.contacts.count[track] += 1


@kernel
def remember_back(contacts, state, track):
    """Raise the approach of the actions that led to a contact, backwards from the last but one."""
    q, left, count, worth = state.values.q, state.contacts.left, state.contacts.count[track], 1.0
    for back in range(2, min(count, left.shape[1]) + 1):
        worth *= contacts.discount
        entry = np.uint64(left[track, (count - back) % left.shape[1]])
        value = np.float64(q[entry])
        if worth > value:
            q[entry] = np.float32(value + contacts.trace_rate * (worth - value))


@kernel
def evaluate_contacts(parameters, constants, state, scene, n):
    """Compute the contributions of a node's desires to its Q-vector, in state.desires: see rule 5 of this module."""
    nodes, chosen, desires, contacts = parameters.nodes, parameters.desires, state.desires, parameters.contacts
    most, best = -1.0, -1
    for i in range(nodes.first_input[n], nodes.first_input[n + 1]):
        e = nodes.inputs[i]
        desires.valence[e] = 0.0
        for action in range(len(constants.actions)):
            desires.q[e, action] = 0.0
        worth = desires.worth[e]
        if chosen.source[e] == Source.node:
            worth = desires.target[e, len(constants.axes)]
        for thing in range(scene.kinds.shape[0] if chosen.source[e] == Source.kind else 1):
            frame = -1
            if chosen.source[e] == Source.kind:
                if scene.kinds[thing] == chosen.kind[e]:
                    frame = see_track(parameters, state, n, thing)
            else:
                for axis in range(len(constants.axes)):
                    state.offset[axis] = (desires.target[e, axis] if chosen.source[e] == Source.node else
                                          chosen.at[e, axis] - state.here[axis])
                locate(parameters, constants, scene, n, 0, True, state.offset, state.coordinates, state.faults)
                frame = seen_cells(parameters, constants, state, n)
            if frame < 0:
                continue
            desires.valence[e] += worth
            fears = worth < 0.0 and contacts.flees
            adds = worth < 0.0 or contacts.rivals_add
            highest = -1.0
            for action in range(len(constants.actions)):
                value = blended(parameters, constants, state, n, parameters.frames[frame, action],
                                np.uint64(FEAR) if fears else np.uint64(APPROACH))
                state.rival[action] = worth * value
                highest = max(highest, worth * value)
            if adds or highest > most:
                if not adds:
                    most = highest
                    if best >= 0:  # the previous best no longer counts
                        for action in range(len(constants.actions)):
                            desires.q[best, action] -= state.favourite[action]
                    best = e
                for action in range(len(constants.actions)):
                    value = state.rival[action] if worth > 0.0 else contacts.caution * state.rival[action]
                    desires.q[e, action] += value
                    if not adds:
                        state.favourite[action] = value


@inlined_kernel
def learn_worth(parameters, state, scene):
    """Learn, for desires, the worth of kinds of things from the rewards on meeting them (Rescorla and Wagner 1972).

    The reward of a step beyond the worths of the things met in it updates the worth of each of their kinds, at the rate
    1 / n for the n-th meeting, or a tenth if that is higher.
    """
    chosen, desires = parameters.desires, state.desires
    surprise = state.reward[0]
    for e in range(chosen.source.shape[0]):
        if chosen.learned[e]:
            for thing in range(scene.met.shape[0]):
                if scene.met[thing] == chosen.kind[e] + 1:
                    surprise -= desires.worth[e]
    for e in range(chosen.source.shape[0]):
        if chosen.learned[e]:
            for thing in range(scene.met.shape[0]):
                if scene.met[thing] == chosen.kind[e] + 1:
                    desires.meetings[e] += 1
                    desires.worth[e] += max(0.1, 1.0 / desires.meetings[e]) * surprise
