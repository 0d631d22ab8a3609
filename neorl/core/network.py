"""From desires to the values of actions, through the network of an agent's nodes (paper C, section 1).

1. For every element of interest, each map of its node evaluates the value function of a goal at the cell of one point.
   If the map represents the agent itself (its place, its direction), the point is the agent and the goal is the cell
   of the element. If it represents things relative to the agent, there are two readings. The state is the self, always
   at the centre, and the goal is the cell of the element. Or the state is the cell of the element, and the goal is the
   contact of the two: distance 0, in a polar map in the direction of the thing, or every cell that the contact reaches.
   An element at the agent's own place has no direction, and adds nothing to a map of directions. Along axes of
   conjunctive cells that do not represent its place, an element is everywhere: it is in several cells, and their values
   add up. An element beyond the range of a map that ends there adds nothing to it.
2. These values, weighted by valence and by the weight of the map, add up to the node's Q-vector (thesis eq. 4.3, 4.4).
   The elements of a desire that are in the same cell add theirs each, or once.
3. The sum of the pushes of all actions, times their values, turns a Q-vector into a vector in the world: a desire. The
   end of that vector is an element of interest for the next node.

`scene` is what the agent perceives of its world (`neorl.core.scene.Scene`).
"""

import numpy as np

from neorl.core.choices import MapState, Source, Vector
from neorl.core.geometry import STRIDE, cell_within, contact_cell, interval_at, locate, maps_of
from neorl.core.kernel import inlined_kernel
from neorl.core.learning import order_of, place_of, values_of
from neorl.core.policy import greedy
from neorl.core.stream import randint, uniform


@inlined_kernel
def choose(parameters, constants, state, scene):
    """The action of the behaviour policy."""
    policy, value = parameters.policy, state.action_value
    if policy.exploration > 0.0 and uniform(state.stream) < policy.exploration:
        return randint(state.stream, len(constants.actions))
    evaluate(parameters, constants, state, scene)
    if policy.indifferent_is_no_op:
        wanted = 0
        for action in range(len(constants.actions)):
            wanted += value[action] != 0.0
        if wanted == 0:
            return len(constants.actions)
    action = greedy(value, state.stream) if policy.is_greedy else constants.choose(state)
    return min(max(action, 0), constants.last)  # a user-defined policy may return any number


@inlined_kernel
def evaluate(parameters, constants, state, scene):
    """Compute the value of each action, in state.action_value: the sum of Q-vectors times gains, nodes in order."""
    nodes, desires = parameters.nodes, state.desires
    for action in range(len(constants.actions)):
        state.action_value[action] = 0.0
    for axis in range(len(constants.axes)):
        state.here[axis] = scene.position[axis] / parameters.size
    for place in range(nodes.order.shape[0]):
        n = nodes.order[place]
        inputs = nodes.inputs[nodes.first_input[n] : nodes.first_input[n + 1]]
        # All before any is updated, since recursion uses those of the last step.
        for i in range(inputs.shape[0] if nodes.receives[n] else 0):
            if parameters.desires.source[inputs[i]] == Source.node:
                project(parameters, constants, desires, np.uint64(inputs[i]))
        if nodes.learns_contacts[n]:
            constants.evaluate_contacts(parameters, constants, state, scene, n)
        for i in range(inputs.shape[0]):
            e = np.uint64(inputs[i])
            if not nodes.learns_contacts[n]:
                evaluate_desire(parameters, constants, state, scene, n, e)
            for action in range(len(constants.actions)):
                state.action_value[action] += nodes.gain[n] * desires.q[e, action]


@inlined_kernel
def project(parameters, constants, desires, e):
    """Compute where the desire of a node lands, and its valence, in desires.target."""
    chosen, target, n_axes = parameters.desires, desires.target, len(constants.axes)
    for axis in range(n_axes):
        target[e, axis] = 0.0
    valence = 0.0
    for i in range(chosen.source.shape[0]):
        if chosen.elements[e, i]:
            valence += desires.valence[i]
            towards = chosen.signed[e] or desires.valence[i] > 0.0
            for axis in range(n_axes):
                pushed = 0.0
                for action in range(len(constants.actions)):
                    pushed += parameters.push[action, axis] * desires.q[i, action]
                target[e, axis] += pushed if towards else -pushed
    for axis in range(n_axes):
        target[e, axis] *= chosen.scale[e]
    target[e, n_axes] = valence if chosen.sums_valence[e] else chosen.valence[e]


@inlined_kernel
def evaluate_desire(parameters, constants, state, scene, n, e):
    """Compute a desire's contribution to its node's Q-vector, and its elements' total valence, in state.desires."""
    chosen, desires, n_axes = parameters.desires, state.desires, len(constants.axes)
    q, source, valence = desires.q[e], chosen.source[e], desires.worth[e]
    for action in range(len(constants.actions)):
        q[action] = 0.0
    if source == Source.node:
        valence = desires.target[e, n_axes]
    desires.valence[e] = 0.0 if source == Source.kind else valence
    if source == Source.point:
        for m in maps_of(parameters.nodes, n):
            for track in range(parameters.maps.first_track[m], parameters.maps.first_track[m + 1]):
                if state.tracks.cell[track] >= 0:
                    add_value(parameters, constants, state, n, m, state.tracks.cell[track], chosen.goal[e, m], valence,
                              q)
        return
    state.evaluation[0] += 1
    of_place = parameters.nodes.follows[n] == Vector.position
    sees_things = (source == Source.kind and parameters.nodes.follows[n] == Vector.objects
                   and parameters.nodes.state[n] == MapState.object)
    for thing in range(scene.kinds.shape[0] if source == Source.kind else 1):
        if source == Source.kind:
            if scene.kinds[thing] != chosen.kind[e]:
                continue
            desires.valence[e] += valence
        if sees_things:
            for m in maps_of(parameters.nodes, n):
                cell = state.tracks.cell[np.uint64(parameters.maps.first_track[m] + thing)]
                if counts(parameters, state, m, cell):
                    add_contact(parameters, constants, state, n, m, cell, valence, q)
            continue
        for axis in range(n_axes):
            here = state.here[axis]
            if source == Source.node:
                offset = desires.target[e, axis]
            elif source == Source.place:
                offset = chosen.at[e, axis] - here
            else:
                offset = scene.things[thing, axis] / parameters.size - here
            state.offset[axis] = offset + here if of_place else offset
        add_element(parameters, constants, state, scene, n, valence, q)


@inlined_kernel
def add_element(parameters, constants, state, scene, n, valence, q):
    """Add the values of an element in every map of a node; state.offset is its vector, as followed by the node."""
    maps, nodes = parameters.maps, parameters.nodes
    has_direction, coordinates = True, state.offset
    if not nodes.is_cartesian[n]:
        has_direction, _ = locate(parameters, constants, scene, n, 0, True, state.offset, state.coordinates,
                                  state.faults)
        coordinates = state.coordinates
    of_agent = nodes.follows[n] == Vector.position or nodes.follows[n] == Vector.velocity
    if of_agent and not has_direction:
        return
    for m in maps_of(nodes, n):
        cell = cell_within(parameters, coordinates, n, m)
        if not counts(parameters, state, m, cell):
            continue
        if of_agent:
            add_goals(parameters, constants, state, n, m, state.tracks.cell[np.uint64(maps.first_track[m])], cell,
                      valence, q)
        elif nodes.state[n] == MapState.object:
            add_contact(parameters, constants, state, n, m, cell, valence, q)
        else:
            add_value(parameters, constants, state, n, m, maps.contact[m], cell, valence, q)


@inlined_kernel
def counts(parameters, state, m, cell):
    """Whether an element in a cell of a map counts beside those of its desire that came before it."""
    if not parameters.shared_cell_counts_once or cell < 0:
        return True
    place = np.uint64(parameters.maps.first_cell[m] + cell)
    is_first = state.counted[place] != state.evaluation[0]
    state.counted[place] = state.evaluation[0]
    return is_first


@inlined_kernel
def add_contact(parameters, constants, state, n, m, cell, valence, q):
    """Add the values of a thing's contact with the agent, or of every cell that the contact reaches."""
    reach, first = parameters.nodes.reach[n], np.uint64(parameters.maps.first_grid[m])
    if reach == 0.0 or cell < 0:
        add_goals(parameters, constants, state, n, m, cell, contact_cell(parameters.maps, m, cell), valence, q)
        return
    boxes = 1
    for axis in range(len(constants.axes)):
        cut = parameters.grid[first + axis]
        boxes *= int(interval_at(cut, reach) - interval_at(cut, -reach)) + 1
    for box in range(boxes):
        goal, rest = 0, box
        for axis in range(len(constants.axes)):
            cut = parameters.grid[first + axis]
            lowest = int(interval_at(cut, -reach))
            side = int(interval_at(cut, reach)) - lowest + 1
            goal += int(cut[STRIDE]) * (lowest + rest % side)
            rest //= side
        add_value(parameters, constants, state, n, m, cell, goal, valence, q)


@inlined_kernel
def add_goals(parameters, constants, state, n, m, cell, goal, valence, q):
    """Add the values of all goals that differ from one only along axes on which an element has no place."""
    followed = parameters.maps.followed[m]
    if followed == parameters.maps.cells[m]:
        add_value(parameters, constants, state, n, m, cell, goal, valence, q)
    elif goal >= 0:
        for other in range(goal % followed, parameters.maps.cells[m], followed):
            add_value(parameters, constants, state, n, m, cell, other, valence, q)


@inlined_kernel
def add_value(parameters, constants, state, n, m, cell, goal, valence, q):
    """Add one goal's value of each action in a cell, times its valence and the weight of the map."""
    maps, actions = parameters.maps, len(constants.actions)
    if cell >= 0 and goal >= 0 and (goal != cell or parameters.own_cell_counts):
        weight, order = maps.weight[m] * valence, order_of(parameters, m)
        if parameters.nodes.state[n] != MapState.object:
            cell, goal = goal, 0  # the only state is the centre, so the values are found by the goal
        place = place_of(values_of(parameters, state, m), order, cell, goal)
        for action in range(actions):
            q[action] += weight * state.values.q[place + np.uint64(action) * order.action]
