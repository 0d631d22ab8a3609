"""Sweeps over conditions, on this machine's cores or on any executor, with the same results to the last bit.

1. A task is one or more runs of a condition, at least 100,000 steps if there are so many: one core computes them in
   turn, and returns their rewards and hits. A single condition thus keeps all cores as busy as many do.
2. The process that called `sweep` writes finished runs to disk; runs that are on disk already are not repeated.
3. A task that fails, by itself or with its worker, is retried after the others are done, up to three attempts in all.
   An executor that breaks as a whole is replaced by the cores of this machine.
4. On this machine the workers are threads, not processes: compiled kernels run in parallel in them. Threads share the
   kernels, have no start-up time, and accept kernels and worlds defined in a notebook, which cannot be sent to a
   process.
5. There is no time limit, since only the user knows how long a run may take. Ctrl-C ends a sweep that waits for a
   hanging worker, reports the task it waited for, and leaves finished runs on disk.
"""

import os
import threading
import warnings
from concurrent.futures import BrokenExecutor, CancelledError, Executor, ThreadPoolExecutor, as_completed
from collections.abc import Callable, Iterator, Sequence
from typing import NamedTuple

from neorl import checks
from neorl.agents.agent import Agent
from neorl.agents.compile import n_values
from neorl.experiments.cache import Condition
from neorl.experiments.keeping import Keeper
from neorl.experiments.run import new_bins
from neorl.experiments.simulation import Result, label, live, progress_bar, usable_threads
from neorl.worlds.world import World

ATTEMPTS = 3
TASK_STEPS = 100_000  # they take a typical agent a tenth of a second, and a task's overhead is a millisecond


def simulate_once(agent: Agent, world: World, *, steps: int, runs: int, seed: int = 0,
                  changes: tuple[tuple[int, Agent], ...] = (),
                  progress: bool | Callable[[int, int], object] = True) -> Result:
    """`neorl.simulate` with a cache: a condition that is on disk already is read instead of computed.

    The arguments are those of `simulate`. Returns a `Result`. If it is interrupted, finished runs are kept, and the
    next call does the rest.
    Raises what `simulate` raises. Warns if results cannot be written to disk.
    """
    try:
        return next(sweep([Condition(agent, world, steps, runs, seed, changes)], progress=progress))
    except RuntimeError as failure:
        raise failure.__cause__ or failure


def sweep(conditions: Sequence[Condition], executor: Executor | None = None,
          progress: bool | Callable[[int, int], object] = True, *, workers: int | None = None) -> Iterator[Result]:
    """Compute independent conditions, and return an iterator of their `Result`s, in order.

    conditions: `Condition`s. All are computed before this returns; each result is read from disk when its turn comes.
    executor: any `concurrent.futures.Executor` whose workers can import this version of neorl, such as a process
        pool, `dask.distributed.Client.get_executor()`, or an executor over MPI; by default this machine's cores. It is
        not shut down.
    progress: show a progress bar, with the time left at the pace so far; or a function (done, total) as in `simulate`,
        of the steps of those conditions that are not on disk already.
    workers: the greatest number of this machine's cores to use, an integer ≥ 1; by default all, as far as the runs fit
        into memory. Not with an executor, which has workers of its own.

    Results that cannot be written to disk stay in memory, with a warning.

    Raises ValueError for a bad argument, MemoryError if a single run, or results that cannot be written, do not fit
    into the free memory of this machine, RuntimeError for conditions that have failed three times, once all others are
    kept; the next call resumes there.
    """
    conditions = checks.several("conditions", conditions)
    for condition in conditions:
        checks.instance("condition", condition, Condition)
    if not hasattr(executor, "submit") and executor is not None:
        raise checks.error("executor", "an executor of concurrent.futures or None", executor)
    if workers is not None:
        checks.integer("workers", workers, at_least=1)
        if executor is not None:
            raise checks.error("workers", "None beside an executor", workers)
    keeper = Keeper()
    missing = {condition: runs for condition in dict.fromkeys(conditions) if (runs := keeper.missing(condition))}
    # The largest come first, so that later runs can reuse their memory.
    waiting = [task for condition in sorted(missing, key=lambda each: -n_values(each.agent, each.world))
               for task in _tasks(condition, missing[condition])]
    total, errors = sum(task.steps for task in waiting), list[tuple[Task, BaseException]]()
    name = label(next(iter(missing)).agent) if len(missing) == 1 else "sweep"
    with progress_bar(total, name, progress) as bar:
        try:
            for _ in range(ATTEMPTS):
                errors = _run(waiting, executor, workers, keeper, bar) if waiting else []
                waiting = [task for task, _ in errors]
                if any(isinstance(error, BrokenExecutor) for _, error in errors):
                    warnings.warn(f"{executor!r} is broken; this machine's cores do the rest", RuntimeWarning,
                                  stacklevel=2)
                    executor = None
        finally:
            keeper.write_runs()
    if errors:
        failed = {task.condition: error for task, error in errors}
        condition, error = next(iter(failed.items()))
        raise RuntimeError(f"{len(failed)} of {len(conditions)} conditions have failed {ATTEMPTS} times, such as "
                           f"{condition}: {error!r}") from error
    return (keeper.result(condition) or simulate_once(**condition.choices) for condition in conditions)


class Task(NamedTuple):
    """Some runs of a condition."""

    condition: Condition
    runs: list

    @property
    def steps(self):
        """The steps of all these runs together."""
        return len(self.runs) * self.condition.steps


def _tasks(condition, runs):
    count = -(-TASK_STEPS // condition.steps)
    return [Task(condition, runs[first : first + count]) for first in range(0, len(runs), count)]


def _run(tasks, executor, workers, keeper, bar):
    """Compute tasks, and return the failed ones, [(task, exception), ...]."""
    if executor is None:
        return _run_here(tasks, workers, keeper, bar)
    return _collect(tasks, lambda task: executor.submit(_live, *task, task.condition.key), keeper,
                    lambda task: bar.update(task.steps))


def _run_here(tasks, workers, keeper, bar):
    conditions = {id(task.condition): task.condition for task in tasks}.values()
    lives = [(agent, each.world) for each in conditions
             for agent in (each.agent, *(later for _, later in each.changes))]
    usable = usable_threads(*max(lives, key=lambda life: n_values(*life)))
    pool = ThreadPoolExecutor(usable if workers is None else min(usable, workers))
    stop, room = threading.Event(), threading.local()

    def each_slice(lived):
        if stop.is_set():
            raise CancelledError
        bar.update(lived)

    try:
        return _collect(tasks, lambda task: pool.submit(_live, *task, task.condition.key, each_slice, room), keeper)
    except BaseException:
        stop.set()
        raise
    finally:
        pool.shutdown(wait=not stop.is_set())  # a thread that is still compiling may end by itself


def _collect(tasks, submit, keeper, finished=lambda task: None):
    """Submit tasks, pass their results to the keeper, and return the failed ones, [(task, exception), ...]."""
    waiting, errors = {}, []
    try:
        for task in tasks:
            waiting[submit(task)] = task
    except BrokenExecutor as error:
        errors = [(task, error) for task in tasks[len(waiting) :]]
    try:
        for future in as_completed(waiting):
            task = waiting.pop(future)
            try:
                rewards, hits = future.result()
            except Exception as error:
                errors.append((task, error))
            else:
                keeper.add(*task, rewards, hits)
                finished(task)
    except KeyboardInterrupt as interruption:
        if waiting:
            task = next((task for future, task in waiting.items() if future.running()), next(iter(waiting.values())))
            interruption.add_note(f"{len(waiting)} tasks were left, such as runs {task.runs[0]} to "
                                  f"{task.runs[-1]} of {task.condition}; finished runs are kept, and the next call "
                                  "resumes there.")
        raise
    finally:
        for future in waiting:  # none, unless it was interrupted
            future.cancel()
    return errors


def _live(condition, runs, key, each_slice=lambda lived: None, room=None):
    """The work of one task: carry out runs of a condition, and return their rewards and hits.

    A worker with other code or constants than the caller's is refused, since its results could differ.
    key: of the condition, where the caller computes it. room: holds the thread's last run, whose memory the next one
    reuses.
    """
    _check_key(condition, key)
    rewards, hits = new_bins(condition.world, len(runs), condition.steps)
    run = vars(room).pop("run", None) if room else None
    if run and n_values(run.agent, run.world) < n_values(condition.agent, condition.world):
        run = None  # frees its memory before another run allocates
    for k, *into in zip(runs, rewards, hits):
        run = live(condition.agent, condition.world, condition.steps, condition.seed, k, condition.changes, *into,
                   each_slice, run)
    if room:
        room.run = run
    _check_key(condition, key)
    return rewards, hits


def _check_key(condition, key):
    if condition.key != key:
        raise RuntimeError(f"worker {os.getpid()} must have the sources of neorl and the kernels and constants of the "
                           "sweep that it works for, but has others; restart it, and change nothing while it runs")
