"""The page of chapter 1: newborns and veterans, the helmsman and the captain in its cells."""

import numpy as np
import pytest
from page_cells import executed

from neorl import Run
from neorl.kernels.annotations import arrays

AGENT = "multimodal([3, 5], learning=Learning(learning_rate=0.1, discount=0.9, memory=0.0, bootstrap=True))"


@pytest.fixture(scope="module")
def page():
    """The page with an agent that learns quickly."""
    return executed("chapter_1", (("multimodal()", AGENT), ("import Run", "import Learning, Run")),
                    runs=6, steps=20_000, seed=4)


def test_a_veteran_begins_on_the_newborns_board_with_the_values_of_another_run(page):
    first, second = Run(page.agent, page.tank, seed=4, run=1), page.veteran(1)
    assert all(map(np.array_equal, *(arrays(run.world_state).values() for run in (first, second))))
    teacher = Run(page.agent, page.tank, seed=5, run=1)
    teacher.advance(20_000)
    assert not first.q().any() and np.array_equal(second.q(), teacher.q()) and teacher.q().any()
    assert second.step == 0
    second.advance(1_000)  # knowledge of goals is kept while it continues to learn
    assert second.q().sum() > 0.5 * teacher.q().sum()


def test_pairs_are_the_same_among_others_and_experience_pays(page):
    assert page.earned(2).tolist() == page.veterans[:2].tolist()
    alone = [Run(page.agent, page.tank, 4, k).advance(page.minute) / 60 for k in range(6)]
    assert page.newborns.tolist() == alone
    assert page.veterans.mean() > page.newborns.mean()


def test_the_helmsman_takes_the_action_after_which_the_velocity_is_best(page):
    rng, state, taken = np.random.default_rng(0), page.tank.reset(0), set()
    pushes = 62.5 * np.array([(0, -1), (0, 1), (1, 0), (-1, 0), (0, 0)])
    for _ in range(300):
        state.scene.position[:], state.scene.velocity[:] = rng.uniform(0, 250, 2), rng.uniform(-200, 200, 2)
        target = state.scene.position + rng.uniform(-60, 60, 2)
        missed = 4 * (target - state.scene.position) - state.scene.velocity - pushes
        action = page.steer(state.scene, target)
        assert action == np.linalg.norm(missed, axis=1).argmin()
        taken.add(int(action))
    assert taken == set(range(5))


def test_the_route_passes_its_waypoints_in_order(page):
    for points in page.plans:
        path = page.steered(points)
        assert path.shape == (251, 2) and path[0].tolist() == [0.5, 0.5]
        assert np.all(np.diff([0, *((np.linalg.norm(path - point, axis=1) < 0.05).argmax() for point in points)]) > 0)


def test_the_captain_earns_more_than_one_per_second(page):
    assert page.by_rule.min() > 1 and len(set(page.by_rule)) == 6
