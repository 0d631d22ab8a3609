"""What a learner learns from a recording is what it would learn from the same steps, one by one."""

import json
import sys
from dataclasses import replace

import numpy as np
import pytest
from golden import MEMORIES, RULES, STATES, plain_rule
from same import assert_equal
from subprograms import printed

from neorl import (CARDINAL, Agent, Contacts, Desire, Learner, Node, Place, Policy, Run, Scene, WaterWorld, forager,
                   kernel, multimodal, place_cells)
from neorl.core.modality import PLACE_CELL, SPEED_CELL
from neorl.custom import Axis, Modality
from neorl.kernels.annotations import mapped

TANK, BUSY = WaterWorld(n_creeps=2), WaterWorld(n_creeps=8)
STEPS = 1_500
AFTER_STATES = forager([5, 9], contacts=Contacts(efference=0.25))


@kernel
def half_of_the_last(count, steps, last, activity):
    return 0.5 * activity if last else 0.25


def walk(steps=STEPS, seed=0):
    """A path in the unit square, and the actions behind it."""
    rng = np.random.default_rng(seed)
    actions = rng.integers(0, 5, steps)
    moves = 0.03 * CARDINAL.table[actions] + rng.normal(0, 0.004, (steps, 2))
    path = [np.array([0.5, 0.5])]
    for move in moves:
        path.append(np.clip(path[-1] + move, 0, 1))
    return np.array(path), actions


PLACES = Agent([Node("PC", PLACE_CELL, [4, 9])])
AGENTS = {
    **{f"rule, {name}": replace(PLACES, learning=plain_rule(**rule)) for name, rule in (RULES | MEMORIES).items()},
    **{f"credit {name}": replace(PLACES, learning=plain_rule(credit=name, memory=memory))
       for name in ("share", "happened", "last", "count", "activity") for memory in (0.0, 4.0)},
    "own credit": replace(PLACES, learning=plain_rule(credit=half_of_the_last, memory=3.0)),
    "unnoticed": replace(PLACES, resets="unnoticed"), "bare": PLACES,
    "wants": replace(PLACES, desires=[Desire(Place(0.1, 0.1), "PC", 1.0)], policy=Policy(0.3))}


def one_by_one(learner, path, actions, ends=()):
    learner.begin(Scene(path[0]))
    for t, action in enumerate(actions):
        if t in ends:
            learner.begin(Scene(path[t + 1]))
        else:
            learner.observe(Scene(path[t + 1]), action=int(action))


@pytest.mark.parametrize("name", AGENTS)
def test_watching_is_observing_step_by_step(name):
    (path, actions), ends = walk(), [400, 401, 900]
    watcher, observer = Learner(AGENTS[name]), Learner(AGENTS[name])
    assert watcher.watch(path, actions, ends=ends) == STEPS - len(ends)
    one_by_one(observer, path, actions, ends)
    assert_equal(watcher, observer)
    assert any(watcher.q(m).any() for m in range(2))
    watcher.act()  # and it can go on by itself
    watcher.observe(Scene((0.3, 0.3)))


@pytest.mark.parametrize("agent", [multimodal([3, 4], policy=Policy(0.5)), forager([5, 9]), AFTER_STATES, *(
    multimodal([3, 5], **state) for state in STATES.values())])
def test_what_a_run_did_teaches_a_learner_that_watches_its_scenes_the_same(agent):
    run = Run(agent, BUSY, seed=3)
    scenes = [mapped(np.copy, run.world_state.scene)]
    recorded = []
    for _ in range(600):
        recorded.append(run.record(1))
        scenes.append(mapped(np.copy, run.world_state.scene))
    assert not any(len(each.ends) for each in recorded)
    actions, rewards = (np.concatenate([getattr(each, name) for each in recorded]) for name in ("actions", "rewards"))
    shown = [scene._replace(met=scene.met != 0) for scene in scenes]
    watcher = Learner(agent, BUSY.things, BUSY.kinds, BUSY.actions, size=BUSY.width, fps=BUSY.fps)
    watcher.watch(shown, actions, rewards=rewards)
    np.testing.assert_array_equal(watcher.memory.q, run.memory.q)
    np.testing.assert_array_equal(watcher.memory.tracks, run.memory.tracks)
    np.testing.assert_array_equal(watcher.state.desires.meetings, run.state.desires.meetings)


def test_a_recording_in_parts_is_a_recording():
    path, actions = walk()
    whole, parts = Learner(PLACES), Learner(PLACES)
    whole.watch(path, actions)
    for first, end in ((0, 700), (700, 701), (701, STEPS)):
        parts.watch(path[first : end + 1], actions[first:end], progress=False)
    assert_equal(whole, parts)


def test_a_lost_animal_and_a_jump_end_a_stretch_as_a_mask_or_by_indices():
    path, actions = walk()
    lost = path.copy()
    lost[300:303] = np.nan
    lost[800, 1] = np.nan
    by_nan, by_ends = Learner(PLACES), Learner(PLACES)
    assert by_nan.watch(lost, actions) == STEPS - 4 - 2
    kept = ~np.isnan(lost).any(axis=1)
    ends = np.flatnonzero(np.diff(np.flatnonzero(kept)) > 1)
    by_ends.watch(path[kept], np.append(actions, 0)[kept][:-1], ends=ends)
    assert_equal(by_nan, by_ends)
    masks = [Learner(PLACES) for _ in range(3)]
    for learner, ends in zip(masks, ([500], np.arange(STEPS) == 500, np.arange(STEPS + 1) == 500)):
        learner.watch(path, actions, ends=ends)
        assert_equal(masks[0], learner)


@pytest.mark.parametrize("actions", ["displacements", "pushes", "numbers"])
def test_a_push_counts_for_the_action_with_the_nearest_direction(actions):
    path, numbers = walk()
    learner, exact = Learner(PLACES), Learner(PLACES)
    moves = np.diff(path, axis=0)
    nearest = [4 if not move.any() else int(np.argmax(CARDINAL.table[:4] @ move)) for move in moves]
    learner.watch(path, {"displacements": None, "pushes": 40.0 * moves, "numbers": nearest}[actions])
    exact.watch(path, nearest)
    assert_equal(learner, exact)
    learner.act()
    learner.observe(Scene((0.5, 0.5)), action=(0.1, -0.3))  # instead of what it chose
    assert learner.state.last_event == 0
    learner.observe(Scene((0.5, 0.5)), action=np.int8(2))
    assert learner.state.last_event == 2


@pytest.mark.parametrize("positions, actions, more, message", [
    (5.0 * walk()[0], None, {}, r"axis 0 must be from 0 to 1, as the agent's maps of places are, but 1,\d+ of 1,501"),
    (np.c_[np.arange(1_501) / 50.0, walk()[0][:, 0]], None, {}, "it rises steadily, as timestamps do: leave these out"),
    (np.c_[np.arange(1_501), walk()[0]], None, {}, "a row for each time without the time itself, but are float"),
    (walk()[0][:, 0], None, {}, r"but are float64 of the shape \(1501,\)"), ([], None, {}, r"the shape \(0,\)"),
    (np.where(walk()[0] > 0.6, np.inf, walk()[0]), None, {}, "positions must be finite numbers"),
    (walk()[0], np.zeros(1_501), {}, r"actions must be numbers of the shape \(1500,\), one for each step"),
    (walk()[0], np.full((1_500, 3), 0.1), {}, r"actions must be numbers of the shape \(1500, 2\)"),
    (walk()[0], np.full(1_500, 5), {}, "actions must be numbers of actions from 0 to 4, which stands"),
    (walk()[0], np.full(1_500, 0.5), {}, "actions must be numbers of actions from 0 to 4"),
    (walk()[0], np.full((1_500, 2), np.nan), {}, "must be finite .* 1,500 of 1,500 are not, first that of step 0: end"),
    (walk()[0], None, {"ends": [1_501]}, "ends must be indices of positions, from 0 to 1500"),
    (walk()[0], None, {"ends": [0.5]}, "ends must be indices"),
    (walk()[0], None, {"rewards": [1.0]}, "rewards must be numbers of the shape"),
    ("a path", None, {}, "positions must be"), ([Scene((0.1, 0.1)), "here"], None, {}, "scene must be a neorl.Scene")])
def test_what_is_no_recording_is_refused_and_teaches_nothing(positions, actions, more, message):
    learner = Learner(PLACES)
    with pytest.raises(ValueError, match=message):
        learner.watch(positions, actions, **more)
    assert not any(learner.q(m).any() for m in range(2))


def test_a_thing_that_is_nowhere_in_a_scene_is_refused():
    learner = Learner(multimodal([3]), 1, ("green", "red"))
    scenes = [Scene((0.5, 0.5), None, [(0.2, 0.2)], ["green"]), Scene((0.5, 0.6), None, [(np.nan, 0.2)], ["green"])]
    with pytest.raises(ValueError, match="things must be finite"):
        learner.watch(scenes)
    scenes[1] = scenes[1]._replace(kinds=[None])
    assert learner.watch(scenes) == 1


@kernel
def nan_in_the_east(scene, point):
    return np.nan if scene.position[0] > 0.6 else 0.5


def test_a_users_axis_that_returns_nan_is_named():
    learner = Learner(Agent([Node("own", Modality("own cell", [Axis(nan_in_the_east)]), [3])]))
    with pytest.raises(ValueError, match="nan_in_the_east of an axis must return numbers"):
        learner.watch(np.linspace((0.1, 0.1), (0.9, 0.9), 50))


def test_progress_is_reported_to_a_function():
    path, seen = walk(50_000)[0], []
    learner = Learner(PLACES)
    learner.watch(path, progress=lambda done, total: seen.append((done, total)))
    assert seen == [(20_000, 50_001), (40_000, 50_001), (50_001, 50_001)]


def test_an_agent_that_only_watched_goes_where_it_is_told_to():
    path, actions = walk(60_000)
    learner = Learner(Agent([Node("PC", PLACE_CELL, [9])]))
    learner.watch(path, actions)
    learner.learns = False
    knows, at = learner.memory.q.copy(), np.array([0.1, 0.1])
    learner.want((0.9, 0.8))
    for _ in range(80):
        at = np.clip(at + 0.03 * learner.output("PC", Scene(at), normalised=True).desire, 0, 1)
    assert np.abs(at - (0.9, 0.8)).max() < 0.12 and np.array_equal(learner.memory.q, knows)


@pytest.mark.parametrize("agent", [place_cells([4]), multimodal([3, 4]), forager([5, 9]), AFTER_STATES, *(
    multimodal([3, 5], **state) for state in STATES.values())])
def test_an_agent_that_does_not_learn_changes_no_value_and_learns_again(agent):
    agent = replace(agent, policy=Policy(0.3))
    run = Run(agent, TANK, seed=2)
    run.advance(1_000)
    before = run.copy()
    run.learns = False
    assert before.learns and not run.learns and not run.copy().learns
    run.advance(1_000)
    np.testing.assert_array_equal(run.memory.q, before.memory.q)
    assert run.state.desires.meetings.tolist() == before.state.desires.meetings.tolist()
    run.change(agent)
    assert not run.learns
    run.learns = True
    run.advance(1_000)
    assert not np.array_equal(run.memory.q, before.memory.q)
    with pytest.raises(ValueError, match="learns must be True or False, but is 1"):
        run.learns = 1


def test_an_output_in_a_scene_is_that_of_an_agent_there_and_changes_nothing():
    agent = multimodal([3, 5], learning=plain_rule(), policy=Policy(0.0))
    teacher = Run(agent, TANK, seed=1)
    teacher.advance(5_000)
    learner, there = (Learner(agent, TANK.things, TANK.kinds, TANK.actions, size=TANK.width) for _ in range(2))
    scene = mapped(np.copy, teacher.world_state.scene)._replace(met=())
    for each in (learner, there):
        each.transfer(teacher)
    there.begin(scene)
    there.act()
    before = learner.copy()
    for node in ("PC", "OVC"):
        np.testing.assert_array_equal(learner.output(node, scene).q, there.output(node).q)
        assert np.abs(learner.output(node, scene, normalised=True).desire).max() == 1.0
    assert_equal(learner, before)


def test_desires_are_set_by_one_line():
    run = Run(multimodal([3]), TANK)
    run.want("red", (50.0, 200.0), valence=2.0)
    assert run.agent.desires == tuple(Desire(each, node, 2.0) for each in ("red", Place(0.2, 0.8))
                                      for node in ("PC", "OVC"))
    run.want()
    assert run.agent.desires == ()
    with pytest.raises(ValueError, match="source of the desire .* must be a node .* or a kind of this world's things"):
        run.want("blue")
    with pytest.raises(ValueError, match="must have a node of places or of things to want one, but has none"):
        Learner(Agent([Node("V", SPEED_CELL, [3])])).want((0.5, 0.5))


def test_without_the_compiler_watching_has_the_same_bits():
    assert printed(__file__, jit=False) == digests()


def digests():
    """The values that some agents learn from a short recording."""
    path, actions = walk(120)
    found = {}
    for name in ("own credit", "rule, memory, count", "wants"):
        learner = Learner(AGENTS[name])
        learner.watch(path, actions, ends=[50])
        found[name] = learner.memory.q.astype(float).sum().hex()
    return found


if __name__ == "__main__":
    json.dump(digests(), sys.stdout)
