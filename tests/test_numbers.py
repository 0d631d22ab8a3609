"""NumPy scalars and zero-dimensional arrays are accepted as numbers everywhere, and give equal values and keys."""

from dataclasses import fields, is_dataclass, replace

import numpy as np
import pytest

import neorl
from neorl import (Actions, Agent, Condition, Contacts, Desire, Learning, Node, NresMap, Place, Policy, Result,
                   WaterWorld)
from neorl.custom import Axis
from neorl.worlds import Arena, Arm, Vessel, WaterMaze
from neorl.core.modality import LANDMARK_VECTOR_CELL, PLACE_CELL
from neorl.kernels.identity import identity

AXIS = Axis("position", along=1, low=-1.0, high=2.0, intervals=3, name="y")
NODE = Node("PC", PLACE_CELL, (3, 7), gain=0.5)
VALUES = [  # instances of every public dataclass, with a number in every field that can hold one
    Learning(memory=2.0), Policy(exploration=0.25), NODE, AXIS,
    Contacts(0.5, 0.25, 4.0, 0.5, 0.25, 0.5, "avoidance", 0.25, 0.25, 2),
    Axis("position", boundaries=(0.0, 0.25, 1.0)), LANDMARK_VECTOR_CELL, Place(0.5, 0.25), NresMap(4, PLACE_CELL),
    Desire("green", "PC", valence=-1.0, scale=2.0), Desire((0.5, 0.25), "PC", 1.0), Agent((NODE,), own_cell="silent"),
    Actions(("N", "S"), ((0.0, 1.0), (1.0, 0.0)), "no-op"), WaterWorld(n_creeps=4, win_reward=5.0),
    Arena(pay=(2.0,), obstacles=((0.25, 0.25, 0.5, 0.5),), start=(0.75, 0.75)),
    Arm(lengths=(0.5, 0.25), targets=2, radius=0.125), Vessel(traffic=2, current=(0.0625, 0.0), speed=0.125),
    WaterMaze(places=((0.5, 0.25),), trials_a_day=2, radius=0.125),
    Condition(neorl.place_cells([3]), WaterWorld(), 100, 2, 7, ((50, neorl.place_cells([2])),))]
NUMBERS = {int: [np.int64, np.uint16, np.array], float: [np.float64, np.float32, np.float16, np.array, int, np.int64]}
OF_BOUNDARIES = ("low", "high", "intervals")  # which determine these
CASES = [(value, each.name) for value in VALUES for each in fields(value)]


def with_numbers(value, kind, make):
    """A value or tuple of values, with numbers of one type made NumPy's by `make`, and strings made NumPy's too."""
    if isinstance(value, tuple):
        return tuple(with_numbers(each, kind, make) for each in value)
    if type(value) is str:
        return np.str_(value)
    return make(value) if type(value) is kind else value


def test_every_public_dataclass_is_here():
    public = {each for space in (neorl, neorl.custom, neorl.worlds) for each in vars(space).values()
              if isinstance(each, type) and is_dataclass(each)}
    assert {type(value) for value in VALUES} == public - {Result}
    assert {name for value, name in CASES if type(value) is Learning} == {each.name for each in fields(Learning)}


@pytest.mark.parametrize("value, name", CASES, ids=[f"{type(value).__name__}.{name}" for value, name in CASES])
def test_a_number_of_another_type_in_any_field_makes_the_same_value(value, name):
    given = getattr(value, name)
    for kind, makes in NUMBERS.items():
        for make in makes:
            if not has_inexact(given, kind, make):
                changed = with_numbers(given, kind, make)
                other = Place(*changed) if isinstance(value, Place) else replace(value, **{name: changed})
                assert (other, repr(other), identity(other)) == (value, repr(value), identity(value))


def has_inexact(given, kind, make):
    return any(has_inexact(each, kind, make) for each in given) if isinstance(given, tuple) else (
        type(given) is kind and float(make(given)) != given)


@pytest.mark.parametrize("value, name", [(value, name) for value, name in CASES
                                         if type(getattr(value, name)) in (int, float)
                                         and not (getattr(value, "boundaries", ()) and name in OF_BOUNDARIES)])
def test_true_is_no_number(value, name):
    for true in (True, np.True_, np.array(True)):
        with pytest.raises(ValueError, match=f"^{name} must be .*, but is "):
            replace(value, **{name: true})


@pytest.mark.parametrize("value, name", [(value, name) for value, name in CASES if type(getattr(value, name)) is bool])
def test_numpys_booleans_are_booleans_and_numbers_are_not(value, name):
    given = getattr(value, name)
    assert identity(replace(value, **{name: np.bool(given)})) == identity(value)
    for number in (int(given), np.int64(given), float(given)):
        with pytest.raises(ValueError, match=f"^{name} must be .*, but is "):
            replace(value, **{name: number})


def test_single_precision_is_another_number():
    assert Policy(np.float32(0.1)) == Policy(float(np.float32(0.1))) != Policy(0.1)


def test_a_kernel_maker_tells_an_integer_from_the_same_number():
    """A kernel may use an integer as the length of a loop."""
    @neorl.custom.kernel_maker
    def exact(number):
        def choose(value, stream):
            return number

        return neorl.kernel(choose)

    assert [exact(each).origin[1] for each in (1, 1.0, np.int32(1))] == [(1,), (1.0,), (1,)]
    assert exact(1) is exact(np.int32(1)) is not exact(1.0)
    assert type(exact(1.0).origin[1][0]) is float
