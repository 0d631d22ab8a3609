"""A user's program whose parts are edited at random, between processes and within them: see `test_staleness.py`.

    python tests/edited.py FOLDER SEED EDITS PARTS HOW…    runs the program in FOLDER, and edits it as a notebook would

Every part adds its number to the reward of a step, so that the right reward is known without a run.
"""

import functools
import json
import random
import sys
from concurrent.futures import ProcessPoolExecutor
from contextlib import nullcontext
from multiprocessing import get_context
from pathlib import Path

ACTION = ("action", "shift")  # parts that choose an action, whose number is added, too
PARTS = ("rule", "base", "own", "file", "constant", "helper", "attribute", "table", "closure", "default", *ACTION)
HELPERS = """
from neorl import kernel
HELPER, ATTRIBUTE = {helper}, {attribute}

@kernel
def helped(x):
    return x + HELPER
"""
PROGRAM = """
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

import numpy as np

import helpers
from neorl import CARDINAL, Agent, Node, Policy, Scene, World, kernel
from neorl.custom import Axis, Modality, kernel_maker
from neorl.core.modality import PLACE_CELL
from neorl.kernels.annotations import array
from neorl.worlds.world import Dynamics

RULE, CONSTANT, TABLE, ACTION, SHIFT = {rule}, {constant}, np.array([0.0, {table}]), {action}, {shift}

class State(NamedTuple):
    scene: Scene
    stream: array("uint64", 4)

class Rules(NamedTuple):
    more: float

def adding(amount):
    @kernel
    def add(x):
        return x + amount
    return add

add = adding({closure})

@kernel
def raised(x, by={default}):
    return x + by

@kernel
def seen(scene, point):
    return raised(CONSTANT)

@kernel
def reset(state: State, rules: Rules) -> None:
    state.scene.position[0] = state.scene.position[1] = 0.5

@kernel
def step(state: State, rules: Rules, action: int):
    paid = add(raised(helpers.helped(rules.more + CONSTANT + helpers.ATTRIBUTE + TABLE[1])))
    return paid + action, False

class Base(World):
    base = {base}
    things, size, fps, actions, dynamics = 0, 1.0, 5, CARDINAL, Dynamics(reset, step)

    @property
    def rules(self):
        return Rules(RULE + self.base + self.own + float(Path(__file__).with_name("number").read_text()))

@dataclass(frozen=True)
class Mine(Base):
    own = {own}

@kernel_maker
def always(factor):
    number = factor * SHIFT

    @kernel
    def choose(value, stream):
        return number + ACTION
    return choose

AXIS = Modality("seen", (Axis(seen),))

def agent():
    return Agent((Node("PC", PLACE_CELL, [2]),), policy=Policy(0.0, choose=always(1)))
"""
CELLS = {"closure": "add = adding({closure})", "default": "@kernel\ndef raised(x, by={default}):\n    return x + by\n",
         "own": "Mine.own = {own}", "base": "Base.base = {base}", "table": "TABLE[1] = {table}",
         "helper": "helpers.HELPER = {helper}", "attribute": "helpers.ATTRIBUTE = {attribute}"}


def redrawn(rng, numbers, parts=PARTS):
    """A part, and the same numbers with another one for that part."""
    part = rng.choice(parts)
    choices = [0, 1] if part in ACTION else [k / 4 for k in range(64)]
    return part, numbers | {part: rng.choice([each for each in choices if each != numbers[part]])}


def write(folder, numbers):
    """Write the program, as an editor would."""
    (folder / "number").write_text(str(numbers["file"]))
    (folder / "helpers.py").write_text(HELPERS.format(**numbers))
    (folder / "program.py").write_text(PROGRAM.format(**numbers))


def rerun(program, folder, part, numbers):
    """Change one part of the running program, as a cell of a notebook would."""
    if part == "file":
        (folder / "number").write_text(str(numbers["file"]))
    else:
        cell = CELLS.get(part, f"{part.upper()} = {{{part}}}").format(**numbers)
        exec(compile(cell, f"<cell {cell}>", "exec"), vars(program))


@functools.cache
def lasting(kind, *made_of):
    """A run, a learner or an environment that goes on while the program is edited."""
    return kind(*made_of)


def paid(how, program, numbers):
    """The reward of a step, by one of the ways to run an agent or a world."""
    from neorl import Condition, Learner, Run, Scene, gym, simulate, sweep
    from neorl.core.coordinates import sense

    agent, world, size = program.agent(), program.Mine(), {"steps": 2, "runs": 1}
    action = sum(numbers[part] for part in ACTION)
    if how == "Run":
        return lasting(Run, agent, world).advance(2) / 2
    if how == "Learner":
        learner = lasting(Learner, agent)
        learner.begin(Scene((0.5, 0.5)))
        return sum(numbers.values()) + learner.act() - action
    if how == "environment":
        env = lasting(gym.WorldEnv, world)
        env.reset()
        return env.step(action)[1]
    if how == "World":
        return world.step(world.reset(0), action)[0]
    if how == "Modality":
        coordinate, = sense(program.AXIS, Scene((0.5, 0.5)), 1.0)[0]
        return sum(numbers.values()) + coordinate - numbers["constant"] - numbers["default"]
    if how in ("sweep", "pool"):
        with ProcessPoolExecutor(1, get_context("spawn")) if how == "pool" else nullcontext() as pool:
            result, = sweep([Condition(agent, world, **size)], pool, progress=False)
    else:
        result = simulate(agent, world, **size, cache=how == "cached", progress=False)
    return float(result.totals[0]) / 2


def main(folder, seed, edits, parts, *ways):
    folder, rng = Path(folder), random.Random(seed)
    sys.path.insert(0, str(folder))
    import program

    numbers, wrong = json.loads((folder / "numbers.json").read_text()), []
    for edit in range(int(edits) + 1):
        if edit:
            part, numbers = redrawn(rng, numbers, PARTS if parts == "all" else parts.split(","))
            rerun(program, folder, part, numbers)
        wrong += [(edit, how, found, numbers) for how in rng.sample(ways, len(ways))
                  if (found := paid(how, program, numbers)) != sum(numbers.values())]
    print(json.dumps({"wrong": wrong, "numbers": numbers}))


if __name__ == "__main__":
    main(*sys.argv[1:])
