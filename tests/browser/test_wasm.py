"""The WebAssembly modules: their imports, their size, and that each computes the same runs as native code."""

import sys
import time
from concurrent.futures import ThreadPoolExecutor

import golden
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from webassembly import Machine, compiled, copied, module_of, sizes_of, state_of, widened

from neorl import Run, WaterWorld, place_cells
from neorl.agents.embodiment import choices_in
from neorl.browser import wasm
from neorl.browser.explorer import OTHER_SPACES
from neorl.browser.seeding import start_stream
from neorl.browser.worlds import rules_of
from neorl.common import files
from neorl.core.building import SIZES, WITHOUT_VALUES, laid_out
from neorl.core.layout import Memory
from neorl.core.stream import new_stream
from neorl.experiments.condition import PARTS
from neorl.kernels.annotations import arrays, new_tuple
from neorl.kernels.execution import execute

STEPS = 50_000
RUNS = [name for name in golden.RUNS if name != "softmax"]  # a choice of actions that is not compiled for the page


def assert_equal_to(run, arguments):
    for own, views in ((run.memory, viewed(arguments["memory"])), (run.world_state, viewed(arguments["world_state"])),
                       (widened(run._record, module_of(run)), arguments["agent"][1])):
        copies = arrays(views)
        for field, array in arrays(own).items():
            assert np.array_equal(copies[field], array, equal_nan=True), field


def viewed(values):
    """Turn a named tuple of (address, view) pairs into one of views."""
    return type(values)(*(viewed(value) if hasattr(value, "_fields") else value[1] if isinstance(value, tuple) else
                          value for value in values))


@pytest.mark.parametrize("name", RUNS)
def test_a_run_equals_a_native_run_to_the_last_bit(name):
    run = Run(golden.agent_of(name), golden.world_of(name), seed=1, run=4)
    assert_lives_alike(run)
    assert name == "Brownian" or run.memory.q.any()


@pytest.mark.parametrize("name", OTHER_SPACES)
def test_a_run_in_another_space_equals_a_native_run_to_the_last_bit(name):
    run = Run(*OTHER_SPACES[name], seed=2, run=3)
    assert assert_lives_alike(run) != 0
    assert run.memory.q.any()


def assert_lives_alike(run):
    """Advance a run in the module and natively, compare the two, and return the total reward."""
    machine, sizes, arguments = copied(run)
    for last_step in range(STEPS // 5, STEPS + 1, STEPS // 5):
        machine.call("rollout", sizes, last_step=last_step, **arguments)
    total = arguments["log"].paid[1][0]
    assert total == run.advance(STEPS)
    assert_equal_to(run, arguments)
    return total


BEGINNINGS = OTHER_SPACES | {name: (golden.agent_of(name), golden.world_of(name)) for name in (
    "place, weights cells", "both", "network D", "both, object, ends, centred", "every modality", "contacts", "arena")}


@pytest.mark.parametrize("name", BEGINNINGS)
def test_a_run_begins_as_in_python_without_any_python(name):
    agent, world = BEGINNINGS[name]
    run = Run(agent, world, seed=2**32 - 1, run=17)
    machine, sizes = Machine(name=module_of(run)), sizes_of(run)
    record, draft = laid_out(choices_in(agent, run.world))
    agent, draft = machine.put(widened(record, module_of(run))), machine.put_tuple(draft)
    machine.call("derive", sizes | {name: 0 for name in SIZES}, agent=agent, memory=draft, n_things=world.things)
    world_state = machine.put_tuple(new_tuple(type(state_of(run)), sizes, {}))
    memory = machine.put_tuple(new_tuple(Memory, sizes, {
        name: getattr(viewed(draft), name) for name in WITHOUT_VALUES}))
    of_policy = agent[0] + agent[1].dtype.fields["stream"][1], agent[1]["stream"]
    for words, stream in (([2**32 - 1, 0, 0, 0, 17], world_state.stream), ([2**32 - 1, 0, 0, 0, 17, 0], of_policy)):
        machine.call("start_stream", sizes | {"words": len(words)}, words=machine.put(np.array(words, np.uint64)),
                     stream=stream)
    machine.call("reset", sizes, state=world_state, rules=machine.put_tuple(rules_of(world)))
    machine.call("begin_values", sizes, agent=agent, memory=memory)
    machine.call("begin", sizes, agent=agent, memory=memory, scene=world_state.scene)
    assert_equal_to(run, {"agent": agent, "memory": memory, "world_state": world_state})


@given(st.integers(0, 2**32 - 1), st.lists(st.integers(0, 2**32 - 1), min_size=1, max_size=3))
def test_a_stream_is_seeded_as_by_numpy(seed, key):
    stream = np.zeros(4, np.uint64)
    execute(start_stream, np.array([seed, 0, 0, 0, *key], np.uint64), stream)
    assert np.array_equal(stream, new_stream(np.random.SeedSequence(seed, spawn_key=key)))


@pytest.mark.parametrize("name", wasm.MODULES)
def test_a_module_is_small_and_asks_for_memory_alone(name):
    _, module = compiled(name)
    assert len(wasm.modules()[name]) <= 120_000
    assert [each.name for each in module.imports] == ["memory"]
    assert {each.name for each in module.exports} == {"__heap_base", *wasm.layout(name)["exports"]}


@pytest.fixture
def contents(tmp_path, monkeypatch):
    """The contents of the modules, with none left on disk and a build that fails the test."""
    contents = wasm.modules()
    monkeypatch.setenv("NEORL_CACHE", str(tmp_path))
    monkeypatch.setattr(wasm, "_built", lambda names, at_once: names and pytest.fail(f"built again: {names}"))
    return contents


def test_modules_on_disk_are_taken_and_a_damaged_one_is_not(contents, tmp_path):
    for name, content in contents.items():
        files.write_checked(tmp_path / "wasm" / wasm._digest(name).hex(), content)
    assert wasm.modules() == contents
    path = tmp_path / "wasm" / wasm._digest("plane").hex()
    path.write_bytes(path.read_bytes()[:-1])
    with pytest.raises(pytest.fail.Exception, match=r"built again: \['plane'\]"):
        wasm.modules()


def test_a_wheel_ships_the_modules_of_its_own_sources(contents, tmp_path, monkeypatch):
    monkeypatch.setattr(wasm, "_built", lambda names, at_once: {name: contents[name] for name in names})
    wasm.ship(tmp_path / "neorl")
    monkeypatch.undo()
    monkeypatch.setenv("NEORL_CACHE", str(tmp_path / "empty"))
    monkeypatch.setattr(wasm, "SHIPPED", {name: tmp_path / "neorl" / "browser" / f"{name}.wasm" for name in contents})
    assert wasm.modules() == contents and not (tmp_path / "empty").exists()
    others = dict.fromkeys(contents, b"of other sources")
    monkeypatch.setattr(wasm, "_built", lambda names, at_once: {name: others[name] for name in names})
    monkeypatch.setattr(wasm, "source_digest", lambda: "other sources")
    assert wasm.modules() == others


@pytest.mark.skipif(sys.platform == "win32", reason="Windows locks files differently")
def test_of_processes_that_start_at_once_one_builds_and_the_others_wait(contents, monkeypatch):
    built = []

    def build(names, at_once):
        built.append(names)
        time.sleep(0.5)
        return {name: contents[name] for name in names}

    monkeypatch.setattr(wasm, "_built", build)
    with ThreadPoolExecutor(3) as pool:  # each holds a lock of its own, as a process would
        assert list(pool.map(lambda _: wasm.modules(), range(3))) == [contents] * 3
    assert [names for names in built if names] == [list(contents)]


def test_without_a_linker_the_error_says_what_to_install(tmp_path, monkeypatch):
    monkeypatch.setenv("NEORL_CACHE", str(tmp_path))
    monkeypatch.setitem(sys.modules, "ziglang", None)
    with pytest.raises(ImportError, match="ziglang must be installed for this, but is not; pip install 'neorl-compan"):
        wasm.modules()
    assert Run(place_cells([3]), WaterWorld()).advance(10) is not None


def test_modules_that_cannot_be_kept_are_built_with_a_warning(contents, tmp_path, monkeypatch):
    (tmp_path / "file").write_text("")
    monkeypatch.setenv("NEORL_CACHE", str(tmp_path / "file"))
    monkeypatch.setattr(wasm, "_built", lambda names, at_once: {name: contents[name] for name in names})
    with pytest.warns(RuntimeWarning, match="takes no WebAssembly modules"):
        assert wasm.modules() == contents


def test_a_module_is_built_again_if_the_source_of_any_kernel_that_it_exports_changes():
    sources = {export.__module__ for module in wasm.MODULES.values() for export in module.exports}
    known = tuple(f"neorl.{name}" for name in (*PARTS, *wasm.OURS))
    assert all(source.startswith(known) for source in sources)
