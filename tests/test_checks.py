"""Bad arguments found by fuzzing are refused by messages that name the argument, its value and what is allowed."""

from fractions import Fraction

import numba
import numpy as np
import pytest
from fuzzing import Unequal, Unprintable

import neorl
from neorl import (CARDINAL, Actions, Agent, Arena, Axis, Desire, Learner, Learning, Modality, Node, NresMap, Place,
                   Policy, Run, Scene, WaterWorld, checks, drawing, kernel, kernel_maker, learn, object_vector_cells,
                   place_cells, softmax, superpose)
from neorl.agents.compile import n_bytes
from neorl.core.horde import as_vectors
from neorl.core.modality import PLACE_CELL, cartesian, polar
from neorl.evidence import curves, statistics

WORLD = WaterWorld(n_creeps=2)
MASKED = np.ma.array([0.5, 0.6], mask=[True, False])


def learner():
    return Learner(place_cells([3]), 1, ("green", "red"))


def scene(**fields):
    return Scene((0.5, 0.5), None, [(0.1, 0.2)], ("green",), (0,))._replace(**fields)


def values_with(number):
    q = np.zeros((4, 2, 4), np.float32)
    q[1, 0, 2] = number
    return q


def state_with(**fields):
    return WORLD.reset(0)._replace(**fields)


@pytest.mark.parametrize("call, message", [
    (lambda: checks.real("x", 10**400), "x is 1000.*, allowed are finite numbers"),
    (lambda: checks.real("x", Fraction(10**400, 3)), "x is .*, allowed are finite numbers"),
    (lambda: checks.integer("x", 10**5000, 0, 9), "x is a value of type int, allowed are integers from 0 to 9"),
    (lambda: checks.integer("x", Unprintable(), 0), "x is <Unprintable instance at .*>, allowed are integers ≥ 0"),
    (lambda: checks.one_of("x", np.array(["a"]), ("a", "b")), "x is array.*, allowed are 'a', 'b'"),
    (lambda: checks.one_of("x", Unequal("c"), ("a", "b")), "x is 'c', allowed are 'a', 'b'"),
    (lambda: checks.several("x", range(2**80)), "x is range.*, allowed are 1048576 values or fewer"),
    (lambda: checks.several("x", np.broadcast_to(0.0, (10**12,))), "allowed are 1048576 values or fewer"),
    (lambda: checks.doubles("x", ["1.5"]), "x is .*, allowed are numbers, in lists of equal lengths"),
    (lambda: checks.doubles("x", [[1], [1, 2]]), "x is .*, allowed are numbers, in lists of equal lengths"),
    (lambda: checks.doubles("x", np.ones(2, complex)), "x is .*, allowed are numbers"),
    (lambda: checks.doubles("x", [1e308]), "x is .*, allowed are finite numbers from -1e[+]30 to 1e[+]30"),
    (lambda: checks.doubles("x", MASKED), "x must have no masked values, but is masked_array.*; fill them in, or"),
    (lambda: Actions(("a",), (MASKED,)), "pushes must have no masked values"),
    (lambda: NresMap(3).encode(MASKED), "points must have no masked values"),
    (lambda: learner().begin(scene(position=MASKED)), "scene.position must have no masked values"),
    (lambda: drawing.draw_curves(MASKED, {"a": [[1, 2]]}), "xs must have no masked values"),
    (lambda: checks.path("x", None), "x is None, allowed are paths of files"),
    (lambda: checks.path("x", "a\0b"), "x is .*, allowed are paths of files"),
    (lambda: checks.instance("x", None, Agent), "x is None, allowed is an Agent"),
    (lambda: WaterWorld(win_reward=1e308), "win_reward is 1e[+]308, allowed are finite numbers from -1e[+]30"),
    (lambda: WaterWorld(fps=2**80), "fps is 1208925819614629174706176, allowed are integers from 1 to 2147483648"),
    (lambda: Learner(place_cells([3]), 1, ("green", "red"), fps=2**101), "fps is .*, allowed are finite numbers"),
    (lambda: Arena(pay=[1e308]), "pay is 1e[+]308, allowed are finite numbers"),
    (lambda: Learning(memory=1e308), "memory is 1e[+]308, allowed are finite numbers from 0 to 1e[+]30"),
    (lambda: Desire("green", "PC", 1e308), "valence is 1e[+]308, allowed are finite numbers"),
    (lambda: Place.of_fields(None), "coordinates is None, allowed are lists and tuples"),
    (lambda: place_cells([3]).comes_from_node(None), "desire is None, allowed is a Desire"),
    (lambda: Agent([Node("PC", PLACE_CELL, [3])], [Desire("green", "PC", 1.0)] * 4_097),
     "desires are 4097, allowed are 0 to 4096"),
    (lambda: Axis("position", along=2**80), "along is .*, allowed are integers from 0 to 7"),
    (lambda: Axis("position", intervals=2**80), "intervals is .*, allowed are integers from 1 to 2147483647"),
    (lambda: Axis("position", low=-1e308), "low is -1e[+]308, allowed are finite numbers"),
    (lambda: Axis("position", low=0, high=5e-324), "low is 0.0, allowed are numbers below high"),
    (lambda: cartesian("position", None), "ranges is None, allowed are lists and tuples"),
    (lambda: cartesian("position", (0, 1, 2)), "ranges is .*, allowed are .low, high. each"),
    (lambda: Modality("x", polar("landmarks", 1), [(0.5,)]), "landmarks is .*, allowed are places of 2 coordinates"),
    (lambda: PLACE_CELL.coordinates(None, 1), "scene is None, allowed is a Scene"),
    (lambda: PLACE_CELL.coordinates(Scene((0.5,)), 1), "place cells need a world of 2 axes"),
    (lambda: PLACE_CELL.coordinates(Scene((0.5, 0.5)), 0), "size is 0, allowed are"),
    (lambda: NresMap(2**80), "resolution is .*, allowed are integers from 1 to 2147483647"),
    (lambda: NresMap(3).encode("ab"), "points is 'ab', allowed are numbers"),
    (lambda: Actions(("a",), ((1,),), idle=["x"]), r"idle is \['x'\], allowed is a str"),
    (lambda: Actions(("a",), ((1,) * 9,)), "pushes is .*, allowed are 8 axes and 1024 actions or fewer"),
    (lambda: learn(values_with(np.nan), 0, 1, (1, 1)), "q is .*nan.*, allowed are finite numbers"),
    (lambda: superpose(values_with(np.inf), 1, [2], [1]), "q is .*inf.*, allowed are finite numbers"),
    (lambda: superpose(values_with(0), 1, [2], [1e308]), "valences is 1e[+]308, allowed are finite numbers"),
    (lambda: as_vectors(None), "values is None, allowed are numbers"),
    (lambda: as_vectors([1, 2, 3, 4], None), "actions is None, allowed is an Actions"),
    (lambda: kernel(3), "function is 3, allowed are Python functions"),
    (lambda: kernel_maker(3), "function is 3, allowed are Python functions"),
    (lambda: kernel_maker(lambda: 3)(), "what .* returns is 3, allowed is a function that is decorated"),
    (lambda: softmax([1]), r"temperature is \[1\], allowed are finite numbers from 1e-30"),
    (lambda: learner().begin(None), "scene is None, allowed is a neorl.Scene"),
    (lambda: learner().begin(scene(position=[[1], [1, 2]])), "scene.position is .*, allowed are numbers of the shape"),
    (lambda: learner().begin(scene(position=range(10**12))), "scene.position is range.*, allowed are numbers"),
    (lambda: learner().begin(scene(position=(1e308, 0))), "scene is .*, allowed are finite numbers from -1e[+]30"),
    (lambda: learner().begin(scene(things=5)), "scene.things is 5, allowed are numbers of the shape"),
    (lambda: learner().begin(scene(kinds=None)), "scene.kinds is None, allowed are 1 of"),
    (lambda: learner().begin(scene(met=[np.nan])), "scene.met is .*nan.*, allowed are finite numbers"),
    (lambda: learner().begin(scene(met=np.array(5))), "scene.met is array.5., allowed are numbers of the shape"),
    (lambda: learner().begin(scene(met=np.array([2**70, 0], object))), "scene.met is .*, allowed are numbers"),
    (lambda: WORLD.step(state_with(direction=np.full((2, 2), 2.0)), 0), "state.direction is .*, allowed are vectors"),
    (lambda: WORLD.step(state_with(jitter=np.full(2, 1e300)), 0), "state.jitter is .*, allowed are"),
    (lambda: WORLD.step(state_with(speed=np.full(2, 1e308)), 0), "state.speed is .*, allowed are finite numbers"),
    (lambda: statistics.estimate(np.mean, []), r"samples is \[\], allowed is a number for each run"),
    (lambda: statistics.estimate(np.mean, [1, np.nan]), "samples is .*nan.*, allowed are finite numbers"),
    (lambda: statistics.estimate(np.mean, [1, 2], rng=-1), "rng is -1, allowed are integers ≥ 0"),
    (lambda: statistics.mean_band([1, 2]), "curves has the shape .2,., allowed are .runs, points."),
    (lambda: statistics.tolerance_band(np.zeros((0, 3))), "curves has the shape .0, 3., allowed are"),
    (lambda: statistics.tolerated_share(5, 0), "beyond is 0, allowed are integers"),
    (lambda: statistics.points(None), "result is None, allowed is a Result"),
    (lambda: statistics.minutes_sooner([], [], 1.0), "quick has 0 results, allowed are one or more"),
    (lambda: curves.binned_rate(None, 3), "result is None, allowed is a Result"),
    (lambda: curves.low_passed(None), "rates is None, allowed are numbers"),
])
def test_what_is_refused(call, message):
    with pytest.raises(ValueError, match=f"(?s){message}"):
        call()


def test_a_masked_array_without_a_masked_value_is_an_array():
    assert checks.doubles("x", np.ma.array([0.5, 0.6])).tolist() == [0.5, 0.6]


def test_numbers_of_numpy_and_arrays_of_no_axis_are_numbers():
    assert checks.real("x", np.array(0.5)) == checks.real("x", np.float32(0.5)) == 0.5
    assert checks.integer("x", np.array(5), 0) == checks.integer("x", np.uint8(5), 0) == 5
    assert checks.flag("x", np.array(True)) is True
    assert softmax(np.array(2.0)) is softmax(temperature=2.0) is softmax(np.float64(2))


def test_zero_has_no_sign_so_that_equal_values_have_equal_keys():
    assert str(checks.real("x", -0.0)) == "0.0"


def test_arrays_that_cannot_be_written_to_and_those_in_another_order_are_points_like_others():
    points = np.array([[0.1, 0.9], [0.7, 0.2]])
    cells = NresMap(5).encode(points).tolist()
    points.flags.writeable = False
    for same in (points, np.asfortranarray(points), np.repeat(points, 2, 0)[::2], points.astype(">f8")):
        assert NresMap(5).encode(same).tolist() == cells


def test_a_policy_that_returns_no_action_takes_the_nearest():
    @kernel
    def far_off(value, stream):
        return 10**9

    run = Run(place_cells([3], policy=Policy(choose=far_off)), WORLD)
    run.advance(10)
    assert run.state.last_event[0] == len(CARDINAL.names)


@pytest.mark.skipif(numba.config.DISABLE_JIT, reason="the compiler is off")
def test_a_kernel_that_cannot_be_compiled_is_named():
    @kernel
    def of_nothing():
        return 0

    with pytest.raises(TypeError, match="rollout.* cannot be compiled, with all kernels that it calls"):
        Run(place_cells([3], policy=Policy(choose=of_nothing)), WORLD).advance(1)


def test_what_is_remembered_counts_as_memory():
    none, some = (place_cells([3], learning=Learning(memory=memory)) for memory in (0, 2))
    assert n_bytes(some, WORLD) - n_bytes(none, WORLD) == 9 * (20 + 16 * 4)
    short, long = (object_vector_cells([3], object_state="self", learning=Learning(memory=memory))
                   for memory in (0, 1e9))
    assert n_bytes(long, WORLD) - n_bytes(short, WORLD) == (500 - 1) * (2 * 8 + 4 * 4)
    assert neorl.agents.memory.n_bytes is n_bytes
