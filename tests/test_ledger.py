"""What was found, as the pages tell it: tables, records on disk, and what is not there."""

import json

import pytest
from matplotlib import pyplot as plt
from test_claims import as_the_paper_says, made_up, paper_c

from neorl import claims, ledger
from neorl.multiverse_figures import draw_standing
from neorl.statements import STATEMENTS

pytestmark = pytest.mark.usefixtures("cache")


def test_claims_are_kept_as_data(cache):
    single, brownian, layers, together = as_the_paper_says()
    judged = claims.judge_single_layer(single, brownian)
    ledger.store("paper_a", judged)
    kept = json.loads((cache / "claims" / "paper_a.json").read_text())
    assert list(kept["claims"]) == ["A1", "A2", "A3", "A4", "A5"]
    assert kept["claims"]["A4"]["here"] == list(judged[3].here)
    assert kept["claims"]["A4"]["runs"] == 20


def test_a_bound_that_does_not_exist_is_kept_as_null(cache):
    ledger.store("look", claims.judge_multiple_layers(*as_the_paper_says(runs=1)[2:]))
    text = (cache / "claims" / "look.json").read_text()
    assert "NaN" not in text
    assert json.loads(text)["claims"]["A6"]["here"][1:] == [None, None]


def test_tables_hold_every_claim_and_reading():
    single, brownian, layers, together = as_the_paper_says()
    layered = claims.judge_multiple_layers(layers, together)
    table = ledger.table(layered)
    assert "**A6**" in table and "**A7**" in table and table.count("**reproduced**") == 2
    compared = ledger.comparison({"one": claims.judge_single_layer(single, brownian) + layered, "other": layered})
    assert compared.splitlines()[0] == "| Reading | A1 | A2 | A3 | A4 | A5 | A6 | A7 |"
    assert compared.splitlines()[3].startswith("| other |  |  |  |  |  | ●\u00a00.16 |")


def test_a_summary_names_where_claims_hold_and_what_comes_closest():
    good, bad = (claims.judge_networks(*(made_up(0.0, final) for final in finals))
                 for finals in [(0.05, 0.15, 0.3, 0.6), (0.05, 0.02, 0.3, 0.1)])
    text = ledger.summary({"default": bad, "other": good})
    assert "- **C1** Network A improves over time but stays weak: *default; other*." in text
    assert "- **C4** Recursion (D) improves on C drastically: *other*." in text
    assert "Closest to the paper comes *other*: 4 of its claims are reproduced and 0 partly." in text
    assert text.endswith("In the default reading they are 2 and 0.")
    assert "none of these readings" in ledger.summary({"default": bad})
    assert ledger.summary({"default": claims.judge_networks(*paper_c(runs=2))}) == (
        "With so few runs there is nothing to sum up.")


@pytest.fixture
def record(cache):
    ledger.store("paper_c", claims.judge_networks(*paper_c()))
    ledger.store("look", claims.judge_multiple_layers(*as_the_paper_says(runs=1)[2:]))
    ledger.store("assumptions", shares={"C2": {"holds": 64, "undecided": 26, "untestable": 3, "readings": 256}})
    return ledger.read((cache / "claims").iterdir())


def row(table, name):
    (found,) = [line for line in table.splitlines() if line.lstrip("|* ").startswith(name)]
    return found


def test_the_page_has_every_claim_of_the_thesis_and_says_which_were_not_computed(record):
    page = ledger.page(record)
    assert [name for name in STATEMENTS if f"**{name}** " in page] == list(STATEMENTS)
    assert len(page.splitlines()) == 2 + len(STATEMENTS)
    assert "not computed in this build" in row(page, "H1") and "not computed in this build" in row(page, "A1")
    assert row(page, "C2").replace("\u00a0", " ") == (
        "| **C2** A desire for each colour (B) beats one for all (A) | **reproduced**; holds in 25 % of 256 readings, "
        "undecided in 10 % | Lead of B over A in final reward per second. Thesis (paper C, section 3 and figure 4e): "
        "> 0. Here: 0.10 [0.09, 0.11], 20 runs. A run of B beats one of A with probability 1.00 [1.00, 1.00]. "
        "({ref}`Figure <fig-proficiency-networks>`, {ref}`rule <rule-judge-networks>`) |")


def test_a_claim_of_a_single_run_has_no_interval_and_no_verdict(record):
    line = row(ledger.page(record), "A6")
    assert "Here: 0.14, 1 runs. Over the best alone, N23, the lead is 0.40;" in line and "**no verdict**" in line


def test_the_short_table_says_the_same(record):
    table = ledger.in_short(record)
    assert row(table, "C2") == ("| C2 A desire for each colour (B) beats one for all (A) | > 0 | 0.10 [0.09, 0.11] | "
                                "reproduced | 25\u00a0% |")
    assert row(table, "H1").endswith("| fewer |  | not computed in this build |  |")


def test_claims_are_listed_by_what_became_of_them(record):
    assert ledger.standing(record, ["H1", "C3", "C2", "A6"]) == (
        "- *Reproduced*: Values from both nodes (C) beat those of the last one (B) (C3); A desire for each colour (B) "
        "beats one for all (A) (C2).\n- *No verdict*: 3, 7 and 23 together beat the sum of the three alone (A6).\n"
        f"- *Not computed in this build*: {STATEMENTS['H1'].text} (H1).")


def test_all_that_is_kept_is_read_unless_files_are_named(record, cache):
    (cache / "claims" / "notes.txt").touch()
    assert ledger.read() == record
    assert list(ledger.read([cache / "claims" / "look.json"])["claims"]) == ["A6", "A7"]


def test_readings_are_drawn_beside_the_verdicts(record):
    draw_standing(record, ["C2", "A6", "T5"])
    axes = plt.gca()
    assert [tick.get_text() for tick in axes.get_yticklabels()] == [
        "C2  reproduced", "A6  no verdict", "T5  not computed"]
    assert [(bar.get_x(), bar.get_width()) for bar in axes.patches] == [(0, 25), (25, pytest.approx(100 * 26 / 256))]
    assert [text.get_text() for text in axes.texts] == ["not varied over readings"] * 2
    plt.close()
