"""Readings of the thesis side by side: the conditions computed, and sentences on several readings at once."""

from dataclasses import replace

import neorl
from lib.shared import side_by_side
from neorl.evidence.priors import TO_THE_LETTER
from neorl.evidence.reading import Reading


def test_conditions_that_readings_share_are_computed_once(monkeypatch):
    computed = []

    def sweep(conditions):
        computed.extend(conditions)
        return [f"result {i}" for i, _ in enumerate(conditions)]

    monkeypatch.setattr(side_by_side, "sweep", sweep)
    one, other = (neorl.Condition(neorl.place_cells([n]), neorl.WaterWorld(), 100, 1) for n in (2, 3))
    lived = side_by_side.live({"a": {"x": one, "y": other}, "b": {"y": other, "z": replace(one)}})
    assert computed == [one, other]
    assert lived == {"a": {"x": "result 0", "y": "result 1"}, "b": {"y": "result 1", "z": "result 0"}}


def test_secondary_conditions_have_at_most_as_many_runs_as_a_verdict_needs():
    assert [side_by_side.few(runs) for runs in (1, 10, 20, 100)] == [1, 10, 10, 10]


def test_each_reading_is_judged_by_its_own_results(monkeypatch):
    monkeypatch.setattr(side_by_side, "judge", lambda results: {name: name.upper() for name in results})
    assert side_by_side.judge_each({"one": {"a1": 0, "a2": 0}, "other": {}}) == {"one": ["A1", "A2"], "other": []}


def test_a_change_that_leaves_a_reading_unchanged_is_dropped():
    reading = Reading(memory=0.0, exploration=0.1)
    made = side_by_side.changed(reading, {"no memory": {"memory": 0.0}, "greedy": {"exploration": 0.0}})
    assert made == {"greedy": replace(reading, exploration=0.0)}


def test_results_are_named_by_resolution_in_the_order_asked_for():
    results = {("place", "all"): "together", ("place", 2): "coarse", ("place", 13): "fine", "both": "other"}
    found = side_by_side.by_resolution(results, "place", (2, 13, "all"))
    assert list(found.items()) == [("N2", "coarse"), ("N13", "fine"), ("all", "together")]


def test_the_sentences_on_each_reading_are_an_item_of_a_list():
    assert side_by_side.each_in_words({"to the letter": "One.", "calibrated": "Two."}) == (
        "- **To the letter.** One.\n- **Calibrated.** Two.")


def test_choices_are_open_or_pinned():
    table = side_by_side.choices({"letter": TO_THE_LETTER, "far": replace(TO_THE_LETTER, recursion=2.0)},
                                 ["recursion", "network_resolutions"])
    assert table.splitlines() == ["| Choice | The text | letter | far |", "|---|---|---|---|",
                                  "| recursion, r | pinned | −1 | 2 |",
                                  "| resolutions, C | open | {3, 7, 23} | {3, 7, 23} |"]
