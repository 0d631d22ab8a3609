"""Many conditions at a time, on this machine's cores or on any executor, with the same results to the last bit.

1. A task is some runs of a condition, at least 100,000 steps of them: one core lives them, one after the other, and
   hands back what they brought. So one condition keeps all cores busy as well as many do.
2. What is finished is kept on disk by the process that called `sweep`; what is on disk already is not run again.
3. A task that fails, by itself or with its worker, is run again when the others are done, up to three times in all.
   An executor that breaks as a whole is replaced by the cores of this machine.
4. On this machine the workers are threads, not processes: compiled kernels run side by side in them, and they share
   the kernels, need no start, and take kernels and worlds of a notebook, which cannot be sent to a process.
5. There is no time limit, since only the user knows how long a run may take. Ctrl-C ends a sweep that waits for a
   worker that hangs, says what it waited for, and leaves what is finished on disk.
"""

import os
import threading
import warnings
from concurrent.futures import BrokenExecutor, CancelledError, Executor, ThreadPoolExecutor, as_completed
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from neorl import checks
from neorl.agents.agent import Agent
from neorl.agents.compile import n_values
from neorl.experiments.cache import Condition, source_digest
from neorl.experiments.keeping import Keeper
from neorl.experiments.run import new_bins
from neorl.experiments.simulation import Result, label, live, progress_bar, usable_threads
from neorl.worlds.world import World

ATTEMPTS = 3
TASK_STEPS = 100_000  # a tenth of a second of a typical agent's, against a millisecond for handing them over


def simulate_once(agent: Agent, world: World, *, steps: int, runs: int, seed: int = 0,
                  changes: tuple[tuple[int, Agent], ...] = (), progress: bool = True) -> Result:
    """`neorl.simulate`, unless the same condition is on disk already; then what was computed is read.

    The arguments are those of `simulate`. Returns a `Result`. If it is interrupted, the runs that are finished are
    kept, and the next call does the rest.
    Raises what `simulate` does. Results that cannot be written to disk cost a warning.
    """
    try:
        return next(sweep([Condition(agent, world, steps, runs, seed, changes)], progress=progress))
    except RuntimeError as failure:
        raise failure.__cause__ or failure


def sweep(conditions: Sequence[Condition], executor: Executor | None = None, progress: bool = True, *,
          workers: int | None = None) -> Iterator[Result]:
    """Compute independent conditions, and return an iterator of their `Result`s, in order.

    conditions: `Condition`s. All are computed before this returns; each result is read from disk when its turn comes.
    executor: any `concurrent.futures.Executor` whose workers can import this version of neorl, such as that of a
        process pool, of `dask.distributed.Client.get_executor()`, or of MPI; by default this machine's cores. It is
        left open.
    progress: show a progress bar, with the time that is left at the pace so far.
    workers: how many of this machine's cores to use at most, an integer ≥ 1; by default all, as far as the runs fit
        into memory. Not with an executor, which has workers of its own.

    Results that cannot be written to disk cost a warning, and stay in memory.

    Raises ValueError for a bad argument, MemoryError if a single run does not fit into the free memory of this machine,
    or results that cannot be written do not, RuntimeError for conditions that have failed three times, after all others
    are kept; the next call goes on there.
    """
    conditions = checks.several("conditions", conditions)
    for condition in conditions:
        checks.instance("condition", condition, Condition)
    if not hasattr(executor, "submit") and executor is not None:
        raise ValueError(f"executor is {checks.shown(executor)}, allowed are executors of concurrent.futures and None")
    if workers is not None:
        checks.integer("workers", workers, at_least=1)
        if executor is not None:
            raise ValueError(f"workers is {workers!r} beside an executor, allowed is one of the two")
    keeper = Keeper()
    missing = {condition: runs for condition in dict.fromkeys(conditions) if (runs := keeper.missing(condition))}
    # The large ones come first and take over each other's memory.
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
        """Of all these runs."""
        return len(self.runs) * self.condition.steps


def _tasks(condition, runs):
    count = -(-TASK_STEPS // condition.steps)
    return [Task(condition, runs[first : first + count]) for first in range(0, len(runs), count)]


def _run(tasks, executor, workers, keeper, bar):
    """Compute tasks, and return those that failed, [(task, exception), ...]."""
    if executor is None:
        return _run_here(tasks, workers, keeper, bar)
    return _collect(tasks, lambda task: executor.submit(_live, *task, source_digest()), keeper,
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
        return _collect(tasks, lambda task: pool.submit(_live, *task, source_digest(), each_slice, room), keeper)
    except BaseException:
        stop.set()
        raise
    finally:
        pool.shutdown(wait=not stop.is_set())  # a thread that is still compiling may end by itself


def _collect(tasks, submit, keeper, finished=lambda task: None):
    """Submit tasks, give what they bring to the keeper, and return those that failed, [(task, exception), ...]."""
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
                                  f"{task.runs[-1]} of {task.condition}; what is finished is kept, and the next call "
                                  "goes on there.")
        raise
    finally:
        for future in waiting:  # none, unless it was interrupted
            future.cancel()
    return errors


def _live(condition, runs, source, each_slice=lambda lived: None, room=None):
    """What a worker does: let runs of a condition live, and return their rewards and hits.

    Another version of the code than the caller's would bring other results.
    room: holds the run that the thread has lived last, whose memory the next one takes over.
    """
    if source_digest() != source:
        raise RuntimeError(f"worker {os.getpid()} has other sources of neorl than the sweep that it works for")
    rewards, hits = new_bins(condition.world, len(runs), condition.steps)
    run = vars(room).pop("run", None) if room else None
    if run and n_values(run.agent, run.world) < n_values(condition.agent, condition.world):
        run = None  # before another takes memory
    for k, *into in zip(runs, rewards, hits):
        run = live(condition.agent, condition.world, condition.steps, condition.seed, k, condition.changes, *into,
                   each_slice, run)
    if room:
        room.run = run
    return rewards, hits
