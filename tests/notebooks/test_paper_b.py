"""The page of paper B: its conditions, numbers and sentences."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

import neorl
from lib.paper_b import experiments, findings, trials
from lib.paper_b.trials import Costs, Watched
from lib.shared import side_by_side
from neorl.core.modality import MODALITIES
from neorl.evidence.reading import Reading
from neorl.evidence.statistics import Estimate

READING = Reading(object_state="object", place_gain=1.0, weighting="resolution")


def made_up(rate, runs=12, red=0.0, bins=3_000, win_reward=0.0):
    """A result in which every run takes about `rate` green and `red` red creeps per second."""
    luck = np.random.default_rng(0).random((runs, bins, 2))
    hits = (luck < 0.2 * np.array([rate, red])).astype(np.int16)
    rewards = (hits[..., 0] - hits[..., 1]).astype(np.float32)
    world = neorl.WaterWorld(win_reward=win_reward)
    return neorl.Result(neorl.place_cells([2]), world, 10 * bins, runs, 0, rewards, hits)


@pytest.fixture(scope="module")
def lived():
    """Results of every key, as if both modalities together earned 0.6 per second and place cells 0.3."""
    made = experiments.all_conditions(READING, 1_000, 12)
    rates = {key: 0.3 for key in made} | {"both": 0.6, ("objects", "all"): 0.1, ("pace", "both"): 0.6,
                                          ("brownian", 3): 0.05}
    return {"calibrated": {key: made_up(rate, win_reward=float(key[0] == "points")) for key, rate in rates.items()}}


def test_main_conditions_have_all_runs_and_others_fewer():
    made = experiments.all_conditions(READING, 1_000, 60, seed=3)
    assert {made[key].runs for key in experiments.AGENTS.values()} == {60}
    assert made["place", 3].runs == made["revalued"].runs == made["joined"].runs == 10
    assert {each.seed for each in made.values()} == {3}


def test_object_vector_cells_join_place_cells_at_half_time():
    made = experiments.all_conditions(READING, 1_000, 2)
    assert made["joined"].agent == made["place", "all"].agent
    assert made["joined"].changes == ((500, made["both"].agent),)


def test_points_are_taken_from_the_same_lives(cache_folder):
    made = experiments.all_conditions(READING, 40_000, 1)
    chosen = {key: made[key] for key in ("both", ("points", "PC + OVC"))}
    results = side_by_side.live({"calibrated": chosen})["calibrated"]
    np.testing.assert_array_equal(results["both"].hits, results["points", "PC + OVC"].hits)
    found = findings.points_a_reset({"calibrated": results})["calibrated"]["PC + OVC"]
    boards = results["points", "PC + OVC"].totals[0] - results["both"].totals[0]
    assert boards > 0 and found.value == results["both"].totals[0] / boards


def test_all_conditions_are_lived_under_each_reading(monkeypatch):
    monkeypatch.setattr(side_by_side, "sweep", lambda conditions: conditions)
    lived = experiments.live({"one": READING, "other": Reading()}, 1_000, 20, seed=3)
    assert lived == {"one": experiments.all_conditions(READING, 1_000, 20, 3),
                     "other": experiments.all_conditions(Reading(), 1_000, 20, 3)}


def test_the_state_before_is_compared_in_the_agents_of_figure_5(monkeypatch):
    monkeypatch.setattr(side_by_side, "sweep", lambda conditions: conditions)
    reading = replace(READING, object_reach=0.096)
    (made,) = experiments.live_with_objects_as_state(replace(reading, object_state="self"), 1_000, 2, seed=3).values()
    before = replace(reading, object_reach=0.0)
    assert made == experiments.conditions(before, 1_000, 2, 3, ["modal"]) and {*made} >= {*experiments.AGENTS.values()}


def test_neighbours_differ_in_one_choice():
    made = experiments.neighbours(READING, 1_000, 2)
    assert "gain of place, B: 2" in made and "gain of place, B: 3" not in made
    assert READING.object_state not in [name.split(": ")[1] for name in made if name.startswith("state")]
    of_self = made["state of object vectors: self"]["both"].agent
    assert [node.state for node in of_self.nodes] == ["object", "self"]


def test_the_figures_of_the_paper_have_their_agents_in_order(lived):
    results = lived["calibrated"]
    four, five = experiments.of_figure_4(results, "objects"), experiments.of_figure_5(results)
    assert list(four) == ["N2", "N3", "N5", "N7", "N11", "N13", "all"] and four["N5"] is results["objects", 5]
    assert list(five) == ["PC", "OVC", "PC + OVC"] and five["PC + OVC"] is results["both"]


def test_the_explorer_offers_the_figures_and_what_changes(lived):
    offered = experiments.explorer_conditions(lived | {"to the letter": dict.fromkeys(lived["calibrated"], "letter")},
                                              "moving")
    results = lived["calibrated"]
    assert next(iter(offered)) == "Paper B, figure 5: place + object-vector cells" and len(offered) == 1 + 2 * 7 + 3 + 3
    assert offered["Paper B, figure 4A: place cells, N13"] is results["place", 13]
    assert offered["Paper B, figure 4B: object-vector cells, all"] is results["objects", "all"]
    assert offered["Paper B, figure 5, to the letter: object-vector cells"] == "letter"
    assert offered["Paper B: a desire that moves"] == "moving"
    assert offered["Paper B: red revalued half-way"] is results["revalued"]
    assert offered["Paper B: object-vector cells join"] is results["joined"]


def watched(runs=12):
    """Trials in which experience halves distances, values of objects are a third, and maps cost the same as alone."""
    moved = {"experienced": np.full((runs, 6, 10), 0.2), "ignorant": np.full((runs, 6, 10), 0.4)}
    moved["experienced"][:, :2] = 0.3
    luck = np.random.default_rng(0).random
    costs = Costs([], 1 + 0.01 * luck(runs), 2 + 0.01 * luck((12, runs)), 13 + 0.01 * luck((12, runs)))
    stays = np.array([[6.0, 5.0, 4.0, 3.0, 2.0, 1.0]]) + 0.1 * luck((runs, 6))
    values = {"PC": np.full(runs, 0.6), "OVC": np.full(runs, 0.2)}
    return Watched(moved, np.arange(1.0, 11.0), stays, values, costs)


def test_all_claims_of_the_page_are_judged_in_their_order(lived):
    (judged,) = findings.judge_each(lived, {"calibrated": watched()}).values()
    assert [claim.name for claim in judged] == ["B1", "B2", "B3", "B4", "B5", "B6", "B7", "T1", "T2", "T6", "T8"]
    by = {claim.name: claim for claim in judged}
    assert (by["T2"].verdict, by["T8"].verdict) == ("reproduced", "reproduced")
    assert by["B7"].here.value == pytest.approx(0.0)
    backwards = watched()._replace(stays=watched().stays[:, ::-1])
    *_, t8 = findings.judge_each(lived, {"calibrated": backwards})["calibrated"]
    assert t8.verdict == "not reproduced"


def test_what_was_found_is_put_in_words_reading_by_reading(lived):
    both = {"to the letter": lived["calibrated"]} | lived
    letter, calibrated = findings.in_words(both).split("\n\n")
    level, minute = findings.levels(lived)["calibrated"], findings.minutes(lived)["calibrated"]
    assert letter.startswith(f"**To the letter**, place cells finally earn {level['PC']} per second (thesis: 0.29), ")
    assert calibrated.startswith("**Calibrated**, place cells finally earn ")
    assert f"and both together {level['PC + OVC']} (thesis: 0.55)" in calibrated
    assert f"after {minute['PC'].value:.0f} minutes (thesis: more than 160), {minute['OVC'].value:.0f}, and" in letter
    short = findings.in_short(both)
    assert calibrated.removeprefix("**Calibrated**, ") in short
    assert short.endswith(f"and both {level['PC + OVC']}. Brackets are 95 % intervals.")


def test_levels_are_those_of_the_last_fifth_and_minutes_those_of_longer_lives(lived):
    results = dict(lived["calibrated"])
    late = results["both"].rewards * (np.arange(3_000) >= 2_400)
    results["both"] = replace(results["both"], rewards=late.astype(np.float32))
    results["pace", "objects"] = replace(results["both"], runs=12)
    level, minute = findings.levels({"a": results})["a"], findings.minutes({"a": results})["a"]
    assert level["PC + OVC"].value == pytest.approx(0.6, rel=0.1) and level["OVC"].value == pytest.approx(0.1, rel=0.2)
    assert minute["OVC"].value > 8 > 5 > minute["PC + OVC"].value


def test_every_modality_has_a_row():
    rows = findings.modalities_table().splitlines()[2:]
    assert len(rows) == len(MODALITIES)
    assert rows[0] == "| place cell | allocentric | x × y (cartesian) | 2-D |" and rows[-1].endswith("| 1-D |")


def test_values_stand_with_their_ratio_and_its_interval():
    trials = watched(2)._replace(values={"PC": np.array([0.5, 1.0]), "OVC": np.array([0.1, 0.4])})
    (row,) = findings.values_table({"calibrated": trials}).splitlines()[2:]
    assert row == "| calibrated | 0.75 [0.50, 1.00] | 0.25 [0.10, 0.40] | 0.30 [0.20, 0.40] |"


def test_points_are_counted_for_each_agent_of_each_reading(lived):
    found = findings.points_a_reset({"one": lived["calibrated"], "other": lived["calibrated"]})
    assert list(found) == ["one", "other"]
    assert list(found["one"]) == ["PC", "OVC", "PC + OVC", "Brownian motion"]


@pytest.mark.parametrize("n, boards", [(1, [1]), (3, [1, 1, 1, 2, 2, 2, 3])])
def test_a_board_brings_twice_the_green_creeps_that_it_begins_with(n, boards):
    assert findings.expected_points(neorl.WaterWorld(n_creeps=n)) == pytest.approx(2 * np.mean(boards))


def test_intervals_that_hold_the_expected_points_are_counted():
    found = {"one": {"PC": Estimate(3.0, 2.0, 4.0), "OVC": Estimate(1.0, 0.5, 1.5)},
             "other": {"PC": Estimate(3.4, 3.4, 3.5), "OVC": Estimate(5.0, 4.0, 6.0)}}
    assert findings.points_in_words(found, 3.4) == (
        "A new board has 1.70 green creeps on average, which gives 3.40 points per reset. That lies within 2 of the 4 "
        "intervals.")
    assert findings.points_in_words({name: {"PC": each["PC"]} for name, each in found.items()}, 3.4).endswith(
        "That lies within all 2 intervals.")
    single = {"one": {"PC": Estimate(3.0, np.nan, np.nan)}}
    assert findings.points_in_words(single, 3.4).endswith("which gives 3.40 points per reset.")


def test_red_creeps_a_minute_add_up_to_those_taken():
    result = made_up(0.3, runs=2, red=0.5)
    curves, minutes = findings.red_a_minute({"a": result})
    assert curves["a"].shape == (2, 100) and minutes[[0, -1]] == pytest.approx([0.05, 9.95])
    np.testing.assert_allclose(curves["a"].mean(axis=1) * 10, result.hits[..., 1].sum(axis=1))


def test_red_creeps_are_reported_before_and_after_the_change_and_finally():
    curve = np.zeros((2, 100))
    curve[:, 49], curve[:, 50], curve[:, 80:] = 1.0, [2.0, 4.0], 5.0
    assert findings.red_in_words({"to the letter": curve, "calibrated": 2 * curve}) == (
        "- To the letter: 1.0 red creeps per minute in the hundredth of the run before the change, 3.0 in the one "
        "after it, and 5.0 in the last fifth.\n"
        "- Calibrated: 2.0 red creeps per minute in the hundredth of the run before the change, 6.0 in the one after "
        "it, and 10.0 in the last fifth.")


def test_green_creeps_are_reported_before_the_change_and_finally():
    def revalued(later):
        rates = {(0.3, 0.5): 0.2, (0.8, 1): later}
        return SimpleNamespace(hit_rate=lambda *part: np.array([[rates[part], 9.0]] * 2))

    found = findings.revaluing({"one": {"revalued": revalued(0.05), ("revalued", "exploring"): revalued(0.25)}})
    assert findings.green_in_words(found) == (
        "- One: 12.0 green creeps per minute in the fifth of the run before the change, and 3.0 in the last fifth.\n"
        "- One, exploring: 12.0 green creeps per minute in the fifth of the run before the change, and 15.0 in the "
        "last fifth.")


def test_agents_explore_after_the_change_and_not_before():
    made = experiments.all_conditions(READING, 1_000, 12)
    ((turn, exploring),) = made["revalued", "exploring"].changes
    ((same_turn, plain),) = made["revalued"].changes
    assert turn == same_turn and exploring == replace(plain, policy=experiments.EXPLORING) != plain
    assert made["revalued", "exploring"].agent == made["revalued"].agent


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
    assert before.shape == end.shape == (2,) and end.all()
    assert before[1] == pytest.approx(np.sqrt(np.mean(np.sum((path - np.mean(path, axis=0)) ** 2, axis=1))))
    assert findings.roaming_in_words({"calibrated": (np.array([0.2, 0.4]), np.array([0.0, 0.1]))}) == (
        "Calibrated, an agent's root mean square distance from its mean position is 0.30 board widths before the "
        "change and 0.05 at the end.")


def test_distances_are_reported_for_the_first_two_moves_and_the_later_ones():
    assert findings.distances_in_words({"to the letter": watched(), "calibrated": watched()}).startswith(
        "To the letter, it is 0.30 and 0.20 for experienced agents, 0.40 and 0.40 for untrained ones. Calibrated, it ")


def test_rewards_are_reported_for_the_twentieths_before_and_after_the_change():
    def rate(begin, end):
        return np.array([{(0.45, 0.5): 0.1, (0.5, 0.55): 0.3}[begin, end]] * 2)

    results = {"joined": SimpleNamespace(rate=rate)}
    assert findings.joining_in_words({"one": results, "other": results}) == (
        "0.10 and 0.30 per second (one) and 0.10 and 0.30 per second (other)")


def test_more_maps_are_compared_in_each_reading(lived, monkeypatch):
    monkeypatch.setattr(findings, "sooner_with_more", lambda more, fewer: (more, fewer))
    (found,) = findings.minutes_with_more_maps(lived).values()
    results = lived["calibrated"]
    assert found["a modality"][0] is results["both"] and len(found["resolutions of place"][1]) == 6
