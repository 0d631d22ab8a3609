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
5. Of all things of positive worth, the one whose approach is worth most counts in full, and each of the others by the
   share `rivals`. Fears add up.
6. An agent with an *efference copy* knows what its own push adds to its velocity. Its values are then those of
   *after-states* (Sutton and Barto 2018, section 6.8) in place of actions: of the cell in which a thing is seen once
   the push is given. An after-state has one approach and one fear, whichever action led to it. An axis with a kernel of
   the user's own represents the velocity before the push.
7. Such an agent can *look ahead*. The approach of an action is then a mean over 0 … n steps of coasting after the push:
   of the after-state, and, for each later moment, of the best of those that one more push would lead to there,
   discounted. Of all motion, only the agent's own is foreseen, in a straight line.

`scene` is what the agent perceives of its world (`neorl.core.scene.Scene`).
"""

import math

import numpy as np

from neorl.core.choices import Source
from neorl.core.functions import UserFunctions
from neorl.core.geometry import cell_of, locate
from neorl.core.layout import ENTRIES, Memory, Record
from neorl.core.scene import ABSENT, Scene
from neorl.kernels.kernel import inlined_kernel, kernel

APPROACH, FEAR, VISITS = range(3)
MOST_VISITS = 1e6  # counted at most; a count is a float32


@inlined_kernel
def mirror(agent, node):
    """Mirror agent.coordinates so that those of the first vector are ≥ 0 and descending; return the frame's number.

    Vectors follow one another in the coordinates, with a component along every axis of the world. Where a component is
    0, that of the next vector decides the sign.
    """
    coordinates, axes, end = agent.coordinates, agent.here.shape[0], int(node.axes)
    frame, flips, orders = 0, 1, 1
    for axis in range(axes):
        sign, place = 0.0, axis
        while place < end and sign == 0.0:
            sign = coordinates[place]
            place += axes
        if sign < 0.0:
            frame += flips
            for place in range(axis, end, axes):
                coordinates[place] = -coordinates[place]
        flips *= 2
    # Selection sort; its exchanges, as digits of descending bases, number the orders.
    for axis in range(axes - 1):
        longest = axis
        for other in range(axis + 1, axes):
            if coordinates[other] > coordinates[longest]:
                longest = other
        for place in range(0, end, axes):
            held = coordinates[place + axis]
            coordinates[place + axis] = coordinates[place + longest]
            coordinates[place + longest] = held
        frame += flips * orders * (longest - axis)
        orders *= axes - axis
    return frame


@kernel
def see(agent, memory, scene, user, node, point, from_offset):
    """Find the cell of a point in every map of a node, into agent.seen; return the frame. See `geometry.locate`."""
    locate(agent, memory, scene, user, node, point, from_offset)
    frame = mirror(agent, node) if node.mirrored else 0
    for m in range(node.first_map, node.end_map):
        agent.seen[m] = cell_of(memory, node, agent.maps[m], agent.coordinates)
    return frame


@inlined_kernel
def entry_of(nres, cell, event):
    """The index in q of the values of an event in a cell of a map."""
    return np.uint64(nres.first_value + (cell * nres.events + event) * ENTRIES)


@kernel
def blended(agent, memory, node, event, which):
    """The approach or fear of an event in the cells of agent.seen, blended over all maps of a node."""
    # V += n / (n + familiarity) (V_m − V), from the coarsest map to the finest.
    q, first = memory.q, node.first_map
    value = np.float64(q[entry_of(agent.maps[first], agent.seen[first], event) + which])
    for m in range(node.first_map + np.uint64(1), node.end_map):
        entry = entry_of(agent.maps[m], agent.seen[m], event)
        visits = np.float64(q[entry + np.uint64(VISITS)])
        if visits > 0.0:
            own = np.float64(q[entry + which])
            value += visits / (visits + agent.contacts.familiarity) * (own - value)
    return value


@inlined_kernel
def see_after(agent, memory, scene, user, node, point, action, from_offset):
    """Find the cells of a point once the push of an action is given, into agent.seen."""
    for axis in range(agent.here.shape[0]):
        agent.efferent[axis] = agent.contacts.efference * agent.push[action, axis]
    see(agent, memory, scene, user, node, point, from_offset)
    for axis in range(agent.here.shape[0]):
        agent.efferent[axis] = 0.0


@inlined_kernel
def follow_after(agent, memory, node, point, action):
    """Keep the cells of agent.seen as those of a point once the push of an action is given."""
    for m in range(node.first_map, node.end_map):
        memory.after[agent.maps[m].first_track + point, action] = agent.seen[m]


@inlined_kernel
def enter_after(agent, memory, node, point, action):
    """Move the tracks of a point to the cells that they are in once the push of an action is given."""
    for m in range(node.first_map, node.end_map):
        t = agent.maps[m].first_track + point
        memory.tracks[t].cell = memory.after[t, action]


@inlined_kernel
def see_track(agent, memory, node, point, action):
    """Copy the cells of a point whose values are those of an action to agent.seen."""
    for m in range(node.first_map, node.end_map):
        t = agent.maps[m].first_track + point
        agent.seen[m] = memory.after[t, action] if agent.contacts.after_states > 0 else memory.tracks[t].cell


@inlined_kernel
def follow(agent, memory, node, point, frame, absent):
    """Move the tracks of a point to the cells of agent.seen, or to none if it is absent."""
    for m in range(node.first_map, node.end_map):
        track = memory.tracks[agent.maps[m].first_track + point]
        track.cell, track.frame = ABSENT if absent else agent.seen[m], frame


@inlined_kernel
def forget_left(agent, memory, node, point):
    """Forget which actions a point's tracks have come by."""
    for m in range(node.first_map, node.end_map):
        memory.tracks[agent.maps[m].first_track + point].left = 0


@kernel
def begin_contacts(agent: Record, memory: Memory, scene: Scene, user: UserFunctions, n: int, point: int) -> None:
    """Start the tracks of a point at its present place, without a history."""
    node = agent.nodes[n]
    for action in range(agent.contacts.after_states):
        see_after(agent, memory, scene, user, node, point, action, False)
        follow_after(agent, memory, node, point, action)
    frame = see(agent, memory, scene, user, node, point, False)
    follow(agent, memory, node, point, frame, scene.kinds[point] < 0)
    forget_left(agent, memory, node, point)


@kernel
def observe_contacts(agent: Record, memory: Memory, scene: Scene, user: UserFunctions, n: int, point: int) -> None:
    """Learn, in the maps of a node, from the effect of the last step on one thing, and follow the thing."""
    node, contacts, event = agent.nodes[n], agent.contacts, agent.last_event
    first = memory.tracks[agent.maps[node.first_map].first_track + point]
    met, absent, of_after_states = scene.met[point] != 0, scene.kinds[point] < 0, contacts.after_states > 0
    learns = agent.learns and event < agent.rates.shape[0] and first.cell >= 0 and (met or not absent)
    if of_after_states and learns:
        enter_after(agent, memory, node, point, event)
    # The outcome: 1 for a contact, else γ max_a approach(s⁺, a) and γ min_a fear(s⁺, a).
    frame, approach, fear = 0, 0.0, np.inf
    if not of_after_states:
        frame = see(agent, memory, scene, user, node, point, False)
    for action in range(agent.rates.shape[0]):
        if of_after_states:
            see_after(agent, memory, scene, user, node, point, action, False)
            follow_after(agent, memory, node, point, action)
        if learns and not met:
            valued = 0 if of_after_states else action
            approach = max(approach, blended(agent, memory, node, valued, np.uint64(APPROACH)))
            fear = min(fear, blended(agent, memory, node, valued, np.uint64(FEAR)))
    if learns:
        approach, fear = (1.0, 1.0) if met else (contacts.discount * approach, contacts.discount * fear)
        learn_step(agent, memory, node, point, 0 if of_after_states else memory.frames[first.frame, event],
                   approach, fear)
        if met:
            for m in range(node.first_map, node.end_map):
                remember_back(contacts, memory, agent.maps[m].first_track + point)
    follow(agent, memory, node, point, frame, absent)
    if met or absent or not agent.learns:
        forget_left(agent, memory, node, point)


@inlined_kernel
def learn_step(agent, memory, node, point, event, approach, fear):
    """Move the values of an event, in the cells that a thing was in, towards its outcome."""
    q, contacts = memory.q, agent.contacts
    coarser, feared = 0.0, 0.0
    # Q_m(s⁻, a) += max(α, (n + 2)^(−3/4)) (outcome − Q_m(s⁻, a)); an event not seen yet begins with the coarser blend.
    for m in range(node.first_map, node.end_map):
        t = agent.maps[m].first_track + point
        track = memory.tracks[t]
        entry = entry_of(agent.maps[m], track.cell, event)
        old, old_fear = np.float64(q[entry + np.uint64(APPROACH)]), np.float64(q[entry + np.uint64(FEAR)])
        visits = np.float64(q[entry + np.uint64(VISITS)])
        if m == node.first_map:
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
        memory.left[t, track.left % memory.left.shape[1]] = entry
        track.left += 1


@kernel
def remember_back(contacts, memory, t):
    """Raise the approach of the actions that led to a contact, backwards from the last but one."""
    q, left, count, worth = memory.q, memory.left, memory.tracks[t].left, 1.0
    # approach_k += trace rate · (γᵏ − approach_k) where γᵏ is higher, of the action k steps before the last.
    for back in range(2, min(count, left.shape[1]) + 1):
        worth *= contacts.discount
        entry = np.uint64(left[t, (count - back) % left.shape[1]])
        value = np.float64(q[entry])
        if worth > value:
            q[entry] = np.float32(value + contacts.trace_rate * (worth - value))


@kernel
def look_ahead(agent, memory, scene, user, node, point, action, from_offset, value):
    """The approach of an action, with that of coasting after it and one more push later: see rule 7 of this module.

    value: the approach of its after-state.
    """
    # (V(y₀) + Σ_k γᵏ max_b V(y_k(b))) / (n + 1) for k = 1 … n
    contacts, axes, worth = agent.contacts, agent.here.shape[0], 1.0
    for _ in range(contacts.lookahead):
        worth *= contacts.discount
        best = 0.0
        for axis in range(axes):
            velocity = scene.velocity[axis] / agent.size + contacts.efference * agent.push[action, axis]
            agent.ahead[axis] += velocity * contacts.step
        for later in range(agent.rates.shape[0]):
            for axis in range(axes):
                agent.efferent[axis] = contacts.efference * (agent.push[action, axis] + agent.push[later, axis])
            see(agent, memory, scene, user, node, point, from_offset)
            best = max(best, blended(agent, memory, node, 0, np.uint64(APPROACH)))
        value += worth * best
    for axis in range(axes):
        agent.ahead[axis] = agent.efferent[axis] = 0.0
    return value / (contacts.lookahead + 1)


@kernel
def evaluate_contacts(agent: Record, memory: Memory, scene: Scene, user: UserFunctions, n: int) -> None:
    """Compute the contributions of a node's desires to its Q-vector: see rule 5 of this module."""
    node, contacts, actions, axes = agent.nodes[n], agent.contacts, agent.rates.shape[0], agent.here.shape[0]
    of_after_states = contacts.after_states > 0
    # Q(a) = Σ w approach(a) + caution Σ w fear(a), approaches other than the best thing's times `rivals`.
    most, best = -1.0, -1
    for i in range(node.first_input, node.end_input):
        e = agent.inputs[i]
        desire = agent.desires[e]
        desire.total_valence = 0.0
        for action in range(actions):
            desire.q[action] = 0.0
        worth = desire.target_valence if desire.source == Source.node else desire.worth
        of_kind = desire.source == Source.kind
        for thing in range(scene.kinds.shape[0] if of_kind else 1):
            frame = 0
            if of_kind:
                first = memory.tracks[agent.maps[node.first_map].first_track + thing]
                # A user may make an absent thing present between two steps.
                if scene.kinds[thing] != desire.kind or first.cell < 0:
                    continue
                frame = first.frame
                see_track(agent, memory, node, thing, 0)
            else:
                for axis in range(axes):
                    agent.offset[axis] = (desire.target_at[axis] if desire.source == Source.node else
                                          desire.place[axis] - agent.here[axis])
                frame = see(agent, memory, scene, user, node, 0, True)
            desire.total_valence += worth
            which = np.uint64(FEAR) if worth < 0.0 and contacts.flees else np.uint64(APPROACH)
            highest = -1.0
            for action in range(actions):
                valued = 0
                if not of_after_states:
                    valued = memory.frames[frame, action]
                elif of_kind:
                    see_track(agent, memory, node, thing, action)
                else:
                    see_after(agent, memory, scene, user, node, 0, action, True)
                value = blended(agent, memory, node, valued, which)
                if contacts.lookahead > 0 and which == APPROACH:
                    value = look_ahead(agent, memory, scene, user, node, thing, action, not of_kind, value)
                agent.rival[action] = worth * value
                highest = max(highest, agent.rival[action])
            if worth < 0.0:
                for action in range(actions):
                    desire.q[action] += contacts.caution * agent.rival[action]
            elif highest > most:
                if best >= 0:  # the previous best counts as a rival from now on
                    for action in range(actions):
                        agent.desires[best].q[action] -= (1.0 - contacts.rivals) * agent.favourite[action]
                most, best = highest, e
                for action in range(actions):
                    desire.q[action] += agent.rival[action]
                    agent.favourite[action] = agent.rival[action]
            elif contacts.rivals > 0.0:
                for action in range(actions):
                    desire.q[action] += contacts.rivals * agent.rival[action]
