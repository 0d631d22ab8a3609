"""What pages share: tables, marks, the box of findings, readings side by side, figures with the thesis's numbers."""

import re
from pathlib import Path

import numpy as np

from companion.page import marks, report
from companion.study import provenance
from companion.paper_a import superposed_field
from companion.thesis.pins import PINS
from companion.thesis.priors import BEYOND
from companion.page.thesis_figures import draw_against_thesis
from companion.page.wording import number, scientific, table
from neorl import WaterWorld
from neorl.core.horde import superpose
from neorl.drawing.style import linear_light
from companion.thesis.reading import Reading, changed
from neorl.statistics import Estimate
from companion.thesis.verdict import VERDICTS

STYLE_SHEET = (Path(__file__).parents[2] / "book" / "vendor" / "book.css").read_text()
GROUNDS = ("#ffffff", "#f3f4f5"), ("#121212", "#29313d"), ("#ffffff",)  # pages and boxes, light, dark and printed


def test_a_table_has_a_line_for_its_heads_a_rule_and_a_line_for_each_row():
    assert table(("a", 1), [("b", Estimate(2, 1, 3))]) == "| a | 1 |\n|---|---|\n| b | 2.00 [1.00, 3.00] |"
    assert [number(value) for value in (1.234, -1.5, -0.001)] == ["1.23", "−1.50", "0.00"]
    assert [scientific(value) for value in (2.4e-16, 3e9, 0.0)] == ["2 × 10<sup>−16</sup>", "3 × 10<sup>9</sup>", "0"]


def contrast(first, second):
    """The contrast of two colours as WCAG 2 defines it: 1 … 21."""
    (_, dark), (_, light) = sorted(map(linear_light, (first, second)), key=lambda each: each[1])
    return (light + 0.05) / (dark + 0.05)


def test_every_verdict_has_a_mark_whose_colour_is_legible_on_all_grounds():
    symbols = [marks.symbol(verdict) for verdict in (*VERDICTS, report.NOT_COMPUTED)]
    assert symbols == ["●", "◐", "○", "⊘", "?", "◇", "∎", "∃", "◇", "◇"]  # apart by shape, but for those of no finding
    assert "(whether a part holds is open), ?\u00a0undecided (more runs would tell), ◇" in marks.legend()
    styled = dict(re.findall(r"\n\.(verdict-[\w-]+) \{\n  color: var\(--([\w-]+)\);", STYLE_SHEET))
    assert styled.keys() == {mark.css for mark in marks.MARKS.values()}
    found = re.findall(r"--(verdict-[\w-]*|link[\w-]*): (#[0-9a-f]{6});", STYLE_SHEET)
    for grounds, colours in zip(GROUNDS, map(dict, np.array_split(found, len(GROUNDS)))):
        assert colours.keys() == {*styled.values(), "link"}
        for name, colour in colours.items():
            for ground in grounds:
                assert contrast(colour, ground) >= 4.5, (name, ground)


def test_variants_of_a_reading_are_those_that_differ():
    reading = Reading().varied(memory=0.0, exploration=0.1)
    made = changed(reading, {"no memory": {"memory": 0.0}, "greedy": {"exploration": 0.0}})
    assert made == {"greedy": reading.varied(exploration=0.0)}


def test_every_constant_has_a_source_and_the_value_of_the_code():
    constants = {each.name: each for each in provenance.constants()}
    assert all(each.value and each.source for each in constants.values())
    assert constants["side of the tank"].value == f"{WaterWorld().width} pixels"
    assert constants["steps of a run, paper A"].value == "150,000" and constants["creeps, paper A"].value == "8"
    assert constants["creeps, papers B and C"].source.startswith("paper B")


def test_every_choice_stands_once_with_its_sentence_its_values_and_the_claims_that_it_matters_for():
    head, _, *rows = provenance.choices({"memory": ["A6", "A7"]}).splitlines()
    assert len(rows) == len(PINS) and head.endswith("| To the letter | Calibrated | Matters for |")
    valued = [row for row in rows if row.split(" | ")[-2]]
    assert len(valued) == len(BEYOND)
    (memory,) = [row for row in rows if row.startswith("| memory")]
    assert memory.endswith(f"| 0 | {BEYOND['memory'].words(Reading().choices['memory'])} | A6, A7 |")
    (rate,) = [row for row in rows if row.startswith("| learning rate")]
    assert "“is a ‘learning factor’” (section 4.1.3, equation 4.6)" in rate and "0.0122 (*ours*)" in rate
    (ties,) = [row for row in rows if row.startswith("| ties")]
    assert "| open, not varied | random | random |" in ties


def test_a_field_has_the_superposition_of_every_cell():
    q = np.random.default_rng(0).random((9, 4, 9), np.float32)
    field = superposed_field(q, [2, 7], [1.0, -0.5])
    np.testing.assert_array_equal(field, [superpose(q, state, [2, 7], [1.0, -0.5]) for state in range(9)])


def test_only_what_the_thesis_has_a_number_for_is_marked_as_its_own():
    here = {"reward": Estimate(1, 0, 2), "states": Estimate(4, 3, 5)}
    axes = draw_against_thesis({"reward": None, "states": 5.9}, here, "times")
    assert [text.get_text() for text in axes.texts] == ["thesis 5.9"]
    axes = draw_against_thesis(dict.fromkeys(here), here, "times", {"all": 9.0})
    assert [text.get_text() for text in axes.texts] == ["all"] and axes.get_xlim()[1] > 9
