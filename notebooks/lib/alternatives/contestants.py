"""The contestants of the page, and the rewards that each earns on a board of 3 or 8 creeps.

All observe the agent's position and velocity, and the position and kind of every creep. Deep learners also observe the
creeps' velocities; controllers and the planner know the rules of the world. All choose among five actions at every
step, except agents of neorl, which have no action for doing nothing.
"""

from dataclasses import dataclass
from time import thread_time

import numpy as np

from lib.alternatives import controllers
from lib.alternatives.living import BOARDS, live
from lib.alternatives.search import best_settings
from lib.alternatives.stored import FOLDER, METHODS, MINUTE, read_runs
from lib.alternatives.tabular_learners import TABULAR
from neorl import checks
from neorl.agents import papers
from neorl.agents.beyond import forager
from neorl.agents.compile import n_bytes
from neorl.evidence.priors import TO_THE_LETTER
from neorl.evidence.reading import PRIMES, Reading, networks
from neorl.evidence.report import CALIBRATED, LETTER
from neorl.experiments.cache import Condition
from neorl.experiments.run import Run
from neorl.experiments.sweeping import sweep

CHANCE, THESIS, BEYOND, TABLES, DEEP, PHYSICS = (
    "chance", "the thesis's agents", "beyond the thesis", "tabular learners", "deep learners", "given the physics")
BINS = 50  # per run
TIMED_STEPS = 20_000
PLANNED = 1 / 30  # length of the planner's runs, as a share of the others'
READINGS = {LETTER: TO_THE_LETTER, CALIBRATED: Reading()}


@dataclass(frozen=True)
class Earned:
    """The rewards of all runs of one contestant.

    kind: one of the constants of this module. edges: (bins + 1,), the steps at which bins begin and end.
    rewards: float64 (runs, bins). seconds: time to compute a step on one core, the world's part included.
    kilobytes: size of its memory.
    """

    kind: str
    edges: np.ndarray
    rewards: np.ndarray
    seconds: float
    kilobytes: float

    @property
    def runs(self):
        """Number of runs."""
        return len(self.rewards)

    @property
    def steps(self):
        """Steps per run."""
        return int(self.edges[-1])

    @property
    def rates(self):
        """Reward per simulated second in each bin: float64 (runs, bins)."""
        return self.rewards / (np.diff(self.edges) / BOARDS[3].fps)

    def rate(self, begin, end):
        """Reward per simulated second between two steps of a run, which may lie within a bin: float64 (runs,)."""
        sums = np.pad(self.rewards.cumsum(axis=1), ((0, 0), (1, 0)))
        first, last = (np.array([np.interp(at, self.edges, run) for run in sums]) for at in (begin, end))
        return (last - first) / ((end - begin) / BOARDS[3].fps)

    def steps_to(self, level, window):
        """Steps until the rate over the last `window` steps first reaches a level: (runs,), infinite if never."""
        ends = self.edges[self.edges >= window]
        made = np.array([self.rate(end - window, end) >= level for end in ends])
        return np.where(made.any(axis=0), ends[made.argmax(axis=0)], np.inf)


def neorl_agents():
    """The agents of neorl in the comparison: {name: (kind, `Agent`)}."""
    agents = {"Brownian motion": (CHANCE, papers.brownian())}
    for name, reading in READINGS.items():
        both = papers.multimodal(PRIMES, place_gain=reading.place_gain, **reading.agents)
        agents[f"PC + OVC, {name}"] = THESIS, both
        agents[f"network D, {name}"] = THESIS, networks(reading)["D"]
    agents["forager"] = BEYOND, forager()
    return agents


def compete(creeps, steps, runs, seed=0):
    """Run all contestants on a board, but read the runs of deep learners from their table: {name: `Earned`}.

    creeps: 3 or 8. The planner does not learn, so its runs have a thirtieth of the steps.
    """
    checks.one_of("creeps", creeps, tuple(BOARDS))
    found = of_neorl(neorl_agents(), creeps, steps, runs, seed)
    found |= of_kernels(creeps, steps, runs, seed)
    return found | of_deep(creeps, steps)


def of_neorl(agents, creeps, steps, runs, seed=0):
    """Run agents of neorl: {name: `Earned`}. agents: {name: (kind, `Agent`)}."""
    results = sweep([Condition(agent, BOARDS[creeps], steps, runs, seed) for _, agent in agents.values()])
    return {name: _of_result(kind, result) for (name, (kind, _)), result in zip(agents.items(), results)}


def of_kernels(creeps, steps, runs, seed=0):
    """Run the tabular learners, the controllers and the planner: {name: `Earned`}."""
    settings, board = best_settings(), BOARDS[creeps]
    made = {name: (TABLES, make(settings[name]), steps) for name, make in TABULAR.items()}
    made |= {"nearest green": (PHYSICS, controllers.nearest_green(), steps),
             "PD": (PHYSICS, controllers.pd(settings["PD"]), steps),
             "planner": (PHYSICS, controllers.planner(settings["PD"]), max(BINS, round(PLANNED * steps)))}
    found = {}
    for name, (kind, contestant, length) in made.items():
        lived = live(contestant, board, steps=length, runs=runs, bins=BINS, seed=seed)
        found[name] = Earned(kind, np.linspace(0, length, BINS + 1).round(), lived.rewards,
                             float(np.median(lived.seconds)) / length, lived.bytes / 1e3)
    return found


def of_deep(creeps, steps):
    """Rewards of deep learners over the first `steps` of their stored runs: {name: `Earned`}."""
    return _of_rows(DEEP, read_runs(FOLDER / "deep_runs.csv"), METHODS, creeps, max(steps, MINUTE))


def after_long(creeps, kinds):
    """Rewards of contestants in the stored long runs: {name: `Earned`}. kinds: {name: its kind}."""
    rows = read_runs(FOLDER / "long_runs.csv") + read_runs(FOLDER / "deep_runs.csv")
    longest = max(row["steps"] for row in rows)
    found = {}
    for name, kind in kinds.items():
        found |= _of_rows(kind, rows, [name], creeps, longest)
    return found


def _of_rows(kind, rows, names, creeps, steps):
    """The first `steps` of each run, from its shortest row that is long enough: {name: `Earned`}.

    The time of a step is the median over all rows of a contestant on the board that have one.
    """
    found, minutes = {}, steps // MINUTE
    for name in names:
        own = [row for row in rows if row["method"] == name and row["creeps"] == creeps]
        of_run = {row["run"]: row for row in sorted(own, key=lambda row: -row["steps"])
                  if len(row["rewards"]) >= minutes}
        if of_run:
            lived = [of_run[run] for run in sorted(of_run)]
            found[name] = Earned(kind, np.arange(minutes + 1) * MINUTE,
                                 np.array([row["rewards"][:minutes] for row in lived]),
                                 float(np.nanmedian([row["seconds"] / row["steps"] for row in own])),
                                 lived[0]["kilobytes"])
    return found


def _of_result(kind, result):
    edges = np.linspace(0, result.steps, BINS + 1).round()
    sums = np.pad(result.rewards.cumsum(axis=1, dtype=float), ((0, 0), (1, 0)))
    ends = result.edges * result.world.fps
    rewards = np.diff(np.array([np.interp(edges, ends, run) for run in sums]), axis=1)
    return Earned(kind, edges, rewards, seconds_of_a_step(result.agent, result.world, min(result.steps, TIMED_STEPS)),
                  n_bytes(result.agent, result.world) / 1e3)


def seconds_of_a_step(agent, world, steps):
    """Seconds that one core takes to compute a step of an agent of neorl and its world."""
    run = Run(agent, world)
    run.advance(1)
    began = thread_time()
    run.advance(steps)
    return (thread_time() - began) / steps
