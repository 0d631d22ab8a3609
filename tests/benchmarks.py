"""Benchmarks of the kernels: ``make bench``. Compare only rows of the same group, measured in the same run.

A row is named after one operation; the table gives its duration and the number of operations per second.
"""

import numpy as np
import pytest
from explorer_page import write_page

from lib.performance.bound import drawn_steps
from neorl import (Explorer, Run, WaterWorld, multimodal, network_a, network_b, network_c, network_d,
                   object_vector_cells, place_cells, simulate)
from neorl.core.kernel import execute, kernel
from neorl.core.learning import ZERO, MapValues, Rule, learn_all_goals
from neorl.core.stream import new_stream

STEPS = 1_000_000
RATES = np.float32(0.03) * np.array([0.4, 0.3, 0.2, 0.1], np.float32)
DISCOUNT = np.float32(0.8)


@kernel
def random_changes(values, rule, path, rates):
    for change in range(path.shape[0] - 1):
        learn_all_goals(values, rule, path[change], path[change + 1], rates)


def updates_by_numpy(q, path):
    for cell_tm1, cell_t in zip(path[:-1], path[1:]):
        target = DISCOUNT * q[cell_t].max(axis=0)
        target[cell_t] = 1
        q[cell_tm1] += RATES[:, None] * (target - q[cell_tm1])


@pytest.mark.benchmark(group="one million steps of WaterWorld, on one core")
@pytest.mark.parametrize("n_creeps", [3, 8])
def test_steps(benchmark, n_creeps):
    world = WaterWorld(n_creeps=n_creeps)
    state, stream = world.reset(0), new_stream(np.random.SeedSequence(1))
    benchmark.pedantic(execute, (drawn_steps, state, world.rules, stream, STEPS), warmup_rounds=1, rounds=10)


@pytest.mark.parametrize("by", ["kernel", "numpy"])
@pytest.mark.parametrize("resolution", [23, 50])
def test_thousand_updates_of_four_actions_and_every_goal(benchmark, resolution, by):
    benchmark.group = f"a thousand updates of four actions and every goal, N{resolution}"
    cells = resolution**2
    rng = np.random.default_rng(0)
    walk = np.cumsum(rng.choice([-1, 1, -resolution, resolution], 1_001)) + cells // 2
    path = np.clip(walk, 0, cells - 1)
    q = np.zeros((cells, 4, cells), np.float32)
    if by == "kernel":
        everything = np.tile([0, cells], (cells, 1))
        values = MapValues(q.reshape(-1), 0, cells, 4, everything, np.empty(cells, np.float32))
        arguments = (random_changes, values, Rule(DISCOUNT, True, ZERO, False), path, RATES)
        benchmark.pedantic(execute, arguments, warmup_rounds=3, rounds=30)
    else:
        benchmark.pedantic(updates_by_numpy, (q, path), warmup_rounds=3, rounds=30)


@pytest.mark.benchmark(group="twenty runs of 150,000 steps, N3 + N7 + N23")
@pytest.mark.parametrize("threads", [1, 2])
def test_runs_side_by_side(benchmark, threads):
    size = {"steps": 150_000, "runs": 20, "progress": False, "threads": threads}
    arguments = (place_cells([3, 7, 23]), WaterWorld(n_creeps=8, win_reward=5.0))
    benchmark.pedantic(simulate, arguments, size, warmup_rounds=1, rounds=5)


@pytest.mark.benchmark(group="a hundred runs of figure 7's four conditions")
def test_figure_7(benchmark):
    tank = WaterWorld(n_creeps=8, win_reward=5.0)
    simulate(place_cells([3]), tank, steps=1, runs=1, progress=False)

    def figure_7():
        for resolutions in ([3], [7], [23], [3, 7, 23]):
            simulate(place_cells(resolutions), tank, steps=150_000, runs=100, progress=False)

    benchmark.pedantic(figure_7, rounds=1)


@pytest.mark.benchmark(group="a hundred runs of each condition of a paper")
@pytest.mark.parametrize("paper", ["B, 15 of 600,000 steps", "C, 4 of 300,000 steps"])
def test_papers(benchmark, paper):
    primes = [2, 3, 5, 7, 11, 13]
    agents, steps = [make() for make in (network_a, network_b, network_c, network_d)], 300_000
    if paper.startswith("B"):
        sets = [*([n] for n in primes), primes]
        agents = [make(chosen) for make in (place_cells, object_vector_cells) for chosen in sets] + [multimodal(primes)]
        steps = 600_000
    simulate(place_cells([3]), WaterWorld(), steps=1, runs=1, progress=False)

    def conditions():
        for agent in agents:
            simulate(agent, WaterWorld(), steps=steps, runs=100, progress=False)

    benchmark.pedantic(conditions, rounds=1)


@pytest.mark.benchmark(group="a million steps of both modalities, on one core, and in a page that draws them")
@pytest.mark.parametrize("where", ["native", "page"])
def test_million_steps_of_both_modalities(benchmark, where, tmp_path, request):
    if where == "native":
        benchmark.pedantic(Run(multimodal(), WaterWorld()).advance, [1_000_000], warmup_rounds=1, rounds=5)
        return
    write_page(tmp_path, [Explorer(preset="Place and object-vector cells", speed=0.0)], without_end)
    page = request.getfixturevalue("open_page")(tmp_path, "page.html")
    page.wait_for_selector("[data-state=running]")
    page.wait_for_timeout(2_000)  # by then the browser has optimised the code
    live = """() => new Promise((resolve) => {
        const { dataset } = document.querySelector(".neorl-explorer"), end = Number(dataset.step) + 1e6;
        const look = () => Number(dataset.step) >= end ? resolve() : setTimeout(look, 1);
        look();
    })"""
    benchmark.pedantic(page.evaluate, [live], rounds=5)


def without_end(record):
    for preset in record["state"]["_presets"].values():
        preset["steps"] = 10**9
