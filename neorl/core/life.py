"""The life of an agent, step by step: choose, act, perceive, learn.

1. Desires determine the values of the actions through the network of nodes; the policy chooses by these values.
2. The action is an event in the active cell of every track until the track leaves that cell.
3. A map learns all its goals from each track whose active cell changes (with update_on "step", after every step).
4. When the agent meets a thing, the thing's tracks learn that it has arrived at distance 0, then follow the fresh thing
   as if it had always been there. At the end of an episode the world is reset. Neither leap is a transition to learn
   from, nor is the appearance or disappearance of a thing. For an agent that does not notice resets, nothing happens
   at a reset, and its leap is a transition.
5. At rest, or at distance 0, a track keeps its last direction.
6. Where the state of a node's maps is the self, one track follows the agent, and captures do not concern it; or the
   agent as seen from each thing has a track, which starts afresh when that thing is met. A transition is then that the
   agent leaves the centre of the map, see `neorl.core.displacement`.
7. A node whose only goals are contacts learns by its own rules, see `neorl.core.contacts`.

`scene` is what the agent perceives of its world (`neorl.core.scene.Scene`).
"""

import numpy as np

from neorl.core.choices import Credit, MapState, UpdateOn, Vector
from neorl.core.constants import Constants
from neorl.core.contacts import learn_worth
from neorl.core.displacement import has_left_centre, learn_displacement, start_self
from neorl.core.geometry import cell_within, component, contact_cell, locate, maps_of, with_kept_directions
from neorl.core.kernel import inlined_kernel, kernel
from neorl.core.learning import UNIT, ZERO, enter, learn_transition, start_track
from neorl.core.network import choose
from neorl.core.parameters import Parameters
from neorl.core.scene import ABSENT, Scene
from neorl.core.state import State


@kernel
def act(parameters: Parameters, constants: Constants, state: State, scene: Scene) -> int:
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


@kernel
def observe(parameters: Parameters, constants: Constants, state: State, scene: Scene) -> None:
    """Perceive the outcome of an action, and learn from it."""
    for n in range(parameters.nodes.points.shape[0]):
        for point in range(parameters.nodes.points[n]):
            if parameters.nodes.learns_contacts[n]:
                constants.observe_contacts(parameters, constants, state, scene, n, point)
            elif parameters.nodes.state[n] != MapState.object:
                constants.observe_self(parameters, constants, state, scene, n, point)
            else:
                perceive(parameters, constants, state, scene, n, point)
    learn_worth(parameters, state, scene)


@inlined_kernel
def perceive(parameters, constants, state, scene, n, point):
    """Find the active cell of a point in every map of a node, and learn if it has changed or an update is due."""
    learning, tracks = parameters.learning, state.tracks
    things = parameters.nodes.follows[n] == Vector.objects
    met = things and scene.met[point] != 0
    _, all_have_directions = locate(parameters, constants, scene, n, point, False, state.offset, state.coordinates,
                                    state.faults)
    for m in maps_of(parameters.nodes, n):
        track = np.uint64(parameters.maps.first_track[m] + point)
        cell_tm1, cell = tracks.cell[track], cell_within(parameters, state.coordinates, n, m)
        if things and scene.kinds[point] < 0:
            cell = ABSENT
        ends = met or cell < 0 or cell_tm1 < 0
        if not (all_have_directions or ends):
            cell = with_kept_directions(parameters.grid, parameters.maps.first_grid[m], state.coordinates,
                                        parameters.nodes.first_axis[n + 1] - parameters.nodes.first_axis[n], cell,
                                        cell_tm1)
        arrives = met and cell_tm1 >= 0
        cell_t = contact_cell(parameters.maps, m, cell_tm1) if arrives else cell
        if (arrives or not ends) and (cell_t != cell_tm1 or learning.update_on == UpdateOn.step):
            learn_transition(parameters, constants, state, m, point, cell_t)
            enter(constants, tracks, track, cell_t)
        if ends:
            start_track(parameters, constants, tracks, m, point, cell)


@kernel
def observe_self(parameters, constants, state, scene, n, point):
    """Follow the agent, or the agent as seen from a thing, and learn in every map whose centre it has left."""
    of_thing, tracks = parameters.nodes.state[n] == MapState.per_object, state.tracks
    starts = of_thing and (scene.met[point] != 0 or scene.kinds[point] < 0)
    locate_self(parameters, constants, state, scene, n, point)
    for m in maps_of(parameters.nodes, n):
        track = np.uint64(parameters.maps.first_track[m] + point)
        if starts or tracks.cell[track] < 0:
            start_self(parameters, constants, state, m, point, centre_cell(parameters, scene, n, m, point))
        elif has_left_centre(parameters, state, m, point, track):
            cell = cell_within(parameters, state.offset, n, m)
            learn_displacement(parameters, constants, state, n, m, point, cell)
            enter(constants, tracks, track, parameters.maps.contact[m])


@kernel
def begin_self(parameters, constants, state, scene, n, point):
    """Start the tracks of the agent, or of the agent as seen from a thing, at its present place."""
    locate_self(parameters, constants, state, scene, n, point)
    for m in maps_of(parameters.nodes, n):
        start_self(parameters, constants, state, m, point, centre_cell(parameters, scene, n, m, point))


@inlined_kernel
def locate_self(parameters, constants, state, scene, n, point):
    """Write where the agent is, or where it is as seen from a thing, into state.coordinates."""
    for axis in range(len(constants.axes)):
        if parameters.nodes.state[n] == MapState.per_object:
            state.coordinates[axis] = -component(parameters, constants, scene, n, parameters.nodes.follows[n], point,
                                                 axis)
        else:
            state.coordinates[axis] = scene.position[axis] / parameters.size


@inlined_kernel
def centre_cell(parameters, scene, n, m, point):
    """The centre of a map, or no cell if it is of an absent thing."""
    absent = parameters.nodes.state[n] == MapState.per_object and scene.kinds[point] < 0
    return ABSENT if absent else parameters.maps.contact[m]


@kernel
def begin(parameters: Parameters, constants: Constants, state: State, scene: Scene) -> None:
    """Start all tracks in their present cells, without a history, and clear the desires."""
    for n in range(parameters.nodes.points.shape[0]):
        for point in range(parameters.nodes.points[n]):
            begin_point(parameters, constants, state, scene, n, point)
    for event in range(len(constants.actions)):
        state.activity[event] = ZERO
    for e in range(state.desires.valence.shape[0]):
        state.desires.valence[e] = 0.0
        for action in range(len(constants.actions)):
            state.desires.q[e, action] = 0.0


@inlined_kernel
def begin_point(parameters, constants, state, scene, n, point):
    """Start the tracks of a point at its present place."""
    if parameters.nodes.learns_contacts[n]:
        constants.begin_contacts(parameters, constants, state, scene, n, point)
        return
    if parameters.nodes.state[n] != MapState.object:
        constants.begin_self(parameters, constants, state, scene, n, point)
        return
    locate(parameters, constants, scene, n, point, False, state.offset, state.coordinates, state.faults)
    absent = parameters.nodes.follows[n] == Vector.objects and scene.kinds[point] < 0
    for m in maps_of(parameters.nodes, n):
        cell = cell_within(parameters, state.coordinates, n, m)
        start_track(parameters, constants, state.tracks, m, point, ABSENT if absent else cell)
