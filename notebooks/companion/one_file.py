"""The agent of the thesis in one file of plain Python, which every run of the kernels equals to the last bit.

`neorl.Agent` says as data which agent it is, and a `neorl.World` moves it. What the agent does is all here:

1. The agent perceives a scene. Each vector that a node follows activates one cell in each of the node's maps.
2. Q_i(s, a), ``q[s, a, i]``, is the value of action a in cell s for reaching cell i. Elements of interest select value
   functions, which add up with their valences w: Q(s, a) = Σ w_i Q_i(s, a) (eq. 4.3, 4.4). The values of a node, as a
   vector, can be an element of interest for the next node (paper C).
3. The action of highest value is taken.
4. Values are learned when the active cell changes, s⁻ + e → s⁺ (eq. 4.5), for all goals i, desired or not.
5. Event a has the rate α_a = ψ_a α (eq. 4.7), and moves (eq. 4.8; R_i is 1 if i is s⁺, and 0 otherwise)
   Q_i(s⁻, a) ← Q_i(s⁻, a) + α_a (R_i + γ max Q_i(s⁺, ·) − Q_i(s⁻, a)).
   The value of an event that did not occur sinks, by ψ(0). Cells left earlier may learn too, at rates that fade.

In a map whose state is the self, always at its centre, there is no s: a goal is where one's own motion leads (paper B).
The file covers the papers' agents, in a plane with four actions. Like the kernels, it learns in single precision.
"""

import math

import numpy as np

from neorl import Place, Scene
from neorl.custom import execute, turn

ONE, ZERO, N, S, E, W, NO_OP = np.float32(1), np.float32(0), *range(5)


def simulate(agent, world, steps, seed=0, run=0):
    """One run from its first step: rewards, float64 (steps,), and the values of each map, float32 q[s, a, i]."""
    sequence = np.random.SeedSequence(seed).spawn(run + 1)[run]
    rng = np.random.Generator(np.random.SFC64(sequence.spawn(1)[0]))
    state, rule, rewards, done = world.reset(sequence), agent.learning, np.zeros(steps), True
    scene = see(world, state)
    maps = [Map(node, n) for node in agent.nodes for n in node.resolutions]
    keep = np.float32(rule.activity * world.fps / (1 + rule.activity * world.fps))
    for t in range(steps):
        if t == 0 or done and agent.resets == "noticed":  # an episode begins, with what was learned in those before
            activity = np.zeros(4, np.float32)
            pulls = [(np.zeros(4), 0.0) for _ in agent.desires]
            for nres in maps:
                nres.tracks = [Track(nres, vector) for vector in followed(nres.node, scene)]
        action = choose(agent, scene, maps, pulls, rng)
        rewards[t], _, done = world.step(state, action)
        activity = keep * activity + (ONE - keep) * (np.arange(4) == action).astype(np.float32)
        scene = see(world, state)
        for nres in maps:
            perceive(rule, nres, scene, action, activity)
        if done:
            execute(world.dynamics.reset, state, world.rules)
            scene = see(world, state)
    return rewards, [nres.q for nres in maps]


# 1. From the scene to active cells

def see(world, state):
    """The scene, in units of the world's size and with the names of kinds."""
    position, velocity, things, kinds, met = state.scene
    names = [world.kinds[kind] for kind in kinds]
    return Scene(position / world.size, velocity / world.size, things / world.size, names, met)


def followed(node, scene):
    """The vectors that a node follows, one for each point."""
    (x, y), here, modality = scene.position, scene.position, node.modality
    return {"position": [here], "velocity": [scene.velocity], "objects": [thing - here for thing in scene.things],
            "landmarks": [np.array(landmark) - here for landmark in modality.landmarks],
            "boundaries": [(-x, 0.0), (0.0, -y), (1.0 - x, 0.0), (0.0, 1.0 - y)],
            "self": [here], "per object": [-(thing - here) for thing in scene.things],  # the self as each thing sees it
            }[modality.follows if node.state == "object" else node.state]


class Map:
    """A map of a node: how it cuts its axes, what it has learned, and the tracks of the points that it follows."""

    def __init__(self, node, n):
        power = ["equal", "resolution", "cells"].index(node.weighting)
        self.weight = float(n) ** power / sum(float(each) ** power for each in node.resolutions)
        self.node, self.axes, self.cuts = node, node.modality.axes, [cut(axis, n) for axis in node.modality.axes]
        cells = math.prod(intervals for _, _, intervals in self.cuts)
        self.q = np.zeros((cells if node.state == "object" else 1, 4, cells), np.float32)

    def active(self, vector, cell_tm1=None):
        """The one active cell, or None beyond the range of a map that ends there."""
        point = self.coordinates(vector)
        inside = all(axis.closed or axis.low <= x <= axis.high for axis, x in zip(self.axes, point))
        return self.cell(point, cell_tm1) if inside or self.node.beyond == "outermost" else None

    def contact(self, cell_tm1=None):
        """The cell at distance 0."""
        return self.cell(self.coordinates((0.0, 0.0)), cell_tm1)

    def coordinates(self, vector):
        return [coordinate(axis, *vector) for axis in self.axes]

    def cell(self, point, cell_tm1=None):
        """The cell at a point; where the point has no direction, at distance 0 or at rest, that of the cell before."""
        cell, stride = 0, 1
        for k, x in enumerate(point):
            intervals = self.cuts[k][2]
            cell += stride * (self.interval(k, x) if x is not None else (cell_tm1 or 0) // stride % intervals)
            stride *= intervals
        return cell

    def interval(self, k, x):
        """The interval of axis k that contains x, or the outermost one beyond the range."""
        low, scale, intervals = self.cuts[k]
        found = math.floor((x - low) * scale)
        return found % intervals if self.axes[k].is_direction else min(max(found, 0), intervals - 1)


def cut(axis, n):
    """How a map cuts an axis: where the first interval begins, intervals per unit, and their number."""
    n = axis.intervals or n
    low, high = (-0.5 / n, 1.0 - 0.5 / n) if axis.is_direction else (axis.low, axis.high)
    scale = n / (high - low)
    return (low - 0.5 / scale, scale, n + 1) if axis.centred and n % 2 == 0 else (low, scale, n)


def coordinate(axis, x, y):
    """The feature of a vector that an axis measures; None for the direction of a vector of length 0."""
    if axis.feature == "length":
        return math.sqrt(x * x + y * y)
    if axis.feature == "direction":
        return execute(turn, x, y) if x or y else None
    component = (x, y)[axis.along]
    if axis.feature == "margin":  # how far it reaches into the margin along a wall
        return min(component - axis.high, 0.0) if component < 0.5 else max(component - (1.0 - axis.high), 0.0)
    return component


# 2. From elements of interest to the values of actions

def values(agent, scene, maps, pulls):
    """Q(s, ·) (eq. 4.3). pulls: (values, valence) of each desire in the step before, which are updated."""
    value, nodes = np.zeros(4), {node.name: node for node in agent.nodes}
    for node in map(nodes.get, agent.evaluation_order):
        found = {e: elements(agent, desire, scene, pulls) for e, desire in enumerate(agent.desires)
                 if desire.target == node.name}  # all before any is updated, for recursion
        for e in found:
            pull, counted = np.zeros(4), []
            for element, w, k in found[e]:
                for nres in (each for each in maps if each.node is node):
                    pairs = selected(nres, element, scene, k)
                    if agent.shared_cell == "once" and (nres, pairs) in counted:
                        continue
                    counted.append((nres, pairs))
                    for s, i in pairs:
                        if s != i or agent.own_cell == "counts":
                            q = nres.q[s if node.state == "object" else 0, :, i]
                            pull += nres.weight * w * q.astype(float)  # w_i Q_i(s, ·)
            pulls[e] = pull, sum(w for _, w, _ in found[e])
            value += node.gain * pull
    return value


def selected(nres, element, scene, k):
    """The pairs (s, i) of cells by which an element, or thing k, selects Q_i(s, ·) (eq. 4.4)."""
    follows, tracks = nres.node.modality.follows, [track for track in nres.tracks if track.cell is not None]
    if isinstance(element, tuple):  # a point, with directions in radians
        point = [x / math.tau % 1.0 if axis.is_direction else x for x, axis in zip(element, nres.axes)]
        return [(track.cell, nres.cell(point)) for track in tracks]
    vector = scene.position + element if follows == "position" else element
    follows_it = follows == "objects" and nres.node.state == "object" and k is not None
    cell = nres.tracks[k].cell if follows_it else nres.active(vector)
    if cell is None:
        return []
    if follows in ("position", "velocity"):  # s: the agent, i: the element
        return [] if None in nres.coordinates(vector) else [(track.cell, cell) for track in tracks]
    if nres.node.state != "object":  # s: the agent at the centre, i: the element
        return [(nres.contact(), cell)]
    if not nres.node.reach:  # s: the element, i: contact
        return [(cell, nres.contact(cell))]
    reach = nres.node.reach  # i: every cell that the contact reaches
    columns, rows = (range(nres.interval(k, -reach), nres.interval(k, reach) + 1) for k in (0, 1))
    return [(cell, row * nres.cuts[0][2] + column) for row in rows for column in columns]


def elements(agent, desire, scene, pulls):
    """The elements of a desire: [(vector from the agent, or point in the node's own space, valence, thing), …]."""
    if isinstance(desire.source, tuple):
        return [(desire.source, desire.valence, None)]
    if isinstance(desire.source, Place):
        return [(np.array(desire.source.coordinates) - scene.position, desire.valence, None)]
    if not agent.comes_from_node(desire):
        return [(thing - scene.position, desire.valence, k)
                for k, (thing, kind) in enumerate(zip(scene.things, scene.kinds)) if kind == desire.source]
    vector, valence = np.zeros(2), 0.0
    for other, (q, w) in zip(agent.desires, pulls):
        if other.target == desire.source and (not desire.of or other.source in desire.of):
            towards = np.array([q[E] - q[W], q[S] - q[N]])  # y points down
            vector += towards if desire.signed or w > 0 else -towards
            valence += w
    return [(desire.scale * vector, valence if desire.valence is None else desire.valence, None)]


# 3. From values to an action

def choose(agent, scene, maps, pulls, rng):
    """The action of highest value, ties broken at random; with probability ε any action."""
    if agent.policy.exploration > 0 and rng.random() < agent.policy.exploration:
        return int(rng.random() * 4)
    value = values(agent, scene, maps, pulls)
    if agent.policy.when_indifferent == "no-op" and not value.any():
        return NO_OP
    best = np.flatnonzero(value == value.max())
    return int(best[int(rng.random() * len(best))] if len(best) > 1 else best[0])


# 4. From an action to a change of cell

class Track:
    """A point that a map follows: its cell s⁻, the events since it entered, and the cells that it remembers."""

    def __init__(self, nres, vector):
        self.cell, self.events = nres.active(vector) if nres.node.state == "object" else nres.contact(), []
        self.memory = {}  # {cell: (strength, weights, worths)}, see `join`
        self.centre, self.passed = vector, []  # of the self: where its map is centred, [(centre, rates), …] before


def perceive(rule, nres, scene, action, activity):
    """Follow every point of a map, and learn if its cell has changed."""
    of_object, scales = nres.node.state == "object", [scale for _, scale, _ in nres.cuts]
    for k, (track, vector) in enumerate(zip(nres.tracks, followed(nres.node, scene))):
        track.events.append(action)
        met = nres.node.modality.follows == "objects" and nres.node.state != "self" and scene.met[k]
        if of_object and track.cell is not None:
            cell_t = nres.contact(track.cell) if met else nres.active(vector, track.cell)
            if cell_t is not None and (cell_t != track.cell or rule.update_on == "step"):
                learn_transition(rule, nres.q, track, cell_t, rates_of(rule, track.events, activity))
            track.cell = cell_t
        elif not of_object and not met and any(abs((vector - track.centre) * scales) >= 0.5):  # half a cell
            learn_motion(rule, nres, track, vector, rates_of(rule, track.events, activity))
        if met or track.cell is None:  # the leap to a fresh thing is no transition
            nres.tracks[k] = Track(nres, vector)


# 5. From a change of cell to new values

def rates_of(rule, events, activity):
    """α_a = ψ_a α (eq. 4.7): float32 (2, 4), of events that occurred, and of those that did not."""
    alpha, count = np.float32(rule.learning_rate), np.array([events.count(a) for a in range(4)], np.float32)
    psi = {"share": count / np.float32(len(events)), "count": count, "happened": np.minimum(count, ONE),
           "last": (np.arange(4) == events[-1]).astype(np.float32),
           "activity": np.where(activity < np.float32(0.01), ZERO, activity)}[rule.credit]
    rates = np.minimum(alpha * psi, ONE)
    return np.array([rates, np.where(rates > 0, ZERO, alpha * np.float32(rule.absent_decay))])


def learn_transition(rule, q, track, cell_t, rates):
    """Learn from s⁻ → s⁺ about every goal, and in the cells remembered about s⁺."""
    if rule.bootstrap:
        q[track.cell] = bootstrapped(rule, q[track.cell], q[cell_t].max(axis=0), cell_t, rates)
    keep, gamma = np.float32(rule.memory / (1 + rule.memory)), np.float32(rule.discount)
    track.memory = {cell: (strength * keep, weights * keep, positive(worths * keep * gamma))
                    for cell, (strength, weights, worths) in track.memory.items()
                    if strength * keep >= np.float32(1e-4)}
    if not rule.bootstrap:
        join(track.memory, track.cell, rates)
    for cell, trace in track.memory.items():
        q[cell, :, cell_t] = remembered(rule, q[cell, :, cell_t], *trace)
    if rule.bootstrap:  # it has learned already, by bootstrapping
        join(track.memory, track.cell, rates)
    track.events = []


def bootstrapped(rule, row, best, reached, rates):
    """Eq. 4.8 for every goal of a state, row[a, i]. best: max Q_i(s⁺, ·). reached: s⁺."""
    gamma = np.float32(rule.discount)
    target = gamma * best
    target[reached] = ONE if rule.terminal else ONE + target[reached]
    highest = ONE if rule.terminal else ONE / (ONE - gamma) if gamma < 1 else np.float32(np.inf)
    return updated(rule, row, rates[:, :, None], (target, target), highest)


def updated(rule, value, rates, targets, highest):
    """New values. rates, targets: of events that occurred, and of those that did not."""
    value = value + rates[0] * (targets[0] - value)  # Q ← Q + α_a (target − Q)
    away = np.minimum(value - rates[1] * (targets[1] - value), highest)
    sunk = away if rule.absent_form == "away" else value - rates[1] * value
    return positive(np.where(rates[1] > 0, sunk, value))


def positive(value):
    return np.where(value > np.float32(1e-30), value, ZERO)


def join(memory, cell, rates, strength=ONE, worth=ONE):
    """Add a cell to a memory: its strength, the rates of its events, and these times what the goal is worth there."""
    before = memory.get(cell, (ZERO, ZERO, ZERO))
    memory[cell] = before[0] + strength, before[1] + strength * rates, before[2] + worth * rates


def remembered(rule, value, strength, weights, worths):
    """The values of the events in a remembered cell, for the goal just reached."""
    targets = worths / np.where(weights > 0, weights, ONE)
    return updated(rule, value, np.minimum(weights, ONE), targets, ONE)


def learn_motion(rule, nres, track, place, rates):
    """Learn where the self now is, as seen from each place that it has passed, and centre the map on it."""
    row, memory, strength, worth = nres.q[0], {}, ONE, ONE
    keep, gamma, n = np.float32(rule.memory / (1 + rule.memory)), np.float32(rule.discount), nres.cuts[0][2]
    reached = nres.active(place - track.centre)
    if rule.bootstrap and reached is not None:
        down, right = np.subtract(divmod(reached, n), divmod(nres.contact(), n))
        best = np.pad(row.max(axis=0).reshape(n, n), n)  # as seen from the new centre, 0 outside of the map
        best = best[n - down:2 * n - down, n - right:2 * n - right].flatten()
        row[:] = bootstrapped(rule, row, best, reached, rates)
    track.passed = [(track.centre, rates), *track.passed][:500]
    for back, (centre, its_rates) in enumerate(track.passed):
        cell = nres.active(place - centre)
        if cell is not None and (back > 0 or not rule.bootstrap):  # the last has learned already, by bootstrapping
            join(memory, cell, its_rates, strength, worth)
        strength, worth = strength * keep, positive(worth * (keep * gamma))
        if strength < np.float32(0.01):
            break
    for cell, trace in memory.items():
        row[:, cell] = remembered(rule, row[:, cell], *trace)
    track.centre, track.events = place, []
