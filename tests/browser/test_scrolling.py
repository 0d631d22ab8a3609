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
        f'<section><h2>Again<a>#</a></h2><div class="cell_output">{wide}{wide}</div></section>'
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


def test_tables_with_the_same_columns_have_names_of_their_own(open_page, tmp_path):
    write_page(tmp_path)
    page = open_page(tmp_path, "page.html")
    page.locator(".wide-table[role=region]").first.wait_for()
    names = page.locator(".wide-table").evaluate_all("boxes => boxes.map(box => box.getAttribute('aria-label'))")
    assert names == ["Table, scrolls sideways: Claim, Share", "Again: table, scrolls sideways: Claim, Share",
                     "Again: table, scrolls sideways: Claim, Share (2)"]


def test_wide_rows_of_claims_are_cards_on_a_phone_with_the_names_of_their_columns(open_page, tmp_path):
    cells = "<tr><td><strong>A1</strong></td><td>0</td><td>{}</td></tr>"
    table = ("<table><thead><tr><th>Claim</th><th>Thesis</th><th>Calibrated</th></tr></thead>"
             f"<tbody>{cells}</tbody></table>")
    (tmp_path / "page.html").write_text(
        '<!doctype html><link rel="icon" href="data:,"><link rel="stylesheet" href="book.css"><body class="bd-content">'
        f'<div class="cell_output" id="wide">{table.format("long" * 15)}</div>'
        f'<div class="cell_output" id="narrow">{table.format("short")}</div><script src="scrolling.js"></script>')
    for name in ("scrolling.js", "book.css"):
        (tmp_path / name).write_text((VENDOR / name).read_text())
    page = open_page(tmp_path, "page.html")
    page.wait_for_selector("#wide .wide-table:not(.cards)")
    page.set_viewport_size({"width": 400, "height": 800})
    page.wait_for_selector("#wide .cards")
    shown = page.locator("#wide td").evaluate_all(
        "cells => cells.map(cell => getComputedStyle(cell, '::before').content)")
    assert shown == ["none", '"Thesis"', '"Calibrated"']
    assert page.locator("#narrow .cards").count() == 0
    page.set_viewport_size({"width": 1200, "height": 800})
    page.wait_for_selector("#wide .wide-table:not(.cards)")
