"""The page of claims and the strip on the front page have every claim once, with its symbol and shares."""

import inspect
import re
import sys
from pathlib import Path

import pytest
from lib.shared import report

from neorl.evidence import claims
from neorl.evidence.statements import CLAIMS, DEMONSTRATIONS, STATEMENTS

sys.path.insert(0, str(Path(__file__).parents[2] / "book"))
import ledger  # noqa: E402

FOUND = {"here": [0.1, 0.09, 0.11], "runs": 20, "verdict": "reproduced", "numbers": {}}
RECORD = {"claims": {"C2": FOUND, "A6": FOUND | {"here": [0.19, None, None], "runs": 1, "verdict": "no verdict"},
                     "B1": FOUND | {"verdict": "not reproduced"}},
          "letter": {"C2": FOUND | {"here": [-0.3, -0.31, -0.29], "verdict": "partly"}},
          "shares": {"C2": {"holds": 64, "undecided": 26, "readings": 256, "agrees": 2, "measured": 40},
                     "A6": {"holds": 1, "undecided": 0, "readings": 4}}}
EMPTY = {"claims": {}, "letter": {}, "shares": {}}


def row(name, record=RECORD):
    (found,) = [line for line in ledger.page(record).splitlines() if f"**{name}**" in line and line[0] == "|"]
    return re.sub(r"<[^>]*>", "", found.replace("<fig", "(fig").replace("<rule", "(rule")).replace("\u00a0", " ")


def test_a_row_has_both_readings_the_verdict_and_shares_in_columns_of_their_own():
    assert row("C2") == (
        "| **C2** One desire per colour (B) beats one for all (A) Lead of B over A in final reward per second "
        "| > 0 | ◐ −0.30 [−0.31, −0.29] | ● 0.10 [0.09, 0.11] | ● reproduced {ref}`figure "
        "(fig-proficiency-networks>`, {ref}`rule (rule-judge-networks>` | 5 % of 40 | 25 % of 256 | 10 % of 256 |")
    assert row("A6").endswith("| 0.19 | ◇ no verdict {ref}`figure (fig-proficiency>`, {ref}`rule "
                              "(rule-judge-multiple-layers>` |  | 1 of 4 | 0 of 4 |")
    assert row("H1").endswith("| fewer |  |  | ◇ not computed in this build |  |  |  |")
    assert "●</span>\u00a0reproduced" in ledger.page(RECORD)  # a symbol stays beside its word


def test_the_page_has_every_claim_once_in_a_row_and_once_in_what_verdicts_rest_on():
    lines = ledger.page(RECORD).splitlines()
    rows = [line.split("**")[1] for line in lines if line.startswith('| <span id="claim-')]
    assert rows == [line.split("**")[1] for line in lines if line.startswith("- **")] == [*CLAIMS, *DEMONSTRATIONS]
    assert {name[0] for name in CLAIMS} == set(ledger.CHAPTERS)


def test_every_square_of_the_strip_leads_to_the_row_of_its_claim():
    squares = re.findall(r'<a class="([\w-]+)" href="claims.html#([\w-]+)" title="(\w+), ([^:]+): [^"]*"',
                         ledger.squares(RECORD))
    assert [name for *_, name, _ in squares] == list(CLAIMS)
    page = ledger.page(RECORD)
    assert all(page.count(f'<span id="{place}"></span>**{name}**') == 1 for _, place, name, _ in squares)
    assert ("verdict-reproduced", "claim-c2", "C2", "reproduced") in squares
    assert ("verdict-none", "claim-a1", "A1", "not computed in this build") in squares


@pytest.mark.parametrize("record, words", [
    (RECORD, f"Of its {len(CLAIMS)} claims we found 1 reproduced (C2); 1 not reproduced (B1); {len(CLAIMS) - 2} not "
             "judged."),
    (EMPTY, "Verdicts need 10 runs of each condition, and this build has fewer.")])
def test_the_book_opens_with_what_was_found_or_why_nothing_is_known(record, words):
    assert words in re.sub("<[^>]+>", "", ledger.front(record))


def test_the_page_of_claims_shows_the_code_of_every_rule():
    text = (Path(__file__).parents[2] / "book" / "claims.md").read_text(encoding="utf-8")
    section = (r":::{dropdown} .+\n\((rule-[\w-]+)\)=\n```{literalinclude} ../neorl/evidence/(\w+).py\n"
               r":pyobject: (\w+)\n")
    shown = re.findall(section, text)
    rules = [getattr(claims, statement.rule) for statement in STATEMENTS.values()]
    assert {label: (module, rule) for label, module, rule in shown} == {
        report.label(rule.__name__): (inspect.getmodule(rule).__name__.removeprefix("neorl.evidence."), rule.__name__)
        for rule in rules}
