"""The numbers shown by the figures of chapter 4."""

import numpy as np
import pytest
from matplotlib import pyplot as plt

from lib.chapter_4 import potentials, purposive_figures
from lib.chapter_4.realtime import Pace
from lib.chapter_4.walks import expected_squared_displacement, walk
from lib.shared.grid import Grid
from neorl.drawing.style import CURVES, use_style
from neorl.evidence.statistics import Estimate


@pytest.fixture(autouse=True)
def style():
    with plt.rc_context():
        use_style()
        yield


def drawn():
    plt.gcf().draw_without_rendering()
    return plt.gcf().axes


def texts(axes):
    return [text.get_text() for text in axes.texts]


def test_walks_are_drawn_in_full_with_their_ends_and_the_goal():
    paths = walk(0.5, (9, 0, 0), steps=60, runs=2)
    purposive_figures.draw_walks({"noise": paths, "bias": paths}, (9, 0, 0))
    left, right = drawn()
    assert (left.get_title(), right.get_title()) == ("noise", "bias")
    assert [len(panel.lines) for panel in (left, right)] == [5, 6]
    np.testing.assert_array_equal(np.transpose(left.lines[0].get_data_3d()), paths[0])
    np.testing.assert_array_equal(np.ravel(left.lines[3].get_data_3d()), paths[1, -1])
    np.testing.assert_array_equal(np.ravel(right.lines[-1].get_data_3d()), [9, 0, 0])
    assert texts(left) == [f"{np.ptp(left.get_xlim()):.0f} steps wide"]


def test_displacements_lie_on_what_is_expected():
    lags = np.array([1, 10, 100])
    squared = {beta: np.tile(expected_squared_displacement(beta, lags), (4, 1)) for beta in (0.0, 0.3)}
    purposive_figures.draw_displacements(lags, squared)
    (axes,) = drawn()
    line, points = axes.lines[:2]
    np.testing.assert_allclose(points.get_ydata(), [0, 0.5, 1])
    np.testing.assert_allclose(line.get_ydata()[[0, -1]], [0, 1])
    assert texts(axes) == ["β = 0", "β = 0.3"]
    assert [label.get_text() for label in axes.get_yticklabels()][1:3] == ["$10^{0}$", "$10^{1}$"]


def test_parts_are_drawn_under_each_other_with_their_names():
    panels = {"x": {"": np.arange(3.0)}, "u": {"true": np.ones(3), "found": np.zeros(3)}}
    purposive_figures.draw_parts(np.arange(3), panels)
    upper, lower = drawn()
    np.testing.assert_array_equal(upper.lines[0].get_ydata(), [0, 1, 2])
    assert texts(lower) == ["true", "found"]
    assert [line.get_linewidth() for line in lower.lines] == [4.5, 1.2]


def test_errors_are_drawn_as_powers_of_ten_and_not_below_a_ten_thousandth():
    purposive_figures.draw_errors({"product": np.array([1.0, 0.1, 0.0])}, terms=1)
    (axes,) = drawn()
    np.testing.assert_allclose(axes.lines[0].get_ydata(), [0, -1, -4])
    assert axes.lines[1].get_xdata() == [1, 1] and texts(axes) == ["product"]


def test_overlaps_are_the_more_opaque_the_larger():
    purposive_figures.draw_overlaps({"one": np.eye(2), "other": np.full((2, 2), 0.5)})
    one, other = (axes.images[0] for axes in drawn())
    np.testing.assert_allclose(one.to_rgba(one.get_array())[..., 3], np.eye(2))
    np.testing.assert_allclose(other.to_rgba(other.get_array())[..., 3], 0.5, atol=0.01)


def test_policies_are_drawn_where_there_is_no_element_and_ringed_where_they_differ():
    grid = Grid(("....",))
    left, right = (potentials.plan(grid, reward) for reward in np.eye(4)[[0, 3]])
    purposive_figures.draw_policies(grid, {"left": left, "right": right}, {0: 1.0, 3: -1.0})
    first, second = drawn()
    assert (first.get_title(), texts(first)) == ("left", ["+", "−"])
    (arrows,) = first.collections
    assert len(arrows.U) == 2 and np.all(arrows.U < 0) and np.all(second.collections[0].U > 0)
    assert [float(ring.get_xdata()[0]) for ring in first.lines] == [1, 2] and not second.lines


def test_a_state_is_ringed_for_a_wrong_action_and_not_for_one_that_is_left_out():
    left, either = (np.tile(q, (4, 1)) for q in ([0.0, 0.0, 0.0, 1.0], [0.0, 0.0, 1.0, 1.0]))
    purposive_figures.draw_policies(Grid(("....",)), {"sum": either, "plan": left}, {0: 1.0})
    assert [float(ring.get_xdata()[0]) for ring in drawn()[0].lines] == [1, 2, 3]
    purposive_figures.draw_policies(Grid(("....",)), {"sum": left, "plan": either}, {0: 1.0})
    assert not drawn()[0].lines


def test_roles_are_drawn_as_means_over_runs():
    values = np.random.default_rng(0).random((5, 10, 4))
    purposive_figures.draw_roles({"one": values, "other": values + 1})
    upper, lower = drawn()
    for role, (line, colour) in enumerate(zip(lower.lines, CURVES)):
        np.testing.assert_allclose(line.get_ydata(), values[..., role].mean(axis=0) + 1)
        assert line.get_color() == colour
    assert set(texts(upper)) == {"cause", "other lever", "light", "bell"}
    assert upper.lines[0].get_xdata()[0] == 1 and len(upper.collections) == 4


@pytest.mark.parametrize("xs, logarithmic, scale", [([0, 5, 50], True, "symlog"), ([1, 5, 50], True, "log"),
                                                    ([1, 2, 3], False, "linear")])
def test_estimates_are_drawn_with_their_intervals(xs, logarithmic, scale):
    estimates = [Estimate(0.5, 0.4, 0.7), Estimate(0.6, 0.5, 0.8), Estimate(0.2, np.nan, np.nan)]
    purposive_figures.draw_estimates(xs, {"a": estimates}, "x", "y", logarithmic)
    (axes,) = drawn()
    np.testing.assert_allclose(axes.lines[0].get_ydata(), [0.5, 0.6, 0.2])
    np.testing.assert_allclose(axes.collections[0].get_segments()[0], [[xs[0], 0.4], [xs[0], 0.7]])
    assert [label.get_text() for label in axes.get_xticklabels()] == [f"{x:g}" for x in xs]
    assert axes.get_xscale() == scale and texts(axes) == ["a"]


def test_the_load_of_each_window_stands_in_its_middle():
    purposive_figures.draw_load(Pace(np.array([0.02, 0.5]), np.zeros((2, 3))), seconds=0.5)
    (axes,) = drawn()
    np.testing.assert_allclose(axes.lines[0].get_xydata(), [[0.25, 0.02], [0.75, 0.5]])
    assert texts(axes) == ["one core"] and axes.get_ylim()[1] > 1
