"""The loop of an agent, step by step: choose, act, perceive, learn.

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
8. An agent that does not learn follows all points as ever. What it passes then is not remembered.

In `notebooks/companion/one_file.py`, this is the loop of `simulate`, `perceive` in section 4, and
`learn_transition` in section 5. `scene` is what the agent perceives of its world (`neorl.core.scene.Scene`).
"""

from neorl.core.choices import Credit, MapState, UpdateOn, Vector
from neorl.core.functions import AgentFunctions
from neorl.core.geometry import cell_within, contact_cell, locate, with_kept_directions
from neorl.core.layout import Memory, Record
from neorl.core.learning import (UNIT, ZERO, enter, learn_all_goals, learn_one_goal, order_of, rate_events, rule_of,
                                 values_of)
from neorl.core.network import choose, evaluate, learn_worth
from neorl.core.scene import ABSENT, Scene
from neorl.core.trace import fade, forget_all, join, learn_remembered, trace_of
from neorl.kernels.kernel import inlined_kernel, kernel


@kernel
def act(agent: Record, memory: Memory, scene: Scene, functions: AgentFunctions) -> int:
    """Choose an action."""
    action = choose(agent, memory, scene, functions)
    agent.last_event = action
    return action


@kernel
def observe(agent: Record, memory: Memory, scene: Scene, functions: AgentFunctions) -> None:
    """Perceive the outcome of the last action, and learn from it."""
    take(agent, memory)
    for n in range(agent.n_nodes):
        node = agent.nodes[n]
        for point in range(node.points):
            if node.learns_contacts:
                functions.observe_contacts(agent, memory, scene, functions.user, n, point)
            elif node.state != MapState.object:
                functions.observe_self(agent, memory, scene, functions.user, n, point)
            else:
                perceive(agent, memory, scene, functions.user, node, point)
    learn_worth(agent, scene)


@inlined_kernel
def take(agent, memory):
    """Record the last action as an event in the active cell of every track."""
    action, learning = agent.last_event, agent.learning
    for t in range(memory.events.shape[0]):
        memory.events[t, action] += 1
    if learning.credit == Credit.activity or learning.credit == Credit.own:
        for event in range(agent.activity.shape[0]):
            agent.activity[event] *= learning.activity_retained
            agent.activity[event] += UNIT - learning.activity_retained if event == action else ZERO


@inlined_kernel
def perceive(agent, memory, scene, user, node, point):
    """Find the active cell of a point in every map of a node, and learn if it has changed or an update is due."""
    things = node.follows == Vector.objects
    met = things and scene.met[point] != 0
    _, all_have_directions = locate(agent, memory, scene, user, node, point, False)
    for m in range(node.first_map, node.end_map):
        nres = agent.maps[m]
        t = nres.first_track + point
        cell_tm1, cell = memory.tracks[t].cell, cell_within(agent, memory, node, nres, agent.coordinates)
        if things and scene.kinds[point] < 0:
            cell = ABSENT
        ends = met or cell < 0 or cell_tm1 < 0
        if not (all_have_directions or ends):
            cell = with_kept_directions(memory, node, nres, agent.coordinates, cell, cell_tm1)
        arrives = met and cell_tm1 >= 0
        cell_t = contact_cell(nres, cell_tm1) if arrives else cell
        if (arrives or not ends) and (cell_t != cell_tm1 or agent.learning.update_on == UpdateOn.step):
            if agent.learns:
                learn_transition(agent, memory, user, nres, point, cell_t)
                enter(memory, t, cell_t)
            else:
                start_track(agent, memory, nres, point, cell_t)
        if ends:
            start_track(agent, memory, nres, point, cell)


@inlined_kernel
def learn_transition(agent, memory, user, nres, point, cell_t):
    """Learn from a track's change of cell s⁻ → s⁺ (one file: `learn_transition`)."""
    learning, rates, t = agent.learning, agent.rates, nres.first_track + point
    track = memory.tracks[t]
    cell_tm1 = track.cell
    rule, values, order = rule_of(learning), values_of(agent, memory, nres), order_of(agent, nres)
    trace = trace_of(agent, memory, nres, point)
    rate_events(agent, memory, user, t)
    if learning.bootstrap:
        learn_all_goals(values, rule, cell_tm1, cell_t, rates)
    if learning.memory_retained > ZERO:
        track.remembered = fade(trace, track.remembered, learning.memory_retained, learning.discount)
        if learning.bootstrap:  # the cell has already learned by bootstrapping, so it joins afterwards
            learn_remembered(values, order, rule, trace, track.remembered, cell_t)
        track.remembered = join(trace, track.remembered, cell_tm1, rates, rule.absent_rate, UNIT, UNIT)
        if not learning.bootstrap:
            learn_remembered(values, order, rule, trace, track.remembered, cell_t)
    elif not learning.bootstrap:
        learn_one_goal(values, order, rule, cell_tm1, cell_t, rates)


@inlined_kernel
def start_track(agent, memory, nres, point, cell):
    """Start the track of a point in a cell, without a memory."""
    t = nres.first_track + point
    enter(memory, t, cell)
    if memory.tracks[t].remembered > 0:
        forget_all(trace_of(agent, memory, nres, point), memory.tracks[t].remembered)
        memory.tracks[t].remembered = 0


@kernel
def begin(agent: Record, memory: Memory, scene: Scene, functions: AgentFunctions) -> None:
    """Start all tracks in their present cells, without a history, and clear the desires."""
    for n in range(agent.n_nodes):
        for point in range(agent.nodes[n].points):
            begin_point(agent, memory, scene, functions, n, point)
    for event in range(agent.activity.shape[0]):
        agent.activity[event] = ZERO
    for e in range(agent.n_desires):
        desire = agent.desires[e]
        desire.total_valence = 0.0
        for action in range(desire.q.shape[0]):
            desire.q[action] = 0.0


@kernel
def imagine(agent: Record, double: Record, memory: Memory, there: Scene, functions: AgentFunctions) -> None:
    """Evaluate the desires of an agent as if it were in another scene, into those of its double.

    double, memory: those of the agent, with tracks of their own.
    """
    begin(double, memory, there, functions)
    for e in range(agent.n_desires):  # recursion uses the agent's own of the last choice
        double.desires[e].total_valence = agent.desires[e].total_valence
        double.desires[e].worth = agent.desires[e].worth
        for action in range(agent.action_value.shape[0]):
            double.desires[e].q[action] = agent.desires[e].q[action]
    evaluate(double, memory, there, functions)


@inlined_kernel
def begin_point(agent, memory, scene, functions, n, point):
    """Start the tracks of a point at its present place."""
    node = agent.nodes[n]
    if node.learns_contacts:
        functions.begin_contacts(agent, memory, scene, functions.user, n, point)
        return
    if node.state != MapState.object:
        functions.begin_self(agent, memory, scene, functions.user, n, point)
        return
    locate(agent, memory, scene, functions.user, node, point, False)
    absent = node.follows == Vector.objects and scene.kinds[point] < 0
    for m in range(node.first_map, node.end_map):
        nres = agent.maps[m]
        cell = cell_within(agent, memory, node, nres, agent.coordinates)
        start_track(agent, memory, nres, point, ABSENT if absent else cell)
