"""The Explorer from Python: what its state contains, what its traits accept, and which agent they describe."""

import json
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest
from traitlets import TraitError

import neorl
from neorl import (CALIBRATED, Agent, Condition, Desire, Explorer, Learning, Node, Policy, WaterWorld, multimodal,
                   network_d, object_vector_cells, place_cells, simulate)
from neorl.worlds import Arena, Vessel
from neorl.agents.papers import OF_OBJECTS
from neorl.agents.spaces import pilot
from neorl.browser.curves import CURVE_BINS
from neorl.browser.explorer import AGENTS, IN_THE_ARENA, OTHER_SPACES, STEPS
from neorl.browser.settings import SETTINGS
from neorl.core import modality
from companion.thesis.reading import TO_THE_LETTER as LETTER

TANK = WaterWorld(n_creeps=8, win_reward=5.0)
SIZE = {"steps": 12_345, "runs": 12, "seed": 5, "progress": False}

TWO_STATES = Agent([Node(state, modality.CARTESIAN_OBJECT_VECTOR_CELL, [3], state=state) for state in (
    "object", "self")])


@neorl.kernel
def half(count, steps, last, activity):
    return 0.5


@pytest.fixture(scope="module")
def conditions():
    return {"N3": simulate(place_cells([3]), TANK, **SIZE),
            "by N²": simulate(place_cells([3, 5], weighting="cells", learning=Learning(credit="last")), TANK, **SIZE)}


@pytest.mark.parametrize("name", AGENTS)
def test_the_traits_of_a_preset_describe_its_agent(name):
    explorer = Explorer(preset=name)
    assert explorer.agent == AGENTS[name]
    other = {each: world for each, (_, world) in OTHER_SPACES.items()}
    assert explorer.world == (Arena() if name in IN_THE_ARENA else other.get(name, WaterWorld()))


def test_presets_to_the_letter_run_at_their_frame_rate_in_the_tank_of_the_page():
    slow = simulate(place_cells([3]), WaterWorld(n_creeps=2, fps=25), steps=10, runs=1, progress=False)
    explorer = Explorer({"slow": slow}, preset="Network D, to the letter")
    assert explorer.world == WaterWorld(n_creeps=2, fps=LETTER.world.fps, contact=LETTER.world.contact)
    explorer.preset = "Network D"
    assert explorer.world == slow.world


def test_conditions_come_first_and_set_tank_seed_and_traits(conditions):
    explorer = Explorer(conditions)
    assert (explorer.preset, explorer.seed, explorer.n_creeps) == ("N3", 5, 8)
    explorer.preset = "by N²"
    assert explorer.agent == conditions["by N²"].agent and explorer.world == TANK
    assert Explorer(conditions, preset="Network D", resolutions=[4]).agent == network_d([4])


def test_each_trait_changes_its_field_of_the_agent():
    explorer = Explorer(preset="Network D", learning_rate=0.2, discount=0.5, recursion=0.5, valence_red=-2.0,
                        gains=[0.5, 2.0], exploration=0.1, n_creeps=4, resolutions=[3, 6], memory=20.0)
    agent = network_d([3, 6], recursion=0.5, place_gain=0.5, object_gain=2.0,
                      learning=replace(CALIBRATED, learning_rate=0.2, discount=0.5, memory=20.0))
    desires = [replace(each, valence=-2.0) if each.source == "red" else each for each in agent.desires]
    assert explorer.agent == replace(agent, desires=desires, policy=Policy(exploration=0.1))
    assert explorer.world == WaterWorld(n_creeps=4)
    explorer.preset = "Object-vector cells"
    assert explorer.agent == object_vector_cells()
    explorer.modality = "border cell"
    assert explorer.agent.nodes[0].modality == modality.BORDER_CELL


@pytest.mark.parametrize("state", ["object", "self", "per object"])
def test_the_state_of_object_vectors_is_a_trait(state):
    explorer = Explorer(preset="Network D", object_state=state)
    assert explorer.agent == network_d(object_state=state)
    explorer.preset = "Object-vector cells"
    assert explorer.object_state == OF_OBJECTS["object_state"] and explorer.agent == object_vector_cells()
    explorer.object_state = state
    assert explorer.agent == object_vector_cells(object_state=state)


@pytest.mark.parametrize("preset", ["Foveated cells, contacts alone", "Arm of two links", "Vessel with a radar"])
def test_an_agent_without_cartesian_object_vectors_has_no_state_of_them(preset):
    explorer = Explorer(preset=preset)
    assert explorer.object_state == "" and explorer.agent == AGENTS[preset]
    with pytest.raises(TraitError, match="object_state must be '', but is 'self'"):
        explorer.object_state = "self"


def test_the_band_holds_the_runs_and_ends_with_them(conditions):
    band = Explorer(conditions)._presets["N3"]["band"]
    result = conditions["N3"]
    assert band["edges"][0] == 0 and band["edges"][-1] == pytest.approx(result.seconds)
    assert len(band["low"]) == len(band["edges"]) - 1 <= CURVE_BINS
    assert band["edges"][1] == band["steps_per_bin"] / TANK.fps and band["has_all"]
    assert np.sum(band["middle"] * np.diff(band["edges"])) == pytest.approx(result.totals.mean(), abs=0.1)
    assert np.all(np.array(band["low"]) <= band["high"])


def test_the_state_is_json_and_a_second_widget_brings_its_own(conditions):
    state = Explorer(conditions).get_state()
    json.dumps({name: value for name, value in state.items() if name != "_wasm"}, allow_nan=False)
    assert {bytes(each[:4]) for each in state["_wasm"].values()} == {b"\0asm"}
    assert Explorer(seed=7).get_state()["seed"] == 7


FORAGER, NETWORK, MAZE = "Foveated cells, contacts alone", "Network D", "Place cells in the water maze"
ARM = "Arm of two links"


@pytest.mark.parametrize("preset, trait, value, allowed", [
    ("Place cells", "preset", "Network E", "preset must be 'Foveated cells, contacts alone', 'Place and object-vec"),
    ("Place cells", "object_state", "thing", "object_state must be '', 'object', 'self' or 'per object', but is 'thi"),
    ("Place cells", "gains", [1.0, 1.0], r"gains must be a number for each of the 1 nodes, but is \[1.0, 1.0\]"),
    ("Place cells", "gains", [np.nan], r"gains must be a finite number from -1e\+30 to 1e\+30, but is nan"),
    ("Place cells", "valence_red", np.nan, r"valence_red must be a finite number from -1e\+30 to 1e\+30, but is nan"),
    ("Place cells", "resolutions", [], "resolutions must be a list of one number or more, but is"),
    ("Place cells", "resolutions", [91], "resolutions must be an integer from 1 to 90, but is 91"),
    ("Place cells", "resolutions", "35", "resolutions must be a list or a tuple, but is '35'"),
    (FORAGER, "resolutions", [9, 5], "resolutions must be integers that grow, with contacts as goals, but is"),
    ("Place cells", "n_creeps", 0, "n_creeps must be an integer from 1 to 20, but is 0"),
    ("Place cells", "n_creeps", None, "n_creeps must be an integer from 1 to 20, but is None"),
    (ARM, "n_creeps", 3, "n_creeps must be None outside WaterWorld, but is 3"),
    ("Place cells", "recursion", -3.0, "recursion must be None for Place cells, .* choose an agent that does, such as"),
    (NETWORK, "recursion", None, "recursion must be a finite number from .*, but is None"),
    (MAZE, "valence_red", 1.0, "valence_red must be 0 for Place cells in the water maze, for which nothing is to be a"),
    (NETWORK, "modality", "border cell", "modality must be '' for Network D, whose nodes keep their own, but is"),
    (ARM, "modality", "place cell", "modality must be '' for Arm of two links, whose nodes keep their own, but is"),
    ("Place cells", "modality", "grid cell", "modality must be '', 'place cell', 'border cell', 'object-"),
    ("Place cells", "seed", -1, "seed must be an integer from 0 to 4294967295, but is -1"),
    ("Place cells", "discount", 1.5, "discount must be a number from 0 to 1, but is 1.5"),
    ("Place cells", "playing", 1, "playing must be True or False, but is 1")])
def test_a_bad_trait_is_refused_and_the_old_one_stays(preset, trait, value, allowed):
    explorer = Explorer(preset=preset)
    before, agent = getattr(explorer, trait), explorer.agent
    with pytest.raises(TraitError, match=allowed):
        setattr(explorer, trait, value)
    assert getattr(explorer, trait) == before and explorer.agent == agent
    with pytest.raises((TraitError, ValueError), match=allowed):
        Explorer(**{"preset": preset, trait: value})


@pytest.mark.parametrize("trait, value, kept", [
    ("resolutions", np.array([3, 5]), [3, 5]), ("resolutions", (np.int64(4),), [4]), ("gains", np.array([2.0]), [2.0]),
    ("valence_red", np.float32(0.5), 0.5), ("discount", np.array(0.5), 0.5), ("n_creeps", np.int8(5), 5),
    ("playing", np.False_, False)])
def test_numbers_of_numpy_are_kept_as_those_of_python(trait, value, kept):
    explorer = Explorer(preset="Place cells")
    setattr(explorer, trait, value)
    assert getattr(explorer, trait) == kept and json.dumps(getattr(explorer, trait)) == json.dumps(kept)


def test_what_is_set_together_with_an_agent_is_kept_and_the_rest_is_the_agent_s_own():
    explorer = Explorer(preset="Place cells", resolutions=[3], exploration=0.1)
    with explorer.hold_trait_notifications():
        explorer.gains = [0.5, 2.0]
        explorer.preset = "Network D"
    assert explorer.agent == network_d(place_gain=0.5, object_gain=2.0)
    with pytest.raises(TraitError, match="gains must be a number for each of the 1 nodes"):
        with explorer.hold_trait_notifications():
            explorer.preset, explorer.gains = "Place cells", [0.5, 1.0]
    assert explorer.agent == network_d(place_gain=0.5, object_gain=2.0)
    explorer.preset = "Place cells"
    assert explorer.agent == place_cells()


@pytest.mark.parametrize("agent, seed, allowed", [
    (replace(multimodal(), desires=[Desire("red", "PC", -1.0), Desire("red", "OVC", -0.5)]), 0,
     "valences of red in condition X must be the same throughout, but are"),
    (TWO_STATES, 0, "states of object vectors in condition X must be "),
    (place_cells([3]), 2**32, "seed of condition X must be an")])
def test_a_condition_that_cannot_be_shown_is_refused(agent, seed, allowed):
    with pytest.raises(ValueError, match=allowed):
        Explorer({"X": simulate(agent, TANK, steps=10, runs=1, seed=seed, progress=False)})
    with pytest.raises(ValueError, match="preset must be 'Foveated cells, contacts alone', 'Place and object-vec"):
        Explorer(preset="X")


PAIR = Condition(place_cells([3, 5]), WaterWorld(n_creeps=2), steps=70, runs=2, seed=4,
                 changes=[(30, place_cells([3]))])


@pytest.mark.parametrize("what, name, agent, world, steps, seed", [
    ("Network D", "Network D", network_d(), WaterWorld(), STEPS, 0),
    (place_cells([3]), "PC N3", place_cells([3]), WaterWorld(), STEPS, 0),
    (pilot(), "far N8, near N4", pilot(), Vessel(), STEPS, 0),
    (PAIR, "PC N3+N5", PAIR.agent, PAIR.world, 70, 4),
    ({"X": PAIR, "Y": place_cells([3])}, "X", PAIR.agent, PAIR.world, 70, 4)])
def test_what_has_no_results_yet_is_shown_too(what, name, agent, world, steps, seed):
    explorer = Explorer(what)
    assert (explorer.preset, explorer.agent, explorer.world, explorer.seed) == (name, agent, world, seed)
    assert explorer._presets[name]["steps"] == steps


def test_a_result_needs_no_name(conditions):
    result = conditions["by N²"]
    explorer = Explorer(result)
    assert (explorer.preset, explorer.agent, explorer.world, explorer.seed) == ("PC N3+N5", result.agent, TANK, 5)
    assert explorer._presets["PC N3+N5"]["totals"] == result.totals.tolist()


def test_other_conditions_take_the_place_of_those_shown_with_all_traits_from_the_beginning(conditions):
    explorer = Explorer(PAIR, control="resolutions", run=3, recursion=None)
    explorer.playing, explorer.gains, explorer.memory = False, [2.0], 1.0
    with pytest.raises(ValueError, match="preset must be "):
        explorer.show(conditions, "N4")
    with pytest.raises(TraitError, match="discount"):
        explorer.show(conditions, discount=2.0)
    assert explorer.preset == "PC N3+N5" and explorer.agent.learning.memory == 1.0 and "N3" not in explorer._presets
    explorer.show(conditions, "by N²", discount=0.5)
    agent = conditions["by N²"].agent
    assert explorer.agent == replace(agent, learning=replace(agent.learning, discount=0.5))
    assert (explorer.world, explorer.seed, explorer.run, explorer.playing) == (TANK, 5, 0, True)
    assert explorer.control == "resolutions" and "PC N3+N5" not in explorer._presets


def test_a_page_chooses_an_agent_together_with_its_settings_or_without_any():
    explorer = Explorer(preset="Place cells")
    own = {name: explorer._presets["Network D"][name] for name in SETTINGS}
    explorer.set_state({"preset": "Network D", **own, "recursion": 0.5})
    assert explorer.agent == network_d(recursion=0.5)
    explorer.set_state({"preset": "Object-vector cells"})
    assert explorer.agent == object_vector_cells()


@pytest.mark.parametrize("what, allowed", [
    ({"X": TANK}, r"condition X must be a Result, a Condition or an Agent, but is WaterWorld\(width"),
    ({3: PAIR}, "name of a condition must be a str, but is 3"),
    ("Network E", "preset must be 'Foveated cells, contacts alone'"), ("", "preset must be 'Foveated cells"),
    ([PAIR], r"conditions must be a Result, a Condition or an Agent, several by name, {name: …}, or the name of a pr"
     "eset, but is a list$"),
    (TANK, "conditions must be a Result, a Condition or an Agent, several by name")])
def test_what_cannot_be_shown_is_refused(what, allowed):
    with pytest.raises(ValueError, match=allowed):
        Explorer(what)


@pytest.mark.parametrize("behind, allowed", [
    ([1], r"behind must be a dict, but is \[1\]"), ({"Y": (1, [1], [1], [1], "")}, "of a curve behind must be 'X'"),
    ({"X": (1, [1], [1], [1])}, r"behind of X must be \(minutes, mean, low, high, what it is\), but is "),
    ({"X": (0, [1], [1], [1], "")}, "minutes behind X must be "), ({"X": (1, [], [], [], "")}, "or more, but has 0, 0"),
    ({"X": (1, [1, 2], [1], [1, 2], "")}, "but has 2, 1 and 2"), ({"X": (1, [[1]], [1], [1], "")}, "as many means as "),
    ({"X": (1, [1], [np.nan], [1], "")}, "behind of X must be "), ({"X": (1, [1], [1], [1], 2)}, "words on X must be")])
def test_curves_that_cannot_be_drawn_behind_are_refused(behind, allowed):
    with pytest.raises(ValueError, match=allowed):
        Explorer({"X": PAIR}, behind=behind)


def test_an_agent_with_other_choices_keeps_them():
    agent = place_cells([4], tiled_fraction=0.7, policy=Policy(exploration=0.1), own_cell="counts")
    explorer = Explorer({"narrow": simulate(agent, TANK, steps=10, runs=1, progress=False)})
    assert explorer.agent == agent and explorer.modality == "place cell"
    explorer.modality = "border cell"
    explorer.modality = "place cell"
    assert explorer.agent == agent


def test_a_condition_in_the_arena_stands_beside_one_in_a_tank(conditions):
    maze, (agent,) = Arena(shape="square", obstacles=[(0.4, 0.4, 0.6, 0.6)]), IN_THE_ARENA.values()
    explorer = Explorer({"maze": simulate(agent, maze, steps=10, runs=1, progress=False)} | conditions)
    assert (explorer.agent, explorer.world, explorer.n_creeps) == (agent, maze, None)
    with pytest.raises(TraitError, match="n_creeps must be None outside WaterWorld, but is 3"):
        explorer.n_creeps = 3
    explorer.preset = "Network D"
    assert explorer.world == TANK


def test_custom_kernels_cannot_be_shown():
    result = simulate(place_cells([3]), TANK, steps=10, runs=1, progress=False)
    agent = place_cells([3], learning=Learning(credit=half))
    with pytest.raises(ValueError, match="condition X must have the kernels that are compiled for the page, with the"):
        Explorer({"X": replace(result, condition=replace(result.condition, agent=agent))})


def test_an_agent_that_learns_at_every_step_takes_no_memory():
    rule = Learning(update_on="step")
    result = simulate(place_cells([3], learning=rule), TANK, steps=10, runs=1, progress=False)
    explorer = Explorer({"X": result})
    assert explorer.agent.learning == rule
    with pytest.raises(TraitError, match="memory must be 0 for an agent that learns at every step, but is 3.0"):
        explorer.memory = 3.0
    explorer.preset = "Place cells"
    explorer.memory = 3.0
    assert explorer.agent.learning.memory == 3.0


def test_the_rest_of_the_package_does_without_the_widget():
    without = ("import sys; sys.modules.update(dict.fromkeys(['anywidget', 'ipywidgets', 'traitlets', 'IPython']"
               ")); import neorl; neorl.simulate; neorl.Explorer")
    refused = subprocess.run([sys.executable, "-c", without], capture_output=True, text=True)
    assert "anywidget must be installed for this, but is not; pip install 'neorl-companion[wasm]'" in refused.stderr
