"""The headline is the same everywhere, the page of claims has every claim once, and every rule has its history."""

import json
import re
import tomllib
from dataclasses import replace
from types import SimpleNamespace

from writing import answer, base_rate
from writing import curves
from writing import ledger
from writing import levels
import numpy as np
import pytest
from writing import readme
from writing import rules
from companion.page import counts, report
from companion.thesis.priors import WITHIN
from companion.study import sensitivity
from companion.study.calibration_targets import GROUPS

from companion.thesis import reading
from companion.thesis.reading import TO_THE_LETTER, Reading
from companion.thesis.statements import AGENTS, DEMONSTRATIONS, STATEMENTS, Bounds

FOUND = {"here": [0.1, 0.09, 0.11], "runs": 100, "verdict": "reproduced", "parts": [], "together": 1,
         "numbers": {"Lead of B over A": [[0.1, 0.09, 0.11], "more than 0", "✓", "asked"]}}
RECORD = {"commit": "abc1234", "date": "2026-12-01",
          "claims": {"C2": FOUND, "A6": FOUND | {"here": [0.19, None, None], "verdict": "undecided"},
                     "B3": FOUND | {"here": [0.55, 0.5, 0.6], "verdict": "contradicted", "numbers": {
                         "place cells": [[0.7, 0.6, 0.8], "from 0.23 to 0.36 (within a factor)", "✗", "asked"]}},
                     "A8": FOUND, "B1": FOUND | {"verdict": "contradicted"}, "T3": FOUND, "T4": FOUND,
                     "B5": FOUND | {"verdict": "refuted by proof"}},
          "letter": {"C2": FOUND | {"here": [-0.3, -0.31, -0.29], "verdict": "partly", "numbers": {
              "Lead of B over A": [[-0.3, -0.31, -0.29], "more than 0", "✗", "asked"]}}, "A2": FOUND},
          "shares": {"C2": {"agrees": 2, "measured": 40}, "B3": {"agrees": 0, "measured": 40}}}
NOTHING = {"claims": {}, "letter": {}, "shares": {}}


def claim(name, record=RECORD):
    """The line of a claim and what it opens to, without their tags."""
    (found,) = re.findall(rf'<details class="claim"><summary><span><b>{name}</b>(.*?)</summary>(.*?)</details>',
                          ledger.page(record), re.DOTALL)
    return [re.sub(r"</?(?!fig|rule)[^>]*>", " ", part).replace("\u00a0", " ") for part in found]


def test_a_claim_is_a_line_with_the_number_that_decides_and_opens_to_what_its_verdict_rests_on():
    line, fold = claim("C2")
    assert line.split() == ("One desire per colour (B) beats one for all (A) Lead of B over A in final reward per "
                            "second: 0.10 [0.09, 0.11]. Thesis: increased ● "
                            "reproduced").split()
    assert STATEMENTS["C2"].quotation in fold and STATEMENTS["C2"].place in fold
    assert "| Lead of B over A | more than 0 | ✓ 0.10 [0.09, 0.11] | ✗ −0.30 [−0.31, −0.29] |" in fold
    assert "{ref}`this figure <fig-proficiency-networks>`, judged by {ref}`this rule <rule-judge-networks>`" in fold
    assert "B − A, final: 16 of 48 readings agree" in fold
    line, fold = claim("A6")
    assert line.split()[-9:] == "quicker, and more than the sum ? undecided more runs would tell".split()[-9:]
    numbers = {"A": [[0.05, 0.0, 0.1], "0.01 or more", "?", "asked"]}
    open_yet = RECORD | {"claims": RECORD["claims"] | {"A6": FOUND | {"verdict": "undecided", "numbers": numbers}}}
    assert "more runs would tell: some 160 runs, if the means stay" in claim("A6", open_yet)[0]  # 100 · (0.05 / 0.04)²
    line, _ = claim("B3")
    assert "per second of both modalities; place cells: 0.70 [0.60, 0.80], needed: from 0.23 to 0.36. Thes" in line
    line, fold = claim("H1")
    assert line.split("◇")[1].split() == "not computed in this build".split() and "{ref}" not in fold


def test_the_page_has_every_claim_once_and_those_not_about_agents_under_headings_of_their_own():
    page = ledger.page(RECORD)
    names = re.findall(r"<summary><span><b>(\w+)</b>", page)
    assert sorted(names) == sorted(STATEMENTS) and names[:len(AGENTS)] == sorted(AGENTS, key=lambda name: name[0])
    assert names[-len(DEMONSTRATIONS):] == [*DEMONSTRATIONS]
    assert {name[0] for name in AGENTS} == set(ledger.CHAPTERS)
    assert f"### {ledger.CHAPTERS['C']}\n\nPapers B and C: 3 creeps, nothing for the last green one, 50 steps" in page
    sections = {part.split("\n")[0]: re.findall(r"<b>(\w+)</b>", part) for part in page.split("\n### ")[1:]}
    assert {title: tuple(listed) for title, listed in sections.items() if title not in ledger.CHAPTERS.values()} == (
        counts.by_kind(name for name in STATEMENTS if name not in AGENTS))


def test_the_figure_at_the_head_has_every_claim_once_in_blocks():
    head, _, _ = ledger.page(RECORD).partition("\n## ")
    blocks = [re.findall(r'\(<a href="#claim-\w+"[^>]*>(\w+)</a>\)', block) for block in head.split("<tbody>")[1:]]
    assert [sorted(block) for block in blocks] == [sorted(names) for names in answer.BLOCKS.values()]
    assert sorted(name for names in answer.BLOCKS.values() for name in names) == sorted(STATEMENTS)


def test_what_fails_in_any_reading_has_a_reason_and_what_fails_in_two_is_named():
    listed = answer.fails(RECORD)
    assert re.findall(r">(\w+)</a>\*\*", listed) == ["B5"] and "it is 24/7" in listed
    also = RECORD | {"letter": RECORD["letter"] | {"B3": RECORD["claims"]["B3"], "B1": RECORD["claims"]["B1"]}}
    listed, both = answer.fails(also).split("\n\n")
    assert re.findall(r">(\w+)</a>\*\*", listed) == ["B3", "B5"] and answer.NEVER in listed
    assert re.findall(r">(\w+)</a>", both) == ["B1"]


def test_the_choices_that_decide_have_their_sentences_both_values_and_the_claims_that_flip():
    rows = answer.decides(sensitivity.shipped()).splitlines()[2:]
    memory = next(row for row in rows if row.startswith("| **memory, cells**<br>“assigning credit"))
    assert memory.split(" | ")[1] == "0" and ">A6</a>" in memory.split(" | ")[3] and len(rows) <= answer.DECIDING
    assert "Most depends on *credit*" in answer.dependence(RECORD, sensitivity.shipped())
    about = "".join(answer.sections(RECORD, sensitivity.shipped()))
    assert "Of the 17 choices that depart from the letter, 17 were set back, in 10 to 20 runs of each" in about
    assert "5\u00a0% agree with" in answer.dependence(RECORD, sensitivity.shipped())
    assert answer.decides(sensitivity.shipped()._replace(flips={})) == ""


def test_a_panel_of_a_specification_curve_has_all_readings_and_what_agrees_apart():
    shown = curves.panels(sensitivity.shipped(), "B3")
    assert re.findall(r">([^<]*: \d+ of 48 readings agree)<", shown) == [
        "Place cells, final: 4 of 48 readings agree", "Both, final: 9 of 48 readings agree"]
    drawn = [path.count("M") for path in re.findall(r'class="(?:in|out)" d="([^"]*)"', shown)]
    assert drawn == [44, 4, 39, 9] and curves.panels(sensitivity.shipped(), "T1") == ""
    assert not re.search(r"nan|inf", shown) and shown.count(">calibrated<") == shown.count(">letter<") == 2


def test_the_front_page_counts_what_is_reproduced_of_what_a_reading_judges():
    assert answer.reproduced(RECORD) == [
        ["Claims about agents, by which the calibrated reading was chosen", "1 of 2", "1 of 4"],
        ["Claims about agents, not used for that", "0 of 0", "1 of 1"],
        ["What is proved or counted", "0 of 0", "2 of 3"], ["What is about our code", "0 of 0", "0 of 0"],
        ["What the author reports", "0 of 0", "0 of 0"],
        ["Our demonstrations, which are no claims of the thesis", "0 of 0", "0 of 0"]]
    assert "<td>1 of 2</td><td>1 of 4</td>" in ledger.front(RECORD)
    assert 'claims.html#claim-t1">claim T1</a>' in ledger.front(RECORD)


def test_one_headline_stands_on_all_pages_and_counts_what_was_used_to_choose_the_reading_apart(former):
    headline = ledger.headline(RECORD)
    assert all(headline in page for page in (ledger.front(RECORD), ledger.page(RECORD),
                                             readme.found(RECORD)))
    departing = sum(Reading().choices[name] != TO_THE_LETTER.choices[name] for name in WITHIN)
    assert headline == (
        f"The thesis makes {len(AGENTS)} claims about its agents. With every gap of its text filled by the plainest "
        f"choice (“to the letter”), 1 of them is reproduced; with {departing} of the gaps filled otherwise, as fits "
        "best (“calibrated”), 2 are: 1 of the 13 by which these choices were made, and 1 of the other "
        f"{len(AGENTS) - 13}. Of these others only A10, T1, T10 and T11 rest on conditions that took no part in the "
        "choice (0 of 4). By the rules before their last change it was 1 to the letter and 2 calibrated. An honest "
        "range is 0 to 2, "
        "and 1 to 4: from the claims that every version of their rule reproduces to those that any does, or that are "
        f"undecided now. {base_rate.finding(base_rate.read())} Claims rest on 100 runs of each condition, or more.")


def test_every_rule_says_which_commits_fixed_and_changed_it_and_shows_its_code():
    history = tomllib.loads(rules.HISTORY.read_text(encoding="utf-8"))
    assert set(history["rules"]) == {each.rule for each in STATEMENTS.values()}
    assert {each for rule in history["rules"].values() for each in rule["commits"]} == set(history["commits"])
    found = rules.page(RECORD)
    for name in history["rules"]:
        assert f"({report.label(name)})=\n- Fixed on 2026-11-" in found and f"def {name}(" in found
    assert "def _judge_evenness(" in found
    assert all(f"- Reads {name}: “{each.quotation}” ({each.place})." in found for name, each in STATEMENTS.items())


def test_what_the_last_change_of_rules_and_the_runs_moved_is_listed_for_both_readings():
    moved, *_ = rules.page(RECORD).split("\n\n## Beside whom")
    rows = [row for row in moved.splitlines() if row.startswith("| ")]
    assert len(rows) >= 40 and all(row.count(" | ") == 3 for row in rows)
    (row,) = [row for row in rows if row.startswith("| **C2**, calibrated |")]
    assert row.endswith("reproduced, 0.10 [0.09, 0.11] |")
    assert "- **C6** asked: no statement. It asks: D above the best of its nodes alone" in moved
    assert {*tomllib.loads(rules.HISTORY.read_text(encoding="utf-8"))["changes"]} <= {*STATEMENTS}


def test_each_claim_that_compares_agents_has_the_simplest_agent_beside_it():
    listed = tomllib.loads(rules.LEFT_OUT.read_text(encoding="utf-8"))
    assert {*listed["comparable"]} == {name for name in AGENTS if name != "A1"}  # which is about Brownian motion alone
    assert all(decided.startswith(("asked", "shown", "not run")) for _, decided in listed["comparable"].values())
    found = rules.page(RECORD)
    assert all(each["quotation"] in found and each["why"] in found for each in listed["untested"])


def test_no_rule_and_no_bound_changes_without_an_entry(monkeypatch):
    history = tomllib.loads(rules.HISTORY.read_text(encoding="utf-8"))["rules"]
    assert {name: rules.digest(name) for name in history} == {name: each["digest"] for name, each in history.items()}
    before = rules.digest("judge_networks")
    monkeypatch.setitem(STATEMENTS, "C4", replace(STATEMENTS["C4"], bounds=Bounds(low=1.4)))
    assert rules.digest("judge_networks") != before
    assert tomllib.loads(rules.HISTORY.read_text(encoding="utf-8"))["shared"] == rules.shared()


@pytest.fixture
def former(monkeypatch, tmp_path):
    """Verdicts of the rules before the last change, in place of those of the book."""
    def of(name, present, earlier="undecided"):
        return {name: {"earlier runs": {"verdict": earlier}, "present runs": present and {"verdict": present}}}
    verdicts = {"claims": of("C2", "reproduced") | of("B1", None, "reproduced") | of("A8", "partly", "reproduced")
                | of("A6", "partly"),
                "letter": of("C2", "reproduced") | of("A2", "partly") | of("T3", "reproduced")}
    monkeypatch.setattr(answer, "BEFORE", tmp_path / "before.json")
    answer.BEFORE.write_text(json.dumps(verdicts))


def test_the_headline_has_the_usual_numbers_of_runs_and_the_claims_that_have_fewer():
    others = {"A6": FOUND | {"runs": 1_000}, "A10": FOUND | {"runs": 10}, "T2": FOUND | {"runs": 10},
              "T5": FOUND | {"runs": 12}}
    assert answer.runs(RECORD | {"claims": RECORD["claims"] | others}) == (
        "Claims rest on 100 to 1,000 runs of each condition, or more; A10 and T2 on 10; T5 on 12.")
    assert answer.runs({"claims": {"C2": FOUND | {"runs": 20}}}) == "C2 on 20." and answer.runs(NOTHING) == ""


def test_claims_that_are_independent_read_no_condition_that_the_search_ran(monkeypatch):
    called = set()

    class Rules:
        def __getattr__(self, rule):
            return lambda *_, **__: called.add(rule) or Judged()

    class Judged(list):  # of one claim, or of several
        name = "T1"

    monkeypatch.setattr(reading, "claims", Rules())
    monkeypatch.setattr(reading, "additions", lambda _: None)
    conditions = {key: SimpleNamespace() for keys in reading.GROUPS.values() for key in keys} | {"moved": None}
    reading.judge(conditions)
    elsewhere = {STATEMENTS[name].rule for name in AGENTS} - called
    assert elsewhere <= {"judge_untrained", "judge_persistence", "judge_time_scale"}  # the last two of paper B's agents
    called.clear()
    searched = {key for group in GROUPS.values() for key in group.keys}
    reading.judge({key: each for key, each in conditions.items() if key not in searched})
    free = called | {"judge_untrained"}
    assert [name for name in answer.NOT_FITTED if STATEMENTS[name].rule in free] == [*answer.INDEPENDENT]


def test_what_depends_on_the_steps_per_second_of_paper_a_is_said():
    other = {"A6": FOUND | {"verdict": "contradicted", "here": [-0.2, -0.3, -0.1]}, "A8": FOUND}
    assert re.sub("<[^>]*>", "", answer.rate_of_paper_a(RECORD | {"paper A at 50": other})).endswith(
        "with 50 for all, A6 would be contradicted (−0.20 [−0.30, −0.10]).")
    assert answer.rate_of_paper_a(RECORD | {"paper A at 50": {"A8": FOUND}}).endswith("no verdict would change.")
    assert answer.rate_of_paper_a(RECORD) == ""


def test_levels_of_both_readings_stand_on_one_axis():
    record = report.record()
    shown = levels.section(record, sensitivity.shipped())
    widths = [float(width) for width in re.findall(r"width:([\d.]+)%", shown)]
    earned = [float(level) for level in re.findall(r"<span>([\d.]+) \[", shown)]
    assert len(widths) == len(earned) == 2 * len(levels.ROWS) and max(widths) == 100
    np.testing.assert_allclose(widths, 100 * np.array(earned) / max(earned), atol=1.5)
    assert "without memory, they earn 0.43 in place of 0.33" in shown and "rank correlation −0.50" in shown
    assert levels.section(RECORD, sensitivity.shipped()) == ""
