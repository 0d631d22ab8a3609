"""From desires to the values of actions, through the network of an agent's nodes (paper C, section 1).

1. Every element of interest evaluates, in each map of its node, the value function of one goal at the cell of one
   point. Where the map is about the agent itself (its place, its direction), the point is the agent's and the goal is
   the element's. Where the map is about things as seen from the agent, the element is one of these things, and the goal
   is that the two meet: distance 0, in a polar map at the direction that the thing is in. An element where the agent is
   has no direction, and adds nothing to a map of directions.
2. These values add, weighted by valence and by the weight of the map (thesis eq. 4.3, 4.4): the node's Q-vector.
3. Opposite actions taken from one another make a Q-vector a vector in the arena: a desire. It lands at the end of that
   vector and is an element of interest there, for the next node.

`scene` is what the agent perceives of its world: its own position and velocity, and where things are.
"""

from neorl.core.choices import N_EVENTS, Action, Source, Vector
from neorl.core.geometry import cell_of, contact_cell, place_coordinates, without_direction
from neorl.core.kernel import inlined_kernel
from neorl.core.stream import randint, uniform


@inlined_kernel
def choose(parameters, state, scene):
    """The action of the behaviour policy."""
    policy, value = parameters.policy, state.action_value
    if policy.exploration > 0.0 and uniform(state.stream) < policy.exploration:
        return randint(state.stream, N_EVENTS)
    evaluate(parameters, state, scene)
    best = max(max(value[0], value[1]), max(value[2], value[3]))
    if policy.indifferent_is_no_op and best == 0.0 and min(min(value[0], value[1]), min(value[2], value[3])) == 0.0:
        return Action.no_op.value
    ties = 0
    for action in range(N_EVENTS):
        ties += value[action] == best
    skip = randint(state.stream, ties) if ties > 1 else 0
    action = 0
    while action < N_EVENTS - 1 and (value[action] != best or skip > 0):
        skip -= value[action] == best
        action += 1
    return action


@inlined_kernel
def evaluate(parameters, state, scene):
    """The value of each action, into state.action_value: the nodes' Q-vectors times their gains, nodes in order."""
    nodes, desires = parameters.nodes, state.desires
    for action in range(N_EVENTS):
        state.action_value[action] = 0.0
    for place in range(nodes.order.shape[0]):
        n = nodes.order[place]
        inputs = nodes.inputs[nodes.first_input[n] : nodes.first_input[n + 1]]
        for i in range(inputs.shape[0]):  # all before any is renewed, because recursion takes those of the last step
            if parameters.desires.source[inputs[i]] == Source.node:
                project(parameters, desires, inputs[i])
        for i in range(inputs.shape[0]):
            evaluate_desire(parameters, state, scene, n, inputs[i])
            for action in range(N_EVENTS):
                state.action_value[action] += nodes.gain[n] * desires.q[inputs[i], action]


@inlined_kernel
def project(parameters, desires, e):
    """Where the desire of a node lands, and its valence, into desires.target."""
    chosen = parameters.desires
    east, south, valence = 0.0, 0.0, 0.0
    for i in range(chosen.source.shape[0]):
        if chosen.elements[e, i]:
            sign = 1.0 if chosen.signed[e] or desires.valence[i] > 0.0 else -1.0
            east += sign * (desires.q[i, Action.E] - desires.q[i, Action.W])
            south += sign * (desires.q[i, Action.S] - desires.q[i, Action.N])
            valence += desires.valence[i]
    desires.target[e, 0] = chosen.scale[e] * east
    desires.target[e, 1] = chosen.scale[e] * south
    desires.target[e, 2] = valence if chosen.sums_valence[e] else chosen.valence[e]


@inlined_kernel
def evaluate_desire(parameters, state, scene, n, e):
    """What one desire adds to its node's Q-vector, and the valence of its elements together, into state.desires."""
    chosen, desires = parameters.desires, state.desires
    q, source, valence = desires.q[e], chosen.source[e], chosen.valence[e]
    for action in range(N_EVENTS):
        q[action] = 0.0
    if source == Source.node:
        valence = desires.target[e, 2]
    desires.valence[e] = valence if source >= Source.node else 0.0
    if source == Source.point:
        for m in range(parameters.nodes.first_map[n], parameters.nodes.first_map[n + 1]):
            for track in range(parameters.maps.first_track[m], parameters.maps.first_track[m + 1]):
                add_value(parameters, state, m, state.tracks.cell[track], chosen.goal[e, m], valence, q)
        return
    x, y = scene.agent_position[0] / parameters.width, scene.agent_position[1] / parameters.width
    for thing in range(1 if source >= Source.node else scene.creep_speed.shape[0]):
        if source == Source.node:
            dx, dy = desires.target[e, 0], desires.target[e, 1]
        elif source == Source.place:
            dx, dy = chosen.at[e, 0] - x, chosen.at[e, 1] - y
        elif scene.creep_is_green[thing] == (source == Source.red):
            continue
        else:
            desires.valence[e] += valence
            dx = scene.creep_position[thing, 0] / parameters.width - x
            dy = scene.creep_position[thing, 1] / parameters.width - y
        add_element(parameters, state, n, x, y, dx, dy, valence, q)


@inlined_kernel
def add_element(parameters, state, n, x, y, dx, dy, valence, q):
    """Add the values, in every map of a node, of an element at (dx, dy) from the agent, which is at (x, y)."""
    maps, nodes = parameters.maps, parameters.nodes
    at_place = nodes.vector[n] == Vector.position
    of_agent = at_place or nodes.vector[n] == Vector.velocity
    u, v = place_coordinates(nodes, n, x + dx if at_place else dx, y + dy if at_place else dy)
    for m in range(nodes.first_map[n], nodes.first_map[n + 1]):
        cell = cell_of(maps, m, u, v)
        if of_agent:
            goal, evaluated = cell, not without_direction(maps, m, u)
            cell = state.tracks.cell[maps.first_track[m]]
        else:
            goal, evaluated = contact_cell(maps, m, cell), True
        if evaluated:
            add_value(parameters, state, m, cell, goal, valence, q)


@inlined_kernel
def add_value(parameters, state, m, cell, goal, valence, q):
    """Add one goal's value of each action in a cell, times its valence and the weight of the map."""
    maps = parameters.maps
    if goal != cell or parameters.own_cell_counts:
        weight, index = maps.weight[m] * valence, maps.first_value[m] + cell * N_EVENTS * maps.cells[m] + goal
        for action in range(N_EVENTS):
            q[action] += weight * state.values.q[index + action * maps.cells[m]]
