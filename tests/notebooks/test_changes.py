"""The Changes learn in a page what the agent has learned, from the changes of cell of its run."""

import numpy as np
import pytest
from companion.chapter_4.changes import Changes, changes_of
from explorer_page import write_page
from playwright.sync_api import expect

from neorl import Learning, Policy, Run, WaterWorld, place_cells

AGENT = place_cells([5], learning=Learning(credit="share", discount=0.8), policy=Policy(0.02))
STEPS = 6_000


def run_of(agent=AGENT):
    return Run(agent, WaterWorld(), seed=0)


@pytest.fixture
def page(open_page, tmp_path):
    write_page(tmp_path, [Changes(run_of(), STEPS)])
    return open_page(tmp_path, "page.html")


def learned(discount):
    """All values that the agent's changes teach, (cells, actions, goals), by equation 4.8 in Python."""
    q = np.zeros((25, 4, 25), np.float32)
    for left, entered, steps, *counts in changes_of(run_of(), STEPS):
        target = np.float32(discount) * q[entered].max(axis=0)
        target[entered] = 1
        q[left] += np.float32(0.1) * (np.array(counts) / steps).astype(np.float32)[:, None] * (target - q[left])
    return q


def sums(page):
    return float(page.locator(".neorl-changes").get_attribute("data-sum"))


def test_changes_of_cell_and_resets_teach_what_the_agent_has_learned():
    run = run_of()
    path = run.record(STEPS)
    assert len(path.ends) > 3
    assert np.array_equal(learned(0.8), run.q())


def test_the_page_learns_from_one_change_from_a_hundred_and_from_all_with_another_discount(page):
    (left, entered, steps, *counts), *more = changes_of(run_of(), STEPS)
    expect(page.locator("caption")).to_have_text("Nothing learned yet")
    page.get_by_text("Next change of cell").click()
    expect(page.locator("caption")).to_have_text(
        f"From column {left % 5 + 1}, row {left // 5 + 1} to column {entered % 5 + 1}, row {entered // 5 + 1}")
    for row, (push, count) in enumerate(zip(("north", "south", "east", "west"), counts)):
        credit = count / steps
        expect(page.locator("tbody tr").nth(row)).to_have_text(f"{push}{credit:.3f}0.0001.000{0.1 * credit:.3f}")
    page.get_by_text("100 more").click()
    expect(page.locator(".minutes")).to_have_text(f"101 of {len(more) + 1} changes of cell")
    page.get_by_text("All").click()
    assert sums(page) == pytest.approx(learned(0.8).sum(), rel=1e-4)
    page.locator("input").fill("0.5")
    assert sums(page) == pytest.approx(learned(0.5).sum(), rel=1e-4)
    page.get_by_text("Begin again").click()
    assert sums(page) == 0


def test_another_goal_is_chosen_by_a_click_or_an_arrow_key(page):
    changes, canvas = page.locator(".neorl-changes"), page.locator("canvas")
    box = canvas.bounding_box()
    canvas.click(position={"x": 0.5 * box["width"], "y": 0.3 * box["height"]})
    expect(changes).to_have_attribute("data-goal", "7")
    canvas.press("ArrowDown")
    expect(changes).to_have_attribute("data-goal", "12")
    for _ in range(4):
        canvas.press("ArrowRight")
    expect(changes).to_have_attribute("data-goal", "14")
