"""Tables and lists of names in Markdown."""

from neorl.chapters.shared.wording import listed, table


def test_a_table_has_a_line_for_its_heads_one_below_and_one_for_each_row():
    assert table(["Claim", "Share"], [["A1", "0.5"], ["A2", ""]]) == (
        "| Claim | Share |\n|---|---|\n| A1 | 0.5 |\n| A2 |  |")
    assert table(["Claim"], []) == "| Claim |\n|---|"


def test_names_are_listed_and_none_is_said():
    assert listed(name for name in ("A1", "B2")) == "A1, B2"
    assert listed([]) == "none" and listed((), "no claim") == "no claim"
