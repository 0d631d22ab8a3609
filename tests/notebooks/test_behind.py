"""The record behind figures of few runs."""

from dataclasses import replace

import numpy as np
import pytest
from matplotlib import pyplot as plt

from companion.page import behind
from companion.thesis.reading import READINGS, conditions
from neorl import Explorer, Result, drawing

PAPER_C = conditions(READINGS["calibrated"], 3_000, 3, groups=["networks"])


def result(key="C", runs=3, **changes):
    condition = replace(PAPER_C["network", key], runs=runs, **changes)
    rewards = np.full((runs, 300), 0.02, np.float32)
    return Result(condition, rewards, np.zeros((*rewards.shape, 2), np.int16))


@pytest.fixture(autouse=True)
def curves(monkeypatch):
    rising = np.linspace(0, 0.3, behind.BINS)
    found = {"runs": 1_000, "minutes": 100, "curve": [rising, rising - 0.1, rising + 0.1],
             "whole": [0.15, 0.14, 0.16], "final": [0.29, 0.28, 0.30]}
    behind._known.cache_clear()
    monkeypatch.setattr(behind, "_curves", lambda: {"calibrated": {"network C": found}, "letter": {}})
    yield
    behind._known.cache_clear()


def test_the_record_knows_a_result_by_its_agents_and_world_however_long_it_ran():
    assert behind.recorded(result()).runs == behind.recorded(result(runs=12, seed=5)).runs == 1_000
    other = replace(PAPER_C["network", "C"].world, n_creeps=4)
    assert behind.recorded(result("D")) is behind.recorded(result(world=other)) is None


def test_what_an_explorer_offers_has_the_curve_of_what_is_recorded_of_it():
    offered = {"figure 4d": PAPER_C["network", "C"], "figure 4e": result("D")}
    assert [*behind.curves_of(offered)] == ["figure 4d"]
    minutes, mean, low, high, words = behind.curves_of(offered)["figure 4d"]
    assert (minutes, words) == (100, "the record, 1,000 runs")
    np.testing.assert_allclose([mean[-1], low[-1], high[-1]], [0.3, 0.2, 0.4])
    assert Explorer(offered, behind=behind.curves_of(offered))._presets["figure 4d"]["behind"]["edges"][-1] == 6_000


def test_where_there_is_no_record_nothing_is_behind(monkeypatch, tmp_path):
    monkeypatch.undo()
    monkeypatch.setattr(behind, "CURVES", tmp_path / "curves.json")
    behind._curves.cache_clear()
    assert behind.curves_of({"C": result()}) == {}
    behind._curves.cache_clear()


def test_few_runs_have_the_record_behind_them_and_many_stand_for_themselves():
    results = {"C": result(), "D": result("D")}
    axes = behind.add_recorded_rates(drawing.draw_proficiency(results, points=10), results)
    (pale,) = [line for line in axes.lines if len(line.get_xdata()) == behind.BINS]
    np.testing.assert_allclose(pale.get_ydata(), np.linspace(0, 0.3, behind.BINS))
    assert [each.get_text() for each in axes.texts if "record" in each.get_text()] == ["pale: the record, 1,000 runs"]
    assert axes.get_xlim() == (0, 1)  # the page's own minutes
    many = {"C": result(runs=10)}
    assert len(behind.add_recorded_rates(drawing.draw_proficiency(many, points=10), many).lines) == 2


@pytest.mark.parametrize("xs, value", [([7], (7, 0.29)), (range(1), (0.29, 0))])
def test_levels_stand_behind_points_and_behind_rows(xs, value):
    axes = plt.figure().add_subplot(xlim=(0, 0.1), ylim=(0, 0.1))
    behind.add_recorded_levels(axes, xs, {"C": result()})
    assert (axes.get_xlim() if isinstance(xs, range) else axes.get_ylim())[1] > 0.3  # which was too narrow
    (point,) = axes.lines
    assert (point.get_xdata()[0], point.get_ydata()[0]) == value and len(axes.collections) == 1


def test_totals_and_numbers_of_claims_stand_behind_few_runs(monkeypatch):
    axes = behind.add_recorded_totals(drawing.draw_accumulated({"C": result()}), {"C": result()})
    pale = max(axes.lines, key=lambda line: line.get_linewidth())
    assert len(pale.get_xdata()) == behind.BINS + 1 and pale.get_ydata()[-1] == pytest.approx(0.15 * 6_000)
    found = {"runs": 100, "numbers": {"world, arm": [[0.9, 0.8, 1.0], "", "", "asked"]}}
    monkeypatch.setattr(behind.report, "record", lambda: {"claims": {"G2": found}})
    for runs, drawn in ((3, 1), (10, 0)):
        scores = {"arm": (np.ones(runs), np.ones(runs)), "pool": (np.ones(runs), np.ones(runs))}
        assert len(behind.add_recorded_numbers(plt.figure().add_subplot(), scores, "G2", "world").lines) == drawn
