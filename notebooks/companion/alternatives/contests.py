"""How the contestants of the page on alternatives run, what they earn, and the runs that are stored for the page.

1. A *contestant* is two kernels, ``act(setting, memory, state, rules)``, which returns the number of an action, and
   ``learn(setting, memory, state, rules, action, reward, restarted)``, called after the world's step. `state` is the
   `WaterWorldState` and `rules` are its rules; a learner reads only the scene in it, a controller all of it.
2. When the last green creep is captured the board is reset before ``learn`` is called, with `restarted` true, and
   learning continues.
3. A table of stored runs has a row for each run, with its reward in each minute of `MINUTE` steps.
"""

import csv
import functools
import io
from pathlib import Path
from time import thread_time
from typing import NamedTuple

import numpy as np

from companion.shared.runs import each_run
from companion.thesis.reading import TO_THE_LETTER, conditions
from neorl.agents.embodiment import embodied
from neorl.common.files import write_whole
from neorl.core.building import n_bytes
from neorl.core.stream import new_stream
from neorl import Run, WaterWorld
from neorl.custom import execute
from neorl.kernels.annotations import arrays
from neorl.kernels.kernel import inlined, kernel
from neorl.worlds import waterworld

BOARDS = {creeps: WaterWorld(n_creeps=creeps) for creeps in (3, 8)}
PAPER_A = conditions(TO_THE_LETTER, 1, 1)["layers"].world
FPS, BINS = BOARDS[3].fps, 50
TIMED_STEPS = 20_000
MINUTE = 3_000  # steps
FOLDER = Path(__file__).parent
TABLES = FOLDER / "long_runs.csv", FOLDER / "deep_runs.csv"
DEFAULTS = FOLDER / "deep_defaults.csv"  # of deep learners with nothing tuned, on `PAPER_A`


class Contestant(NamedTuple):
    """A learner or controller: its kernels, their setting, and a function (world, stream) that makes its memory."""

    act: object
    learn: object
    setting: tuple
    new_memory: object


class Earned(NamedTuple):
    """What the runs of one contestant earned, and what they cost."""

    rewards: np.ndarray  # float64 (runs, bins)
    steps: int  # per run
    seconds: float  # to compute a step on one core, the world's part included
    kilobytes: float  # of its memory
    identity: tuple = ()  # see `identity`; of agents of neoRL and of stored runs it is empty

    @property
    def edges(self):
        """The steps at which bins begin and end: float64 (bins + 1,)."""
        return np.linspace(0, self.steps, self.rewards.shape[1] + 1).round()

    @property
    def rates(self):
        """Reward per simulated second in each bin: float64 (runs, bins)."""
        return self.rewards / (np.diff(self.edges) / FPS)

    @property
    def of_minutes(self):
        """Reward in each minute of `MINUTE` steps, of a run with `bins_of` bins: float64 (runs, minutes)."""
        return self.rewards.reshape(len(self.rewards), self.steps // MINUTE, -1).sum(axis=-1)

    def rate(self, begin=0.0, end=1.0):
        """Reward per simulated second between two fractions of the run: float64 (runs,)."""
        return self._between(begin * self.steps, end * self.steps)

    def steps_to(self, level):
        """Steps until the rate over the last tenth of a run first reaches a level: (runs,), infinite if never."""
        window = self.steps / 10
        ends = self.edges[self.edges >= window]
        made = np.array([self._between(end - window, end) >= level for end in ends])
        return np.where(made.any(axis=0), ends[made.argmax(axis=0)], np.inf)

    def _between(self, begin, end):
        """Reward per simulated second between two steps, which may lie within a bin: float64 (runs,)."""
        sums = np.pad(self.rewards.cumsum(axis=1), ((0, 0), (1, 0)))
        first, last = (np.array([np.interp(at, self.edges, run) for run in sums]) for at in (begin, end))
        return (last - first) / ((end - begin) / FPS)


def identity(contestant, world):
    """What runs in a world, but for its random numbers: its kernels, its setting and the world, a tuple."""
    return *contestant[:3], world


def run_contestant(contestant, world, *, steps, runs, bins=BINS, seed=0):
    """Run a contestant in a `WaterWorld`: `Earned`.

    Run k has the world of ``neorl.Run(agent, world, seed, k)``; the contestant has a random stream of its own.
    """
    loop = _loop_of(contestant.act, contestant.learn)
    edges = np.linspace(0, steps, bins + 1).round().astype(int)
    rewards, seconds, sizes = np.zeros((runs, bins)), np.zeros(runs), np.zeros(runs, int)

    def run_one(run, edges=edges):
        state = world.reset(np.random.SeedSequence(seed, spawn_key=(run,)))
        memory = contestant.new_memory(world, new_stream(np.random.SeedSequence(seed, spawn_key=(run, 1))))
        sizes[run] = sum(each.nbytes for each in arrays(memory).values())
        began = thread_time()
        execute(loop, contestant.setting, memory, state, world.rules, edges, rewards[run])
        seconds[run] = thread_time() - began

    run_one(0, np.zeros_like(edges))  # compiles the kernel before calls are timed
    each_run(run_one, runs)
    return Earned(rewards, steps, float(np.median(seconds)) / steps, int(sizes[0]) / 1e3,
                  identity(contestant, world))


@functools.cache
def _loop_of(act, learn):
    act, learn, step = inlined(act), inlined(learn), inlined(waterworld.step)

    @kernel
    def loop(setting, memory, state, rules, edges, rewards):
        for part in range(rewards.shape[0]):
            for _ in range(edges[part], edges[part + 1]):
                action = act(setting, memory, state, rules)
                reward, done = step(state, rules, action)
                if done:
                    waterworld.reset(state, rules)
                learn(setting, memory, state, rules, action, reward, done)
                rewards[part] += reward

    return loop


@kernel
def learn_nothing(setting, memory, state, rules, action, reward, restarted):
    """Do nothing: a controller does not learn."""


def bins_of(steps):
    """The number of parts of a run on the page: `BINS` or more, as many in each minute."""
    minutes = max(1, steps // MINUTE)
    return minutes * -(-BINS // minutes)


def of_result(result, bins=None):
    """What an agent of neorl earned in a `WaterWorld`: `Earned`."""
    bins = bins or bins_of(result.steps)
    edges = np.linspace(0, result.steps, bins + 1).round()
    sums = np.pad(result.rewards.cumsum(axis=1, dtype=float), ((0, 0), (1, 0)))
    rewards = np.diff(np.array([np.interp(edges, result.edges * FPS, run) for run in sums]), axis=1)
    run, timed = Run(result.agent, result.world), min(result.steps, TIMED_STEPS)
    run.advance(1)
    began = thread_time()
    run.advance(timed)
    record, _ = embodied(result.agent, result.world)
    return Earned(rewards, result.steps, (thread_time() - began) / timed, n_bytes(record) / 1e3)


class Row(NamedTuple):
    """A row of a table of stored runs."""

    method: str
    creeps: int
    steps: int
    run: int
    seconds: float  # of processor time for the run
    kilobytes: float
    rewards: np.ndarray  # in each minute: float64 (minutes,), whole numbers


def read(*paths):
    """The rows of tables of stored runs, by default of the page's: a list of `Row`."""
    rows = []
    for path in paths or TABLES:
        with open(path, newline="") as file:
            rows += [Row(row["method"], int(row["creeps"]), int(row["steps"]), int(row["run"]),
                         float(row["seconds"]), float(row["kilobytes"]), np.array(row["rewards"].split(), float))
                     for row in csv.DictReader(file)]
    return rows


def write(path, rows):
    """Write rows to a table of stored runs, which need not exist; they replace those of the same runs."""
    kept = {row[:4]: row for row in [*(read(path) if Path(path).exists() else ()), *rows]}
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows([Row._fields] + [
        [*row[:4], f"{row.seconds:.3g}", f"{row.kilobytes:.4g}", " ".join(f"{each:.0f}" for each in row.rewards)]
        for row in kept.values()])
    write_whole(path, text.getvalue().encode())


def stored(rows, names, creeps, steps):
    """The first `steps` of the stored runs of some contestants, whole minutes: {name: `Earned`}.

    The time of a step is the median over all rows of a contestant on the board.
    """
    found, minutes = {}, steps // MINUTE
    for name in names:
        own = [row for row in rows if (row.method, row.creeps) == (name, creeps)]
        long_enough = sorted((row for row in own if len(row.rewards) >= minutes), key=lambda row: row.run)
        if long_enough:
            seconds = float(np.median([row.seconds / row.steps for row in own]))
            found[name] = Earned(np.array([row.rewards[:minutes] for row in long_enough]), minutes * MINUTE,
                                 seconds, long_enough[0].kilobytes)
    return found
