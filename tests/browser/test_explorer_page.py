"""The Explorer in a page without Python starts, computes the same runs as Python, and does what the reader asks."""

import re
from dataclasses import replace

import numpy as np
import pytest
from explorer_page import (drop_by_keyboard, explorer_of, picture, play_to_the_end, press, wait,
                           wait_for_frame_in_flight, wait_for_maps, write_page)
from playwright.sync_api import expect

from neorl import Desire, Explorer, Learning, Place, Run, WaterWorld, multimodal, network_d, place_cells, simulate
from neorl.browser.explorer import GROUPS
from neorl.core.modality import OBJECT_VECTOR_CELL

SIZE = {"steps": 12_000, "runs": 12, "seed": 3, "progress": False}
TANK = WaterWorld()
BOTH, PLACES = multimodal([2, 3, 5], object_state="per object"), place_cells([5, 3])
RULE = {"learning": Learning(0.03, 0.8, credit="happened", absent_decay=0.06, terminal=False),
        "object_state": "per object", "object_tiled_fraction": 1.0, "object_beyond": "outermost", "scale": 17.86}
NETWORK = network_d([3, 4], **RULE)
TURNED = network_d([3, 4], recursion=0.5, **RULE)


@pytest.fixture(scope="module")
def conditions():
    return {"both": simulate(BOTH, TANK, **SIZE), "places": simulate(PLACES, TANK, **SIZE),
            "joins": simulate(PLACES, TANK, changes=[(4_000, multimodal([5, 3]))], **SIZE),
            "D": simulate(NETWORK, TANK, **SIZE),
            "turned": simulate(NETWORK, TANK, changes=[(4_000, TURNED)], **SIZE)}


@pytest.fixture
def site(tmp_path, conditions):
    """`site(preset, …, trait=value)` writes a page with one Explorer per preset, and returns its folder and name."""
    def write(*presets, change=None, **traits):
        explorers = [Explorer(conditions, preset, **{"playing": False, "speed": 0.0} | traits) for preset in presets]
        write_page(tmp_path, explorers, change)
        return tmp_path, "page.html"
    return write


def set_slider(page, name, value):
    if not page.locator(f'[name="{name}"]').first.is_visible():
        page.locator("summary").first.click()
    page.locator(f'[name="{name}"]').first.fill(str(value))


def wait_for_score(page, score):
    page.wait_for_function("""score => {
        const { state, score: shown } = document.querySelector(".neorl-explorer").dataset;
        return state === "ended" && Number(shown) === score;
    }""", arg=float(score))


def lived(agent, world=TANK, seed=SIZE["seed"], run=0, steps=SIZE["steps"]):
    return Run(agent, world, seed, run).advance(steps)


@pytest.mark.parametrize("over", ["http", "file"])
def test_it_starts_by_itself_and_the_reward_curve_grows(open_page, site, conditions, over):
    page = open_page(*site("both", playing=True), over)
    explorer = explorer_of(page, "running|ended")
    page.wait_for_function("document.querySelector('.neorl-explorer').dataset.step > 5000")
    wait(page, "ended")
    assert explorer.get_attribute("data-step") == str(SIZE["steps"])
    assert float(explorer.get_attribute("data-score")) == conditions["both"].totals[0] > 5


def test_the_menu_of_agents_is_in_groups_and_begins_with_the_forager(open_page, site):
    menu = open_page(*site("both")).locator('[name="preset"]')
    expect(menu.locator("option").first).to_have_text("Forager: foveated cells, contacts alone")
    first, *others = GROUPS
    labels = menu.locator("optgroup").evaluate_all("groups => groups.map(({ label }) => label)")
    assert labels == [first, "On this page", *others]


def test_runs_of_the_agent_that_is_watched_are_offered(open_page, site):
    page = open_page(*site("D"), "file")
    expect(page.locator(".open")).to_contain_text(f"of {SIZE['runs']}, as behind the figure")
    page.locator('[name="preset"]').select_option("Network D")
    expect(page.locator(".open")).to_be_hidden()


@pytest.mark.parametrize("name, run", [("both", 7), ("places", 11), ("joins", 4), ("turned", 2), ("D", 0)])
def test_a_run_opened_by_its_number_ends_with_the_score_of_python(open_page, site, conditions, name, run):
    page = open_page(*site("both", seed=99))
    explorer = explorer_of(page)
    page.locator('[name="preset"]').select_option(name)
    page.locator('[name="open-run"]').fill(str(run))
    press(page, "open")
    page.wait_for_function("document.querySelector('.neorl-explorer').dataset.step > 0")
    wait(page, "ended")
    total = conditions[name].totals[run]
    assert float(explorer.get_attribute("data-score")) == total
    nodes = (conditions[name].changes or [(0, conditions[name].agent)])[-1][1].nodes
    wait_for_maps(page, [f"{node.name} N{n}" for node in nodes for n in node.resolutions])
    expect(explorer).to_contain_text(re.compile(r"The notebook computed .* for this run: the same\."))


def test_a_condition_without_results_is_computed_in_the_page(open_page, tmp_path, conditions):
    result = conditions["joins"]
    write_page(tmp_path, [Explorer(result.condition, playing=False, speed=0.0)])
    page = open_page(tmp_path, "page.html")
    explorer_of(page)
    assert play_to_the_end(page) == result.totals[0]


@pytest.mark.parametrize("name, value, change", [
    ("valence_red", 0.5, lambda agent: replace(agent, desires=[
        replace(each, valence=0.5) if each.source == "red" else each for each in agent.desires])),
    ("recursion", 0.7, lambda agent: replace(agent, desires=[
        replace(each, valence=0.7) if each.source == each.target else each for each in agent.desires])),
    ("gain-1", 3.0, lambda agent: replace(agent, nodes=[agent.nodes[0], replace(agent.nodes[1], gain=3.0)])),
    ("exploration", 0.1, lambda agent: replace(agent, policy=replace(agent.policy, exploration=0.1))),
    ("horizon", 0.3, lambda agent: replace(agent, learning=replace(agent.learning, discount=0.5))),
    ("memory", 1.48, lambda agent: replace(agent, learning=replace(agent.learning, memory=30.0))),
])
def test_a_slider_changes_the_run_as_python_changes_the_agent(open_page, site, conditions, name, value, change):
    page = open_page(*site("D"))
    explorer_of(page)
    set_slider(page, name, value)
    score = play_to_the_end(page)
    assert score == lived(change(NETWORK))
    assert score != conditions["D"].totals[0]


def test_creeps_resolutions_modality_and_seed_begin_the_run_that_python_begins(open_page, site):
    page = open_page(*site("places"))
    explorer = explorer_of(page)
    page.locator('[name="resolutions"]').fill("4, 6")
    page.locator('[name="resolutions"]').press("Enter")
    page.locator('[name="modality"]').select_option("object-vector cell")
    set_slider(page, "n_creeps", 5)
    page.locator('[name="seed"]').fill("4294967295")
    page.locator('[name="run"]').fill("17")
    page.locator('[name="run"]').press("Enter")
    node = replace(PLACES.nodes[0], modality=OBJECT_VECTOR_CELL, resolutions=[4, 6])
    agent = replace(PLACES, nodes=[node])
    assert play_to_the_end(page) == lived(agent, WaterWorld(n_creeps=5), seed=2**32 - 1, run=17)
    assert explorer.get_attribute("data-condition") == ""


@pytest.mark.parametrize("state", ["object", "self"])
def test_the_state_of_object_vectors_in_the_menu_begins_the_run_that_python_begins(open_page, site, conditions, state):
    page = open_page(*site("both"))
    menu = page.locator('[name="object_state"]')
    expect(menu).to_have_value("per object")
    expect(menu.locator("option:checked")).to_have_text("the self, per object")
    menu.select_option(state)
    score = play_to_the_end(page)
    assert score == lived(multimodal([2, 3, 5], object_state=state)) != conditions["both"].totals[0]
    assert explorer_of(page).get_attribute("data-condition") == ""
    menu.select_option("per object")  # and the run of the preset begins at once
    wait_for_score(page, conditions["both"].totals[0])
    assert explorer_of(page).get_attribute("data-condition") == "both"


@pytest.mark.parametrize("name, agent", [("both", BOTH), ("D", NETWORK)])
def test_what_is_dropped_is_an_element_of_interest_for_the_nodes_that_count(open_page, site, name, agent):
    page = open_page(*site(name))
    explorer_of(page)
    drop_by_keyboard(page)
    page.keyboard.press("ArrowLeft")
    page.locator('[name="element-valence"]').fill("-1.5")
    element = page.locator(".interest")
    expect(element).to_have_text("−1.5")
    dropped = [Desire(Place(0.48, 0.5), node, -1.5) for node in ("PC", "OVC")]
    assert play_to_the_end(page) == lived(replace(agent, desires=(*agent.desires, *dropped)))
    press(page, "reset")
    expect(element).to_have_count(0)


def test_elements_and_creeps_are_dragged_to_where_the_pointer_goes(open_page, site):
    page = open_page(*site("both"))
    explorer_of(page)
    drop_by_keyboard(page)
    box = page.locator(".arena").bounding_box()
    for thing, x, y in ((".interest", 0.2, 0.8), (".grip", 0.7, 0.3)):
        place = page.locator(thing).first
        begin = place.bounding_box()
        page.mouse.move(begin["x"] + begin["width"] / 2, begin["y"] + begin["height"] / 2)
        page.mouse.down()
        page.mouse.move(box["x"] + 0.5 * box["width"], box["y"] + 0.5 * box["height"])
        page.mouse.move(box["x"] + x * box["width"], box["y"] + y * box["height"], steps=3)
        page.mouse.up()
        expect(place).to_have_attribute("style", re.compile(rf"left: {100 * x:.0f}\b.*top: {100 * y:.0f}\b|"
                                                            rf"left: {100 * x - 1:.0f}\.9.*top: {100 * y - 1:.0f}\.9"))
    expect(page.locator(".legend")).to_contain_text("changed on the way")


def test_a_change_on_the_way_keeps_what_was_learned(open_page, site):
    folder, name = site("both", speed=1.0)  # so that the run goes on for minutes
    page = open_page(folder, f"{name}#explorer_second-20")
    explorer = explorer_of(page)
    page.wait_for_function("document.querySelector('.neorl-explorer').dataset.step === '1000'")
    wait(page, "paused")
    press(page, "play")
    page.wait_for_function("document.querySelector('.neorl-explorer').dataset.step > 1000")
    set_slider(page, "valence_red", 1)
    page.wait_for_function("document.querySelector('.legend').textContent.includes('changed on the way')")
    press(page, "play")
    wait(page, "paused")
    wait_for_frame_in_flight(page)
    before = int(explorer.get_attribute("data-step"))
    assert 1000 < before
    press(page, "step")
    page.wait_for_function(f"document.querySelector('.neorl-explorer').dataset.step == {before + 1}")


def test_the_trail_is_drawn_unless_it_is_hidden(open_page, site):
    seconds = Run(BOTH, TANK, SIZE["seed"])
    seconds.advance(5_850)
    assert np.ptp(seconds.record(150).positions, axis=0).max() > 100  # so there is a trail of the last three
    folder, name = site("both")
    page = open_page(folder, f"{name}#explorer_minute-2")
    page.wait_for_function("document.querySelector('.neorl-explorer')?.dataset.step === '6000'")
    wait(page, "paused")
    with_trail = picture(page)
    page.locator('[name="trail"]').uncheck()
    without = picture(page)
    page.locator('[name="trail"]').check()
    assert picture(page) == with_trail != without


def test_a_click_on_a_cell_shows_how_to_get_there(open_page, site):
    page = open_page(*site("places"))
    explorer = explorer_of(page)
    play_to_the_end(page)
    arena = page.locator(".arena canvas")
    before = picture(page)
    page.locator('[name="field"]').uncheck()
    expect(page.locator(".key")).not_to_contain_text("Grey: what the agent would do")  # written as the tank is drawn
    without_field = picture(page)
    page.locator('[name="map"]').select_option("PC N5")
    page.wait_for_function("document.querySelector('.neorl-explorer').dataset.map === 'PC N5'")
    of_five = picture(page)
    assert len({before, without_field, of_five}) == 3
    box = arena.bounding_box()
    arena.click(position={"x": 0.32 * box["width"], "y": 0.68 * box["height"]})
    page.wait_for_function("document.querySelector('.neorl-explorer').dataset.goal !== ''")
    assert explorer.get_attribute("data-goal") == str(int(place_cells([5]).maps[0].encode([0.3, 0.7])))
    expect(explorer).to_contain_text("learned without being asked")
    assert picture(page) != of_five
    page.keyboard.press("Escape")
    page.wait_for_function("document.querySelector('.neorl-explorer').dataset.goal === ''")
    page.keyboard.press("ArrowDown")
    page.keyboard.press("Enter")
    page.wait_for_function("document.querySelector('.neorl-explorer').dataset.goal === '12'")


def test_arrow_keys_play_against_the_agent_and_both_scores_are_shown(open_page, site):
    page = open_page(*site("both"))
    explorer = explorer_of(page)
    press(page, "game")
    page.wait_for_function("document.querySelector('.neorl-explorer').dataset.step > 5")
    scrolled = page.evaluate("scrollY")
    page.keyboard.down("ArrowDown")
    page.wait_for_function("document.querySelector('.neorl-explorer').dataset.step > 25")
    page.keyboard.up("ArrowDown")
    expect(explorer).to_contain_text(re.compile(r"You: [−\d]+ · neoRL: [−\d]+"))
    assert page.evaluate("scrollY") == scrolled
    page.keyboard.press("Escape")
    expect(explorer).not_to_contain_text("You: ")


def test_it_pauses_out_of_view_and_in_a_hidden_tab(open_page, site):
    page = open_page(*site("both", speed=1.0, playing=True))
    explorer = explorer_of(page, "running")
    page.evaluate("document.body.style.paddingTop = '4000px'")
    wait(page, "paused")
    page.evaluate("document.body.style.paddingTop = 0")
    wait(page, "running")
    page.evaluate("""() => { Object.defineProperty(document, "hidden", { value: true, configurable: true });
                             document.dispatchEvent(new Event("visibilitychange")); }""")
    wait(page, "paused")
    wait_for_frame_in_flight(page)
    step = explorer.get_attribute("data-step")
    page.wait_for_timeout(300)
    assert explorer.get_attribute("data-step") == step


def test_with_reduced_motion_it_begins_paused(open_page, site):
    page = open_page(*site("both", playing=True), reduced_motion="reduce")
    assert explorer_of(page).get_attribute("data-state") == "paused"
    play_to_the_end(page)


def test_every_control_has_a_name_for_screen_readers(open_page, site):
    page = open_page(*site("D"))
    explorer_of(page)
    page.locator(".neorl-explorer summary").click()
    unnamed = page.evaluate("""[...document.querySelectorAll(".neorl-explorer :is(input, select, button, canvas)")]
        .filter((each) => !each.labels?.[0]?.textContent.trim() && !each.ariaLabel && !each.textContent.trim())
        .map((each) => each.outerHTML)""")
    assert unnamed == []


def spoilt(**changes):
    def change(record):
        record["state"] |= changes
    return change


def without_buffers(record):
    record["buffers"] = []


def with_a_spoilt_module(record):
    record["buffers"][0]["data"] = record["buffers"][0]["data"][:5000]


@pytest.mark.parametrize("change, sentence", [
    (spoilt(_presets={}), "this page does not hold its _presets"),
    (spoilt(_engine="not a program ("), "The simulation has stopped"),
    (spoilt(gains=[1, 2, 3]), r"cannot run with gains"), (without_buffers, "_wasm"),
    (with_a_spoilt_module, "The simulation has stopped")])
def test_a_bad_state_is_reported(open_page, site, change, sentence):
    page = open_page(*site("both", change=change, playing=True))
    expect(page.locator("[role=alert]:visible")).to_contain_text(re.compile(sentence))


@pytest.mark.parametrize("missing", ["WebAssembly", "Worker"])
def test_a_browser_without_a_required_feature_gets_a_message(chromium, open_page, site, missing):
    folder, name = site("both", playing=True)
    page_path = folder / name
    page_path.write_text(page_path.read_text().replace("<body", f"<script>delete window.{missing}</script><body", 1))
    page = open_page(folder, name)
    expect(page.locator("[role=alert]:visible")).to_contain_text("needs WebAssembly and web workers")
