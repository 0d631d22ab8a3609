"""The page on alternatives: its learners, controllers and stored runs."""

from itertools import product

import numpy as np
import pytest
from page_cells import assert_captions_end_with_numbers_of_their_figures, executed

from companion.alternatives import contestants, controllers, contests, search, tabular_learners
from companion.alternatives.contestants import BROWNIAN, of_thesis
from companion.alternatives.contests import BOARDS, Earned
from companion.page import beginning
from neorl import Run, WaterWorld, brownian, forager, place_cells, simulate
from neorl.core.stream import new_stream
from neorl.kernels.annotations import arrays
from neorl.kernels.execution import execute
from neorl.worlds.waterworld import GREEN, RED

SETTINGS = search.best_settings()
GAINS = SETTINGS["PD"]
AGENTS = {"Brownian motion": brownian(), "forager": forager(),
          **of_thesis()}
LONG = [row for row in contests.read() if row.steps == 600_000]


def stream(number=0):
    return new_stream(np.random.SeedSequence(number))


def tank(*creeps, width=250):
    """A state with the agent at rest in the middle and motionless creeps: (x, y, kind), in widths from the agent."""
    state = WaterWorld(width=width, n_creeps=len(creeps)).reset(0)
    for thing, (x, y, kind) in enumerate(creeps):
        state.scene.things[thing] = state.scene.position + np.array([x, y]) * width
        state.scene.kinds[thing], state.speed[thing] = kind, 0.0
    return state


def act(contestant, state, memory=None):
    board = WaterWorld(n_creeps=len(state.speed))
    memory = contestant.new_memory(board, stream()) if memory is None else memory
    return execute(contestant.act, contestant.setting, memory, state, board.rules), memory


@pytest.mark.parametrize("name", tabular_learners.TABULAR)
def test_a_run_is_the_same_among_any_number_of_runs_and_learns(name):
    contestant = tabular_learners.TABULAR[name](SETTINGS[name])
    three = contests.run_contestant(contestant, BOARDS[3], steps=150_000, runs=3, bins=3)
    two = contests.run_contestant(contestant, BOARDS[3], steps=150_000, runs=2, bins=3)
    assert np.array_equal(three.rewards[:2], two.rewards) and not np.array_equal(two.rewards[0], two.rewards[1])
    assert three.rewards[:, 2].mean() > three.rewards[:, 0].mean() > 0


def test_contestants_run_in_the_worlds_of_runs():
    earned = contests.run_contestant(controllers.nearest_green(), BOARDS[3], steps=50, runs=1, bins=1, seed=5)
    state, total = Run(place_cells([1]), BOARDS[3], seed=5).world_state, 0.0
    for _ in range(50):
        action, _ = act(controllers.nearest_green(), state)
        reward, _, done = BOARDS[3].step(state, int(action))
        total += reward
        if done:
            execute(BOARDS[3].dynamics.reset, state, BOARDS[3].rules)
    assert earned.rewards[0, 0] == total


def test_a_contact_teaches_the_head_of_its_creep_alone():
    setting = SETTINGS["hybrid reward"]._replace(first=0.0, exploration=0.0)
    contestant = tabular_learners.hybrid_reward(setting)
    state = tank((0.02, 0.0, GREEN), (0.3, 0.3, RED))
    action, memory = act(contestant, state)
    rows = memory.rows.copy()
    state.scene.met[:] = 1 + GREEN, 0
    execute(contestant.learn, setting, memory, state, BOARDS[3].rules, action, 1.0, False)
    assert memory.table[rows[0], action] == setting.learning_rate
    assert np.count_nonzero(memory.table) == 1


def test_successor_features_learn_what_contacts_are_worth_and_count_them():
    setting = SETTINGS["successor features"]._replace(first=0.0, exploration=0.0, discount=0.0, learning_rate=0.5)
    contestant = tabular_learners.successor_features(setting)
    state = tank((0.02, 0.0, GREEN), (0.3, 0.3, RED))
    action, memory = act(contestant, state)
    for kind, reward in ((GREEN, 1.0), (RED, -1.0)):
        state.scene.met[:] = 1 + kind, 0
        for _ in range(100):
            execute(contestant.learn, setting, memory, state, BOARDS[3].rules, action, reward, False)
    assert memory.weights == pytest.approx([1, -1], abs=1e-3)
    seen = memory.table[memory.rows[0]].reshape(3, tabular_learners.ACTIONS, 2)[:, action]
    assert seen == pytest.approx(np.array([[0, 1]] * 3))


def test_the_planner_does_not_know_creeps_to_come_and_leaves_the_world_unchanged():
    state = BOARDS[8].reset(3)
    before = {name: each.copy() for name, each in arrays(state).items()}
    action, _ = act(controllers.planner(GAINS), state)
    assert all(np.array_equal(each, before[name]) for name, each in arrays(state).items())
    state.stream[:] = stream(9)
    assert act(controllers.planner(GAINS), state)[0] == action


def test_controllers_that_know_more_earn_more():
    rates = [contests.run_contestant(each, BOARDS[3], steps=6_000, runs=4, bins=1).rewards.mean() / 120
             for each in (controllers.nearest_green(), controllers.pd(GAINS), controllers.planner(GAINS))]
    assert 1.5 < rates[0] < rates[1] < rates[2] < 5


@pytest.mark.parametrize("method", search.RANGES)
def test_the_stored_search_is_what_the_script_finds(method):
    rates = search.rates()[method]
    assert len(rates) == search.SETTINGS
    assert search.evaluate(method, int(np.argmax(rates))) == pytest.approx(max(rates), abs=1e-4)


@pytest.mark.parametrize("name, creeps", [("hybrid reward", 3), ("monolithic", 8)])
def test_the_stored_long_runs_are_those_of_learners(name, creeps):
    row = next(row for row in LONG if row[:4] == (name, creeps, 600_000, 1))
    contestant = tabular_learners.TABULAR[name](SETTINGS[name])
    earned = contests.run_contestant(contestant, BOARDS[creeps], steps=30_000, runs=2, bins=10)
    assert np.array_equal(earned.rewards[1], row.rewards[:10])
    assert earned.kilobytes == pytest.approx(row.kilobytes, rel=1e-3)


@pytest.mark.parametrize("name", AGENTS)
def test_the_stored_long_runs_are_those_of_agents(name):
    earned = contests.of_result(simulate(AGENTS[name], BOARDS[3], steps=30_000, runs=10, progress=False), bins=10)
    rows = [next(row for row in LONG if row[:4] == (name, 3, 600_000, run)) for run in range(10)]
    assert np.array_equal(earned.rewards, [row.rewards[:10] for row in rows])
    assert earned.kilobytes == pytest.approx(rows[0].kilobytes, rel=1e-3)


def test_every_run_is_stored_once_and_deep_learners_have_three_long_ones_on_each_board():
    rows = contests.read()
    assert len({(row.method, row.creeps, row.run) for row in rows}) == len(rows)
    assert all(len(row.rewards) == row.steps // contests.MINUTE for row in rows)
    long = [row[:2] + row[3:4] for row in LONG if row.method in search.DEEP]
    assert set(long) == {*product(search.DEEP, (3, 8), range(3))}


@pytest.mark.deep
@pytest.mark.parametrize("method", search.DEEP)
def test_a_short_rerun_of_a_deep_learner_equals_the_start_of_its_stored_run(method):
    from companion.alternatives.deep_runs import train
    row = next(row for row in LONG if row[:4] == (method, 3, 600_000, 2))
    rewards, _, _ = train(method, SETTINGS[method], BOARDS[3], 6_000, 0, 2)
    assert np.array_equal(rewards, row.rewards[:2])


@pytest.mark.deep
@pytest.mark.parametrize("method", search.WITH_DEFAULTS)
def test_stored_runs_with_defaults_have_those_of_the_library_on_the_board_of_paper_a(method):
    from companion.alternatives.deep_runs import row_of
    row = next(row for row in contests.read(contests.DEFAULTS) if (row.method, row.run) == (method, 1))
    again = row_of(method, {}, contests.PAPER_A, 6_000, 1)
    assert np.array_equal(again.rewards, row.rewards[:2]) and f"{again.kilobytes:.4g}" == f"{row.kilobytes:.4g}"


def test_runs_with_defaults_are_stored_as_claim_a10_wants_them():
    from companion.alternatives.deep_runs import DEFAULT_RUNS
    rows = {row[:4]: row for row in contests.read(contests.DEFAULTS)}
    assert rows.keys() == {*product(search.WITH_DEFAULTS, (8,), (150_000,), range(DEFAULT_RUNS))}
    assert {len(row.rewards) for row in rows.values()} == {150_000 // contests.MINUTE}
    assert contests.PAPER_A == WaterWorld(n_creeps=8, win_reward=5.0, fps=50)


def test_deep_learners_see_how_fast_creeps_move_nearest_first():
    from companion.alternatives.deep_runs import FASTEST_CREEP, Sight, gymnasium
    env = Sight(gymnasium.make("neorl.gym:neorl/WaterWorld-v0", n_creeps=3, max_episode_steps=-1), 6_000, 0, 1, 3.0)
    observation, _ = env.reset(seed=12345)
    state = env.unwrapped.world_state
    assert np.array_equal(state.scene.things, Run(place_cells([1]), BOARDS[3], 0, 1).world_state.scene.things)
    for action in (0, 2, 2, 2, 1):
        observation, reward, *_ = env.step(action)
    nearest = np.argmin(((state.scene.things - state.scene.position) ** 2).sum(axis=1))
    velocity = state.direction[nearest] * state.speed[nearest] / 250 / FASTEST_CREEP
    assert observation[4:6] == pytest.approx(3 * (state.scene.things[nearest] - state.scene.position) / 250,
                                              abs=1e-6)
    assert observation[16:18] == pytest.approx(velocity, abs=1e-6)
    assert env.observation_space.contains(observation) and env.rewards.shape == (2,)


def test_rates_lie_between_steps_and_levels_are_reached_by_means():
    rising = 2.0 * np.minimum(np.arange(1, 31) / 20, 1)[None]  # per second, level after two thirds of the run
    each = Earned(rising * 150_000 / 30 / 50, 150_000, 1e-6, 1.0)
    assert each.rate(2 / 3) == pytest.approx([2.0]) and each.rate(0, 1 / 60) == pytest.approx([0.1])
    assert each.rates[0, :2] == pytest.approx([0.1, 0.2])
    assert each.steps_to(1.05) == pytest.approx([60_000])  # bins of 1.0, 1.1 and 1.2
    assert np.isinf(each.steps_to(2.5)).all()


@pytest.mark.parametrize("page, judged", [
    ({}, {"C5": False, "A10": False}), ({"n_creeps": 5}, {"C5": False, "A10": False})])
def test_claims_are_judged_whatever_the_second_board(page, judged):
    assert {claim.name: claim.full_length for claim in executed("alternatives", **page).judged} == judged


def test_claims_are_judged_only_of_the_page_s_own_contestants(monkeypatch):
    page = executed("alternatives")
    assert_captions_end_with_numbers_of_their_figures(page)
    results = {creeps: dict(of_board) for creeps, of_board in page.results.items()}
    results[3]["network D, calibrated"] = results[3]["forager"]
    assert [claim.name for claim in contestants.judge(results, page.boards, page.control)] == ["A10"]
    assert [claim.name for claim in contestants.judge(page.results, page.boards, page.results[8][BROWNIAN])] == ["C5"]
    monkeypatch.setattr(contestants, "best_settings", lambda: SETTINGS | {"monolithic": SETTINGS["joint cells"]})
    assert [claim.name for claim in contestants.judge(page.results, page.boards, page.control)] == ["A10"]


def test_claim_a10_compares_untuned_learners_with_brownian_motion_on_the_board_of_paper_a():
    control = simulate(brownian(), contests.PAPER_A, steps=150_000, runs=10, progress=False)
    (claim,) = contestants.untrained(control)
    first = contests.stored(contests.read(contests.DEFAULTS), search.WITH_DEFAULTS, 8, 150_000)
    assert {what: found.value for what, (found, *_) in claim.numbers.items() if what.startswith("score")} == {
        **{f"score, {name}": pytest.approx(each.rewards.sum(axis=1).mean()) for name, each in first.items()},
        f"score, {BROWNIAN}": pytest.approx(control.totals.mean())}
    assert claim.full_length and claim.runs == 10


def test_a_run_and_the_stored_ones_last_the_same_whole_minutes(tmp_path):
    page = executed("alternatives", steps=8_999, keep=str(tmp_path / "kept.csv"))
    steps = {name: each.steps for of_board in page.boards.values() for name, each in of_board.items()}
    assert {*steps.values()} == {200, 6_000} and [name for name in steps if steps[name] == 200] == ["planner"]
    kept = contests.read(tmp_path / "kept.csv")
    assert {len(row.rewards) for row in kept} == {2} and len(kept) == 2 * 2 * (6 + 4)


def test_the_reward_of_a_minute_is_the_sum_of_its_parts():
    each = Earned(np.arange(2.0 * contests.bins_of(9_000)).reshape(2, -1), 9_000, 1e-6, 1.0)
    assert each.rewards.shape == (2, 51) and each.of_minutes[0].tolist() == [sum(range(17)), sum(range(17, 34)),
                                                                            sum(range(34, 51))]


@pytest.mark.parametrize("keep", ["none/kept.csv", "."])
def test_a_file_to_keep_is_checked_before_anything_runs(keep):
    with pytest.raises(ValueError, match=f"keep must be a file in a folder that exists, but is '{keep}'"):
        beginning.begin(keep=keep)
