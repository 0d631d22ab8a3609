"""Navigation by rule, and the same agent before and after learning."""

import numpy as np
import pytest
from matplotlib import pyplot as plt

from lib.chapter_1 import navigation_figures
from lib.chapter_1.before_and_after import first_minutes, leads, trials, veteran
from lib.chapter_1.steering import CLOSE, HASTE, chase, follow_route, steer
from neorl import Learning, Run, WaterWorld, multimodal, place_cells
from neorl.core.kernel import arrays, execute
from neorl.experiments.recording import Recording

TANK = WaterWorld()
MOVES = 62.5 * np.array([(0, -1), (0, 1), (1, 0), (-1, 0), (0, 0)])


def test_the_helmsman_takes_the_action_after_which_the_velocity_is_best():
    rng = np.random.default_rng(0)
    state = TANK.reset(0)
    scene = state.scene
    taken = set()
    for _ in range(300):
        scene.position[:], scene.velocity[:] = rng.uniform(0, 250, 2), rng.uniform(-200, 200, 2)
        target = scene.position + rng.uniform(-60, 60, 2)
        miss = HASTE * (target - scene.position) - scene.velocity
        action = execute(steer, state, TANK.rules, *target)
        assert np.linalg.norm(miss - MOVES, axis=1).argmin() == action
        taken.add(action)
    assert taken == set(range(5))


def test_a_route_is_followed_point_by_point_and_the_vessel_stays_at_its_end():
    waypoints = np.array([(0.2, 0.3), (0.7, 0.2), (0.6, 0.8)])
    path = follow_route(TANK, waypoints, seconds=20)
    assert path.shape == (1001, 2) and path[0].tolist() == [0.5, 0.5]
    reached = [int((np.linalg.norm(path - point, axis=1) < CLOSE).argmax()) for point in waypoints]
    assert 0 < reached[0] < reached[1] < reached[2]
    assert np.linalg.norm(path[-100:] - waypoints[-1], axis=1).max() < CLOSE


@pytest.mark.parametrize("waypoints", [[(0.2, 1.2)], [(0.2,)], (0.5, 0.5), [(0.1, np.nan)]])
def test_a_route_that_leaves_the_tank_is_refused(waypoints):
    with pytest.raises(ValueError, match="waypoints"):
        follow_route(TANK, waypoints, seconds=1)


def test_hunting_by_rule_earns_more_than_one_per_second_and_a_run_is_the_same_alone():
    rewards = chase(TANK, steps=3_000, runs=4, seed=1)
    assert rewards.min() > 60  # one per second
    assert chase(TANK, steps=3_000, runs=2, seed=1).tolist() == rewards[:2].tolist()
    assert len(set(rewards)) > 1


def test_an_untrained_newborn_and_a_veteran_trained_in_a_run_begin_on_the_same_board():
    agent = place_cells([3])
    first, second = Run(agent, TANK, seed=4, run=2), veteran(agent, TANK, 5_000, seed=4, run=2)
    assert all(map(np.array_equal, *(arrays(run.world_state).values() for run in (first, second))))
    teacher = Run(agent, TANK, seed=5, run=2)
    teacher.advance(5_000)
    assert not first.q().any() and np.array_equal(second.q(), teacher.q()) and teacher.q().any()
    assert np.array_equal(second.state.values.goal_range, teacher.state.values.goal_range)
    assert second.step == 0
    second.advance(1_000)  # knowledge of goals is kept while it continues to learn
    assert second.q().sum() > 0.5 * teacher.q().sum()


def test_trials_pair_newborns_with_veterans_and_do_not_depend_on_their_number():
    choices = {"lessons": 20_000, "steps": 1_500, "seed": 3}
    agent = multimodal([3, 5], learning=Learning(learning_rate=0.1, discount=0.9, memory=0.0, bootstrap=True))
    before, after = trials(agent, TANK, runs=6, **choices)
    assert trials(agent, TANK, runs=2, **choices).tolist() == [before[:2].tolist(), after[:2].tolist()]
    assert after.mean() > before.mean()


def test_leads_are_differences_per_second_by_how_long_veterans_have_lived(monkeypatch):
    def made_up(agent, world, *, lessons, steps, runs, seed):
        assert (steps, seed) == (150, 7)  # three seconds
        return np.array([np.full(runs, 3.0), np.full(runs, 3.0 + lessons)])

    monkeypatch.setattr("lib.chapter_1.before_and_after.trials", made_up)
    found = leads(multimodal([3]), TANK, [0, 6], steps=150, runs=4, seed=7)
    assert found == {0: (0.0, 0.0, 0.0), 6: (2.0, 2.0, 2.0)}


@pytest.mark.parametrize("change, message", [({"steps": -1}, "steps must be .*, but is -1"),
({"runs": 0}, "runs must be .*, but is 0"),
                                             ({"lessons": 0.5}, "steps must be .*, but is 0.5"),
                                             ({"seed": -1}, "seed must be an inte")])
def test_a_bad_argument_of_trials_is_refused(change, message):
    with pytest.raises(ValueError, match=message):
        trials(place_cells([2]), TANK, **{"lessons": 10, "steps": 10, "runs": 1, "seed": 0, **change})


def test_a_path_breaks_off_where_the_agent_is_put_back_and_a_creep_is_drawn_where_it_was_met():
    agent = np.array([(0.5, 0.5, 0, 0), (0.52, 0.5, 1, 0), (0.5, 0.5, 0, 0), (0.5, 0.48, 0, -1)], np.float32)
    hits = np.array([(0, 0), (0, 1), (1, 1), (1, 1)])
    recording = Recording("made up", 50, 0.05, agent, np.zeros((4, 1, 4), np.float32), np.ones((4, 1), bool), hits)
    axes = plt.figure().add_subplot()
    navigation_figures.draw_recording(axes, recording)
    (path,) = axes.collections
    assert np.allclose(path.get_segments(), [agent[0:2, :2], agent[2:4, :2]])
    assert [patch.center for patch in axes.patches] == [pytest.approx((0.52, 0.5)), pytest.approx((0.52, 0.5)),
                                                        pytest.approx((0.5, 0.48))]
    assert [text.get_text() for text in axes.texts] == ["+", "−", ""]
    assert "1 green, 1 red" in axes.get_title()
    plt.close("all")


def test_the_first_minute_is_that_of_trials_and_of_the_rule_per_second():
    world, agent = WaterWorld(), multimodal([3])
    newborns, veterans, by_rule = first_minutes(agent, world, lessons=100, runs=2)
    minute = 60 * world.fps
    np.testing.assert_array_equal([newborns, veterans], trials(agent, world, lessons=100, steps=minute, runs=2) / 60)
    np.testing.assert_array_equal(by_rule, chase(world, minute, 2) / 60)
