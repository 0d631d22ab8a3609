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

In `notebooks/companion/one_file.py`, 1 is `selected` in section 2, 2 `values`, 3 `elements`, and the choice section 3.
`scene` is what the agent perceives of its world (`neorl.core.scene.Scene`).
"""

import numpy as np

from neorl.core.choices import MapState, Source, Vector
from neorl.core.geometry import cell_within, contact_cell, interval_at, locate
from neorl.core.learning import order_of, place_of
from neorl.core.policy import greedy
from neorl.core.stream import randint, uniform
from neorl.kernels.kernel import inlined_kernel


@inlined_kernel
def choose(agent, memory, scene, functions):
    """a = argmax Q(s, ·), ties broken at random, or what the user's policy chooses (one file: `choose`)."""
    policy, value, actions = agent.policy, agent.action_value, agent.action_value.shape[0]
    if policy.exploration > 0.0 and uniform(agent.stream) < policy.exploration:
        return randint(agent.stream, actions)
    evaluate(agent, memory, scene, functions)
    if policy.indifferent_is_no_op:
        wanted = 0
        for action in range(actions):
            wanted += value[action] != 0.0
        if wanted == 0:
            return actions
    action = greedy(value, agent.stream) if policy.is_greedy else functions.user.choose(agent)
    return min(max(action, 0), policy.last)  # a user-defined policy may return any number


@inlined_kernel
def evaluate(agent, memory, scene, functions):
    """Q(s, a) = Σ gain Σ Q_e(s, a) over nodes in order and their desires e (eq. 4.3), into agent.action_value."""
    for action in range(agent.action_value.shape[0]):
        agent.action_value[action] = 0.0
    for axis in range(agent.here.shape[0]):
        agent.here[axis] = scene.position[axis] / agent.size
    for place in range(agent.n_nodes):
        n = agent.order[place]
        node = agent.nodes[n]
        if node.receives:  # all before any is updated, since recursion uses those of the last step
            for i in range(node.first_input, node.end_input):
                if agent.desires[agent.inputs[i]].source == Source.node:
                    project(agent, memory, agent.desires[agent.inputs[i]])
        if node.learns_contacts:
            functions.evaluate_contacts(agent, memory, scene, functions.user, n)
        for i in range(node.first_input, node.end_input):
            desire = agent.desires[agent.inputs[i]]
            if not node.learns_contacts:
                evaluate_desire(agent, memory, scene, functions.user, node, desire)
            for action in range(agent.action_value.shape[0]):
                agent.action_value[action] += node.gain * desire.q[action]


@inlined_kernel
def project(agent, memory, desire):
    """d = scale Σ_e Σ_a push_a Q_e(a) over elements e: where the desire of a node lands, and its valence Σ w."""
    axes, valence = agent.here.shape[0], 0.0
    for axis in range(axes):
        desire.target_at[axis] = 0.0
    for i in range(desire.first_element, desire.end_element):
        element = agent.desires[memory.elements[i]]
        valence += element.total_valence
        towards = desire.signed or element.total_valence > 0.0
        for axis in range(axes):
            pushed = 0.0
            for action in range(agent.action_value.shape[0]):
                pushed += agent.push[action, axis] * element.q[action]
            desire.target_at[axis] += pushed if towards else -pushed
    for axis in range(axes):
        desire.target_at[axis] *= desire.scale
    desire.target_valence = valence if desire.sums_valence else desire.valence


@inlined_kernel
def evaluate_desire(agent, memory, scene, user, node, desire):
    """Q_e(s, a) = Σ w_i Q_i(s, a) over the elements of a desire (eq. 4.4), and their total valence Σ w_i."""
    is_of_kind, valence = desire.source == Source.kind, desire.worth
    for action in range(agent.action_value.shape[0]):
        desire.q[action] = 0.0
    if desire.source == Source.node:
        valence = desire.target_valence
    desire.total_valence = 0.0 if is_of_kind else valence
    if desire.source == Source.point:
        add_point(agent, memory, node, desire, valence)
        return
    agent.evaluation += 1  # outdates all that `counts` has marked, so that no mark need be cleared
    has_tracks = is_of_kind and node.follows == Vector.objects and node.state == MapState.object
    for thing in range(scene.kinds.shape[0] if is_of_kind else 1):  # one call of each kernel, since it is inlined here
        if not is_of_kind or scene.kinds[thing] == desire.kind:
            if is_of_kind:
                desire.total_valence += valence
            if has_tracks:
                add_tracked(agent, memory, node, thing, valence, desire.q)
            else:
                face(agent, scene, node, desire, thing)
                add_element(agent, memory, scene, user, node, valence, desire.q)


@inlined_kernel
def add_point(agent, memory, node, desire, valence):
    """Add the values of a point, whose cell is known, in every map of a node and at each of its tracks."""
    for m in range(node.first_map, node.end_map):
        nres, goal = agent.maps[m], memory.goals[desire.first_goal + int(m - node.first_map)]
        for t in range(nres.first_track, nres.end_track):
            if memory.tracks[t].cell >= 0:
                add_value(agent, memory, node, nres, memory.tracks[t].cell, goal, valence, desire.q)


@inlined_kernel
def add_tracked(agent, memory, node, thing, valence, q):
    """Add the values of the contact with a thing that has a track in every map of a node."""
    for m in range(node.first_map, node.end_map):
        nres = agent.maps[m]
        cell = memory.tracks[nres.first_track + thing].cell
        if counts(agent, memory, nres, cell):
            add_contact(agent, memory, node, nres, cell, valence, q)


@inlined_kernel
def face(agent, scene, node, desire, thing):
    """Write the vector of an element, as the node follows it, into agent.offset: of a landing, a place, or a thing."""
    for axis in range(agent.here.shape[0]):
        here = agent.here[axis]
        if desire.source == Source.node:
            offset = desire.target_at[axis]
        elif desire.source == Source.place:
            offset = desire.place[axis] - here
        else:
            offset = scene.things[thing, axis] / agent.size - here
        agent.offset[axis] = offset + here if node.follows == Vector.position else offset


@inlined_kernel
def add_element(agent, memory, scene, user, node, valence, q):
    """Add the values of an element in every map of a node; agent.offset is its vector, as followed by the node."""
    has_direction, coordinates = True, agent.offset
    if not node.is_cartesian:
        has_direction, _ = locate(agent, memory, scene, user, node, 0, True)
        coordinates = agent.coordinates
    of_agent = node.follows == Vector.position or node.follows == Vector.velocity
    if of_agent and not has_direction:
        return
    for m in range(node.first_map, node.end_map):
        nres = agent.maps[m]
        cell = cell_within(agent, memory, node, nres, coordinates)
        if not counts(agent, memory, nres, cell):
            continue
        if of_agent:
            add_goals(agent, memory, node, nres, memory.tracks[nres.first_track].cell, cell, valence, q)
        elif node.state == MapState.object:
            add_contact(agent, memory, node, nres, cell, valence, q)
        else:
            add_value(agent, memory, node, nres, nres.contact, cell, valence, q)


@inlined_kernel
def counts(agent, memory, nres, cell):
    """Whether an element in a cell of a map counts beside those of its desire that came before it."""
    if not agent.shared_cell_counts_once or cell < 0:
        return True
    place = nres.first_cell + cell
    is_first = memory.counted[place] != agent.evaluation
    memory.counted[place] = agent.evaluation
    return is_first


@inlined_kernel
def add_contact(agent, memory, node, nres, cell, valence, q):
    """Add the values of a thing's contact with the agent, or of every cell that the contact reaches."""
    if node.reach == 0.0 or cell < 0:
        add_goals(agent, memory, node, nres, cell, contact_cell(nres, cell), valence, q)
        return
    # Σ_i Q_i(s, a) over the cells i of a box around distance 0, which one number counts along all axes.
    boxes = 1
    for axis in range(node.axes):
        cut = memory.cuts[nres.first_cut + axis]
        boxes *= int(interval_at(cut, node.reach) - interval_at(cut, -node.reach)) + 1
    for box in range(boxes):
        goal, rest = 0, box
        for axis in range(node.axes):
            cut = memory.cuts[nres.first_cut + axis]
            lowest = int(interval_at(cut, -node.reach))
            side = int(interval_at(cut, node.reach)) - lowest + 1
            goal += int(cut.stride) * (lowest + rest % side)
            rest //= side
        add_value(agent, memory, node, nres, cell, goal, valence, q)


@inlined_kernel
def add_goals(agent, memory, node, nres, cell, goal, valence, q):
    """Add the values of all goals that differ from one only along axes on which an element has no place."""
    if nres.followed == nres.cells:  # the usual case, without a loop
        add_value(agent, memory, node, nres, cell, goal, valence, q)
    elif goal >= 0:
        for other in range(goal % nres.followed, nres.cells, nres.followed):
            add_value(agent, memory, node, nres, cell, other, valence, q)


@inlined_kernel
def add_value(agent, memory, node, nres, cell, goal, valence, q):
    """Q(a) += weight w_i Q_i(s, a) for each action: a goal's values in a cell, by the map's weight and its valence."""
    if cell >= 0 and goal >= 0 and (goal != cell or agent.own_cell_counts):
        weight, order = nres.weight * valence, order_of(agent, nres)
        if node.state != MapState.object:
            cell, goal = goal, 0  # the only state is the centre, so the values are found by the goal
        place = place_of(nres.first_value, order, cell, goal)
        for action in range(agent.action_value.shape[0]):
            q[action] += weight * memory.q[place + np.uint64(action) * order.action]


@inlined_kernel
def learn_worth(agent, scene):
    """Learn, for desires, the worth of kinds of things from the rewards on meeting them (Rescorla and Wagner 1972).

    The reward of a step beyond the worths of the things met in it updates the worth of each of their kinds, at the rate
    1 / n for the n-th meeting, or a tenth if that is higher. All desires that learn the worth of a kind have one.
    """
    # V_k ← V_k + max(1 / n_k, 0.1) (r − Σ V), summed over the things met
    if not agent.learns:
        return
    surprise = agent.reward
    for e in range(agent.n_desires):
        desire = agent.desires[e]
        if desire.learned and desire.worth_of == e:
            for thing in range(scene.met.shape[0]):
                if scene.met[thing] == desire.kind + 1:
                    surprise -= desire.worth
    for e in range(agent.n_desires):
        desire = agent.desires[e]
        if desire.learned and desire.worth_of == e:
            for thing in range(scene.met.shape[0]):
                if scene.met[thing] == desire.kind + 1:
                    desire.meetings += 1
                    desire.worth += max(0.1, 1.0 / desire.meetings) * surprise
        elif desire.learned:  # after the desire that it reads
            desire.worth = agent.desires[desire.worth_of].worth
            desire.meetings = agent.desires[desire.worth_of].meetings
