"""What an agent keeps as it changes, as its values go to another, and in a file."""

from dataclasses import replace

import numpy as np
import pytest
from golden import RUNS, plain_rule, world_of
from hypothesis import example, given, settings
from hypothesis import strategies as st
from same import assert_same

from neorl import Agent, Contacts, Desire, Learner, Node, Policy, Run, Scene, WaterWorld, forager, kernel, multimodal
from neorl.agents.embodiment import choices_in
from neorl.agents.forager import FOVEATED_CELL
from neorl.core.building import TABLES
from neorl.core.layout import KEEPING, Memory, agent_type
from neorl.core.modality import CARTESIAN_OBJECT_VECTOR_CELL, PLACE_CELL
from neorl.custom import Axis, Modality, softmax

TANK = WaterWorld()
BASIN = WaterWorld(width=60, n_creeps=2)  # where a forager meets things all the time


@kernel
def at_the_end(count, steps, last, activity):
    return activity if last else 0.0


AGENTS = {name: (agent, world_of(name)) for name, (agent, _) in RUNS.items()} | {
    "own credit": (multimodal([3, 5], learning=plain_rule(credit=at_the_end, memory=4.0)), TANK),
    "own policy": (multimodal([3, 5], policy=Policy(0.0, choose=softmax(0.1))), TANK),
    "one map twice": (multimodal([4, 4]), TANK),
    "one desire twice": (Agent([Node("PC", PLACE_CELL, [4])], [Desire("green", "PC", 1.0)] * 2), TANK),
    "forager in a basin": (forager(), BASIN),
    "worth learned at several nodes": (Agent(
        [Node("PC", PLACE_CELL, [4]), *forager().nodes],
        [Desire(kind, node, "learned") for node in ("PC", "OVC × V") for kind in ("green", "red")]), BASIN)}


@settings(max_examples=60)
@given(st.sampled_from(sorted(AGENTS)), st.integers(0, 3_000), st.integers(1, 2_000))
@example("forager in a basin", 500, 2_000)
@example("network D", 1, 2_000)
@example("both, self", 700, 2_000)
@example("worth learned at several nodes", 500, 500)
def test_a_change_to_the_same_agent_at_any_step_changes_nothing(name, steps, later):
    agent, world = AGENTS[name]
    run = Run(agent, world, seed=steps)
    run.advance(steps)
    other = run.copy()
    other.change(agent)
    assert_same(run, other)
    assert run.advance(later) == other.advance(later)
    assert_same(run, other)


@settings(max_examples=30)
@given(st.sampled_from(sorted(set(AGENTS) - {"Brownian"})), st.integers(0, 2_000), st.booleans())
@example("forager in a basin", 1_500, True)
@example("both, per object", 1_500, True)
def test_maps_stay_as_they_were_beside_an_added_node_and_after_it_is_gone(name, steps, first):
    agent, world = AGENTS[name]
    more = Node("more", PLACE_CELL, [6])
    run = Run(agent, world, seed=steps)
    run.advance(steps)
    before = run.copy()
    run.change(replace(agent, nodes=(more, *agent.nodes) if first else (*agent.nodes, more)))
    moved = len(more.maps) * first
    for m in range(len(agent.maps)):
        np.testing.assert_array_equal(run.q(m + moved), before.q(m))
    run.change(agent)
    assert_same(run, before)
    run.advance(300)
    before.advance(300)
    assert_same(run, before)


@settings(max_examples=20)
@given(st.sampled_from(sorted(AGENTS)), st.integers(0, 2_000))
def test_a_file_keeps_the_state(tmp_path_factory, name, steps):
    run = Run(*AGENTS[name], seed=steps)
    run.advance(steps)
    path = tmp_path_factory.mktemp("kept") / "run.npz"
    run.save(path)
    loaded = Run.load(path)
    for each in (run, loaded):
        each.advance(200)
    assert_same(run, loaded)


def test_every_array_and_every_field_says_whether_it_is_kept():
    assert list(KEEPING) == list(Memory._fields)
    kept = {name.partition(".")[2] for name in Run(forager(), TANK)._state() if name.startswith("agent.")}
    chosen = set(choices_in(forager(), TANK)) | {f"n_{name}" for name in TABLES} | {"maps", "axes", "inputs"}
    working = {"faults", "rates", "here", "efferent", "ahead", "offset", "coordinates", "seen", "rival", "favourite"}
    assert kept | chosen | working >= set(agent_type(4, 2, 32).names) and not kept & working and len(kept) == 7


def test_a_forager_that_changes_to_itself_credits_no_action_that_it_has_not_taken():
    run = Run(forager(), WaterWorld(), seed=0)
    run.advance(30_000)
    first, other = run.q(0)[0, 0].copy(), run.copy()
    other.change(forager())
    for each in (run, other):
        each.advance(3_000)
    assert_same(run, other)
    assert np.array_equal(run.q(0)[0, 0], first) or run.q(0)[0, 0, 2] > first[2]  # only as it is visited


@pytest.mark.parametrize("changes", [{"memory": 0.0}, {"memory": 9.0}, {"learning_rate": 0.5}, {"bootstrap": True}])
def test_another_rule_of_learning_takes_no_values(changes):
    run = Run(multimodal([3, 5]), TANK)
    run.advance(5_000)
    knows = [run.q(m).copy() for m in range(4)]
    run.change(replace(run.agent, learning=replace(run.agent.learning, **changes)))
    assert all(np.array_equal(run.q(m), knows[m]) and knows[m].any() for m in range(4))
    run.advance(500)


OVC = Node("OVC", CARTESIAN_OBJECT_VECTOR_CELL, [4, 5])
WANTS = [Desire("green", "OVC", 1.0)]


@pytest.mark.parametrize("other, message", [
    (replace(OVC, state="per object"), "of its map 0 state is 'per object', and here 'object'"),
    (replace(OVC, name="V"), "of its map 0 node is 'V', and here 'OVC'"),
    (replace(OVC, beyond="none"), "of its map 0 beyond is 'none', and here 'outermost'"),
    (replace(OVC, resolutions=[4, 6]), "of its map 1 map is NresMap.*resolution=6.* and here .*resolution=5"),
    (replace(OVC, goals="contacts"), "of its map 0 goals is 'contacts', and here 'cells'"),
    (replace(OVC, resolutions=[4]), "must have as many maps as this one, 2, but has 1")])
def test_values_go_to_the_same_maps_alone(other, message):
    taught, teacher = (Run(Agent([node], [replace(WANTS[0], target=node.name)]), TANK) for node in (OVC, other))
    teacher.advance(2_000)
    with pytest.raises(ValueError, match=message):
        taught.transfer(teacher)
    assert not taught.q(0).any()


def test_a_kind_of_thing_has_one_worth_however_many_nodes_want_it():
    nodes = [Node(name, PLACE_CELL, [3]) for name in "ABC"]
    for count in (1, 2, 3):
        learner = Learner(Agent(nodes[:count], [Desire("green", node.name, "learned") for node in nodes[:count]]), 1,
                          ("green",))
        learner.begin(Scene((0.5, 0.5), None, [(0.2, 0.2)], (0,)))
        for _ in range(60):
            learner.act()
            learner.observe(Scene((0.5, 0.5), None, [(0.2, 0.2)], (0,), (1,)), reward=3.0)
        assert np.allclose(learner.state.desires.worth, 3.0, atol=0.05)
        assert learner.state.desires.meetings.tolist() == [60] * count


def test_a_node_that_comes_to_want_a_kind_knows_its_worth():
    run = Run(forager(), BASIN)
    run.advance(2_000)
    worth = run.state.desires.worth[0]
    run.change(Agent([*run.agent.nodes, Node("more", FOVEATED_CELL, [3], goals="contacts")],
                     [Desire("green", "more", "learned"), *run.agent.desires], contacts=Contacts()))
    assert run.state.desires.worth[0] == worth != 0.0


@kernel
def nothing_at_the_wall(scene, point):
    return np.nan if scene.position[0] < 10.0 else 0.5


def test_a_kernel_that_returns_nan_is_named_before_anything_goes_on():
    sees = Agent([Node("own", Modality("own cell", [Axis(nothing_at_the_wall)]), [3])])
    started = Learner(sees, size=100.0)
    with pytest.raises(ValueError, match="nothing_at_the_wall of an axis must return numbers, but has returned NaN"):
        started.begin(Scene((1.0, 50.0)))
    plain = Learner(Agent([Node("PC", PLACE_CELL, [3])]), size=100.0)
    plain.begin(Scene((1.0, 50.0)))
    with pytest.raises(ValueError, match="nothing_at_the_wall of an axis must return numbers, but has returned NaN"):
        plain.change(sees)
    assert plain.agent.nodes[0].name == "PC"
    plain.act()
    fine = Learner(sees, size=100.0)
    fine.change(replace(sees, policy=Policy(0.5)))  # before its first scene, it sees nothing
    fine.begin(Scene((50.0, 50.0)))
    assert fine.act() in range(5)
