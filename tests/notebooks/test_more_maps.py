"""Agents with more and more maps: their definition and the sentences on them."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np

from lib.chapter_5 import more_maps
from lib.chapter_5.more_maps import COUNTS
from neorl import WaterWorld
from neorl.evidence.reading import Reading, conditions


def made_up(*rates):
    """A result of eight runs for each rate, which they earn throughout, up to small differences."""
    return [SimpleNamespace(rate=lambda *share, rate=rate: rate + 1e-3 * np.arange(8))
            for rate in rates]


def results(place=(0.1, 0.2, 0.3, 0.4), objects=(0.1, 0.2, 0.3, 0.4), both=(0.2, 0.3, 0.4, 0.5)):
    rates = {"place cells": place, "object-vector cells": objects, "both": both}
    return {name: made_up(*each) for name, each in rates.items()}


def test_agents_have_the_coarsest_maps_of_paper_b_up_to_all(monkeypatch):
    monkeypatch.setattr(more_maps, "simulate_once", lambda agent, world, **chosen: (agent, world, chosen))
    reading = replace(Reading(), memory=2.0)
    found = more_maps.live(reading, steps=700, runs=3, seed=5)
    paper_b = conditions(reading, 700, 3, 5, ["modal"])
    for name, key in (("place cells", ("place", "all")), ("object-vector cells", ("objects", "all")), ("both", "both")):
        agents = [agent for agent, *_ in found[name]]
        assert agents[-1] == paper_b[key].agent
        assert [agent.nodes[0].resolutions for agent in agents] == [(2,), (2, 3), (2, 3, 5, 7), (2, 3, 5, 7, 11, 13)]
        assert [chosen for *_, chosen in found[name]] == [{"steps": 700, "runs": 3, "seed": 5}] * len(COUNTS)
    assert found["both"][0][1] == WaterWorld()


def test_final_rewards_are_those_of_the_last_fifth():
    shares = []
    one = SimpleNamespace(rate=lambda *share: shares.append(share) or np.array([0.25, 0.75]))
    assert more_maps.final_rewards({"both": [one]})["both"][0].value == 0.5 and shares == [(0.8, 1.0)]


def test_maps_that_help_in_every_case_and_to_the_end_are_said_to():
    assert more_maps.in_words(results()) == (
        "From one map to six the gain is 0.30 [0.30, 0.30] with place cells, 0.30 [0.30, 0.30] with object-vector "
        "cells, 0.30 [0.30, 0.30] with both. Six maps earn more than one in every case. From four to six the gain "
        "is still above zero with place cells and object-vector cells and both.")


def test_ability_that_levels_off_is_said_to():
    level = (0.1, 0.2, 0.3, 0.3)
    assert more_maps.in_words(results(level, level, level)).endswith(
        "Six maps earn more than one in every case. From four to six no interval is above zero any more: ability "
        "scales, and it levels off.")


def test_maps_that_help_in_some_cases_or_in_none_are_distinguished():
    flat, level = (0.1, 0.1, 0.1, 0.1), (0.1, 0.2, 0.3, 0.3)
    assert more_maps.in_words(results(flat, level, level)).endswith(
        "The interval is above zero with object-vector cells and both. From four to six no interval is above zero any "
        "more.")
    assert "The interval is above zero with none of them." in more_maps.in_words(results(flat, flat, flat))
