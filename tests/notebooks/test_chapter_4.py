"""The page of chapter 4: its experiment, and its toy systems against closed forms and second implementations."""

import itertools
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from page_cells import assert_captions_end_with_numbers_of_their_figures, executed

from companion.chapter_4 import drivers, noise, superposition
from companion.chapter_4.credit import DEFAULT, INVERSION, Chamber, learn_in
from companion.chapter_4.noise import expected_squared_displacement, mean_squared_displacement, walk
from companion.chapter_4.superposition import fit_ridges, plan
from companion.shared.grid import Grid
from neorl.agents.rules import CALIBRATED
from neorl.core.stream import new_stream, randint, uniform
from neorl.kernels.execution import execute
from companion.thesis.reading import READINGS, conditions

FAR = (np.inf, 0, 0)
SIDE = np.linspace(-1, 1, 31)
X, Y = np.meshgrid(SIDE, SIDE)
N5 = Grid((".....",) * 5)
QUICK = replace(INVERSION, learning_rate=0.3)


@pytest.mark.parametrize("name", READINGS)
def test_agents_differ_in_their_temporal_driver_alone(name):
    reading = READINGS[name]
    page = executed("chapter_4", until="judging" if name == "calibrated" else None, reading=name)
    made = conditions(reading, 1_000, 2, groups=["layers", "modal"])
    for which, (key, chance) in drivers.AGENTS.items():
        ran = {driver: result.condition for driver, result in page.results[which].items()}
        assert ran["changes of cell"] == made[key]
        assert (ran["Brownian motion"].agent, ran["Brownian motion"].world) == (made[chance].agent, made[chance].world)
        for stay, condition in drivers.at_every_step(ran).items():
            rule = reading.varied(credit="step", discount=reading.learning.discount ** (1 / stay))
            assert condition == conditions(rule, 1_000, 2, groups=["layers", "modal"])[key]
            assert condition.agent.learning.update_on == "step"
    assert [claim.name for claim in page.judged] == ["T7"] and not page.judged[0].full_length
    if name == "letter":  # run to the end
        assert_captions_end_with_numbers_of_their_figures(page, ["cell-26", "cell-45", "cell-04"])


@pytest.mark.parametrize("parameters, changes, judged", [
    ({"stays": (1, 2, 10, 50)}, (("run = neorl.Run(multimodal()", "run = neorl.Run(place_cells([3])"),), ["T7"]),
    ({"stays": (999, 1_000)}, (("n_creeps=8 if", "n_creeps=5 if"),), ["T5"])])
def test_only_agents_and_stays_of_the_thesis_are_judged(parameters, changes, judged, monkeypatch):
    monkeypatch.setattr(drivers, "STEPS", 500)  # an agent's experience, and the length of runs, that give verdicts
    page = executed("chapter_4", changes, **parameters)
    assert [(claim.name, claim.full_length) for claim in [*page.t5, *page.judged]] == [(name, True) for name in judged]
    assert list(drivers.at_every_step(page.results["both"])) == [*page.stays]


class Clock:
    """A clock that advances only by sleep and work; only work uses the processor."""

    now, used, step = 100.0, 7.0, 0

    def monotonic(self):
        return self.now

    def process_time(self):
        return self.used

    def sleep(self, seconds):
        assert seconds >= 0
        self.now += seconds

    perf_counter = monotonic


@pytest.fixture
def keep_pace(monkeypatch):
    """Load and delay of a run in real time whose k-th step takes `seconds[k]`, and later ones as long as the last."""
    def keep_pace(seconds, windows):
        clock = Clock()

        def advance(steps):
            worked = seconds[min(clock.step, len(seconds) - 1)]
            clock.now, clock.used, clock.step = clock.now + worked, clock.used + worked, clock.step + 1

        in_real_time = executed("chapter_4", until=None, reading="letter").in_real_time
        monkeypatch.setitem(in_real_time.__globals__, "time", clock)
        return in_real_time(SimpleNamespace(advance=advance), windows, 35)

    return keep_pace


def test_a_slow_step_makes_those_after_it_late_until_they_have_caught_up(keep_pace):
    load, delay = keep_pace([0.005, 0.05, 0.005], windows=1)
    np.testing.assert_allclose(delay[0, :5], [0.25, 2.5, 1.75, 1.0, 0.25])
    np.testing.assert_allclose(load, (34 * 0.005 + 0.05) / 0.7)
    load, delay = keep_pace([0.04], windows=2)
    np.testing.assert_allclose(load, 1.0)
    np.testing.assert_allclose(np.diff(delay.ravel()), 1.0)


def test_a_walk_goes_one_unit_a_step_in_six_equally_likely_directions():
    paths = walk(0.0, (3, 3, 3), steps=20_000, runs=3)
    steps = np.diff(paths, axis=1).reshape(-1, 3)
    assert paths.shape == (3, 20_001, 3) and not paths[:, 0].any()
    directions, counts = np.unique(steps, axis=0, return_counts=True)
    assert len(directions) == 6 and np.all(np.abs(directions).sum(axis=1) == 1)
    np.testing.assert_allclose(counts / len(steps), 1 / 6, atol=0.006)


@pytest.mark.parametrize("strength", [0.0, 0.1, 1.0])
def test_walks_spread_as_diffusion_and_drift_foretell(strength):
    lags = np.array([1, 10, 100])
    squared = mean_squared_displacement(walk(strength, FAR, steps=5_000, runs=60), lags)
    np.testing.assert_allclose(squared.mean(axis=0), expected_squared_displacement(strength, lags), rtol=0.06)


def test_displacements_are_those_counted_by_hand():
    path = np.array([[[0, 0, 0], [1, 0, 0], [1, 1, 0], [1, 1, -1]]])
    np.testing.assert_allclose(mean_squared_displacement(path, [1, 2, 3]), [[1, 2, 3]])
    straight = np.arange(100_001, dtype=np.int32)[None, :, None] * np.array([1, 0, 0], np.int32)
    assert mean_squared_displacement(straight, [100_000])[0, 0] == 1e10


def test_a_walker_that_is_always_biased_goes_to_its_goal_and_wanders_about_it():
    paths = walk(1.0, (3, -2, 0), steps=9, runs=2)
    np.testing.assert_array_equal(paths[:, 2], [[2, 0, 0]] * 2)  # first along the axis on which it is furthest
    np.testing.assert_array_equal(paths[:, 5], [[3, -2, 0]] * 2)
    np.testing.assert_array_equal(np.abs(paths[:, 5:] - [3, -2, 0]).sum(axis=2), [[0, 1, 0, 1, 0]] * 2)
    assert len(np.unique(walk(1.0, (0, 0, 0), steps=1, runs=60)[:, 1], axis=0)) == 6  # at its goal it draws
    np.testing.assert_array_equal(walk(0.2, (40, 10, 0), 300, runs=3)[:2], walk(0.2, (40, 10, 0), 300, runs=2))


def test_a_series_is_the_sum_of_its_parts_and_its_noise_is_filtered():
    series, parts = noise.generate([0.6, 0.3], 2.0, 25.0, steps=500)
    np.testing.assert_allclose(series[noise.PAST:], parts.deterministic + parts.stochastic)
    drawn = parts.innovations
    np.testing.assert_allclose(parts.stochastic[2:], drawn[2:] + 0.6 * drawn[1:-1] + 0.3 * drawn[:-2])
    np.testing.assert_allclose(parts.deterministic[25:], parts.deterministic[:-25])
    assert np.ptp(parts.deterministic) == pytest.approx(4.0, rel=0.01)
    first = [noise.generate([0.5], 1.0, 20.0, 100, run)[1].deterministic[0] for run in range(200)]
    assert abs(np.mean(first)) < 0.15 and np.std(first) == pytest.approx(0.5**0.5, abs=0.05)


def test_the_parts_of_a_series_are_recovered_and_the_better_the_longer_it_is():
    errors = {300: [], 30_000: []}
    for length, run in itertools.product(errors, range(5)):
        series, true = noise.generate([0.6, 0.3], 1.0, 37.3, length, run)
        parts = noise.decompose(series)
        np.testing.assert_allclose(parts.deterministic + parts.stochastic, series[noise.PAST:])
        errors[length].append([np.std(part - drawn) for part, drawn in zip(parts, true)])
    short, long = (np.mean(each, axis=0) for each in errors.values())
    assert np.all(short < 0.5) and np.all(long < 0.2 * short)  # a tenth is to be expected


def test_a_product_is_the_sum_of_two_ridges():
    errors = fit_ridges(X * Y, terms=2)
    assert errors[0] == 1 and errors[1] > 0.3 and errors[2] < 1e-9


def test_ridges_are_fitted_jointly_each_at_the_angle_that_explains_most_of_the_residual():
    values = np.exp(-3 * ((X - 0.4) ** 2 + (Y + 0.1) ** 2)).ravel()
    bases = [np.vander((X * np.cos(angle) + Y * np.sin(angle)).ravel(), 11) for angle in superposition.ANGLES]
    residual, chosen, errors = values - values.mean(), [], [1]
    for _ in range(3):
        chosen.append(max(bases, key=lambda basis: np.linalg.norm(basis @ np.linalg.lstsq(basis, residual)[0])))
        basis = np.hstack(chosen)
        residual = values - basis @ np.linalg.lstsq(basis, values)[0]
        errors.append(residual.std() / values.std())
    np.testing.assert_allclose(fit_ridges(values.reshape(X.shape), terms=3), errors, rtol=1e-5)


def test_the_value_of_a_single_goal_falls_by_the_discount_with_each_step():
    goal = 7
    q = plan(N5, np.eye(25)[goal], discount=0.8)
    distance = np.abs(N5.places - N5.places[goal]).sum(axis=1)
    away = distance > 0
    np.testing.assert_allclose(q.max(axis=1)[away], 0.8 ** (distance[away] - 1) / (1 - 0.8**2))
    assert q[goal].max() == pytest.approx(0.8 / (1 - 0.8**2))  # out and in again
    assert plan(N5, np.eye(25)[0], 0.5)[0, 0] == pytest.approx(0.5 * plan(N5, np.eye(25)[0], 0.5)[0].max())  # a wall


def test_the_best_values_are_those_of_the_best_of_all_policies():
    corridor = Grid(("...",))
    rewards = np.array([1.0, -0.5, 0.3])
    best = np.max([superposition.evaluate(corridor, np.eye(4)[list(policy)], rewards)
                   for policy in itertools.product(range(4), repeat=3)], axis=0)
    np.testing.assert_allclose(plan(corridor, rewards).max(axis=1), best)


def test_values_of_a_policy_add_up_over_rewards_and_optimal_values_do_not():
    policy = np.full((25, 4), 0.25)
    rewards = np.eye(25)[[0, 4, 12]]
    alone = superposition.evaluate(N5, np.stack([policy] * 3), rewards)
    np.testing.assert_allclose(alone.sum(axis=0), superposition.evaluate(N5, policy, rewards.sum(axis=0)))
    sums, together = plan(N5, rewards).sum(axis=0), plan(N5, rewards.sum(axis=0))
    assert np.all(sums >= together - 1e-9) and (sums - together).max() > 0.5


def test_a_sum_misleads_where_one_of_its_best_actions_is_not_best_by_the_plan():
    planned = np.array([[1.0, 1, 0, 0]] * 4)
    added = np.array([[1.0, 1 - 1e-12, 0, 0], [1, 0, 0, 0], [0, 1, 1, 0], [0, 0, 1, 0]])
    assert superposition.best_actions(added).sum(axis=1).tolist() == [2, 1, 2, 1]
    assert superposition.misled(added, planned, elements=[3]) == [2]
    assert superposition.misled(added, planned, elements={}) == [2, 3]


def test_a_comparison_is_of_the_returns_of_superposed_and_planned_actions():
    comparison = superposition.compare(N5, [1, 1, 1, -1], placements=1, seed=5, discount=0.7)
    states = np.random.default_rng(5).choice(25, 4, replace=False)
    rewards = np.zeros(25)
    rewards[states] = 1, 1, 1, -1
    sums = sum(reward * plan(N5, goal, 0.7) for reward, goal in zip(rewards, np.eye(25)))
    best = plan(N5, rewards, 0.7)
    outside = [state for state in range(25) if state not in states]
    followed = superposition.evaluate(N5, superposition.greedy(sums), rewards, 0.7)[outside].sum()
    assert comparison.achieved[0] == pytest.approx(followed / best.max(axis=1)[outside].sum())


def test_cosines_are_those_of_the_angles():
    half = 0.5**0.5
    found = superposition.cosines(np.array([[1.0, 0], [0, 2], [3, 3], [0, 0]]))
    np.testing.assert_allclose(found, [[1, 0, half, 0], [0, 1, half, 0], [half, half, 1, 0], [0] * 4], atol=1e-12)


def restated(chamber, learning, visits, seed=0, run=0):
    """The values of one run of `learn_in` in plain Python, bout by bout and visit by visit: (visits, 4, 2)."""
    stream = new_stream(np.random.SeedSequence(seed, spawn_key=(run,)))
    q, over, values = np.zeros((4, 2)), True, []
    for _ in range(visits):
        seen, opened = [], None
        while opened is None or len(seen) <= opened[1] + chamber.delay:
            if over:
                lever = execute(randint, stream, 2)
                on = [lever == 0, lever == 1, execute(uniform, stream) < chamber.light,
                      execute(uniform, stream) < chamber.bell]
            seen.append(np.array(on, float))
            over = execute(uniform, stream) < 1 / chamber.hold
            if opened is None and sum(seen)[lever] >= chamber.effort:
                opened = lever, len(seen) - 1
        goal = np.eye(2)[opened[0]]
        if learning.update_on == "step":
            for events in seen[:-1]:
                q += learning.learning_rate * events[:, None] * (learning.discount * q.max(axis=0) - q)
            q += learning.learning_rate * seen[-1][:, None] * (goal - q)
        else:
            times = sum(seen)
            psi = {"share": times / len(seen), "happened": times > 0, "last": seen[-1],
                   "count": times}[learning.credit]
            psi = psi[:, None].astype(float)
            learns = 1.0 if learning.bootstrap else goal
            rate = learning.learning_rate * np.where(psi > 0, psi, learning.absent_decay) * learns
            away = -rate * (goal - q) if learning.absent_form == "away" else -rate * q
            q = np.clip(q + np.where(psi > 0, np.minimum(rate, 1) * (goal - q), away), 0, 1)
        values.append(q.copy())
    return np.array(values)


@pytest.mark.parametrize("chamber", [Chamber(), Chamber(effort=3, hold=2.0, light=0.9), Chamber(delay=7, hold=4.0)])
@pytest.mark.parametrize("learning", [QUICK, replace(QUICK, credit="happened"), replace(QUICK, credit="last"),
                                      replace(QUICK, absent_decay=0.5), replace(QUICK, credit="count"),
                                      replace(QUICK, absent_decay=0.5, absent_form="away"),
                                      replace(QUICK, absent_decay=0.5, bootstrap=False),
                                      replace(DEFAULT, learning_rate=0.3),
                                      replace(QUICK, discount=0.9, update_on="step")])
@pytest.mark.filterwarnings("ignore:overflow encountered")
def test_the_kernel_does_what_the_rules_say(chamber, learning):
    values = learn_in(chamber, learning, visits=20, runs=2, seed=5)
    np.testing.assert_allclose(values[1], restated(chamber, learning, 20, seed=5, run=1), atol=2e-5)


def test_the_rule_of_the_agents_remembers_no_earlier_cell_when_put_back():
    assert replace(DEFAULT, learning_rate=CALIBRATED.learning_rate, discount=CALIBRATED.discount) == CALIBRATED
    learned = [learn_in(Chamber(), replace(DEFAULT, memory=memory), 30, runs) for memory, runs in ((0.0, 2), (5.0, 3))]
    np.testing.assert_array_equal(learned[0], learned[1][:2])
