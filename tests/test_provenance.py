"""Where constants come from: none is left out, and the values are those of the code."""

from neorl import Policy, WaterWorld, provenance
from neorl.multiverse import CHOICES


def test_every_open_choice_and_every_rule_of_the_tank_has_a_source():
    constants = {each.name: each for each in provenance.constants()}
    assert {choice.label for choice in CHOICES.values()} <= set(constants)
    assert set(provenance.SOURCES) == set(CHOICES)
    assert all(each.value and each.source for each in constants.values())
    assert len(constants) == len(provenance.constants())


def test_the_values_are_those_of_the_code():
    values = {each.name: each.value for each in provenance.constants()}
    assert values["side of the tank"] == f"{WaterWorld().width} pixels"
    assert values["exploration, ε"] == f"{Policy().exploration:g}"
    assert values["resolutions, papers B and C"] == "N2, N3, N5, N7, N11, N13"
    assert values["steps of a run, paper A"] == "150,000" and values["creeps, paper A"] == "8"
    assert provenance.table().count("\n") == len(values) + 1
