"""The Steering leads in a page where the agent would go in Python."""

import numpy as np
import pytest
from explorer_page import write_page

pytest.importorskip("ratinabox")
from companion.recordings import pilots, steering, ways  # noqa: E402 (they import RatInABox)

pytestmark = pytest.mark.filterwarnings("ignore:invalid escape sequence")  # of RatInABox, where it is first compiled
STARTS = np.array([[0.1, 0.2], [0.85, 0.9], [0.3, 0.7]])


@pytest.fixture(scope="module")
def learner():
    path, missing = ways.rat(10)
    return pilots.pupil(path, (5, 8), ends=missing)


def test_the_vectors_of_maps_add_up_to_the_desire_vector_of_the_agent(learner):
    rng, push = np.random.default_rng(0), pilots.towards_thing(learner)
    vectors = [steering.vectors_of(learner, index) for index in (0, 1)]
    for place, goal in rng.random((40, 2, 2)):
        cells = [[int(n * x) + n * int(n * y) for x, y in (place, goal)] for n in (5, 8)]
        total = sum(part[cell, aim] for part, (cell, aim) in zip(vectors, cells))
        assert total / max(np.abs(total).max(), 1e-12) == pytest.approx(push(tuple(goal))(place), abs=1e-5)


def test_ways_in_a_page_are_those_of_walkers_and_follow_a_goal_that_is_dragged(open_page, tmp_path, learner):
    path, missing = ways.rat(1)
    noise = np.random.default_rng(0).normal(size=(3, 300, 2)).astype(np.float32)
    write_page(tmp_path, [steering.Steering(learner, path, missing, STARTS, noise)])
    page = open_page(tmp_path, "page.html")
    figure, mark = page.locator(".neorl-steering"), page.locator(".neorl-steering button")

    def check():
        goal = tuple(map(float, figure.get_attribute("data-goal").split()))
        walked = [ways.walk(pilots.towards_thing(learner)(goal), ways.box(), start, np.array(goal), drawn)
                  for start, drawn in zip(STARTS, noise.astype(float))]
        arrived = [np.linalg.norm(way[-1] - goal) <= ways.NEAR for way in walked]
        assert figure.get_attribute("data-steps") == " ".join(str(len(way) - 1) for way in walked)
        assert page.locator(".said").inner_text().startswith(f"{sum(arrived)} of 3 ways arrive at ({goal[0]:.2f}, ")
        return goal

    assert check() == steering.GOAL
    mark.press("ArrowLeft")
    assert check() == pytest.approx((steering.GOAL[0] - 0.02, steering.GOAL[1]))
    box = figure.locator("canvas").bounding_box()
    mark.hover()
    page.mouse.down()
    page.mouse.move(box["x"] + 0.3 * box["width"], box["y"] + 0.6 * box["height"], steps=3)
    page.mouse.up()
    unit = box["width"] / 1.11
    assert check() == pytest.approx([(share * box["width"] - 0.055 * unit) / unit for share in (0.3, 0.6)], abs=0.01)
    page.mouse.move(box["x"] + 5, box["y"] + 5)
    assert check()[0] > 0.2, "a goal that was let go follows the pointer no more"
