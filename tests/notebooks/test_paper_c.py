"""The page of paper C: the experiment in its cells, its parameters, and where desires land."""

import ast
from dataclasses import replace
from pathlib import Path

import nbformat
import numpy as np
import pytest
from matplotlib import pyplot as plt

from lib import paper_c
from lib.shared.report import CALIBRATED, LETTER
from neorl import Result, Run, WaterWorld, brownian, network_b
from neorl.evidence.reading import TO_THE_LETTER, Reading, conditions, networks
from neorl.experiments.condition import Condition

CELLS = nbformat.read(Path(__file__).parents[2] / "notebooks" / "paper_c.ipynb", 4).cells
READINGS = {LETTER: TO_THE_LETTER, CALIBRATED: Reading()}
LIKE_THE_THESIS = {"A": 0.12, "B": 0.2, "C": 0.3, "D": 0.6}


def experiment(**parameters):
    """The names that the page's cells define down to its experiment, with an iterator of conditions for results."""
    names = {}
    for cell in [cell for cell in CELLS if cell.cell_type == "code"]:
        code = ast.parse(cell.source)
        code.body = [each for each in code.body if not ast.unparse(each).startswith("notebook.begin(")]
        exec(compile(code, "paper_c.ipynb", "exec"), names)
        if "parameters" in cell.metadata.tags:
            names |= parameters
        names["sweep"] = iter
        if "experiment" in cell.metadata.tags:
            return names


@pytest.mark.parametrize("steps", [4_000, 300_000, 600_000])
def test_the_page_runs_the_networks_of_each_reading(steps):
    found = experiment(runs=3, steps=steps, seed=2)
    for name, reading in READINGS.items():
        expected = conditions(reading, steps, 3, 2, groups=["networks"])
        assert found["results"][name] == {key[1] if key[0] == "network" else "Brownian": each
                                          for key, each in expected.items()}
    assert found["of_paper"]


def test_weights_and_creeps_and_maps_are_those_of_the_parameters():
    other = experiment(recursion=-0.5, n_creeps=5, resolutions="[7, 2]")
    assert not other["of_paper"]
    for name, reading in READINGS.items():
        agents = networks(replace(reading, recursion=-0.5, network_resolutions=(2, 7)))
        assert {key: each.agent for key, each in other["results"][name].items() if key != "Brownian"} == agents
        assert {each.world for each in other["results"][name].values()} == {WaterWorld(n_creeps=5)}


@pytest.mark.parametrize("parameter", [{"recursion": -0.5}, {"n_creeps": 4}, {"resolutions": [3, 7]}])
def test_claims_are_judged_only_if_what_the_paper_ran_is_what_was_run(parameter):
    assert not experiment(**parameter)["of_paper"]


def made_up(agent, rate, runs=12, bins=3_000):
    """A result in which every run earns about `rate` per second in its second half, and nothing before."""
    hits = np.zeros((runs, bins, 2), np.int16)
    hits[:, bins // 2 :, 0] = np.random.default_rng(0).random((runs, bins - bins // 2)) < 0.2 * rate
    return Result(Condition(agent, WaterWorld(), 10 * bins, runs), hits[..., 0].astype(np.float32), hits)


@pytest.fixture
def results():
    return {name: made_up(agent, LIKE_THE_THESIS[name]) for name, agent in networks(Reading()).items()}


def dashed():
    """The heights and names of the dashed lines in the last figure."""
    axes = plt.gca()
    heights = [line.get_ydata()[0] for line in axes.lines if not isinstance(line.get_linestyle(), str)
               or line.get_linestyle() == "--"]
    return heights, [text.get_text() for text in axes.texts if text.get_text().startswith("thesis")]


def test_recursion_has_to_lift_a_network_that_earns_something(results):
    paper_c.draw_rates(results, of_paper=True)
    (level,), names = dashed()
    assert level == pytest.approx(1.5 * results["C"].rate(0.8, 1.0).mean())
    assert names == ["thesis: D beyond 1.5 × C"]
    paper_c.draw_rates(results | {"C": made_up(brownian(), -0.1)}, of_paper=True)
    assert dashed()[0] == [0.0]


def test_without_the_papers_setting_no_level_is_the_thesiss(results):
    paper_c.draw_rates(results, of_paper=False)
    assert dashed() == ([], [])


def test_the_table_has_a_row_for_each_network_and_reading(results):
    rows = paper_c.final_rates({"one": results, "other": results}).splitlines()[2:]
    assert [row.split(" | ")[:2] for row in rows[:3]] == [["| A", "one"], ["| A", "other"], ["| B", "one"]]
    assert len(rows) == 8 and rows[-1].endswith("| 0.0 |")


def test_the_moment_is_the_first_at_which_the_agent_is_well_inside_and_desires_something_far(monkeypatch):
    monkeypatch.setattr(paper_c, "FAR", 0.001)
    network, world = network_b([2, 3]), WaterWorld()
    run, other = paper_c.moment_of_desire(network, world, 300, seed=1), Run(network, world, 1)
    assert 300 <= run.step < 300 + paper_c.PATIENCE
    other.advance(300)
    fits = []
    for _ in range(run.step - 300 + 1):
        at = other.world_state.scene.position / world.size
        lands = np.hypot(*other.state.desires.target[2:, :2].T)  # after the desires for creeps
        fits.append(np.abs(at - 0.5).max() < 0.2 and lands.max() > 0.001)
        other.advance(1)
    assert fits[-1] and not any(fits[:-1])


def test_the_moment_is_not_waited_for_in_vain(monkeypatch):
    monkeypatch.setattr(paper_c, "PATIENCE", 7)
    monkeypatch.setattr(paper_c, "WELL_INSIDE", 0.0)
    assert paper_c.moment_of_desire(network_b([2]), WaterWorld(), 10).step == 17


def test_the_table_has_where_each_desire_between_nodes_lands():
    run = Run(network_b([2, 3]), WaterWorld())
    run._state.desires.target[2:] = [[0.25, -0.1, 1.0], [-0.0001, 0.5, -1.5]]
    assert paper_c.landings(run).splitlines()[2:] == ["| PC to OVC, green creeps | (0.250, −0.100) | +1 |",
                                                      "| PC to OVC, red creeps | (0.000, 0.500) | −1.5 |"]


MOVING = Reading(0.03, 0.8, "share", absent_decay=0.0, memory=0.0, bootstrap=True, terminal=True,
                 object_state="object", exploration=0.1)


def test_desires_that_land_on_the_agent_are_distinguished_from_those_that_do_not():
    near, far = ({name: paper_c.distances(Condition(agent, WaterWorld(), 60_000, 2), runs=2)
                  for name, agent in networks(replace(MOVING, scale=scale)).items()} for scale in (1e-6, 1e6))
    for widths, share in near.values():
        assert widths.shape == (2,) and np.all(widths < 0.01) and np.all(share == 1)
    widths, share = far["D"]
    assert np.all(widths > 1) and np.all(share < 1)
