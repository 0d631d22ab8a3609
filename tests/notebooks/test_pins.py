"""Pins: every pinned choice quotes its sentence, and a reading that breaks one is detected."""

import pytest

from companion.thesis import pins
from companion.thesis.priors import BEYOND, WITHIN
from companion.thesis.reading import TO_THE_LETTER, Reading

PINNED = [pin for pin in pins.PINS if pin.status == "pinned"]


def test_every_choice_of_a_reading_has_its_row_and_no_other_has():
    assert {name for pin in pins.PINS for name in pin.fields} == set(Reading().choices)
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
    ({"network_gain": 5.0}, ["gain of place cells, paper C"]), ({"recursion": -2.0}, ["recursion, r"]),
    ({"recursion": 1.0, "network_gain": 5.0}, ["gain of place cells, paper C", "recursion, r"])])
def test_a_reading_against_the_text_says_which_sentences_it_breaks(change, broken):
    reading = TO_THE_LETTER.varied(**change)
    found = pins.broken(reading)
    assert [pin.choice for pin in found] == broken
    assert all(f"“{pin.quotation}” ({pin.place})" in pins.in_words(reading) for pin in found)


def test_every_sentence_that_pins_a_choice_is_broken_somewhere_beyond_and_nowhere_within():
    for pin in PINNED:
        for choices, breaks in ((WITHIN, False), (BEYOND, bool(pin.fields))):
            of_pin = [name for name in pin.fields if name in choices]
            values = [choices[name].at((k + 0.5) / 60) for name in of_pin for k in range(60)]
            names = [name for name in of_pin for _ in range(60)]
            assert any(not pin.allows(TO_THE_LETTER.varied(**{name: value}))
                       for name, value in zip(names, values)) == breaks, pin.choice
