"""Wide tables scroll by keyboard and have a name; tables that fit are left alone."""

from pathlib import Path

VENDOR = Path(__file__).parents[2] / "book" / "vendor"
TABLE = "<table><thead><tr><th>Claim</th><th>Share</th></tr></thead><tr><td>A1</td><td>{}</td></tr></table>"


def write_page(folder):
    wide, narrow = TABLE.format("long" * 300), TABLE.format("short")
    (folder / "page.html").write_text(
        '<!doctype html><link rel="icon" href="data:,"><link rel="stylesheet" href="book.css">'
        '<body class="bd-content" style="width: 600px"><div class="pst-scrollable-table-container" id="narrow">'
        f'{narrow}</div><div class="cell_output">{wide}</div>'
        '<script src="scrolling.js"></script>')
    for name in ("scrolling.js", "book.css"):
        (folder / name).write_text((VENDOR / name).read_text())


def test_a_wide_table_scrolls_by_keyboard_and_shows_where_there_is_more(open_page, tmp_path):
    write_page(tmp_path)
    page = open_page(tmp_path, "page.html")
    wide = page.locator(".wide-table[role=region]").first
    wide.wait_for()
    assert wide.get_attribute("aria-label") == "Table, scrolls sideways: Claim, Share"
    assert wide.get_attribute("class") == "wide-table more-right"
    page.keyboard.press("Tab")
    assert page.evaluate("document.activeElement.className").startswith("wide-table")
    page.keyboard.press("ArrowRight")
    page.wait_for_function("document.querySelector('.wide-table').scrollLeft > 1")
    page.wait_for_selector(".more-left.more-right")
    assert page.locator("#narrow").get_attribute("tabindex") is None
