"""The page of paper A: the conditions of its experiment, its judgements, its tables and its figures."""

from dataclasses import replace

import numpy as np
import pytest
from page_cells import planned, source

from companion import paper_a
from companion.shared.judging import by_condition, papers
from neorl import Condition, Result, WaterWorld, brownian, place_cells
from companion.thesis.reading import LAYERS, READINGS, SINGLE, TO_THE_LETTER, Reading, conditions, judge

WORLD = WaterWorld(n_creeps=8, win_reward=5.0, fps=Reading().paper_a_fps)


def page(*cells, **parameters):
    """The names in the page's notebook after its experiment, whose results are the conditions themselves."""
    return planned("paper_a", "e0010b66", "ran", *cells, **parameters)


def made_up(agent, rate, runs=12, steps=150_000, world=WORLD):
    """A result in which every run earns about `rate` per second, all of it from green creeps."""
    bins = steps // 10
    hits = np.zeros((runs, bins, 2), np.int16)
    hits[..., 0] = np.random.default_rng(0).random((runs, bins)) < 0.2 * rate
    return Result(Condition(agent, world, steps, runs), hits[..., 0].astype(np.float32), hits)


def results_of(layers=LAYERS, resolutions=SINGLE, world=WORLD):
    """Results of both experiments, and of Brownian motion in as many steps as the paper's."""
    single = {f"N{n}": made_up(place_cells([n]), 0.2 + 0.001 * n, world=world) for n in resolutions}
    several = {f"N{n}": made_up(place_cells([n]), 0.1 + 0.01 * n, world=world) for n in layers}
    control = {"Brownian motion": made_up(brownian(), 0.03, world=world)}
    return single | control, several | {"all maps": made_up(place_cells(layers), 0.7, world=world)}, control


@pytest.mark.parametrize("reading", READINGS)
@pytest.mark.parametrize("runs, steps", [(30, 150_000), (3, 4_000), (12, 400_000)])
def test_the_experiment_is_that_of_the_paper_under_a_reading(reading, runs, steps):
    names = page(reading=reading, runs=runs, steps=steps, seed=5)
    expected = conditions(READINGS[reading], steps, runs, 5, groups=("layers",))
    expected |= conditions(READINGS[reading], steps, min(runs, 10), 5, groups=("single",)) | {
        ("brownian", 8): expected["brownian", 8]}
    assert by_condition(names["ran"], expected) == expected
    assert names["single"]["Brownian motion"] == replace(expected["single", 10], agent=brownian())


def test_the_experiment_follows_the_parameters():
    names = page(reading="letter", layers="[5, 11]", resolutions=[20], n_creeps=3)
    assert [*names["single"]] == ["N20", "Brownian motion"] and [*names["several"]] == ["N5", "N11", "all maps"]
    assert names["several"]["all maps"].agent == place_cells([5, 11], **TO_THE_LETTER.agents)
    assert {each.world.n_creeps for each in names["ran"]} == {3}


def test_the_variations_are_those_of_the_second_experiment():
    names = page("variations", runs=20)
    assert set(names["varied"]) == set(names["variants"]) and len(names["variants"]) >= 8
    for name, reading in names["variants"].items():
        expected = conditions(reading, 150_000, 10, groups=("layers",))
        assert {*names["varied"][name].values()} == {*expected.values()} - {expected["brownian", 8]}


def judged(layers=LAYERS, resolutions=SINGLE, n_creeps=8):
    """The claims that the page judges of made-up results, and those results."""
    single, several, control = results_of(layers, resolutions, replace(WORLD, n_creeps=n_creeps))
    squares = {name: np.full((12, 3), count) for count, name in enumerate(control | several, 20)}
    names = page(layers=layers, resolutions=resolutions, n_creeps=n_creeps)
    names |= {"ran": [*single.values(), *several.values(), *control.values()], "explored": squares}
    exec(source("paper_a", "judging"), names)
    return names["judged"], names["ran"]


OF_SINGLE = ["A1", "A2", "A3", "A4", "A5", "A11"]
ALL = [*(f"A{n}" for n in range(1, 10)), "A11", "T9"]


def test_the_paper_s_own_conditions_are_judged_as_its_reading_is():
    claims, ran = judged()
    assert claims[:-1] == [*judge(by_condition(ran, papers(Reading(), "single", "layers"))).values()]
    assert [claim.name for claim in claims] == ALL
    assert claims[-1].here.value == pytest.approx(24 / 23)  # all over the best alone


@pytest.mark.parametrize("parameters, names", [
    ({"layers": (5, 11)}, OF_SINGLE),
    ({"layers": (3, 7, 11, 23)}, OF_SINGLE),
    ({"resolutions": (10, 50)}, ["A6", "A7", "A8", "T9"]),
    ({"resolutions": (10, 20, 30, 50, 70, 90)}, ALL),
    ({"layers": (5,), "resolutions": (20,)}, []),
    ({"n_creeps": 5}, [])])
def test_a_claim_is_judged_only_where_its_own_conditions_are_run(parameters, names):
    assert [claim.name for claim in judged(**parameters)[0]] == names


def test_the_explorer_offers_what_was_run_by_the_paper_s_figures():
    single, several, control = results_of()
    offered = paper_a.explorer_conditions(single, several)
    six, seven = "Paper A, figure 6", "Paper A, figure 7"
    assert next(iter(offered)) == f"{seven}: all three maps" and len(offered) == 1 + len(LAYERS) + len(SINGLE) + 1
    assert offered[f"{seven}: all three maps"] is several["all maps"]
    assert offered[f"{seven}: N23 alone"] is several["N23"]
    assert offered[f"{six}: N90"] is single["N90"]
    assert offered[f"{six}: Brownian motion"] is single["Brownian motion"]


def test_squares_are_counted_once_ten_times_a_second():
    squares = paper_a.squares_entered(brownian(), WaterWorld(), 200, 2)
    assert squares.shape == (2, 40) and (squares[:, 0] == 1).all()
    assert set(np.diff(squares).ravel()) == {0, 1}
    assert np.array_equal(squares, paper_a.squares_entered(brownian(), WaterWorld(), 400, 2)[:, :40])
    assert paper_a.squares_entered(brownian(), WaterWorld(), 3, 1).shape == (1, 1)  # of a short run
