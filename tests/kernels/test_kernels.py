"""The rules that every kernel follows, so that a run is the same everywhere."""

import contextlib
import pickle
import random
import re
import sys
from random import randrange

import cloudpickle
import numpy as np
import pytest
from numba.core import event

from neorl import Agent, Learning, Node, Policy, Run, WaterWorld, forager, network_d, place_cells
from neorl.custom import softmax
from neorl.worlds import Arena
from neorl.agents.embodiment import loop_of
from neorl.browser import probe
from neorl.core import contacts, displacement, geometry, learning, loop, maps, network, policy, stream
from neorl.core.layout import Memory, Record
from neorl.core.modality import HEAD_DIRECTION_CELL, Axis, Modality
from neorl.kernels.execution import execute
from neorl.kernels.kernel import Kernel, inlined_kernel, kernel
from neorl.worlds import arena, waterworld
from neorl.worlds.rollout import rollout_in

TANK, POOL = WaterWorld(), Arena()
MODULES = (arena, contacts, displacement, geometry, learning, loop, maps, network, policy, probe, stream, waterworld)
KERNELS = {f"{value.__module__}.{value.__name__}": value for module in MODULES
           for value in vars(module).values() if isinstance(value, Kernel)}
MADE = {"rollout": rollout_in(TANK.dynamics), "softmax": softmax(0.5)}


@pytest.fixture(scope="module", autouse=True)
def compiled():
    """Compile the kernels by short runs, or load them from disk."""
    for agent in (place_cells([3]), place_cells([3], policy=Policy(choose=softmax(0.5))), network_d([3]), forager([3])):
        Run(agent, TANK).advance(10)
    for world in (TANK, POOL):
        world.step(world.reset(0), 0)


def codes(of):
    """The LLVM code of a kernel as called from Python, with all that is linked into it: numba keeps it on disk, too."""
    return [str(made.library._get_module_for_linking()) for made in of.for_python.overloads.values()]


def test_the_kernels_are_found():
    assert {"neorl.core.learning.learn_all_goals", "neorl.core.stream.uniform", "neorl.worlds.waterworld.step",
            "neorl.worlds.arena.step", "neorl.core.loop.observe"} <= set(KERNELS)
    assert MADE["rollout"].for_python.signatures


@pytest.mark.parametrize("name", [*KERNELS, *MADE])
def test_every_kernel_has_the_same_options_and_calls_no_library(name):
    tested = (KERNELS | MADE)[name]
    assert tested.dispatcher.targetoptions in [each(lambda: None).dispatcher.targetoptions
                                               for each in (kernel, inlined_kernel)]
    assert "fastmath" not in tested.dispatcher.targetoptions
    for code in codes(tested):
        calls = [line for line in code.splitlines() if " call " in line and "@" in line]
        called = {line.split("@", 1)[1].split("(")[0] for line in calls}
        # Allowed are other kernels (_ZN…), the wrapper that Python calls, and LLVM's own functions, sqrt among them.
        assert not {name for name in called if not name.startswith(("llvm.", "_ZN", "Py", "Numba", "numba", "sqrt"))}


def test_a_kernel_that_allocates_does_not_compile():
    @kernel
    def allocate(n):
        return np.zeros(n)

    with pytest.raises(TypeError, match="^the kernel .*allocate .*, line .* must be .*, but No .* >>> zeros"):
        execute(allocate, 3)


@kernel
def learn_once(agent: Record, memory: Memory) -> None:
    values = learning.values_of(agent, memory, agent.maps[0])
    learning.learn_all_goals(values, learning.rule_of(agent.learning), 0, 1, agent.rates)


def test_the_goal_loop_compiles_to_vector_instructions():
    run = Run(place_cells([3]), TANK)
    execute(learn_once, run._record, run._memory)
    code = "".join(codes(learn_once))
    assert "x float> " in code and "fmul <" in code


def test_a_kernel_within_kernels_is_linked_and_has_no_code_of_its_own():
    run = Run(place_cells([3]), TANK)
    execute(learn_once, run._record, run._memory)
    for made in learning.learn_all_goals.dispatcher.overloads.values():
        functions = [each.name for each in made.library.get_defined_functions()]
        assert functions and not any(map(made.library.get_pointer_to_function, functions))


def test_agents_of_any_network_share_one_compilation():
    rollouts = set()
    for agent in (place_cells([3]), network_d([2, 5]), Agent((Node("HD", HEAD_DIRECTION_CELL, [8]),))):
        for world in (TANK, WaterWorld(width=100, n_creeps=5)):
            Run(agent, world, seed=0).advance(10)
            rollouts.add(rollout_in(world.dynamics))
    (rollout,) = rollouts
    assert len(rollout.for_python.signatures) == 1


def test_what_is_the_users_own_compiles_nothing_of_the_package():
    @kernel
    def first(value, stream):
        return 0

    @kernel
    def share(count, steps, last, activity):
        return count / steps

    @kernel
    def eastwards(scene, point):
        return scene.position[0] / 250.0

    agent = place_cells([3])
    Run(agent, TANK, seed=0).advance(10)
    own = Agent([Node("east", Modality("own", [Axis(eastwards)]), [3])], learning=Learning(credit=share),
                policy=Policy(choose=first))
    with compilations() as compiled:
        Run(own, TANK, seed=0).advance(10)
    assert compiled == {"first", "chosen", "share", "eastwards", "feature"}


@contextlib.contextmanager
def compilations():
    """The names of the functions that numba compiles in this context."""
    class Listener(event.Listener):
        def on_start(self, started):
            names.add(started.data["dispatcher"].py_func.__name__)

        def on_end(self, _):
            pass

    names = set()
    with event.install_listener("numba:compile", Listener()):
        yield names


@pytest.mark.parametrize("dtype, order", [(np.float32, "C"), (float, "F")])
def test_an_array_that_kernels_would_misread_is_refused(dtype, order):
    run = Run(place_cells([3]), TANK)
    things = np.asarray(run.world_state.scene.things, dtype=dtype, order=order)
    with pytest.raises(ValueError, match="^things must be a contiguous array of float64 with 2 axes, but is "):
        execute(loop.begin, run._record, run._memory, run.world_state.scene._replace(things=things),
                loop_of(run.agent).functions)


@pytest.mark.parametrize("name", KERNELS)
def test_a_kernel_called_from_python_refuses_instead_of_ending_the_interpreter(name):
    with pytest.raises(TypeError, match=f"{re.escape(name)} is a kernel, which checks nothing"):
        KERNELS[name](1, 2, 3)


@pytest.mark.parametrize("name", [name for name in KERNELS if KERNELS[name].is_inlined])
def test_a_kernel_that_is_inlined_cannot_even_be_executed(name):
    with pytest.raises(TypeError, match=f"{re.escape(name)} must be called by kernels, into which it is inlined"):
        execute(KERNELS[name], 1, 2, 3)


def noisy_helper():
    return random.random()


def draws_within():
    def inner():
        return np.random.rand()

    return inner()


def draws_from_a_module_by_another_name():
    library = np
    stream = library.random
    return stream.random()


drawn = np.random.default_rng(0).random


@pytest.mark.parametrize("function, name", [
    (lambda value, stream: np.random.randint(4), "np.random.randint"),
    (lambda value, stream: random.randrange(4), "random.randrange"), (lambda value, stream: randrange(4), "randrange"),
    (lambda scene, point: noisy_helper(), "random.random"),
    (lambda: np.random.seed(0), "np.random.seed"), (draws_within, "np.random.rand"), (lambda: drawn(), "drawn"),
    (draws_from_a_module_by_another_name, "np.random.random")])
def test_a_kernel_that_draws_from_a_global_stream_is_refused_by_name(function, name):
    with pytest.raises(ValueError, match=rf"must draw its random numbers from a stream .*calls {re.escape(name)}, "):
        kernel(function)


def late():
    raise NotImplementedError  # replaced once a kernel calls it


@kernel
def calls_late():
    return late()


def test_a_kernel_whose_helper_comes_to_draw_from_a_global_stream_is_refused_when_it_is_compiled(monkeypatch):
    monkeypatch.setattr(sys.modules[__name__], "late", noisy_helper)
    with pytest.raises(ValueError, match="calls_late calls random.random, which no seed of a run determines"):
        execute(calls_late)


@kernel
def first_of_two(one, other):
    return one


@pytest.mark.parametrize("module", [cloudpickle, pickle])
def test_a_kernel_remains_one_and_the_same_however_often_it_is_pickled(module, monkeypatch):
    """Else a worker would compile it again for every condition."""
    @kernel
    def local(x):
        return x

    if module is pickle:  # which finds the kernels of the main program by name
        local.__module__, local.__qualname__ = "__main__", "local"
        monkeypatch.setattr(sys.modules["__main__"], "local", local, raising=False)
    assert {pickle.loads(module.dumps(local)) for _ in range(2)} == {local}


def test_a_disk_that_is_full_costs_time_alone(monkeypatch, tmp_path):
    def refuse(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setenv("NEORL_CACHE", str(tmp_path))
    monkeypatch.setattr("neorl.common.files.write_whole", refuse)
    with pytest.warns(RuntimeWarning, match="takes no compiled kernels .No space left on device"):
        assert execute(softmax(0.125), np.array([0.0, 9.0]), np.arange(4, dtype=np.uint64)) in (0, 1)


def test_a_kernel_that_is_given_another_number_of_arguments_says_so():
    with pytest.raises(TypeError, match="test_kernels.first_of_two must be called with 2 arguments, but is with 3"):
        execute(first_of_two, 1.0, 2.0, 3.0)
