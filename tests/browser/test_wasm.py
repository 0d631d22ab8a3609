"""The WebAssembly modules: their imports, their size, and that each computes the same runs as native code."""

import sys
import time
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from webassembly import Machine, compiled, copied, module_of, sizes_of, state_of

import neorl
from neorl import (Agent, Arena, Desire, Learning, Node, Place, Policy, Run, WaterWorld, files, multimodal,
                   network_a, network_b, network_c, network_d, object_vector_cells, place_cells)
from neorl.agents.compile import chosen
from neorl.browser import wasm
from neorl.browser.explorer import OTHER_SPACES
from neorl.browser.worlds import rules_of
from neorl.core import modality
from neorl.core.kernel import arrays, execute, mapped, new_tuple
from neorl.core.parameters import Parameters
from neorl.core.state import State
from neorl.worlds.probe import probes_with

STEPS = 50_000
LAYERS = (10, 30, 50, 70, 90, 3, 7, 23)
PRIMES = (2, 3, 5, 7, 11, 13)
MEMORIES = {
    "memory": Learning(memory=20.0, credit="happened", absent_decay=0.1),
    "memory, bootstrapping": Learning(memory=5.0, discount=0.9, bootstrap=True, absent_decay=0.2, absent_form="away",
                                      credit="count"),
    "activity": Learning(credit="activity", absent_decay=0.2, absent_form="away", terminal=False),
}
STATES = {
    "self": {"object_state": "self"},
    "per object": {"object_state": "per object"},
    "self, ends": {"object_state": "self", "object_beyond": "none", "object_tiled_fraction": 0.5},
    "per object, centred": {"object_state": "per object", "object_centred": True},
    "self, no memory, bootstrapping": {"object_state": "self", "learning": Learning(memory=0.0, bootstrap=True)},
    "object, reach": {"object_state": "object", "object_reach": 0.096},
    "object, ends, centred": {"object_state": "object", "object_beyond": "none", "object_centred": True,
                              "object_tiled_fraction": 0.5},
}
CONJUNCTIVE = modality.Modality("place and head direction", (*modality.PLACE_CELL.axes,
                                                             *modality.HEAD_DIRECTION_CELL.axes))
UNEVEN = modality.Modality("uneven", [modality.Axis("objects", boundaries=[-1.0, -0.2, 0.1, 1.0]),
                                      modality.Axis("objects", along=1, closed=True, intervals=3)])
PAPERS = {
    "Brownian": (neorl.brownian(), 8),
    **{f"A, N{n}": (place_cells([n]), 8) for n in LAYERS},
    **{f"A, {by}": (place_cells([3, 7, 23], weighting=by), 8) for by in ("equal", "resolution", "cells")},
    **{f"B, {make.__name__} N{n}": (make([n]), 3) for n in PRIMES for make in (place_cells, object_vector_cells)},
    **{f"B, {make.__name__}": (make(), 3) for make in (place_cells, object_vector_cells, multimodal)},
    **{f"C, {make.__name__}": (make(), 3) for make in (network_a, network_b, network_c, network_d)},
    **{f"C, signed {make.__name__}": (make(signed=True), 3) for make in (network_a, network_b, network_c, network_d)},
    **{f"{name}": (multimodal([3, 7], learning=rule), 3) for name, rule in MEMORIES.items()},
    **{f"state {name}": (multimodal([4, 7], **choices), 3) for name, choices in STATES.items()},
    "every modality": (Agent([Node(each.name, each, [1, 4]) for each in modality.MODALITIES],
                             [*(Desire("green", each.name, 1.0) for each in modality.MODALITIES if each.takes_places),
                              Desire(Place(0.2, 0.9), "object-vector cell", -1.0),
                              Desire((0.3, 0.3), "place cell", 0.4)]), 4),
    "axes of several kinds": (Agent([Node("PC × HD", CONJUNCTIVE, [3]), Node("uneven", UNEVEN, [4])],
                                    [Desire("green", "PC × HD", 1.0), Desire("red", "uneven", -1.0)]), 3),
}
MAZES = {
    "Morris": Arena(),
    "walls": Arena(places=[("food", 0.8, 0.2), ("shock", 0.3, 0.7), ("food", 0.1, 0.1)], pay=[1.0, -2.0], ends=False,
                   obstacles=[(0.4, 0.0, 0.5, 0.6), (0.6, 0.5, 0.7, 1.0)], shape="square", motion="steps",
                   start=(0.2, 0.2), trial_seconds=20.0),
}


def assert_equal_to(run, arguments):
    for own, name in ((run.state, "state"), (run.world_state, "world_state")):
        views = arrays(viewed(arguments[name]))
        for field, array in arrays(own).items():
            assert np.array_equal(views[field], array, equal_nan=True), (name, field)


def viewed(values):
    """Turn a named tuple of (address, view) pairs into one of views."""
    return type(values)(*(viewed(value) if hasattr(value, "_fields") else value[1] if isinstance(value, tuple) else
                          value for value in values))


@pytest.mark.parametrize("name", PAPERS)
def test_a_run_equals_a_native_run_to_the_last_bit(name):
    agent, creeps = PAPERS[name]
    run = Run(agent, WaterWorld(n_creeps=creeps, win_reward=5.0 if creeps == 8 else 0.0), seed=1, run=4)
    assert_lives_alike(run)
    assert name == "Brownian" or run.state.values.q.any()


@pytest.mark.parametrize("name", MAZES)
def test_a_run_in_the_arena_equals_a_native_run_to_the_last_bit(name):
    world = MAZES[name]
    cells = modality.PLACE_CELL, modality.CARTESIAN_OBJECT_VECTOR_CELL, modality.HEAD_DIRECTION_CELL
    agent = Agent([Node(each.name, each, [3, 7]) for each in cells],
                  [Desire(kind, each.name, 1.0) for kind in world.kinds for each in cells],
                  policy=Policy(exploration=0.3))
    run = Run(agent, world, seed=3, run=1)
    assert assert_lives_alike(run) != 0
    assert run.state.values.q.any()


@pytest.mark.parametrize("name", OTHER_SPACES)
def test_a_run_in_another_space_equals_a_native_run_to_the_last_bit(name):
    run = Run(*OTHER_SPACES[name], seed=2, run=3)
    assert assert_lives_alike(run) != 0
    assert run.state.values.q.any()


def assert_lives_alike(run):
    """Advance a run in the module and natively, compare the two, and return the total reward."""
    machine, sizes, arguments = copied(run)
    for last_step in range(STEPS // 5, STEPS + 1, STEPS // 5):
        arguments["total"] = machine.call("rollout", sizes, last_step=last_step, bin_steps=2 * STEPS, **arguments)
    assert arguments["total"] == run.advance(STEPS)
    assert_equal_to(run, arguments)
    return arguments["total"]


BEGINNINGS = {name: (PAPERS[name][0], WaterWorld(n_creeps=PAPERS[name][1]))
              for name in ("A, cells", "B, multimodal", "C, network_d", "state per object, centred",
                           "state object, ends, centred", "every modality", "axes of several kinds")}
BEGINNINGS["pool"] = Agent([Node("PC", modality.PLACE_CELL, [5])], [Desire("platform", "PC", 1.0)]), Arena()
BEGINNINGS |= OTHER_SPACES


@pytest.mark.parametrize("name", BEGINNINGS)
def test_a_run_begins_as_in_python_without_any_python(name):
    agent, world = BEGINNINGS[name]
    run = Run(agent, world, seed=2**32 - 1, run=17)
    machine, sizes = Machine(name=module_of(run)), sizes_of(run)
    choices, _ = chosen(agent, run.world)
    parameters = machine.put_tuple(new_tuple(Parameters, sizes, choices))
    machine.call("derive", sizes, parameters=parameters, n_things=world.things)
    world_state = machine.put_tuple(new_tuple(type(state_of(run)), sizes, {}))
    state = machine.put_tuple(new_tuple(State, sizes, {}))
    for words, stream in (([2**32 - 1, 0, 0, 0, 17], world_state.stream), ([2**32 - 1, 0, 0, 0, 17, 0], state.stream)):
        machine.call("start_stream", sizes | {"words": len(words)}, words=machine.put(np.array(words, np.uint64)),
                     stream=stream)
    machine.call("reset", sizes, state=world_state, rules=machine.put_tuple(rules_of(world)))
    machine.call("begin_values", sizes, parameters=parameters, state=state)
    machine.call("begin", sizes, parameters=parameters, state=state, scene=world_state.scene)
    assert_equal_to(run, {"state": state, "world_state": world_state})
    derived = arrays(viewed(parameters))
    for field, array in arrays(run.parameters).items():
        assert np.array_equal(derived[field], array), field


@pytest.mark.parametrize("choices", [{"object_state": "object"}, {"object_state": "per object"},
                                     {"object_state": "self", "object_beyond": "none", "object_tiled_fraction": 0.5}])
def test_looking_and_joining_in_equal_native_calls(choices):
    run = Run(multimodal([5, 7], **choices), WaterWorld(n_creeps=6), seed=3)
    run.advance(20_000)
    machine, sizes, arguments = copied(run)
    agent, rules, board = (run._parameters, run._state), run.world.rules, run.world_state
    probes, scene = probes_with(wasm.MODULES["plane"].constants), board.scene

    there, elsewhere = scene._replace(position=np.zeros(2)), mapped(np.copy, run._state)
    values = np.zeros((81, 4))
    copies = {"there": arguments["scene"]._replace(position=machine.put(np.zeros(2))),
              "elsewhere": machine.put_tuple(elsewhere), "values": machine.put(values)}
    execute(probes.survey, *agent, elsewhere, there, 9, values)
    machine.call("survey", sizes | {"tiles": 81}, side=9, **arguments, **copies)
    assert values.any() and np.array_equal(copies["values"][1], values)

    for m, x, y in ((0, 0.1, 0.9), (3, 0.6, 0.2)):
        cell = machine.call("cell_seen_at", sizes, m=m, x=x, y=y, **arguments, **copies)
        assert cell == execute(probes.cell_seen_at, run._parameters, elsewhere, scene, m, x, y)

    second = scene._replace(position=np.array([10.0, 10.0]), velocity=np.zeros(2))
    second_copy = arguments["scene"]._replace(position=machine.put(second.position),
                                              velocity=machine.put(second.velocity))
    game = arguments | {"board": arguments["world_state"], "rules": rules}
    met = 0
    for step, action in enumerate(np.random.default_rng(0).integers(0, 5, 1_000).tolist()):
        run.advance(1)
        machine.call("rollout", sizes, last_step=step + 1, bin_steps=10_000, **arguments)
        paid = execute(probes.step_second, *agent, board, rules, second, action)
        assert machine.call("step_second", sizes, second=second_copy, action=action, **game) == paid
        met += second.met.any()
    assert met > 5
    assert_equal_to(run, arguments)


@pytest.mark.parametrize("name", wasm.MODULES)
def test_a_module_is_small_and_asks_for_memory_alone(name):
    _, module = compiled(name)
    assert len(wasm.modules()[name]) <= 105_000
    assert [each.name for each in module.imports] == ["memory"]
    assert {each.name for each in module.exports} == {"__heap_base", *wasm.layout(name)["exports"]}


@pytest.fixture
def contents(tmp_path, monkeypatch):
    """The contents of the modules, with none left on disk and a build that fails the test."""
    contents = wasm.modules()
    monkeypatch.setenv("NEORL_CACHE", str(tmp_path))
    monkeypatch.setattr(wasm, "_built", lambda names: names and pytest.fail(f"built again: {names}"))
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
    monkeypatch.setattr(wasm, "_built", lambda names: {name: contents[name] for name in names})
    wasm.ship(tmp_path / "neorl")
    monkeypatch.undo()
    monkeypatch.setenv("NEORL_CACHE", str(tmp_path / "empty"))
    monkeypatch.setattr(wasm, "SHIPPED", {name: tmp_path / "neorl" / "browser" / f"{name}.wasm" for name in contents})
    assert wasm.modules() == contents and not (tmp_path / "empty").exists()
    others = dict.fromkeys(contents, b"of other sources")
    monkeypatch.setattr(wasm, "_built", lambda names: {name: others[name] for name in names})
    monkeypatch.setattr(wasm, "source_digest", lambda: "other sources")
    assert wasm.modules() == others


@pytest.mark.skipif(sys.platform == "win32", reason="Windows locks files differently")
def test_of_processes_that_start_at_once_one_builds_and_the_others_wait(contents, monkeypatch):
    built = []

    def build(names):
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
    monkeypatch.setattr(wasm, "_built", lambda names: {name: contents[name] for name in names})
    with pytest.warns(RuntimeWarning, match="cannot be kept"):
        assert wasm.modules() == contents


def test_a_failed_build_is_an_error(tmp_path, monkeypatch):
    monkeypatch.setenv("NEORL_CACHE", str(tmp_path))
    monkeypatch.setattr(sys, "executable", "/bin/false")
    with pytest.raises(RuntimeError, match="was not built"):
        wasm.modules()
