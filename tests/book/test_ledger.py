"""The headline is the same everywhere, the page of claims has every claim once, and every rule has its history."""

import re
import tomllib
from dataclasses import replace

import ledger
import pytest
import readme
import rules
from companion.shared import report
from companion.shared.priors import WITHIN

from companion.thesis.reading import TO_THE_LETTER, Reading
from companion.thesis.statements import AGENTS, CLAIMS, DEMONSTRATIONS, STATEMENTS, Bounds

FOUND = {"here": [0.1, 0.09, 0.11], "runs": 100, "verdict": "reproduced",
         "numbers": {"Lead of B over A": [[0.1, 0.09, 0.11], "more than 0", "✓", "asked"]}}
RECORD = {"commit": "abc1234", "date": "2026-12-01",
          "claims": {"C2": FOUND, "A6": FOUND | {"here": [0.19, None, None], "verdict": "undecided"},
                     "A8": FOUND, "B1": FOUND | {"verdict": "contradicted"}, "T3": FOUND, "T4": FOUND,
                     "B5": FOUND | {"verdict": "refuted by proof"}},
          "letter": {"C2": FOUND | {"here": [-0.3, -0.31, -0.29], "verdict": "partly", "numbers": {
              "Lead of B over A": [[-0.3, -0.31, -0.29], "more than 0", "✗", "asked"]}}, "A2": FOUND},
          "shares": {"C2": {"reproduced": 64, "undecided": 26, "contradicted": 128, "readings": 256, "agrees": 2,
                            "measured": 40},
                     "A6": {"reproduced": 1, "undecided": 0, "contradicted": 3, "readings": 4}}}
NOTHING = {"claims": {}, "letter": {}, "shares": {}}


def claim(name, record=RECORD):
    """The line of a claim and what it opens to, without their tags."""
    (found,) = re.findall(rf'<details class="claim"><summary><span><b>{name}</b>(.*?)</summary>(.*?)</details>',
                          ledger.page(record, record), re.DOTALL)
    return [re.sub(r"</?(?!fig|rule)[^>]*>", " ", part).replace("\u00a0", " ") for part in found]


def test_a_claim_is_a_line_that_opens_to_what_its_verdict_rests_on():
    line, fold = claim("C2")
    assert line.split() == ("One desire per colour (B) beats one for all (A) Thesis: &gt; 0 · Here: 0.10 [0.09, 0.11] "
                            "● reproduced").split()
    assert STATEMENTS["C2"].quotation in fold and STATEMENTS["C2"].place in fold
    assert "| Lead of B over A | more than 0 | ✓ 0.10 [0.09, 0.11] | ✗ −0.30 [−0.31, −0.29] |" in fold
    assert "{ref}`this figure <fig-proficiency-networks>`, judged by {ref}`this rule <rule-judge-networks>`" in fold
    assert "| 5 % of 40 | 25 % of 256 | 10 % of 256 | 50 % of 256 |" in fold
    line, fold = claim("A6")
    assert line.split()[-8:] == "Here: 0.19 ? undecided more runs would tell".split()
    assert "|  | 1 of 4 | 0 of 4 | 3 of 4 |" in fold
    line, fold = claim("H1")
    assert line.split("◇")[1].split() == "not computed in this build".split() and "{ref}" not in fold


def test_the_page_has_every_claim_once_and_those_not_about_agents_under_headings_of_their_own():
    page = ledger.page(RECORD, RECORD)
    names = re.findall(r"<summary><span><b>(\w+)</b>", page)
    assert sorted(names) == sorted(STATEMENTS) and names[:len(AGENTS)] == sorted(AGENTS, key=lambda name: name[0])
    assert names[-len(DEMONSTRATIONS):] == [*DEMONSTRATIONS]
    assert {name[0] for name in AGENTS} == set(ledger.CHAPTERS)
    sections = {part.split("\n")[0]: re.findall(r"<b>(\w+)</b>", part) for part in page.split("\n## ")[1:]}
    assert (sections["Counted apart: decided by proof"], sections["Counted apart: decided by counting"]) == (
        ["B5"], ["T3", "T4"])
    plain = re.sub("<[^>]+>", "", page)
    assert f"\n{len(AGENTS)} claims about agents: ● 2 reproduced · ○ 1 contradicted · ? 1 undecided (more" in plain
    assert f"\n{len(ledger.APART)} claims counted apart: ● 2 reproduced · ∎ 1 refuted by proof · ◇ 3 not comp" in plain


def test_every_square_of_the_strips_leads_to_its_claim():
    squares = re.findall(r'<a class="([\w-]+)" href="claims.html#([\w-]+)" title="(\w+), ([^:]+): [^"]*"',
                         ledger.squares(RECORD, RECORD))
    assert [name for *_, name, _ in squares] == [*AGENTS, *ledger.APART]
    page = ledger.page(RECORD, RECORD)
    assert all(page.count(f'<div id="{place}">') == 1 for _, place, *_ in squares)
    assert ("verdict-reproduced", "claim-c2", "C2", "reproduced") in squares
    assert ("verdict-none", "claim-a6", "A6", "undecided") in squares
    assert ("verdict-none", "claim-a1", "A1", "not computed in this build") in squares


def test_one_headline_stands_on_all_pages_and_counts_what_was_used_to_choose_the_reading_apart():
    headline = ledger.headline(RECORD)
    assert all(headline in page for page in (ledger.front(RECORD), ledger.page(RECORD, RECORD),
                                             readme.by_verdict(RECORD)))
    departing = sum(Reading().choices[name] != TO_THE_LETTER.choices[name] for name in WITHIN)
    assert headline == (
        f"Of the thesis’s {len(AGENTS)} claims about agents, 2 are reproduced, 1 contradicted, 1 "
        f"undecided and {len(AGENTS) - 4} not computed in this build (100 runs of each condition). 13 of the "
        f"{len(AGENTS)} were used to choose the reading, in which {departing} of {len(WITHIN)} open choices depart "
        f"from the letter: 1 of these 13 claims and 1 of the other {len(AGENTS) - 13} are reproduced. To the letter: 1 "
        "reproduced. Counted apart: B5 refuted by proof; C5 not computed in this build; T3, T4 (by counting) "
        "reproduced; T2, T5 (this book’s code) not computed in this build.")


@pytest.mark.parametrize("record", [NOTHING, NOTHING | {"claims": {"A2": FOUND | {"verdict": "no verdict"}}}])
def test_a_build_without_verdicts_says_why(record):
    assert "Verdicts need 10 runs of each condition, and this build has fewer." in ledger.front(record)


def test_a_build_says_how_its_verdicts_compare_with_the_record():
    build = RECORD | {"claims": {name: each | {"runs": 10} for name, each in RECORD["claims"].items()}}
    build["claims"] |= {"A8": build["claims"]["A8"] | {"verdict": "undecided"},
                        "B1": build["claims"]["B1"] | {"verdict": "partly"}}
    del build["claims"]["T3"]
    words = (f"Recorded on 2026-12-01 with commit abc1234. This build, 10 runs: {len(CLAIMS) - 3} the same, 1 "
             "undecided, 1 without a verdict, 1 different (B1 partly).")
    assert words in ledger.squares(RECORD, build) and words in ledger.page(RECORD, build)
    assert ledger.beside(RECORD, RECORD) == ""


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
