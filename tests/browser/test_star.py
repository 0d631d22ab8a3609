"""The star of the front page: the page runs what Python runs, readers move the star, and nothing shifts or fails."""

import re
from dataclasses import replace
from functools import partial
from io import BytesIO
from pathlib import Path

from writing import front, moving
import neorl
import numpy as np
import pytest
from writing import star
from axe_playwright_python.sync_playwright import Axe
from PIL import Image
from playwright.sync_api import expect

ROOT = Path(__file__).parents[2]

# Moves the star as soon as the agent learns, since it may have learned before a test can look.
AT_ONCE = """<script>
    const [root, handle] = document.querySelectorAll(".neorl-star, button.star");
    new MutationObserver((_, observer) => {
        if (root.dataset.state !== "learning" || handle.hidden) return;
        observer.disconnect();
        handle.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowLeft", bubbles: true }));
        window.moved = root.dataset.state;
    }).observe(root, { attributes: true, childList: true, subtree: true });
</script>"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("star")
    for name in ("book.css", "star.png"):
        (folder / "_static").mkdir(exist_ok=True)
        (folder / "_static" / name).write_bytes((ROOT / "book" / "vendor" / name).read_bytes())
    page = front.page().replace("const SPEED = 2;", "const SPEED = 20;")  # so that tests wait less
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


def shown(page, column):
    """The numbers of both agents in a column of the table, as text."""
    return [page.locator("tbody tr").nth(row).locator("td").nth(column).inner_text() for row in (0, 1)]


def check_place(page, run):
    """The agent in the page is where a run has brought it after as many steps."""
    step, at = page.evaluate("(({ step, at }) => [step, at])(document.querySelector('.neorl-star').dataset)")
    run.advance(int(step))
    assert [*map(float, at.split())] == [*(run.world_state.scene.position / star.TANK.width)]


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


def muted(agent, name):
    """An agent whose node of this name counts for nothing."""
    return replace(agent, nodes=[replace(node, gain=0.0) if node.name == name else node for node in agent.nodes])


def test_either_kind_of_cells_leads_to_the_star_but_less_so_place_cells_that_learned_alone():
    places = neorl.place_cells()
    agents = {"both": star.AGENT, "place cells of both": muted(star.AGENT, "OVC"),
              "object vectors of both": muted(star.AGENT, "PC"), "place cells alone": places}
    near = {name: [] for name in ("untrained", *agents)}

    def arrivals(run, agent):
        for place in moving.PLACES:
            run.change(star.with_star(agent, place))
            end = run.record(30 * star.TANK.fps).positions[-1] / star.TANK.width
            yield np.hypot(*(end - place)) < 0.15

    for seed in range(8):
        teachers = {len(agent.nodes): neorl.Run(agent, star.TANK, seed + 1) for agent in (star.AGENT, places)}
        for teacher in teachers.values():
            teacher.advance(star.LESSON)
        for name, agent in agents.items():
            run = neorl.Run(agent, star.TANK, seed)
            run.transfer(teachers[len(agent.nodes)])
            near[name] += arrivals(run, agent)
        near["untrained"] += arrivals(neorl.Run(star.AGENT, star.TANK, seed), star.AGENT)
    shares = {name: np.mean(each) for name, each in near.items()}
    assert shares["both"] > 0.75 and shares["untrained"] < 0.15, shares
    assert min(shares["place cells of both"], shares["object vectors of both"]) > 0.55, shares
    assert shares["place cells alone"] < shares["place cells of both"] - 0.2, shares


def test_told_that_red_is_good_the_agent_catches_red_discs_at_once_and_for_as_long():
    run = star.experienced()
    agent = star.with_star(star.AGENT, star.START)
    wants = [replace(each, valence=1.0) if each.source == "red" else each for each in star.AGENT.desires]
    red = star.TANK.kinds.index("red")
    before, *after = [], [], []
    for reds, desires, minutes in ((before, star.AGENT.desires, 2), (after[0], wants, 1), (after[1], wants, 30)):
        run.change(replace(agent, desires=desires))
        reds.append(run.record(60 * star.TANK.fps * minutes).hits[:, red].sum() / minutes)
    assert before[0] < 10 and min(*after[0], *after[1]) > 50


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
    assert page.locator(".still").is_visible() and not page.locator(".neorl-star .buttons").is_visible()


def test_the_star_can_be_moved_while_the_agent_learns(open_page, folder):
    (folder / "moved.html").write_text((folder / "index.html").read_text() + AT_ONCE)
    page = open_page(folder, "moved.html")
    page.wait_for_function("window.moved === 'learning'")
    page.wait_for_selector("button.star[aria-label^='The star, 76 % from the left']")
    page.wait_for_selector("[data-state=running]")
    wait_for(page, 2)
    check_place(page, star.experienced((star.START[0] - 0.04, star.START[1])))


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


def test_the_star_is_wanted_by_every_node_and_nothing_changes_but_that_learning_stops():
    agent = star.with_star(star.AGENT, (0.2, 0.3))
    *own, first, second = agent.desires
    assert replace(agent, desires=own, learning=star.AGENT.learning) == star.AGENT
    assert agent.learning == replace(star.AGENT.learning, learning_rate=0.0)
    assert tuple(own) == star.AGENT.desires
    assert {first.target, second.target} == {node.name for node in star.AGENT.nodes}
    assert first.source == neorl.Place(0.2, 0.3) and np.isclose(first.valence, star.VALENCE)


def test_the_page_runs_what_python_runs(page):
    wait_for(page, 2)
    check_place(page, star.experienced())


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
        found.append(float(shown(page, 0)[0]))
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


def test_without_a_star_red_discs_are_counted_and_the_switch_is_undone(page):
    red, handle = page.locator("[data-action=red]"), page.locator("button.star")
    red.click()
    page.wait_for_selector(".minutes:text-is('It learned for 100 minutes. The star is gone.')")
    expect(handle).to_be_hidden()
    expect(page.locator("thead")).to_contain_text("Red a minute before")
    wait_for(page, 30)
    before, caught = shown(page, 0), [int(each) for each in shown(page, 2)]
    assert int(before[0]) < 10 and before[1] == "–"
    assert caught[0] > 40 and caught[0] > 2 * caught[1]
    page.locator(".tank canvas").click()
    red.click()
    page.wait_for_selector(".minutes:text-is('It learned for 100 minutes. It learns no more.')")
    expect(handle).to_be_visible()
    wait_for(page, 16)
    assert float(shown(page, 0)[0]) < 0.4  # it is a distance again


def test_the_agent_forgets_and_learns_again_while_the_star_waits(page):
    forget = page.locator("[data-action=forget]")
    forget.click()
    page.wait_for_selector(".minutes:text-is('It has forgotten everything. It learns no more.')")
    page.evaluate("""() => {
        const said = document.querySelector(".minutes");
        window.said = [];
        new MutationObserver(() => window.said.push(said.textContent)).observe(said, { childList: true });
    }""")
    forget.click()
    page.wait_for_function("window.said.at(-1) === 'It learned for 100 minutes. It learns no more.'")
    assert any(re.fullmatch(r"It learns for 100 minutes, without a star: \d+ …", each)
               for each in page.evaluate("window.said"))
