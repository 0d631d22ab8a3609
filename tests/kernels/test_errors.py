"""The error of a user's kernel that numba cannot compile, or that raises, begins with that kernel: name, file and line.

Run as a program, this file prints the errors of kernels that raise, for a comparison with the compiler switched off.
"""

import gc
import inspect
import json

import numpy as np
import pytest
from pond import Pond, PondRules, PondState
from subprograms import printed

from neorl import Agent, Node, Policy, Run, Scene, WaterWorld, kernel
from neorl.custom import Axis, Modality
from neorl.core.coordinates import sense
from neorl.core.modality import PLACE_CELL
from neorl.kernels.execution import execute
from neorl.kernels.kernel import function_of
from neorl.worlds.world import Dynamics


@kernel
def innermost(x):
    return x.nowhere


@kernel
def between(x):
    return innermost(x) + 1.0


@kernel
def looks_up(x):
    return x + missing  # noqa: F821


@kernel
def raises(x):
    if x > 1.0:
        raise ValueError("too much")
    return x


@kernel
def calls_it(x):
    return raises(x)


@kernel
def out_of_sight(scene, point):
    return scene.nowhere[0]


@kernel
def indifferent(value, stream):
    if value[0] > 0.0:
        return 0


@kernel
def pays_alone(state: PondState, rules: PondRules, action: int):
    return 1.0


class Paying(Pond):
    """A pond whose step returns no pair."""

    dynamics = Dynamics(Pond.dynamics.reset, pays_alone)


def begins(function, line=None):
    """How the error of a kernel must begin."""
    function = function_of(function)
    first = inspect.getsourcelines(function)[1] if line is None else line
    return f"the kernel {__name__}.{function.__qualname__} ({__file__}, line {first}) must "


@pytest.mark.parametrize("called, to_blame, what", [
    (between, innermost, "Unknown attribute 'nowhere' of type float64"),
    (looks_up, looks_up, "NameError: name 'missing' is not defined"),
])
def test_a_kernel_that_cannot_be_compiled_is_named_first(called, to_blame, what):
    with pytest.raises(TypeError) as caught:
        execute(called, 1.0)
    assert str(caught.value).startswith(f"{begins(to_blame)}be one that numba can compile, but {what}")
    assert "numba's message:" in str(caught.value)
    assert gc.isenabled()  # again: while a kernel is compiled, no garbage is collected


@pytest.mark.parametrize("make, to_blame", [
    (lambda: sense(Modality("own", (Axis(out_of_sight),)), Scene((0.5, 0.5)), 1.0), out_of_sight),
    (lambda: Run(Agent((Node("PC", PLACE_CELL, [3]),)), Paying()).advance(1), pays_alone),
])
def test_a_users_kernel_within_the_packages_is_named_first(make, to_blame):
    with pytest.raises((TypeError, ValueError)) as caught:
        make()
    assert str(caught.value).startswith(begins(to_blame)), str(caught.value)[:300]


def test_a_step_that_returns_no_pair_is_refused():
    world = Paying()
    with pytest.raises(ValueError, match=r"what the kernel .*pays_alone returns must be \(reward, done\), but is 1.0"):
        world.step(world.reset(0), 0)


def error_of_raising():
    try:
        execute(calls_it, 2.0)
    except ValueError as error:
        return str(error)


def test_a_kernel_that_raises_is_named_first_with_and_without_the_compiler():
    line = inspect.getsourcelines(function_of(raises))[1] + 3
    said = f"{begins(raises, line)}not raise, but has raised ValueError: too much; let it return a value in every case"
    assert error_of_raising() == said and execute(calls_it, 1.0) == 1.0
    assert printed(__file__) == said.replace(f" {__name__}.", " __main__.")


def test_a_policy_that_returns_nothing_in_some_case_is_named():
    agent = Agent((Node("PC", PLACE_CELL, [3]),), policy=Policy(0.0, choose=indifferent))
    with pytest.raises(ValueError) as caught:
        Run(agent, WaterWorld()).advance(1)
    assert str(caught.value) == f"{begins(indifferent)}return a value in every case, but has returned None"


def test_an_error_of_the_package_is_passed_on():
    with pytest.raises(TypeError, match="missing|argument"):
        execute(calls_it, np.zeros(2), 1)


if __name__ == "__main__":
    print(json.dumps(error_of_raising()))
