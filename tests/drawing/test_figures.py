"""Figures show the right numbers, names and colours."""

import numpy as np
import pytest
from matplotlib import pyplot as plt
from matplotlib.collections import LineCollection, PolyCollection

from companion import paper_c
from companion.page.panels import draw_means
from companion.shared.smoothing import draw_smoothed, low_passed
from neorl import (Condition, NresMap, Result, Run, WaterWorld, brownian, network_b, object_vector_cells, place_cells,
                   simulate)
from neorl.core.direction import TAU
from neorl import drawing
from neorl.drawing.curves import draw_sums
from neorl.drawing.style import letters, linear_light, looks
from neorl.statistics import binned_rate


@pytest.fixture(scope="module")
def results():
    return {f"N{n}": simulate(place_cells([n]), WaterWorld(n_creeps=8), steps=6_000, runs=3, progress=False)
            for n in (3, 7)}


def test_rates_over_stretches_add_up_to_the_total(results):
    result = results["N7"]
    rates = binned_rate(result, 7)
    edges = np.linspace(0, 600, 8).astype(int)
    np.testing.assert_allclose(rates @ np.diff(edges) * 0.2, result.totals, rtol=1e-5, atol=1e-9)


def test_accumulated_curves_end_at_the_mean_total(results):
    control = simulate(brownian(), WaterWorld(n_creeps=8), steps=6_000, runs=3, progress=False)
    drawing.draw_accumulated(results, {"Brownian": control})
    lines = plt.gca().lines
    assert [line.get_ydata()[-1] for line in lines] == pytest.approx(
        [result.totals.mean() for result in [*results.values(), control]])
    assert {text.get_text() for text in plt.gca().texts} == {"N3", "N7", "Brownian"}


def test_proficiency_draws_the_sum_of_the_parts(results):
    sums = [*((name, [result]) for name, result in results.items()), ("sum", list(results.values()))]
    draw_sums(sums, looks(3), points=10)
    n3, n7, total, _ = (line.get_ydata() for line in plt.gca().lines)
    np.testing.assert_allclose(total, n3 + n7, rtol=1e-5, atol=1e-12)


def test_letters_are_legible_on_a_page_of_any_colour(results):
    """Figures bring their own ground, since no colour of letters has 4.5 : 1 with both white and black."""
    with plt.rc_context(drawing.STYLE):
        drawing.draw_proficiency(results)
        figure = plt.gcf()
        figure.draw_without_rendering()
        assert figure.get_facecolor()[3] == 1 and plt.rcParams["savefig.facecolor"] in ("auto", "white")
        _, ground = linear_light(figure.get_facecolor())
        written = {each.get_color() for each in figure.findobj(plt.Text) if each.get_text()}
        for colour in written | {letters(colour) for colour, _ in looks(7)}:
            assert (ground + 0.05) / (linear_light(colour)[1] + 0.05) >= 4.5


def test_the_filter_keeps_what_is_slow_and_takes_out_what_is_fast():
    time = np.linspace(0, 1, 400)
    straight = np.stack([np.full(400, 0.3), 0.5 * time - 0.1])
    np.testing.assert_allclose(low_passed(straight), straight, atol=1e-6)
    slow = np.sin(TAU * 4 * time)[None]
    np.testing.assert_allclose(low_passed(slow)[:, 30:-30], slow[:, 30:-30], atol=0.01)  # no shift in time
    fast = low_passed(np.sin(TAU * 60 * time)[None])
    assert np.abs(fast[:, 30:-30]).max() < 0.01


def test_smoothed_curves_have_the_unfiltered_ones_behind_them(results):
    axes = plt.figure().add_subplot()
    assert draw_smoothed(results, axes) is axes and axes.get_xlim() == (0, 2)
    assert len(axes.lines) == 2 * len(results) + 1  # and the line at 0


def test_a_last_bin_that_is_short_counts_as_short():
    rewards = np.array([[0.2] * 9 + [0.1]], np.float32)
    result = Result(Condition(place_cells([2]), WaterWorld(), 95, 1), rewards, np.zeros((1, 10, 2), np.int16))
    np.testing.assert_allclose(binned_rate(result, 5), 1.0, rtol=1e-6)


def test_arrows_point_where_values_pull():
    axes = drawing.new_board()
    values = np.zeros((4, 4))
    values[1] = [0.0, 0.2, 0.0, 0.4]  # south, and more to the west
    drawing.draw_values(NresMap(2), values, ax=axes)
    (quiver,) = axes.collections
    assert len(quiver.U) == 1 and quiver.U[0] < 0 < quiver.V[0]
    assert quiver.U[0] == pytest.approx(-2 * quiver.V[0])


def test_the_outermost_cells_of_a_map_reach_as_far_as_things_can_be():
    axes = drawing.new_board(low=-1)
    for nres_map in (place_cells([2], tiled_fraction=0.5).maps[0],
                     object_vector_cells([2], object_tiled_fraction=0.5, object_centred=False).maps[0]):
        drawing.draw_cells(nres_map, ax=axes)
    boxes = [patch.get_bbox().extents.tolist() for patch in axes.patches]
    assert boxes[:4] == [[0, 0, 0.5, 0.5], [0.5, 0, 1, 0.5], [0, 0.5, 0.5, 1], [0.5, 0.5, 1, 1]]
    assert boxes[4:] == [[-1, -1, 0, 0], [0, -1, 1, 0], [-1, 0, 0, 1], [0, 0, 1, 1]]
    drawing.draw_cells(place_cells([5], tiled_fraction=0.5).maps[0], ax=axes)
    assert sorted({round(patch.get_width(), 9) for patch in axes.patches[8:]}) == [0.1, 0.35]


def test_desires_are_drawn_where_they_land_or_towards_it_if_that_is_far_away():
    run = Run(network_b([3, 5]), WaterWorld(), seed=0)
    start = run.world_state.scene.position / 250
    run._record["desires"]["target_at"][2:4] = [[0.1, -0.2], [9.0, 3.0]]
    axes = drawing.new_board()
    paper_c.draw_desires(run, axes)
    (near,) = axes.lines
    np.testing.assert_allclose(near.get_xydata()[0] - start, [0.1, -0.2])
    assert near.get_color() == drawing.GREEN
    far = axes.texts[-1].xy
    np.testing.assert_allclose(far, [1.06, start[1] + 3 * (1.06 - start[0]) / 9])


@pytest.mark.parametrize("runs, drawn", [(9, LineCollection), (10, PolyCollection)])
def test_an_interval_of_fewer_than_ten_runs_is_never_drawn(runs, drawn):
    curves = np.random.default_rng(0).random((runs, 5))
    for draw in (lambda: drawing.draw_curves(np.arange(5), {"luck": curves}),
                 lambda: draw_means({"luck": (np.arange(5), curves)}, "", "")):
        draw()
        (spread,) = plt.gca().collections
        assert isinstance(spread, drawn) and len(spread.get_paths()) == (runs if runs < 10 else 1)
