"""The page of chapter 5: its experiments, the claims that it judges, and whether the conclusions stand."""

from dataclasses import replace

import re
import numpy as np
import pytest
from page_cells import LAST, assert_captions_end_with_numbers_of_their_figures, executed

import neorl
from companion.chapter_5 import conclusions, figures, trials
from companion.page import counts, report
from companion.page.report import CLAIMS_OF
from companion.thesis.reading import PRIMES, READINGS, conditions
from companion.thesis.statements import AGENTS, DEMONSTRATIONS, STATEMENTS
from neorl import WaterWorld


@pytest.fixture(scope="module", params=READINGS)
def page(request):
    return executed("chapter_5", until=LAST[request.param], reading=request.param)


def test_agents_have_the_coarsest_maps_of_paper_b_up_to_all(page):
    paper_b = conditions(page.thesis, 1_000, 2, groups=["modal"])
    for name, key in (("place cells", ("place", "all")), ("object-vector cells", ("objects", "all")), ("both", "both")):
        *fewer, full = (each.condition for each in page.growing[name])
        assert full == paper_b[key] and len(fewer) == len(page.numbers) - 1
        for n, each in zip(page.numbers, fewer):
            assert {node.resolutions for node in each.agent.nodes} == {PRIMES[:n]}
            assert replace(each, agent=full.agent) == full


def test_indifferent_agents_have_the_same_desires_but_no_valence_until_these_begin(page):
    throughout, later = page.throughout.condition, page.later.condition
    assert page.begun == 0.5 and later.changes == ((500, throughout.agent),)
    assert throughout == conditions(page.thesis, 1_000, 2, groups=["modal"])["both"]
    assert [desire.source for desire in later.agent.desires] == [desire.source for desire in throughout.agent.desires]
    assert not any(desire.valence for desire in later.agent.desires) and later.agent.nodes == throughout.agent.nodes


def test_agents_explore_after_the_change_and_not_before(page):
    ((turn, plain),), ((same_turn, exploring),) = page.ran["revalued"].changes, page.exploring.changes
    assert turn == same_turn == 500 and exploring.policy == neorl.Policy(0.05, "random") != plain.policy
    assert page.exploring.agent == page.ran["revalued"].agent
    (first, drifting), (later, frozen) = page.drifted.changes
    assert (first, later) == (500, 650) and drifting.policy.exploration == 1 and frozen.learning.learning_rate == 0


def other_agent(made):
    """The same result, or measurement, of another agent."""
    condition = replace(made.condition, agent=neorl.brownian())
    return replace(made, condition=condition) if isinstance(made, neorl.Result) else made._replace(condition=condition)


@pytest.mark.parametrize("change, without", [
    (None, ""), ("moved", "T1"), ("costs", "T2"), ("frozen", "T1 T6"), (("layer", 7), "T6")])
def test_a_claim_is_judged_only_if_what_was_run_for_it_is_the_papers(change, without, page):
    measured = {"ran": page.ran, "moved": page.moved, "costs": page.costs}
    if change in page.ran:
        measured["ran"] = page.ran | {change: other_agent(page.ran[change])}
    elif change == "moved":
        measured["moved"] = page.moved | {"both": other_agent(page.moved["both"])}
    elif change:
        measured[change] = other_agent(measured[change])
    found = [claim.name for claim in conclusions.judge(reading=page.thesis, **measured)]
    assert found == [name for name in CLAIMS_OF["chapter_5"] if name not in without.split()]
    assert change or found == [claim.name for claim in page.judged]


def test_every_claim_belongs_to_one_group():
    assert sorted(name for names in conclusions.GROUPS.values() for name in names) == sorted(STATEMENTS)
    assert {name for title in counts.KINDS.values() for name in conclusions.GROUPS.get(title, ())} == (
        {*STATEMENTS} - {*AGENTS})
    for names, group in zip(conclusions.CARRYING.values(), conclusions.GROUPS.values()):
        assert {*names} <= {*group}


def test_the_answer_has_the_claims_of_both_conclusions():
    answer = conclusions.answer().data
    names = conclusions.CARRYING["Superposition"]
    count, _ = counts.reproduced(report.record()["claims"], names)
    assert f"Of the 4 claims that carry the conclusion on superposition, {count} hold; of the 4 claims that " in answer
    assert re.findall(r"#claim-\w+\" [^>]*>(\w+)</a>", answer) == [
        *conclusions.CARRYING["Superposition"], *conclusions.CARRYING["Learning apart from behaviour"], "T2", "T6",
        *conclusions.REQUIREMENTS]


def test_what_is_said_of_all_claims_counts_them_as_every_place_does():
    words = counts.sentence(report.record(), STATEMENTS)
    assert f'<p class="sentence">{words}</p>' in conclusions.all_claims().data
    shown = {*sum(conclusions.CARRYING.values(), ()), *CLAIMS_OF["chapter_5"], *conclusions.REQUIREMENTS}
    count, judged = counts.reproduced(report.record()["claims"], shown & {*AGENTS})
    assert f"of claims about agents: {count} of {judged} calibrated" in conclusions.answer().data


def test_claims_that_fail_are_those_of_one_reading_and_those_without_any():
    letter, calibrated = map(conclusions.failed, ("letter", "calibrated"))
    assert ">A7</a>" in letter and ">A7</a>" not in calibrated
    assert ">C5</a>" in letter and ">C5</a>" in calibrated
    assert all(f">{name}</a>" not in letter for name in DEMONSTRATIONS)


def made_up(rate, runs=2, red=0.0, bins=3_000):
    """A result in which every run takes about `rate` green and `red` red creeps per second."""
    luck = np.random.default_rng(0).random((runs, bins, 2))
    hits = (luck < 0.2 * np.array([rate, red])).astype(np.int16)
    rewards = (hits[..., 0] - hits[..., 1]).astype(np.float32)
    return neorl.Result(neorl.Condition(neorl.place_cells([2]), WaterWorld(), 10 * bins, runs), rewards, hits)


def test_discs_caught_a_minute_add_up_to_those_caught_around_half_time():
    result = made_up(0.3, red=0.5)  # of ten minutes
    minutes, curves = figures.caught_around({"a": result})
    assert curves["a"].shape == (2, 50) and minutes[[0, -1]] == pytest.approx([-0.475, 1.975])
    np.testing.assert_allclose(curves["a"].mean(axis=1) * 2.5, result.hits[:, 1_350:2_100].sum(axis=(1, 2)))
    assert figures.caught_around({"a": made_up(0.3, bins=40)})[1]["a"].shape == (2, 8)


def test_agents_roam_as_far_as_their_paths_spread():
    tank = neorl.WaterWorld()
    changed = neorl.simulate(neorl.brownian(), tank, steps=400, runs=2, seed=1,
                             changes=[(200, neorl.place_cells([3]))], progress=False)
    before, end = trials.roaming(changed, seconds=1)
    run = neorl.Run(changed.agent, tank, seed=1, run=1)
    run.advance(200 - tank.fps)
    path = []
    for _ in range(tank.fps):
        run.advance(1)
        path.append(run.world_state.scene.position / tank.width)
    assert before.shape == end.shape == (2, 2) and end.all()
    np.testing.assert_allclose(before[1], np.std(path, axis=0))


@pytest.mark.parametrize("reading", ["calibrated", "letter"])
def test_pasts_stand_beside_each_other_for_both_desires(reading):
    header, _, *rows, _, note = conclusions.pasts(reading).splitlines()
    assert header == ("| While learning | Points a second, green wanted and red feared | Caught a minute, both colours "
                      "wanted |")
    assert [row.split(" | ")[0] for row in rows] == [
        "| Nothing wanted before", "| Green wanted before", "| Green wanted and red feared before"]
    numbers = report.record()[report.PART_OF[reading]]["T11"]["numbers"]
    value, *_ = numbers["caught a minute, both colours wanted, green wanted before"][0]
    assert f"{value:.0f} [" in rows[1] or f"{value:.2f}" in rows[1]


def test_captions_end_with_numbers_of_their_figures():
    assert_captions_end_with_numbers_of_their_figures(
        executed("chapter_5", until=LAST["calibrated"], reading="calibrated"))
