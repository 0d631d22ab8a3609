"""Tables, lists of names, numbers and intervals in Markdown."""

import numpy as np

from lib.shared.wording import by_interval, listed, number, of_all, scientific, table
from neorl.evidence.statistics import Estimate


def test_a_table_has_a_line_for_its_heads_a_rule_and_a_line_for_each_row():
    assert table(["Claim", "Share"], [["A1", "0.5"], ["A2", ""]]) == (
        "| Claim | Share |\n|---|---|\n| A1 | 0.5 |\n| A2 |  |")
    assert table(("a", 1), [("b", Estimate(2, 1, 3))]) == "| a | 1 |\n|---|---|\n| b | 2.00 [1.00, 3.00] |"
    assert table(["Claim"], []) == "| Claim |\n|---|"


def test_names_are_listed_and_an_empty_list_is_none():
    assert listed(name for name in ("A1", "B2")) == "A1, B2"
    assert listed([]) == "none" and listed((), "no claim") == "no claim"


def test_a_number_has_a_minus_sign_and_zero_has_none():
    assert [number(value) for value in (1.234, -1.5, -0.001)] == ["1.23", "−1.50", "0.00"]
    assert number(-12.34, 1) == "−12.3"


def test_a_number_is_written_with_a_power_of_ten():
    assert [scientific(value) for value in (2.4e-16, 3e9, 0.0)] == ["2 × 10<sup>−16</sup>", "3 × 10<sup>9</sup>", "0"]
    assert scientific(2.96e9, 1) == "3.0 × 10<sup>9</sup>"


def test_an_interval_decides_only_if_it_leaves_out_zero():
    texts = "more", "less", "open"
    assert by_interval(Estimate(2, 1, 3), *texts) == "more"
    assert by_interval(Estimate(-2, -3, -1), *texts) == "less"
    assert by_interval(Estimate(1, -1, 3), *texts) == by_interval(Estimate(-1, -3, 1), *texts) == "open"
    assert by_interval(Estimate(1, np.nan, np.nan), *texts) == "open"


def test_a_share_that_is_everything_says_all():
    assert (of_all(8, 8), of_all(2, 8), of_all(0, 8)) == ("all 8", "2 of the 8", "0 of the 8")
