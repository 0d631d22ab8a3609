"""What the rules measure, on made-up runs with a known answer, and how often its intervals hold."""

from dataclasses import replace

import numpy as np
import pytest
from scipy import stats

from companion.thesis.measures import (evenness, later, learning_minutes, lead_over_sum, least, minutes_sooner,
                                       minutes_to_own_level, rank_correlation, share_of_lead, widened)
from neorl import Condition, Result, WaterWorld, place_cells
from neorl.statistics import Estimate
from neorl.statistics import difference, estimate, quotient


def result_of(rewards):
    """A `Result` of runs that earn `rewards` per second, (runs, bins)."""
    rewards = np.asarray(rewards, np.float32) * np.float32(0.2)
    runs, bins = rewards.shape
    return Result(Condition(place_cells([1]), WaterWorld(), 10 * bins, runs), rewards,
                  np.zeros((runs, bins, 2), np.int16))


def steps_up(at, runs=10, height=1.0):
    """Runs of 80 s that earn nothing at first, and `height` per second from the bin `at` of 400 on."""
    return result_of(np.tile(np.where(np.arange(400) < at, 0.0, height), (runs, 1)))


def test_the_mean_reaches_a_level_later_than_the_luckiest_run():
    """Half of the runs are lucky once, early; the mean only reaches its final level when all have learned."""
    rewards = np.full((10, 400), 0.05)
    rewards[:5, 20:30], rewards[:, 200:] = 1.0, 1.0
    found = minutes_to_own_level(result_of(rewards))
    assert 60 * np.array(found) == pytest.approx(40, abs=0.2)
    assert minutes_to_own_level(result_of(rewards), result_of(rewards), of=later).value == 0
    assert minutes_to_own_level(result_of(-rewards)).value == np.inf  # never


def test_a_lead_in_time_is_that_of_the_mean_over_runs():
    early, late = steps_up(100), steps_up(250)
    assert minutes_sooner(early, late, 0.5) == pytest.approx([0.5] * 3)  # 150 bins of 0.2 s
    assert minutes_sooner(late, early, 0.5) == pytest.approx([-0.5] * 3)
    assert minutes_sooner(early, late, 2.0) == (0, 0, 0)  # neither reaches it
    low = steps_up(250, height=0.4)
    assert minutes_sooner(early, low, 0.5).value == pytest.approx(0.5)  # half of its own level
    assert minutes_sooner(early, low, 0.5, late).value == np.inf  # that of the best, never
    assert minutes_sooner(low, early, 0.5, late).value == -np.inf
    assert np.isnan(minutes_sooner(steps_up(1, runs=1), late, 0.5).low)


def test_a_level_is_as_uncertain_as_those_who_set_it():
    """Runs climb to levels of their own, so that the mean of others may or may not ever reach nine tenths of theirs."""
    rng = np.random.default_rng(4)
    steady = result_of(np.tile(np.linspace(0, 0.9, 400), (20, 1)))
    varied = result_of(rng.normal(0.9, 0.4, (20, 1)) * np.ones(400))
    found = minutes_sooner(steps_up(10, 20, 2.0), steady, 0.9, varied)
    assert found.low < 1.2 and found.high == np.inf  # reached late, and never
    wide = widened(found, 34)
    assert 0 < wide.low <= found.low and wide.high == np.inf
    assert (found / 2).high == found.high / 2


def test_a_lead_in_time_is_not_made_by_the_noise_of_single_runs():
    noisy = steps_up(200, runs=100)
    noisy.rewards[::10, 20:40] = 0.2  # one run in ten is lucky early
    assert minutes_sooner(noisy, steps_up(200, runs=100), 0.5).value == 0


def test_a_run_that_earns_its_final_level_from_a_time_on_has_learned_for_as_long():
    chance = np.zeros(10)
    assert learning_minutes(steps_up(100), chance=chance).value == pytest.approx(20 / 60)
    falling = result_of(np.tile(np.arange(400) < 380, (10, 1)))  # at the end
    assert learning_minutes(falling, chance=chance).value == 0
    pair = learning_minutes(steps_up(200), steps_up(100), chance=chance, of=quotient)
    assert pair == pytest.approx([2, 2, 2])
    above = learning_minutes(replace(steps_up(100), rewards=steps_up(100).rewards + 0.2), chance=chance + 1)
    assert above.value == pytest.approx(20 / 60)  # over Brownian motion


def test_shares_are_of_leads_over_chance_and_0_without_one():
    two, one, three = np.full(3, 2.0), np.ones(4), np.full(2, 3.0)
    assert share_of_lead(two, one, three, axis=-1) == 0.5 and share_of_lead(one, two, three, axis=-1) == 0
    assert share_of_lead(three, two, one, axis=-1) == 0 and lead_over_sum(three, one, one, axis=-1) == 1


def test_a_rank_correlation_is_spearmans():
    samples = [np.random.default_rng(n).normal(n / 2, 1, 8) for n in range(4)]
    expected = stats.spearmanr(np.repeat(np.arange(4), 8), np.concatenate(samples)).statistic
    assert rank_correlation(*samples, axis=-1) == pytest.approx(expected)
    assert rank_correlation(*[np.zeros(3)] * 2, axis=-1) == 0


@pytest.mark.parametrize("turned, given, expected", [
    (evenness, (2, 1.6, 4), (0.5, 0.25, 1 / 1.6)), (evenness, (0.9, 0.8, 1.5), (0.9, 1 / 1.5, 1)),
    (evenness, (0.5, 0, 0.7), (0.5, 0, 0.7))])
def test_an_interval_is_turned_with_its_number(turned, given, expected):
    assert turned(Estimate(*given)) == pytest.approx(expected)


def test_one_of_several_intervals_is_as_much_wider_as_of_a_normal_distribution():
    assert widened(Estimate(1.0, 0.0, 3.0), 1) == (1, 0, 3)
    by = stats.norm.ppf(1 - 0.05 / 5 / 2) / stats.norm.ppf(0.975)
    assert widened(Estimate(1.0, 0.0, 3.0), 5) == pytest.approx((1, 1 - by, 1 + 2 * by))


def test_the_least_of_several_leads_is_covered_as_often_as_its_interval_says():
    """Five rivals that earn alike: a bootstrap of the lead over the best of them holds in far fewer cases."""
    rng, covered, bootstrapped, trials = np.random.default_rng(1), 0, 0, 150
    for _ in range(trials):
        one, *others = rng.normal(0, 1, (6, 30))
        found = least(widened(estimate(difference, one, other), 5) for other in others)
        covered += found.low <= 0 <= found.high
        of_best = estimate(lambda a, *rest, axis: a.mean(axis) - np.max([each.mean(axis) for each in rest], axis=0),
                           one, *others)
        bootstrapped += of_best.low <= 0 <= of_best.high
    assert covered / trials >= 0.93 and bootstrapped / trials < 0.85


@pytest.mark.parametrize("runs", [10, 40])
def test_the_time_to_a_level_is_covered_and_hardly_biased(runs):
    """Runs of 80 s approach 1 with a time constant of 20 s, and so nine tenths of their final level after 42 s."""
    rng, covered, values, time = np.random.default_rng(2), 0, [], (np.arange(400) + 0.5) / 5
    curve, trials = 1 - np.exp(-time / 20), 60
    known = -20 * np.log(1 - 0.9 * curve[320:].mean())
    for _ in range(trials):
        value, low, high = minutes_to_own_level(result_of(curve + rng.normal(0, 0.6, (runs, 400))))
        covered += 60 * low <= known <= 60 * high
        values.append(60 * value)
    assert covered / trials >= 0.85 and np.mean(values) == pytest.approx(known, rel=0.06)
