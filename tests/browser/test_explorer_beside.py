"""The second tank of the Explorer: a veteran, or another agent, at the same moment on the same seed.

All tests share one page; each begins with an address, as a link would.
"""

import re
from dataclasses import replace

import pytest
from explorer_page import drop_by_keyboard, picture, press, wait, write_page
from playwright.sync_api import expect

from neorl import Desire, Explorer, Place, Run, WaterWorld, object_vector_cells, place_cells, simulate
from neorl.browser.explorer import OTHER_SPACES, STEPS
from companion.thesis.reading import TO_THE_LETTER, networks

TANK, PLACES, THINGS = WaterWorld(), place_cells([5, 3]), object_vector_cells([4])
SIZE = {"steps": 12_000, "runs": 12, "seed": 3, "progress": False}
MINUTE = 60 * TANK.fps


@pytest.fixture(scope="module")
def page(open_shared_page, tmp_path_factory):
    folder = tmp_path_factory.mktemp("beside")
    conditions = {"places": simulate(PLACES, TANK, **SIZE), "things": simulate(THINGS, TANK, **SIZE)}
    write_page(folder, [Explorer(conditions, playing=False, speed=0.0)])
    page = open_shared_page(folder, "page.html")
    wait(page, "paused")
    return page


def visit(page, address):
    page.evaluate("""address => {
        history.replaceState(null, "", location.pathname);  // so that the same address counts once more
        document.querySelector(".neorl-explorer").dataset.step = "";  // that of the run before
        location.hash = address;
    }""", address)


def wait_for(page, **data):
    page.wait_for_function("""wanted => Object.entries(wanted).every(([name, value]) =>
        (document.querySelector(".neorl-explorer").dataset[name] ?? null) === value)""", arg=data)


def scores(page):
    data = page.evaluate("({...document.querySelector('.neorl-explorer').dataset})")
    assert data["step"] == data["secondStep"]
    return float(data["score"]), float(data["secondScore"])


def veteran(agent, minutes, world=TANK, run=0):
    teacher, learner = (Run(agent, world, seed, run) for seed in (SIZE["seed"] + 1, SIZE["seed"]))
    teacher.advance(60 * world.fps * minutes)
    learner.transfer(teacher)
    return learner


def newborn(agent, world=TANK, run=0):
    return Run(agent, world, SIZE["seed"], run)


def test_a_newborn_runs_beside_a_veteran_as_in_python(page):
    visit(page, "#explorer_agent-places_run-2_minute-0")
    wait_for(page, step="0", state="paused")
    expect(page.locator(".second, .versus")).to_have_count(2)
    expect(page.locator(".second")).to_be_hidden()
    visit(page, "#explorer_agent-places_run-2_beside-places_learned-100_minute-0")
    wait_for(page, step="0", secondStep="0", state="paused")
    press(page, "play")
    wait_for(page, step="12000", secondStep="12000", state="ended")
    first, second = newborn(PLACES, run=2).advance(12_000), veteran(PLACES, 100, run=2).advance(12_000)
    assert scores(page) == (first, second) and first != second
    expect(page.locator(".named")).to_have_text([re.compile(f"^{name}: [−\\d]") for name in ("Newborn", "Veteran")])
    expect(page.locator(".told")).to_contain_text(re.compile(r"minutes · Newborn: [−\d]+ · Veteran: [−\d]+\."))
    expect(page.locator(".legend")).to_contain_text("Veteran")
    page.wait_for_function("location.hash.endsWith('_beside-places_learned-100')")


def turn(page, name, value):
    page.locator(f'[name="{name}"]').evaluate("""(control, value) => {
        control[control.type === "checkbox" ? "checked" : "value"] = value;
        control.dispatchEvent(new Event("input", { bubbles: true }));
    }""", value)


@pytest.mark.parametrize("before", [
    lambda page: press(page, "red"), lambda page: turn(page, "valence_red", "1"), lambda page: press(page, "game"),
    lambda page: turn(page, "heat", True), drop_by_keyboard])
def test_the_newborn_and_the_veteran_differ_in_nothing_but_experience_whatever_was_tried_before(page, before):
    visit(page, "#explorer_agent-places_minute-1")
    wait_for(page, step=str(MINUTE), state="paused")
    before(page)
    press(page, "compare")
    expect(page.locator('[name="speed"]')).to_have_attribute("aria-valuetext", "10× real time")
    turn(page, "speed", "10")
    wait_for(page, step=str(2 * MINUTE), secondStep=str(2 * MINUTE), state="paused")
    first, second = scores(page)
    assert (first, second) == (newborn(PLACES).advance(2 * MINUTE), veteran(PLACES, 100).advance(2 * MINUTE))
    ahead = "veteran" if second >= first else "newborn"
    expect(page.locator(".said")).to_contain_text(f"the {ahead} is {abs(second - first):g} ahead.")
    expect(page.locator(".wants")).to_have_text("Wants: green +1, red −1")
    expect(page.locator('[name="heat"]')).not_to_be_checked()


def test_any_other_agent_of_such_a_world_stands_in_the_menus_and_in_the_address(page):
    visit(page, "#explorer_agent-places_beside-places_learned-100_minute-0")
    wait_for(page, step="0", secondStep="0", state="paused")
    page.get_by_role("combobox", name="Second tank").select_option("things")
    page.get_by_label("has learned for").select_option("10 minutes")
    first, second = newborn(PLACES).advance(12_000), veteran(THINGS, 10).advance(12_000)
    wait_for(page, step="12000", state="ended", beside="things", secondScore=f"{second:g}")
    assert scores(page) == (first, second)
    expect(page.locator(".named")).to_have_text([re.compile("^places: "), re.compile("^things, a veteran: ")])
    page.wait_for_function("location.hash.includes('_beside-things_learned-10')")
    address = page.evaluate("location.hash")
    visit(page, address.replace("learned-10", "learned-0"))
    second = newborn(THINGS).advance(12_000)
    wait_for(page, step="12000", state="ended", beside="things", secondScore=f"{second:g}")
    assert scores(page) == (first, second)


def test_both_show_the_same_moment_step_by_step_and_of_agents_with_other_steps_per_second(page):
    visit(page, "#explorer_agent-places_beside-network-d-to-the-letter_minute-2")
    letter = replace(TANK, fps=TO_THE_LETTER.world.fps, contact=TO_THE_LETTER.world.contact)
    wait_for(page, step=str(2 * MINUTE), secondStep=str(120 * letter.fps), state="paused")
    run = Run(networks(TO_THE_LETTER)["D"], letter, SIZE["seed"])
    assert float(page.locator(".neorl-explorer").get_attribute("data-second-score")) == run.advance(120 * letter.fps)
    visit(page, "#explorer_agent-places_beside-things_minute-2")
    wait_for(page, step=str(2 * MINUTE), secondStep=str(2 * MINUTE), state="paused")
    press(page, "step")
    wait_for(page, step=str(2 * MINUTE + 1), secondStep=str(2 * MINUTE + 1))


def test_an_element_is_dropped_into_both_tanks(page):
    visit(page, "#explorer_agent-places_beside-things_minute-0")
    wait_for(page, step="0", secondStep="0", state="paused")
    before = picture(page, ".second canvas")
    drop_by_keyboard(page)
    page.wait_for_function("document.querySelector('.legend').textContent.includes('changed')")
    assert picture(page, ".second canvas") != before
    press(page, "play")
    wait_for(page, step="12000", state="ended")
    runs = [replace(agent, desires=(*agent.desires, Desire(Place(0.5, 0.5), agent.nodes[0].name, 1.0)))
            for agent in (PLACES, THINGS)]
    assert scores(page) == tuple(newborn(each).advance(12_000) for each in runs)


def test_the_same_agent_takes_the_settings_of_the_first(page):
    visit(page, "#explorer_agent-places_beside-places_learned-10_exploration-0p1_minute-2")
    wait_for(page, step=str(2 * MINUTE), secondStep=str(2 * MINUTE), state="paused")
    agent = replace(PLACES, policy=replace(PLACES.policy, exploration=0.1))
    assert scores(page) == (newborn(agent).advance(2 * MINUTE), veteran(agent, 10).advance(2 * MINUTE))


def test_the_way_to_a_cell_is_shown_in_both_tanks(page):
    visit(page, "#explorer_agent-places_beside-places_learned-10_minute-0")
    wait_for(page, step="0", secondStep="0", state="paused")
    before = picture(page, ".second canvas")
    page.locator(".space canvas").focus()
    page.keyboard.press("Enter")
    page.wait_for_function("""() => {
        const { goal, secondGoal } = document.querySelector(".neorl-explorer").dataset;
        return goal !== "" && goal === secondGoal;
    }""")
    assert picture(page, ".second canvas") != before


def test_a_comparison_ends_without_stopping_the_first_run(page):
    visit(page, "#explorer_agent-places_beside-things_minute-1")
    wait_for(page, step=str(MINUTE), state="paused", beside="things")
    page.locator('[name="speed"]').fill("0")  # so that the run goes on for minutes
    press(page, "play")
    page.wait_for_function(f"document.querySelector('.neorl-explorer').dataset.step > {MINUTE}")
    press(page, "compare")
    wait_for(page, beside=None)
    expect(page.locator(".second")).to_be_hidden()
    page.locator('[name="speed"]').fill("10")
    wait_for(page, step="12000", state="ended")
    assert float(page.locator(".neorl-explorer").get_attribute("data-score")) == newborn(PLACES).advance(12_000)
    page.wait_for_function("!location.hash.includes('beside')")


def test_a_link_that_is_followed_while_the_second_tank_is_asked_leads_to_its_moment(page):
    visit(page, "#explorer_agent-places_beside-things_minute-0")
    wait_for(page, step="0", secondStep="0", state="paused")
    page.evaluate("""() => {  // the second tank, which is to catch up whatever it takes, is never asked
        window.post = Worker.prototype.postMessage;
        Worker.prototype.postMessage = function (message, ...more) {
            if (message.budget === Infinity) window.isHeld = true;
            else window.post.call(this, message, ...more);
        };
    }""")
    press(page, "play")
    page.wait_for_function("window.isHeld")
    visit(page, "#explorer_agent-places_minute-0p1")
    wait_for(page, step="300", state="paused", beside=None)
    page.evaluate("() => { Worker.prototype.postMessage = window.post; }")


def test_a_choice_made_while_the_veteran_learns_begins_at_once(page):
    visit(page, "#explorer_agent-places_minute-0")
    wait_for(page, step="0", state="paused")
    page.evaluate("""() => {
        const root = document.querySelector(".neorl-explorer");
        location.hash = "#explorer_agent-places_beside-places_learned-100";
        setTimeout(() => Object.assign(root.querySelector('[name="preset"]'), { value: "things" }).dispatchEvent(
            new Event("input", { bubbles: true })), 60);
    }""")
    wait_for(page, step="12000", condition="things", state="ended", secondStep="12000")
    assert scores(page) == (newborn(THINGS).advance(12_000), veteran(THINGS, 100).advance(12_000))


def test_an_agent_of_another_world_stands_only_beside_itself(page):
    visit(page, "#explorer_agent-places_beside-things_minute-0")
    wait_for(page, step="0", state="paused", beside="things")
    page.locator('[name="preset"]').select_option("Arm of two links")
    wait_for(page, beside="", secondStep="0", state="paused")
    press(page, "play")
    wait_for(page, secondStep=str(STEPS), step=str(STEPS), state="ended")
    expect(page.locator('[name="beside"] option')).to_have_text(["the same agent"])
    arm, world = OTHER_SPACES["Arm of two links"]
    assert scores(page) == (newborn(arm, world=world).advance(STEPS), veteran(arm, 100, world).advance(STEPS))


@pytest.mark.parametrize("beside", ["nobody", "arm-of-two-links", "things_learned-7"])
def test_an_address_with_an_impossible_comparison_is_reported(page, beside):
    visit(page, "#explorer_agent-places_minute-0")
    wait_for(page, step="0", state="paused", beside=None)
    visit(page, f"#explorer_beside-{beside}")
    expect(page.locator(".refused")).to_contain_text("There is no agent “")
    wait_for(page, beside=None)


def test_on_a_phone_the_tanks_stand_side_by_side(page):
    visit(page, "#explorer_agent-places_beside-things_minute-0")
    wait_for(page, secondStep="0", state="paused")
    size = page.viewport_size
    page.set_viewport_size({"width": 400, "height": 800})
    page.evaluate("document.body.style.width = 'auto'")
    first, second = (page.locator(each).first.bounding_box() for each in (".first canvas", ".second canvas"))
    assert first["y"] == second["y"] and first["width"] == second["width"] > 150
    assert first["x"] + first["width"] < second["x"] and second["x"] + second["width"] <= 400
    assert page.evaluate("document.documentElement.scrollWidth") <= 400
    page.evaluate("document.body.style.width = '700px'")
    page.set_viewport_size(size)
