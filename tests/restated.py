"""The rules of agents and of learning in plain Python: a slow second implementation, which runs must equal."""

import numpy as np

from neorl import Place
from neorl.core.kernel import execute
from neorl.core.stream import new_stream, uniform
from neorl.worlds.waterworld import GREEN, reset


class Track:
    """A point that a map follows."""

    def __init__(self, cell):
        self.cell, self.events, self.memory, self.passed = cell, [], {}, []


def restated(agent, world, steps, seed, run):
    """A run in plain Python, by public functions alone: (rewards, q of each map)."""
    sequence = np.random.SeedSequence(seed).spawn(run + 1)[run]
    stream = new_stream(sequence.spawn(1)[0])
    state = world.reset(sequence)
    policy, maps = agent.policy, agent.maps
    node_of = [node for node in agent.nodes for _ in node.resolutions]
    q = [np.zeros((each.cells if node.state == "object" else 1, 4, each.cells), np.float32)
         for each, node in zip(maps, node_of)]
    tracks, pull, worth = fresh_tracks(agent, world, state), np.zeros((len(agent.desires), 4)), np.zeros(20)
    rule, rewards, activity = agent.learning, [], np.zeros(4, np.float32)
    keep = np.float32(rule.activity * world.fps / (1 + rule.activity * world.fps))
    for _ in range(steps):
        if policy.exploration > 0 and execute(uniform, stream) < policy.exploration:
            action = int(execute(uniform, stream) * 4)
        else:
            value = values_restated(agent, world, state, q, tracks, pull, worth)
            best = np.flatnonzero(value == value.max())
            if policy.when_indifferent == "no-op" and not value.any():
                action = 4
            else:
                action = int(best[int(execute(uniform, stream) * len(best))] if len(best) > 1 else best[0])
        activity = keep * activity + (np.float32(1) - keep) * (np.arange(4) == action).astype(np.float32)
        reward, hits, done = world.step(state, action)
        rewards.append(reward)
        cells = cells_restated(agent, world, state)
        for m, each in enumerate(maps):
            if node_of[m].state != "object":
                perceive_self_restated(agent, node_of[m], each, world, state, hits, action, activity, q[m], tracks[m])
                continue
            for point, track in enumerate(tracks[m]):
                met = each.modality.follows == "objects" and hits[point]
                if without_direction(each.modality, world, state.scene, point) and not met:
                    cells[m][point] = meeting(each, track.cell)
            for point, track in enumerate(tracks[m]):
                track.events.append(action)
                is_thing = each.modality.follows == "objects"
                met = is_thing and hits[point]
                arrives = met and track.cell is not None
                ends = met or track.cell is None or cells[m][point] is None
                cell_t = meeting(each, track.cell) if arrives else cells[m][point]
                if (arrives or not ends) and (cell_t != track.cell or rule.update_on == "step"):
                    learn_restated(rule, q[m], track, cell_t, action, activity)
                if ends:
                    tracks[m][point] = Track(cells[m][point])
        if done:
            execute(reset, state, world.rules)
            tracks = fresh_tracks(agent, world, state)
            pull[:], worth[:], activity = 0, 0, np.zeros(4, np.float32)
    return rewards, q


def cells_restated(agent, world, state):
    nodes = [node for node in agent.nodes for _ in node.resolutions]
    return [[cell_restated(node, each, at) for at in each.modality.coordinates(state.scene, world.size)]
            for node, each in zip(nodes, agent.maps)]


def cell_restated(node, nres_map, coordinates):
    """The cell of a point, or None beyond the range of a map that ends there."""
    ends = node.beyond == "none" and not nres_map.covers(coordinates)
    return None if ends else int(nres_map.encode(coordinates))


def fresh_tracks(agent, world, state):
    nodes = [node for node in agent.nodes for _ in node.resolutions]
    return [[Track(cell) for cell in cells] if node.state == "object" else
            [fresh_self(place) for place in places_of_self(node, world, state)]
            for node, cells in zip(nodes, cells_restated(agent, world, state))]


def places_of_self(node, world, state):
    """Where the agent is, or where it is as seen from each thing."""
    here = state.scene.position / world.size
    return [here] if node.state == "self" else [-(thing / world.size - here) for thing in state.scene.things]


def fresh_self(place):
    track = Track(None)
    track.passed = [(place, None)]
    return track


def perceive_self_restated(agent, node, nres_map, world, state, hits, action, activity, table, tracks):
    """Learn if the self has moved by half a cell along an axis since the map was last centred on it."""
    axes = nres_map.modality.axes
    width = [(axis.high - axis.low) / (axis.intervals or nres_map.resolution) for axis in axes]
    for point, place in enumerate(places_of_self(node, world, state)):
        track = tracks[point]
        track.events.append(action)
        if node.state == "per object" and hits[point]:
            tracks[point] = fresh_self(place)
        elif np.any(np.abs((place - track.passed[0][0]) * (1 / np.array(width))) >= 0.5):
            learn_self_restated(agent, node, nres_map, table[0], track, place, action, activity)


def learn_self_restated(agent, node, nres_map, table, track, place, action, activity):
    rule, one = agent.learning, np.float32(1)
    rates, decay = rates_restated(rule, track, action, activity)
    track.passed[0] = track.passed[0][0], rates
    keep = np.float32(rule.memory / (1 + rule.memory))
    reached = cell_restated(node, nres_map, place - track.passed[0][0])
    if rule.bootstrap and reached is not None:
        n, centre = nres_map.intervals[0], meeting(nres_map, 0)
        rows, columns = np.divmod(np.arange(nres_map.cells), n)
        row, column = rows - reached // n + centre // n, columns - reached % n + centre % n
        inside = (0 <= row) & (row < n) & (0 <= column) & (column < n)
        best = np.where(inside, table.max(axis=0)[np.where(inside, row * n + column, 0)], np.float32(0))
        bootstrap_restated(rule, table, best, reached, rates, decay)
    found, strength, worth = {}, one, one
    for back, (passed, of_it) in enumerate(track.passed):
        cell = cell_restated(node, nres_map, place - passed)
        if cell is not None and (back > 0 or not rule.bootstrap):
            both = np.array([of_it, np.where(of_it > 0, np.float32(0), decay)])
            sums = found.setdefault(cell, np.zeros((2, 2, 4), np.float32))
            sums += np.array([strength * both, worth * both])
        strength *= keep
        worth *= keep * np.float32(rule.discount)
        worth = worth if worth > 1e-30 else np.float32(0)
        if strength < np.float32(0.01):
            break
    for cell, sums in found.items():
        remember_restated(table[:, cell], sums, rule.absent_form == "away")
    track.passed, track.events = [(place, None), *track.passed[:499]], []




def has_direction(modality):
    return modality.axes[-1].is_direction


def without_direction(modality, world, scene, point):
    """Whether a point lacks the direction that its modality needs, because it is at rest or at distance 0."""
    if modality.follows == "velocity":
        return has_direction(modality) and not scene.velocity.any()
    return has_direction(modality) and modality.coordinates(scene, world.size)[point, 0] == 0


def meeting(nres_map, cell):
    """The cell at distance 0, in the direction of the previous cell."""
    if nres_map.modality.names == ("direction",):
        return cell
    if has_direction(nres_map.modality):
        return int(nres_map.encode([0, cell // nres_map.resolution / nres_map.resolution * 2 * np.pi]))
    return int(nres_map.encode([0, 0]))


def values_restated(agent, world, state, q, tracks, pull, worth):
    """The value of each action; `pull` and `worth` of each desire enter from the previous step and are updated."""
    owner = [node.name for node in agent.nodes for _ in node.resolutions]
    here, creeps = state.scene.position / world.width, state.scene.things / world.width
    nodes, value = {node.name: node for node in agent.nodes}, np.zeros(4)
    for name in agent.evaluation_order:
        node = nodes[name]
        power = ["equal", "resolution", "cells"].index(node.weighting)
        weights = np.array([float(n) ** power for n in node.resolutions])
        weights /= weights.sum()
        mine = [m for m, other in enumerate(owner) if other == name]
        elements = {e: elements_restated(agent, desire, here, creeps - here, state.scene.kinds == GREEN, pull, worth)
                    for e, desire in enumerate(agent.desires) if desire.target == name}
        for e, found in elements.items():
            pull[e], worth[e] = 0, 0
            for place, valence in found:
                worth[e] += valence
                for m, weight in zip(mine, weights):
                    nres_map, modality = agent.maps[m], node.modality
                    if isinstance(agent.desires[e].source, tuple):
                        pairs = [(track.cell, int(nres_map.encode(place))) for track in tracks[m]]
                    elif has_direction(modality) and modality.follows == "velocity" and not np.any(place):
                        pairs = []
                    elif modality.follows in ("position", "velocity"):
                        vector = here + place if modality.follows == "position" else place
                        pairs = [(tracks[m][0].cell, int(nres_map.encode(modality.tune(vector))))]
                    else:
                        pairs = pairs_restated(node, nres_map, modality.tune(place))
                    for cell, goal in pairs:
                        if cell != goal or agent.own_cell == "counts":
                            state_of = cell if node.state == "object" else 0
                            pull[e] += weight * valence * q[m][state_of, :, goal].astype(float)
            value += node.gain * pull[e]
    return value


def pairs_restated(node, nres_map, coordinates):
    """The cells (of the state, of the goal) that count for a thing."""
    cell = cell_restated(node, nres_map, coordinates)
    if cell is None:
        return []
    if node.state != "object":
        return [(meeting(nres_map, cell), cell)]
    if not node.reach:
        return [(cell, meeting(nres_map, cell))]
    (left, top), (right, bottom) = (np.array(np.unravel_index(int(nres_map.encode([each, each])), nres_map.intervals,
                                                              "F")) for each in (-node.reach, node.reach))
    return [(cell, int(np.ravel_multi_index((column, row), nres_map.intervals, order="F")))
            for row in range(top, bottom + 1) for column in range(left, right + 1)]


def elements_restated(agent, desire, here, creeps, green, pull, worth):
    """The elements of a desire: [(place relative to the agent, or point of the node's space, valence), …]."""
    if isinstance(desire.source, tuple):
        return [(desire.source, desire.valence)]
    if isinstance(desire.source, Place):
        return [(np.array(desire.source.coordinates) - here, desire.valence)]
    if not agent.comes_from_node(desire):
        wanted = green == (desire.source == "green")
        return [(place, desire.valence) for place in creeps[wanted]]
    place, valence = np.zeros(2), 0.0
    for i, other in enumerate(agent.desires):
        if other.target == desire.source and (not desire.of or other.source in desire.of):
            sign = 1.0 if desire.signed or worth[i] > 0 else -1.0
            place += sign * np.array([pull[i, 2] - pull[i, 3], pull[i, 1] - pull[i, 0]])
            valence += worth[i]
    return [(desire.scale * place, valence if desire.valence is None else desire.valence)]


def learn_restated(rule, table, track, cell_t, action, activity):
    rates, decay = rates_restated(rule, track, action, activity)
    if rule.memory:
        fade_restated(rule, track)
    if rule.bootstrap:
        bootstrap_restated(rule, table[track.cell], table[cell_t].max(axis=0), cell_t, rates, decay)
    away = rule.absent_form == "away"
    if rule.memory:
        for joins in (rule.bootstrap, not rule.bootstrap):
            if not joins:
                found = track.memory.setdefault(track.cell, [np.float32(0), np.zeros((2, 2, 4), np.float32)])
                found[0] += np.float32(1)
                found[1][:] += np.array([rates, np.where(rates > 0, np.float32(0), decay)])
            else:
                for cell, (_, sums) in track.memory.items():
                    remember_restated(table[cell, :, cell_t], sums, away)
    elif not rule.bootstrap:
        for event in range(4):
            old = table[track.cell, event, cell_t]
            absent = sunk_restated(old, decay, np.float32(1), away, np.float32(1)) if decay > 0 else old
            table[track.cell, event, cell_t] = old + rates[event] * (1 - old) if rates[event] else absent
    track.cell, track.events = cell_t, []


def rates_restated(rule, track, action, activity):
    """The rates of the events that occurred, and the one of those that did not."""
    alpha = np.float32(rule.learning_rate)
    counts = np.array([track.events.count(event) for event in range(4)])
    credit = {"share": counts.astype(np.float32) / np.float32(len(track.events)),
              "happened": (counts > 0).astype(np.float32), "count": counts.astype(np.float32),
              "activity": np.where(activity < np.float32(0.01), np.float32(0), activity),
              "last": (np.arange(4) == action).astype(np.float32)}[rule.credit]
    return np.minimum(alpha * credit, np.float32(1)), alpha * np.float32(rule.absent_decay)


def bootstrap_restated(rule, row, best, reached, rates, decay):
    """Eq. 4.8 for all goals of a state, row[action, goal], from the best values of the state that followed."""
    away, one = rule.absent_form == "away", np.float32(1)
    target = np.float32(rule.discount) * best
    target[reached] = 1 if rule.terminal else 1 + target[reached]
    highest = one if rule.terminal else one / (one - np.float32(rule.discount))
    for event in range(4):
        rate, old = rates[event], row[event].copy()
        absent = sunk_restated(old, decay, target, away, highest) if decay > 0 else old
        new = old + rate * (target - old) if rate > 0 else absent
        row[event] = np.where(new > 1e-30, new, 0)


def sunk_restated(old, rate, target, away, highest):
    new = np.minimum(old - rate * (target - old), highest) if away else old - rate * old
    return np.where(new > 1e-30, new, np.float32(0))


def fade_restated(rule, track):
    """Decay `track.memory`, {cell: [strength, [weights, worths] of events that occurred and that were absent]}."""
    factor = np.float32(rule.memory / (1 + rule.memory))
    for cell, found in [*track.memory.items()]:
        found[0] *= factor
        found[1] *= factor
        found[1][1] *= np.float32(rule.discount)
        if found[0] < np.float32(1e-4):
            del track.memory[cell]


def remember_restated(values, sums, away):
    """Move the values of each event for one goal. sums: [weights, worths], see `fade_restated`."""
    one, (weights, worths) = np.float32(1), sums
    for event in range(4):
        value = values[event]
        if weights[0, event] > 0:
            value += min(weights[0, event], one) * (worths[0, event] / weights[0, event] - value)
        if weights[1, event] > 0:
            value = sunk_restated(value, min(weights[1, event], one), worths[1, event] / weights[1, event], away, one)
        values[event] = value if value > 1e-30 else 0
