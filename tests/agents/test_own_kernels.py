"""A user's own kernels: those that reimplement the package's give the same bits, with and without the compiler."""

import json
import sys
from dataclasses import replace

import numpy as np
import pytest
from golden import plain_rule
from same import digest
from subprograms import printed

from neorl import (CALIBRATED, Agent, Desire, Learner, Node, Place, Policy, Run, Scene, WaterWorld, kernel, multimodal,
                   place_cells)
from neorl.custom import Axis, Modality
from neorl.core.coordinates import sense
from neorl.core.stream import randint

WORLD = WaterWorld(n_creeps=4, win_reward=5.0)
PLAIN = {"learning": plain_rule(), "policy": Policy(0.1)}


@kernel
def happened(count, steps, last, activity):
    return 1.0 if count > 0 else 0.0


@kernel
def share(count, steps, last, activity):
    return np.float32(count) / np.float32(steps)


@kernel
def last_of_all(count, steps, last, activity):
    return 1.0 if last else -3.0  # a negative credit counts as 0


@kernel
def activity_above(count, steps, last, activity):
    return activity if activity >= 0.01 else 0.0


@kernel
def x_share(scene, point):
    return scene.position[0] / 250.0


@kernel
def highest(value, stream):
    best, ties = value[0], 0
    for action in range(value.shape[0]):
        best = max(best, value[action])
    for action in range(value.shape[0]):
        ties += value[action] == best
    skip = randint(stream, ties) if ties > 1 else 0
    for action in range(value.shape[0]):
        if value[action] == best:
            if skip == 0:
                return action
            skip -= 1
    return 0


def crediting(credit, **changes):
    return multimodal([4], learning=plain_rule(credit=credit, absent_decay=0.1, **changes))


def perceiving(of):
    """An agent that desires points in its own spaces, whose second axis is its position from west to east."""
    place = Modality("place", (Axis("position", along=1), Axis(of)))
    beside = Modality("beside", (Axis("objects", along=1, low=-1), Axis(of)))
    return Agent((Node("PC", place, [4, 7]), Node("B", beside, [3])),
                 (Desire((0.2, 0.9), "PC", 1.0), Desire((0.0, 0.3), "B", 0.5)), **PLAIN)


PAIRS = {  # with the user's own kernel, and with the package's that it reimplements
    "credit happened": (crediting(happened), crediting("happened")),
    "credit share": (crediting(share), crediting("share")),
    "credit last": (crediting(last_of_all), crediting("last")),
    "credit activity": (crediting(activity_above, activity=0.1), crediting("activity", activity=0.1)),
    "credit share, calibrated": (multimodal([5], learning=replace(CALIBRATED, credit=share)), multimodal([5])),
    "position": (perceiving(x_share), perceiving("position")),
    "greedy": (multimodal([3, 6], learning=plain_rule(), policy=Policy(0.05, choose=highest)),
               multimodal([3, 6], learning=plain_rule(), policy=Policy(0.05))),
}


def born(agent):
    return Run(agent, WORLD, seed=4)


@pytest.fixture(scope="module")
def interpreted():
    """The output of this file, run as a program with the compiler switched off, so that no kernel needs compiling."""
    return printed(__file__, "250")


@pytest.mark.parametrize("name", PAIRS)
def test_a_users_kernel_that_does_what_the_packages_does_gives_the_same_bits(name, interpreted):
    own, packaged = PAIRS[name]
    assert own != packaged and interpreted[name][0] == interpreted[name][1] == digest(born(packaged), 250)


def all_at_once(of, credit, **choose):
    agent = perceiving(of)
    return replace(agent, learning=plain_rule(credit=credit), policy=Policy(0.05, **choose))


def test_a_users_kernels_of_every_sort_give_the_same_bits_when_compiled():
    own, packaged = all_at_once(x_share, happened, choose=highest), all_at_once("position", "happened")
    assert digest(born(own), 4_000) == digest(born(packaged), 4_000)


@kernel
def in_the_east(scene, point):
    return 1.0 if scene.position[0] > 125.0 else 0.0


def check_that_kernels_of_one_modality_are_distinguished_from_those_of_another():
    west = Modality("X", (Axis(x_share, low=0, high=1), Axis(in_the_east, intervals=2)))
    east = Modality("X", (Axis(in_the_east, intervals=2), Axis(x_share, low=0, high=1)))
    run = Run(Agent((Node("one", west, [5]), Node("other", east, [5])), policy=Policy(1.0)), WORLD, seed=0)
    for _ in range(100):
        run.advance(7)
        one, other = (nres_map.encode(sense(nres_map.modality, run.world_state.scene, WORLD.size))[0]
                      for nres_map in run.agent.maps)
        assert run.memory.tracks.cell.tolist() == [one, other]
        assert (one % 5, one // 5) == (other // 2, other % 2)


def test_a_policy_must_return_a_whole_number():
    @kernel
    def halfway(value, stream):
        return 0.5

    with pytest.raises(TypeError, match="the kernel .*halfway .* must return the number of an action, an int"):
        Run(replace(place_cells([3]), policy=Policy(choose=halfway)), WORLD).advance(1)


def test_a_credit_of_another_number_of_arguments_is_named():
    @kernel
    def of_three(count, steps, last):
        return 1.0

    with pytest.raises(TypeError, match="the kernel .*of_three .* but Signature mismatch: 4 argument types given"):
        Run(replace(place_cells([3]), learning=plain_rule(credit=of_three)), WORLD)


def test_a_users_kernels_are_called_and_distinguished(interpreted):
    assert interpreted["called and distinguished"]


@pytest.mark.parametrize("source", ["green", Place(0.2, 0.9), "PC", "own"])
def test_a_desire_that_axes_of_ones_own_cannot_locate_is_refused(source):
    nodes = Node("own", Modality("own cell", (Axis(x_share), Axis(in_the_east))), [4]), place_cells([3]).nodes[0]
    with pytest.raises(ValueError, match=r"must be for a point .* of own cells: their only axes are kernels of your own"
                                         r".* as its source, \(x_share, in_the_east\), or"):
        Agent(nodes, (Desire("green", "PC", 1.0), Desire(source, "own", 1.0)))
    assert Agent(nodes, (Desire((0.2, 1.0), "own", 1.0),)) and perceiving(x_share)


@pytest.mark.parametrize("source", [Place(0.2, 0.9), "PC", "own"])
def test_only_things_are_located_by_axes_of_ones_own_beside_those_of_things(source):
    nodes = Node("own", Modality("own cell", (Axis("objects"), Axis(in_the_east))), [4]), place_cells([3]).nodes[0]
    with pytest.raises(ValueError, match="must be a kind of thing, or a point in the space of own cells, but is .*; k"):
        Agent(nodes, (Desire("green", "PC", 1.0), Desire(source, "own", 1.0)))
    assert Agent(nodes, (Desire("green", "own", 1.0), Desire((0.2, 1.0), "own", 1.0)))


@kernel
def undefined(count, steps, last, activity):
    return np.nan if count > 1 else 1.0


@kernel
def undefined_in_the_east(scene, point):
    return np.nan if scene.position[0] > 125.0 else scene.position[0] / 250.0


SIDE = Agent((Node("side", Modality("side", (Axis(in_the_east), Axis(undefined_in_the_east))), [3]),),
             policy=Policy(1.0))
CALLS = {"credit": (crediting(undefined), "test_own_kernels.undefined of the credit"),
         "axis": (SIDE, "test_own_kernels.undefined_in_the_east of an axis")}


def errors_after_nan():
    """The errors after kernels that return NaN, from a run and from a learner: {kernel: [text, text]}."""
    found = {}
    for name, (agent, _) in CALLS.items():
        run, learner = Run(agent, WORLD), Learner(agent, 1, ("green", "red"), size=250.0)
        found[name] = [error_of(lambda: run.advance(2_000)), error_of(lambda: walk_east(learner))]
    found["coordinates"] = error_of(lambda: sense(SIDE.nodes[0].modality, Scene((200.0, 0.0)), 250.0))
    return found


def walk_east(learner):
    scenes = [Scene((east, 9.0), things=[(50.0, 50.0)], kinds=["green"]) for east in range(0, 250, 5)]
    learner.begin(scenes[0])
    for scene in scenes:
        learner.act()
        learner.observe(scene)


def error_of(call):
    try:
        return f"none, but {call()}"
    except ValueError as error:
        return str(error)


@pytest.mark.parametrize("name", CALLS)
def test_a_kernel_that_returns_nan_is_named_after_the_slice(name, interpreted):
    said = f"the kernel {CALLS[name][1]} must return numbers, but has returned NaN: return a number in every case"
    assert all(said.replace("test_own_kernels", "__main__") in text for text in interpreted["after NaN"][name])
    assert name == "credit" or said.replace("test_own_kernels", "__main__") in interpreted["after NaN"]["coordinates"]


if __name__ == "__main__":
    check_that_kernels_of_one_modality_are_distinguished_from_those_of_another()
    print(json.dumps({"called and distinguished": True, "after NaN": errors_after_nan(), **{
        name: [digest(born(each), int(sys.argv[1])) for each in pair] for name, pair in PAIRS.items()}}))
