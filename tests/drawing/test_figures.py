"""Figures show the right numbers, names and colours."""

import numpy as np
import pytest
from matplotlib import pyplot as plt

from neorl import NresMap, Result, Run, WaterWorld, brownian, network_b, object_vector_cells, place_cells, simulate
from neorl.core.geometry import TAU
from neorl.core.modality import HEAD_DIRECTION_CELL, MODALITIES, PLACE_CELL, Modality, cartesian
from neorl import drawing
from neorl.drawing.style import name_ends
from neorl.evidence.curves import binned_rate, low_passed
from neorl.evidence.statistics import Estimate


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
    drawing.draw_proficiency(results, total=("sum", list(results.values())), points=10)
    n3, n7, total, _ = (line.get_ydata() for line in plt.gca().lines)
    np.testing.assert_allclose(total, n3 + n7, rtol=1e-5, atol=1e-12)


def test_the_control_is_drawn_in_ink(results):
    drawing.draw_accumulated(results, {"control": results["N3"]})
    assert [line.get_color() for line in plt.gca().lines] == [*drawing.CURVES[:2], drawing.INK]


def test_names_at_the_ends_keep_apart_and_near():
    axes = plt.figure().add_subplot()
    axes.set_ylim(0, 1)
    name_ends(axes, [(0.5, "b", "k"), (0.5, "c", "k"), (0.49, "a", "k"), (0.9, "d", "k")])
    heights = [text.xy[1] for text in axes.texts]
    assert np.all(np.diff(heights) >= 0.0749)
    assert np.mean(heights[:3]) == pytest.approx(1.49 / 3) and heights[3] == pytest.approx(0.9)
    assert [text.get_text() for text in axes.texts] == ["a", "b", "c", "d"]


def test_leaders_join_the_ends_of_curves_to_their_names():
    axes = plt.figure().add_subplot()
    axes.set_ylim(0, 1)
    name_ends(axes, [(0.5, "b", "k"), (0.5, "c", "k"), (0.1, "a", "k")], leaders=True)
    (leaders,) = axes.collections
    assert [line[0, 1] for line in leaders.get_segments()] == [0.1, 0.5, 0.5]
    assert [line[1, 1] for line in leaders.get_segments()] == [text.xy[1] for text in axes.texts]
    assert all(text.xy[0] > line[1, 0] for line, text in zip(leaders.get_segments(), axes.texts))


@pytest.mark.parametrize("level", [0.0, 1.0])
def test_names_of_many_curves_at_one_edge_stay_within_the_axes(level):
    axes = plt.figure().add_subplot()
    axes.set_ylim(0, 1)
    name_ends(axes, [(level, name, "k") for name in "abcdefghij"])
    heights = [text.xy[1] for text in axes.texts]
    assert np.all(np.diff(heights) >= 0.0749) and min(heights) >= 0 and max(heights) <= 1


def test_names_on_a_logarithmic_axis_stand_at_the_ends_of_their_curves_and_apart_as_seen():
    axes = plt.figure().add_subplot()
    axes.set(yscale="log", ylim=(1, 1000))
    name_ends(axes, [(10.0, "a", "k"), (10.0, "b", "k"), (500.0, "c", "k")])
    a, b, c = np.log10([text.xy[1] for text in axes.texts])
    assert b - a == pytest.approx(3 * 0.075) and (a + b) / 2 == pytest.approx(1) and c == pytest.approx(np.log10(500))


def test_the_name_of_a_mean_stands_at_its_last_point():
    axes = drawing.draw_curves([1, 2, 3], {"up": [[0, 0, 5]], "gap": [[1, 2, np.nan]]}, "x", "y")
    assert [(text.get_text(), text.xy[1]) for text in axes.texts] == [("gap", 2), ("up", 5)]


# Linear red, green and blue as seen without one kind of cone (Machado, Oliveira and Fernandes 2009).
SEEN = {"by most": np.eye(3),
        "without red": [[0.152, 1.053, -0.205], [0.115, 0.786, 0.099], [-0.004, -0.048, 1.052]],
        "without green": [[0.367, 0.861, -0.228], [0.280, 0.673, 0.047], [-0.012, 0.043, 0.969]],
        "without blue": [[1.256, -0.077, -0.179], [-0.078, 0.931, 0.148], [0.005, 0.691, 0.304]]}


def linear(colours):
    channels = np.array([[int(colour[i : i + 2], 16) / 255 for i in (1, 3, 5)] for colour in colours])
    return np.where(channels <= 0.04045, channels / 12.92, ((channels + 0.055) / 1.055) ** 2.4)


@pytest.mark.parametrize("eyes", SEEN)
def test_colours_of_curves_keep_apart(eyes):
    light = np.clip(linear([*drawing.CURVES, drawing.INK]) @ np.array(SEEN[eyes]).T, 0, 1)
    to_cones = [[0.4122, 0.5363, 0.0514], [0.2119, 0.6807, 0.1074], [0.0883, 0.2817, 0.6300]]  # Ottosson's Oklab
    to_lab = [[0.2105, 0.7936, -0.0041], [1.9780, -2.4286, 0.4506], [0.0259, 0.7828, -0.8087]]
    lab = np.cbrt(light @ np.array(to_cones).T) @ np.array(to_lab).T
    distance = np.linalg.norm(lab[:, None] - lab, axis=-1)
    assert distance[np.triu_indices(len(lab), 1)].min() > 0.09


@pytest.mark.parametrize("ground", ["#ffffff", "#121212"])
def test_colours_of_curves_stand_out_from_the_page(ground):
    luminance = linear([ground, *drawing.CURVES]) @ [0.2126, 0.7152, 0.0722] + 0.05
    assert len(set(drawing.CURVES)) == 7
    assert np.maximum(luminance[0] / luminance[1:], luminance[1:] / luminance[0]).min() > 2.85


def made_up(rate, runs, steps, seed=0):
    """A result in which every run earns `rate` per second, with noise in each bin."""
    rewards = np.random.default_rng(seed).normal(0.2 * rate, 0.3, (runs, -(-steps // 10))).astype(np.float32)
    return Result(place_cells([2]), WaterWorld(), steps, runs, 0, rewards, np.zeros((*rewards.shape, 2), np.int16))


def test_the_filter_keeps_what_is_slow():
    time = np.linspace(0, 1, 400)
    straight = np.stack([np.full(400, 0.3), 0.5 * time - 0.1])
    np.testing.assert_allclose(low_passed(straight), straight, atol=1e-6)
    slow = np.sin(TAU * 4 * time)[None]
    np.testing.assert_allclose(low_passed(slow)[:, 30:-30], slow[:, 30:-30], atol=0.01)  # no shift in time


def test_the_filter_takes_out_what_is_fast():
    time = np.linspace(0, 1, 400)
    fast = low_passed(np.sin(TAU * 60 * time)[None])
    assert np.abs(fast[:, 30:-30]).max() < 0.01


def test_too_short_a_run_is_refused():
    assert low_passed(np.ones((2, 41))).shape == (2, 41)
    with pytest.raises(ValueError, match="rates has the shape .* more than 40 points"):
        low_passed(np.ones((2, 40)))


def test_the_filter_keeps_the_mean_and_follows_no_single_point_at_the_end():
    noise = np.random.default_rng(0).normal(0.5, 0.1, (50, 400))
    smooth = low_passed(noise)
    assert np.abs(smooth.mean(axis=1) - noise.mean(axis=1)).max() < 0.01
    assert smooth[:, [0, -1]].std() < 0.6 * 0.1
    assert smooth[:, 100:-100].std() < 0.4 * 0.1


@pytest.mark.parametrize("runs, steps", [(3, 3_000), (1, 3_000), (4, 60_005)])
def test_smoothed_curves(runs, steps):
    results = {f"N{n}": made_up(n, runs, steps, seed=n) for n in range(7)}
    drawing.draw_smoothed(results)
    plt.gcf().draw_without_rendering()
    axes = plt.gca()
    smooth, raw = axes.lines[:7], axes.lines[8:]
    assert len(axes.lines) == 15 and len(axes.collections) == (7 if runs > 1 else 0)
    assert {text.get_text() for text in axes.texts} == set(results)
    assert [line.get_color() for line in smooth] == [line.get_color() for line in raw] == list(drawing.CURVES)
    for front, behind, result in zip(smooth, raw, results.values()):
        assert len(front.get_ydata()) <= 400
        assert front.get_ydata().mean() == pytest.approx(result.rate().mean(), abs=0.1)
        assert np.diff(front.get_ydata()).std() < 0.3 * np.diff(behind.get_ydata()).std()
        assert front.get_xdata()[-1] == pytest.approx(steps / 50 / 60, rel=0.01)
    assert np.ptp(axes.get_ylim()) < 1.35 * np.ptp([line.get_ydata() for line in smooth])


def test_a_last_bin_that_is_short_counts_as_short():
    result = made_up(1.0, 1, 95)
    result.rewards[:] = [0.2] * 9 + [0.1]
    np.testing.assert_allclose(binned_rate(result, 5), 1.0, rtol=1e-6)


def test_a_sweep_shows_values_and_intervals():
    estimates = {"D": [Estimate(0.1, 0.0, 0.3), Estimate(0.4, 0.3, 0.5)],
                 "single run": [Estimate(0.2, np.nan, np.nan)] * 2}
    drawing.draw_sweep([-1, 0.5], estimates, "r", "reward")
    plt.gcf().draw_without_rendering()
    axes = plt.gca()
    np.testing.assert_array_equal(axes.lines[1].get_xydata(), [[-1, 0.1], [0.5, 0.4]])
    np.testing.assert_array_equal(axes.collections[0].get_segments(), [[[-1, 0], [-1, 0.3]], [[0.5, 0.3], [0.5, 0.5]]])
    assert {text.get_text() for text in axes.texts} == set(estimates)
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("r", "reward")


def test_intervals_at_one_x_do_not_hide_each_other():
    axes = drawing.draw_sweep([-1, 0.5], {name: [Estimate(0.1, 0.0, 0.3)] * 2 for name in "CD"})
    plt.gcf().draw_without_rendering()
    of_c, of_d = (lines.get_transform().transform(lines.get_segments()[0]) for lines in axes.collections)
    assert 2 < (of_d - of_c)[0, 0] * 72 / axes.figure.dpi < 6
    np.testing.assert_allclose((of_c + of_d)[:, 0] / 2, axes.transData.transform((-1, 0))[0], atol=0.01)
    assert axes.get_xlim()[0] < -1 < 0.5 < axes.get_xlim()[1] and axes.get_ylim()[1] > 0.3


def test_arrows_point_where_values_pull():
    axes = drawing.new_board()
    values = np.zeros((4, 4))
    values[1] = [0.0, 0.2, 0.0, 0.4]  # south, and more to the west
    drawing.draw_values(NresMap(2), values, ax=axes)
    (quiver,) = axes.collections
    assert len(quiver.U) == 1 and quiver.U[0] < 0 < quiver.V[0]
    assert quiver.U[0] == pytest.approx(-2 * quiver.V[0])


def test_a_board_shows_every_cell_agent_and_creep():
    world = WaterWorld(n_creeps=5)
    axes = drawing.new_board()
    drawing.draw_cells(NresMap(3), fills={4: ("red", 0.5)}, ax=axes)
    drawing.draw_tank(world, world.reset(0), axes)
    assert len(axes.patches) == 9 + 1 + 6


def test_cells_of_a_map_with_ranges_of_its_own():
    axes = drawing.new_board()
    drawing.draw_cells(NresMap(2, Modality("", cartesian("position", (0, 1), (-1, 3)))), ax=axes)
    boxes = [(*patch.get_xy(), patch.get_width(), patch.get_height()) for patch in axes.patches]
    assert boxes == [(0, -1, 0.5, 2), (0.5, -1, 0.5, 2), (0, 1, 0.5, 2), (0.5, 1, 0.5, 2)]


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


def moving_tank():
    world = WaterWorld(n_creeps=3)
    state = world.reset(3)
    state.scene.position[:] = np.array([0.61, 0.43]) * world.width
    state.scene.velocity[:] = np.array([-0.3, 0.13]) * world.width
    return world, state


@pytest.mark.parametrize("resolution", [1, 2, 5])
@pytest.mark.parametrize("modality", MODALITIES, ids=lambda modality: modality.name)
def test_the_active_receptive_fields_are_filled(modality, resolution):
    world, state = moving_tank()
    nres_map, axes = NresMap(resolution, modality), drawing.new_board()
    drawing.draw_receptive_fields(nres_map, world, state, axes)
    axes.figure.draw_without_rendering()
    active = set(nres_map.encode(modality.coordinates(state.scene, world.size)))
    fills = [fill for fill in axes.collections if fill.get_alpha()]
    assert len(fills) == len(active)

    places = np.random.default_rng(0).random((300, 2))
    agent = state.scene.position / world.size
    seen = {"position": places, "velocity": (places - agent) / 0.5}.get(modality.follows, places - agent)
    filled = np.any([[fill.get_paths()[0].contains_point(place) for place in places] for fill in fills], axis=0)
    expected = np.isin(nres_map.encode(modality.tune(seen)), list(active))
    assert np.mean(filled == expected) > 0.98  # all but where corners are rounded


def test_place_cells_have_square_fields():
    world, state = moving_tank()
    axes = drawing.new_board()
    drawing.draw_receptive_fields(NresMap(4, PLACE_CELL), world, state, axes)
    columns, rows, fill = axes.collections
    for lines, coordinate in ((columns, 0), (rows, 1)):
        at = np.concatenate([path.vertices[:, coordinate] for path in lines.get_paths()])
        assert set(np.round(at, 6)) == {0.25, 0.5, 0.75}
    extent = fill.get_paths()[0].get_extents()
    np.testing.assert_allclose(extent.get_points(), [[0.5, 0.25], [0.75, 0.5]], atol=1e-6)


def test_head_directions_are_sectors_within_the_arena():
    world, state = moving_tank()
    axes = drawing.new_board()
    drawing.draw_receptive_fields(NresMap(4, HEAD_DIRECTION_CELL), world, state, axes)
    rays, fill = axes.collections
    steps = np.array(rays.get_segments())[:, 1] - rays.get_segments()[0][0]
    np.testing.assert_allclose(np.abs(steps[:, 0]), np.abs(steps[:, 1]))  # diagonals: a cell is centred on east
    arena = axes.transData.inverted().transform(rays.get_clip_box())
    np.testing.assert_allclose(np.sort(arena, axis=0), [[0, 0], [1, 1]], atol=1e-9)
    assert fill.get_paths()[0].contains_point((0.1, 0.5)) and not fill.get_paths()[0].contains_point((0.9, 0.5))


def test_curves_end_where_they_are_named():
    drawing.draw_curves(np.arange(20.0), {"one": np.ones((3, 20)), "two": np.full((1, 20), 2.0)}, "x", "y")
    assert {text.get_text(): text.xy[1] for text in plt.gca().texts} == pytest.approx({"one": 1.0, "two": 2.0})
    assert len(plt.gca().collections) == 1  # a single run has no interval


def test_costs_stand_beside_their_sum():
    drawing.draw_costs(["a", "b"], [1.0, 2.1], np.array([1.0, 2.0]))
    predicted, measured = plt.gca().lines
    assert (list(predicted.get_ydata()), list(measured.get_ydata())) == ([1.0, 2.0], [1.0, 2.1])


def test_desires_are_drawn_where_they_land():
    run = Run(network_b([3, 5]), WaterWorld(), seed=0)
    run.advance(20_000)
    axes = drawing.new_board()
    drawing.draw_desires(run, axes)
    landed = [line.get_xydata()[0] - run.world_state.scene.position / 250 for line in axes.lines]
    np.testing.assert_allclose(landed, run.state.desires.target[2:, :2])
    assert [line.get_color() for line in axes.lines] == [drawing.GREEN, drawing.RED]


def test_boards_side_by_side():
    boards = drawing.new_boards(2, 3)
    assert len(boards) == 6 and all(axes.get_ylim()[0] > axes.get_ylim()[1] for axes in boards)
    low, high = drawing.new_board(low=-1).get_xlim()
    assert low < -1 and high > 1
