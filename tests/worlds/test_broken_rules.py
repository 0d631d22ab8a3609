"""Kernels of a user's world that break the rules of worlds: an error names the kernel, and nothing crashes.

Run as a program, this file prints the error of every way to break a rule.
"""

import json
import os
import subprocess
import sys
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import pytest

from neorl import CARDINAL, Agent, Node, Policy, Run, Scene, World, kernel, simulate
from neorl.core.kernel import array
from neorl.core.modality import PLACE_CELL
from neorl.gym.environment import WorldEnv
from neorl.worlds.world import Dynamics


class PerchState(NamedTuple):
    scene: Scene
    stream: array("uint64", 4)


class PerchRules(NamedTuple):
    begins_at: float
    met: int
    kind: int
    pays: float


@kernel
def settle(state: PerchState, rules: PerchRules) -> None:
    state.scene.position[0] = rules.begins_at


@kernel
def peck(state: PerchState, rules: PerchRules, action: int):
    scene = state.scene
    scene.velocity[0] += 1.0  # so that it counts the steps, of which only the third breaks a rule
    third = scene.velocity[0] == 3.0
    scene.met[0], scene.kinds[0] = rules.met if third else 0, rules.kind
    return rules.pays if third else 1.0, False


@dataclass(frozen=True)
class Perch(World):
    """A place with one seed, whose kernels write what they are told."""

    begins_at: float = 0.5
    met: int = 0
    kind: int = 0
    pays: float = 1.0

    dynamics = Dynamics(settle, peck)
    kinds, actions, things, size, fps = ("seed",), CARDINAL, 1, 1.0, 5

    @property
    def rules(self):
        return PerchRules(self.begins_at, self.met, self.kind, self.pays)


def advance(world):
    Run(WALKER, world).advance(20)


def count(world):
    return simulate(WALKER, world, steps=20, runs=1, progress=False).hits.sum(axis=1).tolist()


def play(world):
    env = WorldEnv(world)
    env.reset(seed=0)
    for _ in range(3):
        env.step(0)


def step(world):
    state = world.reset(0)
    for _ in range(3):
        world.step(state, 0)


WALKER = Agent((Node("PC", PLACE_CELL, [3]),), policy=Policy(1.0))
CALLS = {each.__name__: each for each in (advance, count, play, step)}
MET = {f"met {met}": Perch(met=met) for met in (2, 400, 4_000_000, 99_999_999, -1, -(2**62))}
PAYS = {"a reward of nan": Perch(pays=np.nan), "a reward of -inf": Perch(pays=-np.inf)}
BROKEN = {**MET, **PAYS, "kind 7": Perch(kind=7), "no place": Perch(begins_at=np.nan)}


def errors():
    """What each way to break a rule leads to: {call, way: the text of the error}."""
    found = {}
    for way, world in BROKEN.items():
        for name, call in CALLS.items():
            try:
                found[f"{name}, {way}"] = f"no error, but {call(world)}"
            except ValueError as error:
                found[f"{name}, {way}"] = str(error)
    return found


@pytest.fixture(scope="module", params=["compiled", "interpreted"])
def told(request):
    off = {} if request.param == "compiled" else {"NUMBA_DISABLE_JIT": "1"}
    done = subprocess.run([sys.executable, __file__], capture_output=True, text=True, env={
        **os.environ, **off, "PYTHONPATH": os.pathsep.join(sys.path)})
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


@pytest.mark.parametrize("call", CALLS)
@pytest.mark.parametrize("met", MET)
def test_a_step_that_meets_a_thing_of_no_kind_is_named(told, call, met):
    text = told[f"{call}, {met}"]
    assert "peck broke a rule of worlds: after it, state.scene.met must be " in text and str(MET[met].met) in text
    assert "0, or for a thing that was met 1 + the number of its kind among ('seed',)" in text


@pytest.mark.parametrize("call", ["advance", "count", "step"])  # an observation has 0 for all kinds that are unknown
def test_a_step_that_makes_a_thing_of_no_kind_is_named(told, call):
    said = "peck broke a rule of worlds: after it, state.scene.kinds must be −1 or the numbers of ('seed',), but is"
    assert f"{said} array([7])" in told[f"{call}, kind 7"]


@pytest.mark.parametrize("call", CALLS)
def test_a_reset_that_leaves_no_place_is_named(told, call):
    assert "settle broke a rule of worlds: after it, state.scene.position must be finite" in told[f"{call}, no place"]


@pytest.mark.parametrize("call", CALLS)
@pytest.mark.parametrize("way", PAYS)
def test_a_reward_that_is_not_finite_is_named(told, call, way):
    text = told[f"{call}, {way}"]
    assert "peck broke a rule of worlds: after it, reward must be a finite number" in text
    assert text.endswith(f"but is {way.split()[-1]}")


def test_a_kernel_that_keeps_the_rules_is_counted():
    assert count(Perch(met=1)) == [[1]]


if __name__ == "__main__":
    print(json.dumps(errors()))
