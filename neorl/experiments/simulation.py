"""Independent learners in WaterWorld: one run, or many side by side.

Run k of a seed draws its tank from ``SeedSequence(seed).spawn(k + 1)[k]`` and its choices from the first child of
that, so it is the same run alone or among others, on one core or on several.
"""

import os
import threading
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import psutil
from tqdm import tqdm

from neorl import checks
from neorl.agents.agent import Agent
from neorl.agents.compile import compiled
from neorl.core.horde import N_EVENTS, as_vectors
from neorl.core.plan import new_memory
from neorl.core.stream import new_stream
from neorl.worlds.rollout import begin_tracks, rollout
from neorl.worlds.waterworld import WaterWorld, check_state

BIN_SECONDS = 0.2
CACHE_LINES = 128  # bytes; two lines, because processors fetch them in pairs
PAGE = 4_096
SLICE = 10_000  # steps between two looks at the progress bar and at the keyboard
# What `Memory` has of each map, by the array of a plan that says where it begins.
OF_A_MAP = {"first": ("q",), "first_cell": ("known",),
            "first_track": ("cell", "events", "trace_cell", "trace_rates", "trace_count", "remembered_count"),
            "first_trace": ("remembered", "remembered_at", "strength", "trace_weight", "trace_worth")}


class Output(NamedTuple):
    """What a node puts out (paper C, figure 3), as of the agent's last choice that was not drawn."""

    q: np.ndarray  # float64 (4,): the value of each action
    desire: np.ndarray  # float64 (2,): Σ |w| (Q_E − Q_W, Q_S − Q_N) over its elements
    valence: float  # Σ w


class Run:
    """One learner in one tank, from its first step on.

    agent, world: what is chosen. memory, state: what changes, as flat arrays (see `Memory` and `WaterWorldState`).
    after: a run of the same agent that is over; its values are overwritten.
    """

    def __init__(self, agent, world, seed=0, run=0, after=None):
        checks.instance("agent", agent, Agent)
        checks.instance("world", world, WaterWorld)
        sequence = np.random.SeedSequence(checks.integer("seed", seed, at_least=0),
                                          spawn_key=(checks.integer("run", run, at_least=0),))
        self.agent, self.world = agent, world
        self.plan = kept_apart(compiled(agent, world))
        self.state = kept_apart(world.reset(sequence))
        old = after.memory if after and after.agent == agent else None
        self.memory = kept_apart(new_memory(self.plan, new_stream(sequence.spawn(1)[0]), world.n_creeps, old))
        self.step = 0
        self._contacts = on_lines_of_its_own(np.zeros(world.n_creeps, np.int8))
        begin_tracks(self.plan, self.memory, self.state)

    def advance(self, steps, rewards=None, hits=None):
        """Live `steps` more steps; returns the reward that they brought.

        rewards: float32 (bins,) and hits: int16 (bins, 2), if given, take the rewards and the green and red creeps
        of each 0.2 s since the run began. Raises ValueError if they do not fit, or if the state is not finite.
        """
        check_state(self.state, self.world)
        last = self.step + checks.integer("steps", steps, at_least=0)
        bin_length = bin_steps(self.world)
        if rewards is None:  # a single bin, which nobody looks at
            bin_length, rewards, hits = last + 1, np.zeros(1, np.float32), np.zeros((1, 2), np.int16)
        shortest = -(-last // bin_length)
        for name, given, kind, beside in (("rewards", rewards, np.float32, ()), ("hits", hits, np.int16, (2,))):
            if given.dtype != kind or len(given) < shortest or given.shape[1:] != beside:
                raise ValueError(f"{name} is {given.dtype} {given.shape}, allowed is {kind.__name__} from "
                                 f"{(shortest, *beside)} on")
        with np.errstate(over="ignore"):
            brought = rollout(self.plan, self.memory, self.world.rules, self.state, self._contacts, self.step, last,
                           bin_length, rewards, hits)
        self.step = last
        return brought

    def change(self, agent):
        """Go on as another agent, which keeps what this one knows.

        A map keeps its values, its active cells and what led to them if both agents have it, in a node of the same
        name, and as much trace. All else begins anew; so do the desires of the step before.
        Raises ValueError unless it is an `Agent`.
        """
        checks.instance("agent", agent, Agent)
        plan = kept_apart(compiled(agent, self.world))
        memory = kept_apart(new_memory(plan, self.memory.stream, self.world.n_creeps))
        begin_tracks(plan, memory, self.state)
        old = {key: m for m, key in enumerate(_map_keys(self.agent))}
        for m, key in enumerate(_map_keys(agent)):
            if key in old:
                for firsts, names in OF_A_MAP.items():
                    begin, end = getattr(plan, firsts)[m : m + 2]
                    begin_old, end_old = getattr(self.plan, firsts)[old[key] : old[key] + 2]
                    for name in names:
                        new, kept = getattr(memory, name), getattr(self.memory, name)
                        width = len(new) // getattr(plan, firsts)[-1]
                        new[width * begin : width * end] = kept[width * begin_old : width * end_old]
        for name in ("last_event", "activity", "attended"):
            getattr(memory, name)[:] = getattr(self.memory, name)
        self.agent, self.plan, self.memory = agent, plan, memory

    def output(self, name):
        """The `Output` of the node of that name. Raises ValueError if there is none."""
        checks.one_of("name", name, tuple(node.name for node in self.agent.nodes))
        inputs = [e for e, desire in enumerate(self.agent.desires) if desire.target == name]
        pull, worth = self.memory.pull[inputs], self.memory.worth[inputs]
        return Output(pull.sum(axis=0), np.sign(worth) @ as_vectors(pull), float(worth.sum()))

    def q(self, index=0):
        """The values of one of the agent's maps: float32 (cells, 4, cells), q[state, action, goal], a view."""
        first, cells = self.plan.first[index], self.agent.maps[index].cells
        return self.memory.q[first : first + N_EVENTS * cells**2].reshape(cells, N_EVENTS, cells)


def _map_keys(agent):
    rule = agent.learning
    return [(node.name, each, rule.trace, rule.memory > 0) for node in agent.nodes for each in node.maps]


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
    changes: (step, agent) pairs, what the runs became when.
    """

    agent: Agent
    world: WaterWorld
    steps: int
    runs: int
    seed: int
    rewards: np.ndarray
    hits: np.ndarray
    changes: tuple[tuple[int, Agent], ...] = ()

    @property
    def seconds(self):
        """Simulated seconds a run."""
        return self.steps / self.world.fps

    @property
    def edges(self):
        """float64 (bins + 1,): when the first bin begins and each bin ends, in simulated seconds."""
        steps = np.arange(self.rewards.shape[1] + 1) * bin_steps(self.world)
        return np.minimum(steps, self.steps) / self.world.fps

    @property
    def time(self):
        """float64 (bins,): when each bin ends, in simulated seconds."""
        return self.edges[1:]

    @property
    def totals(self):
        """float64 (runs,): the reward that each run accumulated."""
        return self.rewards.sum(axis=1, dtype=float)

    def rate(self, begin=0.0, end=1.0):
        """float64 (runs,): reward per simulated second between two shares of the run in [0, 1], to the nearest bin.

        Raises ValueError for other shares, and for stretches shorter than a bin.
        """
        bins, seconds = self._stretch(begin, end)
        return self.rewards[:, bins].sum(axis=1, dtype=float) / seconds

    def hit_rate(self, begin=0.0, end=1.0):
        """float64 (runs, 2): green and red creeps taken per simulated second between two shares, as in `rate`."""
        bins, seconds = self._stretch(begin, end)
        return self.hits[:, bins].sum(axis=1) / seconds

    def _stretch(self, begin, end):
        checks.real("begin", begin, 0, 1)
        checks.real("end", end, 0, 1)
        first, last = (round(share * self.rewards.shape[1]) for share in (begin, end))
        if first >= last:
            raise ValueError(f"end is {end!r}, allowed are shares at least a bin after begin, {begin!r}")
        return slice(first, last), self.edges[last] - self.edges[first]


def simulate(agent, world, *, steps, runs, seed=0, changes=(), threads=None, progress=True):
    """Let `runs` independent learners live `steps` steps each, one core a run, and return their `Result`.

    seed: integer ≥ 0; run k is the same for any number of runs and threads.
    changes: (step, agent) pairs in order of time: from that step on every learner is another agent, see `Run.change`.
    threads: how many runs go side by side; by default as many as there are cores and as fit into the free memory.
    progress: show a progress bar.
    Raises ValueError for a bad argument, MemoryError if a single run does not fit into the free memory.
    """
    checks.instance("agent", agent, Agent)
    checks.instance("world", world, WaterWorld)
    checks.integer("steps", steps, at_least=1)
    checks.integer("runs", runs, at_least=1)
    checks.integer("seed", seed, at_least=0)
    changes = checked_changes(changes, steps)
    usable = min(usable_threads(each) for each in (agent, *(later for _, later in changes)))
    threads = usable if threads is None else checks.integer("threads", threads, at_least=1)
    rewards, hits = new_bins(world, runs, steps)
    label = ", ".join(f"{node.name} {'+'.join(f'N{n}' for n in node.resolutions)}" for node in agent.nodes)
    stop, before = threading.Event(), threading.local()

    def live_one(k, bar):
        run = before.run = Run(agent, world, seed, k, after=getattr(before, "run", None))
        for until, later in (*changes, (steps, None)):
            while run.step < until and not stop.is_set():
                slice_steps = min(SLICE, until - run.step)
                run.advance(slice_steps, rewards[k], hits[k])
                bar.update(slice_steps)
            if later:
                run.change(later)

    with tqdm(total=runs * steps, desc=label, unit="step", unit_scale=True, leave=False, disable=not progress) as bar:
        with ThreadPoolExecutor(min(threads, runs)) as pool:
            try:
                for finished in [pool.submit(live_one, k, bar) for k in range(runs)]:
                    finished.result()
            except BaseException:
                stop.set()
                pool.shutdown(cancel_futures=True)
                raise
    return Result(agent, world, steps, runs, seed, rewards, hits, changes)


def checked_changes(changes, steps):
    """`changes` as a tuple. Raises ValueError unless they are (step, agent) pairs in order, within the run."""
    changes = tuple(checks.several("changes", pair) for pair in checks.several("changes", changes))
    least = 0
    for pair in changes:
        if len(pair) != 2:
            raise ValueError(f"changes has {pair!r}, allowed are pairs (step, agent)")
        least = checks.integer("step of a change", pair[0], at_least=least, at_most=steps)
        checks.instance("agent of a change", pair[1], Agent)
    return changes


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
