"""Sentences on cats in boxes, rats at levers and an animal with desires."""

import numpy as np
import pytest

from lib.chapter_2.psychology_report import describe_latencies, describe_presses, describe_way


def test_a_law_is_described_by_its_first_and_last_trial_and_by_when_times_have_halved():
    falling = np.array([[80.0, 60.0, 40.0, 30.0], [80.0, 60.0, 40.0, 20.0]])
    words = describe_latencies({"gain": falling, "none": np.full((2, 4), 50.0)}, published=[60, 80])
    assert words.startswith("On average, with *gain* a cat takes 80.00 [80.00, 80.00] seconds in the first trial and "
                            "25.00 [20.00, 30.00] in the last, and trial 3 is the earliest to take at most half as "
                            "long as the first; with *none*")
    assert "no trial takes at most half as long as the first. Over" in words
    assert words.endswith("Over its first 2 trials the cat of 1899 took 70 seconds on average; the simulated "
                          "cats take 70 with *gain*, 50 with *none*.")


def pressing(*phases, runs=4):
    """Presses per minute of rats with these rates in the light and in the dark, for ten sessions of each phase."""
    sessions = np.repeat(np.array(phases, float), 10, axis=0)
    sessions[::10] = 99.0  # the first session of a phase does not count
    return np.tile(sessions, (runs, 1, 1))


def test_presses_are_counted_at_the_end_of_each_phase():
    sees = pressing((58, 57), (56, 4), (3, 2))
    words = describe_presses({"sees": sees, "blind": pressing((58, 58), (50, 30), (3, 3))}, ends=(10, 20, 30))
    numbers = [f"{number:.2f} [{number:.2f}, {number:.2f}]" for number in (58, 57, 56, 4, 3, 2, 52, 20)]
    first, second, third, *_ = words.split(" while ")
    assert f"presses {numbers[0]} times per minute in the light and {numbers[1]} in the dark" in first
    assert f"{numbers[2]} and {numbers[3]}" in second and f"{numbers[4]} and {numbers[5]} once it never pays" in third
    assert f"makes a difference of {numbers[6]} presses" in words
    assert f"In blind rats the difference is {numbers[7]}" in words


@pytest.mark.parametrize("blind, by_food", [((40, 20), True), ((30, 30), False), ((20, 40), False)])
def test_food_is_a_stimulus_where_blind_rats_press_more_in_the_light(blind, by_food):
    minutes = {"sees": pressing((0, 0), (56, 4), (0, 0)), "blind": pressing((0, 0), blind, (0, 0))}
    assert ("food itself acts as a stimulus" in describe_presses(minutes, (10, 20, 30))) == by_food


@pytest.mark.parametrize("sees, gated", [((56, 4), True), ((40, 20), False)])
def test_the_light_gates_the_response_where_its_effect_exceeds_that_on_blind_rats(sees, gated):
    minutes = {"sees": pressing((0, 0), sees, (0, 0)), "blind": pressing((0, 0), (40, 20), (0, 0))}
    words = describe_presses(minutes, (10, 20, 30))
    assert ("only in rats that perceive it" in words) == gated != words.endswith("do not show the effect of the light.")


def test_a_path_has_steps_or_there_is_none():
    assert describe_way(4) == "4 steps" and describe_way(0) == "0 steps" and describe_way(None) == "no path"
