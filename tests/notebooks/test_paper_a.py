"""The page of paper A: the conditions of its experiment, its judgements, its tables and its figures."""

import ast
from dataclasses import replace
from pathlib import Path

import nbformat
import numpy as np
import pytest
from matplotlib import pyplot as plt
from matplotlib.colors import to_hex

from lib import paper_a
from lib.shared.report import CALIBRATED, LETTER
from neorl import Condition, NresMap, Result, WaterWorld, brownian, place_cells
from neorl.drawing.style import AGENT, GREEN, INK, RED
from neorl.evidence.reading import LAYERS, SINGLE, TO_THE_LETTER, Reading, conditions, judge

PAGE = nbformat.read(Path(__file__).parents[2] / "notebooks" / "paper_a.ipynb", 4)
CELLS = {cell.id: cell.source for cell in PAGE.cells if cell.cell_type == "code"}
WORLD = WaterWorld(n_creeps=8, win_reward=5.0)


def page(**parameters):
    """The names in the page's notebook after its experiment, whose results are the conditions themselves."""
    parameters_cell, imports, *_ = CELLS.values()
    imported = ast.parse(imports)
    imported.body.pop()  # notebook.begin sets the style of all figures
    names = {}
    exec(parameters_cell, names)
    names |= parameters
    exec(compile(imported, "imports", "exec"), names)
    names["sweep"] = iter
    for source in (CELLS["lists"], CELLS["e0010b66"]):
        exec(source, names)
    return names


def made_up(agent, rate, runs=12, steps=150_000, world=WORLD):
    """A result in which every run earns about `rate` per second, all of it from green creeps."""
    bins = steps // 10
    hits = np.zeros((runs, bins, 2), np.int16)
    hits[..., 0] = np.random.default_rng(0).random((runs, bins)) < 0.2 * rate
    return Result(Condition(agent, world, steps, runs), hits[..., 0].astype(np.float32), hits)


def results_of(layers=LAYERS, single=SINGLE, world=WORLD):
    """Results under one reading, with the keys of the page."""
    made = {("single", n): made_up(place_cells([n]), 0.2 + 0.001 * n, world=world) for n in single}
    made |= {("layer", n): made_up(place_cells([n]), 0.1 + 0.01 * n, world=world) for n in layers}
    chance = made_up(brownian(), 0.03, world=world)
    return made | {"layers": made_up(place_cells(layers), 0.7, world=world), "control": chance, "brownian": chance}


@pytest.mark.parametrize("runs, steps", [(30, 150_000), (3, 4_000), (12, 400_000)])
def test_the_experiment_is_that_of_the_paper_under_each_reading(runs, steps):
    results = page(runs=runs, steps=steps, seed=5)["results"]
    assert list(results) == [LETTER, CALIBRATED]
    for reading, found in zip((TO_THE_LETTER, Reading()), results.values()):
        expected = conditions(reading, steps, runs, 5, groups=("layers",))
        expected |= conditions(reading, steps, min(runs, 10), 5, groups=("single",)) | {
            ("brownian", 8): expected["brownian", 8]}
        expected["brownian"] = expected.pop(("brownian", 8))
        assert found == expected | {"control": replace(expected["single", 10], agent=brownian())}


def test_the_experiment_follows_the_parameters():
    found = page(layers="[5, 11]", resolutions=[20], n_creeps=3)["results"][LETTER]
    assert set(found) == {("layer", 5), ("layer", 11), "layers", ("single", 20), "control", "brownian"}
    assert found["layers"].agent == place_cells([5, 11], **TO_THE_LETTER.agents)
    assert {each.world.n_creeps for each in found.values()} == {3}


def test_the_variations_are_those_of_the_second_experiment():
    names = page(runs=20)
    exec(CELLS["variations"], names)
    varied, variants = names["varied"], names["variants"]
    assert set(varied) == {LETTER, CALIBRATED, *variants} and len(variants) >= 8
    for name, reading in variants.items():
        expected = conditions(reading, 150_000, 10, groups=("layers",))
        assert varied[name]["brownian"] == expected.pop(("brownian", 8))
        assert expected.items() <= varied[name].items()


def judged(layers=LAYERS, resolutions=SINGLE, n_creeps=8):
    """The claims that the page judges of made-up results, and those results."""
    results = results_of(layers, resolutions, replace(WORLD, n_creeps=n_creeps))
    names = page(layers=layers, resolutions=resolutions, n_creeps=n_creeps)
    squares = {name: np.full((12, 3), count) for count, name in enumerate(("chance", *layers, "all"), 20)}
    names |= {"readings": {CALIBRATED: Reading()}, "results": {CALIBRATED: results}, "explored": {CALIBRATED: squares}}
    exec(CELLS["judging"], names)
    return names["judged"][CALIBRATED], results


def test_the_paper_s_own_conditions_are_judged_as_its_reading_is():
    claims, results = judged()
    assert claims[:-1] == [*judge(results | {("brownian", 8): results["brownian"]}).values()]
    assert [claim.name for claim in claims] == [f"A{n}" for n in range(1, 10)] + ["T9"]
    assert claims[-1].here.value == pytest.approx(24 / 23)  # all over the best alone


@pytest.mark.parametrize("parameters, names", [
    ({"layers": (5, 11)}, ["A1", "A2", "A3", "A4", "A5"]),
    ({"layers": (3, 7, 11, 23)}, ["A1", "A2", "A3", "A4", "A5"]),
    ({"resolutions": (10, 50)}, ["A6", "A7", "A8", "T9"]),
    ({"resolutions": (10, 20, 30, 50, 70, 90)}, [f"A{n}" for n in range(1, 10)] + ["T9"]),
    ({"layers": (5,), "resolutions": (20,)}, []),
    ({"n_creeps": 5}, [])])
def test_a_claim_is_judged_only_where_its_own_conditions_are_run(parameters, names):
    assert [claim.name for claim in judged(**parameters)[0]] == names


def test_the_explorer_offers_both_readings_and_one_control():
    calibrated, letter = results_of(), results_of()
    offered = paper_a.explorer_conditions({LETTER: letter, CALIBRATED: calibrated})
    six, seven = "Paper A, figure 6", "Paper A, figure 7"
    assert next(iter(offered)) == f"{seven}: all three maps" and len(offered) == 2 * (1 + len(LAYERS) + len(SINGLE)) + 1
    assert offered[f"{seven}: all three maps"] is calibrated["layers"]
    assert offered[f"{seven}: N23 alone"] is calibrated["layer", 23]
    assert offered[f"{six}: N90, to the letter"] is letter["single", 90]
    assert offered[f"{six}: Brownian motion"] is calibrated["control"]


def test_the_explorer_names_no_figure_of_the_paper_for_other_maps_and_creeps():
    others = results_of((5, 11), (10, 20))
    names = [*paper_a.explorer_conditions({LETTER: others, CALIBRATED: others})]
    assert names[:5] == ["After paper A, figure 7: both maps", "After paper A, figure 7: N5 alone",
                         "After paper A, figure 7: N11 alone", "Paper A, figure 6: N10", "After paper A, figure 6: N20"]
    fewer = results_of(world=replace(WORLD, n_creeps=3))
    assert all(name.startswith("After ") for name in paper_a.explorer_conditions({LETTER: fewer, CALIBRATED: fewer}))


def test_squares_are_counted_once_ten_times_a_second():
    squares = paper_a.squares_entered(brownian(), WORLD, 200, 2)
    assert squares.shape == (2, 40) and (squares[:, 0] == 1).all()
    assert set(np.diff(squares).ravel()) == {0, 1}
    assert np.array_equal(squares, paper_a.squares_entered(brownian(), WORLD, 400, 2)[:, :40])
    assert paper_a.squares_entered(brownian(), WORLD, 3, 1).shape == (1, 1)  # of a short run


def test_rates_have_a_row_for_each_reading_and_an_interval():
    head, _, *rows = paper_a.rates({"letter": results_of(), "book": results_of()},
                                   {("layer", 7): "N7", "layers": "all three"}, (0.8, 1.0)).splitlines()
    assert head == "| Reading | N7 | all three |"
    assert [row.split(" | ")[0] for row in rows] == ["| letter", "| book"]
    value, low, *_ = rows[0].split(" | ")[2].replace("[", "").replace(",", "").split()
    assert float(low) < float(value) == pytest.approx(0.7, abs=0.05)


def test_choices_are_listed_with_what_the_text_makes_of_them():
    table = paper_a.choices({"to the letter": TO_THE_LETTER, "explores": replace(TO_THE_LETTER, exploration=0.1)})
    assert "| learning rate, α | open | 0.0122 | 0.0122 |" in table
    assert "| exploration, ε | pinned | 0 | 0.1 |" in table
    assert "| *all in all* | | within the text | breaks: policy |" in table
    assert "gain of place" not in table


def steady(rate, n_creeps=8):
    """A result in which every run earns `rate` per second throughout."""
    rewards = np.full((2, 500), 0.2 * rate, np.float32)
    hits = np.zeros((2, 500, 2), np.int16)
    return Result(Condition(place_cells([2]), WaterWorld(n_creeps=n_creeps), 5_000, 2), rewards, hits)


def test_maps_together_are_drawn_beside_each_alone_their_sum_and_the_level_of_the_thesis():
    results = {("layer", n): steady(rate) for n, rate in zip(LAYERS, (0.1, 0.2, 0.3))} | {"layers": steady(0.9)}
    paper_a.draw_together(results)
    axes = plt.gca()
    np.testing.assert_allclose([line.get_ydata()[-1] for line in axes.lines[:5]], [0.1, 0.2, 0.3, 0.9, 0.6], rtol=1e-5)
    assert axes.lines[-1].get_ydata()[0] == pytest.approx(3.5 * 0.2)
    assert {text.get_text() for text in axes.texts} == {"N3", "N7", "N23", "all three", "sum of the three",
                                                        "thesis: 3.5 × N7"}


@pytest.mark.parametrize("layers, n_creeps, names", [
    ((5, 11), 8, {"N5", "N11", "both", "sum of both"}),
    (LAYERS, 3, {"N3", "N7", "N23", "all three", "sum of the three"})])
def test_the_level_of_the_thesis_is_not_drawn_for_other_maps_and_creeps(layers, n_creeps, names):
    paper_a.draw_together({("layer", n): steady(0.1, n_creeps) for n in layers} | {"layers": steady(0.9, n_creeps)})
    assert {text.get_text() for text in plt.gca().texts} == names


def test_an_element_fills_its_cell_by_the_sign_and_the_size_of_its_valence():
    n2 = NresMap(2)
    values = np.zeros((4, 4))
    values[3] = [0.0, 0.0, 1.0, 0.0]
    paper_a.draw_elements(n2, [(0.7, 0.7), (0.2, 0.7)], [0.5, -1.0], values)
    axes = plt.gca()
    filled = {patch.get_xy(): (to_hex(patch.get_facecolor()), patch.get_alpha()) for patch in axes.patches
              if patch.get_alpha()}
    assert filled == {(0.5, 0.5): (GREEN, 0.15), (0.0, 0.5): (RED, 0.3)}
    assert [text.get_text() for text in axes.texts] == ["+0.5", "−1"]
    assert [text.get_ha() for text in axes.texts] == ["left", "left"]  # the upper left corner, which no arrow crosses
    (arrows,) = axes.collections
    assert len(arrows.U) == 1 and arrows.U[0] > 0


def test_a_valence_stands_in_a_corner_that_its_arrow_does_not_cross():
    values = np.zeros((4, 4))
    values[0], values[1] = [0, 1, 1, 0], [1, 0, 1, 0]  # to the south-east, to the north-east
    paper_a.draw_elements(NresMap(2), [(0.2, 0.2), (0.7, 0.2)], [1.0, 1.0], values)
    assert [(text.get_ha(), round(text.get_position()[0], 3)) for text in plt.gca().texts] == [
        ("right", 0.46), ("left", 0.54)]


def test_finer_maps_have_thinner_lines_and_none_is_left_out():
    paper_a.draw_maps([NresMap(n) for n in (1, 2, 3, 2)])
    lines = [(to_hex(patch.get_edgecolor()), patch.get_linewidth()) for patch in plt.gca().patches]
    assert lines == [(RED, 3.2)] + 4 * [(AGENT, 1.8)] + 13 * [(INK, 0.7)]
