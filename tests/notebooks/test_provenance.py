"""The table of constants and their sources: none is missing, and the values are those of the code."""

from dataclasses import replace

from lib.shared import provenance
from lib.shared.priors import BEYOND, PINNED, TO_THE_LETTER, WITHIN
from neorl import GREEDY, WaterWorld
from neorl.evidence.pins import PINS
from neorl.evidence.reading import Reading


def test_every_choice_and_every_rule_of_the_tank_has_a_source():
    constants = {each.name: each for each in provenance.constants()}
    assert {choice.label for choice in BEYOND.values()} <= set(constants)
    assert all(each.value and each.source for each in constants.values())
    assert len(constants) == len(provenance.constants())


def test_the_values_are_those_of_the_code():
    values = {each.name: each.value for each in provenance.constants()}
    assert values["side of the tank"] == f"{WaterWorld().width} pixels"
    assert values["exploration, ε"] == f"{GREEDY.exploration:g}"
    assert values["resolutions, paper B"] == "N2, N3, N5, N7, N11, N13"
    assert values["steps of a run, paper A"] == "150,000" and values["creeps, paper A"] == "8"
    assert {each.name: each.source for each in provenance.constants()}["creeps, papers B and C"].startswith("paper B")
    assert provenance.table().count("\n") == len(values) + 1


def test_the_source_of_a_choice_is_the_sentence_that_pins_it_unless_the_default_breaks_that(monkeypatch):
    reading = replace(TO_THE_LETTER, tiled_fraction=0.5)
    monkeypatch.setattr(provenance, "Reading", lambda: reading)
    assert provenance.source("recursion") == "paper C, section 3"
    assert provenance.source("tiled_fraction") == "against paper B, figure 3"
    assert provenance.source("object_state") == "open in paper B, section 3; value by calibration"
    assert provenance.source("contact") == "value by calibration"


def test_the_tables_of_pins_have_a_row_for_each_choice_what_is_pinned_first():
    pinned, unsettled = provenance.of_pins({"scale": "desire scale"}).split("\n\n**Open**\n\n")
    assert len(pinned.splitlines()[4:] + unsettled.splitlines()[2:]) == len(PINS)
    assert "“e<sup>out</sup> = d”" in unsettled and "Q<sub>tot</sub>(s, a)" in pinned
    assert "| where a desire lies (*desire scale*) |" in unsettled


def test_the_reading_to_the_letter_takes_what_is_pinned_or_else_what_is_plainest():
    plainest = {name: choice.plainest for name, choice in WITHIN.items()}
    assert TO_THE_LETTER == Reading(**PINNED, **plainest | {"memory": 0.0})
