"""The built book, for .ci/run: the Explorer of each page lives, and a run opened in it is the run behind the figure."""

import re
from pathlib import Path

import pytest
from playwright.sync_api import expect

HTML = Path(__file__).parent.parent / "_build" / "html"
PAGES = {"index.html": "Figure 5: PC + OVC", "chapters/paper_a.html": "Figure 7: all, by N²",
         "chapters/paper_b.html": "Figure 5: PC + OVC", "chapters/paper_c.html": "Figure 4e: D"}
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
    options = page.locator('[name="open-preset"] option').all_inner_texts()
    for condition in (PAGES[name], options[-1]):
        page.locator('[name="open-preset"]').select_option(condition)
        page.locator('[name="open-run"]').fill("1")
        page.locator('[data-action="open"]').click()
        page.wait_for_selector(f'.neorl-explorer[data-condition="{condition}"]')
        page.wait_for_selector("[data-state=ended]", timeout=60_000)
        expect(explorer).to_contain_text(re.compile(r"The notebook computed .* for this run: the same\."))


def test_a_page_without_a_widget_asks_for_nothing(open_page):
    page = open_page(HTML, "sources.html")
    assert page.locator(".neorl-explorer").count() == 0
