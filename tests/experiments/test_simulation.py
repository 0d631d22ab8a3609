"""Runs equal a slow second implementation of the rules, and stay the same after what must not change them."""

import itertools
from dataclasses import replace

import numpy as np
import pytest
from golden import learning, plain_rule

import neorl
from neorl import (Agent, Desire, Node, Place, Policy, Run, WaterWorld, multimodal, network_a, network_b, network_c,
                   network_d, object_vector_cells, place_cells, simulate)
from neorl.core.horde import as_vectors
from neorl.core.kernel import arrays, execute
from neorl.core.modality import (BORDER_CELL, BOUNDARY_VECTOR_CELL, CARTESIAN_OBJECT_VECTOR_CELL, HEAD_DIRECTION_CELL,
                                 LANDMARK_VECTOR_CELL, OBJECT_VECTOR_CELL, PLACE_CELL, SPEED_CELL)
from neorl.core.stream import new_stream, uniform
from neorl.worlds.waterworld import GREEN, reset

TANK = WaterWorld(n_creeps=8, win_reward=5.0)
SENSES = (Node("PC", PLACE_CELL, (2, 5), gain=0.5), Node("border", BORDER_CELL, (3,)),
          Node("polar", OBJECT_VECTOR_CELL, (4, 5)), Node("HD", HEAD_DIRECTION_CELL, (6,), gain=0.7),
          Node("landmark", LANDMARK_VECTOR_CELL, (4,)), Node("wall", BOUNDARY_VECTOR_CELL, (3, 4)),
          Node("speed", SPEED_CELL, (3, 4), weighting="cells"))
DESIRES = (Desire("green", "polar", 1.0), Desire("red", "polar", -0.5), Desire("polar", "PC"),
          Desire("green", "border", 0.3), Desire("green", "HD", 1.0), Desire("HD", "polar", valence=0.2, scale=0.5),
          Desire((0.3, 0.9), "PC", 1.0), Desire((0.4,), "speed", 0.5), Desire((0.1, np.pi), "wall", -1.0),
          Desire(Place(0.2, 0.7), "PC", 0.5), Desire(Place(0.6, 0.1), "polar", -0.4),
          Desire(Place(0.9, 0.9), "HD", 0.3),
          Desire("PC", "landmark", signed=True), Desire("polar", "polar", -0.5, of=("green", "polar")))
A_THAT_RECURS = replace(network_a([3, 5]), desires=(
    *network_a().desires, Desire("OVC", "OVC", valence=0.5, scale=2.0, signed=False),
    Desire("OVC", "OVC", valence=-0.7, of=("PC", "OVC"), scale=2.0, signed=False)))
READINGS = {
    "default": place_cells([3, 7]),
    "several": place_cells([2, 5, 9], weighting="cells", policy=Policy(exploration=0.3, when_indifferent="no-op")),
    "happened": place_cells([5], learning=plain_rule(credit="happened", absent_decay=0.1)),
    "last": place_cells([5], learning=plain_rule(credit="last", terminal=False), own_cell="counts"),
    "step": multimodal([5], learning=plain_rule(update_on="step")),
    "trace": multimodal([4, 7], learning=plain_rule(trace=7)),
    "leaky": place_cells([6], tiled_fraction=0.5, learning=plain_rule(trace=5, bootstrap=False)),
    "objects": object_vector_cells([3, 4], weighting="resolution"),
    "memory": multimodal([3, 6], learning=plain_rule(memory=4.0)),
    "memory alone": multimodal([2, 5], learning=plain_rule(memory=30.0, bootstrap=False, absent_decay=0.3,
                                                           learning_rate=0.3)),
    "memory of seconds": multimodal([4], learning=plain_rule(memory=0.2, memory_unit="seconds",
                                                             memory_value="discounted",
                                                           bootstrap=False, credit="happened")),
    "away": multimodal([5], learning=plain_rule(absent_decay=0.2, absent_form="away", terminal=False)),
    "away alone": multimodal([5], learning=plain_rule(absent_decay=0.2, absent_form="away", bootstrap=False, trace=4)),
    "away with memory": multimodal([5], learning=plain_rule(absent_decay=0.4, absent_form="away", memory=6.0,
                                                            bootstrap=False,
                                                          memory_value="discounted")),
    "count": place_cells([4], learning=plain_rule(credit="count", learning_rate=0.4)),
    "activity": multimodal([4], learning=plain_rule(credit="activity", activity=0.1, absent_decay=0.1, memory=2.0)),
    "own causes": multimodal([7], learning=plain_rule(causes="own", memory=5.0)),
    "leap": multimodal([4], learning=plain_rule(capture="leap", causes="own", memory=3.0, bootstrap=False)),
    "silent": object_vector_cells([4], learning=plain_rule(capture="silent")),
    "nearest": multimodal([5], learning=plain_rule(attention="nearest", memory=5.0)),
    "wanted": multimodal([5], learning=plain_rule(attention="wanted", causes="own")),
    "A": network_a([2, 3]),
    "B": network_b([3, 5], signed=True),
    "C": network_c([3], object_gain=0.5),
    "D": network_d([2, 5], policy=Policy(exploration=0.05)),
    "A that recurs": A_THAT_RECURS,
    "all senses": Agent(SENSES, DESIRES),
    "compass": Agent((Node("PC", PLACE_CELL, (7,), gain=0.0), Node("HD", HEAD_DIRECTION_CELL, (4,))),
                     (Desire("green", "PC", 1.0), Desire("PC", "HD"))),
}


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


@pytest.mark.parametrize("name", READINGS)
def test_a_run_equals_the_rules_in_plain_python(name):
    agent, world, steps = READINGS[name], WaterWorld(width=100, n_creeps=2, win_reward=5.0), 1_500
    run = Run(agent, world, seed=3, run=2)
    brought = run.advance(steps)
    rewards, q = restated(agent, world, steps, seed=3, run=2)
    assert brought == sum(rewards) != 0
    for m, table in enumerate(q):
        np.testing.assert_array_equal(run.q(m), table)
        assert table.any() or agent.maps[m].cells < 10


def test_becoming_the_same_agent_changes_nothing():
    whole, changed = (Run(READINGS["trace"], TANK, seed=4) for _ in range(2))
    whole.advance(3_000)
    changed.advance(1_234)
    changed.change(READINGS["trace"])
    changed.advance(1_766)
    assert_equal(whole, changed)


def assert_equal(run, other):
    for name in ("state", "world_state"):
        one, other_one = arrays(getattr(run, name)), arrays(getattr(other, name))
        for field in one:
            np.testing.assert_array_equal(one[field], other_one[field], field)


def test_an_agent_that_gets_a_second_modality_keeps_what_it_knows():
    run = Run(place_cells([3, 7]), TANK, seed=2)
    run.advance(5_000)
    knows = np.concatenate([run.q(0).ravel(), run.q(1).ravel()])
    run.change(multimodal([3, 5, 7]))
    np.testing.assert_array_equal(np.concatenate([run.q(0).ravel(), run.q(2).ravel()]), knows)
    assert knows.any() and not run.q(1).any() and not run.q(4).any()
    run.advance(5_000)
    assert run.q(1).any() and run.q(4).any()
    run.change(place_cells([7]))
    assert run.state.values.q.size == 4 * 7**4 and run.q().any()


def test_a_change_can_be_planned():
    changes = [(1_000, multimodal([3, 7])), (2_500, multimodal([3, 7], place_gain=0.5))]
    result = simulate(place_cells([3, 7]), TANK, steps=4_000, runs=2, seed=6, changes=changes, progress=False)
    run = Run(place_cells([3, 7]), TANK, seed=6, run=1)
    brought = run.advance(1_000)
    for (_, agent), steps in zip(changes, (1_500, 1_500)):
        run.change(agent)
        brought += run.advance(steps)
    assert brought == result.totals[1]
    assert result.changes == tuple(changes)


@pytest.mark.parametrize("changes, message", [
    (5, "changes is 5"), ([(5,)], r"changes has \(5,\), allowed are pairs"),
    ([(101, place_cells())], "is 101, allowed"),
    ([(50, place_cells()), (49, place_cells())], "step of a change is 49"), ([(5, "PC")], "agent of a change is 'PC'")])
def test_bad_changes_are_refused(changes, message):
    with pytest.raises(ValueError, match=message):
        simulate(place_cells([3]), TANK, steps=100, runs=1, changes=changes, progress=False)


def test_the_output_of_a_node():
    run = Run(network_c([2, 5], object_gain=0.5, scale=2.0, signed=False), TANK, seed=0)
    run.advance(20_000)
    place, relative = run.output("PC"), run.output("OVC")
    assert place.q.any() and relative.q.any()
    np.testing.assert_allclose(run.state.action_value, place.q + 0.5 * relative.q, atol=1e-15)
    greens, reds = (sum(run.agent.desires[e].source == colour and run.state.desires.valence[e] for e in range(2))
                    for colour in ("green", "red"))
    assert place.valence == greens + reds == relative.valence
    landing = run.state.desires.target[2:4, :2] / 2.0
    np.testing.assert_allclose(landing.sum(axis=0), place.desire)
    with pytest.raises(ValueError, match="name is 'HD', allowed are 'PC', 'OVC'"):
        run.output("HD")


def test_a_node_by_itself_wants_what_its_agent_does():
    run = Run(place_cells([5]), TANK, seed=0)
    run.advance(20_000)
    np.testing.assert_array_equal(run.output("PC").q, run.state.action_value)


@pytest.mark.parametrize("modality, resolution, here, goal, action", [
    (PLACE_CELL, 5, (0.5, 0.5), (0.7, 0.5), "E"), (BORDER_CELL, 3, (0.0, 0.0), (0.0, -0.25), "N"),
    (OBJECT_VECTOR_CELL, 8, (0.4, 0.0), (0.0, 0.0), "E"), (OBJECT_VECTOR_CELL, 8, (0.4, np.pi), (0.0, np.pi), "W"),
    (CARTESIAN_OBJECT_VECTOR_CELL, 7, (0.0, 0.3), (0.0, 0.0), "S"),
    (BOUNDARY_VECTOR_CELL, 8, (0.4, 1.5 * np.pi), (0.1, 1.5 * np.pi), "N"),
    (LANDMARK_VECTOR_CELL, 8, (0.4, np.pi), (0.1, np.pi), "W"), (HEAD_DIRECTION_CELL, 8, (0.0,), (1.5 * np.pi,), "N"),
])
def test_an_agent_of_any_modality_learns_which_way_to_go(modality, resolution, here, goal, action):
    node = Node("X", modality, [resolution])
    run = Run(Agent((node,), learning=plain_rule(), policy=Policy(exploration=1.0)), TANK, seed=1)
    run.advance(200_000)
    nres_map = run.agent.maps[0]
    values = run.q()[nres_map.encode(here), :, nres_map.encode(goal)]
    assert TANK.actions.names[values.argmax()] == action and values.max() > 1.05 * np.sort(values)[-2]


def test_an_agent_learns_to_keep_a_speed():
    speeds = {}
    for wish in (0.1, 1.9):
        run = Run(Agent((Node("speed", SPEED_CELL, [8]),), (Desire((wish,), "speed", 1.0),), policy=Policy(0.5)), TANK)
        run.advance(50_000)
        speeds[wish] = np.empty(2_000)
        for step in range(2_000):
            run.advance(1)
            speeds[wish][step] = np.linalg.norm(run.world_state.scene.velocity) / TANK.width
    assert np.median(speeds[1.9]) > 1.2 * np.median(speeds[0.1])


def test_runs_share_no_cache_line():
    runs = [Run(place_cells([3]), TANK, run=run) for run in range(20)]
    written = [(array.ctypes.data, array.ctypes.data + array.nbytes, run) for run in runs
               for array in (*arrays(run._state).values(), *arrays(run.world_state).values())
               if array.nbytes < 4_096]
    for (_, end, one), (begin, _, other) in itertools.pairwise(sorted(written, key=lambda each: each[:2])):
        assert begin - end >= 64 or one is other


def test_runs_and_seeds_differ():
    result = simulate(READINGS["default"], TANK, steps=5_000, runs=3, seed=0, progress=False)
    other = simulate(READINGS["default"], TANK, steps=5_000, runs=1, seed=1, progress=False)
    assert len({rewards.tobytes() for rewards in [*result.rewards, *other.rewards]}) == 4


def test_the_bins_add_up():
    world = WaterWorld(n_creeps=8, win_reward=5.0, fps=30)
    result = simulate(neorl.brownian(), world, steps=40_003, runs=2, progress=False)
    green, red = result.hits.sum(axis=(0, 1))
    wins = (result.totals.sum() - (green - red)) / 5.0
    assert result.rewards.shape == (2, 6_668)
    assert wins == int(wins) > 0
    assert result.time[-1] == result.seconds == pytest.approx(40_003 / 30)
    np.testing.assert_allclose(result.rate() * result.seconds, result.totals)
    np.testing.assert_allclose(result.hit_rate() * result.seconds, result.hits.sum(axis=1))
    assert result.edges[0] == 0
    first, rest = result.rate(0, 0.25), result.rate(0.25, 1)
    np.testing.assert_allclose((first * result.time[1666] + rest * (result.seconds - result.time[1666])),
                               result.totals)


@pytest.mark.parametrize("begin, end, message", [
    (-0.1, 1, "begin is -0.1"), (0, 1.1, "end is 1.1"), (0.5, 0.5, "end is 0.5, allowed are"), (1, 0, "end is 0")])
def test_a_bad_stretch_is_refused(begin, end, message):
    result = simulate(place_cells([3]), TANK, steps=100, runs=1, progress=False)
    with pytest.raises(ValueError, match=message):
        result.rate(begin, end)


def test_an_agent_whose_values_overflow_still_chooses():
    with np.errstate(all="ignore"):
        rules = plain_rule(terminal=False, discount=1.0)
        agent = place_cells([3], valence_green=1e30, valence_red=-1e30, learning=rules)
        assert simulate(agent, TANK, steps=50_000, runs=1, progress=False).hits.sum() > 0


def test_learning_pays():
    """N7 clearly beats Brownian motion within 20 simulated minutes: claim A2 in miniature."""
    learner, control = (simulate(agent, TANK, steps=60_000, runs=4, progress=False).rate(0.5).mean()
                        for agent in (place_cells([7], **learning()), neorl.brownian()))
    assert learner > control + 0.2


@pytest.mark.parametrize("change, message", [
    ({"steps": 0}, "steps is 0, allowed are integers ≥ 1"), ({"steps": -5}, "steps is -5"),
    ({"steps": 1e3}, "steps is 1000.0"), ({"runs": 0}, "runs is 0"), ({"runs": -1}, "runs is -1"),
    ({"seed": -1}, "seed is -1"), ({"threads": 0}, "threads is 0"), ({"agent": "N5"}, "agent is 'N5'"),
    ({"world": None}, "world is None, allowed is a World"),
])
def test_a_bad_simulation_is_refused(change, message):
    arguments = {"agent": place_cells([3]), "world": TANK, "steps": 100, "runs": 1, "progress": False}
    with pytest.raises(ValueError, match=message):
        simulate(**{**arguments, **change})


def test_a_bad_advance_is_refused_and_changes_nothing():
    run = Run(place_cells([3]), TANK, seed=0)
    rewards, hits = np.zeros(10, np.float32), np.zeros((10, 2), np.int16)
    for steps, given, message in [(-1, (rewards, hits), "steps is -1"), (101, (rewards, hits), "rewards is float32"),
                                  (100, (rewards, hits[:, :1]), "hits is int16"),
                                  (100, (hits, hits), "rewards is int16")]:
        with pytest.raises(ValueError, match=message):
            run.advance(steps, *given)
    run.world_state.scene.position[:] = np.nan
    with pytest.raises(ValueError, match="state.scene.position is"):
        run.advance(1)
    assert run.step == 0 and not run.state.values.q.any()


def test_an_agent_that_does_not_fit_into_memory_is_refused():
    with pytest.raises(MemoryError, match="a run of this agent needs .* GiB"):
        simulate(place_cells([2_000]), TANK, steps=1, runs=1)


def test_a_run_that_fails_ends_the_others(monkeypatch):
    def fail(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr("neorl.experiments.run.Run.advance", fail)
    with pytest.raises(KeyboardInterrupt):
        simulate(place_cells([3]), TANK, steps=10**9, runs=4, progress=False)


def test_recursion_takes_vectors_and_valences_of_the_step_before():
    run = Run(A_THAT_RECURS, WaterWorld(), seed=0)
    run.advance(2_000)
    while not run.state.desires.q[2:].any(axis=1).all():
        run.advance(1)
    run._state.desires.valence[2:] *= -1  # as if the valences of the previous step had the opposite sign
    pull, worth = run.state.desires.q[2:].copy(), run.state.desires.valence[2:].copy()
    run.advance(1)
    expected = 2.0 * np.where(worth > 0, 1.0, -1.0) @ as_vectors(pull)
    assert expected.all()
    np.testing.assert_allclose(run.state.desires.target[3:, :2], [expected, expected])


@pytest.mark.parametrize("agent", [multimodal([3, 12]),
                                   place_cells([14], learning=plain_rule(trace=5, absent_decay=0.2))])
def test_a_run_in_the_memory_of_another_begins_with_nothing_and_is_the_same(agent):
    before = Run(agent, WaterWorld(), seed=0, run=3)
    before.advance(20_000)
    room = before.state.values.q
    after, fresh = Run(agent, WaterWorld(), seed=0, run=4, after=before), Run(agent, WaterWorld(), seed=0, run=4)
    assert np.shares_memory(after.state.values.q, room) and not after.state.values.q.any()
    assert after.advance(20_000) == fresh.advance(20_000)
    assert_equal(after, fresh)


def test_a_run_takes_over_the_memory_of_a_larger_agent_and_is_the_same():
    before = Run(multimodal([3, 14]), WaterWorld())
    before.advance(5_000)
    smaller = place_cells([13], learning=plain_rule(trace=5))
    after, fresh = Run(smaller, WaterWorld(), after=before), Run(smaller, WaterWorld())
    assert np.shares_memory(after.state.values.q, before.state.values.q) and not after.state.values.q.any()
    assert after.advance(5_000) == fresh.advance(5_000)
    assert_equal(after, fresh)


def test_a_run_after_that_of_a_smaller_agent_has_memory_of_its_own():
    before = Run(place_cells([13]), WaterWorld())
    before.advance(5_000)
    knew = before.state.values.q.copy()
    assert not np.shares_memory(Run(place_cells([14]), WaterWorld(), after=before).state.values.q,
                                before.state.values.q)
    np.testing.assert_array_equal(before.state.values.q, knew)
