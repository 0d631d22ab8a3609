"""What the Explorer says and saves of a run, how it is operated, and where its parts stand."""

import re
from dataclasses import replace

import numpy as np
import pytest
from explorer_page import (COLOURS, coloured, drop_by_keyboard, explorer_of, picture, press, wait, wait_for_score,
                           write_page)
from matplotlib import pyplot as plt
from playwright.sync_api import expect
from traitlets import TraitError

from neorl import (Condition, Desire, Explorer, Place, Run, WaterWorld, multimodal, object_vector_cells, place_cells,
                   simulate)
from neorl.browser.explorer import LITTLE_HAPPENS

TANK, PLACES = WaterWorld(), place_cells([5, 3])
SIZE = {"steps": 20_000, "runs": 12, "seed": 3, "progress": False}
DATA = "document.querySelector('.neorl-explorer').dataset"


@pytest.fixture(scope="module")
def conditions():
    return {"places": simulate(PLACES, TANK, **SIZE)}


@pytest.fixture
def visit(open_page, tmp_path, conditions):
    """`visit(address, options of the context, trait=value)` opens a page with an Explorer at an address."""
    def visit(address="", options=None, **traits):
        write_page(tmp_path, [Explorer(conditions, **{"playing": False, "speed": 0.0} | traits)])
        page = open_page(tmp_path, f"page.html{address}", **options or {})
        wait(page, "paused|running|ended")
        return page
    return visit


def run_of(agent=PLACES, run=0):
    return Run(agent, TANK, SIZE["seed"], run)


def bottom(box):
    return box["y"] + box["height"]


def test_what_it_wants_is_said_and_follows_the_settings(visit):
    page = visit()
    wants = page.locator(".wants")
    expect(wants).to_have_text("Wants: green +1, red −1")
    page.locator('[name="valence_red"]').fill("0.5")
    expect(wants).to_have_text("Wants: green +1, red +0.5")
    drop_by_keyboard(page)
    page.locator('[name="element-valence"]').fill("2")
    expect(wants).to_have_text("Wants: green +1, red +0.5, element +2")
    page.locator('[name="preset"]').select_option("Water maze, platform moved")
    expect(wants).to_have_text("Wants: platform +1")


def test_what_is_caught_is_said_by_colour_and_saved_with_the_reward(visit, conditions):
    page = visit()
    press(page, "play")
    wait(page, "ended")
    result, band = conditions["places"], Explorer(conditions)._presets["places"]["band"]
    begins = np.flatnonzero(np.isin(result.edges[:-1], band["edges"][:-1]))
    hits, rewards = (np.add.reduceat(each[0], begins, axis=0) for each in (result.hits, result.rewards))
    last = 60 * hits[-1] / np.diff(band["edges"])[-1]
    expect(page.locator(".of-catches")).to_have_text(f"Caught a minute: green {last[0]:.3g}, red {last[1]:.3g}")
    with page.expect_download() as download:
        press(page, "csv")
    assert download.value.suggested_filename == "places-run-0.csv"
    head, *rows = download.value.path().read_text().splitlines()
    assert head == "second,reward,green,red"
    saved = np.array([row.split(",") for row in rows], float)
    assert np.array_equal(saved, np.column_stack([band["edges"][1:], rewards, hits]))


def test_what_was_caught_before_a_change_of_the_agent_s_maps_still_counts(visit, tmp_path, open_page):
    joins = simulate(PLACES, TANK, changes=[(10_000, place_cells([5, 3, 2]))], **SIZE)
    write_page(tmp_path, [Explorer({"joins": joins}, playing=False, speed=0.0)])
    page = open_page(tmp_path, "page.html")
    wait(page, "paused")
    press(page, "play")
    wait(page, "ended")
    with page.expect_download() as download:
        press(page, "csv")
    counted = np.genfromtxt(download.value.path(), delimiter=",", skip_header=1)[:, 2:].sum(axis=0)
    assert counted.tolist() == joins.hits[0].sum(axis=0).tolist()


def test_a_picture_has_the_tank_with_its_elements_on_the_colour_of_the_page(visit):
    page = visit()
    greens = []
    for _ in range(2):
        with page.expect_download() as download:
            press(page, "picture")
        saved = plt.imread(download.value.path())
        assert np.all(saved[0, 0] == 1)
        middle = saved[len(saved) // 2 - 20:len(saved) // 2 + 20]
        greens.append(np.sum(np.all(abs(255 * middle[..., :3] - COLOURS["green"]) < 2, axis=-1)))
        drop_by_keyboard(page)
    assert greens[0] < greens[1]


def test_a_run_that_is_over_goes_on_also_when_a_setting_is_changed(visit):
    page = visit()
    press(page, "play")
    wait(page, "ended")
    press(page, "go-on")
    run = run_of()
    score = run.advance(40_000)
    wait_for_score(page, 40_000, score)
    page.locator('[name="valence_red"]').fill("1")
    run.change(replace(PLACES, desires=[replace(each, valence=1.0) for each in PLACES.desires]))
    wait_for_score(page, 80_000, score + run.advance(40_000))


def test_a_link_leads_beyond_the_first_end_of_a_run(visit):
    page = visit("#explorer_minute-10_second-0p5")
    wait_for_score(page, 30_025, run_of().advance(30_025))


def test_a_link_has_what_was_dropped_and_says_what_it_leaves_out(visit):
    dropped = "#explorer_agent-places_run-0_minute-2_elements-0p25-0p75--1p5-0p5-0p5-1"
    page = visit(dropped)
    expect(page.locator(".interest")).to_have_text(["−1.5", "+1"])
    desires = [Desire(Place(0.25, 0.75), "PC", -1.5), Desire(Place(0.5, 0.5), "PC", 1.0)]
    press(page, "link")
    expect(page.locator(".said")).to_contain_text("the link begins it anew, with the present settings, and drops")
    page.wait_for_function("hash => location.hash === hash", arg=dropped)
    press(page, "play")
    run = run_of()
    score = run.advance(6_000)
    run.change(replace(PLACES, desires=[*PLACES.desires, *desires]))
    wait_for_score(page, 20_000, score + run.advance(14_000))
    for wrong in ("0p5-0p5", "0p5-2-1", "0p5-0p5-1-" * 5 + "0p5-0p5-1"):
        page.evaluate("hash => { location.hash = hash; }", f"#explorer_elements-{wrong}")
        expect(page.locator(".refused")).to_contain_text("Its elements must be at most 5")
        expect(page.locator(".interest")).to_have_count(2)
        page.evaluate("document.querySelector('.refused').textContent = ''")


@pytest.mark.parametrize("width", [400, 1200])
def test_the_reason_for_which_an_address_is_refused_stands_above_the_tank_also_beside_folded_controls(visit, width):
    page = visit("#explorer_agent-nonsense", {"viewport": {"width": width, "height": 800}}, control="preset")
    reason = page.locator(".refused")
    expect(reason).to_contain_text("There is no agent “nonsense”")
    expect(reason).to_be_in_viewport(ratio=1)
    box, tank = reason.bounding_box(), page.locator(".arena").bounding_box()
    assert 0 <= tank["y"] - box["y"] - box["height"] < 50
    assert not page.locator("details").evaluate("folded => folded.open")


def test_on_paper_the_tank_and_the_curves_stand_in_light_colours_without_controls(visit):
    page = visit(options={"color_scheme": "dark"})
    press(page, "play")
    wait(page, "ended")
    dark, light = (0xe6, 0xed, 0xf3), (0x24, 0x29, 0x2f)
    tank, curve = page.locator(".arena canvas"), page.locator("canvas.curve")
    on_screen = [coloured(each, dark=dark, light=light) for each in (tank, curve)]
    assert all(each["dark"] > 100 > each["light"] for each in on_screen)
    page.evaluate("dispatchEvent(new Event('beforeprint'))")
    page.emulate_media(media="print")
    printed = [coloured(each, dark=dark, light=light) for each in (tank, curve)]
    assert all(each["light"] > 100 > each["dark"] for each in printed)
    for canvas in (tank, curve):
        expect(canvas).to_be_visible()
    for control in ("button", "input", "summary"):
        assert not any(each.is_visible() for each in page.locator(f".neorl-explorer {control}").all())
    page.emulate_media(media="screen")
    page.evaluate("dispatchEvent(new Event('afterprint'))")
    assert [coloured(each, dark=dark, light=light) for each in (tank, curve)] == on_screen


def test_the_tank_is_the_first_stop_of_the_keyboard_and_space_plays_and_pauses(visit):
    page = visit(speed=1.0)
    page.locator("body").press("Tab")
    tank = page.locator(".arena canvas")
    expect(tank).to_be_focused()
    for state in ("running", "paused"):
        page.keyboard.press("Space")
        wait(page, state)
    top, text = tank.bounding_box()["y"], page.locator(".wants").bounding_box()
    assert top - 4 >= bottom(text)  # the ring of the focus is below the text


def test_the_tank_alone_fills_the_screen(visit):
    page = visit()
    before = page.locator(".arena").bounding_box()["width"]
    press(page, "alone")
    page.wait_for_function("document.fullscreenElement?.matches('.neorl-explorer')")
    expect(page.locator(".side")).to_be_hidden()
    box = page.locator(".arena").bounding_box()
    assert box["width"] > before and bottom(box) <= page.viewport_size["height"]
    expect(page.locator(".arena canvas")).to_be_focused()
    page.evaluate("document.exitFullscreen()")
    expect(page.locator(".side")).to_be_visible()


@pytest.mark.parametrize("chosen", [True, False])
def test_networks_begin_where_something_happens(visit, chosen):
    page = visit(playing=True, **{} if chosen else {"preset": "Network D"})
    if chosen:
        page.locator('[name="preset"]').select_option("Network D")
    page.wait_for_function(f"Number({DATA}.step) >= {LITTLE_HAPPENS}")
    expect(page.locator(".said")).to_contain_text("The first 40 minutes were at full speed")
    press(page, "reset")
    page.wait_for_function(f"Number({DATA}.step) < {LITTLE_HAPPENS}")


def test_few_buttons_are_in_sight_and_the_others_are_a_key_away(visit):
    page = visit()
    expect(page.locator(".board button:visible")).to_have_text([
        "Play", "Make red good", "Reset", "Take the tour", "Newborn beside veteran", "Play against it",
        "Drop an element"])
    page.locator("summary").press("Enter")
    expect(page.locator(".more .buttons button:visible")).to_have_text([
        "Step", "New run", "Watch it learn", "Show the way to a corner", "Copy link", "Save picture", "Save as CSV",
        "Tank only"])


@pytest.mark.parametrize("screen, column", [(1200, 849), (400, 368)])
def test_the_name_of_the_agent_is_shown_whole_in_a_column_of_the_book(open_page, tmp_path, conditions, screen, column):
    write_page(tmp_path, [Explorer({"Paper B, figure 5: place + object-vector cells": conditions["places"]})])
    page = open_page(tmp_path, "page.html", viewport={"width": screen, "height": 800})
    page.evaluate("style => { document.body.style.cssText = style; }", f"width: {column}px; font: 16px sans-serif")
    wait(page, "running|ended")
    assert page.locator('[name="preset"]').evaluate("""menu => {
        const { font, paddingLeft, paddingRight } = getComputedStyle(menu);
        const context = document.createElement("canvas").getContext("2d");
        context.font = font;
        const [text, arrow] = [context.measureText(menu.selectedOptions[0].text).width, 24];
        return parseFloat(paddingLeft) + text + arrow + parseFloat(paddingRight) <= menu.clientWidth;
    }""")


def test_each_agent_stands_in_one_menu(visit):
    page = visit()
    options = page.locator("select:visible option").all_inner_texts()
    assert "places" in options and len(options) == len(set(options))


def test_no_slider_of_a_single_node_is_without_effect(visit):
    page = visit()
    page.locator("summary").click()
    expect(page.locator('[name="gain-0"]')).to_be_hidden()
    page.locator('[name="preset"]').select_option("Network D")
    expect(page.locator('[name="gain-0"]')).to_be_visible()


def test_on_a_phone_the_buttons_of_the_game_stand_below_the_tank(visit):
    page = visit(options={"viewport": {"width": 400, "height": 800}, "has_touch": True, "is_mobile": True})
    press(page, "game")
    expect(page.locator(".said")).to_contain_text("Steer with the four buttons.")
    pad, tank = (page.locator(each).bounding_box() for each in (".pad", ".arena"))
    assert pad["y"] >= bottom(tank) and pad["height"] < 60


def test_no_way_leads_out_of_the_chosen_cell(visit):
    page = visit("#explorer_minute-6_map-pc-n5_goal-12")
    page.wait_for_function(f"{DATA}.goal === '12' && {DATA}.state === 'paused'")
    picture(page)
    arrows = page.locator(".arena canvas").evaluate("""canvas => {
        const { width } = canvas;
        const copy = Object.assign(document.createElement("canvas"), { width, height: width });
        const context = copy.getContext("2d", { willReadFrequently: true });
        context.drawImage(canvas, 0, 0);
        const inside = (column, row) => {
            const [side, edge] = [width / 1.11, 0.055 * width / 1.11];
            const [left, top] = [column, row].map((each) => Math.round(edge + side * (each + 0.1) / 5));
            const length = Math.round(0.16 * side);
            const { data } = context.getImageData(left, top, length, length);
            let count = 0;
            for (let at = 0; at < data.length; at += 4) {
                count += data[at + 3] > 200 && data[at] === 0xa0 && data[at + 1] === 0x3f && data[at + 2] === 0xb5;
            }
            return count;
        };
        return [0, 1, 2, 3, 4].map((row) => inside(2, row));
    }""")
    assert arrows[2] == 0 and sum(arrows) > 50


@pytest.mark.parametrize("control, preset", [("resolutions", "places"), ("recursion", "Network D")])
def test_one_control_stands_beside_the_tank_and_the_others_are_folded(visit, control, preset):
    page = visit(preset=preset, control=control)
    explorer_of(page)
    field = page.locator(f'.only [name="{control}"]')
    tank, box = (each.bounding_box() for each in (page.locator(".arena"), field))
    assert box["x"] > tank["x"] + tank["width"] and abs(box["y"] - tank["y"]) < 100
    expect(page.locator("select:visible, input:visible:not([type=checkbox])")).to_have_count(2)  # it, and the maps
    page.get_by_text("All controls").click()
    expect(page.locator('[name="speed"]')).to_be_visible()
    if control == "recursion":
        field.fill("0.5")
        page.wait_for_function(f"{DATA}.condition === ''")
        expect(field.locator("xpath=..")).to_contain_text(re.compile("Weight of recursion.*0.5", re.DOTALL))


@pytest.mark.parametrize("control, texts", [
    ("preset", ["places", "things", "few", "both"]),
    ("modality", ["place cells", "object-vector cells", "both"])])
def test_a_menu_by_itself_has_buttons_of_what_the_page_s_agents_choose(conditions, tmp_path, open_page, control, texts):
    things, both = object_vector_cells([4]), multimodal([3])
    more = {name: Condition(agent, TANK, SIZE["steps"], 1, SIZE["seed"])
            for name, agent in (("things", things), ("few", place_cells([4])), ("A figure: both", both))}
    write_page(tmp_path, [Explorer(conditions | more, "few", control=control)])
    page = open_page(tmp_path, "page.html")
    explorer_of(page)
    expect(page.locator(".only button")).to_have_text([*texts, "More …"])
    menu, pressed = page.locator(f'[name="{control}"]'), page.locator('.only [aria-pressed="true"]')
    expect(pressed).to_have_text(["few" if control == "preset" else "place cells"])
    expect(menu).to_be_hidden()
    page.get_by_role("button", name="both").click()
    expect(pressed).to_have_text(["both"])
    wait_for_score(page, SIZE["steps"], run_of(both).advance(SIZE["steps"]))
    page.get_by_role("button", name=texts[1]).click()  # of several agents, the first
    wait_for_score(page, SIZE["steps"], run_of(things).advance(SIZE["steps"]))
    expect(page.locator(".legend")).to_contain_text(f"{texts[1]}: this run")
    page.get_by_role("button", name="More").click()
    expect(menu).to_be_focused()
    if control == "modality":
        menu.select_option("head-direction cell")
        expect(pressed).to_have_count(0)


def test_a_page_about_the_explorer_has_all_controls_and_its_first_agent(visit, tmp_path, open_page, conditions):
    write_page(tmp_path, [Explorer(conditions, "Network D", control="recursion", playing=False)])
    path = tmp_path / "page.html"
    path.write_text(path.read_text().replace('<body style="width: 700px">', '<body class="neorl-whole">'))
    page = open_page(tmp_path, "page.html")
    wait(page, "paused")
    expect(page.locator('[name="preset"]')).to_have_value("places")
    expect(page.locator('[name="speed"]')).to_be_visible()
    expect(page.locator(".only")).to_have_count(0)


def test_python_refuses_another_control():
    with pytest.raises(TraitError, match="control must be '', 'preset', 'resolutions', "):
        Explorer(control="speed")


def test_a_control_by_itself_draws_a_whole_run_for_each_setting_and_keeps_the_last_curve(visit, conditions):
    page = visit(control="resolutions", playing=True, speed=5.0)
    wait_for_score(page, SIZE["steps"], conditions["places"].totals[0])
    legend = page.locator(".legend")
    expect(legend).to_contain_text("N3, N5: this run")
    assert coloured(page.locator("canvas.curve"))["agent"] > 50
    assert page.locator(".only .chips button").all_inner_texts() == ["3", "5"]
    page.locator(".only .chips button").first.click()
    wait_for_score(page, SIZE["steps"], run_of(place_cells([5])).advance(SIZE["steps"]))
    expect(legend).to_have_text("N5: this runN3, N5: the one before")
    press(page, "new-run")
    wait_for_score(page, SIZE["steps"], run_of(place_cells([5]), run=1).advance(SIZE["steps"]))
    expect(legend).to_have_text("N5: this runN3, N5: the one before")


def test_a_recorded_curve_is_there_before_the_run_of_its_setting(conditions, tmp_path, open_page):
    rising = np.linspace(0, 1, 50)
    behind = {"N3": (20 / 3, rising, rising - 0.1, rising + 0.1, "the record, 7 runs")}
    offered = conditions | {"N3": Condition(place_cells([3]), TANK, SIZE["steps"], 1, SIZE["seed"])}
    write_page(tmp_path, [Explorer(offered, "places", behind, control="resolutions")])
    page = open_page(tmp_path, "page.html")
    wait(page, "ended")
    legend = page.locator(".legend")
    expect(legend).to_contain_text("of 12 runs of places lie")
    expect(page.locator("progress")).to_be_hidden()
    page.evaluate("() => { Worker.prototype.postMessage = () => null; }")  # which answers no more
    page.locator(".only .chips button", has_text="5").click()
    expect(page.locator(".neorl-explorer")).to_have_attribute("data-state", "loading")
    expect(legend).to_have_text("N3: this runN3, N5: the one beforethe record, 7 runs")
    expect(page.locator("progress")).to_have_js_property("value", 0)
    expect(page.locator("progress")).to_be_visible()
    picture(page, "canvas.curve")
    curve = page.locator("canvas.curve")
    line = curve.evaluate("""canvas => {  // at two thirds of the run, above what any of its own earned
        const { data } = canvas.getContext("2d").getImageData(0.7 * canvas.width, 0, 1, canvas.height / 2);
        return Array.from(data).filter((value, at) => at % 4 === 3 && value > 80 && data[at - 3] < 80).length;
    }""")
    assert line > 0 and coloured(curve)["agent"] == 0


def test_with_recursion_as_its_control_a_weight_begins_a_whole_run_also_with_less_motion(visit):
    page = visit("", {"reduced_motion": "reduce"}, preset="Network D", control="recursion", playing=True)
    wait(page, "paused")
    page.locator('[name="recursion"]').fill("0.5")
    page.wait_for_function(f"{DATA}.step > 0")
    expect(page.locator(".legend")).to_contain_text("r = 0.5: this run")
    expect(page.locator(".said")).not_to_contain_text("full speed")
