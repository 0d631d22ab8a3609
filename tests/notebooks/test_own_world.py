"""The page "Bring your own world": what its cells define, by itself and in a notebook, whose module is `__main__`."""

import json
import os
import subprocess
import sys

import numpy as np
import pytest
from page_cells import assert_captions_end_with_numbers_of_their_figures, code, executed, notebook

from neorl import CARDINAL
from neorl.custom import execute
from neorl.core.stream import new_stream

SHELL = """
import json, sys
from IPython.core.interactiveshell import InteractiveShell

for cell in json.loads(sys.argv[1]):
    InteractiveShell.instance().run_cell(cell).raise_error()
"""
SETUP = """
import json, sys
from neorl import *
from neorl.custom import *
from neorl.experiments import store
from neorl.core.modality import PLACE_CELL

def agent():
    cells = Modality("walls", [*PLACE_CELL.axes, Axis(wall_distance, boundaries=(0, 0.1, 0.5))])
    return Agent([Node("PWC", cells, [6])], [Desire("pad", "PWC", 1.0)], Learning(0.3, credit=recent_credit),
                 Policy(choose=second_best(0.1)))

def look():
    condition = Condition(agent(), Pond(), 600, 2)
    known = store.load(condition) is not None
    reward = simulate(**condition.choices, cache=True, progress=False).rewards.sum()
    print(json.dumps([condition.key, float(reward), known]))
"""
SAVED = """
learner = Learner(agent(), things=1, kinds=["pad"])
learner.begin(Scene([0.1, 0.2], things=[[0.8, 0.3]], kinds=["pad"]))
for x in (0.2, 0.1, 0.2):
    learner.act()
    learner.observe(Scene([x, 0.2], things=[[0.8, 0.3]], kinds=["pad"]))
run = Run(agent(), Pond())
run.advance(600)
learner.save("learner.npz"), run.save("run.npz")
"""
LOADED = """
print(json.dumps([[Learner.load("learner.npz").act() for _ in range(3)], Run.load("run.npz").advance(300),
                  str(Run.load("run.npz").world)]))
"""


@pytest.fixture
def session(tmp_path, cache_folder):
    """Run cells as a notebook does, in a process of their own, and return what they print, each line read as JSON.

    Nothing is compiled there: the book's build runs the page with the compiler.
    """
    def session(*cells):
        done = subprocess.run([sys.executable, "-c", SHELL, json.dumps(cells)], cwd=tmp_path, capture_output=True,
                              text=True, env=os.environ | {"IPYTHONDIR": str(tmp_path / "ipython"),
                                                           "NUMBA_DISABLE_JIT": "1"})
        assert done.returncode == 0, done.stdout + done.stderr
        return [json.loads(line) for line in done.stdout.splitlines() if line.startswith("[")]

    return session


def test_what_cells_define_is_cached_and_saved_like_what_modules_define(session):
    pond, rules = (next(cell for cell in code(notebook("own_world")).values() if text in cell)
                   for text in ("class Pond(World)", "def second_best("))
    longer = pond.replace("0.1, 0.04", "0.1, 0.06")
    assert longer != pond
    first, again, changed, back, here = session(pond, rules, SETUP, "look()", pond, rules, "look()", longer, "look()",
                                                "STRIDE = 0.04", "look()", SAVED, LOADED)
    assert again == back == [*first[:2], True] and first[2] is False
    assert changed[0] != first[0] and changed[1] != first[1] and not changed[2]
    later, there = session(pond, rules, SETUP, "look()", LOADED)
    assert later == again and there == here and here[2] == "Pond()"


@pytest.fixture(scope="module")
def page():
    return executed("own_world")


def test_finds_are_counted_in_shares_of_the_run_that_was_made(page):
    found = np.zeros(2_000, bool)
    found[[0, 60, 1_850, 1_950, 1_999]] = True
    assert page.counts("pad", found).splitlines()[-1] == "| pad | 5 | 2 | 3 |"


def test_the_pond_of_kernels_is_that_of_the_loop(page):
    world = page.Pond()
    state, rng, finds, pad = world.reset(0), np.random.default_rng(0), 0, np.array([0.8, 0.3])
    for _ in range(300):
        state.scene.position[:], action = rng.random(2), rng.integers(4)
        expected = (state.scene.position + 0.04 * CARDINAL.table[action]).clip(0, 1)
        met = ((expected - pad) ** 2).sum() < 0.1**2
        assert world.step(state, action) == (float(met), [met], met)
        np.testing.assert_array_equal(state.scene.position, expected)
        finds += met
    assert finds


def test_credit_is_highest_for_the_last_event(page):
    credit = page.recent_credit
    assert [execute(credit, *each, 0.0) for each in [(3, 9, True), (3, 9, False), (0, 9, False)]] == [1, 0.5, 0]


@pytest.mark.parametrize("value, best, second", [([0.1, 0.4, 0.3, 0.2], 1, 2), ([0.9, 0.1, 0.2, 0.4], 0, 3)])
def test_the_policy_takes_the_second_best_action_in_its_share_of_steps(page, value, best, second):
    stream, value = new_stream(np.random.SeedSequence(0)), np.array(value)
    for share, allowed in [(0.0, {best}), (1.0, {second}), (0.5, {best, second})]:
        assert {int(execute(page.second_best(share), value, stream)) for _ in range(40)} == allowed
    equal = np.zeros(4)
    assert {int(execute(page.second_best(0.0), equal, stream)) for _ in range(80)} == {0, 1, 2, 3}


def test_the_turtle_goes_ahead_and_turns_by_an_eighth(page):
    turtle = page.Turtle()
    observation, _ = turtle.reset(0)
    turtle.position, turtle.heading = np.array([0.5, 0.25]), 0
    observation, reward, done, truncated, _ = turtle.step(0)
    assert observation["position"] == pytest.approx([0.56, 0.25]) and (reward, done, truncated) == (0.0, False, False)
    assert turtle.step(2)[0]["heading"] == pytest.approx(np.pi / 4) and turtle.step(1)[0]["heading"] == 0
    assert [turtle.step(0)[2] for _ in range(2)] == [False, True]
    scene = page.scene_of({"position": np.array([0.1, 0.2]), "heading": np.pi / 2})
    assert np.allclose(scene.velocity, [0, 1]) and np.allclose(scene.position, [0.1, 0.2])


def test_captions_end_with_numbers_of_their_figures(page):
    assert_captions_end_with_numbers_of_their_figures(page)
