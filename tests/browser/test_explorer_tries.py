"""The Explorer's one-click starters and its state in the address lead to the same runs as in Python."""

import re
from dataclasses import replace

import numpy as np
import pytest
from explorer_page import drop_by_keyboard, keep_states, picture, press, wait, wait_for_states, write_page
from playwright.sync_api import expect

from neorl import Explorer, Run, WaterWorld, object_vector_cells, place_cells, simulate
from neorl.core.horde import as_vectors

TANK = WaterWorld()
PLACES = place_cells([5, 3])
SIZE = {"steps": 12_000, "runs": 12, "seed": 3, "progress": False}


@pytest.fixture(scope="module")
def conditions():
    return {"places": simulate(PLACES, TANK, **SIZE), "things": simulate(object_vector_cells([4]), TANK, **SIZE)}


@pytest.fixture
def visit(open_page, tmp_path, conditions):
    """`visit(address)` opens a page with an Explorer at an address."""
    def visit(address="", **options):
        write_page(tmp_path, [Explorer(conditions, playing=False, speed=0.0)])
        page = open_page(tmp_path, f"page.html{address}", **options)
        wait(page, "paused|running|ended")
        return page
    return visit


def shown(page, name):
    return page.locator(".neorl-explorer").get_attribute(f"data-{name}")


def wanting_red(agent, **learning):
    return replace(agent, desires=[replace(each, valence=1.0) for each in agent.desires],
                   learning=replace(agent.learning, **learning))


def test_red_becomes_good_in_the_middle_of_a_short_run_learning_stops_and_red_creeps_are_counted(visit):
    page = visit()
    press(page, "red")
    wait(page, "ended")
    run, reds = Run(PLACES, TANK, SIZE["seed"], 0), []
    for minutes, agent in ((2, PLACES), (1, wanting_red(PLACES, learning_rate=0.0)), (1, None)):
        if agent:
            run.change(agent)
        reds.append(run.record(60 * TANK.fps * minutes).hits[:, TANK.kinds.index("red")].sum() / minutes)
    expect(page.locator(".counts")).to_have_text(f"Red a minute: {reds[0]:g}, then {reds[1]:g}, now {reds[2]:g}")
    expect(page.locator(".of-catches")).to_have_text("Caught a minute, by colour")  # not over another time
    expect(page.locator('[name="valence_red"]')).to_have_value("1")
    expect(page.get_by_label("Learning", exact=True)).not_to_be_checked()
    expect(page.locator(".said")).to_contain_text("Learning is off")


def test_the_way_to_the_turn_is_shown_and_can_be_stopped(visit):
    page = visit("#explorer_agent-network-d_minute-0")
    expect(page.locator("progress")).to_be_hidden()
    button = page.locator('[data-action="red"]')
    button.click()
    expect(button).to_have_text("Stop here")
    bar = page.get_by_label("How far the run has come")
    expect(bar).to_be_visible()
    expect(page.locator(".board .minutes")).to_contain_text(re.compile(r"^[\d.]+ of 50 simulated minutes"))
    page.wait_for_function("document.querySelector('progress').value > 0")
    button.click()
    expect(page.locator(".said")).to_contain_text(re.compile(r"Stopped after [\d.]+ simulated minutes\."))
    wait(page, "paused")
    step, end = int(shown(page, "step")), bar.evaluate("bar => bar.max")
    assert 0 < step < end == 50 * 60 * TANK.fps
    expect(button).to_have_text("Make red good")
    expect(page.locator("progress")).to_be_hidden()
    expect(page.locator('[name="valence_red"]')).to_have_value("-1")


def test_the_sign_on_red_discs_is_that_of_the_desire(visit):
    page = visit()
    sign = page.locator(".key li", has_text="Red creep").locator(".sign")
    tank = picture(page)
    expect(sign).to_have_attribute("d", "M8 8h8")
    page.locator("summary").click()
    page.locator('[name="valence_red"]').fill("1")
    expect(page.locator(".key")).to_contain_text("Red creep: pays −1, but is wanted")
    expect(sign).to_have_attribute("d", "M8 8h8M12 4v8")
    wanting = picture(page)
    assert wanting != tank
    page.locator('[name="valence_red"]').fill("0")
    expect(sign).to_have_attribute("d", "")
    assert picture(page) not in (tank, wanting)


def test_resolutions_to_press_are_those_of_the_agent_too(visit):
    page = visit("#explorer_agent-foveated-cells-contacts-alone_minute-0")
    pressed = page.locator('.chips [aria-pressed="true"]')
    expect(pressed).to_have_text(["5", "9", "15", "25"])
    page.locator('[name="preset"]').select_option("things")
    expect(page.locator(".chips button")).to_have_text(["2", "3", "4", "5", "7", "11", "13"])
    expect(pressed).to_have_text(["4"])


def test_learning_is_switched_on_again_at_the_rate_of_before(visit):
    page = visit("#explorer_rate-0p1_minute-1")
    page.wait_for_function("document.querySelector('.neorl-explorer').dataset.step === '3000'")
    learns, rate = page.get_by_role("switch", name="Learning"), page.locator('[name="learning_rate"] + output')
    expect(learns).to_be_checked()
    learns.uncheck()
    expect(rate).to_have_text("0")
    expect(page.locator(".said")).not_to_contain_text("Learning is")  # of red creeps
    press(page, "step")
    page.wait_for_function("document.querySelector('.neorl-explorer').dataset.step === '3001'")
    learns.check()
    expect(rate).to_have_text("0.1")
    press(page, "play")
    wait(page, "ended")
    slow = replace(PLACES, learning=replace(PLACES.learning, learning_rate=0.1))
    run = Run(slow, TANK, SIZE["seed"], 0)
    reward = run.advance(3_000)
    run.change(replace(slow, learning=replace(slow.learning, learning_rate=0.0)))
    reward += run.advance(1)
    run.change(slow)
    assert float(shown(page, "score")) == reward + run.advance(8_999)


def test_an_address_without_learning_says_so_and_that_of_a_turned_run_turns_it_again(visit):
    page = visit("#explorer_rate-0_minute-0p1")
    learns = page.get_by_role("switch", name="Learning")
    expect(learns).not_to_be_checked()
    learns.check()
    page.wait_for_function("location.hash === '#explorer_agent-places_run-0'")
    press(page, "red")
    wait(page, "ended")
    page.wait_for_function("location.hash === '#explorer_agent-places_start-red'")
    press(page, "link")
    expect(page.locator(".said")).to_contain_text("It makes red good again.")


def test_an_agent_that_learns_contacts_has_no_switch_since_its_learning_does_not_stop(visit):
    page = visit("#explorer_agent-foveated-cells-contacts-alone_start-red")
    expect(page.get_by_role("switch", name="Learning")).to_have_count(0)
    expect(page.locator(".said")).to_contain_text("First it learns for 50 minutes")


def test_the_way_to_a_corner_is_shown_once_it_is_learned(visit):
    page = visit()
    press(page, "corner")
    page.wait_for_function("document.querySelector('.neorl-explorer').dataset.goal === '0'")
    wait(page, "ended")
    assert shown(page, "step") == "12000"
    assert page.locator('[name="map"]').input_value() == "PC N5"
    run = Run(PLACES, TANK, SIZE["seed"], 0)
    run.advance(SIZE["steps"])
    ways = as_vectors(run.q(0)[:, :, 0].astype(float))
    learned = ways.any(axis=1) & (np.arange(25) > 0)
    towards = learned & (np.sum(ways * [(-(cell % 5), -(cell // 5)) for cell in range(25)], axis=1) > 0)
    expect(page.locator(".said")).to_contain_text(
        f"Arrows in {learned.sum()} of the 24 other cells, learned without being asked; {towards.sum()} point towards")


def test_playing_again_repeats_the_run_with_the_same_settings(visit):
    page = visit("#explorer_run-4_red-0p5")
    wait(page, "ended")
    score = shown(page, "score")
    keep_states(page)
    press(page, "play")
    wait_for_states(page, "running", "ended")
    assert shown(page, "score") == score
    expect(page.locator('[name="run"]')).to_have_value("4")
    expect(page.locator('[name="valence_red"]')).to_have_value("0.5")


def test_reset_restores_the_settings_and_a_new_run_keeps_them(visit):
    page = visit()
    page.locator('[name="valence_red"]').fill("2")
    page.locator('[name="resolutions"]').fill("4")
    page.locator('[name="resolutions"]').press("Enter")
    press(page, "new-run")
    expect(page.locator('[name="run"]')).to_have_value("1")
    expect(page.locator('[name="valence_red"]')).to_have_value("2")
    press(page, "compare")
    expect(page.locator(".second")).to_be_visible()
    page.locator('[name="heat"]').check()
    page.locator('[name="speed"]').fill("2")
    press(page, "reset")
    expect(page.locator(".second")).to_be_hidden()
    expect(page.locator('[name="heat"]')).not_to_be_checked()
    expect(page.locator('[name="speed"]')).to_have_value("10")
    expect(page.locator('[name="run"]')).to_have_value("0")
    expect(page.locator('[name="valence_red"]')).to_have_value("-1")
    expect(page.locator('[name="resolutions"]')).to_have_value("5, 3")


def test_an_element_drops_where_the_next_click_is(visit):
    page = visit()
    press(page, "drop")
    expect(page.locator(".said")).to_contain_text("Click where")
    tank = page.locator(".arena canvas")
    box = tank.bounding_box()
    tank.click(position={"x": 0.25 * box["width"], "y": 0.75 * box["height"]})
    expect(page.locator(".interest")).to_have_attribute("style", re.compile(r"left: 2[45].*top: 7[45]"))
    expect(page.locator('[data-action="drop"]')).to_have_attribute("aria-pressed", "false")


@pytest.mark.parametrize("name, typed, kept", [
    ("resolutions", "0, 3", "5, 3"), ("seed", "-1", "3")])
def test_refused_input_reverts_to_the_last_valid_value_and_the_reason_stands_below_it(visit, name, typed, kept):
    page = visit()
    page.locator("summary").click()
    field = page.locator(f'[name="{name}"]')
    field.fill(typed)
    field.press("Enter")
    expect(field).to_have_value(kept)
    expect(field).to_have_attribute("aria-invalid", "true")
    message = page.locator(".refused")
    expect(message).to_contain_text("hole numbers from")
    assert 0 < message.bounding_box()["y"] - field.bounding_box()["y"] < 100  # below the field
    field.fill("7")
    field.press("Enter")
    expect(field).not_to_have_attribute("aria-invalid", "true")
    expect(page.locator(".refused")).to_have_text("")


def test_a_link_leads_to_a_moment_of_a_run(visit):
    page = visit("#explorer_agent-things_run-7_minute-2_map-ovc-n4_goal-5")
    page.wait_for_function("document.querySelector('.neorl-explorer').dataset.goal === '5'")
    assert (shown(page, "state"), shown(page, "step"), shown(page, "condition")) == ("paused", "6000", "things")
    assert float(shown(page, "score")) == Run(object_vector_cells([4]), TANK, SIZE["seed"], 7).advance(6_000)


def test_the_address_of_a_moment_leads_back_to_it(visit):
    page = visit()
    page.locator("summary").click()
    page.locator('[name="valence_red"]').fill("0.5")
    page.locator('[name="run"]').fill("4")
    page.locator('[name="run"]').press("Enter")
    page.locator('[name="speed"]').fill("5")
    press(page, "play")
    page.wait_for_function("document.querySelector('.neorl-explorer').dataset.step > 500")
    press(page, "play")
    page.wait_for_function("""() => {
        const { step } = document.querySelector('.neorl-explorer').dataset;
        const [minute, second] = [Math.floor(step / 3000), (step % 3000) / 50];
        return location.hash.endsWith(`_minute-${minute}` + (second ? `_second-${second}`.replace(".", "p") : ""));
    }""")  # not the address of an earlier moment
    before = {name: shown(page, name) for name in ("step", "score")}
    assert "_red-0p5" in page.url and "_run-4" in page.url
    again = visit(page.url[page.url.index("#"):])
    again.wait_for_function(f"document.querySelector('.neorl-explorer').dataset.step == {before['step']}")
    wait(again, "paused")
    assert {name: shown(again, name) for name in before} == before


def test_a_link_leads_to_its_run_even_if_the_address_of_the_last_one_was_written_in_between(visit):
    page = visit("#explorer_agent-things_minute-0")
    page.evaluate("""() => {
        const newURL = new URL("#explorer_agent-things_run-7_minute-2", location.href).href;
        window.dispatchEvent(new HashChangeEvent("hashchange", { newURL }));
    }""")
    page.wait_for_function("document.querySelector('.neorl-explorer').dataset.step === '6000'")
    assert float(shown(page, "score")) == Run(object_vector_cells([4]), TANK, SIZE["seed"], 7).advance(6_000)


def test_the_address_has_the_state_of_object_vectors(visit):
    page = visit("#explorer_agent-things_state-self_minute-2")
    page.wait_for_function("document.querySelector('.neorl-explorer').dataset.step === '6000'")
    agent = object_vector_cells([4], object_state="self")
    assert float(shown(page, "score")) == Run(agent, TANK, SIZE["seed"], 0).advance(6_000)
    page.locator('[name="object_state"]').select_option("object")
    page.wait_for_function("location.hash === '#explorer_agent-things_run-0_state-object'")
    page.locator('[name="object_state"]').select_option("per object")
    page.wait_for_function("location.hash === '#explorer_agent-things_run-0'")


def test_a_slider_of_the_previous_agent_does_no_harm_and_the_same_agent_starts_again(visit):
    page = visit("#explorer_agent-network-d_minute-0")
    page.locator("summary").click()
    page.locator('[name="preset"]').evaluate("""menu => {
        const root = menu.closest(".neorl-explorer");
        const gain = root.querySelector("[name=gain-1]");
        const turn = (control, value) => {
            control.value = value;
            control.dispatchEvent(new Event("input", { bubbles: true }));
        };
        turn(menu, "places");
        turn(gain, 3);
    }""")
    page.wait_for_function("document.querySelector('.neorl-explorer').dataset.condition === 'places'")
    expect(page.locator("[role=alert]")).to_be_hidden()
    wait(page, "paused")
    page.evaluate("""() => {  // at once, or the first frame may be drawn in between
        window.sound = CanvasRenderingContext2D.prototype.clearRect;
        CanvasRenderingContext2D.prototype.clearRect = () => undefined.there;
        document.querySelector('[data-action="step"]').click();
    }""")
    wait(page, "failed")
    page.evaluate("() => { CanvasRenderingContext2D.prototype.clearRect = window.sound; }")
    page.locator('[name="preset"]').dispatch_event("input")
    wait(page, "paused")


def test_elements_go_with_their_agent_or_all_at_once(visit):
    page = visit()
    for _ in range(2):
        drop_by_keyboard(page)
    expect(page.locator(".interest")).to_have_count(2)
    page.locator('[name="preset"]').select_option("things")
    expect(page.locator(".interest")).to_have_count(0)
    wait(page, "paused")
    for _ in range(2):
        drop_by_keyboard(page)
    press(page, "clear")
    expect(page.locator(".interest")).to_have_count(0)
    expect(page.locator('[data-action="clear"]')).to_be_hidden()


def test_the_address_follows_a_run_that_goes_on(visit):
    page = visit("#explorer_agent-network-d_minute-0")
    page.locator('[name="speed"]').fill("0")  # so that no run ends
    page.locator('[name="valence_red"]').fill("1")
    press(page, "corner")
    page.wait_for_function("location.hash.includes('_red-1') && location.hash.includes('_goal-0')")
    press(page, "game")
    press(page, "reset")
    wait(page, "running")
    page.wait_for_function("location.hash === '#explorer_agent-network-d_run-0'")


def test_screen_readers_hear_whole_sentences(visit):
    page = visit("#explorer_minute-2")
    page.wait_for_function("document.querySelector('.neorl-explorer').dataset.step === '6000'")
    press(page, "play")
    wait(page, "ended")
    told = page.locator(".told")
    expect(told).to_contain_text("Run 0 is over: its score is")
    expect(told).not_to_contain_text("..")


def test_the_score_of_a_game_stands_above_the_tank(visit):
    page = visit()
    press(page, "game")
    score = page.get_by_text(re.compile("You: [−\\d]+"))
    expect(score).to_contain_text("neoRL: ")
    assert score.bounding_box()["y"] < page.locator(".arena").bounding_box()["y"]


def test_a_link_within_the_page_brings_the_tank_into_view_or_the_reason_of_its_refusal(visit):
    page = visit("", viewport={"width": 400, "height": 800})
    page.evaluate("""() => {
        document.body.style.width = "auto";
        document.body.insertAdjacentHTML("beforeend", "<div style='height: 2000px'></div>"
            + "<a href='#explorer_start-corner'>The way to a corner</a>");
    }""")
    for _ in range(2):  # also when the address is that of the link already
        page.evaluate("document.querySelector('.neorl-explorer').dataset.goal = ''")  # that of the click before
        page.get_by_role("link").click()
        page.wait_for_function("document.querySelector('.neorl-explorer').dataset.goal === '0'")
        page.wait_for_function("""() => {
            const { top, bottom } = document.querySelector(".arena").getBoundingClientRect();
            return top > 0 && bottom < innerHeight;
        }""")
    page.evaluate("location.hash = '#explorer_agent-nobody'")
    expect(page.locator(".refused")).to_be_in_viewport()


def test_an_address_without_an_agent_is_one_of_the_agent_with_which_the_page_begins(visit):
    page = visit()
    page.locator('[name="preset"]').select_option("Arm of two links")
    page.evaluate("location.hash = '#explorer_start-red'")
    expect(page.locator(".said")).to_contain_text("Red creeps are desirable now")
    expect(page.locator('[name="preset"]')).to_have_value("places")


@pytest.mark.parametrize("address, reason", [
    ("#explorer_agent-nobody", "There is no agent “nobody”"), ("#explorer_run--1", "run = -1"),
    ("#explorer_minute-soon", "Its minute must be"),
    ("#explorer_agent-water-maze-platform-moved_start-red", "Only an agent that avoids red creeps"),
    ("#explorer_agent-foveated-cells-contacts-alone_start-corner", "Only an agent with cells as goals"),
    ("#explorer_agent-arm-of-two-links_start-game", "Only an agent among creeps")])
def test_an_invalid_address_is_reported_and_the_page_stays_as_it_is(visit, address, reason):
    page = visit(address)
    expect(page.locator(".refused")).to_contain_text(reason)
    assert (shown(page, "condition"), shown(page, "step")) == ("places", "0")
