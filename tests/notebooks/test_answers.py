"""The answers that open pages: plain words, with numbers of the record."""

import re

import pytest

from companion.page import answers

CODES = re.compile(r"\b[ABCTGH]\d{1,2}\b")


@pytest.mark.parametrize("page", answers.WORDS)
def test_an_answer_is_in_plain_words_with_one_number_in_bold(page):
    answer = answers.answer(page)
    assert answer.count("<strong>") == 1 and re.search(r"<strong>[^<]*\d", answer) and "{" not in answer
    assert not CODES.search(answer) and "calibrated" not in answer and "reproduced" not in answer
    assert len(re.sub("<[^>]*>", "", answer).split()) <= 75


def test_numbers_are_those_of_the_record(monkeypatch):
    claim = {"here": [0.62, 0.6, 0.7], "numbers": {"lead": [[1.5, 1, 2], "", "", "shown"]}}
    monkeypatch.setattr(answers.report, "record", lambda: {"claims": {"T7": claim}})
    monkeypatch.setattr(answers, "WORDS", {"one": "At **{T7 %}** of it, {T7: lead} ahead."})
    assert answers.answer("one") == "At <strong>62\u00a0%</strong> of it, 1.50 ahead."
    assert answers.answer("another") == ""
