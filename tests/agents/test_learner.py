"""A learner in a user's own loop: bit-identical to a run, also when saved or copied; bad arguments are refused."""

import copy
import errno
import pickle
from dataclasses import replace

import numpy as np
import pytest
from golden import every_modality, plain_rule
from same import assert_equal, assert_same, newborn
from saved_files import rewrite

from neorl import (CARDINAL, Agent, Desire, Learner, Learning, Node, Place, Policy, Run, Scene, WaterWorld, brownian,
                   drawing, multimodal, network_d, object_vector_cells, place_cells)
from neorl.custom import softmax
from neorl.agents.agent import LEARNED
from neorl.core.modality import CARTESIAN_OBJECT_VECTOR_CELL, PLACE_CELL
from neorl.kernels.annotations import arrays, mapped
from neorl.kernels.execution import execute
from neorl.kernels.kernel import jit_is_off

TANK = WaterWorld(width=100, n_creeps=2, win_reward=5.0)  # small, so that episodes end often
AGENTS = {
    "calibrated": network_d([2, 5]),
    "every modality": every_modality(),
    "at every step": multimodal([5], learning=plain_rule(update_on="step"), object_state="object",
                                policy=Policy(0.1, "no-op")),
    "per object": multimodal([4], learning=plain_rule(memory=7.0, bootstrap=False), object_state="per object"),
    "resets unnoticed": multimodal([4], resets="unnoticed"),
    "softmax": multimodal([4], learning=plain_rule(credit="activity", memory=3.0), policy=Policy(choose=softmax(0.2))),
}


def test_an_agent_with_the_defaults_learns_in_a_plain_loop_on_every_seed():
    agent = Agent([Node("PC", PLACE_CELL, [10])], [Desire(Place(0.8, 0.3), "PC", 1.0)])
    for seed in range(20):
        learner, at, far = Learner(agent, seed=seed), np.array([0.5, 0.5]), []
        learner.begin(Scene(at))
        for _ in range(5_000):
            at = np.clip(at + 0.05 * CARDINAL.table[learner.act()], 0, 1)
            learner.observe(Scene(at))
            far.append(np.hypot(*(at - (0.8, 0.3))))
        assert np.mean(far[-1_000:]) < 0.3, seed  # at random it is 0.4 to 0.55


def take(learner, world, state, action):
    """Carry out an action; returns whether the episode has ended."""
    _, _, done = world.step(state, action)
    learner.observe(state.scene)
    if done:
        execute(world.dynamics.reset, state, world.rules)
        learner.begin(state.scene)
    return done


def live(learner, world, state, steps):
    """Act for a number of steps; returns the actions."""
    actions = []
    for _ in range(steps):
        actions.append(learner.act())
        take(learner, world, state, actions[-1])
    return actions


@pytest.mark.parametrize("half_way", [False, True], ids=["whole", "half-way"])
@pytest.mark.parametrize("name", AGENTS)
def test_a_learner_goes_on_from_a_copy_a_pickle_or_a_file_to_the_same_bit(name, half_way, tmp_path):
    learner, state = newborn(AGENTS[name], TANK)
    live(learner, TANK, state, 400)
    action = learner.act() if half_way else None
    learner.save(tmp_path / "learner")
    others = [learner.copy(), Learner.load(tmp_path / "learner"), copy.copy(learner), copy.deepcopy(learner)]
    if not (jit_is_off() and name == "softmax"):  # a function within a function, which pickle refuses
        others.append(pickle.loads(pickle.dumps(learner)))
    states = [mapped(np.copy, state) for _ in others]
    assert others[1].agent == learner.agent and others[1].world == learner.world
    lives = []
    for each, there in zip([learner, *others], [state, *states]):
        if half_way:
            with pytest.raises(RuntimeError, match=r"act\(\) must follow begin\(scene\) or observe\(scene\), but came"):
                each.act()
            take(each, TANK, there, action)
        lives.append(live(each, TANK, there, 400))
    assert all(actions == lives[0] for actions in lives)
    for other in others:
        assert_equal(learner, other)


def test_a_run_goes_on_from_a_pickle_to_the_same_bit():
    run = Run(AGENTS["calibrated"], TANK)
    run.advance(400)
    other = pickle.loads(pickle.dumps(run))
    assert run.advance(400) == other.advance(400)
    assert_same(run, other)


def test_a_learner_that_has_not_begun_is_kept_as_such(tmp_path):
    learner = Learner(place_cells([3]), 2, ("green", "red"))
    learner.save(tmp_path / "learner")
    for other in (learner.copy(), Learner.load(tmp_path / "learner")):
        with pytest.raises(RuntimeError, match="before the first scene"):
            other.act()


@pytest.mark.parametrize("bootstrap", [True, False])
def test_values_stay_those_of_their_goals_when_the_order_of_q_changes(bootstrap):
    rules = [plain_rule(memory=3.0, bootstrap=each) for each in (bootstrap, not bootstrap)]
    learner, state = newborn(multimodal([3, 4], learning=rules[0]), TANK)
    live(learner, TANK, state, 3_000)
    knows = [learner.q(m).copy() for m in range(4)]
    other = newborn(multimodal([3, 4], learning=rules[1]), TANK)[0]
    other.transfer(learner)
    learner.change(multimodal([3, 4], learning=rules[1]))
    for each in (learner, other):
        assert all(np.array_equal(each.q(m), knows[m]) and knows[m].any() for m in range(4))
    assert learner.q(0).flags.c_contiguous is not bootstrap


def test_learning_continues_from_transferred_values_as_at_their_source():
    """Learning covers only the range of goals whose values may differ from 0, so the ranges must be transferred too."""
    agent = multimodal([4, 6], learning=plain_rule(absent_decay=0.1), policy=Policy(0.1))
    source = Run(agent, TANK, seed=1)
    source.advance(3_000)
    pupils = [newborn(agent, TANK, seed=8) for _ in range(2)]
    pupils[0][0].transfer(source)
    pupils[1][0]._memory.q[:] = source.memory.q
    pupils[1][0]._memory.goal_range[:] = [[0, each.cells] for each in agent.maps for _ in range(each.cells)]
    np.testing.assert_array_equal(pupils[0][0].memory.goal_range, source.memory.goal_range)
    lives = [live(learner, TANK, state, 1_000) for learner, state in pupils]
    assert lives[0] == lives[1]
    np.testing.assert_array_equal(pupils[0][0].memory.q, pupils[1][0].memory.q)
    assert not np.array_equal(pupils[0][0].memory.q, source.memory.q)


def test_values_state_and_parameters_are_views_that_cannot_be_written_to():
    learner, state = newborn(place_cells([3]), TANK)
    view = learner.q()
    live(learner, TANK, state, 1_000)
    assert view.any()
    for array in (view, learner.state.maps, learner.state.rates, *arrays(learner.memory).values()):
        with pytest.raises(ValueError, match="read-only"):
            array.fill(1)
    with pytest.raises(ValueError, match="index must be an integer from 0 to 0, but is 1"):
        learner.q(1)


FINE = Scene((0.5, 0.5), None, [(0.1, 0.2), (0.3, 0.4)], ["red", None])
BAD_SCENES = [
    ({"position": (0.5,)}, r"scene.position must be numbers of the shape \(2,\), but is \(0.5,\)"),
    ({"position": (np.nan, 0.5)}, r"scene must be of finite numbers from -1e\+30 to 1e\+30, but is Scene\(position=\("),
    ({"things": [(0.1, 0.2)]}, r"scene.things must be numbers of the shape \(2, 2\), but is \[\(0.1, 0.2\)\]"),
    ({"kinds": ["blue", None]}, r"scene.kinds must be a list of 2, each None, 'green', 'red', -1, 0 or 1, but is \['b"),
    ({"kinds": [-2, None]}, "scene.kinds must be .*, but is .*-2, None"),
    ({"kinds": [["red"], None]}, "scene.kinds must be a list of 2, each None, 'g"),
    ({"met": [1]}, r"scene.met must be numbers of the shape \(2,\), but is \[1\]")]


@pytest.mark.parametrize("call", ["begin", "observe"])
@pytest.mark.parametrize("change, message", BAD_SCENES)
def test_a_scene_that_does_not_fit_is_refused_and_changes_nothing(call, change, message):
    learner = Learner(multimodal([3]), 2, ("green", "red"))
    learner.begin(FINE)
    learner.act()
    before, scene = learner.copy(), mapped(np.copy, learner._scene)
    with pytest.raises(ValueError, match=message):
        getattr(learner, call)(FINE._replace(**change))
    assert_equal(before, learner)
    assert_equal(scene, learner._scene)
    learner.observe(FINE)


def test_kinds_go_by_name_or_by_number_and_what_is_absent_may_be_anywhere():
    cells = []
    for kinds, second in [(["red", None], 0.4), ([1, -1], 0.4), (np.array([1, -1], np.int8), np.nan),
                          (["red", None], 9.0)]:
        learner = Learner(multimodal([3], object_state="object"), 2, ("green", "red"))
        learner.begin(FINE._replace(kinds=kinds, things=[(0.1, 0.2), (0.3, second)]))
        cells.append(learner.memory.tracks.cell.tolist())
    assert cells[0] == cells[1] == cells[2] == cells[3] and cells[0][-1] == -1


@pytest.mark.parametrize("calls, message", [
    (["act"], r"act\(\) must follow begin\(scene\) or observe\(scene\), but came before the first scene"),
    (["observe"], r"observe\(scene\) must follow act\(\), but came before it"),
    (["begin", "observe"], r"observe\(scene\) mus"),
    (["begin", "act", "act"], r"act\(\) must follow begin\(scene\) or observe\(scene\), but came"),
    (["begin", "act", "observe", "observe"], r"observe\(scene\) mus"),
])
def test_steps_out_of_order_are_refused(calls, message):
    learner = Learner(multimodal([3]), 2, ("green", "red"))
    given = {"begin": [FINE], "observe": [FINE], "act": []}
    for call in calls[:-1]:
        getattr(learner, call)(*given[call])
    before = learner.copy()
    with pytest.raises(RuntimeError, match=message):
        getattr(learner, calls[-1])(*given[calls[-1]])
    assert_equal(before, learner)


def watcher(rule):
    """A learner, and scenes with the agent at x and food, if present, at the other end."""
    agent = Agent([Node("OVC", CARTESIAN_OBJECT_VECTOR_CELL, [5])], [Desire("food", "OVC", 1.0)], rule)
    learner = Learner(agent, 1, ("food",))
    return learner, lambda x, kind="food", met=0, food=0.9: Scene((x, 0.5), None, [(food, 0.5)], [kind], [met])


@pytest.mark.parametrize("rule", [plain_rule(), Learning(), plain_rule(memory=5.0, bootstrap=False),
                                  plain_rule(update_on="step")])
def test_nothing_is_learned_from_what_vanishes_and_appears(rule):
    learner, scene = watcher(rule)
    learner.begin(scene(0.1))
    for each in (scene(0.1, None), scene(0.9), scene(0.9, None), scene(0.2, None), scene(0.2), scene(0.3, None),
                 scene(0.6)):
        learner.act()
        learner.observe(each)
        assert (learner.memory.tracks.cell[0] < 0) == (each.kinds == [None])
    assert not learner.q().any()
    learner.act()
    learner.observe(scene(0.9))
    assert learner.q().any()  # from a thing that was present before and after


def test_a_thing_that_is_met_and_vanishes_was_met():
    learner, scene = watcher(plain_rule())
    learner.begin(scene(0.5))
    action = learner.act()
    before = int(learner.memory.tracks.cell[0])
    learner.observe(scene(0.5, None, met=1))
    contact = learner.agent.maps[0].encode([0.0, 0.0])
    assert learner.q()[before, action, contact] > 0 and np.count_nonzero(learner.q()) == 1
    assert learner.memory.tracks.cell[0] < 0


def test_a_reset_that_is_not_noticed_is_one_more_transition():
    for resets in ("noticed", "unnoticed"):
        learner = Learner(Agent([Node("PC", PLACE_CELL, [2])], learning=plain_rule(), resets=resets))
        for begin, end in ((0.2, 0.3), (0.8, 0.9)):
            learner.begin(Scene((begin, 0.1)))
            learner.act()
            learner.observe(Scene((end, 0.1)))
        assert learner.q()[0, :, 1].any() == (resets == "unnoticed") and learner.memory.tracks.cell[0] == 1


@pytest.mark.parametrize("agent", [place_cells([3]), *(
    object_vector_cells([3], object_state=state) for state in ("object", "self", "per object"))])
def test_things_of_a_kind_in_the_same_cell_count_each_or_once(agent):
    def wanted(greens, shared_cell):
        learner = Learner(replace(agent, shared_cell=shared_cell), greens, ("green", "red"))
        learner._memory.q[:] = np.random.default_rng(0).random(len(learner.memory.q))
        learner.begin(Scene((0.1, 0.1), None, [(0.5, 0.5 - 0.01 * k) for k in range(greens)], ["green"] * greens))
        learner.act()
        return learner.output(agent.nodes[0].name)
    one, each, once = wanted(1, "once"), wanted(2, "each"), wanted(2, "once")
    assert one.q.all() and each.q.tolist() == (2 * one.q).tolist() and once.q.tolist() == one.q.tolist()
    assert each.valence == once.valence == 2


@pytest.fixture
def saved(tmp_path):
    learner = Learner(multimodal([3], policy=Policy(choose=softmax(0.2))), 2, ("green", "red"))
    learner.begin(FINE)
    learner.save(tmp_path / "learner")
    return tmp_path / "learner"


@pytest.mark.parametrize("forge", [
    lambda about, kept: about.update(format=1), lambda about, kept: about.update(progress="asleep"),
    lambda about, kept: about.pop("progress"), lambda about, kept: about["agent"].update(colour="red"),
    lambda about, kept: about["world"].update(things=5),
    lambda about, kept: about["agent"].update({"is": "neorl:Brain"}),
    lambda about, kept: about["agent"]["policy"].update(choose={"kernel": "os:getcwd", "of": []}),
    lambda about, kept: kept.pop("q"), lambda about, kept: kept.update(more=np.zeros(3)),
    lambda about, kept: kept["q"].fill(np.nan)])
def test_a_file_of_another_version_or_making_is_refused(saved, forge):
    rewrite(saved, forge)
    with pytest.raises(ValueError, match=str(saved)):
        Learner.load(saved)


@pytest.mark.parametrize("edit", [
    lambda file: file.update(about=np.array(str(file["about"]).replace('_rate": 0.0', '_rate": 0.9'))),
    lambda file: file.update(q=np.ones_like(file["q"])), lambda file: file.update(digest=np.array("0" * 64))])
def test_one_digest_covers_all_of_a_file(saved, edit):
    with np.load(saved) as file:
        content = dict(file)
    edit(content)
    with saved.open("wb") as file:
        np.savez(file, **content)
    with pytest.raises(ValueError, match=f"{saved} must be a file of neorl's, but is damaged"):
        Learner.load(saved)


def test_a_sound_file_that_does_not_fit_into_the_free_memory_is_called_no_damaged_one(tmp_path, monkeypatch):
    Run(place_cells([30]), WaterWorld()).save(tmp_path / "run.npz")
    monkeypatch.setattr("neorl.common.container.free_memory", lambda: 2**20)
    with pytest.raises(MemoryError, match="a run of this agent needs .* GiB of memory, but 0.0 are free"):
        Run.load(tmp_path / "run.npz")


def test_a_folder_is_refused_by_its_own_name_and_other_errors_name_the_file(tmp_path, monkeypatch):
    run = Run(place_cells([2]), WaterWorld())
    for each in (run, Learner(brownian()), WaterWorld()):
        (tmp_path / "folder.json").mkdir(exist_ok=True)
        with pytest.raises(OSError, match=f"^{tmp_path}/folder.json must be a file, but is a folder: add a name for a"):
            each.save(tmp_path / "folder.json")

    def full(*_):
        raise OSError(errno.ENOSPC, "No space left on device", ".neorl-1.tmp")

    monkeypatch.setattr("os.fsync", full)
    with pytest.raises(OSError, match=f"No space left on device: '{tmp_path}/run.npz'$"):
        run.save(tmp_path / "run.npz")


def test_another_learner_is_called_by_the_names_that_users_know():
    for refused in (lambda: Learner(brownian()).transfer(5), lambda: drawing.draw_value_map(5, [(0.5, 0.5)])):
        with pytest.raises(ValueError, match="(other|run) must be a Run or a Learner, but is 5"):
            refused()


def test_what_is_no_learner_or_not_there_is_refused(saved, tmp_path):
    with pytest.raises(ValueError, match="must hold a Run of format 2, but holds a Learner"):
        Run.load(saved)
    with pytest.raises(OSError):
        Learner.load(tmp_path / "nowhere")
    np.savez(tmp_path / "foreign.npz", q=np.zeros(3))
    with pytest.raises(ValueError, match="must be a file of neorl's, but"):
        Learner.load(tmp_path / "foreign.npz")


def test_a_thing_that_is_met_counts_by_the_kind_that_it_had():
    agent = Agent([Node("PC", PLACE_CELL, [3])], [Desire(kind, "PC", LEARNED) for kind in ("green", "red")])
    learner = Learner(agent, 1, ("green", "red"))
    learner.begin(Scene([0.5, 0.5], things=[[0.6, 0.5]], kinds=["green"]))
    learner.act()
    learner.observe(Scene([0.5, 0.5], things=[[0.1, 0.9]], kinds=["red"], met=[True]), reward=3.0)
    assert learner.state.desires.meetings.tolist() == [1, 0] and learner.state.desires.worth[0] == 3.0
