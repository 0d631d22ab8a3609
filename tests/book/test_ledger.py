"""The page of claims and the strip on the front page have every claim once, and every rule its history."""

import re
import tomllib
from dataclasses import replace

import ledger
import pytest
import rules
from lib.shared import report

from neorl.evidence.statements import CLAIMS, DEMONSTRATIONS, STATEMENTS, Bounds

FOUND = {"here": [0.1, 0.09, 0.11], "runs": 20, "verdict": "reproduced",
         "numbers": {"Lead of B over A": [[0.1, 0.09, 0.11], "more than 0", ""]}}
RECORD = {"claims": {"C2": FOUND, "A6": FOUND | {"here": [0.19, None, None], "runs": 1, "verdict": "no verdict"},
                     "B1": FOUND | {"verdict": "not reproduced"}},
          "letter": {"C2": FOUND | {"here": [-0.3, -0.31, -0.29], "verdict": "partly",
                                         "numbers": {"Lead of B over A": [[-0.3, -0.31, -0.29], "more than 0", ""]}}},
          "shares": {"C2": {"reproduced": 64, "undecided": 26, "readings": 256, "agrees": 2, "measured": 40},
                     "A6": {"reproduced": 1, "undecided": 0, "readings": 4}}}


def claim(name, record=RECORD):
    """The line of a claim and what it opens to, without their tags."""
    (found,) = re.findall(rf'<details class="claim"><summary><span><b>{name}</b>(.*?)</summary>(.*?)</details>',
                          ledger.page(record), re.DOTALL)
    return [re.sub(r"</?(?!fig|rule)[^>]*>", " ", part).replace("\u00a0", " ") for part in found]


def test_a_claim_is_a_line_that_opens_to_what_its_verdict_rests_on():
    line, fold = claim("C2")
    assert line.split() == ("One desire per colour (B) beats one for all (A) Thesis: &gt; 0 · Here: 0.10 [0.09, 0.11] "
                            "● reproduced").split()
    assert STATEMENTS["C2"].quotation in fold and STATEMENTS["C2"].place in fold
    assert "| Lead of B over A | more than 0 | 0.10 [0.09, 0.11] | −0.30 [−0.31, −0.29] |" in fold
    assert "{ref}`this figure <fig-proficiency-networks>`, judged by {ref}`this rule <rule-judge-networks>`" in fold
    assert "| 5 % of 40 | 25 % of 256 | 10 % of 256 |" in fold
    line, fold = claim("A6")
    assert line.split()[-5:] == "Here: 0.19 ◇ no verdict".split()
    assert "|  | 1 of 4 | 0 of 4 |" in fold
    line, fold = claim("H1")
    assert line.split("◇")[1].split() == "not computed in this build".split() and "{ref}" not in fold


def test_the_page_has_every_claim_once():
    names = re.findall(r"<summary><span><b>(\w+)</b>", ledger.page(RECORD))
    assert names == [*CLAIMS, *DEMONSTRATIONS]
    assert {name[0] for name in CLAIMS} == set(ledger.CHAPTERS)


def test_every_square_of_the_strip_leads_to_its_claim():
    squares = re.findall(r'<a class="([\w-]+)" href="claims.html#([\w-]+)" title="(\w+), ([^:]+): [^"]*"',
                         ledger.squares(RECORD))
    assert [name for *_, name, _ in squares] == list(CLAIMS)
    page = ledger.page(RECORD)
    assert all(page.count(f'<div id="{place}">') == 1 for _, place, *_ in squares)
    assert ("verdict-reproduced", "claim-c2", "C2", "reproduced") in squares
    assert ("verdict-none", "claim-a1", "A1", "not computed in this build") in squares


@pytest.mark.parametrize("record, words", [
    (RECORD, f"Of its {len(CLAIMS)} claims we found 1 reproduced (C2); 1 not reproduced (B1); {len(CLAIMS) - 2} not "
             "judged (A1, A2, "),
    ({"claims": {}, "letter": {}, "shares": {}}, "Verdicts need 10 runs of each condition, and this build has fewer.")])
def test_the_book_opens_with_what_was_found_or_why_nothing_is_known(record, words):
    assert words in re.sub("<[^>]+>", "", ledger.front(record))


def test_every_rule_says_which_commits_fixed_and_changed_it_and_shows_its_code():
    history = tomllib.loads(rules.HISTORY.read_text(encoding="utf-8"))
    assert set(history["rules"]) == {each.rule for each in STATEMENTS.values()}
    assert {each for rule in history["rules"].values() for each in rule["commits"]} == set(history["commits"])
    found = rules.page()
    for name in history["rules"]:
        assert f"({report.label(name)})=\n- Fixed on 2026-11-" in found and f"def {name}(" in found
    assert "def _judge_saturation(" in found


def test_no_rule_and_no_bound_changes_without_an_entry(monkeypatch):
    history = tomllib.loads(rules.HISTORY.read_text(encoding="utf-8"))["rules"]
    assert {name: rules.digest(name) for name in history} == {name: each["digest"] for name, each in history.items()}
    before = rules.digest("judge_networks")
    monkeypatch.setitem(STATEMENTS, "C4", replace(STATEMENTS["C4"], bounds=Bounds(low=1.4)))
    assert rules.digest("judge_networks") != before
