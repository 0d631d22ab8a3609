"""Agents, worlds and conditions as plain data are read as they were written, and errors are located by their path."""

import codecs
import json
import sys
import types
from collections import ChainMap, UserDict
from dataclasses import dataclass, field, replace
from types import MappingProxyType

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from neorl import (Agent, Condition, Desire, Learner, Learning, Node, Place, Policy, Result, Run, WaterWorld, World,
                   brownian, kernel, multimodal, network_a, network_b, network_c, network_d, object_vector_cells,
                   place_cells)
from neorl.custom import Axis, Modality, softmax
from neorl.worlds import Arena
from neorl.core.modality import HEAD_DIRECTION_CELL, LANDMARK_VECTOR_CELL, MODALITIES, PLACE_CELL
from neorl.description import described, restored
from neorl.experiments.bins import new_bins

PAPERS = (place_cells, object_vector_cells, multimodal, network_a, network_b, network_c, network_d)
SHARES = st.floats(0, 1)
OWN = Modality("place × direction", PLACE_CELL.axes + HEAD_DIRECTION_CELL.axes)


@kernel
def of_a_module(count, steps, last, activity):
    return 1.0 if last else 0.0


@dataclass(frozen=True)
class Cave(World):
    """A user's own world, which validates nothing."""

    depth: float
    rooms: tuple[tuple[str, int], ...] = ()
    map: Modality | None = None
    names: list[str] = field(default_factory=list)

    dynamics, rules = WaterWorld().dynamics, WaterWorld().rules
    actions, things, size, fps = WaterWorld().actions, WaterWorld().things, 250.0, 50


learnings = st.one_of(
    st.builds(Learning, learning_rate=SHARES, discount=SHARES, memory=st.floats(0, 1e9), terminal=st.booleans(),
              credit=st.sampled_from(["share", "last", of_a_module])),
    st.just(Learning(update_on="step")))
policies = st.builds(Policy, SHARES, choose=st.sampled_from([softmax(0.1), softmax(3), Policy().choose]))
choices = st.fixed_dictionaries({
    "learning": learnings, "policy": policies, "object_state": st.just("object")}, optional={
    "own_cell": st.sampled_from(["silent", "counts"]), "shared_cell": st.sampled_from(["each", "once"]),
    "resets": st.sampled_from(["noticed", "unnoticed"]), "tiled_fraction": st.floats(0.1, 2.0),
    "weighting": st.sampled_from(["equal", "cells"])})
of_papers = st.builds(lambda make, resolutions, chosen: make(resolutions, **chosen), st.sampled_from(PAPERS),
                      st.lists(st.integers(1, 30), min_size=1, max_size=3), choices)
others = st.sampled_from([
    brownian(), Agent([Node('"a"\n[b]', OWN, [2]), Node("é 𝄞", LANDMARK_VECTOR_CELL, [3])],
                      [Desire(Place(0.1, 0.2), '"a"\n[b]', 1.0), Desire((0.1, 0.2, 3), '"a"\n[b]', -0.0)])])
worlds = st.one_of(
    st.builds(WaterWorld, width=st.integers(11, 2**31), n_creeps=st.integers(1, 9), win_reward=st.floats(-1e30, 1e30)),
    st.builds(Arena, obstacles=st.sampled_from([(), [(0.1, 0.2, 0.3, 0.4)]]), pay=st.sampled_from([(), [2], [-0.5]])),
    st.builds(Cave, st.floats(allow_nan=False, allow_infinity=False) | st.integers(),
              st.sampled_from([(), (("hall", 3), ("nook", -1))]), st.sampled_from([None, OWN])))
conditions = st.builds(Condition, of_papers | others, worlds, st.integers(5, 2**40), st.integers(1, 99),
                       st.integers(0, 2**70), st.lists(st.tuples(st.just(4), of_papers), max_size=2))


@settings(max_examples=60)
@given(condition=conditions, suffix=st.sampled_from(["toml", "json"]))
def test_a_condition_is_read_again_as_it_was_written(tmp_path_factory, condition, suffix):
    assert Condition.from_dict(condition.to_dict()) == condition
    if suffix == "toml":
        pytest.importorskip("tomli_w")
    path = tmp_path_factory.mktemp("written") / f"condition.{suffix}"
    condition.save(path)
    again = Condition.load(path)
    assert again == condition and again.key == condition.key
    assert type(again.world) is type(condition.world)


def test_an_experiment_can_be_written_by_hand(tmp_path):
    path = tmp_path / "experiment.toml"
    path.write_text("""
        steps = 1_000
        runs = 2
        world = { is = "WaterWorld", n_creeps = 8 }

        [agent]
        is = "place_cells"
        resolutions = [3, 7]
        learning = { memory = 10 }
        policy.choose = { kernel = "softmax", of = [0.5] }
    """)
    agent = place_cells([3, 7], learning=Learning(memory=10.0), policy=Policy(choose=softmax(0.5)))
    assert Condition.load(path) == Condition(agent, WaterWorld(n_creeps=8), 1_000, 2)
    (tmp_path / "MARKED.TOML").write_bytes(codecs.BOM_UTF8 + path.read_bytes())  # as by an editor of Windows
    assert Condition.load(tmp_path / "MARKED.TOML") == Condition.load(path)


@pytest.mark.parametrize("exists", [True, False])
def test_a_link_to_a_file_stays_one(tmp_path, exists):
    target, link = tmp_path / "folder" / "target.JSON", tmp_path / "link.json"
    if exists:
        target.parent.mkdir()
        target.write_text("")
    link.symlink_to(target)
    WaterWorld(n_creeps=8).save(link)
    assert link.is_symlink() and WaterWorld.load(target) == WaterWorld(n_creeps=8)


def test_modalities_and_kernels_go_by_name_and_numbers_of_numpy_are_plain_numbers(monkeypatch):
    module = types.ModuleType("my_modalities")
    module.OWN = OWN
    monkeypatch.setitem(sys.modules, "my_modalities", module)
    for name, modality in ((each.name, each) for each in MODALITIES):
        assert restored({"name": "X", "modality": name, "resolutions": [2]}, Node).modality is modality
    node = restored({"name": "X", "modality": "my_modalities:OWN", "resolutions": np.array([2, 3])}, Node)
    assert repr(node) == repr(Node("X", OWN, (2, 3)))
    data = {"is": np.str_("WaterWorld"), "n_creeps": np.int64(3), "win_reward": np.array(0.5)}
    assert repr(World.from_dict(data)) == repr(WaterWorld(n_creeps=3, win_reward=0.5))
    assert described(Policy())["choose"] == {"kernel": "greedy"}
    assert described(Learning(credit=of_a_module))["credit"] == {"kernel": f"{__name__}:of_a_module"}


FINE = {"agent": {"is": "place_cells"}, "world": {"is": "WaterWorld"}, "steps": 100, "runs": 2}
NODE = {"name": "PC", "modality": "place cell", "resolutions": [3]}


@pytest.mark.parametrize("change, message", [
    ({"stepps": 3}, "^a field of the data must be 'agent', .*, but is 'stepps'; did you mean 'steps'"),
    ({"steps": "many"}, "^steps must be an integer of at least 1, but is 'many'"),
    ({"world": {}}, "^world.is must be the name of a kind of World, but is missing"),
    ({"world": {"is": "WaterWorlds"}}, "^world.is must be a name of neorl, or 'module:name' of what can be imported, "),
    ({"world": {"is": "place_cells"}}, "^world.is must be the name of a kind of World, but is 'place_cells'"),
    ({"world": {"is": "Arena", "places": [["a", 0.1, {"kernel": "greedy"}]]}},
     "^world.places must be .*, but is <kernel"),
    ({"world": {"is": f"{__name__}:Cave", "depth": "deep"}}, "^world.depth must be a number, but is 'deep'"),
    ({"world": {"is": f"{__name__}:Cave", "depth": 1, "rooms": [["a", 1], ["b", 0.5]]}},
     r"^world.rooms\[1\]\[1\] must"),
    ({"world": {"is": "no_such_module:Cave"}}, "^world.is must be a name of neorl, or 'module:name' of what can be im"),
    ({"agent": {"is": "os:system"}}, "^agent.is must be the name of a kind of Agent, but is 'os:system'"),
    ({"agent": {"is": "place_cells", "learning": {"memry": 3}}}, "^a field of agent.learning must be .* 'memory'"),
    ({"agent": {}}, "^agent.nodes must be .*, but is missing"),
    ({"agent": {"nodes": [NODE | {"modality": "place cel"}]}},
     r"^agent.nodes\[0\].modality must be a table, 'module:N"),
    ({"agent": {"nodes": [NODE | {"modality": "os:path"}]}},
     r"^agent.nodes\[0\].modality must be .*, but is 'os:path'"),
    ({"agent": {"nodes": [NODE], "desires": [{"source": {"coordinates": ["x"]}, "target": "PC"}]}},
     r"^agent.desires\[0\].source.coordinates must be .*, but is 'x'"),
    ({"agent": {"is": "place_cells", "policy": {"choose": {"kernel": "softmax", "of": [-1]}}}},
     r"^agent.policy.choose.of is \[-1\]: temperature must be a finite number from 1e-30 to 1e\+30, but is -1"),
    ({"agent": {"is": "place_cells", "policy": {"choose": {"kernel": "os:system", "of": ["exit 3"]}}}},
     "^agent.policy.choose.kernel must be .*, but is 'os:system'"),
    ({"agent": {"is": "place_cells", "policy": {"choose": {"kernel": "greedy", "o": 1}}}}, "^the fields of agent.poli"),
    ({"changes": [[3, 5]]}, r"^changes\[0\]\[1\] must be an Agent, but is 5")])
def test_what_is_wrong_is_named_by_its_path(tmp_path, change, message):
    with pytest.raises(ValueError, match=message):
        Condition.from_dict(FINE | change)
    (tmp_path / "condition.json").write_text(json.dumps(FINE | change))
    with pytest.raises(ValueError, match=f"^{tmp_path / 'condition.json'}: {message.replace('^', '')}"):
        Condition.load(tmp_path / "condition.json")


@pytest.mark.parametrize("kind", [MappingProxyType, UserDict, ChainMap])
def test_any_mapping_is_a_table(kind):
    data = kind(FINE | {"agent": kind({"is": "place_cells", "policy": kind({"choose": kind(
        {"kernel": "softmax", "of": [0.5]})})})})
    assert Condition.from_dict(data).agent == place_cells(policy=Policy(choose=softmax(0.5)))


def test_a_path_may_begin_at_the_users_home(tmp_path, monkeypatch):
    monkeypatch.setenv("HOME", str(tmp_path))
    monkeypatch.setenv("USERPROFILE", str(tmp_path))
    monkeypatch.chdir(tmp_path)
    agent = place_cells([2])
    result = Result(Condition(agent, WaterWorld(), 20, 1), *new_bins(WaterWorld(), 1, 20))
    for made in (agent, result, Run(agent, WaterWorld()), Learner(agent, 1, ("green", "red"))):
        made.save("~/made.json")
        assert isinstance(type(made).load("~/made.json"), type(made)) and (tmp_path / "made.json").exists()
    assert not (tmp_path / "~").exists()


def test_data_that_contain_themselves_are_refused():
    data = dict(NODE)
    data["nodes"] = [data]
    with pytest.raises(ValueError, match="a field of the data must be 'nodes', 'desires', 'learning', 'policy', 'own_"):
        Agent.from_dict(data)
    deep = []
    for _ in range(100_000):
        deep = [deep]
    with pytest.raises(ValueError, match="data must be nested less deeply than these to be described"):
        Agent.from_dict({"nodes": deep})


@pytest.mark.parametrize("name, content, message", [
    ("a.toml", b"steps = ", "must be written in TOML, but is not: Invali"), ("a.json", b"{", "must be written in JSO"),
    ("a.json", "{}".encode("utf-16"), "must be a text in UTF-8, but is not: .*; save it as UTF-8"),
    ("a.toml", "steps = 3".encode("utf-16"), "must be a text in UTF-8, but is not: .*; save it as UTF-8"),
    ("a.toml", "steps = 3".encode("utf-16-le"), "must be a text in UTF-8, but is not: .*; save it as UTF-8"),
    ("a.json", b"[1]", r"must be a table of fields, but is \[1\]"),
    ("a.json", b"[" * 100_000, "must be written in JSO"), ("a.yaml", b"", "must be a name that ends in .toml or"),
])
def test_other_files_are_refused_by_name(tmp_path, name, content, message):
    (tmp_path / name).write_bytes(content)
    with pytest.raises(ValueError, match=f"(?=.*{tmp_path / name}).*{message}"):
        Agent.load(tmp_path / name)
    with pytest.raises(OSError, match="nowhere"):
        Agent.load(tmp_path / "nowhere.toml")


def test_what_cannot_be_found_again_is_not_written(tmp_path):
    @kernel
    def of_no_module(value, stream):
        return 0

    @dataclass(frozen=True)
    class Hidden(World):
        depth: float = 1.0

    for value, message in ((place_cells([2], policy=Policy(choose=of_no_module)), "^policy.choose must be a kernel th"),
                           (Hidden(), "the value must be a "), (Cave(np.float32(0.1)), "^depth must be a number, a te"),
                           (Cave(np.zeros(2)), "^depth must be a number, a text, a tuple, a dataclass or a kernel to")):
        with pytest.raises(ValueError, match=message):
            value.save(tmp_path / "value.json")
    for value in (Cave(float("nan")), Cave(float("inf"))):
        with pytest.raises(ValueError, match="not JSON compliant"):
            value.save(tmp_path / "value.json")
    assert not list(tmp_path.iterdir())


def test_none_is_left_out_where_it_is_the_default_and_refused_by_toml_elsewhere(tmp_path):
    pytest.importorskip("tomli_w")
    assert "intervals" not in described(Axis("position")) and "map" not in described(Cave(1.0))
    Cave(None).save(tmp_path / "cave.json")
    with pytest.raises(ValueError, match="choose a name that ends in .json"):
        Cave(None).save(tmp_path / "cave.toml")


WHOLE = Condition(replace(network_d(), policy=Policy(choose=softmax(0.5))), Arena(), 500, 3, changes=[(9, brownian())])
JSON = st.recursive(st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=9) | st.sampled_from(
    ["Agent", "Arena", "place_cells", "greedy", "softmax", "kernel", "place cell", "os:path", ":", "neorl:neorl"]),
    lambda each: st.lists(each, max_size=3) | st.dictionaries(
        st.sampled_from(["is", "kernel", "of", "nodes", "name", "steps"]) | st.text(max_size=5), each, max_size=3))


@st.composite
def damaged(draw):
    """The data of a condition with one value replaced by arbitrary data."""
    data = WHOLE.to_dict()
    at, key = data, draw(st.sampled_from(sorted(data)))
    while isinstance(at[key], dict | list) and at[key] and draw(st.integers(0, 5)):
        at = at[key]
        key = draw(st.sampled_from(sorted(at) if isinstance(at, dict) else range(len(at))))
    at[key] = draw(JSON)
    return data


@settings(max_examples=300)
@given(data=damaged() | JSON)
def test_data_are_those_of_a_condition_or_refused(data):
    try:
        condition = Condition.from_dict(data)
    except ValueError:
        return
    assert Condition.from_dict(condition.to_dict()) == condition
