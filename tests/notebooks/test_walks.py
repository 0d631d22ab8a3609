"""Random walks and series, against closed forms."""

import numpy as np
import pytest

from lib.chapter_4 import walks, wold
from lib.chapter_4.walks import expected_squared_displacement, mean_squared_displacement, walk

FAR = (np.inf, 0, 0)


def test_a_walk_begins_at_the_origin_and_goes_one_unit_a_step():
    paths = walk(0.3, (5, -20, 9), steps=200, runs=4)
    assert paths.shape == (4, 201, 3) and not paths[:, 0].any()
    np.testing.assert_array_equal(np.abs(np.diff(paths, axis=1)).sum(axis=2), 1)


def test_without_a_bias_all_six_directions_are_equally_likely():
    steps = np.diff(walk(0.0, (3, 3, 3), steps=20_000, runs=3), axis=1).reshape(-1, 3)
    shares = np.unique(steps, axis=0, return_counts=True)[1] / len(steps)
    assert len(shares) == 6
    np.testing.assert_allclose(shares, 1 / 6, atol=0.006)


@pytest.mark.parametrize("strength", [0.0, 0.1, 0.5, 1.0])
def test_walks_spread_as_diffusion_and_drift_foretell(strength):
    lags = np.array([1, 10, 100])
    squared = mean_squared_displacement(walk(strength, FAR, steps=5_000, runs=60), lags)
    np.testing.assert_allclose(squared.mean(axis=0), expected_squared_displacement(strength, lags), rtol=0.06)


def test_displacements_are_those_counted_by_hand():
    path = np.array([[[0, 0, 0], [1, 0, 0], [1, 1, 0], [1, 1, -1]]])
    np.testing.assert_allclose(mean_squared_displacement(path, [1, 2, 3]), [[1, 2, 3]])
    straight = np.arange(100_001)[None, :, None] * np.array([1, 0, 0], np.int32)
    assert mean_squared_displacement(straight.astype(np.int32), [100_000])[0, 0] == 1e10


def test_distance_grows_with_the_root_of_time_first_and_with_time_itself_at_last():
    lags = 10 ** np.arange(7)
    squared = np.array([[1, 7, 100, 1e6, 7e8, 7e10, 1e12], [4, 7, 400, 4e6, 7e8, 7e10, 4e12]])
    np.testing.assert_allclose(walks.powers_of_time(squared, lags), [[0.5, 0.5], [1, 1]])


def test_a_walk_has_arrived_when_it_first_is_near_its_goal():
    path = np.arange(20)[:, None] * [1, 0, 0]
    there_and_back = np.concatenate([path, path[::-1]])
    first = walks.first_arrivals(np.stack([there_and_back, -there_and_back]), goal=(10, 0, 0))
    np.testing.assert_array_equal(first, [6, np.inf])
    assert walks.first_arrivals(path[None], goal=(3, 0, 0)) == [0]


def test_a_walker_that_is_always_biased_goes_to_its_goal_and_wanders_about_it():
    paths = walk(1.0, (3, -2, 0), steps=9, runs=2)
    np.testing.assert_array_equal(paths[:, 5], [[3, -2, 0]] * 2)
    np.testing.assert_array_equal(np.abs(paths[:, 5:] - [3, -2, 0]).sum(axis=2), [[0, 1, 0, 1, 0]] * 2)
    first_steps = walk(1.0, (0, 0, 0), steps=1, runs=60)[:, 1]
    assert len(np.unique(first_steps, axis=0)) == 6  # at its goal it steps at random


def test_the_way_to_a_goal_is_along_the_axis_on_which_it_is_furthest():
    to_goals = np.array([[5, -3, 4], [1, -9, 4], [0, 0, -1], [-np.inf, 9, 9], [2, 2, 0]])
    np.testing.assert_array_equal(walks.DIRECTIONS[walks._towards(to_goals)],
                                  [[1, 0, 0], [0, -1, 0], [0, 0, -1], [-1, 0, 0], [1, 0, 0]])


@pytest.mark.parametrize("goal", [FAR, (40, 10, 0)])
def test_a_walk_is_the_same_alone_or_among_others(goal):
    np.testing.assert_array_equal(walk(0.2, goal, 300, runs=3)[:2], walk(0.2, goal, 300, runs=2))
    assert (walk(0.2, goal, 300, 1, seed=1) != walk(0.2, goal, 300, 1)).any()


@pytest.mark.parametrize("change, message", [
    ({"strength": 1.1}, "strength must be .*, but is 1.1"), ({"goal": (1, 2)}, "goal is"),
    ({"goal": (1, 2, np.nan)}, "goal is"),
    ({"steps": 0}, "steps must be .*, but is 0"), ({"runs": 0}, "runs must be .*, but is 0"),
    ({"seed": -1}, "seed must be .*, but is -1"),
])
def test_a_bad_walk_is_refused(change, message):
    with pytest.raises(ValueError, match=message):
        walk(**{"strength": 0.1, "goal": FAR, "steps": 5, "runs": 1, **change})


def test_a_series_is_the_sum_of_its_parts_and_its_noise_is_filtered():
    series, parts = wold.generate([0.6, 0.3], 2.0, 25.0, steps=500)
    np.testing.assert_allclose(series[wold.PAST:], parts.deterministic + parts.stochastic)
    noise = parts.innovations
    np.testing.assert_allclose(parts.stochastic[2:], noise[2:] + 0.6 * noise[1:-1] + 0.3 * noise[:-2])
    np.testing.assert_allclose(parts.deterministic[25:], parts.deterministic[:-25])
    assert np.ptp(parts.deterministic) == pytest.approx(4.0, rel=0.01)


def test_the_phase_of_the_oscillation_is_random():
    first = [wold.generate([0.5], 1.0, 20.0, 100, run)[1].deterministic[0] for run in range(200)]
    assert abs(np.mean(first)) < 0.15 and np.std(first) == pytest.approx(0.5**0.5, abs=0.05)


def test_the_parts_of_a_series_are_found_and_the_better_the_longer_it_is():
    errors = []
    for steps in (500, 50_000):
        of_runs = []
        for run in range(5):
            series, true = wold.generate([0.6, 0.3], 1.0, 37.3, steps, run)
            found = wold.decompose(series, order=2)
            np.testing.assert_allclose(found.deterministic + found.stochastic, series[wold.PAST:])
            of_runs.append([np.std(found.deterministic - true.deterministic),
                            np.std(found.innovations - true.innovations),
                            np.abs(found.coefficients - true.coefficients).max()])
        errors.append(np.mean(of_runs, axis=0))
    assert np.all(errors[0] < [0.3, 0.4, 0.15])
    assert np.all(errors[1] < 0.2 * errors[0])  # a tenth is to be expected


def test_errors_are_those_of_each_run_by_length(monkeypatch):
    true = wold.Parts(np.zeros(4), np.zeros(4), np.zeros(4), np.array([0.6, 0.3]))
    found = wold.Parts(np.full(4, 2.0), np.zeros(4), np.array([1.0, -1, 1, -1]), np.array([0.5, 0.7]))
    lived = []
    monkeypatch.setattr(wold, "generate", lambda *chosen: (lived.append(chosen), true))
    monkeypatch.setattr(wold, "decompose", lambda series, order: found)
    errors = wold.errors([0.6, 0.3], period=20.0, longest=1_000, runs=2, seed=7)
    assert list(errors) == [300, 1_000] and lived[-1] == ([0.6, 0.3], 1.0, 20.0, 1_000, 1, 7)
    np.testing.assert_allclose(errors[300], [[2, 2], [1, 1], [0.4, 0.4]])


def test_the_coefficients_of_an_autoregression_are_the_powers_of_its_own():
    """x_t = 0.5 x_t−1 + y_t is y_t + 0.5 y_t−1 + 0.25 y_t−2 + …; the oscillation found in it is nearly zero."""
    noise = np.random.default_rng(0).normal(size=40_000)
    series = np.zeros_like(noise)
    for t in range(1, len(series)):
        series[t] = 0.5 * series[t - 1] + noise[t]
    np.testing.assert_allclose(wold.decompose(series, 3).coefficients, [0.5, 0.25, 0.125], atol=0.02)


@pytest.mark.parametrize("series, order, message", [
    (np.zeros((2, 90)), 2, "series has the shape"), (np.zeros(40), 2, "series has the shape"),
    (np.full(90, np.nan), 2, r"series must be finite numbers from -1e\+30 to 1e\+30,"),
    (np.zeros(90), 0, "order must be .*, but is 0"),
])
def test_a_decomposition_refuses_what_it_cannot_take_apart(series, order, message):
    with pytest.raises(ValueError, match=message):
        wold.decompose(series, order)


@pytest.mark.parametrize("change, message", [
    ({"coefficients": [np.inf]}, "coefficients must be"), ({"amplitude": -1}, "amplitude must be .*, but is -1"),
    ({"period": 1}, "period"),
    ({"steps": 40}, "steps must be .*, but is 40"), ({"run": -1}, "run must be .*, but is -1"),
    ({"seed": -1}, "seed must be .*, but is -1"),
])
def test_a_bad_series_is_refused(change, message):
    with pytest.raises(ValueError, match=message):
        wold.generate(**{"coefficients": [0.5], "amplitude": 1.0, "period": 20.0, "steps": 100, **change})
