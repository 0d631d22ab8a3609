"""The life of an agent, step by step: choose, act, perceive, learn.

1. The values of the actions come from desires through the network of nodes; the policy chooses among them.
2. The action is an event in the active cell of every track until that track has moved on.
3. A map learns all its goals from each track whose active cell changes (with update_on "step", after every step).
4. A thing that is touched has met the agent: its tracks learn that, then follow the fresh thing as if it had always
   been there. After the last one of an episode the world starts afresh. Neither leap is a transition to learn from.
5. At rest, or at distance 0, a track keeps the direction that it had.
6. What a capture is, which changes of cell a thing's tracks learn from and which things have any are choices of
   `neorl.agents.agent.Learning`; a track that does not learn follows its point all the same.

`scene` is what the agent perceives of its world, and `contacts` which things it has met in this step.
"""

import numpy as np

from neorl.core.choices import N_EVENTS, Attention, Capture, Credit, UpdateOn, Vector
from neorl.core.geometry import cell_of, contact_cell, moved_alone, point_coordinates, without_direction
from neorl.core.kernel import inlined_kernel, kernel
from neorl.core.learning import UNIT, ZERO, enter, learn_transition, start_track


@inlined_kernel
def act(parameters, state, action):
    """Note that an action was taken, as an event in the active cell of every track."""
    for track in range(state.tracks.cell.shape[0]):
        state.tracks.events[track, action] += 1
    state.last_event[0] = action
    if parameters.learning.credit == Credit.activity:
        retained = parameters.learning.activity_retained
        for event in range(N_EVENTS):
            state.activity[event] *= retained
            state.activity[event] += UNIT - retained if event == action else ZERO


@inlined_kernel
def perceive(parameters, state, scene, contacts, n):
    """Let every map of a node find its active cells, and learn if there is reason to."""
    learning, tracks = parameters.learning, state.tracks
    things = parameters.nodes.vector[n] == Vector.objects
    for point in range(parameters.nodes.points[n]):
        met = things and contacts[point] != 0
        attended = not things or learning.attention == Attention.each or state.attended[0] == point
        u, v = point_coordinates(parameters, scene, n, point)
        for m in range(parameters.nodes.first_map[n], parameters.nodes.first_map[n + 1]):
            track = parameters.maps.first_track[m] + point
            cell_tm1, cell = tracks.cell[track], cell_of(parameters.maps, m, u, v)
            arrives = met and learning.capture == Capture.contact
            stays = arrives or without_direction(parameters.maps, m, u)
            cell_t = contact_cell(parameters.maps, m, cell_tm1) if stays else cell
            ends = not attended or met and learning.capture != Capture.leap
            if attended and (arrives or not ends) and (cell_t != cell_tm1 or learning.update_on == UpdateOn.step):
                drifts = things and learning.own_causes and not arrives
                caused = not drifts or moved_alone(parameters, state, scene, n, m, point)
                learn_transition(parameters, state, m, point, cell_t, caused)
                enter(tracks, track, cell_t)
            if ends:
                start_track(parameters, tracks, m, point, cell)


@inlined_kernel
def attend(parameters, state, scene):
    """See where the things are, and which of them is to be learned about."""
    attention = parameters.learning.attention
    if parameters.learning.own_causes:
        for thing in range(state.thing_position.shape[0]):
            state.thing_position[thing, 0] = scene.creep_position[thing, 0]
            state.thing_position[thing, 1] = scene.creep_position[thing, 1]
    if attention != Attention.each:
        nearest = np.inf
        for thing in range(state.thing_position.shape[0]):
            dx = scene.creep_position[thing, 0] - scene.agent_position[0]
            dy = scene.creep_position[thing, 1] - scene.agent_position[1]
            distance = dx * dx + dy * dy
            if distance < nearest and (attention != Attention.wanted or scene.creep_is_green[thing]):
                nearest = distance
                state.attended[0] = thing


@kernel
def reset_tracks(parameters, state, scene):
    """Take the present cells as given, with nothing that led to them, and desires without a past."""
    for n in range(parameters.nodes.points.shape[0]):
        for point in range(parameters.nodes.points[n]):
            reset_point(parameters, state, scene, n, point)
    for event in range(N_EVENTS):
        state.activity[event] = ZERO
    attend(parameters, state, scene)
    for e in range(state.desires.valence.shape[0]):
        state.desires.valence[e] = 0.0
        for action in range(N_EVENTS):
            state.desires.q[e, action] = 0.0


@inlined_kernel
def reset_point(parameters, state, scene, n, point):
    u, v = point_coordinates(parameters, scene, n, point)
    for m in range(parameters.nodes.first_map[n], parameters.nodes.first_map[n + 1]):
        start_track(parameters, state.tracks, m, point, cell_of(parameters.maps, m, u, v))
