"""Sentences and tables on decision processes, for made-up results."""

import numpy as np
import pytest

from lib.chapter_3 import decision, decision_report
from lib.shared.grid import Grid


def test_returns_stand_below_rewards_by_step():
    found = decision_report.returns_table(np.array([0.0, 2.0]), {0.5: np.array([1.0, 2.0])})
    assert found == "| t | 0 | 1 |\n|---|---|---|\n| Rₜ₊₁ | 0 | 2 |\n| Gₜ, γ = 0.5 | 1.00 | 2.00 |"


def test_errors_are_those_at_the_last_checkpoint_in_the_order_of_floors():
    visits = np.array([1, 2])
    errors = {"α ≥ 1": (visits, np.array([[9.0, 1.0]])), "α = 1/n": (visits, np.array([[9.0, 0.25]]))}
    assert decision_report.final_errors(errors).splitlines()[2:] == ["| α = 1/n | 0.25 |", "| α ≥ 1 | 1.00 |"]


@pytest.fixture(scope="module")
def task():
    grid = Grid(("..", ".G"))
    return decision.reaching(grid.next_state, {3: 1.0}, slip=0.2)


@pytest.mark.parametrize("late, expected", [
    ([0.5, 0.9, 0.95], "The model thus learns from fewer steps."),
    ([0.95, 0.95, 0.95], "The interval leaves open which one needs fewer."),
])
def test_the_larger_table_needs_fewer_steps_only_if_the_interval_says_so(task, late, expected):
    made = {"Q-learning": np.array([late, late]), "model": np.array([[0.95, 1.0, 1.0], [0.95, 1.0, 1.0]])}
    text = decision_report.model_against_values(made, [1_000, 2_000, 3_000], task)
    assert expected in text and "6,400 multiplications" in text
    steps = "3,000 steps and the model 1,000" if late[0] < 0.95 else "1,000 steps and the model 1,000"
    assert f"Q-learning takes {steps}; " in text


def test_what_a_dimension_costs_is_fitted_for_each_number_of_cells():
    ds = np.arange(1, 5)
    covering = {"2 cells": (ds, np.array([4.0**ds] * 2)), "3 cells": (ds, np.array([9.0**ds] * 2))}
    learning = {"2 cells": (ds, np.array([2.0 ** (3 * ds)] * 2)), "3 cells": (ds, np.array([9.0**ds] * 2))}
    text = decision_report.cost_of_a_dimension(covering, learning)
    assert "| 2 | × 4.00 [4.00, 4.00] | × 8.00 [8.00, 8.00] |" in text and "to the power of 2.0 to 3.0." in text
    assert "Each factor is larger than that" in text


def test_no_reason_is_given_if_a_factor_does_not_exceed_the_number_of_cells():
    ds = np.arange(1, 5)
    steps = {"4 cells": (ds, np.array([5.0**ds, 3.0**ds]))}
    assert "Each factor is larger" not in decision_report.cost_of_a_dimension(steps, steps)


def test_sweeps_are_counted_in_all(task):
    found = decision_report.sweeps_in_all(task, 0.9, (1, 50))
    totals = [decision.sweeps_until_stable(*task.expected(), 0.9, sweeps) for sweeps in (1, 50)]
    assert found == f"{totals[0]} sweeps in all with 1 per iteration; {totals[1]} sweeps in all with 50 per iteration."
