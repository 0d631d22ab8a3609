"""A user's kernels that write and return wild values bring an error or a result, and never a crash: `fuzzed_kernels`.

`make fuzz` tries a thousand settings, compiled, in processes of 100 each, since one may crash; `make test` tries a few
as Python functions, where an index out of range is an error. Run as a program, this file prints what each way to break
a rule of worlds leads to.
"""

import dataclasses
import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from fuzzed_kernels import FIELDS, RESET, SETTINGS, THINGS, Wild, WildRules
from subprograms import printed

from neorl import Run, forager, network_d, simulate
from neorl.gym.environment import WorldEnv
from neorl.kernels.kernel import jit_is_off


@dataclasses.dataclass(frozen=True)
class Told(Wild):
    """The wild world, whose kernels write what they are told: (when, field, place, number, integer) each."""

    writes: tuple = ()

    @property
    def rules(self):
        when, field, place, number, integer = zip(*self.writes)
        return WildRules(np.array(when), np.ones(len(when), np.int64), np.array([FIELDS.index(each) for each in field]),
                         np.array(place), np.array(number, float), np.array(integer))


MET = "wander broke a rule of worlds: after it, state.scene.met must be 0, or for a thing that was met 1 + the number"
REWARD = "wander broke a rule of worlds: after it, reward must be a finite number from -1e+30 to 1e+30, but is"
KIND = "wander broke a rule of worlds: after it, state.scene.kinds must be −1 or the numbers of ('green', 'red'), but"
PLACE = "wander broke a rule of worlds: after it, state.scene.position must be finite"
BROKEN = {  # rules of worlds, by what a kernel writes, and what is then said
    **{f"met {met}": ((3, "met", 0, 0.0, met), MET) for met in (3, 400, 4_000_000, 99_999_999, -1, -(2**62))},
    "kind 9 for a step": ((3, "kinds", 0, 0.0, 9), KIND),
    "a reward of nan": ((3, "reward", 0, np.nan, 0), REWARD),
    "a reward of -inf": ((3, "reward", 0, -np.inf, 0), REWARD),
    "rewards that cancel": ((3, "reward", 0, 1e300, 0), REWARD, (5, "reward", 0, -1e300, 0)),
    "no place for a step": ((3, "position", 0, np.nan, 0), PLACE, (4, "position", 0, 0.5, 0)),
    "no place": ((RESET, "position", 0, np.nan, 0),
                 "begin broke a rule of worlds: after it, state.scene.position must be finite"),
}
ABSENT = Told(writes=((RESET, "kinds", 0, 0.0, -1), (RESET, "things", 0, 0.0, 0)))
NOWHERE = Told(writes=((RESET, "kinds", 1, 0.0, -1), (RESET, "things", 1, np.nan, 0)))


def play(world):
    env = WorldEnv(world)
    env.reset(seed=0)
    return [env.step(0)[1] for _ in range(8)]


def step(world):
    state = world.reset(0)
    return [world.step(state, 0)[0] for _ in range(8)]


CALLS = {
    "advance": lambda world: Run(network_d(), world).advance(20),
    "simulate": lambda world: simulate(network_d(), world, steps=20, runs=1, progress=False).rewards.tolist(),
    "play": play, "step": step}
if jit_is_off():  # what would compile the life once more
    CALLS["record"] = lambda world: Run(network_d(), world).record(20).rewards.tolist()


def told(call, world):
    try:
        return f"no error, but {call(world)}"
    except ValueError as error:
        return str(error)


@pytest.fixture(scope="module", params=["interpreted", "compiled"])
def outcomes(request):
    return printed(__file__, jit=request.param == "compiled")


@pytest.mark.parametrize("way", BROKEN)
def test_a_kernel_that_breaks_a_rule_is_named_with_what_it_did(outcomes, way):
    for call, said in outcomes[way].items():
        if (call, way) != ("play", "kind 9 for a step"):  # an observation has 0 for all kinds that are unknown
            assert BROKEN[way][1] in said, call


def test_a_thing_that_the_user_makes_appear_is_in_no_cell_until_it_is_seen(outcomes):
    assert outcomes["an appearance"] is True


def test_an_absent_thing_that_is_nowhere_is_observed_last(outcomes):
    observed = np.reshape(outcomes["an absent thing"][4:], (THINGS, 4))
    assert observed.any(axis=1).tolist() == [True, True, False]


def appearance():
    """Whether a run goes on after the user's code, and not the kernel, has made an absent thing appear."""
    run = Run(forager(), ABSENT)
    run.advance(1)
    run.world_state.scene.kinds[0] = 0
    run.advance(20)
    return bool(np.isfinite(run.state.action_value).all())


COMPILED = int(os.environ.get("SETTINGS", 1_000))


@pytest.mark.parametrize("jit, first, count", [(False, 0, len(SETTINGS)), *(
    pytest.param(True, first, min(100, COMPILED - first), marks=pytest.mark.fuzz)
    for first in range(0, COMPILED, 100))])
def test_wild_kernels_bring_an_error_or_a_result(jit, first, count):
    program = Path(__file__).with_name("fuzzed_kernels.py")
    done = subprocess.run([sys.executable, program, str(first), str(count)], capture_output=True, text=True,
                          env=os.environ | {"NUMBA_DISABLE_JIT": str(int(not jit))})
    assert done.returncode == 0, done.stdout[-3_000:] + done.stderr[-3_000:]
    counts = done.stdout.splitlines()[-1]
    assert "'result': 0" not in counts and "'error': 0" not in counts


if __name__ == "__main__":
    found = {way: {name: told(call, Told(writes=(first, *more))) for name, call in CALLS.items()}
             for way, (first, _, *more) in BROKEN.items()}
    print(json.dumps(found | {
        "an appearance": appearance(), "an absent thing": WorldEnv(NOWHERE).reset(seed=0)[0].tolist()}))
