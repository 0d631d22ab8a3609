"""Kernels of a user's that write and return wild values: the engine of `test_fuzzed_kernels.py`.

    python tests/fuzzed_kernels.py FIRST COUNT    tries some settings in a process of their own

What is wild is data in the rules of one world, so its kernels compile once: for a setting, into which fields of the
state its reset and step write which values when, and what step returns. A process prints each setting before it runs.
It must not crash, and the setting must end in a result without NaN, or in an error that is a sentence.
"""

import dataclasses
import faulthandler
import itertools
import sys
import warnings
from typing import NamedTuple

import numpy as np

from neorl import (CARDINAL, Actions, Agent, Desire, Learner, Learning, Node, Policy, Run, Scene, World, forager,
                   kernel, network_d, simulate)
from neorl.agents.forager import AFTER_STATES
from neorl.custom import Axis, Modality
from neorl.core.stream import randint
from neorl.gym.environment import WorldEnv
from neorl.gym.vector import VectorWorldEnv
from neorl.kernels.annotations import array, arrays
from neorl.worlds.world import Dynamics

WRITES, THINGS, KINDS = 8, 3, ("green", "red")
FIELDS = ("position", "velocity", "things", "kinds", "met", "own", "stream", "reward", "done")
NUMBERS = (np.nan, np.inf, -np.inf, 1e308, -1e308, 1e30, -1e30, 1e31, 1e300, 5e-324, -0.0, 0.5, -3.0, 7.0, 2.0**63)
INTEGERS = (0, 1, 2, 3, 7, 400, -1, -2, -400, 2**31, 2**62, 2**63 - 1, -(2**31), -(2**63))
RESET = -1  # in place of the number of a step


class WildState(NamedTuple):
    scene: Scene
    stream: array("uint64", 4)
    own: array("float64", 2)
    clock: array("int64", 1)


class WildRules(NamedTuple):
    when: array("int64", "writes")  # the step, or RESET
    lasts: array("int64", "writes")  # steps
    field: array("int64", "writes")
    place: array("int64", "writes")
    number: array("float64", "writes")
    integer: array("int64", "writes")


@kernel
def write(state, rules, now):
    scene, reward, done = state.scene, 0.5, False
    for i in range(rules.when.shape[0]):
        if rules.when[i] <= now < rules.when[i] + rules.lasts[i]:
            field, at, number = rules.field[i], rules.place[i], rules.number[i]
            if field == 0:
                scene.position[at % 2] = number
            elif field == 1:
                scene.velocity[at % 2] = number
            elif field == 2:
                scene.things[at % THINGS, at % 2] = number
            elif field == 3:
                scene.kinds[at % THINGS] = rules.integer[i]
            elif field == 4:
                scene.met[at % THINGS] = rules.integer[i]
            elif field == 5:
                state.own[at % 2] = number
            elif field == 6:
                state.stream[at % 4] = np.uint64(rules.integer[i])
            elif field == 7:
                reward = number
            else:
                done = True
    return reward, done


@kernel
def begin(state: WildState, rules: WildRules) -> None:
    scene = state.scene
    for axis in range(2):
        scene.position[axis], scene.velocity[axis] = 0.5, 0.0
    for thing in range(THINGS):
        scene.things[thing, 0], scene.things[thing, 1], scene.kinds[thing] = 0.2 * thing, 0.9, thing % 2
        scene.met[thing] = 0
    write(state, rules, RESET)


@kernel
def wander(state: WildState, rules: WildRules, action: int):
    scene = state.scene
    for thing in range(THINGS):
        scene.met[thing] = 0
    axis = randint(state.stream, 2)
    scene.velocity[axis] = 0.1 if randint(state.stream, 2) == 0 else -0.1
    scene.position[axis] = min(max(scene.position[axis] + scene.velocity[axis], 0.0), 1.0)
    state.clock[0] += 1
    return write(state, rules, state.clock[0])


@dataclasses.dataclass(frozen=True)
class Wild(World):
    """A world whose kernels write wild values, at random by its seed."""

    seed: int = 0
    idle: str | None = "no-op"

    dynamics = Dynamics(begin, wander)
    kinds, things, size, fps = KINDS, THINGS, 1.0, 5

    @property
    def actions(self):
        return Actions(CARDINAL.names, CARDINAL.pushes, self.idle)

    @property
    def rules(self):
        rng = np.random.default_rng(self.seed)
        fields = rng.integers(len(FIELDS), size=WRITES)
        fields[rng.random(WRITES) < 0.7] = 5  # writes that matter to no one, so that half of all settings get through
        return WildRules(np.where(rng.random(WRITES) < 0.1, RESET, rng.integers(1, 200, size=WRITES)),
                         rng.choice([1, 1, 5, 1_000], size=WRITES), fields, rng.integers(12, size=WRITES),
                         rng.choice(NUMBERS, size=WRITES), rng.choice(np.array(INTEGERS, np.int64), size=WRITES))


@kernel
def any_action(value, stream):
    """Out of range in half of all steps."""
    wild, by = randint(stream, 2) == 0, randint(stream, 6)
    if not wild:
        return by % 4
    return (-1, 4, 5, -(2**62), 2**31, 2**62)[by]


@kernel
def any_credit(count, steps, last, activity):
    """Infinite, huge, negative or, seldom, NaN."""
    return (np.inf, -np.inf, 1e308, -1e308, 5e-324, 0.3, np.nan if count > 12 else 1.0)[(count + steps) % 7]


@kernel
def any_place(scene, point):
    x = scene.position[0]
    return (x, np.inf, -np.inf, 1e308, -0.0)[int(min(max(x * 5.0, 0.0), 4.0))] if x == x else np.nan


OWN = Agent((Node("own", Modality("own", (Axis("position", along=1), Axis(any_place))), [3, 5]),
             Node("OVC", Modality("OV", (Axis("objects", low=-1), Axis(any_place))), [3])),
            (Desire((0.9, 0.2), "own", 1.0), Desire((0.1, 0.5), "OVC", -1.0)),
            learning=Learning(credit=any_credit, memory=3.0), policy=Policy(0.0, choose=any_action))
AGENTS = {"own kernels": OWN, "forager": forager(), "after-states": forager(**AFTER_STATES), "network D": network_d()}


def by_simulate(agent, world, rng):
    result = simulate(agent, world, steps=300, runs=2, seed=int(rng.integers(99)), progress=False)
    return [result.rewards]


def by_run(agent, world, rng):
    run = Run(agent, world, seed=int(rng.integers(99)))
    for _ in range(4):
        run.advance(int(rng.integers(1, 90)))
        if rng.random() < 0.5:
            edit(run.world_state, rng)
    return [run.memory.q, run.state.desires.q]


def edit(state, rng):
    """Write valid or wild values into a state, as a user may between two steps."""
    values = list(arrays(state).values())
    values = values[rng.integers(len(values))]
    wild = rng.random() < 0.3
    if values.dtype.kind == "f":
        values.flat[rng.integers(values.size)] = rng.choice(NUMBERS) if wild else rng.random()
    elif values.dtype.kind == "i":
        values.flat[rng.integers(values.size)] = rng.choice(np.array(INTEGERS)) if wild else rng.integers(-1, 2)


def by_learner(agent, world, rng):
    learner = Learner(agent, world.things, world.kinds, world.actions, size=1.0, fps=5)
    learner.begin(any_scene(rng, 0.0))
    for _ in range(60):
        action = learner.act()
        assert 0 <= action < len(world.actions.all_names), f"act() returns {action}"
        learner.observe(any_scene(rng, 0.02), float(rng.choice([0.5, -1.0, 1e30])))
    return [learner.memory.q, learner.state.desires.q]


def any_scene(rng, wild):
    kinds = [None if each < 0 else KINDS[each] for each in rng.integers(-1, 2, size=THINGS)]
    scene = Scene(rng.random(2), rng.random(2), rng.random((THINGS, 2)), kinds, rng.integers(0, 2, size=THINGS))
    if rng.random() < wild:
        field = rng.integers(5)
        return scene._replace(**{scene._fields[field]: np.full(np.shape(scene[field]), rng.choice(NUMBERS))})
    return scene


def by_world(agent, world, rng):
    state, rewards = world.reset(int(rng.integers(99))), []
    for _ in range(250):
        reward, _, done = world.step(state, int(rng.integers(len(world.actions.all_names))))
        rewards.append(reward)
        if done:
            state = world.reset(0)
    return [np.array(rewards)]


def by_environment(agent, world, rng):
    env = WorldEnv(world, egocentric=bool(rng.integers(2)))
    seen = [env.reset(seed=int(rng.integers(99)))[0]]
    for _ in range(250):
        observation, reward, terminated, truncated, _ = env.step(int(rng.integers(4)))
        seen += [observation, np.array([reward])]
        if terminated or truncated:
            seen.append(env.reset()[0])
    return seen


def by_environments(agent, world, rng):
    envs = VectorWorldEnv(world, 3, autoreset_mode=str(rng.choice(["NextStep", "SameStep"])))
    seen = [envs.reset(seed=int(rng.integers(99)))[0]]
    for _ in range(120):
        observation, reward, *_ = envs.step(rng.integers(4, size=3))
        seen += [observation, reward]
    return seen


CALLS = (by_simulate, by_run, by_learner, by_world, by_environment, by_environments)
SETTINGS = list(itertools.product(CALLS, AGENTS, ("no-op", None)))


def attempt(number):
    """Run a setting, and return "error" or "result"."""
    call, name, idle = SETTINGS[number % len(SETTINGS)]
    print(f"setting {number}: {call.__name__}, {name}, idle={idle}", flush=True)
    try:
        found = call(AGENTS[name], Wild(number, idle), np.random.default_rng(number))
    except ValueError as error:
        assert "must" in str(error) and ", but " in str(error), f"setting {number}: {error}"
        return "error"
    wild = [each for each in found if not np.all(np.abs(each) <= 1e31)]
    assert not wild, f"setting {number} returns {wild[0]}"
    return "result"


def attempt_all(first, count):
    """Run settings in this process, and return whether all have passed."""
    faulthandler.enable()
    warnings.simplefilter("error")
    outcomes = {"error": 0, "result": 0, "FAILED": 0}
    for number in range(first, first + count):
        try:
            outcomes[attempt(number)] += 1
        except Exception as error:
            outcomes["FAILED"] += 1
            print("FAILED", type(error).__name__, str(error)[:600], flush=True)
    print(outcomes, flush=True)
    return not outcomes["FAILED"]


if __name__ == "__main__":
    sys.exit(not attempt_all(int(sys.argv[1]), int(sys.argv[2])))
