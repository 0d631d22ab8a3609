"""Many conditions at a time, on this machine's cores or on any executor, with the same results to the last bit.

1. A condition is a task of its own: one core lives its runs, one after the other, and hands back what they brought.
2. What is finished is kept on disk at once, by whoever called `sweep`; what is on disk already is not run again.
3. A task that fails, by itself or with its worker, is run again when the others are done, up to three times in all.
   An executor that breaks as a whole is replaced by the cores of this machine.
"""

import os
import warnings
from concurrent.futures import BrokenExecutor, ThreadPoolExecutor, as_completed

from tqdm import tqdm

from neorl import checks
from neorl.agents.compile import n_values
from neorl.experiments.cache import Condition, save, simulate_once, source_digest
from neorl.experiments.simulation import simulate, usable_threads
from neorl.files import read_checked

ATTEMPTS = 3


def sweep(conditions, executor=None, progress=True):
    """Compute independent conditions, and return an iterator of their `Result`s, in order.

    conditions: `Condition`s. All are computed before this returns; each result is read from disk when its turn comes.
    executor: any `concurrent.futures.Executor` whose workers can import this version of neorl, such as that of a
        process pool, of `dask.distributed.Client.get_executor()`, or of MPI; by default as many threads as there are
        cores and as fit into memory. It is left open.
    progress: show a progress bar, with the time that is left at the pace so far.

    Raises ValueError for a bad argument, MemoryError if a single run does not fit into the free memory of this machine,
    RuntimeError for conditions that have failed three times, after all others are kept; the next call goes on there.
    """
    conditions = checks.several("conditions", conditions)
    for condition in conditions:
        checks.instance("condition", condition, Condition)
    if not hasattr(executor, "submit") and executor is not None:
        raise ValueError(f"executor is {executor!r}, allowed are executors of concurrent.futures and None")
    waiting = [condition for condition in dict.fromkeys(conditions) if read_checked(condition.path) is None]
    # The large ones come first and take over each other's memory.
    waiting.sort(key=lambda condition: -n_values(condition.agent, condition.world))
    total = sum(condition.steps * condition.runs for condition in waiting)
    with tqdm(total=total, unit="step", unit_scale=True, desc="sweep", leave=False, disable=not progress) as bar:
        for _ in range(ATTEMPTS):
            errors = _run(waiting, executor, bar) if waiting else {}
            waiting = list(errors)
            if any(isinstance(error, BrokenExecutor) for error in errors.values()):
                warnings.warn(f"{executor!r} is broken; this machine's cores do the rest", RuntimeWarning, stacklevel=2)
                executor = None
    if errors:
        condition, error = next(iter(errors.items()))
        raise RuntimeError(f"{len(errors)} of {len(conditions)} conditions have failed {ATTEMPTS} times, such as "
                           f"{condition}: {error!r}") from error
    return (simulate_once(**condition.choices) for condition in conditions)


def _run(conditions, executor, bar):
    """Compute conditions, and return those that failed, {condition: exception}."""
    if executor is None:
        lives = [(agent, each.world) for each in conditions
                 for agent in (each.agent, *(later for _, later in each.changes))]
        with ThreadPoolExecutor(usable_threads(*max(lives, key=lambda life: n_values(*life)))) as cores:
            return _run(conditions, cores, bar)
    tasks, errors = {}, {}
    try:
        for condition in conditions:
            tasks[executor.submit(_live, condition, source_digest())] = condition
    except BrokenExecutor as error:
        errors = dict.fromkeys(conditions[len(tasks) :], error)
    try:
        for task in as_completed(tasks):
            condition = tasks.pop(task)
            try:
                save(condition, task.result())
            except Exception as error:
                errors[condition] = error
            else:
                bar.update(condition.steps * condition.runs)
    finally:
        for task in tasks:  # none, unless somebody has interrupted
            task.cancel()
    return errors


def _live(condition, source):
    """What a worker does. Another version of the code than the caller's would bring other results."""
    if source_digest() != source:
        raise RuntimeError(f"worker {os.getpid()} has other sources of neorl than the sweep that it works for")
    return simulate(**condition.choices, threads=1, progress=False)
