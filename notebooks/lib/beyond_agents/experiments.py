"""The forager, the forager without each of its parts, and agents between the bare one and it: conditions and results.

1. Parts are the differences between the forager and the bare agent, which superposes the values of contacts in a single
   map of object-vector cells. Without mirrored cells an axis has 2N − 1 intervals in place of N, so receptive fields
   keep their size; without several resolutions there is the middle one.
2. All conditions have runs of `seed`, which took no part in the search (`lib.beyond_agents.search`).
"""

import time
from dataclasses import dataclass

import numpy as np

from neorl.agents.agent import Agent, Desire, Node
from neorl.agents.beyond import forager, foveated_cells
from neorl.agents.papers import multimodal
from neorl.agents.rules import GREEDY, Contacts
from neorl.core.contacts import APPROACH, FEAR, VISITS
from neorl.experiments.cache import Condition
from neorl.experiments.run import Run
from neorl.experiments.sweeping import sweep
from neorl.worlds.waterworld import WaterWorld

THESIS = "the thesis, calibrated"
BARE = "contacts alone"
PARTS = ("velocity", "foveated fields", "the best alone", "fear by avoidance", "first values", "mirror images", "trace",
         "several resolutions")
TARGETS = {  # (creeps, begin and end as shares of 600,000 steps, reward per second)
    "3 creeps, first 50,000 steps": (3, 0.0, 1 / 12, 1.5), "3 creeps, steps 100,000 to 150,000": (3, 1 / 6, 1 / 4, 3.0),
    "8 creeps, steps 100,000 to 150,000": (8, 1 / 6, 1 / 4, 2.0), "3 creeps, around step 600,000": (3, 5 / 6, 1.0, 3.3)}
TIMES_AS_LONG = 4  # length of the runs that are compared with the targets


@dataclass(frozen=True)
class Lived:
    """Results of the conditions of the page: `neorl.Result` by name.

    way: from the bare agent on, each with one more part. without: the forager without one part. long: by creeps, runs
    that are `TIMES_AS_LONG` times as long. revalued: the forager when red is worth as much as green from half-time on.
    """

    thesis: dict
    way: dict
    without: dict
    long: dict
    revalued: object


def forager_with(parts):
    """The forager with only these parts. Raises ValueError for an unknown part."""
    unknown = set(parts) - set(PARTS)
    if unknown:
        raise ValueError(f"parts has {', '.join(sorted(unknown))}, allowed are {', '.join(PARTS)}")
    if set(parts) == set(PARTS):
        return forager()
    whole = forager()
    mirrored, resolutions = "mirror images" in parts, whole.nodes[0].resolutions
    if "several resolutions" not in parts:
        resolutions = (resolutions[len(resolutions) // 2],)
    if not mirrored:
        resolutions = tuple(2 * each - 1 for each in resolutions)
    chosen = Contacts()
    contacts = Contacts(
        fear=chosen.fear if "fear by avoidance" in parts else "approach",
        rivals=chosen.rivals if "the best alone" in parts else "add",
        first_value=chosen.first_value if "first values" in parts else 0.0,
        trace_rate=chosen.trace_rate if "trace" in parts else 0.0)
    cells = foveated_cells("foveated fields" in parts, "velocity" in parts, mirrored)
    name = whole.nodes[0].name
    return Agent([Node(name, cells, resolutions, goals="contacts")],
                 [Desire(each.source, name, each.valence) for each in whole.desires], policy=GREEDY,
                 contacts=contacts)


def way_agents():
    """The agents from the bare one to the forager, each with one more part: {name: `Agent`}."""
    return {BARE: forager_with(())} | {f"+ {part}": forager_with(PARTS[: number + 1])
                                       for number, part in enumerate(PARTS)}


def without_agents():
    """The forager without one part: {part: `Agent`}."""
    return {part: forager_with([each for each in PARTS if each != part]) for part in PARTS}


def live(steps, runs, seed=0):
    """Run all conditions: `Lived`. steps: per run, except long ones. runs: per condition."""
    tank = WaterWorld()
    agents = {("thesis", THESIS): multimodal(), **{("way", name): each for name, each in way_agents().items()},
              **{("without", name): each for name, each in without_agents().items()}}
    conditions = {key: Condition(agent, tank, steps, runs, seed) for key, agent in agents.items()}
    for creeps in (3, 8):
        conditions["long", creeps] = Condition(forager(), WaterWorld(n_creeps=creeps), TIMES_AS_LONG * steps, runs,
                                               seed)
    both = forager(valence_green=1.0, valence_red=1.0)
    conditions["revalued", ""] = Condition(forager(valence_green=1.0, valence_red=-1.0), tank, steps, runs, seed,
                                           changes=((steps // 2, both),))
    results = dict(zip(conditions, sweep(list(conditions.values()), progress=False)))
    groups = {group: {name: result for (of, name), result in results.items() if of == group}
              for group in ("thesis", "way", "without", "long")}
    return Lived(**groups, revalued=results["revalued", ""])


def last_third(result):
    """Reward per second of each run over the last third: float64 (runs,)."""
    return result.rate(2 / 3, 1.0)


def reached(lived):
    """Reward per second of each run over the stretch of each target: {name: float64 (runs,)}."""
    return {name: lived.long[creeps].rate(begin, end) for name, (creeps, begin, end, _) in TARGETS.items()}


def hits_per_second(result, stretches=30):
    """Minutes, and the creeps of each kind met per second over the run: {"green": (runs, stretches), "red": …}."""
    bins = np.array_split(np.arange(result.hits.shape[1]), min(stretches, result.hits.shape[1]))
    seconds = np.array([result.edges[each[-1] + 1] - result.edges[each[0]] for each in bins])
    middles = np.array([(result.edges[each[-1] + 1] + result.edges[each[0]]) / 120 for each in bins])
    counts = np.array([result.hits[:, each].sum(axis=1) for each in bins])  # (stretches, runs, kinds)
    rates = counts / seconds[:, None, None]
    return middles, {kind: rates[:, :, number].T for number, kind in enumerate(result.world.kinds)}


def fear_by_approach(steps, runs, seed=0, bins=20):
    """Mean fear of actions as a function of their approach, in foragers that have learned for `steps` steps.

    Returns the middles of the bins, float64 (bins,), and fear, float64 (runs, bins), NaN where a bin is empty. Actions
    are those of the finest map, weighted by their visits.
    """
    edges, fears = np.linspace(0, 1, bins + 1), np.full((runs, bins), np.nan)
    for number in range(runs):
        run = Run(forager(), WaterWorld(), seed, number)
        run.advance(steps)
        q = run.q(len(run.agent.maps) - 1).reshape(-1, 3).astype(float)
        q = q[q[:, VISITS] > 0]
        which = np.clip(np.digitize(q[:, APPROACH], edges) - 1, 0, bins - 1)
        visits = np.bincount(which, q[:, VISITS], bins)
        found = np.bincount(which, q[:, VISITS] * q[:, FEAR], bins)
        fears[number, visits > 0] = found[visits > 0] / visits[visits > 0]
    return (edges[1:] + edges[:-1]) / 2, fears


@dataclass(frozen=True)
class Cost:
    """Cost of an agent on one core: microseconds per step, kibibytes that it holds and that it has ever used."""

    microseconds: float
    held: float
    used: float


def cost(steps, seed=0):
    """The `Cost` of the forager with 3 creeps, over `steps` steps after as many that are not timed."""
    run = Run(forager(), WaterWorld(), seed)
    run.advance(steps)
    began = time.perf_counter()
    run.advance(steps)
    seconds = time.perf_counter() - began
    maps = [run.q(number) for number in range(len(run.agent.maps))]
    return Cost(1e6 * seconds / steps, sum(q.nbytes for q in maps) / 1024,
                sum(np.count_nonzero(q[..., VISITS]) * 3 * q.itemsize for q in maps) / 1024)
