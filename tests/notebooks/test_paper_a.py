"""The page of paper A: the conditions of its experiment, its judgements, its tables and its figures."""

from dataclasses import replace

import numpy as np
import pytest
from matplotlib import pyplot as plt
from page_cells import (LAST, assert_captions_and_prose_speak_of_what_is_drawn,
                        assert_captions_end_with_numbers_of_their_figures, executed, few_resamples)

from companion import paper_a
from companion.page.judging import by_condition
from neorl import Condition, Result, WaterWorld, brownian, place_cells
from companion.thesis.reading import LAYERS, READINGS, SINGLE, TO_THE_LETTER, Reading, conditions, judge

WORLD = WaterWorld(n_creeps=8, win_reward=5.0, fps=Reading().paper_a_fps)


SHORT = ("8 * runs, 150_000)", "8 * runs, 1_500)"),  # Brownian motion, which is as long as the paper's at any size


def other_maps():
    return executed("paper_a", SHORT, reading="letter", layers="[5, 11]", resolutions=(10, 20, 30, 50, 70, 90))


def other_board():
    return executed("paper_a", SHORT, n_creeps=3)


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
def test_the_page_runs_and_judges_what_the_paper_ran_under_a_reading(reading):
    page = executed("paper_a", SHORT, LAST[reading], reading=reading, runs=11)
    expected = conditions(READINGS[reading], 1_000, 11, groups=("layers",))
    expected |= conditions(READINGS[reading], 1_000, 10, groups=("single",)) | {
        ("brownian", 8): replace(expected["brownian", 8], runs=88, steps=1_500)}
    ran = by_condition(page.ran, expected)
    assert {key: each.condition for key, each in ran.items()} == expected
    *claims, explored = page.judged
    with few_resamples():
        assert [replace(claim, full_length=True) for claim in claims] == [*judge(ran).values()]
    assert not any(claim.full_length for claim in page.judged)
    assert [claim.name for claim in page.judged] == [*(f"A{n}" for n in range(1, 10)), "A11", "T9"]


def test_other_maps_are_run_and_only_claims_about_the_paper_s_own_are_judged():
    page = other_maps()
    assert [*page.several] == ["N5", "N11", "all maps"] and [*page.single][:2] == ["N10", "N20"]
    assert page.several["all maps"].agent == place_cells([5, 11], **TO_THE_LETTER.agents)
    assert [claim.name for claim in page.judged] == ["A1", "A2", "A3", "A4", "A5", "A11"]


def test_the_page_speaks_of_the_thesis_s_level_where_it_is_drawn():
    _, papers, _ = results_of()
    _, others, _ = results_of(layers=(5, 11))
    _, among_three, _ = results_of(world=replace(WORLD, n_creeps=3))
    for several, of_paper in ((papers, True), (others, False), (among_three, False)):
        paper_a.draw_together(several)
        dashed = [line for line in plt.gca().lines if line.get_linestyle() == "--"]
        assert bool(dashed) == ("dashed" in paper_a.about_levels(several)) == of_paper
        plt.close()


def test_nothing_is_judged_on_another_board_and_variations_are_of_what_was_run():
    page = other_board()
    assert page.judged == [] and {each.world.n_creeps for each in page.ran} == {3}
    assert set(page.varied) == set(page.variants) and len(page.variants) == 3  # of few runs
    for name, reading in page.variants.items():
        expected = conditions(reading, 1_000, 2, groups=("layers",))
        agents = {each.agent for key, each in expected.items() if key != ("brownian", 8)}
        assert {each.agent for each in page.varied[name].values()} == agents


@pytest.mark.parametrize("page", [other_maps, other_board])
def test_captions_and_prose_speak_of_what_is_drawn(page):
    assert_captions_and_prose_speak_of_what_is_drawn("paper_a", page().parts_drawn)
    assert_captions_end_with_numbers_of_their_figures(page())


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
