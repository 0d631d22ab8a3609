"""Pins: every pinned choice quotes its sentence, and a reading that breaks one is detected."""

from dataclasses import fields, replace

import pytest

from lib.shared.priors import BEYOND, TO_THE_LETTER, WITHIN
from lib.study import multiverse
from neorl.evidence import pins
from neorl.evidence.reading import Reading

PINNED = [pin for pin in pins.PINS if pin.status == "pinned"]


def test_every_choice_of_a_reading_has_its_row_and_no_other_has():
    assert {name for pin in pins.PINS for name in pin.fields} == {field.name for field in fields(Reading)}
    assert len({pin.choice for pin in pins.PINS}) == len(pins.PINS)


def test_what_is_pinned_is_quoted_and_located():
    assert all(pin.quotation and pin.place and pin.follows for pin in PINNED)
    assert all(bool(pin.quotation) == bool(pin.place) and pin.follows for pin in pins.PINS)
    assert all(len(pin.quotation.split()) <= 30 for pin in pins.PINS)


@pytest.mark.parametrize("change, broken", [
    ({"exploration": 0.02}, ["policy"]),
    ({"tiled_fraction": 0.5}, ["range of place cells"]), ({"weighting": "equal"}, ["weight of a map"]),
    ({"own_cell": "silent"}, ["elements in the agent's own cell"]),
    ({"credit": "step"}, ["driver of learning", "credit of events that occurred", "credit of events that did not occur",
                          ]),
    ({"credit": "last"}, ["credit of events that occurred"]),
    ({"absent_decay": 0.0}, ["credit of events that did not occur"]),
    ({"fps": 30}, ["steps per second"]), ({"network_gain": 5.0}, ["gain of place cells, paper C"]),
    ({"recursion": -2.0}, ["recursion, r"]), ({"recursion": 1.0, "fps": 30}, ["recursion, r", "steps per second"])])
def test_a_reading_against_the_text_says_which_sentences_it_breaks(change, broken):
    found = replace(TO_THE_LETTER, **change).within_the_text
    assert not found and [pin.choice for pin in found.broken] == broken
    assert all(f"“{pin.quotation}” ({pin.place})" in str(found) for pin in found.broken)


@pytest.mark.parametrize("change", [
    {"weighting": "cells"}, {"credit": "count"}, {"credit": "share"}, {"credit": "activity", "memory": 0.0},
    {"absent_form": "decay"}, {"bootstrap": False}, {"terminal": True}, {"object_tiled_fraction": 0.25},
    {"place_gain": 5.0},
    {"network_resolutions": (2, 3)}, {"fps": 60}, {"learning_rate": 0.9}, {"memory": 0.0}, {"vectors": "signed"},
    {"scale": 100.0}, {"when_indifferent": "no-op"}, {"object_state": "object"}])
def test_what_is_open_breaks_nothing(change):
    assert replace(TO_THE_LETTER, **change).within_the_text


def test_designs_within_the_text_are_and_those_beyond_are_not():
    assert all(reading.within_the_text for reading in multiverse.design(256))
    assert not any(reading.within_the_text for reading in multiverse.design(256, choices=BEYOND))


def test_every_sentence_that_pins_a_choice_is_broken_somewhere_beyond_and_nowhere_within():
    for pin in PINNED:
        for choices, breaks in ((WITHIN, False), (BEYOND, bool(pin.fields))):
            of_pin = [name for name in pin.fields if name in choices]
            values = [choices[name].at((k + 0.5) / 60) for name in of_pin for k in range(60)]
            names = [name for name in of_pin for _ in range(60)]
            assert any(not pin.allows(replace(TO_THE_LETTER, **{name: value}))
                       for name, value in zip(names, values)) == breaks, pin.choice
