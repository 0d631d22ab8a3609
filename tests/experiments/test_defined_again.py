"""What a notebook's cell made is the same after the cell has run again; other code of the same name is refused."""

import copy
import pickle
import sys
import types

import cloudpickle
import numpy as np
import pytest

from neorl import Agent, Condition, Learner, Run, World, simulate, sweep
from neorl.kernels.identity import identity
from neorl.kernels.kernel import jit_is_off

CELL = """
from dataclasses import dataclass
from typing import NamedTuple

from neorl import CARDINAL, Agent, Desire, Learning, Node, Policy, Scene, World, kernel
from neorl.custom import Axis, Dynamics, Modality, array, kernel_maker

class State(NamedTuple):
    scene: Scene
    stream: array("uint64", 4)
    visits: array("int64", 1)

class Rules(NamedTuple):
    more: array("float64", 2)

@kernel
def reset(state: State, rules: Rules) -> None:
    state.scene.position[0] = state.scene.position[1] = 0.5

@kernel
def step(state: State, rules: Rules, action: int):
    state.scene.position[0] = 0.1 * action
    state.visits[0] += 1
    return rules.more[0] + action, False

@dataclass(frozen=True)
class Room(World):
    light: float = 1.0
    things, kinds, size, actions, fps, dynamics = 0, (), 1.0, CARDINAL, 5, Dynamics(reset, step)

    @property
    def rules(self):
        return Rules(CARDINAL.table[0] + self.light)

@kernel
def credit(count, steps, last, activity):
    return 0.5

@kernel
def axis(scene, point):
    return scene.position[0]

@kernel
def choose(value, stream):
    return 2

@kernel_maker
def shifted(of, by):
    @kernel
    def choose(value, stream):
        return of(value, stream) - by
    return choose

OWN = Modality("own", (Axis(axis),))
"""
MADE = """
agent = Agent([Node("PC", OWN, [3])], learning=Learning(credit=credit), policy=Policy(0.0, choose=shifted(choose, 1)))
world = Room()
"""
EDITS = {"credit": ("return 0.5", "return 0.25"), "axis": ("return scene.position[0]", "return scene.position[1]"),
         "choose": ("return 2", "return 1"), "shifted": ("stream) - by", "stream) + by"),
         "step": ("] + action, False", "] - action, False"), "Room": ("CARDINAL, 5,", "CARDINAL, 6,"),
         "Rules": ("more: array(\"float64\", 2)", "more: array(\"float64\", 2)\n    less: float = 0.0"),
         "State": ("visits: array(\"int64\", 1)", "visits: array(\"int64\", 2)")}
OF_WORLD = ("step", "Room", "Rules", "State")
SINCE = "defined again since, with other code: make again what was made with it"
pytestmark = pytest.mark.filterwarnings("ignore:.* can be read again by .* alone:RuntimeWarning")
needs_compiler = pytest.mark.skipif(jit_is_off(), reason="without the compiler, kernels are functions to pickle")


@pytest.fixture
def notebook(monkeypatch):
    """The namespace of a main program that has run the cell, and has made an agent and a world."""
    program = types.ModuleType("__main__")
    monkeypatch.setitem(sys.modules, "__main__", program)
    exec(CELL + MADE, vars(program))
    return program


def again(notebook, *edit):
    """Run the cell again, perhaps edited."""
    exec(CELL.replace(*edit) if edit else CELL, vars(notebook))


def test_after_the_cell_has_run_again_what_was_made_before_is_saved_and_runs(notebook, tmp_path, cache_folder):
    agent, world = notebook.agent, notebook.world
    condition, run, learner = Condition(agent, world, 20, 1), Run(agent, world), Learner(agent)
    data, key, result = condition.to_dict(), condition.key, simulate(agent, world, steps=20, runs=1, progress=False)
    run.advance(10)
    again(notebook)
    assert condition.to_dict() == data and condition.key == key and run.copy().advance(10) == run.advance(10) == 20.0
    for made, kind in ((agent, Agent), (world, World), (condition, Condition)):
        made.save(tmp_path / "made.json")
        assert identity(copy.deepcopy(made)) == identity(made) == identity(kind.from_dict(made.to_dict()))
    for made in (run, learner, result):
        made.save(tmp_path / "made")
        assert identity(type(made).load(tmp_path / "made").agent) == identity(agent)
    assert np.array_equal(simulate(agent, world, steps=20, runs=1, progress=False).rewards, result.rewards)
    assert [each.totals for each in sweep([condition], progress=False)] == [result.totals]
    state = world.reset(0)
    assert notebook.Room().step(state, 3)[0] == world.step(state, 3)[0] == 4.0


@needs_compiler
@pytest.mark.parametrize("module", [pickle, cloudpickle])
def test_after_the_cell_has_run_again_what_was_made_before_is_pickled(notebook, module):
    made = notebook.agent, notebook.world, notebook.world.reset(0), Run(notebook.agent, notebook.world)
    again(notebook)
    agent, world, state, run = pickle.loads(module.dumps(made))
    assert identity((agent, world)) == identity(made[:2]) and run.advance(5) == made[-1].advance(5) == 10.0
    assert world.step(state, 0)[0] == made[1].step(made[2], 0)[0]
    assert module is cloudpickle or type(world) is notebook.Room and type(state) is notebook.State


@pytest.mark.parametrize("part", EDITS)
def test_after_an_edited_cell_has_run_what_was_made_before_runs_as_it_was_but_is_not_saved(notebook, part, tmp_path):
    agent, world = notebook.agent, notebook.world
    made, run = world if part in OF_WORLD else agent, Run(agent, world)
    again(notebook, *EDITS[part])
    for save in (made.to_dict, lambda: made.save(tmp_path / "made.json"), lambda: run.save(tmp_path / "run")):
        with pytest.raises(ValueError, match=f"__main__:.* has been {SINCE}"):
            save()
    if not jit_is_off():  # kernels are functions then, of which pickle says so in its own words
        with pytest.raises((pickle.PicklingError, ValueError), match=f"__main__:.* has been {SINCE}"):
            pickle.dumps(run)
    if part == "Rules":
        with pytest.raises(ValueError, match=f"rules must be a Rules, but is Rules.* has been {SINCE}"):
            run.advance(5)
    else:
        assert jit_is_off() or identity(pickle.loads(cloudpickle.dumps(made))) == identity(copy.deepcopy(made))
        assert run.copy().advance(5) == run.advance(5) == 10.0


@needs_compiler
@pytest.mark.parametrize("part", EDITS)
def test_what_was_pickled_by_name_is_refused_where_the_name_has_other_code(notebook, part):
    made = notebook.world if part in OF_WORLD else notebook.agent
    joblib = pytest.importorskip("joblib")  # which the package does without
    pickled, digest = pickle.dumps(made), joblib.hash(made)
    assert joblib.hash(made) == digest
    again(notebook, *EDITS[part])
    with pytest.raises(ValueError, match="__main__:.* must have the code that it was pickled with, but has other code"):
        pickle.loads(pickled)
    exec(MADE, vars(notebook))
    assert joblib.hash(notebook.world if part in OF_WORLD else notebook.agent) != digest
