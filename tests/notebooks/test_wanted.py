"""The page "What it wanted while it learned": yoked partners, what agents know, and the recorded lessons."""

import csv
import re
from dataclasses import replace

import numpy as np
import pytest
from companion.page import recorded
from companion.thesis.reading import READINGS
from companion.wanted import findings, lessons, measures, ten_hours
from companion.wanted.yoked import Partner
from page_cells import executed

from neorl import Desire, Place, Run, WaterWorld, multimodal

TANK = WaterWorld()


@pytest.mark.parametrize("reading", READINGS)
@pytest.mark.parametrize("wanted", lessons.WANTED)
def test_a_partner_that_wants_something_else_learns_the_same_to_the_last_bit(reading, wanted):
    agent = lessons.agent_of(reading)
    actor = Run(lessons.desiring(agent, wanted), lessons.WORLD, 3, 1)
    other = lessons.WANTED[lessons.WANTED.index(wanted) - 1]
    partner = Partner(lessons.desiring(agent, other), lessons.WORLD, 3, 1)
    for steps in (1, 3_999):
        partner.follow(actor.record(steps).actions)
    assert all(np.array_equal(actor.q(m), partner.q(m)) for m in range(len(agent.maps)))
    assert np.array_equal(actor.world_state.scene.things, partner.world_state.scene.things)
    assert partner.step == actor.step == 4_000


def test_a_partner_with_another_rule_or_another_tank_learns_something_else():
    actor = Run(multimodal([5]), TANK, 3)
    actions = actor.record(2_000).actions
    for partner in (Partner(lessons.varied(multimodal([5]), credit="last"), TANK, 3),
                    Partner(multimodal([5]), TANK, 4)):
        partner.follow(actions)
        assert not np.array_equal(actor.q(0), partner.q(0))


def test_a_partner_follows_across_the_end_of_an_episode():
    tank, agent = WaterWorld(n_creeps=1), multimodal([5])
    actor, partner = Run(agent, tank, 1), Partner(agent, tank, 1)
    path = actor.record(20_000)
    partner.follow(path.actions)
    assert len(path.ends) and np.array_equal(actor.q(0), partner.q(0)) and np.array_equal(actor.q(1), partner.q(1))


def test_values_point_to_their_goals_after_random_motion_and_at_chance_before():
    agent = lessons.desiring(lessons.agent_of("letter"), "nothing")
    run = Run(agent, lessons.WORLD)
    assert all(0.4 < measures.pointing(run, n) < 0.5 for n in range(2))
    run.advance(30_000)
    assert all(measures.pointing(run, n) > 0.9 for n in range(2))


def test_the_agent_can_enter_all_cells_but_those_in_which_its_corner_never_is():
    assert measures.within_reach(multimodal([5]).maps[0], TANK).all()
    assert measures.within_reach(multimodal([13]).maps[0], TANK).sum() == 12**2


def test_a_stream_that_stands_still_covers_one_cell():
    agent, path = multimodal([13]), Run(multimodal([13]), TANK).record(500)
    still = replace(path, positions=0 * path.positions, actions=0 * path.actions, hits=0 * path.hits)
    found = measures.stream_of(still, agent, TANK)
    assert (found.covered, found.entropy, found.pairs, found.paid) == pytest.approx((1 / 144, 0, 1 / 576, 0))
    assert measures.stream_of(path, agent, TANK).covered > 1 / 144


def test_an_agent_is_measured_without_learning_and_leaves_the_run_as_it_was():
    run = Run(multimodal([5]), TANK)
    run.advance(5_000)
    before = run.q(0).copy()
    first, again = (measures.knowledge(run, 0, minutes=1) for _ in range(2))
    assert first == again and np.array_equal(before, run.q(0)) and run.step == 5_000
    assert not measures.told(run, 1.0, 1.0).learns


def test_a_short_row_of_every_lesson_can_be_made():
    rows = list(lessons.rows_of_run("letter", 0, minutes=2, short=1, wanted=("nothing", "green"),
                                    measured_minutes=0.1))
    assert [row.lesson for row in rows] == ["own", *lessons.LESSONS, *lessons.LESSONS]
    by = {(row.wanted, row.lesson): row.knowledge for row in rows}
    assert by["nothing", "own"] == by["nothing", "wide"] != by["green", "wide"]  # as nothing is remembered
    assert all((row.stream is None) != (row.lesson == "own" and row.wanted != lessons.UNTRAINED) for row in rows)


def test_the_recorded_lessons_are_whole_and_of_fresh_seeds():
    rows = lessons.read()
    expected = len(READINGS) * lessons.RUNS * (1 + len(lessons.WANTED) * len(lessons.LESSONS))
    assert len(rows) == expected == len({row[:4] for row in rows})
    with open(lessons.SHIPPED, newline="") as file:
        assert {line["seed"] for line in csv.DictReader(file)} == {str(lessons.SEED)}
    assert findings.runs() == lessons.RUNS


def test_a_recorded_row_comes_out_again():
    (row,) = [row for row in lessons.read() if row[:4] == ("letter", lessons.UNTRAINED, "own", 2)]
    again = measures.knowledge(Run(lessons.agent_of("letter"), lessons.WORLD, lessons.SEED, 2), 2)
    assert [f"{each:.4g}" for each in again] == [f"{each:.4g}" for each in row.knowledge]


@pytest.mark.parametrize("reading", READINGS)
def test_a_prediction_shows_what_its_whole_interval_shows(reading):
    for lesson, words in findings.PREDICTIONS.items():
        for wanted in findings.NARROW:
            share, shows = findings.shown(reading, wanted, lesson)
            assert shows == (words["low"] if share.high <= 0.5 else words["high"] if share.low >= 0.8 else "open")
    assert findings.shown(reading, "nothing", "first").share.value == 1


def test_predictions_name_lessons_and_each_says_what_either_side_shows():
    assert set(findings.PREDICTIONS) == set(lessons.LESSONS) - {"own"}
    for words in findings.PREDICTIONS.values():
        assert {words["low"], words["high"]} == {"stream", "overwriting"} and words["expected"] in (
            words["low"], words["high"]) and words["beside"] in lessons.LESSONS


def test_the_answer_is_in_words_and_every_table_has_a_row_for_each_desire():
    words = re.search('<p class="sentence">(.*?)</p>', findings.answer().data)[1]
    assert "{" not in words and "nan" not in words and recorded.SHOWN["wanted"] == ("T10", "T11")
    for made in (findings.knowledge("calibrated"), findings.coverage("letter")):
        assert all(f"| {findings.WAS[wanted].capitalize()} |" in made for wanted in lessons.WANTED)
    said = findings.predictions("letter"), findings.every_lesson("letter"), *map(findings.in_chapter_5, READINGS)
    assert not any("nan" in words for words in said)


def test_a_restless_agent_fears_where_it_was_at_the_beginning_of_each_second():
    agent = multimodal([5])
    restless, changed = ten_hours.Restless(ten_hours.fearing(agent, 2.0), TANK, 3), Run(agent, TANK, 3)
    hits = 0
    for _ in range(8):
        place = Place(*changed.world_state.scene.position / TANK.size)
        changed.change(replace(agent, desires=[*agent.desires, *(Desire(place, node.name, -2.0)
                                                                 for node in agent.nodes)]))
        hits = hits + changed.record(TANK.fps, every=TANK.fps).hits[0]
    assert np.array_equal(restless.met(8 * TANK.fps), hits)
    assert np.array_equal(restless.world_state.scene.position, changed.world_state.scene.position)


def test_today_s_agent_takes_its_ten_hours_as_any_run_does():
    row = ten_hours.row_of("calibrated", "kept", "today", 5, 1, pieces=2, piece=1, measured=0.1)
    run = Run(lessons.desiring(lessons.agent_of("calibrated"), "green, fearing red"), lessons.WORLD, 5, 1)
    assert np.array_equal(row.green, [run.record(3_000, every=3_000).hits[0, 0] for _ in range(2)])
    assert row.known[-1] == measures.caught(run, 1, minutes=0.1)


@pytest.mark.parametrize("way", ["learning ends after 100 minutes", "6 seconds a minute without desire", "trail −1"])
def test_every_way_turns_its_desire_and_differs_from_today_s_agent(way):
    today, other = (ten_hours.row_of("letter", "turned", each, 5, 0, pieces=4, piece=2, measured=0.5)
                    for each in ("today", way))
    assert np.array_equal(today.known[:2], other.known[:2]) == ("6 seconds" not in way)
    assert not np.array_equal(today.red[2:], other.red[2:])


@pytest.mark.parametrize("path, plan", [(ten_hours.SHIPPED, "report"), (ten_hours.SEARCHED, "search")])
def test_the_recorded_hours_are_whole(path, plan):
    wanted, seed, runs = ten_hours.PLANS[plan]
    expected = {(*each, way, k) for *each, ways in wanted for way in ways for k in range(runs)}
    rows = ten_hours.read(path)
    assert {row[:4] for row in rows} == expected and len(rows) == len(expected)
    with open(path, newline="") as file:
        assert {line["seed"] for line in csv.DictReader(file)} == {str(seed)}
    assert all(len(series) == ten_hours.PIECES for row in rows for series in row[4:])


def test_the_first_piece_of_a_recorded_run_comes_out_again():
    (row,) = [row for row in ten_hours.read() if row[:4] == ("letter", "kept", "today", 1)]
    again = ten_hours.row_of("letter", "kept", "today", ten_hours.SEED, 1, pieces=1)
    assert [f"{each[0]:.4g}" for each in again[4:]] == [f"{each[0]:.4g}" for each in row[4:]]


def test_a_way_keeps_what_is_known_if_no_piece_is_below_and_it_earns_as_much_as_today():
    for reading in READINGS:
        for task in ten_hours.TASKS:
            ways = findings.hours_of(reading, task)
            for way, each in ways.items():
                assert each.is_kept == (each.lowest >= 170 and each.paid.value >= ways["today"].paid.value)
                assert f"| {way} |" in findings.hours(reading)
        assert "nan" not in findings.mended(reading) + findings.turned(reading)


def test_the_page_runs_and_its_partners_have_their_actors_streams():
    page = executed("wanted")
    for wanted in lessons.WANTED:
        actor, partner = page.made[0][wanted, "own"], page.made[0][wanted, "wide"]
        assert np.array_equal(actor.world_state.scene.position, partner.world_state.scene.position)
    assert all(page.same) and set(page.caught) == {(wanted, lesson) for wanted in lessons.WANTED
                                                   for lesson in ("own", "wide")}
