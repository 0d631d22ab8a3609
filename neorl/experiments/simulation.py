"""Runs of conditions, on this machine's cores or on any executor, with the same results to the last bit.

1. A task is one or more runs of a condition, at least 100,000 steps if there are so many: one core computes them in
   turn, and returns their rewards and hits. A single condition thus keeps all cores as busy as many do.
2. The process that called writes finished runs to disk; runs that are on disk already are not repeated
   (`neorl.experiments.store`).
3. Tasks that fail, by themselves or with their workers, are reported once the others are done and kept; the next call
   repeats them alone. Without a cache, where nothing would be kept, the first error ends the call.
4. On this machine the workers are threads, not processes: compiled kernels run in parallel in them. Threads share the
   kernels, have no start-up time, and accept kernels and worlds defined in a notebook, which cannot be sent to a
   process.
5. There is no time limit, since only the user knows how long a run may take. Ctrl-C ends a sweep that waits for a
   hanging worker, reports the task it waited for, and leaves finished runs on disk.
"""

import os
import pickle
import threading
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import BrokenExecutor, CancelledError, Executor, ThreadPoolExecutor, as_completed
from itertools import islice
from typing import NamedTuple

from neorl.agents.agent import Agent
from neorl.agents.embodiment import embodied
from neorl.agents.memory import fitting_runs
from neorl.common import checks
from neorl.common.container import cores, usable_bytes
from neorl.common.progress import progress_bar
from neorl.common.warn import users_frame, work_for
from neorl.core.building import n_values
from neorl.experiments.bins import n_bins, new_bins
from neorl.experiments.condition import PARTS, Condition
from neorl.experiments.result import Result
from neorl.experiments.run import SLICE, Run
from neorl.experiments.store import Keeper
from neorl.kernels.identity import can_cache
from neorl.worlds.world import World

TASK_STEPS = 100_000  # they take a typical agent a tenth of a second, and a task's overhead is a millisecond
BYTES_OF_A_RUN = 500  # with its task and what waits for it, besides its rewards and hits


def simulate(agent: Agent, world: World, *, steps: int, runs: int, seed: int = 0,
             changes: tuple[tuple[int, Agent], ...] = (), cache: bool = False, threads: int | None = None,
             progress: bool | Callable[[int, int], object] = True) -> Result:
    """Run `runs` independent learners for `steps` steps each, one core per run, and return their `Result`.

    agent: an `Agent`. world: a `neorl.World`. steps, runs: integers ≥ 1.
    seed: integer ≥ 0; run k is the same for any number of runs and threads.
    changes: (step, agent) pairs in order of time: from that step on every learner is that agent, see
        `neorl.Run.change`.
    cache: read what is on disk already instead of computing it, and keep finished runs there, so that after an
        interruption the next call does the rest.
    threads: the greatest number of runs in parallel, an integer ≥ 1; by default one per core that this process may
        use (its affinity, container and ``NUMBA_NUM_THREADS``), as far as they fit into the free memory.
    progress: show a progress bar in a terminal or a notebook, but not where the output is recorded; or a function
        (done, total), which is called now and then with the number of steps that all runs together have taken, and
        will take. It is called from threads, but never twice at once.

    Raises ValueError for a bad argument, MemoryError if a single run does not fit into the free memory. Warns if
    results that are to be cached cannot be written to disk.
    """
    try:
        return next(sweep([Condition(agent, world, steps, runs, seed, changes)], progress=progress, cache=cache,
                          threads=threads))
    except RuntimeError as failure:
        raise failure.__cause__ or failure


def sweep(conditions: Iterable[Condition], executor: Executor | None = None,
          progress: bool | Callable[[int, int], object] = True, *, cache: bool = True,
          threads: int | None = None) -> Iterator[Result]:
    """Compute independent conditions, and return an iterator of their `Result`s, in order.

    conditions: an iterable of `Condition`s. All are computed before this returns; each result is read from disk when
        its turn comes.
    executor: any `concurrent.futures.Executor` whose workers can import this version of neorl, such as a process
        pool, `dask.distributed.Client.get_executor()`, or an executor over MPI; by default this machine's cores. It is
        not shut down.
    progress: show a progress bar, with the time left at the pace so far, or call a function (done, total), as
        `simulate` does; both count the steps of those conditions that are not on disk already.
    cache: as in `simulate`; without it, all results are in memory.
    threads: as in `simulate`. Not with an executor, which has workers of its own.

    Raises ValueError for a bad argument, MemoryError if a single run, or results that cannot be written, do not fit
    into the free memory of this machine, RuntimeError for conditions that have failed, once all others are kept; the
    next call resumes there. Warns if results cannot be written to disk.
    """
    try:
        each = iter(conditions)
    except TypeError:
        raise checks.error("conditions", "an iterable of Conditions, such as a list", conditions) from None
    conditions = checks.several("conditions", list(islice(each, checks.MOST + 1)))
    for condition in conditions:
        _check_fits(checks.instance("condition", condition, Condition))
    if not hasattr(executor, "submit") and executor is not None:
        raise checks.error("executor", "an executor of concurrent.futures or None", executor)
    if threads is not None:
        checks.integer("threads", threads, at_least=1)
        if executor is not None:
            raise checks.error("threads", "None beside an executor", threads)
    cache = checks.flag("cache", cache) and can_cache(*PARTS)
    names = [condition.key if cache else id(condition) for condition in conditions]
    keepers = {name: Keeper(condition, cache) for name, condition in dict(zip(names, conditions)).items()}
    missing = [keeper for keeper in keepers.values() if keeper.missing]
    # The largest come first, so that later runs can reuse their memory.
    missing.sort(key=lambda keeper: -n_values(embodied(keeper.condition.agent, keeper.condition.world)[0]))
    waiting = [task for keeper in missing for task in _tasks(keeper)]
    total = sum(task.steps for task in waiting)
    name = label(missing[0].condition.agent) if len(missing) == 1 else "sweep"
    with progress_bar(total, name, progress) as bar:
        try:
            errors = _run(waiting, executor, threads, cache, bar) if waiting else []
        finally:
            for keeper in missing:
                keeper.write_runs()
    if errors:
        failed = {id(task.keeper): (task.keeper.condition, error) for task, error in errors}
        condition, error = next(iter(failed.values()))
        raise RuntimeError(f"{len(failed)} of {len(conditions)} conditions have failed, one by {type(error).__name__}: "
                           f"{error}\n\nIt was {condition}") from error
    return (keepers[name].result() or simulate(**condition.choices, cache=True, progress=progress)
            for name, condition in zip(names, conditions))


def _check_fits(condition):
    """Raise MemoryError if the result of a condition does not fit into the free memory."""
    bins = n_bins(condition.world, condition.steps)
    usable_bytes(condition.runs * (BYTES_OF_A_RUN + bins * (4 + 2 * len(condition.world.kinds))),
                 "rewards and hits of all these runs need", "choose fewer runs or steps")


class Task(NamedTuple):
    """Some runs of a condition, and where they are kept."""

    keeper: Keeper
    runs: list

    @property
    def steps(self):
        """The steps of all these runs together."""
        return len(self.runs) * self.keeper.condition.steps


def _tasks(keeper):
    count = -(-TASK_STEPS // keeper.condition.steps)
    return [Task(keeper, keeper.missing[first : first + count]) for first in range(0, len(keeper.missing), count)]


def _run(tasks, executor, threads, cache, bar):
    """Compute tasks, and return the failed ones, [(task, exception), ...]."""
    if executor is not None:
        return _collect(tasks, lambda condition, runs: executor.submit(
            _computed_there, _pickled(condition), runs, condition.key), cache, lambda task: bar.update(task.steps))
    conditions = {id(task.keeper): task.keeper.condition for task in tasks}.values()
    pairs = [(agent, each.world) for each in conditions
             for agent in (each.agent, *(later for _, later in each.changes))]
    usable = usable_threads(*max(pairs, key=lambda pair: n_values(embodied(*pair)[0])))
    pool = ThreadPoolExecutor(usable if threads is None else min(usable, threads),
                              initializer=work_for, initargs=(users_frame(),))
    stop, thread = threading.Event(), threading.local()

    def each_slice(steps):
        if stop.is_set():
            raise CancelledError
        bar.update(steps)

    try:
        return _collect(tasks, lambda condition, runs: pool.submit(
            _computed, condition, runs, condition.key if cache else None, each_slice, thread), cache)
    except BaseException:
        stop.set()
        raise
    finally:
        pool.shutdown(wait=not stop.is_set())  # a thread that is still compiling may end by itself


def _collect(tasks, submit, cache, finished=lambda task: None):
    """Submit tasks, pass their results to their keepers, and return the failed ones, [(task, exception), ...]."""
    waiting, errors = {}, []
    try:
        for task in tasks:
            waiting[submit(task.keeper.condition, task.runs)] = task
    except BrokenExecutor as error:
        errors = [(task, error) for task in tasks[len(waiting) :]]
    try:
        for future in as_completed(waiting):
            task = waiting.pop(future)
            try:
                rewards, hits = future.result()
            except Exception as error:
                if not cache:
                    raise
                errors.append((task, error))
            else:
                task.keeper.add(task.runs, rewards, hits)
                finished(task)
    except KeyboardInterrupt as interruption:
        if waiting:
            task = next((task for future, task in waiting.items() if future.running()), next(iter(waiting.values())))
            interruption.add_note(f"{len(waiting)} tasks were left, such as runs {task.runs[0]} to {task.runs[-1]} of "
                                  f"{task.keeper.condition}"
                                  + "; finished runs are kept, and the next call resumes there." * cache)
        raise
    finally:
        for future in waiting:  # none, unless it was interrupted
            future.cancel()
    return errors


def _pickled(condition):
    """A condition for a worker, by cloudpickle where it is installed, which includes what the main program defines."""
    try:
        from cloudpickle import dumps
    except ImportError:
        from pickle import dumps
    return dumps(condition)


def _computed_there(pickled, runs, key):
    """`_computed` on a worker of an executor, for a pickled condition.

    As an argument, a condition that a worker cannot restore would end the worker or its connection, again and again.
    """
    try:
        condition = pickle.loads(pickled)
    except (AttributeError, ImportError) as error:
        raise RuntimeError("the kernels and worlds of a sweep must be in modules that its executor's workers can "
                           f"import, but are not: {error}; move them to a module, or leave out the executor") from error
    return _computed(condition, runs, key)


def _computed(condition, runs, key, each_slice=lambda steps: None, thread=None):
    """The work of one task: carry out runs of a condition, and return their rewards and hits.

    key: of the condition, where the caller computes it, or None if they are not cached. A worker with other code or
    constants than the caller's is refused, since its results could differ. thread: holds the thread's last run, whose
    memory the next one reuses.
    """
    _check_key(condition, key)
    rewards, hits = new_bins(condition.world, len(runs), condition.steps)
    run = vars(thread).pop("run", None) if thread else None
    if run and not run._holds_values_of(embodied(condition.agent, condition.world)[0]):
        run = None  # frees its memory before another run allocates
    for k, *into in zip(runs, rewards, hits):
        run = finished_run(condition, k, *into, each_slice, run)
    if thread:
        thread.run = run
    _check_key(condition, key)
    return rewards, hits


def _check_key(condition, key):
    if key and condition.key != key:
        raise RuntimeError(f"worker {os.getpid()} must have the sources of neorl and the kernels and constants of the "
                           "sweep that it works for, but has others; restart it, and change nothing while it runs")


def finished_run(condition, k, rewards, hits, each_slice=lambda steps: None, after=None):
    """Carry out run k of a condition, and return it. Its rewards and hits are written into the arrays given.

    each_slice: called after every slice with its number of steps; an exception in it ends the run. after: see `Run`.
    """
    run = Run(condition.agent, condition.world, condition.seed, k, after=after)
    for until, later in (*condition.changes, (condition.steps, None)):
        while run.step < until:
            slice_steps = min(SLICE, until - run.step)
            run.advance(slice_steps, rewards, hits)
            each_slice(slice_steps)
        if later:
            run.change(later)
    return run


def usable_threads(agent, world):
    """The number of runs of an agent in a world to run in parallel: one per core, within nine tenths of free memory."""
    return min(fitting_runs(embodied(agent, world)[0]), cores())


def label(agent):
    """An agent in a few words, for a progress bar."""
    return ", ".join(f"{node.name} {'+'.join(f'N{n}' for n in node.resolutions)}" for node in agent.nodes)
