"""The page of paper B: the conditions of its cells, and what it judges of them."""

from dataclasses import replace

import numpy as np
import pytest
from page_cells import executed

import neorl
from companion.paper_b import figures, judgement
from companion.page.judging import by_condition
from companion.page.report import CLAIMS_OF
from companion.thesis.reading import READINGS, conditions

ALL = [*CLAIMS_OF["paper_b"]]


@pytest.mark.parametrize("reading", READINGS)
def test_the_page_runs_and_judges_what_the_paper_ran_under_a_reading(reading):
    page = executed("paper_b", reading=reading, runs=11)
    main = conditions(READINGS[reading], 1_000, 11, groups=["modal"])
    expected = conditions(READINGS[reading], 1_000, 10, groups=["modal", "resolutions"])
    expected |= {key: main[key] for key in (("place", "all"), ("objects", "all"), "both")}
    expected["brownian", 3] = replace(expected["brownian", 3], runs=80)
    assert {key: each.condition for key, each in by_condition(page.ran, expected).items()} == expected
    assert {name: (each.agent, each.steps, each.runs) for name, each in page.paced.items()} == {
        name: (page.agents[name], 16_000, 5) for name in ("PC", "OVC", "PC + OVC")}
    joined = page.joined.condition
    assert (joined.agent, joined.runs) == (expected["place", "all"].agent, 10)
    assert joined.changes == ((500, expected["both"].agent),)
    assert [claim.name for claim in page.judged] == ALL and page.of_paper


def test_points_are_taken_from_the_same_runs():
    page = executed("paper_b", reading="letter", runs=11)
    assert {name: each.steps for name, each in page.boards.items()} == {
        "PC": 250, "OVC": 250, "PC + OVC": 1_000, "Brownian motion": 250}
    np.testing.assert_array_equal(page.results["PC + OVC"].hits[:10], page.boards["PC + OVC"].hits)


@pytest.mark.parametrize("parameters, judged", [
    ({"resolutions": (2, 3), "n_creeps": 4}, []), ({"place_gain": 0.0}, ["T8"])])
def test_only_claims_about_what_was_run_are_judged(parameters, judged):
    page = executed("paper_b", **parameters)
    assert [claim.name for claim in page.judged] == judged and not page.of_paper


def test_a_claim_is_not_judged_if_what_was_run_for_it_is_not_the_paper_s():
    page = executed("paper_b", reading="calibrated", runs=11)
    measured = {"paced": [*page.paced.values()], "paying": page.boards["PC + OVC"], "joined": page.joined,
                "stays": page.stays}
    changed = {"B5": {"paying": other_agent(page.boards["PC + OVC"])}, "B7": {"joined": other_agent(page.joined)},
               "T8": {"stays": page.stays._replace(condition=other_agent(page.joined).condition)}}
    for lost, changes in changed.items():
        claims = judgement.judge(page.ran, page.thesis, **measured | changes)
        assert [claim.name for claim in claims] == [name for name in ALL if name != lost]


def other_agent(result):
    return replace(result, condition=replace(result.condition, agent=neorl.brownian()))


def test_the_variations_are_other_values_of_what_the_text_leaves_open():
    page = executed("paper_b", reading="calibrated", runs=11)
    assert page.varied["a quarter as long"]["PC + OVC"].agent == page.agents["PC + OVC"]
    assert len(page.varied) == 10 == len({each["PC + OVC"].condition for each in page.varied.values()})


def test_the_explorer_offers_what_was_run_by_the_paper_s_figures():
    page = executed("paper_b", reading="calibrated", runs=11)
    offered = figures.explorer_conditions(page.results, page.place, page.objects, page.joined, True)
    assert next(iter(offered)) == "Paper B, figure 5: place + object-vector cells" and len(offered) == 2 + 2 * 7
    assert offered["Paper B, figure 4A: place cells, N13"] is page.place["N13"]
    assert offered["Paper B, figure 4B: object-vector cells, all"] is page.results["OVC"]
