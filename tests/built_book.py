"""Tests of the built book, for .ci/run: the Explorer of each page works, and reruns the runs behind its figures."""

import re
from pathlib import Path

import pytest
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import expect

from companion.page import recorded
from companion.thesis.statements import CLAIMS, STATEMENTS

HTML = Path(__file__).parent.parent / "_build" / "html"
BOTH_MODALITIES = "Paper B, figure 5: place + object-vector cells"
PAGES = {"explorer.html": BOTH_MODALITIES,
         "chapters/paper_a.html": "Paper A, figure 7: all three maps",
         "chapters/paper_b.html": "Paper B, figure 4A: place cells, all",
         "chapters/paper_c.html": "Paper C, figure 4e: network D"}
SHIFTS = """new Promise(resolve => {  // of the layout, until now
    new PerformanceObserver(list => resolve(list.getEntries().reduce((sum, { value }) => sum + value, 0))).observe(
        { type: "layout-shift", buffered: true });
    setTimeout(resolve, 500, 0);
})"""
pytestmark = pytest.mark.skipif(not HTML.exists(), reason="no book: run make book first")


@pytest.mark.parametrize("over", ["http", "file"])
@pytest.mark.parametrize("name", PAGES)
def test_the_explorer_of_a_page_starts_and_reruns_the_runs_of_its_figures(open_page, name, over):
    page = open_page(HTML, name, over)
    explorer = page.locator(".neorl-explorer")
    explorer.scroll_into_view_if_needed()
    page.wait_for_selector("[data-state=running], [data-state=ended]")
    assert explorer.get_attribute("data-condition") == PAGES[name]
    page.wait_for_function("Number(document.querySelector('.neorl-explorer').dataset.step) > 100")
    page.locator(".neorl-explorer summary").click()
    menu = page.locator('[name="preset"]')
    options = menu.locator("optgroup[label='On this page'] option").all_inner_texts()
    for condition in (PAGES[name], options[-1]):
        menu.select_option(condition)
        page.locator('[name="open-run"]').fill("1")
        page.locator('[data-action="open"]').click()
        page.wait_for_selector(f'.neorl-explorer[data-condition="{condition}"]')
        page.wait_for_selector("[data-state=ended]")
        expect(explorer).to_contain_text(re.compile(r"The notebook computed .* for this run: the same\."))


@pytest.mark.parametrize("width", [1200, 400])
def test_the_front_page_is_light_and_opens_with_the_idea_the_star_and_its_switches(open_page, width):
    page = open_page(HTML, "index.html", "http", viewport={"width": width, "height": 800})
    page.wait_for_selector(".neorl-star[data-state=running]")
    boxes = [page.locator(each).first.bounding_box() for each in ("article p strong", ".tank", "[data-action=red]")]
    assert [each["y"] for each in boxes] == sorted(each["y"] for each in boxes)
    assert all(each["y"] + each["height"] <= 800 for each in boxes)
    assert page.evaluate("document.documentElement.scrollWidth") <= width
    loaded = page.evaluate("""() => {  // but for pictures that browsers load sooner or later, further down the page
        const later = Array.from(document.querySelectorAll("[loading=lazy]"), ({ src }) => src);
        return ["resource", "navigation"].flatMap((kind) => performance.getEntriesByType(kind)).filter(({ name }) =>
            !name.startsWith("blob:") && !later.includes(name)).map(({ encodedBodySize }) => encodedBodySize); }""")
    assert sum(loaded) <= 1_200_000
    assert page.evaluate(SHIFTS) < 0.05


@pytest.mark.parametrize("size", [(1200, 800), (1920, 1080), (400, 800)])
def test_the_tank_of_the_explorer_s_page_is_on_its_first_screen_and_stands_still(open_page, size):
    page = open_page(HTML, "explorer.html", viewport={"width": size[0], "height": size[1]})
    page.wait_for_selector("[data-state=running], [data-state=ended]")
    tank = page.locator(".arena").bounding_box()
    assert 0 < tank["y"] and tank["y"] + tank["height"] <= size[1]
    assert page.evaluate(SHIFTS) < 0.05
    page.locator("#pst-skip-link + .skip-link a").press("Enter")
    page.keyboard.press("Tab")
    expect(page.locator(".arena canvas")).to_be_focused()


def test_without_scripts_the_explorer_s_page_has_a_picture_and_a_sentence(open_page):
    page = open_page(HTML, "explorer.html", java_script_enabled=False)
    for part in ("img", "p"):
        expect(page.locator(f"article noscript {part}")).to_be_visible()


@pytest.mark.parametrize("name", ["index.html", *PAGES])
def test_a_page_without_scripts_and_on_paper_has_a_picture_where_an_agent_would_run(open_page, name):
    for options in ({"java_script_enabled": False}, {}):
        page = open_page(HTML, name, **options)
        page.emulate_media(media="print" if not options else "screen")
        pictures = page.locator(".unscripted img, .neorl-star .still, noscript img").all()
        assert any(each.is_visible() for each in pictures)


def test_letters_of_figures_have_nine_pixels_on_a_phone():
    column, pixels = 368, 96 / 72  # the column of a page 400 pixels wide; pixels per point
    for path in sorted((HTML / "_images").glob("*.svg")):
        text = path.read_text(encoding="utf-8")
        width = float(re.search(r'<svg [^>]*?width="([\d.]+)pt"', text)[1]) * pixels
        sizes = [100 * float(scale) for scale in re.findall(r"scale\(([\d.]+) -[\d.]+\)", text)]  # letters are paths
        assert min(sizes, default=9) * pixels * min(1, column / width) >= 8.9, path.name


@pytest.mark.parametrize("name", recorded.SHOWN)
def test_what_is_recorded_stands_on_the_first_screen(open_page, name):
    page = open_page(HTML, f"chapters/{name}.html", viewport={"width": 1200, "height": 800})
    box = page.locator(".recorded .sentence").first.bounding_box()
    assert box["y"] + box["height"] < 800


@pytest.mark.parametrize("width", [400, 1200])
def test_the_page_of_alternatives_shows_its_figure_soon_and_its_tables_whole(open_page, width):
    page = open_page(HTML, "chapters/alternatives.html")
    page.set_viewport_size({"width": width, "height": 800})
    assert page.locator(".recorded .sentence").bounding_box()["y"] < 500
    assert page.locator("#fig-alternatives-rewards").bounding_box()["y"] < 1_500
    tables = page.locator("article .pst-scrollable-table-container")
    assert tables.count() > 3
    assert not any(tables.evaluate_all("tables => tables.map(each => each.scrollWidth > each.clientWidth)"))


def test_a_page_without_a_widget_asks_for_nothing(open_page):
    page = open_page(HTML, "sources.html")
    assert page.locator(".neorl-explorer").count() == 0


def test_the_page_of_claims_has_all_of_them_and_its_links_lead_somewhere(open_page):
    page = open_page(HTML, "claims.html")
    rows = page.locator("details.claim")
    assert sorted(rows.locator("summary b").all_inner_texts()) == sorted(STATEMENTS)
    links = rows.locator("p:last-of-type a").evaluate_all("links => links.map(link => link.getAttribute('href'))")
    assert len(links) > len(CLAIMS)
    for link in links:
        name, _, target = link.partition("#")
        assert f'id="{target}"' in (HTML / (name or "claims.html")).read_text(encoding="utf-8")


def test_links_from_the_source_of_a_module_to_its_documentation_lead_somewhere():
    for page in (HTML / "_modules").rglob("*.html"):
        source = page.read_text(encoding="utf-8")
        for name, target in re.findall(r'class="viewcode-back" href="([^"#]+)#([^"]+)"', source):
            assert f'id="{target}"' in (page.parent / name).read_text(encoding="utf-8"), (page, target)


def test_the_answer_has_a_row_for_each_claim_and_fits_on_a_phone(open_page):
    page = open_page(HTML, "claims.html")
    rows = page.locator("table.numbers tbody th a")
    assert sorted(rows.all_inner_texts()) == sorted(STATEMENTS)
    page.set_viewport_size({"width": 400, "height": 800})
    assert page.evaluate("document.documentElement.scrollWidth") <= 400
    rows.first.click()
    expect(page.locator("details.claim[open]")).to_have_count(1)


def test_the_sample_of_calibrated_readings_came_out_as_it_stands_in_the_table(open_page):
    page = open_page(HTML, "chapters/calibration.html")
    drawn, equal = page.locator("table", has_text="Rows drawn at random").locator("tbody td").all_inner_texts()
    assert equal == drawn != "0"


def test_the_first_chapter_plays_two_lives_side_by_side(open_page):
    page = open_page(HTML, "chapters/chapter_1.html")
    replay = page.locator(".neorl-replay")
    replay.scroll_into_view_if_needed()
    page.wait_for_function("Number(document.querySelector('.neorl-replay').dataset.frame) > 10")
    assert replay.locator(".title").all_inner_texts() == ["Newborn", "Veteran"]


def test_the_living_figures_of_chapters_run_and_the_pages_hold_no_module_twice(open_page):
    page = open_page(HTML, "chapters/chapter_5.html")
    turn = page.locator(".neorl-turn")
    turn.scroll_into_view_if_needed()
    for learning in ("on", "off"):
        page.wait_for_selector(".neorl-turn[data-state=whole]")
        expect(turn.locator(".legend")).to_contain_text(f"learning {learning} after the turn")
        turn.get_by_label("Learning goes on").set_checked(False)
    assert page.content().count('"path": ["_wasm", ') == 1
    page = open_page(HTML, "chapters/chapter_4.html")
    page.get_by_role("button", name="Next change of cell").click()
    expect(page.locator(".neorl-changes tbody tr")).to_have_count(4)
    assert '"_wasm"' not in page.content()


def test_the_goal_of_an_agent_that_watched_a_rat_can_be_moved(open_page):
    page = open_page(HTML, "chapters/recordings.html")
    figure = page.locator(".neorl-steering")
    figure.scroll_into_view_if_needed()
    figure.get_by_role("button").press("ArrowLeft")
    expect(figure.get_by_role("status")).to_contain_text("(0.48, 0.50)")
    assert '"_wasm"' not in page.content()


@pytest.mark.parametrize("chapter", range(1, 6))
def test_a_term_leads_to_the_glossary_and_from_there_to_the_function(open_page, chapter):
    page = open_page(HTML, f"chapters/chapter_{chapter}.html")
    links = page.locator("a[href*='glossary.html#term-']")
    assert links.count() > 3
    links.first.click()
    page.wait_for_url("**/glossary.html#term-*")
    places = {link.split("#")[1] for link in page.locator("dd a[href*='api_']").evaluate_all(
        "links => links.map(link => link.href)")}
    assert len(places) > 15
    reference = "".join(path.read_text(encoding="utf-8") for path in HTML.glob("api_*.html"))
    assert not [place for place in places if f'id="{place}"' not in reference]


@pytest.mark.parametrize("name", [  # one of each kind: axe takes minutes for all
    "index.html", "explorer.html", "claims.html", "glossary.html", "api_gym.html", "chapters/chapter_1.html",
    "chapters/paper_c.html"])
def test_axe_finds_nothing_that_keeps_readers_out(open_page, name):
    page = open_page(HTML, name)
    for width, scheme in ((1200, "light"), (400, "dark")):
        page.set_viewport_size({"width": width, "height": 800})
        page.emulate_media(color_scheme=scheme)
        page.wait_for_selector(f"html[data-theme={scheme}]")
        # Preloading would request style sheets by wrong addresses; what passes need not be listed.
        found = Axe().run(page, options={"preload": False, "resultTypes": ["violations"]})
        assert found.violations_count == 0, found.generate_report()
