"""The statements: their quotations, their bounds, and the rules that they name."""

import math

import pytest

from companion.thesis import claims
from companion.thesis.statements import CLAIMS, DEMONSTRATIONS, POSITIVE, STATEMENTS, Bounds
from neorl.statistics import Estimate


def test_bounds_are_read_by_both_ends_of_an_interval():
    near = Bounds(2.5, 5.0, number=3.5)
    within, across, beyond = Estimate(3, 2.5, 5), Estimate(3, 2, 4), Estimate(6, 5.1, 7)
    assert [near.decide(each) for each in (within, across, beyond)] == [True, None, False]
    assert [str(each) for each in (near, Bounds(low=0.8), Bounds(high=30), Bounds(-5, 5), POSITIVE)] == [
        "from 2.5 to 5", "0.8 or more", "30 or less", "from −5 to 5", "more than 0"]
    at_0, at_most_0, unknown = Estimate(1, 0, 2), Estimate(-1, -2, 0), Estimate(1, math.nan, math.nan)
    assert [Bounds(low=0.0).decide(each) for each in (at_0, at_most_0, unknown)] == [True, None, None]
    assert [POSITIVE.decide(each) for each in (at_0, at_most_0, unknown)] == [None, False, None]


def test_a_number_stands_in_the_words_of_its_statement_and_within_its_bounds():
    for name, statement in STATEMENTS.items():
        for each in (statement.bounds, *statement.also.values()):
            if each.number is not None:
                assert f"{each.number:g}" in f"{statement.thesis} {statement.quotation}", name
                assert each.low <= each.number <= each.high, name


def test_a_factor_that_is_named_is_that_of_the_bounds():
    for statement in STATEMENTS.values():
        for each in (statement.bounds, *statement.also.values()):
            if "within a factor of" in each.why:
                factor = float(each.why.split()[-1].replace("√2", str(math.sqrt(2))))
                number = 1.0 if each.number is None else each.number
                for end, sense in ((each.low, -1), (each.high, 1)):
                    assert math.isinf(end) or end == pytest.approx(number * factor**sense, rel=0.02)


def test_every_rule_is_named_in_the_statements():
    rules = {name for name in vars(claims) if name.startswith("judge_")}
    assert {statement.rule for statement in STATEMENTS.values()} == rules


def test_every_statement_quotes_what_it_judges_and_demonstrations_stand_beside_the_claims():
    for name, statement in STATEMENTS.items():
        assert statement.place and 5 <= len(statement.quotation.split()) <= 45, name
    assert DEMONSTRATIONS == ("B7", "T9", "G1", "G2", "G3", "G4", "H1")
    assert sorted((*CLAIMS, *DEMONSTRATIONS)) == sorted(STATEMENTS)
