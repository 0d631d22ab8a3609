"""Independent learners run in parallel in a world, and their rewards."""

import os
import threading
from collections.abc import Callable
from concurrent.futures import CancelledError, ThreadPoolExecutor
from dataclasses import dataclass
from os import PathLike
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from neorl import checks
from neorl.agents.agent import Agent
from neorl.agents.memory import fitting_runs
from neorl.experiments import exchange
from neorl.experiments.run import SLICE, Run, bin_steps, new_bins
from neorl.worlds.world import World


@dataclass(frozen=True, eq=False)
class Result:
    """The rewards and hits of the runs of one condition.

    rewards: float32 (runs, bins), summed over bins of 0.2 s. hits: int16 (runs, bins, kinds), the number of things of
    each kind that were met, counted up to 32,767 in a bin; in WaterWorld green and red creeps.
    changes: (step, agent) pairs, the agents that the runs became at these steps.
    agent, world, steps, runs, seed: as in `simulate`.
    """

    agent: Agent
    world: World
    steps: int
    runs: int
    seed: int
    rewards: NDArray[np.float32]
    hits: NDArray[np.int16]
    changes: tuple[tuple[int, Agent], ...] = ()

    __eq__ = checks.equal_fields

    @property
    def seconds(self) -> float:
        """Simulated seconds per run."""
        return self.steps / self.world.fps

    @property
    def edges(self) -> NDArray[np.float64]:
        """float64 (bins + 1,): when the first bin begins and when each bin ends, in simulated seconds."""
        steps = np.arange(self.rewards.shape[1] + 1) * bin_steps(self.world)
        return np.minimum(steps, self.steps) / self.world.fps

    @property
    def time(self) -> NDArray[np.float64]:
        """float64 (bins,): when each bin ends, in simulated seconds."""
        return self.edges[1:]

    @property
    def totals(self) -> NDArray[np.float64]:
        """float64 (runs,): the accumulated reward of each run."""
        return self.rewards.sum(axis=1, dtype=float)

    def rate(self, begin: float = 0.0, end: float = 1.0) -> NDArray[np.float64]:
        """float64 (runs,): reward per simulated second between two fractions of the run, to the nearest bin.

        begin, end: the fractions, in [0, 1]. Raises ValueError for others, and for intervals shorter than a bin.
        """
        bins, seconds = self._stretch(begin, end)
        return self.rewards[:, bins].sum(axis=1, dtype=float) / seconds

    def hit_rate(self, begin: float = 0.0, end: float = 1.0) -> NDArray[np.float64]:
        """float64 (runs, kinds): things of each kind met per simulated second between two fractions of the run.

        begin, end: the fractions, in [0, 1]. Raises ValueError as `rate` does.
        """
        bins, seconds = self._stretch(begin, end)
        return self.hits[:, bins].sum(axis=1) / seconds

    def to_frame(self) -> Any:
        """A `pandas.DataFrame` with a row for each run and bin, sorted by run, then bin.

        Columns: "run", int64; "time", float64, when the bin ends, in simulated seconds; "reward", float32, the sum over
        the bin; and for each kind of thing, such as ``hits_green``, int16, the number met in the bin.
        Raises ImportError without pandas.
        """
        return exchange.to_frame(self)

    def to_xarray(self) -> Any:
        """An `xarray.Dataset` of dimensions run, time and kind, with coordinates of the same names.

        time: when each bin ends, in simulated seconds. rewards: float32 (run, time), the sum over the bin. hits: int16
        (run, time, kind), the number of things met in the bin. attributes: steps and runs; agent, world and changes as
        JSON texts (see `neorl.core.description`); seed and the version of neorl as texts.
        Raises ImportError without xarray, ValueError for an agent or a world that cannot be imported by name.
        """
        return exchange.to_xarray(self)

    def save(self, path: str | PathLike[str]) -> None:
        """Save to a NumPy npz file: the arrays rewards and hits, and the text about, a table in JSON.

        path: of the file, a string or a `pathlib.Path`; an existing file is replaced.
        Raises OSError if it cannot be written, ValueError for an agent or a world that cannot be imported by name
        (`neorl.core.description`).
        """
        exchange.save(self, path)

    @classmethod
    def load(cls, path: str | PathLike[str]) -> Self:
        """Load a result that `save` has written.

        path: of the file, a string or a `pathlib.Path`.
        Raises OSError if there is no such file, ValueError if it is damaged, of another kind or from a newer neorl, or
        if its agent or world cannot be imported.
        """
        return cls(**exchange.load(path))

    def _stretch(self, begin, end):
        checks.real("begin", begin, 0, 1)
        checks.real("end", end, 0, 1)
        first, last = (round(share * self.rewards.shape[1]) for share in (begin, end))
        if first >= last:
            raise checks.error("end", f"a share at least a bin after begin, {begin!r}", end)
        return slice(first, last), self.edges[last] - self.edges[first]


def simulate(agent: Agent, world: World, *, steps: int, runs: int, seed: int = 0,
             changes: tuple[tuple[int, Agent], ...] = (), threads: int | None = None,
             progress: bool | Callable[[int, int], object] = True) -> Result:
    """Run `runs` independent learners for `steps` steps each, one core per run, and return their `Result`.

    agent: an `Agent`. world: a `neorl.World`. steps, runs: integers ≥ 1.
    seed: integer ≥ 0; run k is the same for any number of runs and threads.
    changes: (step, agent) pairs in order of time: from that step on every learner is that agent, see
        `neorl.Run.change`.
    threads: the number of runs in parallel, an integer ≥ 1; by default one per core, as far as they fit into the free
        memory.
    progress: show a progress bar; or a function (done, total), which is called now and then with the number of steps
        that all runs together have taken, and will take. It is called from threads, but never twice at once.
    Raises ValueError for a bad argument, MemoryError if a single run does not fit into the free memory.
    """
    checks.instance("agent", agent, Agent)
    checks.instance("world", world, World)
    steps, runs = checks.integer("steps", steps, at_least=1), checks.integer("runs", runs, at_least=1)
    seed = checks.integer("seed", seed, at_least=0)
    changes = checked_changes(changes, steps)
    usable = min(usable_threads(each, world) for each in (agent, *(later for _, later in changes)))
    threads = usable if threads is None else checks.integer("threads", threads, at_least=1)
    rewards, hits = new_bins(world, runs, steps)
    stop, before = threading.Event(), threading.local()
    with progress_bar(runs * steps, label(agent), progress) as bar:

        def each_slice(lived):
            if stop.is_set():
                raise CancelledError
            bar.update(lived)

        def live_one(k):
            before.run = live(agent, world, steps, seed, k, changes, rewards[k], hits[k], each_slice,
                              getattr(before, "run", None))

        with ThreadPoolExecutor(min(threads, runs)) as pool:
            try:
                for finished in [pool.submit(live_one, k) for k in range(runs)]:
                    finished.result()
            except BaseException:
                stop.set()
                pool.shutdown(cancel_futures=True)
                raise
    return Result(agent, world, steps, runs, seed, rewards, hits, changes)


def live(agent, world, steps, seed, k, changes, rewards, hits, each_slice, after=None):
    """Carry out run k, and return it. Its rewards and hits are written into the arrays given.

    each_slice: called after every slice with its number of steps; an exception in it ends the run. after: see `Run`.
    """
    run = Run(agent, world, seed, k, after=after)
    for until, later in (*changes, (steps, None)):
        while run.step < until:
            slice_steps = min(SLICE, until - run.step)
            run.advance(slice_steps, rewards, hits)
            each_slice(slice_steps)
        if later:
            run.change(later)
    return run


def progress_bar(steps, name, shown):
    """A progress bar over steps, with the time left at the pace so far, or a `Report` to a function.

    Raises ValueError unless `shown`, the caller's argument `progress`, is True, False or a function.
    """
    from tqdm import tqdm

    if callable(shown):
        return Report(shown, steps)
    try:
        disable = not checks.flag("progress", shown)
    except ValueError:
        raise ValueError("progress must be True, False or a function that takes the steps done and their total, but is "
                         f"{checks.shown(shown)}") from None
    return tqdm(total=steps, desc=name, unit="step", unit_scale=True, leave=False, disable=disable)


class Report:
    """A progress bar whose display is a function (done, total) of the user's."""

    def __init__(self, function, total):
        self.function, self.total, self.done, self.lock = function, total, 0, threading.Lock()

    def __enter__(self):
        return self

    def __exit__(self, *error):
        pass

    def update(self, steps):
        """Count more steps, and call the function."""
        with self.lock:
            self.done += steps
            self.function(self.done, self.total)


def label(agent):
    """An agent in a few words, for a progress bar."""
    return ", ".join(f"{node.name} {'+'.join(f'N{n}' for n in node.resolutions)}" for node in agent.nodes)


def checked_changes(changes, steps):
    """`changes` as a tuple. Raises ValueError unless they are (step, agent) pairs in order, within the run."""
    pairs, least = [], 0
    for pair in checks.several("changes", changes):
        if len(checks.several("changes", pair)) != 2:
            raise checks.error("changes", "pairs (step, agent)", pair)
        least = checks.integer("step of a change", pair[0], at_least=least, at_most=steps)
        pairs.append((least, checks.instance("agent of a change", pair[1], Agent)))
    return tuple(pairs)


def usable_threads(agent, world):
    """The number of runs of an agent in a world to run in parallel: one per core, within nine tenths of free memory."""
    cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count()
    return min(fitting_runs(agent, world), cores)
