"""Sweeps give the same results on threads, processes and a cluster, with workers that fail, die or hang."""

import importlib
import os
import re
import signal
import subprocess
import sys
import threading
from concurrent.futures import Future, ProcessPoolExecutor, ThreadPoolExecutor
from dataclasses import replace
from multiprocessing import get_all_start_methods, get_context
from pathlib import Path
from types import SimpleNamespace

import pond
import pytest
from same import alone

from neorl import Condition, Policy, WaterWorld, multimodal, place_cells, simulate, sweep
from neorl.experiments import simulation, store
from neorl.kernels.kernel import jit_is_off

WORLD = WaterWorld()
CONDITIONS = [Condition(place_cells([n]), WORLD, 2_000, 2, seed) for n in (2, 3) for seed in (0, 1)]
CONDITIONS.append(Condition(place_cells([3]), WORLD, 2_000, 2, changes=[(1_000, multimodal([3]))]))
pytestmark = pytest.mark.usefixtures("cache_folder")


@pytest.fixture
def lived(monkeypatch):
    """The tasks that workers in this process have computed: (condition, runs)."""
    tasks = []
    original = simulation._computed
    monkeypatch.setattr(simulation, "_computed", lambda *task: tasks.append(task[:2]) or original(*task))
    return tasks


def assert_the_same(results, conditions=CONDITIONS):
    results = list(results)
    assert len(results) == len(conditions)
    assert results == [alone(condition) for condition in conditions]
    assert any(result.rewards.any() for result in results)


@pytest.mark.parametrize("choices", [{}, {"cache": False}, {"threads": 1}])
def test_a_sweep_returns_the_results_of_its_conditions_alone_and_in_order(lived, choices):
    results = sweep(CONDITIONS, **choices, progress=False)
    assert sorted(map(repr, lived)) == sorted(repr((each, [0, 1])) for each in CONDITIONS)
    assert_the_same(results)


def test_without_a_cache_nothing_is_kept_and_the_first_error_ends_it(cache_folder, monkeypatch):
    simulate(**CONDITIONS[0].choices, progress=False)
    assert not (cache_folder / "runs").exists()
    fails(monkeypatch, lambda condition, runs: True)
    with pytest.raises(MemoryError, match="for now"):
        simulate(**CONDITIONS[0].choices, progress=False)


def test_results_are_those_of_the_code_and_constants_of_the_call(lived, monkeypatch):
    results = sweep(CONDITIONS[:1], progress=False)
    monkeypatch.setattr("neorl.experiments.condition.source_digest", lambda: "changed")
    assert next(results).rewards.any() and len(lived) == 1


def test_what_is_on_disk_or_asked_for_twice_is_computed_once(lived):
    list(sweep(CONDITIONS[:2], progress=False))
    assert_the_same(sweep([*CONDITIONS, CONDITIONS[0]], progress=False), [*CONDITIONS, CONDITIONS[0]])
    assert len(lived) == len(CONDITIONS)


def fails(monkeypatch, fails_now):
    """Make a task fail after its work is done, if `fails_now(condition, runs)`."""
    original = simulation._computed

    def live(condition, runs, *others):
        brought = original(condition, runs, *others)
        if fails_now(condition, runs):
            raise MemoryError("for now")
        return brought

    monkeypatch.setattr(simulation, "_computed", live)


def test_conditions_that_fail_are_reported_after_the_others_are_kept_and_run_alone_next_time(lived, monkeypatch):
    failing = [CONDITIONS[1], CONDITIONS[3]]
    fails(monkeypatch, lambda condition, runs: condition in failing)
    with pytest.raises(RuntimeError, match=r"(?s)2 of 5 conditions have failed, one by MemoryError: .*Condition\("):
        sweep(CONDITIONS, progress=False)
    assert [store.load(condition) is not None for condition in CONDITIONS] == [True, False, True, False, True]
    again, failing[:] = [*failing], []
    lived.clear()
    assert_the_same(sweep(CONDITIONS, progress=False))
    assert sorted(map(repr, lived)) == sorted(repr((each, [0, 1])) for each in again)


class Hung:
    """An executor whose workers never finish."""

    futures = []

    def submit(self, *task):
        self.futures.append(Future())
        return self.futures[-1]


@pytest.mark.usefixtures("interruptible")
def test_a_sweep_that_waits_for_a_worker_that_hangs_can_be_interrupted_and_says_what_it_waits_for():
    executor = Hung()
    threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
    with pytest.raises(KeyboardInterrupt) as interruption:
        sweep(CONDITIONS, executor, progress=False)
    (note,) = interruption.value.__notes__
    assert "5 tasks were left, such as runs 0 to 1 of Condition(agent=Agent(" in note
    assert all(future.cancelled() for future in executor.futures)


def test_workers_are_threads_at_most_so_many(monkeypatch):
    asked, original = [], simulation.ThreadPoolExecutor
    monkeypatch.setattr(simulation, "usable_threads", lambda agent, world: 3)
    monkeypatch.setattr(simulation, "ThreadPoolExecutor", lambda count, **_: asked.append(count) or original(count))
    for seed, threads in enumerate([None, 1, 2, 9]):
        sweep([Condition(place_cells([3]), WORLD, 100, 1, seed)], threads=threads, progress=False)
    assert asked == [3, 1, 2, 3]


def test_a_worker_of_joblib_s_runs_as_many_threads_as_joblib_leaves_to_it():
    joblib = pytest.importorskip("joblib")
    with joblib.parallel_config("loky", inner_max_num_threads=1):
        found = joblib.Parallel(2)(joblib.delayed(simulation.usable_threads)(place_cells([3]), WORLD) for _ in range(2))
    assert found == [1, 1]


def test_a_sweep_takes_any_iterable_of_conditions_and_no_other():
    first, second, *_ = CONDITIONS
    by_name = {"one": first, "other": second}
    for conditions in (iter((first, second)), by_name.values(), (each for each in (first, second))):
        assert_the_same(sweep(conditions, progress=False), [first, second])
    for wrong, message in ((5, "conditions must be an iterable of Conditions, such as a list, but is 5"),
                           (first, "conditions must be an iterable of Conditions, such as a list, but is Condition"),
                           (by_name, "condition must be a Condition, but is 'one'")):
        with pytest.raises(ValueError, match=message):
            sweep(wrong)


def test_a_process_pool_that_breaks_is_reported_and_the_next_call_does_the_rest():
    """A killed worker breaks the whole process pool, which loses all unfinished tasks."""
    conditions = [Condition(place_cells([3]), WORLD, 1_000_000, 1, seed) for seed in range(4)]
    with ProcessPoolExecutor(2, get_context("spawn")) as pool:
        pool.submit(os.getpid).result()
        killer = threading.Timer(0.3, lambda: os.kill(next(iter(pool._processes)), signal.SIGKILL))
        killer.start()
        with pytest.raises(RuntimeError, match="conditions have failed, one by BrokenProcessPool"):
            sweep(conditions, pool, progress=False)
    assert_the_same(sweep(conditions, progress=False), conditions)


@pytest.fixture(scope="module")
def cluster():
    import distributed  # here, since it takes long, and all workers import this file

    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None) as cluster:
        yield cluster


@pytest.mark.filterwarnings("ignore")
def test_a_cluster_of_worker_processes_brings_the_same(cluster, lived):
    with cluster.get_client() as client:
        assert_the_same(sweep(CONDITIONS, client.get_executor(), progress=False))
        assert len(client.run(os.getpid)) == 2 and os.getpid() not in client.run(os.getpid).values()
    assert lived == []  # nothing was computed in this process


@pytest.mark.filterwarnings("ignore")
def test_a_killed_worker_of_a_cluster_loses_only_its_current_task(cluster, monkeypatch):
    """One of two workers is killed as soon as the first condition is cached; unfinished tasks are repeated."""
    conditions = [Condition(place_cells([3]), WORLD, 200_000, 1, seed) for seed in range(20, 28)]
    original, kept_after = store.save_runs, []

    def keep_and_kill(condition, runs, key):
        original(condition, runs, key)
        if not kept_after:
            os.kill(next(iter(client.run(os.getpid).values())), signal.SIGKILL)
        kept_after.append(key)

    monkeypatch.setattr(store, "save_runs", keep_and_kill)
    with cluster.get_client() as client:
        results = sweep(conditions, client.get_executor(), progress=False)
    assert len(kept_after) == len(conditions)  # each once
    assert_the_same(results, conditions)


@pytest.mark.filterwarnings("ignore")
def test_kernels_that_workers_cannot_import_are_refused(cluster, tmp_path, monkeypatch):
    """They once ended the connection of one worker after the other, and the sweep never returned."""
    (tmp_path / "only_here.py").write_text("import neorl\n\n@neorl.kernel\ndef first(value, stream):\n    return 0\n")
    monkeypatch.syspath_prepend(tmp_path)
    agent = replace(place_cells([3]), policy=Policy(0.0, choose=importlib.import_module("only_here").first))
    with (cluster.get_client() as client,
          pytest.raises(RuntimeError, match="modules that its executor's workers can import")):
        sweep([Condition(agent, WORLD, 1_000, 1)], client.get_executor(), progress=False)


@pytest.mark.skipif(jit_is_off(), reason="the compiler is off")
def test_worlds_and_kernels_of_the_main_program_reach_other_processes():
    methods = [each for each in get_all_start_methods() if each != "fork"]
    subprocess.run([sys.executable, pond.__file__, methods[0], methods[-1]], check=True)


PAGE = Path(__file__).parents[2] / "book" / "running.md"
RECIPES = re.findall("^```python\n(.*?)^```", PAGE.read_text("utf-8"), re.S | re.M)


def small(recipe):
    return recipe.replace("steps=150_000, runs=100", "steps=1_000, runs=3").replace("range(2, 30)", "(2, 3)")


@pytest.mark.filterwarnings("ignore")
def test_the_recipe_for_dask_runs(cluster, monkeypatch):
    """A local cluster stands for that of the job queue."""
    asked = {}

    def submitted(**job):
        asked.update(job)
        return cluster

    monkeypatch.setattr(cluster, "scale", asked.update)
    monkeypatch.setitem(sys.modules, "dask_jobqueue", SimpleNamespace(SLURMCluster=submitted))
    made = {}
    exec(small(RECIPES[0]), made)
    assert set(asked) == {"cores", "processes", "memory", "walltime", "jobs"} and len(made["results"]) == 2
    assert_the_same(made["results"].values(), made["conditions"])


def test_the_recipe_for_mpi_runs(monkeypatch):
    """Threads stand for the processes of MPI."""
    monkeypatch.setitem(sys.modules, "mpi4py.futures", SimpleNamespace(MPIPoolExecutor=ThreadPoolExecutor))
    made = {"__name__": "__main__"}
    exec(small(RECIPES[1]), made)
    assert len(made["results"]) == 2
    assert_the_same(made["results"].values(), made["conditions"])
