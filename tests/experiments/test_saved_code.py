"""What is saved knows the user's code: other code of the same name is never taken for it, and results can be read."""

import importlib
import os
import pickle
import re
import subprocess
import sys
import types
from contextlib import contextmanager, nullcontext
from dataclasses import replace

import numpy as np
import pytest
from saved_files import rewrite

from neorl import Condition, Learner, Result, Run, WaterWorld, place_cells, simulate
from neorl.experiments.bins import new_bins
from neorl.kernels.kernel import jit_is_off

ROOMS = '''
from dataclasses import dataclass
from typing import NamedTuple

import pays
from neorl import CARDINAL, Agent, Learning, Node, Policy, Scene, World, kernel
from neorl.custom import Axis, Dynamics, Modality, array, kernel_maker

class State(NamedTuple):
    scene: Scene
    stream: array("uint64", 4)

class Rules(NamedTuple):
    more: float

@kernel
def reset(state: State, rules: Rules) -> None:
    state.scene.position[0] = state.scene.position[1] = 0.5

@kernel
def step(state: State, rules: Rules, action: int):
    return pays.pay * rules.more, False

@dataclass(frozen=True)
class Room(World):
    kinds, actions, things, size, fps = ("red", "green"), CARDINAL, 2, 1.0, {fps}
    dynamics, rules = Dynamics(reset, step), Rules({rules})

@kernel
def credit(count, steps, last, activity):
    return {credit}

@kernel
def axis(scene, point):
    return scene.position[0] * {axis}

@kernel
def argument(value, stream):
    return {argument}

@kernel_maker
def policy(of, shift):
    @kernel
    def choose(value, stream):
        return of(value, stream) + shift * {policy}
    return choose

def agent():
    modality = Modality("own", (Axis("position"), Axis(axis)))
    return Agent((Node("PC", modality, [2]),), learning=Learning(credit=credit),
                 policy=Policy(0.0, choose=policy(argument, 1)))
'''
AT_FIRST = {"fps": 5, "rules": 1.0, "pays": 1.0, "credit": 1.0, "axis": 1.0, "argument": 1, "policy": 1}
NAMES = {"fps": ("world", "Room"), "rules": ("world", "Room"), "pays": ("world", "Room"),
         "credit": ("agent.learning.credit", "credit"), "axis": ("agent.nodes[0].modality.axes[1].of", "axis"),
         "argument": ("agent.policy.choose.of[0]", "argument"), "policy": ("agent.policy.choose", "policy")}
SAYS_WHERE = "can be read again by .*rooms.py alone, where __main__:.* stands: to read it elsewhere, move that to a mod"
ONCE = [part for part in NAMES if part not in ("fps", "rules")]  # each part once


def written(folder, numbers, module="rooms"):
    """The program with these numbers, newly imported from a folder, or as the main one."""
    (folder / "rooms.py").write_text(ROOMS.format(**numbers))
    (folder / "pays.py").write_text(f"pay = {numbers['pays']}")
    for name in ("rooms", "pays"):
        sys.modules.pop(name, None)
    importlib.invalidate_caches()
    if module == "rooms":
        return importlib.import_module("rooms")
    program = types.ModuleType("__main__")
    program.__file__ = str(folder / "rooms.py")
    sys.modules["__main__"] = program
    exec(ROOMS.format(**numbers), vars(program))
    return program


@contextmanager
def replaceable(folder):
    """A function (module, numbers) that replaces the user's program in a folder, within this context."""
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(folder)
        patch.setattr(sys, "dont_write_bytecode", True)  # which within a second would hide an edit
        for name in ("rooms", "pays", "__main__"):
            patch.setitem(sys.modules, name, sys.modules.get(name, pytest))
        yield lambda module="rooms", **numbers: written(folder, AT_FIRST | numbers, module)


@pytest.fixture
def programs(tmp_path):
    with replaceable(tmp_path) as replaced:
        yield replaced


def saved(program, folder):
    """Save a run, a learner, a result and a condition of the program to files of a folder, and return the result."""
    condition = Condition(program.agent(), program.Room(), 20, 3, 7)
    rewards, hits = new_bins(condition.world, 3, 20)
    rewards.flat, hits.flat = np.arange(rewards.size), np.arange(hits.size)
    result = Result(condition, rewards, hits)
    run = Run(condition.agent, condition.world)
    run.advance(3)
    of_main = condition.world.__module__ == "__main__"
    for kind, each in (("Run", run), ("Learner", Learner(condition.agent)), ("Result", result),
                       ("Condition.json", condition)):
        with pytest.warns(RuntimeWarning, match=f"{kind} {SAYS_WHERE}") if of_main else nullcontext():
            each.save(folder / kind)
    return result


@pytest.fixture(scope="module")
def originals(tmp_path_factory):
    """{module: (folder of what was saved, result, its key)}, of the program at first."""
    found = {}
    for module in ("rooms", "__main__"):
        folder = tmp_path_factory.mktemp(module)
        with replaceable(folder) as replaced:
            result = saved(replaced(module), folder)
            found[module] = folder, result, result.condition.key
    return found


@pytest.fixture(params=[(module, part, change) for module, changes in {
    "rooms": ("edited", "absent"), "__main__": ("another", "absent")}.items() for change in changes
    for part in (ONCE if change == "absent" else NAMES)], ids=" ".join)
def case(request, originals, programs):
    """The folder of what was saved; the result and its key; the path of the part that has changed; a pattern of it."""
    module, part, change = request.param
    path, name = NAMES[part]
    program = programs(module, **{part: AT_FIRST[part] + 1} if change != "absent" else {})
    if change == "absent":
        delattr(program, name)
    how = f"cannot be found: .*{name}" if change == "absent" else "has changed, or another Python has compiled it"
    return *originals[module], path, f"{re.escape(f'{path} ({module}:{name})')} {how}"


@pytest.mark.parametrize("kind", [Run, Learner])
def test_a_run_goes_on_with_no_other_code_and_names_what_has_changed(case, kind):
    folder, _, _, path, named = case
    if kind is Learner and path == "world":
        Learner.load(folder / "Learner")
        return
    with pytest.raises(ValueError, match=f"a {kind.__name__} must go on with the code .*{named}.* or begin another"):
        kind.load(folder / kind.__name__)


def test_a_result_gives_its_data_in_every_case_and_its_condition_is_of_other_code(case, tmp_path):
    folder, result, key, path, named = case
    with pytest.warns(RuntimeWarning, match=f"Result has a result of other code than the present: .*{named}"):
        again = Result.load(folder / "Result")
    assert np.array_equal(again.rewards, result.rewards) and np.array_equal(again.hits, result.hits)
    assert (again.steps, again.runs, again.seed, again.seconds) == (20, 3, 7, 4.0)
    assert np.array_equal(again.rate(), result.rate()) and np.array_equal(again.hit_rate(0.5), result.hit_rate(0.5))
    assert again.world.kinds == ("red", "green") and again.agent.maps[0].resolution == 2
    program = sys.modules[result.world.__module__]
    if hasattr(program, "Room") and path == "world":
        now = replace(again.condition, world=program.Room())
        assert again.condition != now and again.condition.key != now.key != key
    assert ("FormerWorld(name=" if path == "world" else "former_kernel(") in repr(again.condition)
    with pytest.warns(RuntimeWarning) if "__main__" in named else nullcontext():
        again.save(tmp_path / "again")
    assert Result.load(tmp_path / "again") == again
    assert jit_is_off() or pickle.loads(pickle.dumps(again)) == again
    with pytest.raises(ValueError, match=f"{result.world.__module__}:.* must have the code that a saved result was"):
        simulate(**again.condition.choices, progress=False)


def test_a_condition_stays_by_name_since_people_write_it(case):
    folder, _, key, path, named = case
    if "cannot be found" in named:
        with pytest.raises(ValueError, match=f"{re.escape(path)}.* must be a name of neorl, or 'module:name' of what"):
            Condition.load(folder / "Condition.json")
    else:
        assert Condition.load(folder / "Condition.json").key != key


@pytest.mark.parametrize("module", ["rooms", "__main__"])
def test_the_same_code_goes_on_bit_for_bit_wherever_it_is_read_again(originals, programs, module):
    folder, _, key = originals[module]
    programs(module)
    assert Run.load(folder / "Run").advance(10) == 10
    assert Learner.load(folder / "Learner").agent.maps[0].resolution == 2
    assert Result.load(folder / "Result").condition.key == key == Condition.load(folder / "Condition.json").key


def test_a_saved_world_of_the_main_program_says_where_it_can_be_read_again(programs, tmp_path):
    with pytest.warns(RuntimeWarning, match=f"room.json {SAYS_WHERE}"):
        programs("__main__").Room().save(tmp_path / "room.json")


def test_code_without_a_digest_is_refused_with_the_reason(programs, tmp_path):
    saved(programs(), tmp_path)
    for kind in (Run, Result):
        rewrite(tmp_path / kind.__name__, lambda about, _: about.pop("code"))
        with pytest.raises(ValueError, match=r"the digest of .* \(rooms:axis\) must be in the file, but is not: an"):
            kind.load(tmp_path / kind.__name__)


def test_what_is_of_neorl_alone_is_read_without_digests(tmp_path):
    Run(place_cells([2]), WaterWorld()).save(tmp_path / "run")
    rewrite(tmp_path / "run", lambda about, _: about.pop("code"))
    assert Run.load(tmp_path / "run").step == 0


def test_what_stands_for_former_code_says_so_when_it_is_run(programs, tmp_path):
    saved(programs(), tmp_path)
    programs(policy=2, pays=2.0)
    with pytest.warns(RuntimeWarning, match="agent.policy.choose .* has changed.*; world .* has changed"):
        former = Result.load(tmp_path / "Result")
    learner = Learner(place_cells([2]), 1, ("green", "red"))
    for run in (lambda: Run(former.agent, WaterWorld()), lambda: Learner(former.agent),
                lambda: Run(place_cells([2]), former.world), lambda: learner.change(former.agent),
                lambda: former.world.reset(0)):
        with pytest.raises(ValueError, match="rooms:.* must have the code that a saved result was computed with to be"):
            run()


SCRIPT = """
import sys
from neorl import Run, place_cells
{}
run = Run(place_cells([2]), Room()) if sys.argv[1] == "save" else Run.load("run.npz")
print(run.advance(100))
run.save("run.npz")
"""


def test_two_programs_with_a_class_of_one_name_are_not_confused(tmp_path):
    def ran(name, how, jit=True):
        done = subprocess.run([sys.executable, f"{name}.py", how], cwd=tmp_path, capture_output=True, text=True,
                              env=os.environ | {"NUMBA_DISABLE_JIT": str(int(not jit))})
        return done.stdout + done.stderr

    (tmp_path / "pays.py").write_text("pay = 1.0")
    for name, rules in (("one", 1.0), ("other", 9.0)):
        (tmp_path / f"{name}.py").write_text(SCRIPT.format(ROOMS.format(**AT_FIRST | {"rules": rules})))
    said = ran("one", "save")
    assert said.startswith("100.0") and "run.npz can be read again by" in said and "one.py:" in said
    assert ran("one", "load", jit=False).startswith("100.0")  # the same code, compiled or not
    assert re.search(r"world \(__main__:Room\) has changed", ran("other", "load"))
