"""The page of paper A: runs of both experiments, and their numbers beside the thesis's."""

from dataclasses import replace

import numpy as np
import pytest

from neorl import Result, WaterWorld, brownian, place_cells
from lib.paper_a.experiments import (CONTROL, explore, explorer_conditions, layers, live, neighbours,
                                                singles, squares_entered)
from lib.paper_a.findings import (REWARD, STATES, THESIS, beside_thesis, choices, in_short, in_words,
                                             judge_exploration, judge_second_experiment)
from lib.shared.side_by_side import judge_each
from neorl.evidence.priors import TO_THE_LETTER
from neorl.evidence.reading import GROUPS, LAYERS, SINGLE, Reading

WORLD = WaterWorld(n_creeps=8, win_reward=5.0)


def made_up(agent, rate, runs=12, steps=150_000):
    """A result in which every run earns about `rate` per second, all of it from green creeps."""
    bins = steps // 10
    hits = np.zeros((runs, bins, 2), np.int16)
    hits[..., 0] = np.random.default_rng(0).random((runs, bins)) < 0.2 * rate
    return Result(agent, WORLD, steps, runs, 0, hits[..., 0].astype(np.float32), hits)


@pytest.fixture(scope="module")
def results():
    rates = {("single", n): rate for n, rate in zip(SINGLE, (0.2, 0.3, 0.4, 0.25, 0.1))}
    rates |= {("layer", 3): 0.1, ("layer", 7): 0.2, ("layer", 23): 0.3}
    made = {key: made_up(place_cells([key[1]]), rate) for key, rate in rates.items()}
    return made | {"layers": made_up(place_cells(LAYERS), 0.7), ("brownian", 8): made_up(brownian(), 0.03)}


def test_both_experiments_are_run_under_each_reading(cache_folder):
    readings = {"to the letter": TO_THE_LETTER, "book": Reading()}
    found = live(readings, steps=300, runs=11, groups=("layers",))
    assert list(found) == list(readings)
    assert all(set(each) == set(GROUPS["layers"]) for each in found.values())
    assert found["book"]["layers"].runs == 11 and found["book"]["layers"].steps == 300
    assert found["to the letter"]["layers"].agent == place_cells(LAYERS, **TO_THE_LETTER.agents)


def test_single_maps_have_as_many_runs_as_a_verdict_needs_and_a_control(cache_folder, monkeypatch):
    monkeypatch.setattr("lib.shared.side_by_side.sweep", lambda conditions: conditions)
    (found,) = live({"book": Reading()}, steps=150_000, runs=30).values()
    assert set(found) == {*GROUPS["layers"], *GROUPS["single"], CONTROL}
    assert (found["single", 90].runs, found["layer", 7].runs) == (10, 30)
    assert found[CONTROL] == replace(found["single", 90], agent=brownian())


def test_agents_with_one_map_are_named_by_it_in_either_experiment(results):
    assert list(singles(results)) == ["N10", "N30", "N50", "N70", "N90"]
    assert list(layers(results)) == ["N3", "N7", "N23"]
    assert singles(results)["N50"] is results["single", 50] and layers(results)["N7"] is results["layer", 7]


def test_neighbours_differ_in_one_choice():
    reading = Reading(learning_rate=0.1, weighting="cells", bootstrap=True, memory=5.0)
    made = neighbours(reading)
    assert "maps by N" in made and "maps by N²" not in made
    assert "no bootstrapping" in made and "bootstrapping" not in made
    assert (made["α 0.005"].learning_rate, made["α 1"].learning_rate) == pytest.approx((0.005, 1.0))
    assert made["half the board"] == replace(reading, tiled_fraction=0.5)
    assert not {"maps by N²", "no memory"} - set(neighbours(replace(reading, weighting="equal")))


def test_the_explorer_offers_both_readings_and_one_control(results):
    calibrated, letter = results | {CONTROL: "control"}, dict.fromkeys(results, "letter")
    offered = explorer_conditions({"to the letter": letter, "calibrated": calibrated})
    six, seven, late = "Paper A, figure 6", "Paper A, figure 7", "to the letter"
    assert next(iter(offered)) == f"{seven}: all three maps" and len(offered) == 2 * (1 + len(LAYERS) + len(SINGLE)) + 1
    assert offered[f"{seven}: all three maps"] is results["layers"]
    assert offered[f"{seven}: N23 alone"] is results["layer", 23] and offered[f"{six}: N90"] is results["single", 90]
    assert {offered[f"{each}, {late}"] for each in (f"{seven}: all three maps", f"{seven}: N23 alone", f"{six}: N90")
            } == {"letter"}
    assert offered[f"{six}: Brownian motion"] == "control"


def test_numbers_stand_beside_those_of_the_thesis(results):
    (found,) = beside_thesis({"book": results}).values()
    assert set(found) == set(THESIS)
    assert found[REWARD].value == pytest.approx(3.5, rel=0.05) and found[REWARD].low < 3.5 < found[REWARD].high
    assert found[STATES].value == pytest.approx(587 / 49)


def test_what_was_found_is_put_in_words(results):
    both = {"to the letter": results, "calibrated": results}
    first, words = in_words(both).splitlines()
    assert first.startswith("- **To the letter.** By ") and words.startswith("- **Calibrated.** By ")
    assert "the order of single maps is N50 (0.40), N30 (0.30), N70 (0.25), N10 (0.20), N90 (0.10);" in words
    assert "Brownian motion earns 0.03 and resets the board 0.00 times in 150,000 steps" in words
    assert "together finally earn 0.70 per second, 3." in words and "(thesis: 3.5)" in words
    assert "alone they earn 0.10, 0.20, 0.30, in total 0.60." in words
    short = in_short(both)
    assert "together finally earn 0.70 [0.69, 0.71] per second: 3." in short
    assert "(thesis: 3.5), and more than the sum of what the three earn alone (difference 0.10 [" in short
    assert "N50 (0.40) earns most" in short and "clears the board 0.00 times in 150,000 steps" in short


def test_the_second_experiment_is_judged_by_itself(results):
    (judged,) = judge_second_experiment({"book": results}).values()
    assert judged == [claim for claim in judge_each({"book": results})["book"] if claim.name in ("A6", "A7", "A8")]
    assert len(judged) == 3


def test_squares_are_counted_once_ten_times_a_second():
    squares = squares_entered(brownian(), WORLD, 200, 2)
    assert squares.shape == (2, 40) and (squares[:, 0] == 1).all()
    assert set(np.diff(squares).ravel()) == {0, 1}
    assert np.array_equal(squares, squares_entered(brownian(), WORLD, 400, 2)[:, :40])
    assert squares_entered(brownian(), WORLD, 3, 1).shape == (1, 1)  # of a short run


def test_exploration_is_judged_by_all_three_maps(results):
    explored = explore(results, 20, 2)
    assert list(explored) == ["Brownian motion", "N3", "N7", "N23", "all three"]
    entered = {name: np.full((12, 3), count) for name, count in zip(explored, (50, 20, 30, 40, 80))}
    claim = judge_exploration(entered)
    assert (claim.verdict, claim.here.value, claim.runs) == ("reproduced", 2, 12)


def test_choices_are_listed_with_what_the_text_makes_of_them():
    table = choices({"to the letter": TO_THE_LETTER, "explores": replace(TO_THE_LETTER, exploration=0.1)})
    assert "| learning rate, α | open | 0.0122 | 0.0122 |" in table
    assert "| exploration, ε | pinned | 0 | 0.1 |" in table
    assert "| *all in all* | | within the text | breaks: policy |" in table
    assert "gain of place" not in table
