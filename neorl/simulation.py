"""Independent learners in WaterWorld: one run, or many side by side.

Run k of a seed draws its tank from ``SeedSequence(seed).spawn(k + 1)[k]`` and its choices from the first child of
that, so it is the same run alone or among others, on one core or on several.
"""

import os
import threading
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

import numpy as np
import psutil
from tqdm import tqdm

from neorl import checks
from neorl.agent import Agent, compiled, new_memory
from neorl.horde import N_EVENTS
from neorl.life import live, settle
from neorl.stream import new_stream
from neorl.waterworld import WaterWorld, check_state

BIN_SECONDS = 0.2
CACHE_LINES = 128  # bytes; two lines, because processors fetch them in pairs
PAGE = 4_096
SLICE = 10_000  # steps between two looks at the progress bar and at the keyboard


class Run:
    """One learner in one tank, from its first step on.

    agent, world: what is chosen. memory, state: what changes, as flat arrays (see `Memory` and `WaterWorldState`).
    """

    def __init__(self, agent, world, seed=0, run=0):
        checks.instance("agent", agent, Agent)
        checks.instance("world", world, WaterWorld)
        sequence = np.random.SeedSequence(checks.integer("seed", seed, at_least=0),
                                          spawn_key=(checks.integer("run", run, at_least=0),))
        self.agent, self.world = agent, world
        self.plan = kept_apart(compiled(agent, world.width))
        self.state = kept_apart(world.reset(sequence))
        self.memory = kept_apart(new_memory(agent, new_stream(sequence.spawn(1)[0])))
        self.step = 0
        self._contacts = on_lines_of_its_own(np.zeros(world.n_creeps, np.int8))
        settle(self.plan, self.memory, self.state)

    def advance(self, steps, rewards=None, hits=None):
        """Live `steps` more steps; returns the reward that they brought.

        rewards: float32 (bins,) and hits: int16 (bins, 2), if given, take the rewards and the green and red creeps
        of each 0.2 s since the run began. Raises ValueError if they do not fit, or if the state is not finite.
        """
        check_state(self.state, self.world)
        last = self.step + checks.integer("steps", steps, at_least=0)
        if rewards is None:
            rewards, hits = (bins[0] for bins in new_bins(self.world, 1, last))
        shortest = -(-last // bin_steps(self.world))
        for name, given, kind, beside in (("rewards", rewards, np.float32, ()), ("hits", hits, np.int16, (2,))):
            if given.dtype != kind or len(given) < shortest or given.shape[1:] != beside:
                raise ValueError(f"{name} is {given.dtype} {given.shape}, allowed is {kind.__name__} from "
                                 f"{(shortest, *beside)} on")
        with np.errstate(over="ignore"):
            brought = live(self.plan, self.memory, self.world.rules, self.state, self._contacts, self.step, last,
                           bin_steps(self.world), rewards, hits)
        self.step = last
        return brought

    def q(self, index=0):
        """The values of one map: float32 (cells, 4, cells), q[state, action, goal], a view."""
        first, cells = self.plan.first[index], self.agent.maps[index].cells
        return self.memory.q[first : first + N_EVENTS * cells**2].reshape(cells, N_EVENTS, cells)


def kept_apart(fields):
    """The same named tuple, its small arrays on cache lines of their own.

    Two cores that write to one line have to take turns, which made runs side by side a sixth slower.
    """
    return type(fields)(*(on_lines_of_its_own(value) if isinstance(value, np.ndarray) and value.nbytes < PAGE else value
                          for value in fields))


def on_lines_of_its_own(array):
    buffer = np.zeros(array.nbytes + 2 * CACHE_LINES, np.uint8)
    copy = buffer[CACHE_LINES : CACHE_LINES + array.nbytes].view(array.dtype).reshape(array.shape)
    copy[...] = array
    return copy


@dataclass(frozen=True)
class Result:
    """What the runs of one condition brought.

    rewards: float32 (runs, bins), summed over bins of 0.2 s. hits: int16 (runs, bins, 2), green and red creeps.
    """

    agent: Agent
    world: WaterWorld
    steps: int
    runs: int
    seed: int
    rewards: np.ndarray
    hits: np.ndarray

    @property
    def seconds(self):
        """Simulated seconds a run."""
        return self.steps / self.world.fps

    @property
    def time(self):
        """float64 (bins,): when each bin ends, in simulated seconds."""
        ends = np.arange(1, self.rewards.shape[1] + 1) * bin_steps(self.world)
        return np.minimum(ends, self.steps) / self.world.fps

    @property
    def totals(self):
        """float64 (runs,): the reward that each run accumulated."""
        return self.rewards.sum(axis=1, dtype=float)

    def rate(self, begin=0.0, end=1.0):
        """float64 (runs,): reward per simulated second between two shares of the run in [0, 1], to the nearest bin.

        Raises ValueError for other shares, and for stretches shorter than a bin.
        """
        checks.real("begin", begin, 0, 1)
        checks.real("end", end, 0, 1)
        first, last = (round(share * self.rewards.shape[1]) for share in (begin, end))
        if first >= last:
            raise ValueError(f"end is {end!r}, allowed are shares at least a bin after begin, {begin!r}")
        edges = np.concatenate([[0.0], self.time])
        return self.rewards[:, first:last].sum(axis=1, dtype=float) / (edges[last] - edges[first])


def simulate(agent, world, *, steps, runs, seed=0, threads=None, progress=True):
    """Let `runs` independent learners live `steps` steps each, one core a run, and return their `Result`.

    seed: integer ≥ 0; run k is the same for any number of runs and threads.
    threads: how many runs go side by side; by default as many as there are cores and as fit into the free memory.
    progress: show a progress bar.
    Raises ValueError for a bad argument, MemoryError if a single run does not fit into the free memory.
    """
    checks.instance("agent", agent, Agent)
    checks.instance("world", world, WaterWorld)
    checks.integer("steps", steps, at_least=1)
    checks.integer("runs", runs, at_least=1)
    checks.integer("seed", seed, at_least=0)
    usable = usable_threads(agent)
    threads = usable if threads is None else checks.integer("threads", threads, at_least=1)
    rewards, hits = new_bins(world, runs, steps)
    label = "+".join(f"N{nres_map.resolution}" for nres_map in agent.maps)
    stop = threading.Event()

    def live_one(k, bar):
        run = Run(agent, world, seed, k)
        while run.step < steps and not stop.is_set():
            slice_steps = min(SLICE, steps - run.step)
            run.advance(slice_steps, rewards[k], hits[k])
            bar.update(slice_steps)

    with tqdm(total=runs * steps, desc=label, unit="step", unit_scale=True, leave=False, disable=not progress) as bar:
        with ThreadPoolExecutor(min(threads, runs)) as pool:
            try:
                for finished in [pool.submit(live_one, k, bar) for k in range(runs)]:
                    finished.result()
            except BaseException:
                stop.set()
                pool.shutdown(cancel_futures=True)
                raise
    return Result(agent, world, steps, runs, seed, rewards, hits)


def usable_threads(agent):
    """How many runs of an agent go side by side: a core each, within nine tenths of the memory that is free."""
    free = psutil.virtual_memory().available
    fitting = int(0.9 * free // (4 * agent.n_values))
    if fitting == 0:
        needed = agent.n_values * 4 / 2**30
        raise MemoryError(f"a run of this agent needs {needed:.1f} GiB of memory, {free / 2**30:.1f} are free")
    return min(fitting, len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count())


def bin_steps(world):
    """Steps in a bin of 0.2 s, at least one."""
    return max(1, round(BIN_SECONDS * world.fps))


def new_bins(world, runs, steps):
    bins = -(-steps // bin_steps(world))
    return np.zeros((runs, bins), np.float32), np.zeros((runs, bins, 2), np.int16)
