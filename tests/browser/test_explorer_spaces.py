"""In the arena and in other spaces the Explorer computes the runs of Python, and offers what can be changed there."""

from dataclasses import replace

import pytest
from explorer_page import drop_by_keyboard, explorer_of, play_to_the_end, wait_for_score, write_page
from playwright.sync_api import expect

from neorl import Desire, Explorer, Place, Run, WaterWorld, multimodal, simulate
from neorl.worlds import Arena
from neorl.browser.explorer import IN_THE_ARENA, OTHER_SPACES, STEPS
from neorl.core.modality import BOUNDARY_VECTOR_CELL

SEED, SHORT = 3, 10_000
BOTH, TANK = multimodal([2, 3]), WaterWorld()


@pytest.fixture
def opened(open_page, tmp_path):
    """`opened(preset)` is a page whose Explorer shows a preset, beside a condition in the tank."""
    def write(preset):
        both = simulate(BOTH, TANK, steps=SHORT, runs=2, seed=SEED, progress=False)
        write_page(tmp_path, [Explorer({"both": both}, preset, playing=False, speed=0.0)])
        page = open_page(tmp_path, "page.html")
        explorer_of(page)
        return page
    return write


def lived(agent, world, steps=STEPS):
    return Run(agent, world, SEED).advance(steps)


def test_in_the_arena_it_computes_the_run_of_python_and_has_no_controls_for_creeps(opened):
    ((name, agent),) = IN_THE_ARENA.items()
    page = opened(name)
    page.locator(".neorl-explorer summary").click()
    for control in ("n_creeps", "valence_red"):
        expect(page.locator(f'[name="{control}"]')).to_be_hidden()
    expect(page.locator('[data-action="game"]')).to_be_disabled()
    expect(page.locator(".grip")).to_have_count(0)
    expect(page.locator(".said")).not_to_contain_text("creeps")
    assert play_to_the_end(page) == lived(agent, Arena())
    page.evaluate("""() => {  // the run may be over, and the button disabled again, before the test can look
        const game = document.querySelector('[data-action="game"]');
        new MutationObserver(() => { window.offered ||= !game.disabled; }).observe(game, { attributes: true });
    }""")
    page.locator('[name="preset"]').select_option("both")  # which begins a run at once
    wait_for_score(page, SHORT, lived(BOTH, TANK, SHORT))
    expect(page.locator(".grip")).to_have_count(TANK.n_creeps)
    for control in ("n_creeps", "valence_red"):
        expect(page.locator(f'[name="{control}"]')).to_be_visible()
    assert page.evaluate("window.offered")


@pytest.mark.parametrize("name", OTHER_SPACES)
def test_in_another_space_it_computes_the_run_of_python(opened, name):
    page = opened(name)
    for action in ("game", "red"):
        expect(page.locator(f'[data-action="{action}"]')).to_be_disabled()
    for title, subject in ((".board .limb .title", "Workspace"), (".side .space .title", "Joint space")):
        expect(page.locator(title, has_text=subject)).to_be_visible(visible=name.startswith("Arm"))
    assert play_to_the_end(page) == lived(*OTHER_SPACES[name])


def test_a_condition_in_another_maze_is_not_the_one_that_is_seen(open_page, tmp_path):
    ((name, agent),) = IN_THE_ARENA.items()
    walls = simulate(agent, Arena(obstacles=[(0.4, 0.4, 0.6, 0.6)]), steps=500, runs=2, progress=False)
    write_page(tmp_path, [Explorer({"walls": walls}, playing=False, speed=0.0)])
    page = open_page(tmp_path, "page.html")
    assert explorer_of(page).get_attribute("data-condition") == "walls"
    assert play_to_the_end(page) == walls.totals[0]
    page.locator('[name="preset"]').select_option(name)  # its whole run may be over before one looks
    expect(explorer_of(page)).to_have_attribute("data-condition", "")


def test_what_is_dropped_into_the_arena_draws_the_agent_there(opened):
    ((name, agent),) = IN_THE_ARENA.items()
    page = opened(name)
    drop_by_keyboard(page)
    page.locator('[name="modality"]').select_option("boundary-vector cell")
    dropped = Desire(Place(0.5, 0.5), "PC", 1.0)
    node = replace(agent.nodes[0], modality=BOUNDARY_VECTOR_CELL)
    assert play_to_the_end(page) == lived(replace(agent, nodes=[node], desires=(*agent.desires, dropped)), Arena())
