"""A small world of a user's own, for tests: steps in a square pond, whose lily pad ends an episode.

Run as a program, this file sends the world, then of the main program, and an agent to processes: to a worker of a sweep
and to an environment, each started by a method.
"""

import subprocess
import sys
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from multiprocessing import get_context
from typing import NamedTuple

from neorl import CARDINAL, Agent, Condition, Desire, Node, Policy, Scene, World, kernel, modality, simulate, sweep
from neorl.custom import Dynamics, array, kernel_maker, uniform


class PondState(NamedTuple):
    scene: Scene
    stream: array("uint64", 4)


class PondRules(NamedTuple):
    push: array("float64", 5, 2)


@kernel
def reset(state: PondState, rules: PondRules) -> None:
    scene = state.scene
    for axis in range(2):
        scene.position[axis] = uniform(state.stream)
    scene.things[0, 0], scene.things[0, 1] = 0.8, 0.3
    scene.kinds[0] = scene.met[0] = 0


@kernel
def step(state: PondState, rules: PondRules, action: int):
    scene = state.scene
    for axis in range(2):
        scene.position[axis] = min(max(scene.position[axis] + 0.04 * rules.push[action, axis], 0.0), 1.0)
    dx, dy = scene.position[0] - scene.things[0, 0], scene.position[1] - scene.things[0, 1]
    found = dx * dx + dy * dy < 0.01
    scene.met[0] = 1 if found else 0
    return (1.0 if found else 0.0), found


@dataclass(frozen=True)
class Pond(World):
    kinds, actions, things, size, fps = ("pad",), CARDINAL, 1, 1.0, 10
    dynamics = Dynamics(reset, step)

    @property
    def rules(self):
        return PondRules(CARDINAL.table)


@kernel_maker
def always(action):
    @kernel
    def choose(value, stream):
        return action

    return choose


def main(of_worker, of_environment):
    import cloudpickle
    from gymnasium.vector import AsyncVectorEnv

    from neorl import gym

    agent = Agent([Node("PC", modality.PLACE_CELL, [5])], [Desire("pad", "PC", valence=1.0)],
                  policy=Policy(0.9, choose=always(1)))
    condition = Condition(agent, Pond(), 5_000, 2)
    here = simulate(**condition.choices, progress=False)
    with ProcessPoolExecutor(1, get_context(of_worker)) as pool:
        assert list(sweep([condition], pool, progress=False, cache=False)) == [here] and here.totals.any()
    envs = AsyncVectorEnv([lambda: gym.WorldEnv(Pond())], context=of_environment)
    assert (envs.reset(seed=3)[0] == gym.VectorWorldEnv(Pond(), 1).reset(seed=3)[0]).all()
    envs.close()
    work = cloudpickle.dumps(lambda: simulate(**condition.choices, progress=False).totals.tolist())
    # A worker such as those of loky and Dask, which does not know the main program.
    elsewhere = [sys.executable, "-c", "import pickle, sys\nprint(pickle.load(sys.stdin.buffer)())"]
    assert subprocess.check_output(elsewhere, input=work).decode().strip() == str(here.totals.tolist())


if __name__ == "__main__":
    main(*sys.argv[1:])
