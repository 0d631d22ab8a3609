"""Bad arguments found by fuzzing are refused by messages that name the argument, what it must be and what it is."""

import numpy as np
import pytest
from fuzzing import Unequal, Unprintable

from neorl import (Actions, Agent, Desire, Learner, Learning, Node, NresMap, Scene, WaterWorld, kernel,
                   object_vector_cells, place_cells)
from neorl.core.horde import learn
from neorl.custom import Axis, Modality, kernel_maker, softmax
from neorl import statistics
from neorl.common import checks
from neorl.agents.embodiment import embodied
from neorl.core.building import n_bytes
from neorl.core.coordinates import sense
from neorl.core.modality import PLACE_CELL, cartesian, polar

WORLD = WaterWorld(n_creeps=2)
MASKED = np.ma.array([0.5, 0.6], mask=[True, False])


def learner():
    return Learner(place_cells([3]), 1, ("green", "red"))


def scene(**fields):
    return Scene((0.5, 0.5), None, [(0.1, 0.2)], ("green",), (0,))._replace(**fields)


@pytest.mark.parametrize("call, message", [
    (lambda: checks.real("x", 10**400), r"x must be a finite number from -1e\+30 to 1e\+30, but is 100000000000000000"),
    (lambda: checks.integer("x", 10**5000, 0, 9), "x must be an integer from 0 to 9, but is a value of type int"),
    (lambda: checks.integer("x", Unprintable(), 0), "x must be an integer of at least 0, but is <Unprintable instanc"),
    (lambda: checks.one_of("x", Unequal("c"), ("a", "b")), "x must be 'a' or 'b', but is 'c'"),
    (lambda: checks.several("x", range(2**80)), r"x must be 1048576 values or fewer, but is range\(0, 120892581961462"),
    (lambda: checks.several("x", np.broadcast_to(0.0, (10**12,))), "x must be 1048576 values or fewer, but is array"),
    (lambda: checks.doubles("x", [[1], [1, 2]]), "x must be .*, but is .*"),
    (lambda: checks.doubles("x", np.ones(2, complex)), r"x must be numbers, in lists of equal lengths, but is array\("),
    (lambda: checks.doubles("x", [1e308]), r"x must be finite numbers from -1e\+30 to 1e\+30, but is array\(\[1.e\+30"),
    (lambda: checks.real("x", MASKED[0]), "x must be a finite number from .*, but is masked"),
    (lambda: checks.doubles("x", MASKED), r"x must be free of masked values, but is masked_array\(data=\[--, 0.6\],"),
    (lambda: checks.path("x", "a\0b"), r"x must be the path of a file, but is 'a\\x00b'"),
    (lambda: checks.instance("x", None, Agent), "x must be an Agent, but is None"),
    (lambda: Node("", PLACE_CELL, [3]), "name must be one character or more, but is ''"),
    (lambda: Agent([Node("PC", PLACE_CELL, [3])], [Desire("green", "PC", 1.0)] * 4_097),
     "desires must be 0 to 4096, each a Desire, but are 4097"),
    (lambda: Axis("position", low=0, high=5e-324), "low must be below high, 5e-324, but is 0.0"),
    (lambda: cartesian("position", (0, 1, 2)), r"ranges must be pairs \(low, high\), but is \(\(0, 1, 2\),\)"),
    (lambda: Modality("x", polar("landmarks", 1), [(0.5,)]), "landmarks must be places of 2 coordinates or more, but"),
    (lambda: sense(PLACE_CELL, Scene((0.5,)), 1), "the world of place cells must have 2 axes or more, but has 1"),
    (lambda: Actions(("a",), ((1,) * 9,)), r"pushes must be of 8 axes and 1024 actions or fewer, but is \(\(1, 1, 1, "),
    (lambda: learn(np.float32([[[0, 0]], [[0, np.nan]]]), 0, 1, [1]),
     r"q must be finite numbers from -1e\+30 to 1e\+30, but is arra"),
    (lambda: kernel(3), "function must be .*, but is 3"),
    (lambda: kernel_maker(lambda: 3)(), "what <lambda>.<locals>.<lambda> returns must be a function that is decorate"),
    (lambda: learner().begin(None), "scene must be a neorl.Scene, or have its fields, but is None"),
    (lambda: learner().begin(scene(position=range(10**12))), r"scene.position must be numbers of the shape \(2,\), bu"),
    (lambda: learner().begin(scene(met=np.array([2**70, 0], object))), r"scene.met must be numbers of the shape \(1,"),
    (lambda: WORLD.step(WORLD.reset(0)._replace(direction=np.full((2, 2), 2.0)), 0),
     "state.direction must be vectors of length 1"),
    (lambda: statistics.estimate(np.mean, []), r"samples must be a number for each run, .*, but is \[\]"),
    (lambda: statistics.estimate(np.mean, [1, np.nan]), r"samples must be finite numbers from -1e\+30 to 1e\+30, but "),
    (lambda: statistics.tolerance_band(np.zeros((0, 3))), "curves must have the shape .*, but has .0, 3.")])
def test_what_is_refused(call, message):
    with pytest.raises(ValueError, match=f"(?s){message}"):
        call()


def test_other_forms_of_numbers_are_plain_numbers():
    assert checks.doubles("x", np.ma.array([0.5, 0.6])).tolist() == [0.5, 0.6]
    assert str(checks.real("x", -0.0)) == "0.0"  # without a sign, so that equal values have equal keys
    assert checks.real("x", np.array(0.5)) == checks.real("x", np.float32(0.5)) == 0.5
    assert checks.integer("x", np.array(5), 0) == checks.integer("x", np.uint8(5), 0) == 5
    assert checks.flag("x", np.array(True)) is True
    assert softmax(np.array(2.0)) is softmax(temperature=2.0) is softmax(np.float64(2))


def test_arrays_that_cannot_be_written_to_and_those_in_another_order_are_points_like_others():
    points = np.array([[0.1, 0.9], [0.7, 0.2]])
    cells = NresMap(5).encode(points).tolist()
    points.flags.writeable = False
    for same in (points, np.asfortranarray(points), np.repeat(points, 2, 0)[::2], points.astype(">f8")):
        assert NresMap(5).encode(same).tolist() == cells


def test_what_is_remembered_counts_as_memory():
    none, some = (embodied(place_cells([3], learning=Learning(memory=memory)), WORLD)[0] for memory in (0, 2))
    assert n_bytes(some) - n_bytes(none) == 9 * (20 + 16 * 4)
    short, long = (embodied(object_vector_cells([3], object_state="self", learning=Learning(memory=memory)),
                            WORLD)[0] for memory in (0, 1e9))
    assert n_bytes(long) - n_bytes(short) == (500 - 1) * (3 * 8 + 4 * 4)
