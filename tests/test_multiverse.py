"""The multiverse: its space, its conditions, and what it counts."""

from dataclasses import fields, replace

import numpy as np
import pytest
from matplotlib import pyplot as plt

from neorl import (Learning, Policy, multimodal, multiverse, network_a, network_b, network_c, network_d, place_cells,
                   simulate)
from neorl.claims import Claim
from neorl.multiverse import CHOICES, PLAINEST, Reading
from neorl.multiverse_figures import draw_importance, draw_specification
from neorl.statistics import Estimate


def test_the_default_reading_is_that_of_the_book():
    found = multiverse.conditions(Reading(), 600_000, 2)
    assert found["layers"].agent == place_cells([3, 7, 23])
    assert found["both"].agent == multimodal()
    networks = [found["network", name].agent for name in "ABCD"]
    assert networks == [network_a(), network_b(), network_c(), network_d()]
    assert {key: condition.steps for key, condition in found.items()}["network", "A"] == 300_000
    assert (found["single", 90].steps, found["both"].steps) == (150_000, 600_000)
    assert (found["layers"].world.n_creeps, found["layers"].world.win_reward) == (8, 5.0)
    assert (found["both"].world.n_creeps, found["both"].world.win_reward) == (3, 0.0)


def test_every_field_of_a_reading_is_varied_and_has_its_default_in_the_prior():
    assert [field.name for field in fields(Reading)] == list(CHOICES)
    for name, choice in CHOICES.items():
        default = getattr(Reading(), name)
        assert 0 <= choice.place(default) <= 1
        assert choice.levels


@pytest.mark.parametrize("change", [
    {"learning_rate": 0.1}, {"discount": 0.5}, {"credit": "last"}, {"credit": "step"}, {"absence": 0.3}, {"trace": 10},
    {"terminal": False}, {"own_cell": "counts"}, {"coverage": 1.0}, {"weighting": "cells"}, {"exploration": 0.1},
    {"idle": "no-op"}, {"place_gain": 5.0}, {"vectors": "signed"}, {"vectors": "incoming"}, {"scale": 0.5},
    {"recursion": 1.0}, {"fps": 30}, {"contact": "truncated"}])
def test_every_choice_changes_the_conditions_of_the_papers_that_it_belongs_to_and_no_others(change):
    (name,) = change
    default, other = (multiverse.conditions(reading, 3_000, 2) for reading in (Reading(), Reading(**change)))
    papers = {"single": "A", "layer": "A", "layers": "A", "brownian": "A", "place": "B", "objects": "B", "both": "B",
              "pace": "B", "network": "C", "throughout": "T", "revalued": "T"}
    changed = {papers[key if isinstance(key, str) else key[0]] for key in default if default[key] != other[key]}
    assert changed == set(CHOICES[name].papers)


def test_what_would_teach_an_agent_nothing_is_no_reading():
    assert replace(PLAINEST, idle="no-op").agents == PLAINEST.agents
    assert Reading(idle="no-op", exploration=0.1).agents["policy"] == Policy(0.1, "no-op")
    assert Reading(bootstrap=False).learning == Learning()
    assert Reading(bootstrap=False, trace=10).learning == Learning(trace=10, bootstrap=False)
    assert Reading(credit="step", trace=100, absence=0.3).learning == Learning(driver="step")


def test_the_plainest_reading_is_neither_in_the_middle_nor_weighted_nor_curious():
    found = multiverse.conditions(PLAINEST, 600_000, 10)
    assert found["both"].agent == multimodal(coverage=1, weighting="equal", policy=Policy(exploration=0))
    assert found["pace", "both"] == found["both"]  # long enough


def test_papers_b_and_c_live_the_same_time_at_any_rate_and_paper_a_the_same_steps():
    found = multiverse.conditions(Reading(fps=30), 30_000, 4)
    assert (found["single", 10].steps, found["both"].steps, found["network", "D"].steps) == (30_000, 18_000, 18_000)
    assert (found["pace", "both"].steps, found["pace", "both"].runs, found["brownian"].runs) == (288_000, 2, 32)
    assert found["pace", "both"].steps / 30 == 160 * 60


def test_a_design_fills_the_priors_evenly_and_any_power_of_two_is_part_of_the_next():
    readings = multiverse.design(64)
    assert readings[:16] == multiverse.design(16)
    assert sum(reading.terminal for reading in readings) == 32
    assert sum(reading.recursion == -1 for reading in readings) == 32
    rates = np.sort([reading.learning_rate for reading in readings])
    np.testing.assert_allclose(np.log(rates / 0.003) / np.log(100), (np.arange(64) + 0.5) / 64, atol=1 / 64)
    assert multiverse.design(16, seed=1) != readings[:16]
    assert len(set(readings)) == 64


@pytest.mark.parametrize("points", [0, 1, 3, 100, 2.0])
def test_a_design_of_another_size_is_refused(points):
    with pytest.raises(ValueError, match=f"points is {points}, allowed are"):
        multiverse.design(points)


def test_a_reading_is_judged_on_all_claims_that_readings_matter_for():
    found = multiverse.conditions(replace(Reading(), fps=30), 600, 2)
    results = {key: simulate(**condition.choices, progress=False) for key, condition in found.items()
               if key not in [("single", n) for n in (70, 90)]}
    results |= {("single", n): results["single", 50] for n in (70, 90)}
    judged = multiverse.judge(results)
    assert list(judged) == ["A1", "A2", "A3", "A4", "A5", "A6", "A7", "B1", "B2", "B3", "B4", "C1", "C2", "C3", "C4",
                            "T1"]
    assert judged["B4"].outcome == "not testable"  # in runs of 2.4 minutes


def judged(value, outcome="not reproduced", is_open=False):
    return Claim("C2", Estimate(value, value - 0.1, value + 0.1), "", 4, outcome, is_open)


def test_claims_are_counted():
    claims = [{"C2": judged(0.3, "reproduced")}, {"C2": judged(0.05, "partly", True)}, {"C2": judged(-1)},
              {"C2": judged(0, "not testable")}]
    assert multiverse.shares(claims) == {"C2": {"holds": 1, "undecided": 1, "untestable": 1, "readings": 4}}
    assert [multiverse.held(each) for each in claims] == [["C2"], [], [], []]


@pytest.fixture
def made_up():
    """128 readings whose C2 follows from the discount and, less so, from the credit."""
    readings = multiverse.design(128)
    values = [CHOICES["discount"].place(reading.discount) + 0.5 * (reading.credit == "last") for reading in readings]
    return readings, [{"C2": judged(value, "reproduced" if value > 1 else "not reproduced")} for value in values]


def test_support_counts_the_claims_that_hold_at_each_level(made_up):
    found = {(each.choice, each.level): each for each in multiverse.support(*made_up)}
    assert found["credit", "last"].lead.low > 0 and found["contact", "truncated"].lead.low < 0
    assert found["credit", "share"].is_plainest and found["credit", "share"].lead.value == 0
    assert found["credit", "last"].value == "last"
    assert found["discount", "0.5 … 0.613"].value == pytest.approx(0.5 + 0.45 / 8)
    assert found["coverage", "1"].is_plainest and not found["coverage", "0.5"].is_plainest
    assert found["discount", "0.838 … 0.95"].held > found["discount", "0.5 … 0.613"].held == 0
    assert [level for name, level in found if name == "discount"] == ["0.5 … 0.613", "0.613 … 0.725",
                                                                       "0.725 … 0.838", "0.838 … 0.95"]
    assert [found["discount", level].is_plainest for name, level in found if name == "discount"] == [False, False, True,
                                                                                                    False]


def test_what_leads_is_the_plainest_reading_but_for_what_clearly_leads_it():
    nothing, half, more = Estimate(0.3, -0.1, 0.7), Estimate(0.5, 0.1, 0.9), Estimate(0.9, 0.5, 1.3)
    supports = [multiverse.Support("coverage", "1", 1.0, True, 1.0, Estimate(0, -0.2, 0.2)),
                multiverse.Support("coverage", "0.5", 0.5, False, 1.5, half),
                multiverse.Support("exploration", "0.02", 0.02, False, 1.5, half),
                multiverse.Support("exploration", "0.1", 0.1, False, 1.9, more),
                multiverse.Support("credit", "last", "last", False, 1.3, nothing)]
    assert multiverse.leading(supports) == replace(PLAINEST, coverage=0.5, exploration=0.02)


def test_the_choices_that_matter_are_found(made_up):
    shares, explained = multiverse.importance(*made_up, "C2")
    assert set(shares) == {name for name, choice in CHOICES.items() if "C" in choice.papers}
    first, second, third = sorted(shares, key=shares.get, reverse=True)[:3]
    assert (first, second) == ("discount", "credit") and shares[third] < 0.05
    assert explained > 0.8


def test_a_specification_curve_is_in_order_and_shows_every_choice_below(made_up):
    readings, claims = made_up
    claims[7] = {"C2": judged(np.nan)}
    draw_specification(readings, claims, "C2")
    figure = plt.gcf()
    curve, strips = figure.axes
    points = {line.get_label(): line.get_xydata() for line in curve.lines if line.get_label()[0] != "_"}
    assert [label.split()[0] for label in points] == ["holds", "undecided", "fails"]
    at = np.concatenate(list(points.values()))
    at = at[at[:, 0].argsort()]
    assert len(at) == 128 and np.all(np.diff(at[:, 1]) >= 0)
    (image,) = strips.images
    order = np.argsort([-np.inf if np.isnan(each["C2"].here.value) else each["C2"].here.value for each in claims],
                       kind="stable")
    labels = [tick.get_text() for tick in strips.get_yticklabels()]
    row = labels.index("discount, γ")
    assert labels == [choice.label for choice in CHOICES.values()]
    np.testing.assert_allclose(image.get_array()[row], [CHOICES["discount"].place(readings[i].discount) for i in order])
    plt.close(figure)


def test_a_curve_of_paper_a_leaves_out_what_does_not_concern_it(made_up):
    readings, claims = made_up
    draw_specification(readings, [{"A4": replace(each["C2"], name="A4")} for each in claims], "A4")
    labels = [tick.get_text() for tick in plt.gcf().axes[1].get_yticklabels()]
    assert "recursion, r" not in labels and "map weights" in labels
    plt.close()


def test_importance_is_drawn_as_discs_of_that_area():
    draw_importance({"A2": {"discount": 0.25, "credit": -0.1}, "C4": {"recursion": 1.0}})
    sizes = [line.get_markersize() for line in plt.gca().lines]
    assert sizes[0] == pytest.approx(sizes[2] / 2) and sizes[1] == 0
    assert [tick.get_text() for tick in plt.gca().get_xticklabels()] == ["A2", "C4"]
    plt.close()
