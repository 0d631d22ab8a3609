"""The page of paper B: the conditions of its cells, and what it judges of them."""

from dataclasses import replace

import numpy as np
import pytest
from page_cells import (LAST, assert_captions_and_prose_speak_of_what_is_drawn,
                        assert_captions_end_with_numbers_of_their_figures, executed)

import neorl
from companion.paper_b import figures, judgement
from companion.page.judging import by_condition
from companion.page.wording import in_words
from companion.page.report import CLAIMS_OF
from companion.thesis.reading import READINGS, conditions
from neorl.statistics import Estimate

ALL = [*CLAIMS_OF["paper_b"]]


def judged(reading):
    """The page under a reading."""
    return executed("paper_b", until=LAST[reading], reading=reading, runs=11)


@pytest.fixture(scope="module")
def of_others():
    """The page with other maps and another board."""
    return executed("paper_b", resolutions="[2, 4]", n_creeps=5)


@pytest.mark.parametrize("reading", READINGS)
def test_the_page_runs_and_judges_what_the_paper_ran_under_a_reading(reading):
    page = judged(reading)
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
    page = judged("letter")
    assert {name: each.steps for name, each in page.boards.items()} == {
        "PC": 250, "OVC": 250, "PC + OVC": 1_000, "Brownian motion": 250}
    np.testing.assert_array_equal(page.results["PC + OVC"].hits[:10], page.boards["PC + OVC"].hits)


def test_only_claims_about_what_was_run_are_judged(of_others):
    without_places = executed("paper_b", until="judging", place_gain=0.0)
    for page, names in ((of_others, []), (without_places, ["T8"])):
        assert [claim.name for claim in page.judged] == names and not page.of_paper


def test_captions_and_prose_speak_of_what_is_drawn(of_others):
    assert_captions_and_prose_speak_of_what_is_drawn("paper_b", of_others.parts_drawn)
    for page in (of_others, judged("calibrated")):  # two runs, and eleven
        assert_captions_end_with_numbers_of_their_figures(page, {"time-scale"} & page.numbers_shown.keys())


def test_a_claim_is_not_judged_if_what_was_run_for_it_is_not_the_paper_s():
    page = judged("calibrated")
    measured = {"paced": [*page.paced.values()], "paying": page.boards["PC + OVC"], "joined": page.joined,
                "stays": page.stays}
    changed = {"B5": {"paying": other_agent(page.boards["PC + OVC"])}, "B7": {"joined": other_agent(page.joined)},
               "T8": {"stays": page.stays._replace(condition=other_agent(page.joined).condition)}}
    for lost, changes in changed.items():
        claims = judgement.judge(page.ran, page.thesis, **measured | changes)
        assert [claim.name for claim in claims] == [name for name in ALL if name != lost]


def other_agent(result):
    return replace(result, condition=replace(result.condition, agent=neorl.brownian()))


def test_the_variations_are_other_values_of_what_the_text_leaves_open(of_others):
    varied = of_others.varied
    assert varied["a quarter as long"]["PC + OVC"].agent == of_others.agents["PC + OVC"]
    assert len(varied) == 6 == len({each["PC + OVC"].condition for each in varied.values()})


def test_the_explorer_offers_what_was_run_by_the_paper_s_figures():
    page = judged("calibrated")
    offered = figures.explorer_conditions(page.results, page.place, page.objects, page.joined, True)
    assert next(iter(offered)) == "Paper B, figure 5: place + object-vector cells" and len(offered) == 2 + 2 * 7
    assert offered["Paper B, figure 4A: place cells, N13"] is page.place["N13"]
    assert offered["Paper B, figure 4B: object-vector cells, all"] is page.results["OVC"]


def test_a_level_that_is_never_reached_has_no_time():
    def learning(rate):  # reward per second of each bin, of both runs
        condition = neorl.Condition(neorl.brownian(), neorl.WaterWorld(), 50 * 400, 2)
        return neorl.Result(condition, np.tile(np.float32(rate), (2, 1)), np.zeros((2, len(rate), 2), np.int16))
    table = figures.paces({"PC": learning(np.linspace(0, -1, 400)), "PC + OVC": learning(np.linspace(0, 1, 400))}, True)
    both, place = table.splitlines()[2:]
    assert place == "| place | > 160 | never within the run |" and both.endswith("| 15 | 5.41 |")
    assert in_words(Estimate(150.0, 140.5, np.inf)) == "150 [140, never]"
    assert in_words(Estimate(-np.inf, -np.inf, 3.0)) == "never within the run"
    assert in_words(Estimate(-7.0, -np.inf, 3.0)) == "−7.00 [never, 3.00]"
