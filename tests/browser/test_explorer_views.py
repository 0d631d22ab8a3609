"""The Explorer and the Replay where a host renders them before it shows them, changes its look, or shows them twice."""

import pytest
from explorer_page import COLOURS, coloured, press, wait, write_page
from companion.shared.replay import Replay, record
from playwright.sync_api import expect

from neorl import Condition, Explorer, Run, WaterWorld, place_cells

AGENT, TANK = place_cells([3]), WaterWorld(n_creeps=8)
CONDITION = Condition(AGENT, TANK, steps=600, runs=1)
# The host appends each place to the page. Here it is kept instead, until the test appends it.
KEEP = "<script>HTMLScriptElement.prototype.after = function (place) { window.place = place; };</script>"
TWO_FRAMES = "new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))"
PURPLE = [250, 0, 250]
THEME = "body[data-jp-theme-name='purple'] { --jp-ui-font-color1: rgb(250 0 250); }"


@pytest.mark.parametrize("into", ["page", "fold"])
def test_rendered_outside_the_page_it_is_complete_once_it_is_shown(open_page, tmp_path, into):
    write_page(tmp_path, [Explorer(CONDITION, speed=0.0)])
    page_path = tmp_path / "page.html"
    page_path.write_text(page_path.read_text().replace("<body", f"{KEEP}<body", 1))
    page = open_page(tmp_path, "page.html#explorer_run-2")
    page.wait_for_function("window.place?.querySelector('.neorl-explorer')")
    page.evaluate("""into => {
        const fold = Object.assign(document.createElement("details"), { open: into === "page" });
        fold.append(window.place);
        document.body.append(fold);
    }""", into)
    if into == "fold":
        page.evaluate(TWO_FRAMES)
        expect(page.locator(".neorl-explorer")).to_have_attribute("data-state", "loading")
        page.evaluate("document.querySelector('details').open = true")
    wait(page, "ended")
    assert float(page.locator(".neorl-explorer").get_attribute("data-score")) == Run(AGENT, TANK, run=2).advance(600)
    assert min(coloured(page.locator(".arena canvas")).values()) > 20
    assert coloured(page.locator(".curve"), agent=COLOURS["agent"])["agent"] > 20


@pytest.mark.parametrize("widget", [Explorer, Replay])
@pytest.mark.parametrize("late", ["name", "style sheet"])
def test_it_takes_the_colours_of_a_theme_however_late_they_arrive(open_page, tmp_path, widget, late):
    shown = {Explorer: lambda: Explorer(CONDITION, playing=False),
             Replay: lambda: Replay([record("one", Run(AGENT, TANK), 50)], playing=False)}[widget]()
    write_page(tmp_path, [shown])
    (tmp_path / "theme.css").write_text(THEME)
    page = open_page(tmp_path, "page.html")
    wait(page, "paused")
    tank = page.locator(".arena canvas").first
    assert coloured(tank, ink=PURPLE) == {"ink": 0}
    by_name = "document.body.dataset.jpThemeName = 'purple'"
    by_sheet = """new Promise((done) => document.body.append(Object.assign(
        document.createElement("link"), { rel: "stylesheet", href: "theme.css", onload: done })))"""
    for step in [by_name, by_sheet] if late == "style sheet" else [by_sheet, by_name]:
        page.evaluate(step)
        page.evaluate(TWO_FRAMES)
    assert coloured(tank, ink=PURPLE)["ink"] > 100


def test_two_views_of_a_widget_show_one_run(open_page, tmp_path):
    explorer = Explorer(CONDITION, playing=False, speed=0.0)
    write_page(tmp_path, [explorer, explorer])
    page = open_page(tmp_path, "page.html#explorer_run-2_minute-0p1")
    places = page.locator(".neorl-place")
    expect(places).to_have_count(2)
    for place in (1, 0):
        shown = places.nth(place).locator(".arena")
        if not place:
            page.get_by_role("button", name="Show it here").click()
        expect(shown).to_be_visible()
        expect(page.locator(".neorl-explorer .arena")).to_have_count(1)
        expect(page.locator(".neorl-explorer[data-step]")).to_have_attribute("data-step", "300")
    press(page, "step")
    expect(page.locator(".neorl-explorer[data-step]")).to_have_attribute("data-step", "301")
