"""Tables and numbers in Markdown."""

from lib.shared.wording import number, scientific, table
from neorl.evidence.statistics import Estimate


def test_a_table_has_a_line_for_its_heads_a_rule_and_a_line_for_each_row():
    assert table(["Claim", "Share"], [["A1", "0.5"], ["A2", ""]]) == (
        "| Claim | Share |\n|---|---|\n| A1 | 0.5 |\n| A2 |  |")
    assert table(("a", 1), [("b", Estimate(2, 1, 3))]) == "| a | 1 |\n|---|---|\n| b | 2.00 [1.00, 3.00] |"
    assert table(["Claim"], []) == "| Claim |\n|---|"


def test_a_number_has_a_minus_sign_and_zero_has_none():
    assert [number(value) for value in (1.234, -1.5, -0.001)] == ["1.23", "−1.50", "0.00"]
    assert number(-12.34, 1) == "−12.3"


def test_a_number_is_written_with_a_power_of_ten():
    assert [scientific(value) for value in (2.4e-16, 3e9, 0.0)] == ["2 × 10<sup>−16</sup>", "3 × 10<sup>9</sup>", "0"]
    assert scientific(2.96e9, 1) == "3.0 × 10<sup>9</sup>"
