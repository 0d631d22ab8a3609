"""Each verdict has a symbol, and a colour that is legible on every ground of the book."""

import re

from contrast import GROUNDS, STYLE_SHEET, contrast, variables

from lib.shared import marks, report
from neorl.evidence.verdict import VERDICTS


def test_every_verdict_has_a_mark_and_what_is_not_tested_looks_alike():
    assert [marks.symbol(verdict) for verdict in (*VERDICTS, marks.NOT_COMPUTED)] == ["●", "◐", "○", "◇", "◇", "◇"]
    assert marks.NOT_COMPUTED == report.NOT_COMPUTED


def test_a_mark_is_named_for_readers_who_do_not_see_it():
    assert marks.html("partly") == ('<span class="verdict verdict-partly" role="img" aria-label="partly" '
                                    'title="partly">◐</span>')


def test_links_in_striped_rows_are_legible():
    for mode, colours in variables("table-link").items():
        assert [contrast(colours["table-link"], ground) >= 4.5 for ground in GROUNDS[mode]] == [True, True]


def test_every_mark_has_a_colour_that_is_legible_on_all_grounds():
    classes = {mark.css for mark in marks.MARKS.values()}
    styled = dict(re.findall(r"\n\.(verdict-[\w-]+) \{\n  color: var\(--([\w-]+)\);", STYLE_SHEET.read_text()))
    assert styled.keys() == classes
    for mode, colours in variables("verdict-").items():
        assert colours.keys() == set(styled.values())
        for name, colour in colours.items():
            for ground in GROUNDS[mode]:
                assert contrast(colour, ground) >= 4.5, (mode, name, ground)
