"""Drawings: the numbers that they show."""

import matplotlib
import numpy as np
import pytest
from matplotlib import pyplot as plt

from neorl import NresMap, WaterWorld, brownian, figures, place_cells, simulate
from neorl.figures import binned_rate

matplotlib.use("agg")


@pytest.fixture(autouse=True)
def closed():
    yield
    plt.close("all")


@pytest.fixture(scope="module")
def results():
    return {f"N{n}": simulate(place_cells([n]), WaterWorld(n_creeps=8), steps=6_000, runs=3, progress=False)
            for n in (3, 7)}


def test_rates_over_stretches_add_up_to_the_total(results):
    result = results["N7"]
    rates = binned_rate(result, 7)
    edges = np.linspace(0, 600, 8).astype(int)
    np.testing.assert_allclose(rates @ np.diff(edges) * 0.2, result.totals, rtol=1e-5)


def test_accumulated_curves_end_at_the_mean_total(results):
    control = simulate(brownian(), WaterWorld(n_creeps=8), steps=6_000, runs=3, progress=False)
    figures.draw_accumulated(results, {"Brownian": control})
    lines = plt.gca().lines
    assert [line.get_ydata()[-1] for line in lines] == pytest.approx(
        [result.totals.mean() for result in [*results.values(), control]])
    assert {text.get_text() for text in plt.gca().texts} == {"N3", "N7", "Brownian"}


def test_proficiency_draws_the_sum_of_the_parts(results):
    figures.draw_proficiency(results, total=("sum", list(results.values())), points=10)
    n3, n7, total, _ = (line.get_ydata() for line in plt.gca().lines)
    np.testing.assert_allclose(total, n3 + n7, rtol=1e-5)


def test_names_at_the_ends_keep_apart():
    axes = plt.figure().add_subplot()
    axes.set_ylim(0, 1)
    figures.name_ends(axes, [(0.5, "b", "k"), (0.5, "c", "k"), (0.49, "a", "k"), (0.9, "d", "k")])
    heights = [text.xy[1] for text in axes.texts]
    assert np.all(np.diff(heights) >= 0.0749)
    assert [text.get_text() for text in axes.texts] == ["a", "b", "c", "d"]


def test_arrows_point_where_values_pull():
    axes = figures.new_board()
    values = np.zeros((4, 4))
    values[1] = [0.0, 0.2, 0.0, 0.4]  # south, and more to the west
    figures.draw_values(axes, NresMap(2), values)
    (quiver,) = axes.collections
    assert len(quiver.U) == 1 and quiver.U[0] < 0 < quiver.V[0]
    assert quiver.U[0] == pytest.approx(-2 * quiver.V[0])


def test_a_board_shows_every_cell_agent_and_creep():
    world = WaterWorld(n_creeps=5)
    axes = figures.new_board()
    figures.draw_cells(axes, NresMap(3), fills={4: ("red", 0.5)})
    figures.draw_tank(axes, world, world.reset(0))
    assert len(axes.patches) == 9 + 1 + 6
