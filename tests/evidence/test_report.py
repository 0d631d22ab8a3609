"""Reports of the results: tables, records on disk, and entries that are missing."""

import json

import pytest
from matplotlib import pyplot as plt
from test_claims import brownian, paper_a, paper_c

from lib.shared import report
from lib.shared.errata import ERRATA
from lib.study.multiverse_figures import draw_standing
from neorl.drawing.style import STYLE
from neorl.evidence import claims
from neorl.evidence.statements import STATEMENTS

pytestmark = pytest.mark.usefixtures("cache_folder")


def networks(*agents):
    return claims.judge_networks(*(agents or paper_c()), brownian())


def layers(runs=20):
    _, control, *rest = paper_a(runs)
    return claims.judge_multiple_layers(*rest, control)


def test_claims_are_kept_as_data(cache_folder):
    judged = networks()
    report.save("paper_c", judged, letter=judged[:1])
    kept = json.loads((cache_folder / "claims" / "paper_c.json").read_text())
    assert list(kept["claims"]) == ["C1", "C2", "C3", "C4"] and list(kept["letter"]) == ["C1"]
    assert kept["claims"]["C4"]["here"] == list(judged[3].here)
    assert kept["claims"]["C4"]["runs"] == 20


def test_a_bound_that_does_not_exist_is_kept_as_null(cache_folder):
    report.save("look", layers(runs=1))
    text = (cache_folder / "claims" / "look.json").read_text()
    assert "NaN" not in text
    assert json.loads(text)["claims"]["A6"]["here"][1:] == [None, None]


def test_a_table_of_a_page_has_both_readings_and_leads_to_what_the_verdicts_rest_on():
    table = report.table(networks(), networks(*paper_c()[::-1]))
    assert table.splitlines()[0] == "| Claim | Thesis | To the letter | Calibrated | Verdict |"
    found = row(table, "C2")
    assert found.startswith('| **<a href="../book/claims.md#claim-c2" title=') and STATEMENTS["C2"].statistic in found
    assert found.endswith("| > 0 | ○\u00a0−0.30 [−0.31, −0.29] | ●\u00a00.10 [0.09, 0.11] | reproduced |")


def test_what_a_verdict_rests_on_is_its_sentence_its_quantity_and_the_finding():
    (line,) = report.evidence({"claims": report._kept(networks()), "letter": {}}, ["C2"])
    assert "“Experiment b demonstrates the effect of separating desires" in line and "(paper C, section 3)" in line
    assert "Here, 20 runs: A run of B" in line


@pytest.fixture
def record(cache_folder):
    report.save("paper_c", networks(), letter=networks(*paper_c()[::-1]))
    report.save("look", layers(runs=1))
    report.save("assumptions", shares={"C2": {"holds": 64, "undecided": 26, "untestable": 3, "readings": 256,
                                               "agrees": 2, "measured": 40}})
    return report.load((cache_folder / "claims").iterdir())


def row(table, name):
    (found,) = [line for line in table.splitlines() if f">{name}</a>**" in line and line[0] == "|"]
    return found


def test_some_claims_of_a_record_make_a_table(record):
    header, _, *rows, _, legend = report.extract(record, ["A6", "C2", "C5"]).splitlines()
    assert legend.startswith("● reproduced, ◐ partly")
    assert header.startswith("| Claim | Thesis | To the letter |") and len(rows) == 3
    assert rows[1].endswith("| ●\u00a00.10 [0.09, 0.11] | reproduced |")


def test_errata_are_a_table_and_their_arithmetic_is_right():
    rows = report.errata().splitlines()[2:]
    assert len(rows) == len(ERRATA) and all(line.count(" | ") == 2 for line in rows)
    assert 3**2 + 7**2 + 23**2 == 587 and "587" in rows[0] and round(587 / 49) == 12 and "twelvefold" in rows[0]
    assert "discriminatory stimuli S<sup>R</sup> –" in rows[5] and "^" not in "".join(rows)


def test_errata_of_a_place_are_those_that_name_it():
    header, rule, *rows = report.errata("paper C").splitlines()
    assert [header, rule] == report.errata().splitlines()[:2]
    assert rows == [row for row, each in zip(report.errata().splitlines()[2:], ERRATA) if "paper C" in each.place]
    assert len(rows) == 5 and "paper B" in rows[-2]


def test_all_that_is_kept_is_read_unless_files_are_named(record, cache_folder):
    (cache_folder / "claims" / "notes.txt").touch()
    assert report.load() == record
    assert list(report.load([cache_folder / "claims" / "look.json"])["claims"]) == ["A6", "A7", "A8"]


def test_readings_are_drawn_beside_the_verdicts(record):
    draw_standing(record, ["C2", "A6", "T5"])
    axes = plt.gca()
    assert [tick.get_text() for tick in axes.get_yticklabels()] == [
        "C2  reproduced", "A6  no verdict", "T5  not computed"]
    assert [(bar.get_x(), bar.get_width()) for bar in axes.patches] == [(0, 25), (25, pytest.approx(100 * 26 / 256))]
    assert [line.get_xydata().tolist() for line in axes.lines] == [[[5, 0]]]
    assert [text.get_text() for text in axes.texts] == ["not varied over readings"] * 2
    plt.close()


def test_the_drawing_of_readings_is_no_wider_than_other_figures_so_that_its_letters_are_as_large(record):
    with plt.rc_context(STYLE):
        draw_standing(record, ["C2", "A6", "T5"])
        figure = plt.gcf()
        figure.draw_without_rendering()
        assert figure.get_tightbbox().x1 <= STYLE["figure.figsize"][0]
    plt.close()
