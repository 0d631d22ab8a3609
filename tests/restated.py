"""The rules of agents and of learning in plain Python: a slow second implementation, which runs must equal."""

import numpy as np

from neorl import Place
from neorl.core.kernel import execute
from neorl.core.stream import new_stream, uniform
from neorl.worlds.waterworld import GREEN, reset


class Track:
    """A point that a map follows."""

    def __init__(self, cell):
        self.cell, self.events, self.trace, self.memory = cell, [], [], {}


def restated(agent, world, steps, seed, run):
    """A run in plain Python, by public functions alone: (rewards, q of each map)."""
    sequence = np.random.SeedSequence(seed).spawn(run + 1)[run]
    stream = new_stream(sequence.spawn(1)[0])
    state = world.reset(sequence)
    policy, maps = agent.policy, agent.maps
    q = [np.zeros((each.cells, 4, each.cells), np.float32) for each in maps]
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
        before, attended = state.scene.things.copy(), attended_restated(rule, state.scene)
        reward, hits, done = world.step(state, action)
        still = state.scene._replace(things=before)
        rewards.append(reward)
        cells = cells_restated(agent, world, state)
        for m, each in enumerate(maps):
            for point, track in enumerate(tracks[m]):
                met = each.modality.follows == "objects" and hits[point]
                if without_direction(each.modality, world, state.scene, point) and not met:
                    cells[m][point] = meeting(each, track.cell)
            for point, track in enumerate(tracks[m]):
                track.events.append(action)
                is_thing = each.modality.follows == "objects"
                met = is_thing and hits[point]
                arrives, ends = met and rule.capture == "contact", met and rule.capture != "leap"
                if is_thing and attended not in (None, point):
                    tracks[m][point] = Track(cells[m][point])
                    continue
                cell_t = meeting(each, track.cell) if arrives else cells[m][point]
                if (arrives or not ends) and (cell_t != track.cell or rule.update_on == "step"):
                    own = rule.causes == "own" and is_thing and not arrives
                    caused = not own or each.encode(each.modality.coordinates(still, world.size))[point] != track.cell
                    learn_restated(rule, world, q[m], track, cell_t, action, activity, caused)
                if ends:
                    tracks[m][point] = Track(cells[m][point])
        if done:
            execute(reset, state, world.rules)
            tracks = fresh_tracks(agent, world, state)
            pull[:], worth[:], activity = 0, 0, np.zeros(4, np.float32)
    return rewards, q


def cells_restated(agent, world, state):
    return [each.encode(each.modality.coordinates(state.scene, world.size)).tolist() for each in agent.maps]


def fresh_tracks(agent, world, state):
    return [[Track(cell) for cell in cells] for cells in cells_restated(agent, world, state)]


def attended_restated(rule, scene):
    """The thing to learn about, or None for every thing."""
    if rule.attention == "each":
        return None
    distances = ((scene.things - scene.position) ** 2).sum(axis=1)
    return int(np.where((scene.kinds == GREEN) | (rule.attention == "nearest"), distances, np.inf).argmin())


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
                        cell = int(nres_map.encode(modality.tune(place)))
                        pairs = [(cell, meeting(nres_map, cell))]
                    for cell, goal in pairs:
                        if cell != goal or agent.own_cell == "counts":
                            pull[e] += weight * valence * q[m][cell, :, goal].astype(float)
            value += node.gain * pull[e]
    return value


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


def learn_restated(rule, world, table, track, cell_t, action, activity, caused):
    alpha, decay = np.float32(rule.learning_rate), np.float32(rule.learning_rate) * np.float32(rule.absent_decay)
    away, one = rule.absent_form == "away", np.float32(1)
    counts = np.array([track.events.count(event) for event in range(4)])
    credit = {"share": counts.astype(np.float32) / np.float32(len(track.events)),
              "happened": (counts > 0).astype(np.float32), "count": counts.astype(np.float32),
              "activity": np.where(activity < np.float32(0.01), np.float32(0), activity),
              "last": (np.arange(4) == action).astype(np.float32)}[rule.credit]
    rates = np.minimum(alpha * credit, one)
    if rule.memory:
        fade_restated(rule, world, track)
    if not caused:
        track.cell, track.events = cell_t, []
        return
    track.trace = [(track.cell, rates), *track.trace][:rule.trace]
    if rule.bootstrap:
        target = np.float32(rule.discount) * table[cell_t].max(axis=0)
        target[cell_t] = 1 if rule.terminal else 1 + target[cell_t]
        highest = one if rule.terminal else one / (one - np.float32(rule.discount))
        for event in range(4):
            rate, old = rates[event], table[track.cell, event].copy()
            absent = sunk_restated(old, decay, target, away, highest) if decay > 0 else old
            new = old + rate * (target - old) if rate > 0 else absent
            table[track.cell, event] = np.where(new > 1e-30, new, 0)
    if rule.memory:
        for joins in (rule.bootstrap, not rule.bootstrap):
            if not joins:
                found = track.memory.setdefault(track.cell, [np.float32(0), np.zeros((2, 2, 4), np.float32)])
                found[0] += one
                found[1][:] += np.array([rates, np.where(rates > 0, np.float32(0), decay)])
            else:
                remember_restated(table, track, cell_t, away)
    else:
        fading = one
        for back, (cell_left, rates) in enumerate(track.trace):
            if back > 0 or not rule.bootstrap:
                for event in range(4):
                    old = table[cell_left, event, cell_t]
                    absent = sunk_restated(old, fading * decay, one, away, one) if decay > 0 else old
                    learned = old + fading * rates[event] * (1 - old)
                    table[cell_left, event, cell_t] = learned if rates[event] else absent
            fading *= np.float32(rule.discount)
    track.cell, track.events = cell_t, []


def sunk_restated(old, rate, target, away, highest):
    new = np.minimum(old - rate * (target - old), highest) if away else old - rate * old
    return np.where(new > 1e-30, new, np.float32(0))


def fade_restated(rule, world, track):
    """Decay `track.memory`, {cell: [strength, [weights, worths] of events that occurred and that were absent]}."""
    constant = rule.memory * (world.fps if rule.memory_unit == "seconds" else 1)
    once = factor = np.float32(constant / (1 + constant))
    for _ in range(len(track.events) - 1 if rule.memory_unit == "seconds" else 0):
        factor = factor * once if factor > np.float32(1e-4) else np.float32(0)
    for cell, found in [*track.memory.items()]:
        found[0] *= factor
        found[1] *= factor
        found[1][1] *= np.float32(rule.discount) if rule.memory_value == "discounted" else np.float32(1)
        if found[0] < np.float32(1e-4):
            del track.memory[cell]


def remember_restated(table, track, goal, away):
    one = np.float32(1)
    for cell, (_, (weights, worths)) in track.memory.items():
        for event in range(4):
            value = table[cell, event, goal]
            if weights[0, event] > 0:
                value += min(weights[0, event], one) * (worths[0, event] / weights[0, event] - value)
            if weights[1, event] > 0:
                value = sunk_restated(value, min(weights[1, event], one), worths[1, event] / weights[1, event], away,
                                        one)
            table[cell, event, goal] = value if value > 1e-30 else 0
