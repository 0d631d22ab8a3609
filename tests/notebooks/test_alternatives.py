"""The page on alternatives: its learners, controllers, stored tables and sentences."""

import os
import re
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest
from matplotlib import pyplot as plt

from lib.alternatives import (alternatives_figures, contestants, controllers, deep_settings, living,
                                         long_runs, report, search, sight, stored, tabular_learners)
from lib.alternatives.contestants import BEYOND, CHANCE, DEEP, PHYSICS, TABLES, THESIS, Earned
from lib.alternatives.living import BOARDS
from neorl import Run, WaterWorld, place_cells
from neorl.core.kernel import arrays, execute
from neorl.core.stream import new_stream
from neorl.worlds.waterworld import GREEN, RED

SETTINGS = search.best_settings()
GAINS = SETTINGS["PD"]


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
    three = living.live(contestant, BOARDS[3], steps=150_000, runs=3, bins=3)
    two = living.live(contestant, BOARDS[3], steps=150_000, runs=2, bins=3)
    assert np.array_equal(three.rewards[:2], two.rewards) and not np.array_equal(two.rewards[0], two.rewards[1])
    assert three.rewards[:, 2].mean() > three.rewards[:, 0].mean() > 0


def test_contestants_live_in_the_worlds_of_runs():
    seen = []

    def new_memory(world, stream):
        return controllers.Nothing(np.zeros(1))

    lived = living.live(controllers.nearest_green()._replace(new_memory=new_memory), BOARDS[3], steps=50, runs=1,
                        bins=1, seed=5)
    state = Run(place_cells([1]), BOARDS[3], seed=5).world_state
    for _ in range(50):
        action, _ = act(controllers.nearest_green(), state)
        reward, _, done = BOARDS[3].step(state, int(action))
        seen.append(reward)
        if done:
            execute(BOARDS[3].dynamics.reset, state, BOARDS[3].rules)
    assert lived.rewards[0, 0] == sum(seen)


def test_the_whole_scene_as_one_state_ignores_the_order_of_creeps():
    setting = SETTINGS["monolithic"]._replace(cells=4, reach=1.0)
    creeps = [(0.2, 0.1, GREEN), (-0.3, 0.0, RED), (0.2, 0.1, RED)]
    rows = [act(tabular_learners.monolithic(setting), tank(*some))[1].rows[0]
            for some in (creeps, creeps[::-1], [*creeps[:2], (0.2, 0.1, GREEN)])]
    assert rows[0] == rows[1] != rows[2]


def test_joint_cells_see_the_nearest_of_each_kind():
    contestant = tabular_learners.joint_cells(SETTINGS["joint cells"]._replace(cells=5, reach=0.5, warped=False))
    near, far = (0.1, 0.2, GREEN), (0.4, -0.4, GREEN)
    alone, with_far, with_red = (act(contestant, tank(*some))[1].rows[0]
                                 for some in ([near], [near, far], [near, (-0.3, 0.1, RED)]))
    assert alone == with_far != with_red


@pytest.mark.parametrize("warped, cells", [(False, [0, 1, 3, 4, 4]), (True, [0, 0, 4, 4, 4])])
def test_cells_are_equal_or_grow_with_distance(warped, cells):
    setting = SETTINGS["hybrid reward"]._replace(cells=5, reach=0.5, warped=warped, speeds=1)
    contestant = tabular_learners.hybrid_reward(setting)
    rows = [act(contestant, tank((0.0, y, GREEN)))[1].rows[0] for y in (-0.49, -0.2, 0.2, 0.4, 0.6)]
    assert [row % 5 for row in rows] == cells and {row // 5 for row in rows} == {2}


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


def test_a_new_board_teaches_heads_nothing():
    setting = SETTINGS["hybrid reward"]
    contestant = tabular_learners.hybrid_reward(setting)
    action, memory = act(contestant, tank((0.2, 0.0, GREEN)))
    execute(contestant.learn, setting, memory, tank((0.1, 0.3, RED)), BOARDS[3].rules, action, 0.0, True)
    assert np.all(memory.table == setting.first)


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
    seen = memory.table[memory.rows[0]].reshape(3, sight.ACTIONS, 2)[:, action]
    assert seen == pytest.approx(np.array([[0, 1]] * 3))


@pytest.mark.parametrize("creep, action", [((0.3, 0.1, GREEN), 2), ((-0.3, 0.1, GREEN), 3), ((0.1, 0.3, GREEN), 1),
                                           ((0.1, -0.3, GREEN), 0)])
def test_controllers_go_for_green_creeps(creep, action):
    for contestant in (controllers.nearest_green(), controllers.pd(GAINS), controllers.planner(GAINS)):
        assert act(contestant, tank(creep))[0] == action


def test_pd_keeps_away_from_red_creeps():
    assert act(controllers.pd(GAINS), tank((0.12, 0.0, RED)))[0] == 3


def test_the_planner_does_not_know_creeps_to_come_and_leaves_the_world_unchanged():
    state = BOARDS[8].reset(3)
    before = {name: each.copy() for name, each in arrays(state).items()}
    action, _ = act(controllers.planner(GAINS), state)
    assert all(np.array_equal(each, before[name]) for name, each in arrays(state).items())
    state.stream[:] = stream(9)
    assert act(controllers.planner(GAINS), state)[0] == action


def test_controllers_that_know_more_earn_more():
    rates = [living.live(each, BOARDS[3], steps=6_000, runs=4, bins=1).rewards.mean() / 120
             for each in (controllers.nearest_green(), controllers.pd(GAINS), controllers.planner(GAINS))]
    assert 1.5 < rates[0] < rates[1] < rates[2] < 5


def test_the_same_bits_without_the_compiler():
    program = ("from lib.alternatives import contestants\n"
               "contestants.BINS = 5\n"
               "for name, each in contestants.of_kernels(3, 150, 1, seed=2).items():\n"
               "    print(name, each.rewards.tolist())\n")
    outputs = [subprocess.run([sys.executable, "-c", program], env=os.environ | {"NUMBA_DISABLE_JIT": off}, text=True,
                              capture_output=True, check=True).stdout for off in "01"]
    assert outputs[0] == outputs[1] and "1.0" in outputs[0]


@pytest.mark.parametrize("method", search.RANGES)
def test_the_stored_search_is_what_the_script_finds(method):
    rows = {row["number"]: row["rate"] for row in stored.read_search(stored.FOLDER / "search.csv")
            if row["method"] == method}
    assert sorted(rows) == list(range(search.SETTINGS))
    best = stored.chosen(stored.read_search(stored.FOLDER / "search.csv"))[method]
    assert search.evaluate(method, best) == pytest.approx(rows[best], abs=1e-4) and rows[best] == max(rows.values())


def test_the_search_draws_within_its_ranges():
    for number in range(20):
        drawn = search.setting_of("hybrid reward", number)
        assert drawn.cells in search.RANGES["hybrid reward"]["cells"] and 0.01 <= drawn.learning_rate <= 0.5
    assert search.setting_of("PD", 3) == search.setting_of("PD", 3) != search.setting_of("PD", 4)


@pytest.mark.parametrize("name, creeps", [("hybrid reward", 3), ("monolithic", 8), ("PC + OVC, calibrated", 3),
                                          ("Brownian motion", 8)])
def test_the_stored_long_runs_are_those_of_the_script(name, creeps):
    rows = [row for row in stored.read_runs(stored.FOLDER / "long_runs.csv")
            if (row["method"], row["creeps"]) == (name, creeps)]
    assert [row["run"] for row in rows] == list(range(long_runs.RUNS))
    lived, _, kilobytes = long_runs.rewards_of(name, creeps, 2, steps=30_000)
    assert np.array_equal(lived[1], rows[1]["rewards"][:10])
    assert kilobytes == pytest.approx(rows[1]["kilobytes"], rel=1e-3)


def test_deep_agents_see_how_fast_creeps_move_nearest_first():
    from lib.alternatives.deep_runs import FASTEST_CREEP, Sight, gymnasium
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


@pytest.mark.parametrize("creeps", BOARDS)
@pytest.mark.parametrize("steps", [150_000, 600_000])
def test_the_runs_of_deep_agents_are_stored_whole(creeps, steps):
    each = contestants.of_deep(creeps, steps)
    assert {name: (one.runs, one.steps) for name, one in each.items()} == dict.fromkeys(stored.METHODS, (10, steps))
    assert all(0 < one.seconds < 0.02 for one in each.values())  # also where only shorter runs were timed


def test_the_search_of_deep_agents_is_stored_whole():
    rows = stored.read_search(stored.FOLDER / "deep_search.csv")
    assert {row["method"] for row in rows} == set(stored.METHODS) == set(deep_settings.RANGES)
    assert len(rows) == 3 * deep_settings.SETTINGS


def test_a_short_rerun_of_a_deep_agent_equals_the_start_of_its_stored_run():
    pytest.importorskip("sb3_contrib", reason="deep agents need packages that no extra installs")
    from lib.alternatives.deep_runs import live
    best = stored.chosen(stored.read_search(stored.FOLDER / "deep_search.csv"))["DQN"]
    (row,) = [row for row in stored.read_runs(stored.FOLDER / "deep_runs.csv")
              if (row["method"], row["creeps"], row["steps"], row["run"]) == ("DQN", 3, 150_000, 0)]
    rewards, _, _ = live("DQN", deep_settings.settings_of("DQN", best), 3, 6_000, 0, 0)
    assert np.array_equal(rewards, row["rewards"][:2])


def earned(kind, level, runs=10, steps=150_000, seconds=1e-6):
    """Runs whose reward rises until two thirds of the run and then stays level, slightly different for each run."""
    bins = level * np.minimum(np.arange(1, 31) / 20, 1)[None] + 1e-4 * np.arange(1, runs + 1)[:, None]
    return Earned(kind, np.linspace(0, steps, 31), bins * steps / 30 / 50, seconds, 12.0)


@pytest.fixture
def boards():
    def board(scale):
        return {"Brownian motion": earned(CHANCE, 0.1 * scale), "PC + OVC, to the letter": earned(THESIS, 0.2 * scale),
                "network D, to the letter": earned(THESIS, 0.3 * scale),
                "PC + OVC, calibrated": earned(THESIS, 0.5 * scale),
                "network D, calibrated": earned(THESIS, 0.4 * scale), "monolithic": earned(TABLES, 0.3 * scale),
                "joint cells": earned(TABLES, 0.9 * scale), "hybrid reward": earned(TABLES, 2.5 * scale),
                "nearest green": earned(PHYSICS, 2 * scale), "PD": earned(PHYSICS, 3 * scale),
                "planner": earned(PHYSICS, 4 * scale, steps=5_000), "DQN": earned(DEEP, 1.2 * scale, runs=3)}
    return {3: board(1.0), 8: board(0.5)}


def test_rates_lie_between_steps_and_levels_are_reached_by_means():
    each = earned(TABLES, 2.0, runs=1)
    assert each.rate(100_000, 150_000) == pytest.approx([2.0001])
    assert each.rate(0, 2_500) == pytest.approx([0.1001])  # half of the first bin
    assert each.rates[0, :2] == pytest.approx([0.1001, 0.2001])
    assert each.steps_to(1.0, 15_000) == pytest.approx([55_000])  # bins of 0.9, 1.0 and 1.1
    assert np.isinf(each.steps_to(2.5, 15_000)).all()


def test_the_claim_is_judged_by_learners_with_enough_runs(boards):
    judged = report.judge(boards[3], 150_000)
    assert {name: claim.name for name, claim in judged.items()} == {"to the letter": "C5", "calibrated": "C5"}
    letter, calibrated = judged["to the letter"], judged["calibrated"]
    assert "The best alternative is hybrid reward" in letter.detail and "DQN" not in letter.detail
    assert "thesis's best agent is network D, to the letter" in letter.detail
    assert "thesis's best agent is PC + OVC, calibrated" in calibrated.detail
    assert letter.verdict == "not reproduced" and calibrated.verdict == "not reproduced"
    many = {**boards[3], "DQN": earned(DEEP, 9.0)}
    assert "The best alternative is DQN" in report.judge(many, 150_000)["calibrated"].detail
    short = {**boards[3], "DQN": earned(DEEP, 9.0, steps=3_000)}
    assert "The best alternative is hybrid" in report.judge(short, 150_000)["calibrated"].detail


def test_the_summary_names_the_best_of_each_sort_and_an_agent_beyond_the_thesis_if_there_is_one(boards):
    text = report.summary(boards)
    assert text.startswith("With three creeps, 3 of the 4 tabular and deep learners earn more")
    assert "With 3 creeps, the thesis's best agent (PC + OVC, calibrated) earns 0.50 reward per second" in text
    assert "best tabular learner (hybrid reward) 2.50 and the best deep learner (DQN) 1.20. Controllers" in text
    assert "this part of the book" not in text
    ours = {creeps: {**each, "ours": earned(BEYOND, 3.0)} for creeps, each in boards.items()}
    assert "1.20 and the agent of this part of the book (ours) 3.00. Controllers" in report.summary(ours)
    assert "the best learner (ours) earns" in report.meaning(ours)


def test_the_summary_says_for_which_learners_the_lead_is_not_certain(boards):
    assert "includes zero" not in report.summary(boards)
    apart = earned(TABLES, 0.5)
    close = replace(apart, rewards=apart.rewards * np.linspace(0.8, 1.22, apart.runs)[:, None])
    text = report.summary({**boards, 3: {**boards[3], "monolithic": close}})
    assert text.startswith("With three creeps, 4 of the 4") and "For monolithic the 95 % interval of the diff" in text


def test_the_table_has_thirds_levels_time_and_memory(boards):
    rows = {row.split(" | ")[0].lstrip("| "): row for row in report.results_table(boards[3]).splitlines()[2:]}
    assert re.match(r"\| hybrid reward \| 10 \| 0\.69 \| 1\.94 \| 2\.50 \[2\.50, 2\.50\] \| 25 \| 45 \| 85 \| – \| 1 \|"
                    r" 12 \|", rows["hybrid reward"]), rows["hybrid reward"]
    assert rows["PD"].count("at once") == 3 and rows["DQN"].startswith("| DQN | 3 |")


def test_what_it_means_is_computed(boards):
    text = report.meaning(boards)
    assert "3 of the 4 tabular and deep learners" in text and "in the mean over 15 thousand steps" in text
    assert "joint cells, hybrid reward, DQN" in text
    assert "2.50 per second with a head for each creep, 0.90 with joint cells and 0.30 with the whole scene" in text
    assert "hybrid reward 25, DQN 50, joint cells 65" in text
    assert "the best learner (hybrid reward) earns 83 % of PD's reward" in text


def test_the_tables_of_what_is_stored_name_every_method(boards):
    text = report.search_table()
    counts = dict.fromkeys(search.RANGES, 256) | dict.fromkeys(stored.METHODS, deep_settings.SETTINGS)
    assert all(f"| {name} | {count} |" in text for name, count in counts.items())
    assert all(f"\n- *{name}*: " in text for name in counts)
    searched = report.search_in_words({"joint cells": earned(TABLES, 1.0), "DQN": earned(DEEP, 1.0, seconds=1e-3)})
    assert "256 settings" in searched and "36,000 steps" in searched
    assert "about 154 seconds" in searched and "and 216 for each deep one" in searched
    late = report.long_runs(boards)
    words = report.long_in_words(late)
    assert "over the last 50,000 of 600,000 steps. With 3 creeps: " in words and "Brownian" not in words
    places = [words.index(each) for each in ("DQN (", "hybrid reward (", "calibrated (", ". With 8 creeps: ")]
    assert places == sorted(places)
    text = report.long_table(late)
    assert all(f"| {creeps} | {name} | 10 |" in text for creeps in (3, 8) for name in ("hybrid reward", "joint cells"))
    assert "planner" not in text


def test_a_figure_shows_the_best_agent_of_the_thesis_under_each_reading(boards):
    shown = report.shown(boards[3])
    assert [name for name, each in shown.items() if each.kind == THESIS] == ["network D, to the letter",
                                                                            "PC + OVC, calibrated"]
    alternatives_figures.draw_learning(boards)
    names = [{text.get_text() for text in axes.texts} for axes in plt.gcf().axes]
    assert names == [set(shown)] * 2
    plt.close("all")


def test_deep_agents_are_shown_for_as_many_steps_as_all_others():
    found = contestants.of_deep(3, 150_000)
    assert found and all(each.steps == 150_000 and each.kind == DEEP for each in found.values())
    short = contestants.of_deep(3, 9_000)
    assert all(np.array_equal(short[name].rewards, each.rewards[:, :3]) for name, each in found.items())


def test_rewards_of_neorl_are_shared_out_over_bins():
    agents = {"Brownian motion": contestants.neorl_agents()["Brownian motion"]}
    (each,) = contestants.of_neorl(agents, 3, 3_000, 2).values()
    assert each.rewards.shape == (2, contestants.BINS) and each.edges[-1] == 3_000
    lived = Run(agents["Brownian motion"][1], BOARDS[3])
    assert each.rewards[0].sum() == pytest.approx(lived.advance(3_000))
    assert replace(each, kind=BEYOND).runs == 2
