"""A user's own worlds, with any number of axes and actions, need only a dataclass and two kernels."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import pytest

from neorl import (CARDINAL, Actions, Agent, Condition, Desire, Learning, Node, Place, Policy, Run, Scene, World,
                   brownian, kernel, simulate)
from neorl.custom import Axis, Modality
from neorl.core.modality import LANDMARK_VECTOR_CELL, PLACE_CELL, cartesian
from neorl.core.stream import uniform
from neorl.gym.vector import VectorWorldEnv
from neorl.kernels.annotations import array
from neorl.worlds.world import Dynamics


class DiveState(NamedTuple):
    scene: Scene
    stream: array("uint64", 4)


class DiveRules(NamedTuple):
    stride: float


@kernel
def hide(state: DiveState, rules: DiveRules) -> None:
    for axis in range(3):
        state.scene.position[axis] = 0.5
        state.scene.things[0, axis] = uniform(state.stream)


@kernel
def swim(state: DiveState, rules: DiveRules, action: int):
    """A step along one of three axes; an agent that comes near the pearl gets it, and another one appears elsewhere."""
    scene, axis, sign = state.scene, action // 2, 1.0 - 2.0 * (action % 2)
    scene.position[axis] = min(max(scene.position[axis] + sign * rules.stride, 0.0), 1.0)
    near = True
    for each in range(3):
        near = near and abs(scene.position[each] - scene.things[0, each]) < 0.15
    scene.met[0] = 1 if near else 0
    if near:
        for each in range(3):
            scene.things[0, each] = uniform(state.stream)
    return 1.0 if near else 0.0, False


@dataclass(frozen=True)
class Dive(World):
    """A cube of water with a pearl."""

    stride: float = 0.1

    dynamics = Dynamics(hide, swim)
    kinds = ("pearl",)
    actions = Actions(("east", "west", "south", "north", "down", "up"),
                      ((1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)))
    things, size, fps = 1, 1.0, 10

    @property
    def rules(self):
        return DiveRules(self.stride)


class RoundaboutState(NamedTuple):
    scene: Scene
    stream: array("uint64", 4)


class NoRules(NamedTuple):
    pass


@kernel
def enter(state: RoundaboutState, rules: NoRules) -> None:
    state.scene.position[0] = 0.1


@kernel
def drive(state: RoundaboutState, rules: NoRules, action: int):
    """A step forwards, the only action, on a circular road."""
    position = state.scene.position[0] + 0.2
    state.scene.position[0] = position - np.floor(position)
    return 0.0, False


@dataclass(frozen=True)
class Roundabout(World):
    dynamics = Dynamics(enter, drive)
    actions = Actions(("on",), ((1.0,),))
    rules, things, size, fps = NoRules(), 0, 1.0, 1


DEPTHS = Modality("place cell in a cube", cartesian("position", (0, 1), (0, 1), (0, 1)))
AT_ONCE = Learning(0.3)
SEEKER = Agent((Node("PC", DEPTHS, [5]),), (Desire("pearl", "PC", 1.0),), AT_ONCE, Policy(0.1))
DRIVER = Agent((Node("PC", Modality("ring cell", (Axis("position", closed=True),)), [5]),),
               (Desire(Place(0.5), "PC", 1.0),), AT_ONCE)


def test_a_method_that_runs_would_not_call_is_refused():
    with pytest.raises(TypeError, match="Shallow must not have a method reset, which runs would not call: the reset "):
        type("Shallow", (Dive,), {"reset": lambda world, seed: None})


def test_an_unfinished_world_is_told_what_it_lacks():
    class Unfinished(World):
        dynamics, things, size, rules = Dynamics(enter, drive), 0, 1.0, NoRules()

    with pytest.raises(TypeError, match="^Unfinished must have actions, as a World with dynamics, but has none; see "):
        Unfinished()
    Unfinished.actions, Unfinished.fps = ("N", "S"), 5
    with pytest.raises(ValueError, match="actions of Unfinished must be an Actions, but is "):
        Unfinished()


Streamless = NamedTuple("Streamless", [("scene", Scene)])
Numbered = NamedTuple("Numbered", [("scene", Scene), ("stream", array("uint64", 4)), ("more", float)])


class Unsized(NamedTuple):
    scene: Scene
    stream: array("uint64", 4)
    more: array("float64", "bananas")


def beginning(state_type):
    @kernel
    def begin(state: state_type, rules: NoRules) -> None:
        state.scene.position[0] = 0.1

    return begin


@kernel
def without_types(state, rules):
    return 0.0, False


@pytest.mark.parametrize("change, message", [
    ({"dynamics": (enter, drive)}, "dynamics of Wrong must be a Dynamics, but is "),
    ({"dynamics": Dynamics(print, drive)}, "reset of Wrong must "),
    ({"dynamics": Dynamics(without_types, drive)}, r"reset of Wrong must take \(state, rules\), annotated with"),
    ({"dynamics": Dynamics(enter, without_types)}, r"must take \(state, rules, action\), .*but takes \(state, "),
    ({"dynamics": Dynamics(beginning(Streamless), drive)}, "state of Wrong must have .* a field stream, .*but has sc"),
    ({"dynamics": Dynamics(beginning(Unsized), drive)}, "must be a number or 'things' or 'axes', but is 'bananas'"),
    ({"things": -1}, "things of Wrong must be an integer from 0 to 1048576, but is -1"),
    ({"things": 1.5}, "things of Wrong must be an integer from 0 to 1048576, but is 1.5"),
    ({"fps": 0}, "fps of Wrong must be a finite number from 1e-30 to 1e\\+30, but is 0"),
    ({"dynamics": Dynamics(beginning(Numbered), drive)}, "more in the state of Wrong must be annotated as a neorl."),
    ({"kinds": ("pad", "pad")}, "kinds of Wrong must be different names"), ({"kinds": "pad"}, "kinds of Wrong must be"),
    ({"terminal": 3}, "terminal of Wrong must be a list"), ({"terminal": [1]}, "terminal of Wrong must be None, or 0"),
    ({"size": np.nan}, "size of Wrong must be a finite number from 1e-30 to 1e\\+30, but is nan")])
def test_a_world_whose_parts_are_not_what_they_must_be_is_refused_when_it_is_made(change, message):
    with pytest.raises(ValueError, match=message):
        type("Wrong", (Roundabout,), change)().reset(0)


class AgainState(NamedTuple):
    scene: Scene
    stream: array("uint64", 4)
    begun: array("int64", 1)


AgainRules = NamedTuple("AgainRules", [("what", int)])


@kernel
def begin_again(state: AgainState, rules: AgainRules) -> None:
    state.begun[0] += 1
    wrong, scene = state.begun[0] > 1, state.scene
    scene.position[0] = np.nan if wrong and rules.what == 0 else 0.1
    scene.kinds[0] = 400 if wrong and rules.what == 1 else 0
    scene.met[0] = 99 if wrong and rules.what == 2 else 0


@kernel
def end_at_once(state: AgainState, rules: AgainRules, action: int):
    return 0.0, True


@dataclass(frozen=True)
class Again(World):
    """Every step ends an episode, and the second reset breaks a rule of worlds."""

    what: int

    dynamics, kinds, actions = Dynamics(begin_again, end_at_once), ("pearl",), Actions(("on",), ((1.0,),))
    things, size, fps = 1, 1.0, 1

    @property
    def rules(self):
        return AgainRules(self.what)


@pytest.mark.parametrize("what, field", [(0, "position"), (1, "kinds"), (2, "met")])
def test_a_reset_within_a_run_that_breaks_a_rule_is_named(what, field):
    message = f"begin_again broke a rule of worlds: after it, state.scene.{field} must be "
    for live in (lambda run: run.advance(5), lambda run: run.record(5)):
        run = Run(brownian(), Again(what), seed=0)
        with pytest.raises(ValueError, match=message):
            live(run)
        assert run.step == 1
    envs = VectorWorldEnv(Again(what), 2)
    envs.reset(seed=0)
    with pytest.raises(ValueError, match=message):
        for _ in range(3):
            envs.step(np.zeros(2, int))


def test_rules_that_change_after_a_world_was_made_are_refused_before_kernels_read_them():
    world = type("Growing", (Garden,), {"rules": property(lambda world: world.kept[-1]), "kept": [garden().rules]})
    growing = world.__new__(world)
    state, run = growing.reset(0), Run(brownian(), growing)
    world.kept.append(garden().rules._replace(push=CARDINAL.table[:4]))
    for use in (lambda: growing.reset(0), lambda: growing.step(state, 0), lambda: run.advance(1), lambda: run.record(1),
                lambda: Run(brownian(), growing)):
        with pytest.raises(ValueError, match=r"rules.push must be an array of float64 \(5, 2\)"):
            use()


def test_everything_that_runs_take_from_a_world_determines_its_key():
    def dive(dtype="uint64", **attributes):
        class State(NamedTuple):
            scene: Scene
            stream: array("uint64", 4)
            more: array(dtype, 1)

        @kernel
        def begin(state: State, rules: DiveRules) -> None:
            pass

        return type("Diver", (Dive,), {"dynamics": Dynamics(begin, swim), **attributes})()

    keys = [Condition(SEEKER, world, 1, 1).key for world in (
        dive(), dive("int64"), dive(rules=DiveRules(0.2)), dive(kinds=("pearl", "stone")), dive(things=2), dive(fps=20),
        dive(size=2.0), dive(sizes={"things": 3, "axes": 3}), dive(actions=CARDINAL), dive(dynamics=Dive.dynamics))]
    assert len(set(keys)) == len(keys) and keys[0] == Condition(SEEKER, dive(), 1, 1).key


def test_an_agent_learns_its_way_in_a_world_of_three_axes_and_six_actions():
    learner, control = (simulate(agent, Dive(), steps=60_000, runs=2, progress=False)
                        for agent in (SEEKER, brownian()))
    assert learner.rate(0.5).mean() > 2 * control.rate(0.5).mean() > 0
    np.testing.assert_array_equal(learner.hits.sum(axis=(1, 2)), learner.totals)


def test_every_goal_of_a_cube_is_learned_with_the_action_that_leads_there():
    run = Run(Agent((Node("PC", DEPTHS, [5]),), learning=AT_ONCE, policy=Policy(1.0)), Dive(stride=0.2), seed=0)
    run.advance(100_000)
    middle = NODE_MAP.encode([0.5, 0.5, 0.5])
    for action, push in enumerate(Dive.actions.pushes):
        goal = NODE_MAP.encode(0.5 + 0.4 * np.array(push))
        assert run.q()[middle, :, goal].argmax() == action and run.q().shape == (125, 6, 125)


NODE_MAP = SEEKER.maps[0]


def test_the_output_of_a_node_has_a_component_for_every_axis():
    run = Run(SEEKER, Dive(), seed=0)
    run.advance(20_000)
    output = run.output("PC")
    assert output.q.shape == (6,) and output.q.any()
    np.testing.assert_allclose(output.desire, output.q[::2] - output.q[1::2])


def test_a_world_of_one_axis_and_one_action_is_learned_to_the_end():
    run = Run(DRIVER, Roundabout(), seed=0)
    run.advance(5_000)
    moves = (np.arange(5) - np.arange(5)[:, None] - 1) % 5
    np.testing.assert_allclose(run.q()[:, 0], 0.9 ** moves, rtol=1e-4)
    assert run.world_state.scene.things.shape == (0, 1)


@pytest.mark.parametrize("agent, world, message", [
    (Agent((Node("PC", PLACE_CELL, [3]),)), Roundabout(), "the world of place cells must have 2 axes or more, but ha"),
    (Agent((Node("LVC", LANDMARK_VECTOR_CELL, [3]),)), Dive(),
     r"landmarks must be places of 3 coordinates in this world, but is \(\(0.5, 0.5\),\)"),
    (Agent(SEEKER.nodes, policy=Policy(when_indifferent="no-op")), Dive(),
     "when_indifferent must be 'random' in a world without an idle action, but is 'no-op'")])
def test_an_agent_that_does_not_go_with_a_world_is_refused(agent, world, message):
    with pytest.raises(ValueError, match=message):
        Run(agent, world)


class Stones(NamedTuple):
    place: array("float64", "stones", 2)
    weight: array("float64", "stones")


class GardenRules(NamedTuple):
    stones: Stones
    push: array("float64", 5, 2)
    cost: array("int64", "axes")
    gain: float


@kernel
def open_garden(state: RoundaboutState, rules: GardenRules) -> None:
    state.scene.position[0] = rules.stones.place[0, 0]


@dataclass(frozen=True)
class Garden(World):
    rules: GardenRules

    dynamics, actions = Dynamics(open_garden, drive), CARDINAL
    things, size, fps = 0, 1.0, 1


def garden(place=(3, 2), weight=(3,), push=CARDINAL.table, cost=np.zeros(2, int), gain=1.0):
    return Garden(GardenRules(Stones(np.zeros(place), np.zeros(weight)), push, cost, gain))


@pytest.mark.parametrize("change, message", [
    ({"push": CARDINAL.table[:4]}, r"rules.push must be an array of float64 \(5, 2\), as it is annotated, .* but is "
                                   r"float64 \(4, 2\): change the array, or its annotation"),
    ({"push": CARDINAL.table.astype(np.float32)}, r"rules.push must be an array of float64 .* but is float32 \(5, 2\)"),
    ({"push": CARDINAL.pushes}, r"rules.push must be an array of .* but is \(\(0.0, -1.0\), "),
    ({"cost": np.zeros(3, int)}, r"rules.cost must be an array of int64 \(2,\), .* but is int64 \(3,\)"),
    ({"cost": np.zeros((2, 1), int)}, r"rules.cost must be an array of int64 \(2,\), .* but is int64 \(2, 1\)"),
    ({"gain": "x"}, "rules.gain must be a number of at most 64 bits"), ({"gain": 10**25}, "rules.gain must be a num"),
    ({"weight": 2}, r"rules.stones.weight must be an array of float64 \(3,\), .* but is float64 \(2,\)")])
def test_rules_that_are_not_as_annotated_are_refused_when_a_world_is_made(change, message):
    with pytest.raises(ValueError, match=message):
        garden(**change)


def test_a_dimension_of_rules_that_the_world_has_no_size_for_may_have_any_length():
    assert garden().rules.stones.weight.shape == (3,) and garden((7, 2), 7).rules.stones.weight.shape == (7,)
