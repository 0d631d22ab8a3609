"""The page of paper B: the conditions of its cells, and what it judges of them."""

from dataclasses import replace

import numpy as np
import pytest
from page_cells import planned, source

import neorl
from companion.paper_b import figures
from companion.shared.judging import by_condition
from companion.shared.report import CLAIMS_OF
from companion.thesis.reading import PRIMES, READINGS, Reading, conditions
from neorl import Condition, WaterWorld

STAYS = "stays = trials"  # the line from which on a cell needs results


def page(*cells, runs=12, steps=1_000, **given):
    """What cells of the page define, with conditions in place of results: {name: value}."""
    given = {"seed": 3, "runs": runs, "steps": steps} | given
    return planned("paper_b", "computing", *cells, until=[STAYS], **given)


@pytest.mark.parametrize("reading", READINGS)
@pytest.mark.parametrize("steps", [1_000, 600_000, 700_000])
def test_the_experiment_is_that_of_the_paper_under_a_reading(reading, steps):
    names = page("more-runs-computed", "ran", reading=reading, steps=steps)
    main = conditions(READINGS[reading], steps, 12, 3, ["modal", "pace"])
    expected = conditions(READINGS[reading], steps, 10, 3, ["modal", "resolutions"])
    expected |= {key: main[key] for key in (("place", "all"), ("objects", "all"), "both")}
    assert by_condition(names["ran"], expected) == expected
    pace = {key: main["pace", key] for key in ("place", "both")}
    assert by_condition([*names["ran"], *names["paced"].values()], pace) == pace
    joined = names["joined"]
    assert (joined.agent, joined.runs) == (expected["place", "all"].agent, 10)
    assert joined.changes == ((expected["both"].steps // 2, expected["both"].agent),)


def test_points_are_taken_from_the_same_runs(cache_folder):
    names = page("more-runs-computed", runs=1, steps=40_000, resolutions=(2, 3))
    boards = names["boards"]
    assert {name: each.steps for name, each in boards.items()} == {
        "PC": 10_000, "OVC": 10_000, "PC + OVC": 40_000, "Brownian motion": 10_000}
    both, paying = (neorl.simulate(**each.choices, cache=True)
                    for each in (names["results"]["PC + OVC"], boards["PC + OVC"]))
    np.testing.assert_array_equal(both.hits, paying.hits)
    assert paying.totals[0] > both.totals[0]


def test_the_variations_are_other_values_of_what_the_text_leaves_open():
    names = page("variations")
    usual = conditions(Reading(), 1_000, 10, 3, ["modal"])
    assert names["varied"]["a quarter as long"]["PC + OVC"] == usual["both"]
    assert len(names["varied"]) == 10 == len({each["PC + OVC"] for each in names["varied"].values()})


def empty_results(conditions):
    return [neorl.Result(each, np.zeros((each.runs, bins := -(-each.steps // 10)), np.float32),
                         np.zeros((each.runs, bins, 2), np.int16)) for each in conditions]


ALL = [*CLAIMS_OF["paper_b"]]


def judged(change=None, **given):
    """The claims that the page judges of runs in which nothing is earned. change: of the names that it judges."""
    given = {"runs": 2, "steps": 1_000, "sweep": empty_results} | given
    names = planned("paper_b", "computing", "more-runs-computed", "ran", **given)
    for name in [change] if change else []:
        each = names[name]
        names[name] = ({"PC + OVC": other_agent(each["PC + OVC"])} if isinstance(each, dict) else other_agent(each))
    exec(source("paper_b", "judging"), names)
    return [claim.name for claim in names["judged"]], names["of_paper"]


def other_agent(made):
    """The same result, or measurement, of another agent."""
    condition = replace(made.condition, agent=neorl.brownian())
    return replace(made, condition=condition) if isinstance(made, neorl.Result) else made._replace(condition=condition)


def with_a_third_node(*arguments, **options):
    both = neorl.multimodal(*arguments, **options)
    return replace(both, nodes=[*both.nodes, neorl.Node("HD", neorl.modality.HEAD_DIRECTION_CELL, [8])])


@pytest.mark.parametrize("given, found", [
    ({}, ALL), ({"reading": "letter"}, ALL),
    ({"change": "boards"}, [name for name in ALL if name != "B5"]),
    ({"change": "joined"}, [name for name in ALL if name != "B7"]),
    ({"change": "stays"}, [name for name in ALL if name != "T8"]),
    ({"resolutions": [*PRIMES, 17]}, []), ({"n_creeps": 4}, []), ({"place_gain": 0.0}, ["T8"]),
    ({"multimodal": with_a_third_node}, ["T8"])])
def test_a_claim_is_judged_only_if_what_was_run_for_it_is_the_paper_s(given, found):
    names, of_paper = judged(**given)
    assert names == found and of_paper == (len(found) > 1)


def test_the_explorer_offers_what_was_run_by_the_paper_s_figures():
    names = page("more-runs-computed")
    results, place, objects, joined = (names[name] for name in ("results", "place", "objects", "joined"))
    offered = figures.explorer_conditions(results, place, objects, joined, True)
    assert next(iter(offered)) == "Paper B, figure 5: place + object-vector cells" and len(offered) == 2 + 2 * 7
    assert offered["Paper B, figure 4A: place cells, N13"] is place["N13"]
    assert offered["Paper B, figure 4B: object-vector cells, all"] is results["OVC"]
    assert {*offered.values()} == {*results.values(), *place.values(), *objects.values(), joined}
    assert all(isinstance(each, Condition) and isinstance(each.world, WaterWorld) for each in offered.values())
