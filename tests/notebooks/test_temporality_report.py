"""Sentences and tables on processes that remember, for made-up results."""

import numpy as np
import pytest

from lib.chapter_3 import temporality_report as report


@pytest.mark.parametrize("last, expected", [(9, "Every learner meets all"), (8, "Not every learner meets all")])
def test_all_histories_are_met_or_not(last, expected):
    memories = np.array([1, 2])
    met = {2: (memories, np.array([[2, 4], [2, 4]])), 3: (memories, np.array([[3, 9], [3, last]]))}
    assert report.states_met(met).startswith(expected)


def test_states_are_listed_for_every_second_memory():
    found = report.states_table(np.arange(1, 5), {"sum": [2, 4, 8, 16], "pause": [2, 3, 4, 5]})
    assert found.splitlines() == ["| Outcome, Ψ = 2 | L\xa0=\xa02 | L\xa0=\xa04 |", "|---|---|---|",
                                  "| the sum of the last L symbols modulo Ψ | 4 | 16 |",
                                  "| 1 after L symbols of 0 in a row, else 0 | 3 | 5 |", "| *all histories* | 4 | 16 |"]


def test_the_factors_of_experience_carry_the_names_of_their_worlds():
    memories = np.arange(1, 4)
    needed = {f"Ψ = {base}": (memories, np.array([float(base) ** memories])) for base in (2, 3)}
    assert report.experience_factors(needed) == "2.00 with Ψ = 2; 3.00 with Ψ = 3"


@pytest.mark.parametrize("short, expected", [(0.5, True), (0.6, False)])
def test_a_short_memory_is_worth_a_guess_or_more(short, expected):
    paid = {"sum": np.array([[0.5, short, 0.9]] * 2), "table": np.array([[0.5, 0.8, 0.9]] * 2)}
    text = report.short_memory(paid, memory=2)
    assert text.startswith(f"With the sum, agents that remember 1 of the 2 steps earn {short:.2f} [{short:.2f}, "
                           f"{short:.2f}] per step, and agents that remember all earn 0.90 [0.90, 0.90]. ")
    assert ("no more than a guess" in text) == expected
    assert "With the table, 1 steps earn 0.80 [0.80, 0.80]: there" in text


def curves(certain, remembering, sticky, sticky_remembering):
    made = {"certain": certain, "certain + last": remembering, "sticky": sticky, "sticky + last": sticky_remembering}
    return {name: (np.array([100, 1_000, 10_000]), np.array([shares] * 2)) for name, shares in made.items()}


SEEN = {"certain": 37, "certain + last": 148, "sticky": 37, "sticky + last": 148}


def test_the_cost_of_remembering_is_reported_for_when_others_first_reach_nine_tenths():
    made = curves([0.2, 0.9, 1.0], [0.1, 0.6, 0.9], [0.2, 0.8, 0.8], [0.1, 0.7, 1.0])
    text = report.worth_of_last_action(made, SEEN)
    assert text == ("The learners meet 37 states without the last action and 148 with it. Where actions are "
                    "certain, remembering costs 0.30 [0.30, 0.30] of the best return after 1,000 steps, and finally "
                    "changes the return by −0.10 [−0.10, −0.10]. Where they are sticky, it finally changes the "
                    "return by 0.20 [0.20, 0.20]: the agent without memory stays behind.")


def test_the_cost_is_reported_for_the_end_if_none_reaches_nine_tenths_and_no_difference_is_inconclusive():
    made = curves([0.2, 0.5, 0.7], [0.1, 0.3, 0.3], [0.2, 0.5, 0.5], [0.1, 0.5, 0.5])
    text = report.worth_of_last_action(made, SEEN)
    assert "costs 0.40 [0.40, 0.40] of the best return after 10,000 steps" in text
    assert text.endswith("0.00 [0.00, 0.00], which is inconclusive with so few learners or steps.")


def test_the_table_of_floors_has_a_row_for_each():
    found = report.floors_table({0.1: [np.array([0.5]), np.array([0.75])], 0.5: [np.array([0.25]), np.array([1.0])]})
    assert found.splitlines()[2:] == ["| 0.1 | 0.50 | 0.75 |", "| 0.5 | 0.25 | 1.00 |"]


def test_the_box_has_the_curse_the_missing_step_and_the_model():
    needed = {"Ψ = 2": (np.arange(1, 4), np.array([[10.0, 20.0, 40.0]] * 3))}
    paid = {"sum": np.tile([0.5, 0.5, 0.9], (3, 1)), "table": np.tile([0.5, 0.6, 0.9], (3, 1))}
    text = report.in_short(needed, paid, 2, 169, 1.66)
    assert "prolongs Q-learning by a factor of 2.0" in text and "grid of 169 states only 1.7 % of its entries" in text
    assert "remember 1 of 2 such steps earn 0.50 [0.50, 0.50] per step" in text and "all earn 0.90" in text


def test_the_curse_is_judged_by_all_steps_and_by_all_but_one():
    rng = np.random.default_rng(0)
    paid = {rule: np.stack([np.full(12, 0.5), 0.5 + 0.01 * rng.random(12), 0.9 + 0.01 * rng.random(12)], axis=1)
            for rule in ("sum", "table")}
    assert report.judge(paid, 2).name == "T3"
    assert report.judge(paid, 2).here != report.judge(paid, 1).here
