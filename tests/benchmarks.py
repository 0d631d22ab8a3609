"""Benchmarks of the kernels: ``make bench``. Compare only rows of the same group, measured in the same run.

A row is named after one operation; the table gives its duration and the number of operations per second.
"""

import numpy as np
import pytest
from explorer_page import write_page

from neorl import Explorer, Run, WaterWorld, multimodal, place_cells, simulate
from neorl.core.learning import ZERO, MapValues, Rule, learn_all_goals
from neorl.core.stream import new_stream, randint
from neorl.kernels.execution import execute
from neorl.kernels.kernel import kernel
from neorl.worlds.waterworld import reset, step

STEPS = 1_000_000
RATES = np.float32(0.03) * np.array([0.4, 0.3, 0.2, 0.1], np.float32)
DISCOUNT = np.float32(0.8)


@kernel
def drawn_steps(state, rules, stream, steps):
    for _ in range(steps):
        _, done = step(state, rules, randint(stream, 4))
        if done:
            reset(state, rules)


@kernel
def random_changes(values, rule, path, rates):
    for change in range(path.shape[0] - 1):
        learn_all_goals(values, rule, path[change], path[change + 1], rates)


@pytest.mark.benchmark(group="one million steps of WaterWorld, on one core")
@pytest.mark.parametrize("n_creeps", [3, 8])
def test_steps(benchmark, n_creeps):
    world = WaterWorld(n_creeps=n_creeps)
    state, stream = world.reset(0), new_stream(np.random.SeedSequence(1))
    benchmark.pedantic(execute, (drawn_steps, state, world.rules, stream, STEPS), warmup_rounds=1, rounds=10)


@pytest.mark.parametrize("resolution", [23, 50])
def test_thousand_updates_of_four_actions_and_every_goal(benchmark, resolution):
    benchmark.group = f"a thousand updates of four actions and every goal, N{resolution}"
    cells = resolution**2
    rng = np.random.default_rng(0)
    walk = np.cumsum(rng.choice([-1, 1, -resolution, resolution], 1_001)) + cells // 2
    path = np.clip(walk, 0, cells - 1)
    q = np.zeros((cells, 4, cells), np.float32)
    values = MapValues(q.reshape(-1), 0, cells, 4, np.tile([0, cells], (cells, 1)), np.empty(cells, np.float32))
    arguments = (random_changes, values, Rule(DISCOUNT, True, ZERO, False), path, RATES)
    benchmark.pedantic(execute, arguments, warmup_rounds=3, rounds=30)


@pytest.mark.benchmark(group="twenty runs of 150,000 steps, N3 + N7 + N23")
@pytest.mark.parametrize("threads", [1, 2])
def test_runs_side_by_side(benchmark, threads):
    size = {"steps": 150_000, "runs": 20, "progress": False, "threads": threads}
    arguments = (place_cells([3, 7, 23]), WaterWorld(n_creeps=8, win_reward=5.0))
    benchmark.pedantic(simulate, arguments, size, warmup_rounds=1, rounds=5)


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
