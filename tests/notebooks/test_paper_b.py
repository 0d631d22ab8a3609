"""The page of paper B: the conditions of its cells, its figures and tables."""

import json
from pathlib import Path

import numpy as np
import pytest
from matplotlib import pyplot as plt

import neorl
from lib.paper_b import figures, trials
from lib.paper_b.trials import SECONDS_A_MOVE, best_values, learn
from neorl import WaterWorld, object_vector_cells
from neorl.core.modality import MODALITIES
from neorl.evidence.reading import PRIMES, TO_THE_LETTER, Reading, conditions
from neorl.evidence.statistics import Estimate

PAGE = json.loads((Path(__file__).parents[2] / "notebooks" / "paper_b.ipynb").read_text(encoding="utf-8"))
SOURCES = {cell["id"]: "".join(cell["source"]) for cell in PAGE["cells"]}
ANALYSES = ("per_reset =", "minutes =", "sooner =")  # the lines of a cell from which on it needs results


def run_cells(*names, runs=12, steps=1_000, resolutions=PRIMES):
    """What some cells of the page define, with conditions in place of results: {name: value}."""
    page = {"runs": runs, "steps": steps, "seed": 3, "resolutions": resolutions, "n_creeps": 3, "place_gain": 4.0}
    exec(SOURCES["cell-02"].partition("notebook.begin")[0], page)
    page["sweep"] = iter
    for name in names:
        source = SOURCES[name]
        for analysis in ANALYSES:
            source = source.partition(analysis)[0]
        exec(source, page)
    return page


@pytest.mark.parametrize("steps", [1_000, 600_000])
def test_the_experiment_has_the_conditions_by_which_readings_are_judged(steps):
    page = run_cells("computing", "minutes-computed", steps=steps)
    assert page["readings"] == {"to the letter": TO_THE_LETTER, "calibrated": Reading()}
    for name, reading in page["readings"].items():
        main = conditions(reading, steps, 12, 3, ["modal", "pace"])
        expected = conditions(reading, steps, 10, 3, ["modal", "resolutions"])
        expected |= {key: main[key] for key in (("place", "all"), ("objects", "all"), "both")}
        expected["brownian"] = expected.pop(("brownian", 3))
        assert page["results"][name] == expected
        assert page["paced"][name] == {"PC": main["pace", "place"], "OVC": main["pace", "objects"],
                                       "PC + OVC": main["pace", "both"]}


def test_other_claims_are_judged_by_the_conditions_of_readings_too():
    page = run_cells("computing", "revalued-computed", "more-computed", "variations")
    for name, reading in page["readings"].items():
        expected = conditions(reading, 1_000, 10, 3, ["revaluing", "layers"])
        assert page["turned"][name][""] == expected["revalued"]
        assert page["layers"][name] == {"all": expected["layers"], "brownian": expected["brownian", 8],
                                        **{n: expected["layer", n] for n in (3, 7, 23)}}
        assert list(page["added"][name]) == ["resolutions of place, paper A", "resolutions of place",
                                             "resolutions of object vectors", "a modality"]
    book = conditions(Reading(), 1_000, 10, 3, ["modal"])
    assert page["varied"]["calibrated, a quarter as long"]["both"] == book["both"]
    assert len(page["varied"]) == 9 and len({each["both"] for each in page["varied"].values()}) == 9


def test_agents_explore_after_the_change_and_not_before():
    page = run_cells("computing", "revalued-computed")
    for each in page["turned"].values():
        ((turn, plain),), ((same_turn, exploring),) = each[""].changes, each[", exploring"].changes
        assert turn == same_turn == 500 and exploring.policy == neorl.Policy(0.05, "random") != plain.policy
        assert each[", exploring"].agent == each[""].agent
    assert list(page["revalued"]) == ["to the letter", "to the letter, exploring", "calibrated",
                                      "calibrated, exploring"]


def test_object_vector_cells_join_place_cells_at_half_time():
    page = run_cells("computing", "joined-computed")
    for name, each in page["made"].items():
        (joined,) = page["joined"][name].values()
        assert joined.agent == each["place", "all"].agent and joined.runs == 10
        assert joined.changes == ((500, each["both"].agent),)


def test_points_are_taken_from_the_same_runs(cache_folder):
    page = run_cells("computing", "points-computed", runs=1, steps=40_000, resolutions=(2, 3))
    counted = page["boards"]["calibrated"]
    assert {name: each.steps for name, each in counted.items()} == {
        "PC": 10_000, "OVC": 10_000, "PC + OVC": 40_000, "Brownian motion": 10_000}
    both, paying = (neorl.simulate_once(**each.choices) for each in (page["made"]["calibrated"]["both"],
                                                                     counted["PC + OVC"]))
    np.testing.assert_array_equal(both.hits, paying.hits)
    assert paying.totals[0] > both.totals[0]


def test_other_maps_take_the_place_of_the_papers():
    each = run_cells("computing", resolutions=(2, 5))["made"]["calibrated"]
    assert {key[1] for key in each if key[0] == "place"} == {2, 5, "all"}
    assert {node.resolutions for node in each["both"].agent.nodes} == {(2, 5)}


def made_up(rate, runs=2, red=0.0, bins=3_000):
    """A result in which every run takes about `rate` green and `red` red creeps per second."""
    luck = np.random.default_rng(0).random((runs, bins, 2))
    hits = (luck < 0.2 * np.array([rate, red])).astype(np.int16)
    rewards = (hits[..., 0] - hits[..., 1]).astype(np.float32)
    return neorl.Result(neorl.Condition(neorl.place_cells([2]), WaterWorld(), 10 * bins, runs), rewards, hits)


def test_the_figures_of_the_paper_have_their_agents_in_order():
    results = {("place", "all"): "p", ("objects", "all"): "o", ("objects", 2): 2, ("objects", 5): 5, "both": "b"}
    assert list(figures.of_figure_4(results, "objects").items()) == [("N2", 2), ("N5", 5), ("all", "o")]
    assert figures.of_figure_5(results) == {"PC": "p", "OVC": "o", "PC + OVC": "b"}


def test_the_explorer_offers_the_figures_and_what_changes():
    keys = [(modality, n) for modality in ("place", "objects") for n in (*PRIMES, "all")]
    calibrated, letter = ({key: (reading, key) for key in (*keys, "both")} for reading in ("c", "l"))
    offered = figures.explorer_conditions({"to the letter": letter, "calibrated": calibrated}, "Paper B",
                                          {"a desire that moves": "moving"})
    assert next(iter(offered)) == "Paper B, figure 5: place + object-vector cells" and len(offered) == 1 + 2 * 7 + 3 + 1
    assert offered["Paper B, figure 4A: place cells, N13"] == ("c", ("place", 13))
    assert offered["Paper B, figure 4B: object-vector cells, all"] == ("c", ("objects", "all"))
    assert offered["Paper B, figure 5, to the letter: object-vector cells"] == ("l", ("objects", "all"))
    assert offered["Paper B: a desire that moves"] == "moving"


def test_every_modality_has_a_row():
    rows = figures.modalities_table().splitlines()[2:]
    assert len(rows) == len(MODALITIES)
    assert rows[0] == "| place cell | allocentric | x × y (cartesian) | 2-D |" and rows[-1].endswith("| 1-D |")


def test_values_stand_with_their_ratio_and_its_interval():
    values = {"PC": np.array([0.5, 1.0]), "OVC": np.array([0.1, 0.4])}
    (row,) = figures.values_table({"calibrated": values}).splitlines()[2:]
    assert row == "| calibrated | 0.75 [0.50, 1.00] | 0.25 [0.10, 0.40] | 0.30 [0.20, 0.40] |"


def test_sizes_stand_with_their_cost():
    assert figures.sizes_table({"self": (1_500, 0.25)}).splitlines()[2:] == ["| self | 1,500 | 0.25 |"]


def test_red_creeps_a_minute_add_up_to_those_taken():
    result = made_up(0.3, red=0.5)
    minutes, curves = figures.red_a_minute({"a": result})
    assert curves["a"].shape == (2, 100) and minutes[[0, -1]] == pytest.approx([0.05, 9.95])
    np.testing.assert_allclose(curves["a"].mean(axis=1) * 10, result.hits[..., 1].sum(axis=1))


def test_green_creeps_and_roaming_are_given_before_the_change_and_finally():
    class Revalued:
        def hit_rate(self, *part):
            return np.array([[{(0.3, 0.5): 0.2, (0.8, 1): 0.05}[part], 9.0]] * 2)

    roamed = {"one": np.array([[0.2, 0.4], [0.0, 0.1]])}
    rows = figures.change_table({"one": Revalued(), "exploring": Revalued()}, roamed).splitlines()[2:]
    one, exploring = ([cell.strip().split(" ")[0] for cell in row.strip("|").split("|")] for row in rows)
    assert one == ["one", "12.00", "3.00", "0.30", "0.05"] and exploring == ["exploring", "12.00", "3.00", "", ""]


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


def test_agents_stand_beside_the_numbers_that_the_thesis_has():
    found = {"calibrated": {"PC": Estimate(100, 90, 110), "OVC": Estimate(50, 40, 60),
                            "PC + OVC": Estimate(20, 10, 30)}}
    figures.draw_agents({"PC": 160, "PC + OVC": 15}, found, "minutes")
    axes = plt.gca()
    assert [label.get_text() for label in axes.get_yticklabels()] == ["place cells", "both"]
    assert list(axes.lines[0].get_xdata()) == [100, 20] and axes.get_xlabel() == "minutes"
    assert [text.get_text() for text in axes.texts] == ["thesis 160", "thesis 15"]


def test_state_and_goal_change_places_between_the_readings():
    figures.draw_states()
    for axes, at_centre, start in zip(plt.gcf().axes, ("state", "goal"), ((0, 0), figures.OBJECT)):
        named = {text.get_text(): text.xyann for text in axes.texts}
        arrow = named.pop("")
        assert {name: place[0] for name, place in named.items()} == {
            at_centre: 0, ({"state", "goal"} - {at_centre}).pop(): figures.OBJECT[0]}
        assert arrow == start


@pytest.fixture(scope="module")
def learned():
    """Runs of agents with two small maps, whose state is the self or the object's cell."""
    return learn({state: object_vector_cells([2, 5], object_state=state) for state in ("self", "object")},
                 WaterWorld(), 4_000, 2)


def test_the_values_for_objects_are_drawn_map_by_map(learned):
    figures.draw_object_values(learned)
    assert [axes.get_title() for axes in plt.gcf().axes] == ["self, N5", "object, N5"]
    for axes in plt.gcf().axes:
        assert len(axes.patches) == 26 and axes.get_xlim()[0] < -1 and len(axes.collections[0].U) <= 25


def test_the_best_values_of_each_map_are_means_over_runs(learned):
    figures.draw_best_values(learned)
    axes = plt.gca()
    of_self = np.mean([best_values(run) for run in learned["self"]], axis=0)
    assert any(np.allclose(line.get_ydata(), of_self) for line in axes.lines if len(line.get_ydata()) == 2)
    assert {"self", "object"} <= {text.get_text() for text in axes.texts}


def test_every_modality_has_a_board_with_the_tank():
    world = WaterWorld()
    figures.draw_modalities(world, world.reset(0))
    assert [axes.get_title() for axes in plt.gcf().axes] == [modality.name for modality in MODALITIES]
    assert all(len(axes.patches) >= 4 for axes in plt.gcf().axes)


def test_the_turn_is_marked_at_half_time():
    figures.draw_revaluing({"one": made_up(0.1, red=1.0), "other": made_up(0.1)})
    *curves, turn = plt.gca().lines
    assert curves[0].get_ydata()[0] > curves[1].get_ydata()[0] == 0.0
    assert turn.get_xdata() == pytest.approx([5.0, 5.0])


def test_moves_follow_one_another():
    moved = {"experienced": np.arange(24.0).reshape(2, 3, 4), "ignorant": np.zeros((2, 3, 4))}
    figures.draw_distances(moved, np.array([1.0, 2.0, 3.0, 4.0]))
    experienced, _ = plt.gca().lines
    assert list(experienced.get_xdata()) == [s + SECONDS_A_MOVE * move for move in range(3) for s in (1, 2, 3, 4)]
    np.testing.assert_array_equal(experienced.get_ydata(), np.arange(12) + 6.0)


def test_stays_are_drawn_over_the_widths_of_fields_the_finest_first():
    stays = np.tile([1.0 / n for n in PRIMES], (3, 1))
    figures.draw_time_scale(PRIMES, {"calibrated": stays})
    axes = plt.gca()
    line = axes.lines[1]
    np.testing.assert_allclose(line.get_xdata(), [1 / n for n in PRIMES[::-1]])
    np.testing.assert_allclose(line.get_ydata(), line.get_xdata())
    assert axes.get_xscale() == axes.get_yscale() == "log"
    assert [label.get_text() for label in axes.get_xticklabels()] == ["1/13", "", "1/7", "1/5", "1/3", "1/2"]
