"""Trajectories and tuning against closed forms and cases counted by hand."""

import numpy as np
import pytest
from matplotlib import pyplot as plt

from lib.chapter_2 import tuning_figures
from lib.chapter_2.tuning import (Trajectory, TuningCurve, cartesian, egocentric, in_field, information,
                                          likeness, rate_maps, rates, roam, spikes, information_in_spikes, tuning_curve)
from neorl import NresMap
from neorl.core.geometry import TAU
from neorl.core.modality import (BORDER_CELL, BOUNDARY_VECTOR_CELL, HEAD_DIRECTION_CELL, LANDMARK_VECTOR_CELL,
                                 OBJECT_VECTOR_CELL, SPEED_CELL)


@pytest.fixture(scope="module")
def trajectory():
    return roam(200_000, seed=1)


def standing(*places, velocity=(0.1, 0.0)):
    return Trajectory(np.array(places, float), np.tile(velocity, (len(places), 1)), 0.02)


def test_the_animal_moves_as_its_velocity_says(trajectory):
    moved = np.diff(trajectory.position, axis=0)
    away = np.all(np.abs(trajectory.position[1:] - 0.5) < 0.48, axis=1)  # a wall turns it within a step
    np.testing.assert_allclose(moved[away], 0.02 * trajectory.velocity[1:][away], atol=1e-12)
    assert np.abs(moved).max() < 0.03


def test_the_animal_visits_all_places_and_directions_equally(trajectory):
    assert trajectory.position.min() >= 0 and trajectory.position.max() <= 1
    counts, *_ = np.histogram2d(*trajectory.position.T, bins=4)
    np.testing.assert_allclose(counts / len(trajectory.position), 1 / 16, atol=0.02)
    directions, _ = np.histogram(trajectory.direction, bins=4, range=(0, TAU))
    np.testing.assert_allclose(directions / len(trajectory.position), 1 / 4, atol=0.02)


def test_speeds_are_rayleigh_distributed_and_velocity_has_the_given_persistence():
    walk = roam(400_000, seed=2, step=0.1, speed=0.2, persistence=2.0)
    assert walk.speed.mean() == pytest.approx(0.2, rel=0.01)
    assert np.mean(walk.speed**2) == pytest.approx(0.2**2 * 4 / np.pi, rel=0.02)
    still = roam(400_000, seed=2, step=0.1, speed=1e-6, persistence=2.0).velocity[:, 0]  # meets no wall
    lagged = [np.mean(still[:-lag] * still[lag:]) / np.mean(still**2) for lag in (10, 20)]
    np.testing.assert_allclose(lagged, np.exp([-0.5, -1.0]), atol=0.02)


def test_the_animal_runs_from_the_first_step_on():
    assert np.mean([roam(1, seed).speed for seed in range(300)]) == pytest.approx(0.2, rel=0.1)


def test_a_seed_fixes_the_trajectory():
    np.testing.assert_array_equal(roam(100, 3).position, roam(100, 3).position)
    assert not np.array_equal(roam(100, 3).position, roam(100, 4).position)


def test_a_cell_is_active_where_its_field_says():
    walk = standing((0.05, 0.5), (0.5, 0.05), (0.5, 0.5), (0.3, 0.5))
    assert in_field(NresMap(2), 2, walk).tolist() == [True, False, False, True]
    assert in_field(NresMap(5, BORDER_CELL), 10, walk).tolist() == [True, False, False, False]
    # Column 0, row 6 of 8: less than an eighth away, in the north.
    assert in_field(NresMap(8, BOUNDARY_VECTOR_CELL), 48, walk).tolist() == [False, True, False, False]


def test_any_of_several_objects_activates_a_cell_but_only_its_own_landmark():
    walk = standing((0.2, 0.5), (0.6, 0.5), (0.4, 0.5), (0.4, 0.1))
    objects = [(0.4, 0.5), (0.8, 0.5)]
    east = 1  # of 6 × 6: from 1/6 to 1/3 away, in the east
    assert in_field(NresMap(6, OBJECT_VECTOR_CELL), east, walk, objects).tolist() == [True, True, False, False]
    assert not in_field(NresMap(6, OBJECT_VECTOR_CELL), east, walk).any()
    assert in_field(NresMap(6, LANDMARK_VECTOR_CELL), east, standing((0.3, 0.5), (0.6, 0.5))).tolist() == [True, False]


def test_cells_of_velocity_follow_it():
    walk = standing((0, 0), velocity=(0.0, -0.35))
    assert (walk.direction[0], walk.speed[0]) == pytest.approx((0.75 * TAU, 0.35))
    assert in_field(NresMap(4, HEAD_DIRECTION_CELL), 3, walk).all()  # north, after east, south and west
    assert in_field(NresMap(20, SPEED_CELL), 3, walk).all()  # each spans a tenth of a width per second


def test_spikes_are_poisson_at_the_rates_inside_and_outside():
    active = np.arange(400_000) % 2 == 0
    counts = spikes(active, 0.02, seed=0, inside=20.0, outside=2.0)
    assert counts[active].mean() == pytest.approx(0.4, rel=0.01) == pytest.approx(counts[active].var(), rel=0.02)
    assert counts[~active].mean() == pytest.approx(0.04, rel=0.03)
    assert not spikes(active, 0.02, inside=0.0, outside=0.0).any()


def test_a_rate_is_spikes_over_time():
    values = [0.1, 0.1, 0.6, 0.6, 0.6, 1.0]
    tuned = tuning_curve([1, 3, 0, 0, 1, 1], values, step=0.5, high=1.0, bins=4, smoothing=0.0)
    np.testing.assert_array_equal(tuned.rate, [4.0, np.nan, 2 / 3, 2.0])
    np.testing.assert_array_equal(tuned.seconds, [1.0, 0.0, 1.5, 0.5])


def test_a_rate_map_has_x_first_and_many_trains_at_once():
    places = np.array([(0.1, 0.9), (0.1, 0.9), (0.9, 0.1)])
    tuned = tuning_curve([[1, 1, 0], [0, 0, 5]], places, step=1.0, high=1.0, bins=2, smoothing=0.0)
    np.testing.assert_array_equal(tuned.rate, [[[np.nan, 1], [0, np.nan]], [[np.nan, 0], [5, np.nan]]])
    np.testing.assert_array_equal(tuned.seconds, [[0, 2], [1, 0]])


def test_where_the_animal_never_was_there_is_no_rate():
    smooth = tuning_curve([1, 3, 1], [0.1, 0.1, 0.6], step=0.5, high=1.0, bins=4)
    assert np.isnan(smooth.rate).tolist() == [False, True, False, True] and np.all(smooth.seconds > 0)


def test_what_lies_beyond_the_axis_is_left_out():
    tuned = tuning_curve([1, 1, 1], [-0.1, 0.5, 1.1], step=1.0, high=1.0, bins=1, smoothing=0.0)
    assert (tuned.rate, tuned.seconds) == (1.0, 1.0)


def test_smoothing_leaves_a_constant_rate_alone_and_a_direction_closed():
    values = np.tile((np.arange(8) + 0.5) / 8 * TAU, 10)
    np.testing.assert_allclose(tuning_curve(np.ones(80), values, 0.1, TAU, 8).rate, 10.0)
    single = tuning_curve(np.arange(80) % 8 == 0, values, 0.1, TAU, 8, closed=True).rate
    np.testing.assert_allclose(single[1:], single[:0:-1])  # symmetric about the first bin, across the end
    assert single[0] > single[1] > single[2] and single[-1] == pytest.approx(single[1])


def test_a_map_is_smoothed_along_both_axes():
    places = (np.stack(np.meshgrid(range(9), range(9), indexing="ij"), axis=-1).reshape(-1, 2) + 0.5) / 9
    blob = tuning_curve(np.arange(81) == 40, places, 1.0, 1.0, 9).rate
    assert blob[4, 4] > blob[3, 4] > blob[3, 3] > 0
    np.testing.assert_allclose(blob, blob.T)


def test_a_map_recovers_the_rates_that_made_it(trajectory):
    active = in_field(NresMap(2), 3, trajectory)
    tuned = tuning_curve(spikes(active, 0.02, 5, 10.0, 1.0), trajectory.position, 0.02, 1.0, bins=10)
    assert tuned.rate[7:, 7:].mean() == pytest.approx(10.0, rel=0.05)
    assert tuned.rate[:3].mean() == pytest.approx(1.0, rel=0.1)


def test_information_of_a_cell_with_one_field_measures_how_small_it_is():
    seconds = np.full((4, 4), 3.0)
    field = np.zeros((4, 4))
    field[1, 2] = 7.0
    assert information(TuningCurve(field, seconds)) == pytest.approx(4.0)  # log₂ 16
    assert information(TuningCurve(np.full((4, 4), 2.0), seconds)) == pytest.approx(0.0)
    assert information(TuningCurve(np.zeros((4, 4)), seconds)) == 0.0


def test_information_is_weighted_by_time_and_ignores_bins_that_were_not_visited():
    rate = np.array([[4.0, 0.0, np.nan], [1.0, 1.0, np.nan]])
    expected = [0.25 * 4 * 2, 0.0]  # a quarter of the time at four times the mean: 2 bits
    np.testing.assert_allclose(information(TuningCurve(rate, np.array([1.0, 3.0, 9.0]))), expected)


def test_information_is_the_mutual_information_of_a_rare_spike():
    """Over short steps it is the information of a step, with or without a spike, per spike; here from probabilities."""
    share, rate, step = np.array([0.2, 0.5, 0.3]), np.array([5.0, 1.0, 0.2]), 1e-4
    spike = rate * step
    mean = np.sum(share * spike)
    found = np.sum(share * (spike * np.log2(spike / mean) + (1 - spike) * np.log2((1 - spike) / (1 - mean))))
    assert information(TuningCurve(rate, share)) == pytest.approx(found / mean, rel=1e-3)


def test_spikes_inform_about_what_they_follow_and_only_by_chance_about_anything_else(trajectory):
    walk = Trajectory(trajectory.position[:20_000], trajectory.velocity[:20_000], 0.02)
    trains = {"north": walk.direction > 0.5 * TAU, "fast": walk.speed > 0.3, "corner": walk.position.max(axis=1) < 0.3,
              "chance": np.random.default_rng(0).random(20_000) < 0.1}
    found = information_in_spikes(trains, walk, seed=1)
    assert {cell: [each.clear for each in about.values()] for cell, about in found.items()} == {
        "north": [False, True, False], "fast": [False, False, True], "corner": [True, False, False],
        "chance": [False, False, False]}
    assert [*found["north"]] == ["position", "direction", "speed"]
    expected = information(tuning_curve(trains["north"], walk.direction, 0.02, TAU, 18, closed=True))
    assert found["north"]["direction"].bits == expected > 0.5


def test_rate_maps_are_drawn_from_a_stream_for_each_cell(trajectory):
    walk = Trajectory(trajectory.position[:5_000], trajectory.velocity[:5_000], 0.02)
    axes = {"step": 0.02, "high": 1.0, "bins": 5}
    cells = {"place": (NresMap(2), 0), "object": (NresMap(6, OBJECT_VECTOR_CELL), 1)}
    maps = rate_maps(cells, walk, [(0.5, 0.5)], [3, 1], **axes)
    fired = spikes(in_field(*cells["object"], walk, [(0.5, 0.5)]), 0.02, [3, 1, 1])
    assert [*maps] == ["place", "object"]
    np.testing.assert_array_equal(maps["object"], tuning_curve(fired, walk.position, **axes).rate)


def test_maps_are_compared_where_both_were_seen():
    one, other = np.array([[1.0, 2.0], [3.0, np.nan]]), np.array([[2.0, 4.0], [6.0, -50.0]])
    found = likeness({"same": one, "turned": one}, {"turned": -other, "more": one, "same": other})
    assert found == pytest.approx({"same": 1.0, "turned": -1.0}) and [*found] == ["same", "turned"]


def test_a_point_in_polar_coordinates_has_cartesian_ones():
    np.testing.assert_allclose(cartesian(3.0, np.pi / 6), [1.5 * np.sqrt(3), 1.5])


def test_forward_is_where_one_heads_and_starboard_a_quarter_turn_to_the_right():
    north, east = [1.0, 0.0], [0.0, 1.0]
    np.testing.assert_allclose(egocentric([north, east], 0.0), [[1, 0], [0, 1]])
    np.testing.assert_allclose(egocentric([north, east], np.pi / 2), [[0, -1], [1, 0]], atol=1e-15)
    np.testing.assert_allclose(egocentric([1.0, 1.0], [np.pi / 4, np.pi]), [[np.sqrt(2), 0], [-1, -1]], atol=1e-15)


def test_turning_changes_no_distance():
    rng = np.random.default_rng(0)
    vectors = rng.normal(size=(50, 2))
    seen = egocentric(vectors, rng.uniform(0, 7, 50))
    np.testing.assert_allclose(np.linalg.norm(seen, axis=1), np.linalg.norm(vectors, axis=1))


def test_a_rate_map_is_drawn_with_x_to_the_right_and_y_down(trajectory):
    north_east = (trajectory.position > [0.5, -1]).all(axis=1) & (trajectory.position[:, 1] < 0.5)
    tuned = tuning_curve(north_east, trajectory.position, 0.02, 1.0, bins=4, smoothing=0.0)
    tuning_figures.draw_rate_maps(trajectory, north_east, {"corner": tuned.rate}, [(0.2, 0.3)])
    path, panel, *_ = plt.gcf().axes
    (image,) = panel.images
    shown = image.get_array()
    assert shown[0, 3] == pytest.approx(50.0) and shown[3, 3] == shown[0, 0] == 0.0
    left, right, bottom, top = image.get_extent()
    assert (left, right, bottom, top) == (0, 1, 1, 0) and panel.get_ylim()[0] > panel.get_ylim()[1]
    assert path.lines[1].get_xydata().min(axis=0) == pytest.approx([0.5, 0.0], abs=0.01)
    assert panel.lines[0].get_xydata().tolist() == [[0.2, 0.3]]


def test_a_tuning_curve_runs_clockwise_from_east_and_closes():
    tuning_figures.draw_tuning_curves({"cell": np.array([1.0, 5.0, 1.0, 1.0])}, {"cell": np.array([1.0, np.nan])}, 0.5)
    around, along = plt.gcf().axes
    angles, rates = around.lines[0].get_data()
    assert around.get_theta_direction() == -1 and rates.tolist() == [1.0, 5.0, 1.0, 1.0, 1.0]
    assert angles[1] == pytest.approx(TAU * 3 / 8) and angles[-1] == pytest.approx(angles[0] + TAU)
    assert along.lines[0].get_xdata().tolist() == pytest.approx([0.125, 0.375])


def test_tuning_curves_are_named_outside_the_circle_on_opposite_sides():
    rates = np.array([1.0, 5.0, 1.0, 1.0])
    tuning_figures.draw_tuning_curves({"tuned": rates, "flat": np.ones(4)}, {"flat": rates}, 0.5)
    around, _ = plt.gcf().axes
    tuned, flat = around.texts
    assert min(tuned.xyann[1], flat.xyann[1]) > around.get_rmax()
    assert flat.xyann[0] - tuned.xyann[0] == pytest.approx(np.pi)


def test_both_frames_meet_in_the_point():
    tuning_figures.draw_frames((2.0, 1.0), 0.3, 3.0, np.pi / 3)
    left, right = plt.gcf().axes
    for dotted in left.lines[1:3]:  # from the forward and the starboard axis
        np.testing.assert_allclose(dotted.get_xydata()[1], [1.0, 2.0])
        along, across = dotted.get_xydata()[0], dotted.get_xydata()[1] - dotted.get_xydata()[0]
        assert along @ across == pytest.approx(0.0, abs=1e-12)
    assert right.lines[1].get_xydata()[0] == pytest.approx([1.5, 1.5 * np.sqrt(3)])


@pytest.mark.parametrize("call, message", [
    (lambda: roam(0), "steps must be .*, but is 0"), (lambda: roam(10, step=0.0), "step must be .*, but is 0.0"),
    (lambda: roam(10, speed=-1.0), "speed must be .*, but is -1.0"),
    (lambda: in_field(NresMap(2), 4, roam(5)), "cell must be an integer from 0 to 3, but is 4"),
    (lambda: in_field("map", 0, roam(5)), "nres_map must be a NresMap, but is 'map'"),
    (lambda: spikes([True], 0.02, inside=-1.0), "inside must be .*, but is -1.0"),
    (lambda: tuning_curve([1], [0.5], 1.0, 1.0, bins=0), "bins must be .*, but is 0"),
    (lambda: tuning_curve([1], [0.5], 1.0, 0.0, bins=1), "high must be .*, but is 0.0"),
    (lambda: egocentric([1.0, 2.0, 3.0], 0.0), r"vectors must have the shape \(…, 2\), for north, east, but has \(3,"),
])
def test_a_bad_argument_is_refused(call, message):
    with pytest.raises(ValueError, match=message):
        call()


def test_rates_are_those_of_the_tuning_curves_of_some_cells():
    trains, values = {"a": np.array([1, 0, 1, 0]), "b": np.array([0, 1, 0, 1])}, np.array([0.1, 0.9, 0.1, 0.9])
    found = rates(trains, ["b"], values, step=1.0, high=1.0, bins=2, smoothing=0.0)
    assert list(found) == ["b"] and found["b"].tolist() == [0.0, 1.0]
