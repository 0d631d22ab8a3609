"""Readings of the thesis side by side: their variants and their choices."""

from dataclasses import replace

from lib.shared import side_by_side
from neorl.evidence.reading import TO_THE_LETTER, Reading


def test_a_change_that_leaves_a_reading_unchanged_is_dropped():
    reading = Reading(memory=0.0, exploration=0.1)
    made = side_by_side.changed(reading, {"no memory": {"memory": 0.0}, "greedy": {"exploration": 0.0}})
    assert made == {"greedy": replace(reading, exploration=0.0)}


def test_choices_are_open_or_pinned():
    table = side_by_side.choices({"letter": TO_THE_LETTER, "far": replace(TO_THE_LETTER, recursion=2.0)},
                                 ["recursion", "network_resolutions"])
    assert table.splitlines() == ["| Choice | The text | letter | far |", "|---|---|---|---|",
                                  "| recursion, r | pinned | −1 | 2 |",
                                  "| resolutions, C | open | {3, 7, 23} | {3, 7, 23} |"]
