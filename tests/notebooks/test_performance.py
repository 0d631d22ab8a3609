"""The page on performance: rivals compute the same, bytes are counted as described, and both are reported.

No test judges a measured time.
"""

import json
from dataclasses import replace

import numpy as np
import pytest
from matplotlib import pyplot as plt

from lib.performance import (bandwidth, bound, contest, growth, minutes, performance_figures, report, rivals,
                                        timing)
from neorl import CALIBRATED, Run, WaterWorld, place_cells
from neorl.drawing.style import use_style

STEPS, LIVED = 1_000, 3_000


@pytest.fixture(scope="module")
def stretch():
    return rivals.record(5, STEPS, LIVED)


def test_a_recorded_stretch_is_the_life_of_the_agent_to_the_last_bit(stretch):
    q, lived = stretch.q.copy(), Run(place_cells([5], learning=rivals.PLAIN), WaterWorld())
    lived.advance(LIVED)
    assert np.array_equal(q, lived.q())
    lived.advance(STEPS)
    rivals.by_kernel(stretch, q, stretch.goal_range.copy())
    assert np.array_equal(q, lived.q()) and not np.array_equal(q, stretch.q) and stretch.learns.sum() > 30


def test_all_rivals_compute_the_same(stretch):
    q, by_numpy, heads = stretch.q.copy(), stretch.q.copy(), rivals.heads_of(stretch.q)
    best = rivals.by_kernel(stretch, q, stretch.goal_range.copy())
    assert np.array_equal(rivals.by_numpy(stretch, by_numpy), best)
    assert np.array_equal(rivals.by_heads(stretch, heads), best)
    assert np.unique(best).size == 4
    np.testing.assert_allclose(by_numpy, q, rtol=1e-6, atol=1e-29)
    np.testing.assert_allclose(np.stack([head.q for head in heads], axis=-1), q, rtol=1e-6, atol=1e-29)


@pytest.mark.filterwarnings("ignore")
def test_jax_computes_the_same_where_it_is_installed(stretch):
    jax = pytest.importorskip("jax")
    q = stretch.q.copy()
    best = rivals.by_kernel(stretch, q, stretch.goal_range.copy())
    by_jax, values = rivals.by_jax(stretch)(jax.numpy.array(stretch.q))
    np.testing.assert_allclose(values, q, rtol=1e-5, atol=1e-6)
    assert (np.asarray(by_jax) == best).mean() > 0.99


def test_what_is_not_installed_is_named():
    assert rivals.is_installed("numpy") and not rivals.is_installed("no_such_package")
    assert "JAX, PLE" in report.absent(contest.Contest("", {}, ("JAX",)), contest.Contest("", {}, ("PLE",)))
    assert report.absent(contest.Contest("", {}, ())) == ""


def lived(resolution, **rule):
    indifferent = place_cells([resolution], 0.0, 0.0, learning=replace(CALIBRATED, **rule))  # it moves all the same
    run = Run(indifferent, WaterWorld())
    run.advance(10_000)
    return run


def test_all_goals_move_the_rows_of_two_cells_and_one_of_them_twice():
    run = lived(2, bootstrap=True, memory=0.0)
    found = bound.moved(run, 500)
    assert found.ordered / found.changes == pytest.approx(4 * 4 * 4 * 3)  # 4 bytes, 4 goals, 4 actions
    assert found.scattered == found.remembered == 0 and found.working_set == 4 * 4 * 4 * 4
    assert found.standing == 3 * 4 * 4 + 8 + 2 * 8  # values of three creeps, one track


def test_events_without_a_rate_are_not_moved():
    found = bound.moved(lived(2, bootstrap=True, memory=0.0, credit="last", absent_decay=0.0), 500)
    assert found.ordered / found.changes == pytest.approx(4 * 4 * (4 + 2))


def test_lone_values_move_lines_in_a_map_that_is_larger_than_the_nearest_cache():
    small, large = (bound.moved(lived(n, memory=1.0), 500) for n in (3, 11))
    assert small.scattered == 0 and small.ordered > 0
    far = large.scattered / (2 * 64)  # values of a cell's actions, which share a line
    near = (large.ordered - large.changes * large.remembered * (4 * 2 * 17 + 8 + 32)) / (4 * 2 * 4)
    assert far + near == pytest.approx(large.changes * large.remembered) and min(far, near) > 0
    assert large.working_set <= large.scattered * 500


def test_the_values_of_a_cell_move_a_line_each_if_goals_lie_together():
    found = bound.moved(lived(11, memory=1.0, bootstrap=True), 500)
    assert 2 * 64 * found.changes * found.remembered < found.scattered < 4 * 2 * 64 * found.changes * found.remembered


def test_counting_bytes_takes_the_same_steps():
    counted, run = lived(5), lived(5)
    bound.moved(counted, 300)
    run.advance(300)
    assert np.array_equal(counted.q(), run.q())


SPEEDS = bandwidth.Bandwidths(np.array([1e4, 1e6]), np.array([8e9, 2e9]), np.array([4e9, 1e9]))
LOOP = bound.Loop(bound.Moved(50.0, 150.0, 400.0, 10**5, 0.5, 3.0), np.array([2e-7, 1e-7]), np.array([5e-7, 6e-7]))
LOOPS = {name: LOOP for name in bound.AGENTS}


def test_a_bandwidth_lies_between_those_measured():
    assert SPEEDS.at(1e5) == pytest.approx(5e9) and SPEEDS.at(1e9) == 2e9
    measured = bandwidth.measure(1, largest=2**15)
    assert list(measured.working_sets) == [2**14, 2**15] and measured.copied.min() > 0 < measured.scattered.min()


def test_the_bound_is_the_world_and_the_bytes():
    assert LOOP.moving(SPEEDS) == pytest.approx(600 / 5e9)
    assert LOOP.ratio(SPEEDS).value == pytest.approx(5e-7 / (1e-7 + 1.2e-7))


def test_things_take_turns_and_the_least_counts():
    called, ticks = [], iter(range(100))
    preparations = {name: timing.always(called.append, name) for name in "ab"}
    seconds = timing.in_turns(preparations, 2, lambda: next(ticks))
    assert "".join(called) == "ababab" and all((each == 1).all() and len(each) == 2 for each in seconds.values())
    assert timing.times_as_long(np.array([6.0, 8.0]), np.array([2.0, 9.0])).value == 3


def test_the_same_steps_are_timed_each_time():
    run = lived(3)
    before = run.q().copy()
    timing.again(run, 100)()()
    assert np.array_equal(run.q(), before) and run.step == 10_000


def test_exponents():
    xs = np.array([1.0, 2.0, 4.0, 8.0])
    assert timing.exponent(xs, 5 * xs**3) == pytest.approx((3, 3, 3))
    assert timing.exponent(xs, np.array([-1.0, 2.0, 4.0, 8.0])).value == pytest.approx(1)
    assert np.isnan(timing.exponent(xs, np.array([-1.0, 2.0, 0.0, 8.0]))).all()
    low, high = timing.exponent(xs, xs * [1, 1.5, 1, 1])[1:]
    assert low < 1 < high


def test_series_have_a_point_for_each_number():
    series = growth.maps(20, 1)
    assert series.costs.shape == series.xs.shape == (len(growth.MAPS),)
    assert growth.update(1).xs.tolist() == list(growth.RESOLUTIONS)


def test_where_time_goes_has_every_part():
    agents = {"small": place_cells([3])}
    assert [*bound.spent(50, 1, agents=agents)["small"]] == ["world", "seeing", "choosing", "learning"]
    assert [*bound.measure(50, 1, agents=agents)] == ["small"]


def write_page(folder, name, cells, duration):
    noted = [{"cell_type": "code", "source": source, "metadata": {"papermill": {"duration": seconds}, **more}}
             for source, seconds, more in cells]
    page = {"cells": noted, "metadata": {"papermill": {"duration": duration}}}
    (folder / f"{name}.ipynb").write_text(json.dumps(page))


def test_the_seconds_of_a_page_are_split_by_what_its_cells_do(tmp_path):
    write_page(tmp_path, "short", [("x = 1", 1.0, {})], 2.0)
    write_page(tmp_path, "long", [("import os\nfrom neorl import Run\n", 2.0, {}), ("simulate()", 30.0, {}),
                                  ("draw()", 4.0, {"mystnb": {"figure": {}}}), ("note", None, {})], 40.0)
    (tmp_path / "foreign.ipynb").write_text("{}")
    (tmp_path / "broken.ipynb").write_text("{")
    assert minutes.of_pages(tmp_path) == [minutes.PageTime("long", 4.0, 2.0, 30.0, 4.0),
                                          minutes.PageTime("short", 1.0, 0.0, 1.0, 0.0)]
    assert minutes.of_pages(tmp_path / "nowhere") == []


def test_what_is_said():
    rows = contest.Contest("a step", {"neoRL": np.array([1e-7]), "NumPy": np.array([2e-5])}, ())
    said = report.summary(LOOPS, SPEEDS, rows, rows)
    assert "500 ns to 500 ns" in said and "the aim of at most 2 is met by none" in said and "200 (NumPy)" in said
    assert "**" not in said
    bounds = spaced(report.bound_table(LOOPS, SPEEDS))
    assert "| 500 ns | 2.3 [" in bounds and "| 0.1 MiB |" in bounds
    assert "| a step | NumPy | 20 µs | 200 |" in spaced(report.contest_table(rows))
    assert "less than 1 ns" in spaced(report.spent_table({"N3": {"world": 1e-7, "learning": -1e-9}}))
    series = [growth.Series("N", "values", "bytes", np.array([1.0, 2.0, 3.0]), np.array([1.0, 4.0, 9.0]), 2, True)]
    assert "| values | N | at most 2 | 2.00 [2.00, 2.00] |" in report.growth_table(series)
    assert "No page" in report.minutes_table([])
    assert "| all pages | 1 | 2 | 30 | 4 | 37 |" in report.minutes_table([minutes.PageTime("a", 1.0, 2.0, 30.0, 4.0)])
    assert "| 1,200 |" in report.minutes_table([minutes.PageTime("a", 0.0, 0.0, 1200.0, 0.0)])


def spaced(text):
    """A table with ordinary spaces for those that do not break, of which it has some."""
    assert "\N{NO-BREAK SPACE}" in text
    return text.replace("\N{NO-BREAK SPACE}", " ")


def test_figures_are_drawn():
    rows = contest.Contest("a step of WaterWorld", {"neoRL": np.array([1e-7]), "PLE": np.array([2e-5])}, ())
    series = [growth.Series("N", "cost", "seconds", np.array([1.0, 2.0]), np.array([1e-7, -1e-9]), 2, True)] * 3
    performance_figures.draw_bandwidths(SPEEDS, LOOPS)
    assert plt.gca().get_yscale() == "log"
    performance_figures.draw_bounds(LOOPS, SPEEDS)
    assert [text.get_text() for text in plt.gca().texts] == ["2.3 ×"] * 4
    performance_figures.draw_contests(rows, rows)
    assert not plt.gca().patches and len(plt.gca().lines) == 4  # a bar on a logarithmic axis has no meaningful length
    performance_figures.draw_growth(series)
    performance_figures.draw_minutes([minutes.PageTime("a", 1.0, 2.0, 30.0, 4.0)])
    assert plt.gca().get_yticklabels()[0].get_text() == "a"
    performance_figures.draw_minutes([])
    for number in plt.get_fignums():
        plt.figure(number).canvas.draw()
    plt.close("all")


def test_a_legend_wider_than_the_bars_does_not_narrow_them():
    with plt.rc_context():
        use_style()
        performance_figures.draw_minutes([minutes.PageTime("a_long_name", 1.0, 2.0, 30.0, 4.0)])
        plt.gcf().canvas.draw()
        assert plt.gca().get_position().width > 0.6
        plt.close()
