"""The README: its table of claims is the one that a build has written, and its other promises."""

import re
import sys
from pathlib import Path

from neorl.claims import VERDICTS
from neorl.ledger import NOT_COMPUTED, in_short
from neorl.statements import STATEMENTS

ROOT = Path(__file__).parent.parent
sys.path.insert(0, str(ROOT / "book"))
import readme  # noqa: E402


def test_the_table_has_every_claim_as_it_is_stated_now_and_a_verdict_from_the_rules():
    (table,) = readme.BETWEEN.findall((ROOT / "README.md").read_text(encoding="utf-8"))
    rows = [row.split(" | ") for row in table.splitlines()[2:]]
    assert [(row[0], row[1]) for row in rows] == [(f"| {name} {each.text}", each.thesis)
                                                  for name, each in STATEMENTS.items()]
    assert {row[3] for row in rows} <= {*VERDICTS[:4], NOT_COMPUTED}
    assert all(re.fullmatch(r"−?\d+\.\d\d \[−?\d+\.\d\d, −?\d+\.\d\d\]|", row[2].strip()) for row in rows)


def test_the_table_is_written_between_its_marks_and_nothing_else_is_touched():
    text = "before\n<!-- claims: make readme -->\nold\n<!-- end of claims -->\nafter | \\1\n"
    table = in_short({"claims": {}, "shares": {}})
    assert readme.BETWEEN.sub(lambda _: table, text) == (
        f"before\n<!-- claims: make readme -->\n{table}<!-- end of claims -->\nafter | \\1\n")
