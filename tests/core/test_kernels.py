"""The rules that every kernel keeps to, so that a run is the same everywhere."""

import numba
import numpy as np
import pytest

from neorl import Agent, Node, Run, WaterWorld, network_d, place_cells
from neorl.core import geometry, learning, life, network, parameters, state, stream
from neorl.core.kernel import execute, inlined_kernel, kernel
from neorl.core.modality import HEAD_DIRECTION_CELL
from neorl.worlds import probe, rollout, waterworld

MODULES = (geometry, learning, life, network, parameters, probe, rollout, state, stream, waterworld)
KERNELS = {value.__name__: value for module in MODULES
           for value in vars(module).values() if isinstance(value, numba.core.dispatcher.Dispatcher)}


@pytest.fixture(scope="module", autouse=True)
def compiled():
    """Have every kernel compiled by a short run."""
    Run(place_cells([3]), WaterWorld(), seed=0).advance(10)


def test_the_kernels_are_found():
    assert {"rollout", "learn_all_goals", "step_board", "uniform"} <= set(KERNELS)


@pytest.mark.parametrize("name", KERNELS)
def test_a_kernel_has_the_options_of_all_and_calls_no_library(name):
    assert KERNELS[name].targetoptions in [each(lambda: None).targetoptions for each in (kernel, inlined_kernel)]
    assert "fastmath" not in KERNELS[name].targetoptions
    for code in KERNELS[name].inspect_llvm().values():
        calls = [line for line in code.splitlines() if " call " in line and "@" in line]
        called = {line.split("@", 1)[1].split("(")[0] for line in calls}
        # What is left are other kernels (_ZN…), LLVM's own, and the wrapper that Python calls.
        assert not {name for name in called if not name.startswith(("llvm.", "_ZN", "Py", "Numba", "numba"))}


def test_a_kernel_that_allocates_does_not_compile():
    @kernel
    def allocate(n):
        return np.zeros(n)

    with pytest.raises(numba.core.errors.TypingError):
        execute(allocate, 3)


def test_the_goal_loop_compiles_to_vector_instructions():
    code = "".join(learning.learn_all_goals.inspect_llvm().values())
    assert "x float> " in code and "fmul <" in code


def test_agents_of_any_network_share_one_compilation():
    for agent in (place_cells([3]), network_d([2, 5]), Agent((Node("HD", HEAD_DIRECTION_CELL, [8]),))):
        Run(agent, WaterWorld(), seed=0).advance(10)
    assert len(rollout.rollout.signatures) == 1


@pytest.mark.parametrize("name", KERNELS)
def test_a_kernel_called_from_python_refuses_instead_of_ending_the_interpreter(name):
    with pytest.raises(TypeError, match=f"{name} is a kernel, which checks nothing"):
        KERNELS[name](1, 2, 3)


@pytest.mark.parametrize("name", [name for name in KERNELS if "no_cpython_wrapper" in KERNELS[name].targetoptions])
def test_a_kernel_that_is_inlined_cannot_even_be_executed(name):
    with pytest.raises(TypeError, match=f"{name} is only inlined into other kernels"):
        execute(KERNELS[name], 1, 2, 3)
