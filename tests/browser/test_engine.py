"""The Explorer's engine, called directly, reports of a run exactly what Python computes."""

import base64
import copy
import json
from dataclasses import replace

import numpy as np
import pytest

from neorl import (Contacts, Explorer, Learning, Node, NresMap, Run, WaterWorld, forager, network_d, place_cells,
                   simulate)
from neorl.worlds import Arena
from neorl.browser import wasm
from neorl.browser.explorer import OTHER_SPACES, parameters_in_page, world_in_page
from neorl.core.coordinates import sense
from neorl.core.horde import as_vectors
from neorl.core.modality import PLACE_CELL
from neorl.kernels.annotations import mapped
from neorl.kernels.execution import execute
from neorl.browser.probe import step_second, survey

ENGINE = """
const ask = (worker, request) => new Promise((resolve, reject) => {
  worker.onmessage = ({ data }) => resolve(data);
  worker.onerror = ({ message }) => reject(new Error(message));
  worker.postMessage(request);
});
async function answers([requests, last, layouts]) {
  const worker = new Worker(URL.createObjectURL(new Blob([state._engine])));
  for (const [name, layout] of Object.entries(layouts ?? state._layout)) {
    const wasm = Uint8Array.from(atob(state.wasm[name]), (byte) => byte.charCodeAt(0)).buffer;
    await ask(worker, { type: "load", name, wasm, layout });
  }
  const all = [];
  for (const request of requests) all.push(await ask(worker, request));
  worker.terminate();
  return JSON.parse(JSON.stringify(all.slice(-last), (_, value) => ArrayBuffer.isView(value) ? [...value] : value));
}
"""
CALLS = wasm.MODULES["plane"].loop.functions
TANK = WaterWorld(n_creeps=4)
AGENT = network_d([4, 5])
STEPS, SEED, K = 3_000, 5, 2


@pytest.fixture(scope="module")
def state():
    result = simulate(AGENT, TANK, steps=STEPS, runs=2, seed=SEED, progress=False)
    state = Explorer({"D": result}).get_state()
    return {name: state[name] for name in ("_engine", "_layout", "_presets")} | {
        "wasm": {name: base64.b64encode(each).decode() for name, each in state["_wasm"].items()}}


@pytest.fixture(scope="module")
def ask(open_shared_page, tmp_path_factory, state):
    """`ask(request, …)` begins a run and returns the engine's answers to this and to each request.

    last: how many answers are wanted, or 0 for all; thousands take long to come back from the page. layouts: of the
    modules, in place of their own.
    """
    folder = tmp_path_factory.mktemp("engine")
    preset = state["_presets"]["D"]
    begin = {"type": "begin", "parameters": preset["parameters"], "world": preset["world"], "seed": SEED, "run": K,
             "steps": 10 * STEPS, "bin_steps": 100}
    script = f"const state = {json.dumps(state)};{ENGINE}".replace("</", r"<\/")
    (folder / "page.html").write_text(f'<!doctype html><meta charset="utf-8"><link rel="icon" href="data:,">'
                                        f'<script>{script}</script>')
    page = open_shared_page(folder, "page.html")

    def ask(*requests, last=0, layouts=None, **changes):
        return page.evaluate("given => answers(given)", [[begin | changes, *requests], last, layouts])
    return ask


def advance(steps):
    return {"type": "advance", "steps": steps, "budget": 60_000}


def test_a_run_that_goes_on_has_bins_twice_as_long_and_keeps_what_it_earned_and_met(ask):
    _, before, after = ask(advance(STEPS), {"type": "extend"})
    totals = [(each["rewards"], *(kind["counts"] for kind in each["hits"])) for each in (before, after)]
    for short, long in zip(*totals):
        assert long[: len(short) // 2] == np.reshape(short, (-1, 2)).sum(axis=1).tolist()
    assert sum(totals[0][1]) > 0


def test_a_frame_reports_the_state_of_the_run(ask):
    goal = 7
    begun, _, frame = ask({"type": "look", "map": "OVC N5", "goal": goal, "field": 9, "heat": 9},
                          advance(STEPS))
    run = Run(AGENT, TANK, SEED, K)
    rewards, hits = np.zeros(2 * STEPS, np.float32), np.zeros((2 * STEPS, 2), np.int16)
    assert frame["reward"] == run.advance(STEPS, rewards, hits)
    assert frame["step"] == STEPS and not frame["ended"]
    assert np.array_equal(frame["rewards"][: STEPS // 100], rewards[: STEPS // 10].reshape(-1, 10).sum(axis=1))
    assert [each["counts"][: STEPS // 100] for each in frame["hits"]] == hits[: STEPS // 10].reshape(
        -1, 10, 2).sum(axis=1).T.tolist()
    assert begun["maps"] == ["PC N4", "PC N5", "OVC N4", "OVC N5"]
    assert begun["shapes"] == ["4 × 4", "5 × 5", "4 × 4", "5 × 5"]
    assert (frame["seen"]["name"], frame["seen"]["goal"]) == ("OVC N5", goal)

    width, state, scene = TANK.width, run.world_state, run.world_state.scene
    assert [frame["agent"][name] for name in "xy"] == pytest.approx(scene.position / width)
    assert [frame["agent"][name] for name in ("vx", "vy")] == pytest.approx(scene.velocity / width)
    creeps = frame["things"]
    assert [creep["kind"] for creep in creeps] == [TANK.kinds[kind] for kind in scene.kinds]
    assert np.array([(creep["x"], creep["y"]) for creep in creeps]) == pytest.approx(scene.things / width)
    velocity = state.direction * state.speed[:, None] / width
    assert np.array([(creep["vx"], creep["vy"]) for creep in creeps]) == pytest.approx(velocity)
    nres = run.state.maps[3]
    assert frame["active"] == run.memory.tracks.cell[nres.first_track : nres.end_track].tolist()

    for node in frame["nodes"]:
        output = run.output(node["name"])
        assert (node["x"], node["y"], node["valence"]) == pytest.approx((*output.desire, output.valence))
    landings = run.state.desires.target_at[2:] + scene.position / width
    assert np.array([(each["x"], each["y"]) for each in frame["landings"]]) == pytest.approx(landings)
    assert [each["valence"] for each in frame["landings"]] == run.state.desires.total_valence[2:].tolist()
    assert [each["recurs"] for each in frame["landings"]] == [False, False, True]

    assert np.array(frame["seen"]["ways"]).reshape(-1, 2) == pytest.approx(as_vectors(run.q(3)[0].T))
    values = np.zeros((81, 4))
    execute(survey, run._record, run._record.copy(), mapped(np.copy, run._memory),
            scene._replace(position=np.zeros(2)), CALLS, 9, values)
    assert np.array(frame["field"]).reshape(-1, 2) == pytest.approx(as_vectors(values), rel=1e-6)
    assert frame["heat"] == pytest.approx(values.max(axis=1), rel=1e-6)


MAZES = [Arena(), Arena(places=[("food", 0.8, 0.2), ("shock", 0.3, 0.7)], pay=[1.0, -2.0], ends=False, radius=0.2,
                        shape="square", obstacles=[(0.4, 0.0, 0.5, 0.6)], motion="steps", trial_seconds=20.0)]


@pytest.mark.parametrize("maze", MAZES, ids=["pool", "walls"])
def test_a_run_in_the_arena_is_that_of_python_to_the_last_bit(ask, maze):
    agent, goal = place_cells([4, 5]), 9
    agent = replace(agent, desires=[replace(agent.desires[0], source=kind) for kind in maze.kinds])
    finer = replace(agent, nodes=[replace(agent.nodes[0], resolutions=[5, 6])])
    look = {"type": "look", "map": "PC N5", "goal": goal, "field": 9}
    frame = ask(advance(STEPS), {"type": "change", "parameters": parameters_in_page(finer, maze)}, advance(STEPS), look,
                parameters=parameters_in_page(agent, maze), world=world_in_page(maze))[-1]
    run = Run(agent, maze, SEED, K)
    reward = run.advance(STEPS)
    run.change(finer)
    assert frame["reward"] == reward + run.advance(STEPS) != 0
    assert np.reshape(frame["seen"]["ways"], (-1, 2)).tolist() == learned(run, 0, goal)
    assert [frame["agent"][name] for name in ("x", "y", "vx", "vy")] == [
        *run.world_state.scene.position, *run.world_state.scene.velocity]
    assert [(each["kind"], each["x"], each["y"]) for each in frame["things"]] == list(maze.places)
    assert (frame["round"], frame["radius"]) == (maze.shape == "round", maze.radius)
    assert np.reshape(frame["obstacles"], (-1, 4)).tolist() == [list(each) for each in maze.obstacles]
    assert np.count_nonzero(frame["field"]) > 20


def test_in_another_space_a_frame_shows_the_world_as_it_is(ask):
    for name, (agent, world) in OTHER_SPACES.items():
        frame = ask(advance(STEPS), parameters=parameters_in_page(agent, world), world=world_in_page(world))[-1]
        run = Run(agent, world, SEED, K)
        assert frame["reward"] == run.advance(STEPS), name
        state, scene = run.world_state, run.world_state.scene
        assert [frame["agent"][each] for each in ("x", "y", "vx", "vy")] == [*scene.position, *scene.velocity]
        assert [(each["x"], each["y"]) for each in frame["things"]] == [
            tuple(place) for place, kind in zip(scene.things, scene.kinds) if kind >= 0]
        if name.startswith("Arm"):
            hand = frame["arm"]["links"][-1]
            assert (hand["x"], hand["y"]) == pytest.approx(tuple(state.hand))
            assert [(each["x"], each["y"]) for each in frame["arm"]["points"]] == [tuple(each) for each in state.point]
        elif name.startswith("Vessel"):
            assert frame["heading"] == state.heading.tolist() and frame["current"] == list(world.current)
            assert [(each["vx"], each["vy"]) for each in frame["things"]] == [tuple(each) for each in state.course]
        else:
            assert [frame["hidden"][each] for each in "xy"] == state.platform.tolist()


def test_a_radar_finds_a_place_by_its_bearing(ask):
    agent, world = OTHER_SPACES["Vessel with a radar"]
    places = [(0.1, 0.9), (0.55, 0.3), (0.9, 0.52)]
    found = ask(*({"type": "look", "map": "far N8", "goal": None, "at": {"x": x, "y": y}} for x, y in places),
                advance(1), parameters=parameters_in_page(agent, world), world=world_in_page(world))[1:]
    run = Run(agent, world, SEED, K)
    scene, (node, _) = run.world_state.scene, agent.nodes
    for place, frame in zip(places, found):
        things = np.vstack([place, scene.things[1:]])
        coordinates = sense(node.modality, scene._replace(things=things), 1.0)[0]
        assert frame["seen"]["goal"] == agent.maps[0].encode(coordinates)
    assert found[-1]["reward"] == run.advance(1)
    assert [(each["x"], each["y"]) for each in found[-1]["things"]] == [tuple(each) for each in scene.things]
    assert [each["feature"] for each in found[0]["seen"]["axes"]] == ["length", "bearing"]


def learned(run, m, goal):
    """Learned values as the engine returns them: east minus west and south minus north in each cell, in float32.

    In a map whose state is the self, each cell is a goal with values of its own.
    """
    q = run.q(m)
    values = q[0].T if len(q) == 1 else q[:, :, goal]
    return as_vectors(values.astype(float)).astype(np.float32).tolist()


@pytest.mark.parametrize("later", [
    network_d([5, 7], learning=Learning(memory=30.0, discount=0.95)),
    network_d([4, 5], learning=Learning(memory=30.0), object_state="object"),
    network_d([4, 5], learning=Learning(memory=30.0), object_state="per object"),
    network_d([4, 5], learning=Learning(memory=30.0), object_beyond="none"),
    network_d([4, 5], learning=Learning(memory=30.0), object_centred=True),
    network_d([4, 5], learning=Learning(memory=100.0, discount=0.95)),
    network_d([5, 7], learning=Learning(memory=3.0)),
    network_d([4, 5], learning=Learning(memory=0.0)),
    network_d([4, 5], learning=Learning(memory=30.0, bootstrap=False)),
    network_d([4, 5], learning=Learning(memory=30.0)), network_d([4, 5], learning=Learning(memory=30.0), recursion=2.0),
])
def test_a_memory_that_changes_on_the_way_goes_on_as_in_python(ask, later):
    agent, goal = network_d([4, 5], learning=Learning(memory=30.0)), 9
    maps = [f"{node.name} N{n}" for node in later.nodes for n in node.resolutions]
    change = {"type": "change", "parameters": parameters_in_page(later, TANK)}
    *_, frame, objects = ask(advance(STEPS), change, advance(STEPS),
                             *({"type": "look", "map": f"{node} N5", "goal": goal} for node in ("PC", "OVC")),
                             parameters=parameters_in_page(agent, TANK))
    run = Run(agent, TANK, SEED, K)
    reward = run.advance(STEPS)
    run.change(later)
    assert frame["reward"] == reward + run.advance(STEPS)
    for each in (frame, objects):
        m = maps.index(each["seen"]["name"])
        assert np.reshape(each["seen"]["ways"], (-1, 2)).tolist() == learned(run, m, goal)
        nres = run.state.maps[m]
        assert each["active"] == run.memory.tracks.cell[nres.first_track : nres.end_track].tolist()


HUNTER = forager([5, 9], valence_green=1.0, valence_red=-1.0)
AFTER_STATES = replace(HUNTER, contacts=Contacts(efference=0.25, rivals=0.3))
MORE = Node("PC", PLACE_CELL, [4])


@pytest.mark.parametrize("first, later", [
    (HUNTER, HUNTER), (HUNTER, replace(HUNTER, nodes=[MORE, *HUNTER.nodes])), (HUNTER, AFTER_STATES),
    (AFTER_STATES, AFTER_STATES), (AFTER_STATES, replace(AFTER_STATES, nodes=[MORE, *HUNTER.nodes])),
    (AFTER_STATES, replace(AFTER_STATES, contacts=Contacts(efference=0.2)))],
    ids=["same", "moved", "to after-states", "same after-states", "after-states moved", "another push"])
def test_contacts_on_the_way_of_a_change_are_credited_as_in_python(ask, first, later):
    change = {"type": "change", "parameters": parameters_in_page(later, TANK)}
    *_, frame = ask(advance(STEPS), change, advance(STEPS), parameters=parameters_in_page(first, TANK))
    run = Run(first, TANK, SEED, K)
    reward = run.advance(STEPS)
    run.change(later)
    assert frame["reward"] == reward + run.advance(STEPS) != 0


DRAWN = {"q", "goal_range", "tracks", "cuts", "goals"}  # what of an agent's memory a page draws, or orders anew


def renamed(layout):
    """The layout of a module in which all other arrays of an agent's memory, and their sizes, have other names."""
    memory = layout["tuples"]["Memory"]
    names = {name for name, _ in memory} - DRAWN
    shapes = {name: shape for name, (_, shape) in memory}
    sizes = {*layout["sizes"], *(shapes[name][0] for name in layout["joined"])}
    new = {name: f"renamed {name}" for name in names}
    new_size = {size: f"{size}-renamed" for size in sizes}
    fields = [[new.get(name, name), [dtype, [new_size.get(each, each) for each in shape]]]
              for name, (dtype, shape) in memory]
    return layout | {
        "tuples": layout["tuples"] | {"Memory": fields},
        "joined": {new[name]: source for name, source in layout["joined"].items()},
        "sizes": {new_size[size]: product for size, product in layout["sizes"].items()},
        "kept": {new.get(name, name): how for name, how in layout["kept"].items()}}


def test_a_page_knows_by_the_layout_alone_what_an_agent_s_memory_holds_and_what_it_keeps(ask, state):
    agent = network_d([4, 5], learning=Learning(memory=30.0))
    later = network_d([5, 7], learning=Learning(memory=30.0), object_state="per object")
    requests = (advance(STEPS), {"type": "change", "parameters": parameters_in_page(later, TANK)}, advance(STEPS),
                {"type": "look", "map": "OVC N5", "goal": 7, "field": 9, "heat": 9})
    layouts = {name: renamed(layout) for name, layout in json.loads(json.dumps(state["_layout"])).items()}
    assert layouts["plane"]["kept"]["renamed left"] == ["places", "track"]
    given = {"parameters": parameters_in_page(agent, TANK), "last": 1}
    assert ask(*requests, layouts=layouts, **given) == ask(*requests, **given)


@pytest.mark.parametrize("object_state", ["object", "self", "per object"])
def test_a_second_agent_obeys_commands_on_the_same_creeps(ask, object_state):
    agent = network_d([4, 5], object_state=object_state)
    actions, each = np.random.default_rng(0).integers(0, 5, 300).tolist(), 5  # steps by an action
    frame = ask(advance(STEPS), *(request for action in actions
                                  for request in ({"type": "play", "action": action}, advance(each))),
                last=1, parameters=parameters_in_page(agent, TANK))[-1]
    run = Run(agent, TANK, SEED, K)
    run.advance(STEPS)
    second = run.world_state.scene._replace(position=np.full(2, 0.1 * TANK.width), velocity=np.zeros(2))
    paid, touched = 0.0, 0
    for action in np.repeat(actions, each).tolist():
        run.advance(1)
        board = run.world_state
        paid += execute(step_second, run._record, run._memory, board.scene, CALLS, board, TANK.rules, second,
                        action)
        touched += np.count_nonzero(second.met)
    assert touched > 2 and frame["player"]["reward"] == paid
    assert [frame["player"][name] for name in "xy"] == pytest.approx(second.position / TANK.width)
    assert [frame["agent"][name] for name in "xy"] == pytest.approx(run.world_state.scene.position / TANK.width)


def test_a_reader_acts_in_place_of_the_agent_on_the_board_of_its_run(ask):
    actions, later = np.random.default_rng(0).integers(0, 5, 900).tolist(), replace(AGENT, desires=AGENT.desires[:1])
    frame = ask({"type": "steer", "actions": actions[:700]}, {"type": "steer", "actions": actions[700:]},
                changes=[{"step": 450, "parameters": parameters_in_page(later, TANK)}])[-1]
    state = Run(AGENT, TANK, SEED, K).world_state
    paid, met = 0.0, np.zeros(2)
    for action in actions:
        reward, done = execute(TANK.dynamics.step, state, TANK.rules, action)
        paid += reward
        for kind in state.scene.met[state.scene.met > 0] - 1:
            met[kind] += 1
        if done:
            execute(TANK.dynamics.reset, state, TANK.rules)
    assert met.all() and [sum(each["counts"]) for each in frame["hits"]] == [*met]
    assert frame["step"] == 900 and frame["reward"] == paid == sum(frame["rewards"])
    assert [frame["agent"][name] for name in "xy"] == pytest.approx(state.scene.position / TANK.width)
    assert len(frame["wants"]) == len([each for each in later.desires if each.source in TANK.kinds])


def test_a_place_is_found_in_the_cell_that_it_lies_in(ask):
    places = [(0.1, 0.9), (0.55, 0.3), (0.99, 0.01)]
    found = ask(*({"type": "look", "map": name, "goal": None, "at": {"x": x, "y": y}}
                  for name in ("PC N5", "OVC N4") for x, y in places))[1:]
    agent = Run(AGENT, TANK, SEED, K).world_state.scene.position / TANK.width
    place, objects = (node.modality for node in AGENT.nodes)
    expected = [*NresMap(5, place).encode(places), *NresMap(4, objects).encode(places - agent)]
    assert [each["seen"]["goal"] for each in found] == expected
    twice = {"type": "look", "at": {"x": 0.5, "y": 0.5}}
    assert [each["seen"]["goal"] is None for each in ask(twice, twice)[1:]] == [False, True]


def test_the_map_that_is_looked_at_stays_and_its_goal_with_it_if_it_has_the_same_cells(ask, state):
    parameters = state["_presets"]["D"]["parameters"]
    finer, other, without = (copy.deepcopy(parameters) for _ in range(3))
    for node in (*finer["nodes"], *other["nodes"]):
        node["resolutions"] = [5, 6]
    for node in without["nodes"]:
        node["resolutions"] = [6, 9]
    other["nodes"][0]["axes"][0]["low"] = 0.1
    frames = ask({"type": "look", "map": "PC N5", "goal": 24}, *({"type": "change", "parameters": each} for each in (
        finer, other, without)))[1:]
    assert [(each["seen"]["name"], each["seen"]["goal"]) for each in frames] == [
        ("PC N5", 24), ("PC N5", 24), ("PC N5", None), ("PC N6", None)]
