"""Agents as data: what is refused, and what an agent compiles to."""

import numpy as np
import pytest

from neorl import Agent, Learning, NresMap, Policy, brownian, place_cells
from neorl.agent import compiled


@pytest.mark.parametrize("make, message", [
    (lambda: Agent(()), r"maps is \(\), allowed are one NresMap or more"),
    (lambda: Agent((5,)), "maps is"),
    (lambda: place_cells([]), "maps is"),
    (lambda: place_cells(5), "resolutions is 5, allowed are lists and tuples"),
    (lambda: Agent(NresMap(5)), "maps is NresMap"),
    (lambda: place_cells([0]), "resolution is 0"),
    (lambda: place_cells([3], weighting="heavy"), "weighting is 'heavy', allowed are 'equal', 'resolution', 'cells'"),
    (lambda: place_cells([3], valence_red=np.nan), "valence_red is nan"),
    (lambda: place_cells([3], own_cell="loud"), "own_cell is 'loud'"),
    (lambda: Learning(learning_rate=1.01), "learning_rate is 1.01, allowed are numbers from 0 to 1"),
    (lambda: Learning(learning_rate=-0.01), "learning_rate is -0.01"),
    (lambda: Learning(discount=2), "discount is 2"),
    (lambda: Learning(discount=np.nan), "discount is nan"),
    (lambda: Learning(driver="clock"), "driver is 'clock', allowed are 'cell', 'step'"),
    (lambda: Learning(credit="all"), "credit is 'all'"),
    (lambda: Learning(absence=-1), "absence is -1"),
    (lambda: Learning(trace=0), "trace is 0"),
    (lambda: Learning(terminal=1.5), "terminal is 1.5"),
    (lambda: Learning(driver="step", trace=5), "driver is 'step', allowed with it"),
    (lambda: Policy(exploration=1.1), "exploration is 1.1"),
    (lambda: Policy(idle="sleep"), "idle is 'sleep'"),
])
def test_a_bad_choice_is_refused(make, message):
    with pytest.raises(ValueError, match=message):
        make()


def test_an_agent_is_a_value():
    assert place_cells([3, 7]) == Agent((NresMap(3), NresMap(7)))
    assert hash(place_cells([3])) != hash(place_cells([3], own_cell="counts"))
    assert place_cells(np.array([3])) == place_cells((3,))
    assert brownian().policy.exploration == 1.0


@pytest.mark.parametrize("weighting, weight", [
    ("equal", [1 / 3] * 3), ("resolution", [3 / 33, 7 / 33, 23 / 33]), ("cells", [9 / 587, 49 / 587, 529 / 587])])
def test_the_weights_of_maps_add_up_to_one(weighting, weight):
    plan = compiled(place_cells([3, 7, 23], weighting=weighting), 250)
    np.testing.assert_allclose(plan.weight, weight)


def test_maps_lie_one_after_the_other():
    agent = place_cells([3, 7, 23], extent=(0.25, 0.75))
    plan = compiled(agent, 200)
    assert plan.first.tolist() == [0, 4 * 3**4, 4 * (3**4 + 7**4)]
    assert agent.n_values == 4 * (3**4 + 7**4 + 23**4)
    np.testing.assert_allclose(plan.low, 50)
    np.testing.assert_allclose(plan.scale, [3 / 100, 7 / 100, 23 / 100])
