"""Figures as a library: in the user's axes, with matplotlib alone, with any number of curves, and to scale."""

import doctest
import importlib
import pkgutil
import subprocess
import sys

import numpy as np
import pytest
from matplotlib import pyplot as plt

import neorl
from neorl import Condition, NresMap, Result, Run, WaterWorld, drawing, network_d, place_cells
from neorl.statistics import Estimate

MODULES = [importlib.import_module(f"neorl.drawing.{each.name}") for each in pkgutil.iter_modules(drawing.__path__)]
TANK = WaterWorld()
ESTIMATES = {"D": [Estimate(0.1, 0.0, 0.3), Estimate(0.4, 0.3, 0.5)]}


def made_up(minutes, runs=3, reward=0.1):
    steps = int(minutes * 60 * 50)
    rewards = np.full((runs, -(-steps // 10)), reward, np.float32)
    return Result(Condition(place_cells([2]), TANK, steps, runs), rewards, np.zeros((*rewards.shape, 2), np.int16))


@pytest.fixture(scope="module")
def run():
    run = Run(place_cells([3]), TANK)
    run.advance(1_000)
    return run


def figures_of_one_panel(run):
    curves = {"one": np.ones((3, 4))}
    return {
        drawing.draw_accumulated: ({"N2": made_up(1)},), drawing.draw_proficiency: ({"N2": made_up(1)},),
        drawing.draw_curves: (np.arange(4), curves), drawing.draw_sweep: ([1, 2], ESTIMATES),
        drawing.draw_network: (network_d(),), drawing.draw_cells: (NresMap(3),),
        drawing.draw_values: (NresMap(3), np.ones((9, 4)) * [0, 1, 0, 0]),
        drawing.draw_value_map: (run, [(0.5, 0.5)]), drawing.draw_world: (TANK, run.world_state),
        drawing.draw_tank: (TANK, run.world_state), drawing.draw_walls: (TANK,)}


def test_a_figure_of_one_panel_is_drawn_into_the_axes_that_are_given_and_into_no_other(run):
    functions = figures_of_one_panel(run)
    assert {each.__name__ for each in functions} == {
        name for name in drawing.__all__ if name.startswith("draw_")}
    for draw, arguments in functions.items():
        figure, (left, right) = plt.subplots(1, 2)
        assert draw(*arguments, ax=right) is right
        assert right.has_data() or right.texts or right.patches, draw
        assert not left.has_data() and not left.patches and plt.get_fignums() == [figure.number], draw
        plt.close(figure)
        assert draw(*arguments).figure.number == plt.gcf().number  # a figure of its own
        plt.close("all")


@pytest.mark.parametrize("module", [drawing, *MODULES], ids=lambda module: module.__name__)
def test_the_examples_in_docstrings_run(module, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    names = {"neorl": neorl, "drawing": drawing, "np": np}
    for example in doctest.DocTestFinder(exclude_empty=True).find(module, extraglobs=names):
        if example.name.startswith(module.__name__):
            assert doctest.DocTestRunner().run(example).failed == 0, example.name
            plt.close("all")


@pytest.mark.parametrize("draw", [drawing.draw_accumulated, drawing.draw_proficiency])
def test_runs_of_different_lengths_are_drawn_to_scale(draw):
    for results in ({"long": made_up(20), "short": made_up(2)}, {"short": made_up(2), "long": made_up(20)}):
        axes = draw(results)
        ends = dict(zip(results, (line.get_xdata()[-1] for line in axes.lines)))
        assert ends["long"] == pytest.approx(10 * ends["short"], rel=0.03)
        assert axes.get_xlim()[1] == pytest.approx(ends["long"], rel=0.02)


# Simulates an environment with only the core's packages, matplotlib and its dependencies.
HIDE = """
import importlib.abc, sys
class Hidden(importlib.abc.MetaPathFinder):
    def find_spec(self, name, path, target=None):
        if name.split(".")[0] in {hidden!r}:
            raise ModuleNotFoundError(f"No module named {{name!r}}", name=name)
sys.meta_path.insert(0, Hidden())
"""
OF_THE_BOOK = ("IPython", "ipykernel", "ipywidgets", "anywidget", "traitlets", "matplotlib_inline", "pandas",
               "sklearn", "ziglang", "gymnasium", "distributed", "papermill", "nbformat")


def test_matplotlib_is_enough(tmp_path, monkeypatch):
    monkeypatch.setenv("MPLBACKEND", "agg")
    code = """
import importlib, pkgutil, neorl
assert "matplotlib" not in sys.modules
from neorl import drawing
for each in pkgutil.iter_modules(drawing.__path__):
    importlib.import_module("neorl.drawing." + each.name)
drawing.use_style()
drawing.draw_network(neorl.network_d()).figure.savefig("network.svg")
"""
    done = subprocess.run([sys.executable, "-c", HIDE.format(hidden=OF_THE_BOOK) + code], capture_output=True,
                          text=True, cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "network.svg").read_text().startswith("<?xml")
