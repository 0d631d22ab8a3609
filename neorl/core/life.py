"""The life of an agent, step by step: choose, act, perceive, learn.

1. Desires determine the values of the actions through the network of nodes; the policy chooses by these values.
2. The action is an event in the active cell of every track until the track leaves that cell.
3. A map learns all its goals from each track whose active cell changes (with update_on "step", after every step).
4. When the agent meets a thing, the thing's tracks learn from the contact, then follow the fresh thing as if it had
   always been there. At the end of an episode the world is reset. Neither leap is a transition to learn from, nor is
   the appearance or disappearance of a thing.
5. At rest, or at distance 0, a track keeps its last direction.
6. How a capture counts, which changes of cell a thing's tracks learn from and which things are learned about are
   choices of `neorl.agents.rules.Learning`; a track that does not learn still follows its point.
7. A node whose only goals are contacts learns by its own rules, see `neorl.core.contacts`.

`scene` is what the agent perceives of its world (`neorl.core.scene.Scene`).
"""

import numpy as np

from neorl.core.choices import Attention, Capture, Credit, UpdateOn, Vector
from neorl.core.contacts import begin_contacts, learn_worth, observe_contacts
from neorl.core.geometry import cell_of, contact_cell, locate, maps_of, with_kept_directions
from neorl.core.kernel import inlined_kernel
from neorl.core.learning import UNIT, ZERO, enter, learn_transition, start_track
from neorl.core.network import choose
from neorl.core.scene import ABSENT


@inlined_kernel
def act(parameters, constants, state, scene):
    """Choose an action, and record it as an event in the active cell of every track."""
    action = choose(parameters, constants, state, scene)
    for track in range(state.tracks.cell.shape[0]):
        state.tracks.events[track, action] += 1
    state.last_event[0] = action
    if parameters.learning.credit == Credit.activity or parameters.learning.credit == Credit.own:
        retained = parameters.learning.activity_retained
        for event in range(len(constants.actions)):
            state.activity[event] *= retained
            state.activity[event] += UNIT - retained if event == action else ZERO
    return action


@inlined_kernel
def observe(parameters, constants, state, scene):
    """Perceive the outcome of an action, and learn from it."""
    for n in range(parameters.nodes.points.shape[0]):
        for point in range(parameters.nodes.points[n]):
            if parameters.nodes.learns_contacts[n]:
                observe_contacts(parameters, constants, state, scene, n, point)
            else:
                perceive(parameters, constants, state, scene, n, point)
    learn_worth(parameters, state, scene)
    attend(parameters, constants, state, scene)


@inlined_kernel
def perceive(parameters, constants, state, scene, n, point):
    """Find the active cell of a point in every map of a node, and learn if it has changed or an update is due."""
    learning, tracks = parameters.learning, state.tracks
    things = parameters.nodes.follows[n] == Vector.objects
    met = things and scene.met[point] != 0
    absent = things and scene.kinds[point] < 0
    attended = not things or learning.attention == Attention.each or state.attended[0] == point
    breaks = not attended or absent or met and learning.capture != Capture.leap
    _, all_have_directions = locate(parameters, constants, scene, n, point, False, state.offset, state.coordinates)
    looked_alone = False
    for m in maps_of(parameters.nodes, n):
        track = np.uint64(parameters.maps.first_track[m] + point)
        cell_tm1, cell = tracks.cell[track], cell_of(parameters, state.coordinates, n, m)
        ends = breaks or cell_tm1 < 0
        if not (all_have_directions or ends):
            cell = with_kept_directions(parameters.grid, parameters.maps.first_grid[m], state.coordinates,
                                        parameters.nodes.first_axis[n + 1] - parameters.nodes.first_axis[n], cell,
                                        cell_tm1)
        arrives = met and learning.capture == Capture.contact and cell_tm1 >= 0
        cell_t = contact_cell(parameters.maps, m, cell_tm1) if arrives else cell
        if attended and (arrives or not ends) and (cell_t != cell_tm1 or learning.update_on == UpdateOn.step):
            drifts = things and learning.own_causes and not arrives
            if drifts and not looked_alone:
                look_alone(parameters, constants, state, scene, n, point)
                looked_alone = True
            caused = not drifts or cell_of(parameters, state.alone, n, m) != cell_tm1
            learn_transition(parameters, constants, state, m, point, cell_t, caused)
            enter(constants, tracks, track, cell_t)
        if ends:
            start_track(parameters, constants, tracks, m, point, ABSENT if absent else cell)


@inlined_kernel
def look_alone(parameters, constants, state, scene, n, point):
    """Locate a thing as if it had stood still in this step, into state.alone."""
    for axis in range(len(constants.axes)):
        state.offset[axis] = (state.things[point, axis] - scene.position[axis]) / parameters.size
    locate(parameters, constants, scene, n, point, True, state.offset, state.alone)


@inlined_kernel
def attend(parameters, constants, state, scene):
    """Record where the things are, and select the one to learn about."""
    attention = parameters.learning.attention
    if parameters.learning.own_causes:
        for thing in range(scene.things.shape[0]):
            for axis in range(len(constants.axes)):
                state.things[thing, axis] = scene.things[thing, axis]
    if attention != Attention.each:
        nearest = np.inf
        for thing in range(scene.kinds.shape[0]):
            distance = 0.0
            for axis in range(len(constants.axes)):
                offset = scene.things[thing, axis] - scene.position[axis]
                distance += offset * offset
            wanted = scene.kinds[thing] == 0 or attention != Attention.wanted and scene.kinds[thing] > 0
            if distance < nearest and wanted:
                nearest = distance
                state.attended[0] = thing


@inlined_kernel
def begin(parameters, constants, state, scene):
    """Start all tracks in their present cells, without a history, and clear the desires."""
    for n in range(parameters.nodes.points.shape[0]):
        for point in range(parameters.nodes.points[n]):
            begin_point(parameters, constants, state, scene, n, point)
    for event in range(len(constants.actions)):
        state.activity[event] = ZERO
    attend(parameters, constants, state, scene)
    for e in range(state.desires.valence.shape[0]):
        state.desires.valence[e] = 0.0
        for action in range(len(constants.actions)):
            state.desires.q[e, action] = 0.0


@inlined_kernel
def begin_point(parameters, constants, state, scene, n, point):
    """Start the tracks of a point at its present place."""
    if parameters.nodes.learns_contacts[n]:
        begin_contacts(parameters, constants, state, scene, n, point)
        return
    locate(parameters, constants, scene, n, point, False, state.offset, state.coordinates)
    absent = parameters.nodes.follows[n] == Vector.objects and scene.kinds[point] < 0
    for m in maps_of(parameters.nodes, n):
        cell = cell_of(parameters, state.coordinates, n, m)
        start_track(parameters, constants, state.tracks, m, point, ABSENT if absent else cell)
