"""A user's kernels that write and return wild values bring an error or a result, and never a crash: `fuzzed_kernels`.

``python tests/fuzzed_kernels.py 1000`` runs that many settings, compiled; here a few run as Python functions, where an
index out of range is an error. Run as a program, this file prints what some of them lead to.
"""

import dataclasses
import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from fuzzed_kernels import FIELDS, OWN, RESET, SETTINGS, THINGS, Wild, WildRules

from neorl import Actions, Learner, Run, Scene, forager, network_d, simulate
from neorl.gym.environment import WorldEnv


@dataclasses.dataclass(frozen=True)
class Told(Wild):
    """The wild world, whose kernels write what they are told: (when, field, place, number, integer) each."""

    writes: tuple = ()

    @property
    def rules(self):
        when, field, place, number, integer = zip(*self.writes)
        return WildRules(np.array(when), np.ones(len(when), np.int64), np.array([FIELDS.index(each) for each in field]),
                         np.array(place), np.array(number, float), np.array(integer))


CANCELLING = Told(writes=((3, "reward", 0, 1e300, 0), (5, "reward", 0, -1e300, 0)))
BRIEFLY = Told(writes=((3, "kinds", 0, 0.0, 9), (4, "kinds", 0, 0.0, 0)))
ABSENT = Told(writes=((RESET, "kinds", 0, 0.0, -1), (RESET, "things", 0, 0.0, 0)))
NOWHERE = Told(writes=((RESET, "kinds", 1, 0.0, -1), (RESET, "things", 1, np.nan, 0)))


def step_out_of_an_appearance():
    """Advance past the appearance of an absent thing that the user's code, and not the kernel, has made."""
    run = Run(forager(), ABSENT)
    run.advance(1)
    run.world_state.scene.kinds[0] = 0
    run.advance(20)
    return bool(np.isfinite(run.state.action_value).all())


def actions_without_idleness():
    learner = Learner(OWN, THINGS, ("green", "red"), Actions(("a", "b"), ((0, 1), (1, 0))))
    scene, taken = Scene((0.5, 0.5), things=np.ones((THINGS, 2)), kinds=("green",) * THINGS), set()
    learner.begin(scene)
    for _ in range(100):
        taken.add(int(learner.act()))
        learner.observe(scene)
    return sorted(taken)


def paid_in_an_episode():
    env = WorldEnv(CANCELLING)
    env.reset(seed=0)
    return [env.step(0)[1] for _ in range(8)]


def order_beside_an_absent_thing():
    return WorldEnv(NOWHERE).reset(seed=0)[0].tolist()


OUTCOMES = {
    "rewards that cancel": lambda: Run(network_d(), CANCELLING).advance(20),
    "rewards that cancel, recorded": lambda: Run(network_d(), CANCELLING).record(20).rewards.tolist(),
    "a kind of one step, recorded": lambda: Run(network_d(), BRIEFLY).record(9).rewards.tolist(),
    "rewards in bins": lambda: simulate(network_d(), CANCELLING, steps=20, runs=1, progress=False).rewards.tolist(),
    "rewards of an environment": paid_in_an_episode, "a kind of one step": lambda: Run(network_d(), BRIEFLY).advance(9),
    "an appearance": step_out_of_an_appearance, "no idleness": actions_without_idleness,
    "an absent thing": order_beside_an_absent_thing}


@pytest.fixture(scope="module")
def outcomes():
    done = subprocess.run([sys.executable, __file__], capture_output=True, text=True, env={
        **os.environ, "NUMBA_DISABLE_JIT": "1", "PYTHONPATH": os.pathsep.join(sys.path)})
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


@pytest.mark.parametrize("name", [name for name in OUTCOMES if name.startswith("rewards")])
def test_rewards_too_large_that_cancel_are_refused(outcomes, name):
    assert "reward must be a finite number from -1e+30 to 1e+30, but is" in outcomes[name] and "e+300" in outcomes[name]


@pytest.mark.parametrize("name", [name for name in OUTCOMES if name.startswith("a kind of one step")])
def test_a_kind_that_is_wrong_for_a_single_step_is_refused(outcomes, name):
    assert "state.scene.kinds must be −1 or the numbers of" in outcomes[name]


def test_a_thing_that_the_user_makes_appear_is_in_no_cell_until_it_is_seen(outcomes):
    assert outcomes["an appearance"] is True


def test_an_absent_thing_that_is_nowhere_is_observed_last(outcomes):
    observed = np.reshape(outcomes["an absent thing"][4:], (THINGS, 4))
    assert observed.any(axis=1).tolist() == [True, True, False]


def test_an_agent_that_cannot_be_idle_never_is(outcomes):
    assert outcomes["no idleness"] == [0, 1]


def test_wild_kernels_bring_an_error_or_a_result():
    done = subprocess.run([sys.executable, Path(__file__).with_name("fuzzed_kernels.py"), "here", "0",
                           str(2 * len(SETTINGS))], env=os.environ | {"NUMBA_DISABLE_JIT": "1"}, capture_output=True,
                          text=True)
    assert done.returncode == 0, done.stdout[-3_000:] + done.stderr[-3_000:]
    counts = done.stdout.splitlines()[-1]
    assert "'result': 0" not in counts and "'error': 0" not in counts


def told(call):
    try:
        return call()
    except (ValueError, IndexError) as error:
        return str(error)


if __name__ == "__main__":
    print(json.dumps({name: told(call) for name, call in OUTCOMES.items()}))
