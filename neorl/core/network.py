"""From desires to the values of actions, through the network of an agent's nodes (paper C, section 1).

1. Every element of interest calls up, in each map of its node, the value function of one goal at the cell of one point.
   Where the map is about the agent itself (its place, its direction), the point is the agent's and the goal is the
   element's. Where the map is about things as seen from the agent, the element is one of these things, and the goal is
   that the two meet: distance 0, in a polar map at the direction that the thing is in. An element where the agent is
   calls up no direction.
2. What they call up adds, weighted by valence and by the weight of the map (thesis eq. 4.3, 4.4): the node's Q-vector.
3. Opposite actions taken from one another make a Q-vector a vector in the arena: a desire. It lands at the end of that
   vector and is an element of interest there, for the next node.
"""

from neorl.core.choices import Source
from neorl.core.horde import N_EVENTS, add_goal
from neorl.core.kernel import inlined_kernel
from neorl.core.maps import cell_at
from neorl.core.modality import BOUNDARIES, OBJECTS, POSITION, VELOCITY, boundary_vector, tuned


@inlined_kernel
def evaluate(plan, memory, state):
    """The value of each action, into memory.value: the nodes' Q-vectors times their gains, nodes in order."""
    for action in range(N_EVENTS):
        memory.value[action] = 0.0
    for place in range(plan.order.shape[0]):
        n = plan.order[place]
        inputs = plan.inputs[plan.first_input[n] : plan.first_input[n + 1]]
        for i in range(inputs.shape[0]):  # all before any is renewed, because recursion takes those of the last step
            if plan.source[inputs[i]] == Source.node:
                project(plan, memory, inputs[i])
        for i in range(inputs.shape[0]):
            call_up(plan, memory, state, n, inputs[i])
            for action in range(N_EVENTS):
                memory.value[action] += plan.gain[n] * memory.pull[inputs[i], action]


@inlined_kernel
def project(plan, memory, e):
    """Where the desire of a node lands, and its valence."""
    east, south, valence = 0.0, 0.0, 0.0
    for i in range(plan.source.shape[0]):
        if plan.elements[e, i]:
            sign = 1.0 if plan.signed[e] or memory.worth[i] > 0.0 else -1.0
            east += sign * (memory.pull[i, 2] - memory.pull[i, 3])
            south += sign * (memory.pull[i, 1] - memory.pull[i, 0])
            valence += memory.worth[i]
    memory.landing[e, 0] = plan.scale[e] * east
    memory.landing[e, 1] = plan.scale[e] * south
    memory.landing[e, 2] = valence if plan.sums_valence[e] else plan.valence[e]


@inlined_kernel
def call_up(plan, memory, state, n, e):
    """What one desire adds to the Q-vector of its node, into memory.pull, and the valence of its elements together."""
    pull, source, valence = memory.pull[e], plan.source[e], plan.valence[e]
    for action in range(N_EVENTS):
        pull[action] = 0.0
    if source == Source.node:
        valence = memory.landing[e, 2]
    memory.worth[e] = valence if source >= Source.node else 0.0
    if source == Source.point:
        for m in range(plan.first_map[n], plan.first_map[n + 1]):
            for track in range(plan.first_track[m], plan.first_track[m + 1]):
                add_value(plan, memory, m, memory.cell[track], plan.goal[e, m], valence, pull)
        return
    x, y = state.agent_position[0] / plan.width, state.agent_position[1] / plan.width
    for thing in range(1 if source >= Source.node else state.creep_speed.shape[0]):
        if source == Source.node:
            dx, dy = memory.landing[e, 0], memory.landing[e, 1]
        elif source == Source.place:
            dx, dy = plan.at[e, 0] - x, plan.at[e, 1] - y
        elif state.creep_is_green[thing] == (source == Source.red):
            continue
        else:
            memory.worth[e] += valence
            dx = state.creep_position[thing, 0] / plan.width - x
            dy = state.creep_position[thing, 1] / plan.width - y
        add_element(plan, memory, n, x, y, dx, dy, valence, pull)


@inlined_kernel
def add_element(plan, memory, n, x, y, dx, dy, valence, pull):
    """Let an element at (dx, dy) from the agent, which is at (x, y), call up its goal in every map of a node."""
    at_place = plan.vector[n] == POSITION
    of_agent = at_place or plan.vector[n] == VELOCITY
    u, v = place_coordinates(plan, n, x + dx if at_place else dx, y + dy if at_place else dy)
    for m in range(plan.first_map[n], plan.first_map[n + 1]):
        cell = cell_of(plan, m, u, v)
        if of_agent:
            if not without_direction(plan, m, u):
                add_value(plan, memory, m, memory.cell[plan.first_track[m]], cell, valence, pull)
        else:
            add_value(plan, memory, m, cell, contact_cell(plan, m, cell), valence, pull)


@inlined_kernel
def add_value(plan, memory, m, cell, goal, valence, pull):
    if goal != cell or plan.own_cell_counts:
        add_goal(memory.q, plan.first[m], plan.cells[m], cell, goal, plan.weight[m] * valence, pull)


@inlined_kernel
def point_coordinates(plan, state, n, point):
    """The coordinates of a point that a node follows, a direction in turns."""
    x, y = state.agent_position[0] / plan.width, state.agent_position[1] / plan.width
    if plan.vector[n] == VELOCITY:
        x, y = state.agent_velocity[0] / plan.width, state.agent_velocity[1] / plan.width
    elif plan.vector[n] == OBJECTS:
        x, y = state.creep_position[point, 0] / plan.width - x, state.creep_position[point, 1] / plan.width - y
    elif plan.vector[n] == BOUNDARIES:
        x, y = boundary_vector(point, x, y)
    elif plan.vector[n] != POSITION:
        landmark = plan.first_landmark[n] + point
        x, y = plan.landmark[landmark, 0] - x, plan.landmark[landmark, 1] - y
    return place_coordinates(plan, n, x, y)


@inlined_kernel
def place_coordinates(plan, n, x, y):
    return tuned(plan.tuning[n], x, y, plan.high[n, 0], plan.high[n, 1])


@inlined_kernel
def cell_of(plan, m, u, v):
    return cell_at(u, v, plan.columns[m], plan.rows[m], plan.low_u[m], plan.scale_u[m], plan.low_v[m], plan.scale_v[m],
                   plan.closed[m])


@inlined_kernel
def without_direction(plan, m, u):
    """Whether a map of directions is to place a vector of length 0."""
    return plan.closed[m] and u == 0.0


@inlined_kernel
def contact_cell(plan, m, cell):
    """Where a thing that is in a cell arrives when it meets the agent."""
    if plan.closed[m]:
        return cell - cell % plan.columns[m] + plan.contact[m] % plan.columns[m]
    return plan.contact[m]
