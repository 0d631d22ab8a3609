"""Chapter 2: an animal in a box, the tuning of its cells, and the neuron in the page's cells, by closed forms."""

import numpy as np
import pytest
from page_cells import assert_captions_end_with_numbers_of_their_figures, executed

from companion.chapter_2.tuning import (Trajectory, TuningCurve, egocentric, in_field, information,
                                        information_in_spikes, roam, spikes, tuning_curve)
from neorl import NresMap
from neorl.core.direction import TAU
from neorl.core.modality import (BORDER_CELL, BOUNDARY_VECTOR_CELL, LANDMARK_VECTOR_CELL,
                                 OBJECT_VECTOR_CELL)


@pytest.fixture(scope="module")
def trajectory():
    return roam(200_000, seed=1)


@pytest.fixture(scope="module")
def page():
    return executed("chapter_2", steps=60_000)


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


def test_smoothing_leaves_a_constant_rate_alone_and_a_direction_closed():
    values = np.tile((np.arange(8) + 0.5) / 8 * TAU, 10)
    np.testing.assert_allclose(tuning_curve(np.ones(80), values, 0.1, TAU, 8).rate, 10.0)
    single = tuning_curve(np.arange(80) % 8 == 0, values, 0.1, TAU, 8, closed=True).rate
    np.testing.assert_allclose(single[1:], single[:0:-1])  # symmetric about the first bin, across the end
    assert single[0] > single[1] > single[2] and single[-1] == pytest.approx(single[1])


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


def test_forward_is_where_one_heads_and_starboard_a_quarter_turn_to_the_right():
    north, east = [1.0, 0.0], [0.0, 1.0]
    np.testing.assert_allclose(egocentric([north, east], 0.0), [[1, 0], [0, 1]])
    np.testing.assert_allclose(egocentric([north, east], np.pi / 2), [[0, -1], [1, 0]], atol=1e-15)
    np.testing.assert_allclose(egocentric([1.0, 1.0], [np.pi / 4, np.pi]), [[np.sqrt(2), 0], [-1, -1]], atol=1e-15)


def test_a_grid_cell_fires_most_at_the_nodes_of_a_hexagonal_lattice(page):
    angles = np.radians(60 * np.arange(6))
    nodes = 0.3 * np.stack([np.cos(angles), np.sin(angles)], axis=-1)
    np.testing.assert_allclose(page.grid_rate(np.vstack([(0, 0), nodes, 2 * nodes]), 0.3), 1.0, atol=1e-12)
    fine = np.random.default_rng(0).random((20_000, 2))
    rates = page.grid_rate(fine, 0.3)
    assert rates.min() == pytest.approx(0, abs=0.01) and rates.max() <= 1
    high = fine[rates > 0.99] @ np.linalg.inv(np.array([nodes[0], nodes[1]]))
    assert np.abs(high - np.round(high)).max() < 0.1


def test_an_object_cell_has_a_compact_field_in_its_own_frame_alone(page):
    maps = page.object_maps
    for cell, frames in maps.items():
        share = {frame: np.mean(rate > np.nanmax(rate) / 3) for frame, rate in frames.items()}
        own, other = sorted(share, key=share.get)
        assert cell == f"{own} cell" and share[other] > 3 * share[own]
        peak = np.unravel_index(np.nanargmax(frames[own]), frames[own].shape)
        np.testing.assert_allclose((np.array(peak) + 0.5) / 25 - 0.5, (0.2, -0.15), atol=0.06)


def test_the_gates_move_as_in_the_paper(page):
    """Values at a depolarisation of 25 and 10 mV, where the formulas are 0/0, and of 30 mV."""
    opening, closing = page.gate_rates(page.REST + 25)
    assert (opening[0], closing[0]) == pytest.approx((1.0, 4 * np.exp(-25 / 18)))
    opening, closing = page.gate_rates(page.REST + 10)
    assert (opening[2], closing[2]) == pytest.approx((0.1, 0.125 * np.exp(-1 / 8)))
    opening, closing = page.gate_rates(page.REST + 30)
    assert (opening[1], closing[1]) == pytest.approx((0.07 * np.exp(-1.5), 0.5))


def test_an_action_potential_is_all_or_none_and_obeys_its_own_equation(page):
    peaks = {current: page.action_potential(current)[1].max() for current in (0.0, 6.9, 6.95, 16.0)}
    assert peaks[0.0] == pytest.approx(page.REST, abs=0.02) and peaks[6.9] < -55.0
    assert 30.0 < peaks[6.95] < peaks[16.0] < 45.0
    time, potential, m, h, n = page.action_potential(10.0)
    flow = 120 * m**3 * h * (potential - 50) + 36 * n**4 * (potential + 77) + 0.3 * (potential + 54.387)
    inside = (time > 5.05) & (time < 5.95)
    change = np.gradient(potential, time)  # by finite differences
    np.testing.assert_allclose(change[inside], 10.0 - flow[inside], atol=0.05)
    np.testing.assert_allclose(change[time > 6.05], -flow[time > 6.05], atol=1.0)


def test_the_soma_fires_as_often_as_the_closed_form_says_and_rests_after_a_spike(page):
    integrate = page.integrate
    currents = np.array([1.0, 1.4, 2.5, 3.5, 4.0])
    _, fired = integrate(np.tile(currents, (40_000, 1)), step=0.05)
    drive = 10 * currents[2:]
    np.testing.assert_allclose(fired.sum(axis=0)[2:] / 2, 1000 / (2 + 10 * np.log(drive / (drive - 15))), rtol=0.01)
    assert not fired[:, :2].any()
    potential, fired = integrate(np.full(10_000, 1e6))
    assert np.diff(np.flatnonzero(fired)).min() == 21  # 2 ms at the reset, and one step up
    potential, _ = integrate(np.full(300, 1.2), step=0.5)
    time = 0.5 * np.arange(1, 301)
    np.testing.assert_allclose(potential, -65.0 + 12.0 * (1 - np.exp(-time / 10.0)), rtol=1e-12)


def test_a_synapse_sets_off_a_current_for_each_spike(page):
    spikes = np.zeros(1_000, bool)
    spikes[[100, 400]] = True
    current = page.synaptic_current(spikes, weight=-0.5, decay=4.0, step=0.2)
    assert current[99] == 0.0 and current[100] == -0.5 and current[120] == pytest.approx(-0.5 / np.e)
    assert current[400] == pytest.approx(-0.5 * (1 + np.exp(-15.0))) and current[-1] == pytest.approx(0, abs=1e-10)


def test_a_shock_is_forgotten_and_five_apart_are_not(page):
    efficacy = page.efficacy
    np.testing.assert_allclose(efficacy(np.array([-1, 0, 15, 60]), [0]), 1 + np.array([0, 1, np.exp(-1), np.exp(-4)]))
    share = np.exp(-1.0)  # of a trace, a quarter of an hour later
    assert efficacy(24 * 60.0, [0.0]) == pytest.approx(1.0)
    assert efficacy(24 * 60.0, 15.0 * np.arange(5)) == pytest.approx(1 + 4 * share * (1 - share))
    assert efficacy(24 * 60.0, 0.1 * np.arange(5)) < 1.05


def test_captions_end_with_numbers_of_their_figures(page):
    assert_captions_end_with_numbers_of_their_figures(page, ["cell-16"])
