"""The star of the front page: the page runs what Python runs, readers move the star, and nothing shifts or fails."""

import re
from functools import partial
from io import BytesIO
from pathlib import Path

from writing import moving
import neorl
import numpy as np
import pytest
from writing import star
from axe_playwright_python.sync_playwright import Axe
from PIL import Image

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("star")
    for name in ("book.css", "star.png"):
        (folder / "_static").mkdir(exist_ok=True)
        (folder / "_static" / name).write_bytes((ROOT / "book" / "vendor" / name).read_bytes())
    page = star.page().replace("const SPEED = 2;", "const SPEED = 20;")  # so that tests wait less
    assert "const SPEED = 20;" in page
    (folder / "index.html").write_text(
        '<!doctype html><html lang="en"><meta charset="utf-8"><title>Star</title><link rel="icon" href="data:,">'
        '<link rel="stylesheet" href="_static/book.css"><main class="bd-content"><section><h1>Star</h1>'
        f'{page}</section><p id="below" style="margin-top: 3000px">Below</p></main>')
    return folder


def opened(open_page, folder, **options):
    page = open_page(folder, "index.html", **options)
    page.wait_for_selector(".neorl-star:is([data-state=running], [data-state=paused])")
    return page


@pytest.fixture
def open_star(open_page, folder):
    return partial(opened, open_page, folder)


@pytest.fixture(scope="module")
def page(open_shared_page, folder):
    """A page for what readers do one after the other, since each begins with a lesson of 100 minutes.

    It runs on until all tests of the file are over, so those that use it come last.
    """
    return opened(open_shared_page, folder)


def distances(page):
    return [float(page.locator("tbody tr").nth(row).locator("td").first.inner_text()) for row in (0, 1)]


def wait_for(page, seconds):
    page.wait_for_function("seconds => Number(document.querySelector('.neorl-star').dataset.seconds) >= seconds",
                           arg=seconds)


def test_the_agent_is_closer_to_the_star_than_one_that_knows_nothing():
    runs = [star.experienced(), neorl.Run(star.with_star(star.AGENT, star.START), star.TANK, star.SEED)]
    means = []
    for run in runs:
        found = []
        for place in moving.PLACES:
            run.change(star.with_star(star.AGENT, place))
            found.append(np.hypot(*(run.record(1_500).positions / star.TANK.width - place).T).mean())
        means.append(np.mean(found))
    assert means[0] < 0.2 and means[1] > 2 * means[0], means


def test_it_pauses_out_of_view_and_begins_paused_for_readers_who_want_less_motion(open_star):
    page = open_star(reduced_motion="reduce")
    root = page.locator(".neorl-star")
    assert root.get_attribute("data-state") == "paused"
    page.locator("[data-action=play]").click()
    page.wait_for_selector("[data-state=running]")
    page.locator("#below").scroll_into_view_if_needed()
    page.wait_for_selector("[data-state=paused]", state="attached")
    page.evaluate("scrollTo(0, 0)")
    page.wait_for_selector("[data-state=running]")


@pytest.mark.parametrize("width", [1200, 400])
def test_nothing_shifts_and_readers_without_scripts_have_a_picture_and_a_sentence(open_star, open_page, folder, width):
    viewport = {"width": width, "height": 800}
    page = open_star(viewport=viewport)
    wait_for(page, 1)
    shifts = page.evaluate("""() => new Promise((resolve) => {
        new PerformanceObserver((list) => resolve(list.getEntries().reduce((sum, entry) => sum + entry.value, 0)))
            .observe({ type: "layout-shift", buffered: true });
        setTimeout(() => resolve(0), 500); })""")
    assert shifts < 0.05
    assert Axe().run(page, options={"resultTypes": ["violations"]}).violations_count == 0
    silent = open_page(folder, "index.html", viewport=viewport, java_script_enabled=False)
    assert silent.locator(".still").is_visible() and silent.locator("noscript p").is_visible()
    assert silent.locator(".still").bounding_box() == page.locator(".tank canvas").bounding_box()
    page.emulate_media(media="print")
    assert page.locator(".still").is_visible() and not page.locator(".buttons").is_visible()


def test_a_browser_without_webassembly_has_a_sentence_and_the_picture(open_page, folder):
    page = open_page(folder, "index.html")
    page.add_init_script("delete window.WebAssembly")
    page.reload()
    page.wait_for_selector("[data-state=failed]")
    assert page.get_by_role("alert").inner_text().startswith("This browser cannot run the simulation")
    assert page.locator(".still").is_visible()


def test_the_moving_picture_shows_both_tanks_and_is_the_same_twice():
    few = {"places": moving.PLACES[:2], "seconds": 1, "lesson": 1_000, "dots": 20}
    (film, still), again = moving.film(**few), moving.film(**few)
    assert (film, still) == again
    for content, frames in ((film, 2 * moving.FRAMES), (still, 1)):
        with Image.open(BytesIO(content)) as image:
            assert getattr(image, "n_frames", 1) == frames


def test_the_star_is_wanted_by_every_node_and_nothing_else_changes():
    agent = star.with_star(star.AGENT, (0.2, 0.3))
    *own, first, second = agent.desires
    assert tuple(own) == star.AGENT.desires
    assert {first.target, second.target} == {node.name for node in star.AGENT.nodes}
    assert first.source == neorl.Place(0.2, 0.3) and np.isclose(first.valence, star.VALENCE)


def test_the_page_runs_what_python_runs(page):
    wait_for(page, 2)
    step, at = page.evaluate("(({ step, at }) => [step, at])(document.querySelector('.neorl-star').dataset)")
    run = star.experienced()
    run.advance(int(step))
    assert [*map(float, at.split())] == [*(run.world_state.scene.position / star.TANK.width)]


def test_the_agent_follows_the_star_that_its_reader_drags(page):
    tank = page.locator(".tank canvas").bounding_box()
    found = []
    for x, y in ((0.15, 0.85), (0.85, 0.85), (0.15, 0.15), (0.85, 0.15)):
        handle = page.locator("button.star").bounding_box()
        page.mouse.move(handle["x"] + handle["width"] / 2, handle["y"] + handle["height"] / 2)
        page.mouse.down()
        page.mouse.move(tank["x"] + x * tank["width"], tank["y"] + y * tank["height"], steps=4)
        page.mouse.up()
        wait_for(page, 16)
        found.append(distances(page)[0])
    assert sorted(found)[2] < 0.3, found  # it may be held up at a wall once


def test_the_star_moves_by_keyboard_and_by_a_click_and_says_where_it_is(page):
    handle, tank = page.locator("button.star"), page.locator(".tank canvas")
    box = tank.bounding_box()
    tank.click(position={"x": box["width"] / 2, "y": box["height"] / 2})
    page.wait_for_selector("button.star[aria-label^='The star, 50 % from the left and 50 % from the top']")
    handle.focus()
    page.keyboard.press("ArrowLeft")
    page.keyboard.press("ArrowDown")
    page.wait_for_selector("button.star[aria-label^='The star, 46 % from the left and 54 % from the top']")
    assert page.evaluate("scrollY") == 0


def test_the_switches_forget_and_make_red_good_and_are_undone(page):
    lived = page.locator(".lived")
    assert lived.inner_text() == "It has learned for 100 minutes, without a star."
    forget, red = (page.locator(f"[data-action={name}]") for name in ("forget", "red"))
    forget.click()
    page.wait_for_selector("[data-action=forget][aria-pressed=true]")
    page.wait_for_selector(".lived:text-is('It has forgotten everything.')")
    red.click()
    page.wait_for_selector("[data-action=red][aria-pressed=true]")
    forget.click()
    page.wait_for_selector("[data-state=learning]")
    assert re.fullmatch(r"It learns for 100 minutes: \d+ …", lived.inner_text())
    page.wait_for_selector("[data-state=running]")
    red.click()
    page.wait_for_selector("[data-action=red][aria-pressed=false]")
