"""Sentences and tables of chapter 4 on value functions and their sums, for known numbers."""

import numpy as np

from lib.chapter_4 import potentials_report
from lib.chapter_4.potentials import Comparison

BASIS, NO_BASIS = np.diag([4.0, 2.0, 1.0]), np.ones((3, 3))


def overlaps(learned, neighbours, opposite, planned=0.2):
    cosines = {"learned": np.transpose([np.ones(len(learned)), neighbours, opposite]),
               "planned": np.array([[1.0, 0.5, planned]])}
    return potentials_report.overlaps(np.array(learned), np.eye(3), cosines)


def test_functions_that_overlap_even_at_opposite_corners_are_not_orthogonal():
    text = overlaps([BASIS, BASIS], [0.6, 0.6], [0.1, 0.1])
    assert text.startswith("They are not orthogonal: neighbours have a cosine of 0.60 [0.60, 0.60], and even opposite "
                           "corners of 0.10 [0.10, 0.10]. The learned functions overlap less than the planned ones.")


def test_functions_that_may_be_orthogonal_are_not_said_to_be_otherwise():
    text = overlaps([BASIS, BASIS], [0.6, 0.6], [-0.5, 1.0])
    assert text.startswith("Neighbours have a cosine of 0.60 [0.60, 0.60], opposite corners of 0.25 [−0.50, 1.00]. But")


def test_one_agent_has_no_interval_that_could_hold_0():
    assert overlaps([BASIS], [0.6], [0.3]).startswith("They are not orthogonal: neighbours have a cosine of 0.60, and")


def test_functions_that_are_independent_in_all_agents_are_a_basis():
    text = overlaps([BASIS, 2 * BASIS], [0.6, 0.6], [0.3, 0.3])
    assert ("*independent* in 2 of 2 agents: the 3 functions have rank 3, so none of them is a weighted sum of others. "
            "The planned ones are too, with rank 3. So the set is a *basis*, as the thesis says: any function on the 3 "
            "cells is a weighted sum of the 3. The condition number") in text
    assert text.endswith("its median over agents is 4, and for the planned functions it is 1.")


def test_agents_whose_functions_depend_on_each_other_are_left_out():
    text = overlaps([BASIS, NO_BASIS], [0.6, 0.6], [0.3, 0.3])
    assert "*independent* in 1 of 2 agents" in text and "*basis*" not in text and "median over agents is 4," in text
    text = overlaps([NO_BASIS, NO_BASIS], [0.6, 0.6], [0.3, 0.3])
    assert "*independent* in 0 of 2 agents" in text and text.endswith("with rank 3.")


def test_the_overlap_by_the_default_rule_is_reported_beside_that_by_the_plain_one():
    cosines = {"learned": np.array([[1.0, 0.6, 0.1]]), "planned": np.array([[1.0, 0.5, 0.2]]),
               "book's rule": np.array([[1.0, 0.75, 0.5]])}
    text = potentials_report.overlaps(np.array([BASIS]), np.eye(3), cosines)
    assert text.endswith("By the book's default rule, neighbours have a cosine of 0.75, and opposite corners of 0.50.")


def made_up(achieved, at_random=0.1):
    return Comparison(np.ones(2), np.full(2, achieved), np.full(2, at_random))


def shares(compared):
    others = {0.5: [made_up(0.8), made_up(0.7)]}
    return potentials_report.shares_of_plan(compared, {0: "none feared", 1: "one feared"}, others)


def test_the_sum_is_reported_as_a_share_of_the_plan():
    text = shares({(1, 0): made_up(1.0), (2, 0): made_up(1.0, -0.2), (1, 1): made_up(0.6), (2, 1): made_up(0.75, 0.05)})
    assert text.splitlines()[2:6] == [
        "| Desired | none feared | one feared | random actions, none feared |", "|---|---|---|---|",
        "| 1 | 1.00 [1.00, 1.00] | 0.60 [0.60, 0.60] | 0.10 [0.10, 0.10] |",
        "| 2 | 1.00 [1.00, 1.00] | 0.75 [0.75, 0.75] | −0.20 [−0.20, −0.20] |"]
    assert "With 1 or 2 desired and no feared elements, the sum lost nothing in any placement. Following" in text
    assert ("Following it earns 60 to 100 % of the plan's return. Random actions earn −20 to 10 % if no element is "
            "feared, and otherwise 5 to 10 %. The sum does worst with 1 desired and 1 feared.") in text
    assert text.endswith("with γ = 0.5 it earns 0.80 [0.80, 0.80] and 0.70 [0.70, 0.70].")


def test_a_sum_that_always_loses_is_not_said_to_lose_nothing():
    text = shares({(1, 0): made_up(0.9), (1, 1): made_up(0.95)})
    assert "lost nothing" not in text and "The sum does worst with 1 desired and 0 feared." in text


def test_the_largest_weights_stand_first_beside_their_valences():
    weights, rewards = np.array([0.1, -2.0, *np.zeros(9), 1.5]), np.array([0.0, -1.0, *np.zeros(9), 1.0])
    lines = potentials_report.largest_weights(weights, rewards).splitlines()
    assert len(lines) == 8 and lines[:3] == ["cell 1: weight -2.00, valence -1", "cell 11: weight +1.50, valence +1",
                                             "cell 0: weight +0.10, valence +0"]
