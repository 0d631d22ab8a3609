"""The page of paper B: the conditions of its cells, its figures and tables."""

from dataclasses import replace

import numpy as np
import pytest
from page_cells import planned, source

import neorl
from companion.paper_b import figures, trials
from companion.shared import opening
from companion.shared.report import CALIBRATED, CLAIMS_OF, LETTER
from neorl import WaterWorld
from companion.thesis.reading import PRIMES, TO_THE_LETTER, Reading, conditions
from neorl.statistics import Estimate
from companion.thesis.verdict import Claim

ANALYSES = ("per_reset =", "minutes =", "sooner =")  # the lines of a cell from which on it needs results


def run_cells(*names, runs=12, steps=1_000, resolutions=PRIMES):
    """What some cells of the page define, with conditions in place of results: {name: value}."""
    return planned("paper_b", *names, until=ANALYSES, runs=runs, steps=steps, seed=3, resolutions=resolutions)


@pytest.mark.parametrize("steps", [1_000, 600_000])
def test_the_experiment_has_the_conditions_by_which_readings_are_judged(steps):
    page = run_cells("computing", "minutes-computed", steps=steps)
    assert page["readings"] == {"to the letter": TO_THE_LETTER, "calibrated": Reading()}
    for name, reading in page["readings"].items():
        main = conditions(reading, steps, 12, 3, ["modal", "pace"])
        expected = conditions(reading, steps, 10, 3, ["modal", "resolutions"])
        expected |= {key: main[key] for key in (("place", "all"), ("objects", "all"), "both")}
        assert page["results"][name] == expected
        paced = page["paced"][name]
        assert (paced["PC"], paced["PC + OVC"]) == (main["pace", "place"], main["pace", "both"])


def test_other_claims_are_judged_by_the_conditions_of_readings_too():
    page = run_cells("computing", "ran", "revalued-computed", "more-computed", "variations")
    for name, reading in page["readings"].items():
        expected = conditions(reading, 1_000, 10, 3, ["revaluing", "layers"])
        turned = page["turned"][name]
        assert (turned[""], turned[", from the start"]) == (expected["revalued"], expected["wanting"])
        assert page["layers"][name].items() <= expected.items() and len(page["layers"][name]) == 5
    book = conditions(Reading(), 1_000, 10, 3, ["modal"])
    assert page["varied"]["calibrated, a quarter as long"]["both"] == book["both"]
    assert len(page["varied"]) == 10 and len({each["both"] for each in page["varied"].values()}) == 10


def test_agents_explore_after_the_change_and_not_before():
    page = run_cells("computing", "revalued-computed")
    for each in page["turned"].values():
        ((turn, plain),), ((same_turn, exploring),) = each[""].changes, each[", exploring"].changes
        assert turn == same_turn == 500 and exploring.policy == neorl.Policy(0.05, "random") != plain.policy
        assert each[", exploring"].agent == each[""].agent
    assert list(page["revalued"]) == [f"{reading}{group}" for reading in ("to the letter", "calibrated")
                                      for group in ("", ", exploring", ", from the start")]


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
    both, paying = (neorl.simulate(**each.choices, cache=True)
                    for each in (page["made"]["calibrated"]["both"], counted["PC + OVC"]))
    np.testing.assert_array_equal(both.hits, paying.hits)
    assert paying.totals[0] > both.totals[0]


def test_other_maps_take_the_place_of_the_papers():
    each = run_cells("computing", resolutions=(2, 5))["made"]["calibrated"]
    assert {key[1] for key in each if key[0] == "place"} == {2, 5, "all"}
    assert {node.resolutions for node in each["both"].agent.nodes} == {(2, 5)}


ALL = [*CLAIMS_OF["paper_b"]]


def judged(cache_folder, **given):
    """What the page defines with made-up results, the claims that it judges, and whether it saves a record."""
    def sweep(conditions):
        return (neorl.Result(each, np.zeros((each.runs, bins := -(-each.steps // 10)), np.float32),
                             np.zeros((each.runs, bins, 2), np.int16)) for each in conditions)

    names = planned("paper_b", "computing", "ran", "judging", "minutes-computed", "points-computed",
                    "revalued-computed", "moved-computed", "joined-computed", "more-computed", "stays-computed",
                    "costs-computed", until=ANALYSES, runs=2, steps=1_000, sweep=sweep, **given)
    return names, *judged_of(names, cache_folder)


def judged_of(names, cache_folder):
    exec(source("paper_b", "judging-rest"), names)
    found = {reading: [claim.name for claim in claims] for reading, claims in names["judged"].items()}
    return found, (cache_folder / "claims" / "paper_b.json").exists()


def other_agent(made):
    """The same result, or measurement, of another agent."""
    condition = replace(made.condition, agent=neorl.brownian())
    return replace(made, condition=condition) if isinstance(made, neorl.Result) else made._replace(condition=condition)


def test_a_claim_is_judged_only_if_what_was_run_for_it_is_the_paper_s(cache_folder):
    names, found, saved = judged(cache_folder)
    assert found == {LETTER: ALL, CALIBRATED: ALL} and saved
    (cache_folder / "claims" / "paper_b.json").unlink()
    for claim, what, key in [
            ("B4", "paced", "PC"), ("B5", "boards", "PC + OVC"), ("B7", "joined", "joined"), ("T1", "turned", ""),
            ("T1", "moved", None), ("T2", "costs", None), ("T6", "layers", ("layer", 7)), ("T8", "stays", None)]:
        of_reading = names[what][CALIBRATED]
        changed = other_agent(of_reading) if key is None else of_reading | {key: other_agent(of_reading[key])}
        first = {reading: [each for each in claims if each.name in ("B1", "B2", "B3", "B6")]
                 for reading, claims in names["judged"].items()}
        found, saved = judged_of(names | {"judged": first, what: names[what] | {CALIBRATED: changed}}, cache_folder)
        assert found[CALIBRATED] == [name for name in ALL if name != claim] and not saved, claim


def with_a_third_node(*arguments, **options):
    both = neorl.multimodal(*arguments, **options)
    return replace(both, nodes=[*both.nodes, neorl.Node("HD", neorl.modality.HEAD_DIRECTION_CELL, [8])])


@pytest.mark.parametrize("given, found", [
    ({"place_gain": 0.0}, {LETTER: ALL, "calibrated, PC × 0": []}),
    ({"multimodal": with_a_third_node}, {LETTER: [], CALIBRATED: []}),
    ({"n_creeps": 4, "resolutions": (2, 3)}, {LETTER: [], CALIBRATED: []})])
def test_other_agents_and_boards_are_neither_judged_nor_called_calibrated_nor_saved(given, found, cache_folder):
    assert judged(cache_folder, **given)[1:] == (found, False)


def test_a_reading_without_claims_has_no_line_in_the_box():
    claim = Claim("B1", Estimate(1.0, 0.9, 1.1), {}, 10, "partly")
    box = opening.found({LETTER: [claim], "calibrated, PC × 0": []})
    assert "To the letter: " in box and "× 0" not in box


def made_up(rate, runs=2, red=0.0, bins=3_000):
    """A result in which every run takes about `rate` green and `red` red creeps per second."""
    luck = np.random.default_rng(0).random((runs, bins, 2))
    hits = (luck < 0.2 * np.array([rate, red])).astype(np.int16)
    rewards = (hits[..., 0] - hits[..., 1]).astype(np.float32)
    return neorl.Result(neorl.Condition(neorl.place_cells([2]), WaterWorld(), 10 * bins, runs), rewards, hits)


def test_red_creeps_a_minute_add_up_to_those_taken():
    result = made_up(0.3, red=0.5)
    minutes, curves = figures.red_a_minute({"a": result})
    assert curves["a"].shape == (2, 100) and minutes[[0, -1]] == pytest.approx([0.05, 9.95])
    np.testing.assert_allclose(curves["a"].mean(axis=1) * 10, result.hits[..., 1].sum(axis=1))


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
