"""The recorded answer: its sentence, and numbers against numbers within and beyond what agrees."""

import re

import pytest
from computing import cells
from nbformat.v4 import new_code_cell, new_markdown_cell, new_output

from companion.page import counts, recorded, report
from companion.thesis.statements import STATEMENTS, Bounds
from companion.thesis.verdict import VERDICTS

RECORD = report.record()


@pytest.fixture
def line():
    """`line(bounds, **numbers)`: the SVG of a line with numbers (value, low, high) under readings."""
    return lambda bounds, **numbers: recorded._scale(bounds, {name: {"here": here} for name, here in numbers.items()})


def places(svg, kind):
    return [float(at) for at in re.findall(rf'{kind}="([\d.-]+)%"', svg)]


def test_a_band_lies_in_the_middle_and_numbers_on_the_line_s_own_scale(line):
    svg = line(Bounds(2.0, 4.0, number=3.0), calibrated=(3.5, 3.0, 4.5), letter=(1.0, 0.5, 1.5))
    assert places(svg, "width") == [33.3] and places(svg, "cx") == [58.3] and 'class="thesis" x1="50.0%"' in svg
    assert '<line x1="50.0%" x2="75.0%"' in svg and '<line x1="8.3%" x2="25.0%"' in svg
    assert "calibrated: 3.50 [3.00, 4.50], across the edge" in svg
    assert "to the letter: 1.00 [0.50, 1.50], outside" in svg


def test_a_number_far_beyond_a_band_is_an_arrow_at_the_end_of_its_line(line):
    svg = line(Bounds(2.0, 4.0), calibrated=(100.0, 90.0, 110.0), letter=(-50.0, -60.0, -40.0))
    assert "→" in svg and "←" in svg and "<circle" not in svg


@pytest.mark.parametrize("bounds, numbers, band, at", [
    (Bounds(low=0.0), (5.0, 4.0, 6.0), [66.7], 33.3 + 50), (Bounds(high=1.0), (-2.0, -3.0, -1.0), [66.7], 66.7 - 45),
    (Bounds(low=0.0), (-5.0, -6.0, -4.0), [66.7], 33.3 - 28 * 5 / 6)])
def test_a_band_with_one_edge_leaves_room_for_the_farthest_number(line, bounds, numbers, band, at):
    svg = line(bounds, calibrated=numbers)
    assert places(svg, "width") == band and places(svg, "cx") == [pytest.approx(at, abs=0.1)]


@pytest.mark.parametrize("dark", ['data-theme="dark"', 'data-jp-theme-light="false"'])
def test_on_paper_the_figure_is_light_whatever_the_page_is(open_page, tmp_path, dark):
    (tmp_path / "page.html").write_text(
        f'<!doctype html><html {dark}><meta charset="utf-8"><link rel="icon" href="data:,">'
        f'<style>html {{ --jp-content-font-color1: white; --pst-color-text-base: white; }}</style><body {dark}>'
        f'<main class="bd-content">{recorded.answer("paper_b").data}')
    page = open_page(tmp_path, "page.html", color_scheme="dark")

    def colours():
        return [page.locator(part).first.evaluate(f"part => getComputedStyle(part).{name}") for part, name in (
            (".sentence", "color"), ("g.calibrated", "fill"), ("g.letter", "fill"), (".band", "fillOpacity"))]
    light = ["rgb(34, 34, 34)", "rgb(31, 111, 180)", "rgb(181, 84, 12)", "0.24"]
    assert not {*light[:3]} & {*colours()}
    page.emulate_media(media="print")
    assert colours() == light


def test_a_claim_decided_by_another_number_says_so():
    shown = recorded.figure(RECORD, {"": ["B3", "A7"]})
    (other,) = re.findall(r"<small>decided by another number, (.*?)</small>", shown)
    assert other.startswith("place cells: ") and "0.23 to 0.36" in other


def test_every_line_has_the_thesis_s_number_and_ours_with_verdicts_under_both_readings():
    shown = recorded.figure(RECORD, {"": STATEMENTS})
    lines = re.findall(r'<tr><th scope="row".*?</tr>', shown)
    assert len(lines) == len(STATEMENTS) and "nan" not in shown and "inf" not in shown
    for name, text in zip(STATEMENTS, lines):
        verdicts = re.findall(r'<small class="verdict-\w+"><a[^>]*>([^<]+)</a></small>', text)
        assert verdicts == [RECORD[part][name]["verdict"] for part in ("letter", "claims") if name in RECORD[part]]


@pytest.mark.parametrize("page", recorded.SHOWN)
def test_every_page_has_an_answer_in_words_and_numbers(page):
    words = re.search(r'<p class="sentence">(.*?)</p>', recorded.answer(page).data)[1]
    assert re.search(r"\d", words) and words[0].isupper() and words.endswith(".") and "{" not in words
    assert "calibrated" not in words or page in ("chapter_5", "calibration")  # which count claims


@pytest.mark.parametrize("name", [name for name, each in STATEMENTS.items() if each.finding])
def test_words_for_a_claim_hold_whatever_its_verdict_is(name):
    found = RECORD["claims"][name]
    assert recorded.finding(RECORD, name)
    for verdict in VERDICTS:
        said = recorded.finding({"claims": {name: found | {"verdict": verdict}}, "letter": {}}, name)
        assert "{" not in said and not said.endswith(".")


def test_words_name_what_a_number_is_of():
    claim = {"here": [4.0, 3.5, 4.5], "numbers": {"a ratio, of all": [[4.0, 3.5, 4.5]], "over it, DQN, which sees": [[
        4.0, 3.5, 4.5]], "over it, PPO": [[1.5, 1.0, 2.0]]}}
    assert recorded.said(claim, "{where} {here}, PPO {of[over it, PPO]}") == "DQN 4, PPO 1.50"


def test_a_caption_of_the_book_answers_its_question_by_the_record():
    answer = new_code_cell(outputs=[new_output("display_data", {"text/html": ""},
                                               metadata={"text/html": recorded.answer("paper_c")._repr_html_()[1]})])
    figure = new_code_cell(metadata={"mystnb": {"figure": {"name": "fig-proficiency-networks"}}})
    caption = new_markdown_cell("**Figure.** Does each help? Reward per second.", metadata={"tags": ["caption"]})
    shown = cells.of_page([answer, figure, caption], {})[-1].metadata["mystnb"]["figure"]["caption"]
    found = recorded.by_figure(RECORD)["fig-proficiency-networks"]
    assert shown == f"Does each help? Recorded: {found}. Reward per second."
    assert cells.answered("Drawn from its data.", "all") == "Drawn from its data."


CLAIM = {"verdict": "reproduced"}
COUNTED = {"claims": {name: CLAIM for name in ("B1", "B2", "B5", "B7", "T2")} | {"B3": {"verdict": "partly"}},
           "letter": {"B1": CLAIM, "B7": {"verdict": "partly"}}}


def test_kinds_of_claims_are_counted_apart():
    assert counts.sentence(COUNTED, ["B1", "B7", "B2", "B5", "B3", "B4"]) == (
        "Reproduced, of claims about agents: 2 of 3 calibrated, 1 of 1 to the letter; apart from these, of what is "
        "proved or counted: 1 of 1; apart from these, of our demonstrations, which are no claims of the thesis: 1 of 1 "
        "calibrated, 0 of 1 to the letter.")
    assert counts.sentence(COUNTED, ["T2"]) == "Reproduced, of what is about our code: 1 of 1."
    assert counts.sentence(COUNTED, ["A1"]) == ""


@pytest.mark.parametrize("page", recorded.SHOWN)
def test_the_figure_of_a_page_never_mixes_kinds(page):
    bodies = recorded.answer(page).data.split("<tbody>")[1:]
    found = [re.findall(r'\(<a href="[^"]*#claim-\w+"[^>]*>(\w+)</a>\)', body) for body in bodies]
    assert [tuple(names) for names in found] == [*counts.by_kind(recorded.SHOWN[page]).values()]
    assert len(found) == 1 or all(f">{words}</th>" in body for words, body in zip(
        counts.by_kind(recorded.SHOWN[page]), bodies))


def test_the_column_of_the_thesis_has_what_it_prints_and_bounds_of_ours_are_said_to_be():
    for name, statement in STATEMENTS.items():
        thesis = re.findall("<td>(?!<svg)(.*?)</td>", recorded.figure({"claims": {}, "letter": {}}, {"": [name]}))[0]
        printed = statement.quotation.replace("²", "2")
        words, _, ours = thesis.partition("<small>ours: ")
        assert all(each in printed for each in re.findall(r"[\d.]+", words)) and (words or ours), name
    assert recorded.expected("A7") == "Thesis: 3.5" and recorded.expected("C2") == "Thesis: increased"
    drawn = recorded.figure(RECORD, {"": ["T2"]})
    assert "<small>ours: 1.1 or less</small>" in drawn and '<line class="thesis"' not in drawn


def test_boards_are_said_of_the_papers_whose_claims_are_shown():
    assert recorded.boards(["A1", "T1"]) == ("Paper A: 8 creeps, +5 for the last green one, 30 steps per second "
                                             "calibrated, 50 steps per second to the letter.")
    assert recorded.boards(["C1"]) == "Papers B and C: 3 creeps, nothing for the last green one, 50 steps per second."
    assert recorded.boards(["T1", "A10"]) == "" and recorded.boards(["C2"]) in recorded.answer("paper_c").data


def test_numbers_stand_with_what_they_are_of():
    drawn = recorded.figure(RECORD, {"": ["T6"]})
    assert f"<small>{STATEMENTS['T6'].statistic}</small>" in drawn


def test_claims_in_few_words_are_few():
    assert all(len(each.short.split()) <= 8 for each in STATEMENTS.values())
