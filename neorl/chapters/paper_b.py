"""What the page of paper B computes and reports: its experiments, and those of other claims, under any reading.

1. Figures 4 and 5 of the paper, and agents that change while they live, are conditions: runs whose rewards are enough.
2. What rewards do not show is measured while agents live: how near they come to a desired place that moves, how long
   they stay in the cells of a map, how large their values are, and how long a step takes to compute.
3. Single resolutions, and what the paper does not plot, have a fifth of the runs, but 10 where there are as many.
"""

from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from time import perf_counter
from typing import NamedTuple

import numpy as np

from neorl.agents import papers
from neorl.agents.agent import Desire, Node, Place, Policy
from neorl.core.modality import PLACE_CELL
from neorl.evidence import claims
from neorl.evidence.priors import WITHIN
from neorl.evidence.reading import PRIMES, additions, conditions, judge
from neorl.evidence.report import SIGNS
from neorl.evidence.rules_chapters import sooner_with_more
from neorl.evidence.statements import STATEMENTS
from neorl.evidence.statistics import estimate, points, ratio, resets, time_to_final_level
from neorl.experiments.cache import Condition
from neorl.experiments.run import Run, bin_steps
from neorl.experiments.simulation import usable_threads
from neorl.experiments.sweep import sweep
from neorl.worlds.waterworld import WaterWorld

MAIN, GROUPS = ("modal", "pace"), ("layers", "resolutions", "revaluing")  # of `neorl.evidence.reading.GROUPS`
AGENTS = {"PC": ("place", "all"), "OVC": ("objects", "all"), "PC + OVC": "both"}  # of figure 5, by key
PLACES = (Place(0.3, 0.3), Place(0.65, 0.65))  # of the agent's position; it is desired in turn
MOVES, SECONDS_A_MOVE = 6, 30
LIVED = 0.25  # of a run, before agents are watched


def few(runs):
    """How many runs the secondary conditions have where the main ones have `runs`."""
    return min(runs, claims.RUNS_FOR_A_VERDICT)


def experiments(reading, steps, runs, seed=0):
    """The conditions of the page under a reading: {key: `Condition`}.

    steps, runs: as `neorl.evidence.reading.conditions` takes them, whose keys these have, and
    ("points", name): figure 5's agents and Brownian motion in a tank whose reward shows when a board was reset, for a
        quarter of the time but for both modalities;
    "joined": place cells that get object-vector cells too at half-time.
    Raises ValueError for bad arguments.
    """
    main = conditions(reading, steps, runs, seed, MAIN)
    del main["brownian", 3]  # whose mean is known well from as many runs as the others need
    made = conditions(reading, steps, few(runs), seed, (*MAIN, *GROUPS)) | main
    both = made["both"]
    shows_resets = replace(both.world, win_reward=1.0)
    agents = {name: made[key].agent for name, key in AGENTS.items()} | {"Brownian motion": papers.brownian()}
    for name, agent in agents.items():
        length = both.steps if agent == both.agent else max(1, both.steps // 4)
        made["points", name] = Condition(agent, shows_resets, length, few(runs), seed)
    made["joined"] = replace(made["place", "all"], runs=few(runs), changes=((both.steps // 2, both.agent),))
    return made


def neighbours(reading, steps, runs, seed=0):
    """The conditions of B1, B3 and B6 in readings that differ from a reading in one choice: {name: {key: `Condition`}}.

    The choices are those that make an object vector a state and weigh the two modalities; each takes the other values
    that the text leaves open.
    """
    made = {}
    for field in ("causes", "capture", "attention", "object_tiled_fraction", "place_gain"):
        choice = WITHIN[field]
        for level in choice.prior:
            if level != getattr(reading, field):
                other = replace(reading, **{field: level})
                made[f"{choice.label}: {choice.words(level)}"] = conditions(other, steps, runs, seed, ["modal"])
    return made


def live(made, executor=None):
    """Compute conditions of several readings, those that they share once: {reading: {key: `Condition`}} to `Result`s.

    executor: as `neorl.sweep` takes it.
    """
    different = list(dict.fromkeys(each for of_reading in made.values() for each in of_reading.values()))
    results = dict(zip(different, sweep(different, executor)))
    return {name: {key: results[each] for key, each in of_reading.items()} for name, of_reading in made.items()}


def judged(results, moved, stays, cost):
    """All claims of the page, in their order: [`Claim`, …].

    results: {key: `Result`}, of `experiments`. moved: {name: distances (runs, moves, samples)}, of `distances`. stays:
    (runs, maps), of `mean_stays`. cost: a `Costs`.
    """
    brownian = results["brownian", 3]
    found = {name: claim for name, claim in judge(results).items() if name[0] != "A"}
    near = {name: each.mean(axis=2) for name, each in moved.items()}
    for claim in (claims.judge_points(results["points", "PC + OVC"]),
                  claims.judge_joining(results["joined"], results["place", "all"], brownian),
                  claims.judge_changes(results["revalued"], near),
                  claims.judge_cost(cost.first[-1], cost.alone, cost.none),
                  claims.judge_time_scale(PRIMES, stays)):
        found[claim.name] = claim
    return [found[name] for name in STATEMENTS if name in found]


def in_words(results, judged):
    """What was found under one reading, in Markdown: final levels, the time to them, and verdicts.

    results: {key: `Result`}, of `experiments`. judged: its claims.
    """
    level, minute = levels(results), {name: f"{each.value:.0f}" for name, each in minutes(results).items()}
    by_verdict = {verdict: ", ".join(claim.name for claim in judged if claim.verdict == verdict)
                  for verdict in claims.VERDICTS}
    verdicts = "; ".join(f"{SIGNS[verdict]} {verdict}: {names}" for verdict, names in by_verdict.items() if names)
    return (f"place cells finally earn {level['PC']} per second (thesis: 0.29), object-vector cells {level['OVC']}, "
            f"and both together {level['PC + OVC']} (thesis: 0.55). To reach their final level they take "
            f"{minute['PC']} minutes (thesis: more than 160), {minute['OVC']}, and {minute['PC + OVC']} (thesis: 15). "
            f"{verdicts}.")


def levels(results):
    """Final reward per second of figure 5's agents: {name: `Estimate`}."""
    return {name: estimate(np.mean, results[key].rate(*claims.FINAL)) for name, key in AGENTS.items()}


def minutes(results):
    """Minutes until figure 5's agents reach their final level, as `judge_pace` takes them: {name: `Estimate`}."""
    keys = zip(AGENTS, ("place", "objects", "both"))
    return {name: estimate(np.mean, time_to_final_level(results["pace", key]) / 60) for name, key in keys}


def points_a_reset(results):
    """Points that a board brings until it is reset, of figure 5's agents and of Brownian motion: {name: `Estimate`}."""
    return {key[1]: estimate(ratio, points(result), resets(result)) for key, result in results.items()
            if key[0] == "points"}


def minutes_with_more_maps(results):
    """By how many minutes agents with more maps are sooner than those with fewer: {what is added: `Estimate`}."""
    return {name: sooner_with_more(more, fewer) for name, (more, fewer, _) in additions(results).items()}


def red_a_minute(result, stretches=100):
    """Red creeps that each run takes a minute, (runs, stretches) in equal stretches, and their middles in minutes."""
    edges = np.linspace(0, 1, stretches + 1)
    taken = [60 * result.hit_rate(*pair)[:, 1] for pair in zip(edges[:-1], edges[1:])]
    return np.stack(taken, axis=1), (edges[:-1] + edges[1:]) / 2 * result.seconds / 60


def desiring(reading, place):
    """Place cells that desire nothing but a place."""
    return replace(papers.place_cells(PRIMES, **reading.place_agents), desires=[Desire(place, "PC", valence=1.0)])


def distances(reading, steps, runs, seed=0):
    """How far from a desired place agents are, in board widths, while it moves to and fro: (moved, seconds).

    moved: {"experienced": (runs, moves, samples), "ignorant": the same}, of place cells that have lived a quarter of
    `steps` among creeps before, and of such that have not. seconds: when each sample of a move is, (samples,).
    """
    world = WaterWorld(fps=reading.fps, contact=reading.contact)
    agent, desires = papers.place_cells(PRIMES, **reading.place_agents), [desiring(reading, at) for at in PLACES]
    interval = bin_steps(world)
    samples = SECONDS_A_MOVE * world.fps // interval

    def near(lived, k):
        run, found = Run(agent, world, seed, k), np.empty((MOVES, samples))
        run.advance(lived)
        for move in range(MOVES):
            at = PLACES[move % len(PLACES)]
            run.change(desires[move % len(PLACES)])
            for sample in range(samples):
                run.advance(interval)
                found[move, sample] = np.linalg.norm(run.world_state.agent_position / world.width - (at.x, at.y))
        return found

    lived = {"experienced": round(LIVED * steps), "ignorant": 0}
    moved = {name: _of_runs(lambda k: near(before, k), agent, runs) for name, before in lived.items()}
    return moved, (np.arange(samples) + 1) * interval / world.fps


def mean_stays(reading, steps, runs, seed=0, watched=15_000):
    """How long agents stay in a cell, in mean seconds, for each of the maps of place cells: (runs, maps).

    They have lived a quarter of `steps` before and are watched for as long, `watched` steps at most. A board's reset,
    which puts an agent elsewhere, is no change of cell; without any change a stay is as long as it was watched.
    """
    world = WaterWorld(fps=reading.fps, contact=reading.contact)
    agent = papers.place_cells(PRIMES, **reading.place_agents)
    lived = round(LIVED * steps)
    path_steps = max(2, min(lived, watched))

    def of_run(k):
        run = Run(agent, world, seed, k)
        run.advance(lived)
        path, moved = np.empty((path_steps, 2)), np.empty(path_steps, bool)
        for step in range(path_steps):
            run.advance(1)
            path[step] = run.world_state.agent_position / world.width
            moved[step] = run.world_state.agent_velocity.any() or (path[step] != 0.5).any()  # it is not as after a reset
        changes = [((np.diff(each.encode(path)) != 0) & moved[1:]).sum() for each in agent.maps]
        return path_steps / world.fps / np.maximum(changes, 1)

    return _of_runs(of_run, agent, runs)


def mean_values(reading, steps, runs, seed=0):
    """How large the values of agents with both modalities are after `steps` steps: {node: (runs,)}.

    Of a map it is the value of the best action, averaged over states and over the goals that the node can be asked
    for: any other cell of a map of places, the agent's own cell of a map of object vectors. Maps count by their
    weights; gains are left out.
    """
    world = WaterWorld(fps=reading.fps, contact=reading.contact)
    agent = papers.multimodal(PRIMES, **reading.agents)

    def of_nodes(k):
        run = Run(agent, world, seed, k)
        run.advance(steps)
        means = []
        for m, each in enumerate(agent.maps):
            best = run.q(m).max(axis=1)
            if each.modality.vector == "position":
                means.append(best[~np.eye(each.cells, dtype=bool)].mean())
            else:
                means.append(np.delete(best[:, run.parameters.maps.contact[m]], run.parameters.maps.contact[m]).mean())
        return [np.dot(run.parameters.maps.weight[begin:end], means[begin:end])
                for begin, end in zip(run.parameters.nodes.first_map[:-1], run.parameters.nodes.first_map[1:])]

    return dict(zip((node.name for node in agent.nodes), _of_runs(of_nodes, agent, runs).T))


class Costs(NamedTuple):
    """Microseconds a step on one core, each (repetitions,), of agents that all move alike."""

    labels: list  # of the maps
    none: np.ndarray  # without any map
    alone: np.ndarray  # (maps, repetitions), with one map
    first: np.ndarray  # (maps, repetitions), with this map and all before it

    @property
    def measured(self):
        """What the agents with more and more maps cost typically, (maps,)."""
        return np.median(self.first, axis=1)

    @property
    def predicted(self):
        """What they would if maps cost together what each costs by itself, (maps,)."""
        base = np.median(self.none)
        return base + np.cumsum(np.median(self.alone, axis=1) - base)


def measure_costs(reading, steps, repetitions, seed=0):
    """What agents with one map more each time cost: a `Costs`.

    Their nodes have a gain of 0 and do not explore, so they evaluate and learn everything but draw every action.
    """
    agents = {**reading.agents, "policy": Policy(0.0, "random")}
    both = papers.multimodal(PRIMES, place_gain=0.0, object_gain=0.0, **agents)
    world = WaterWorld(fps=reading.fps, contact=reading.contact)
    maps = [(node.name, n) for node in both.nodes for n in node.resolutions]
    sets = [(), *((each,) for each in maps), *(maps[:k] for k in range(2, len(maps) + 1))]
    alive = [Run(_with_maps(both, chosen), world, seed) for chosen in sets]
    cost = np.empty((len(sets), repetitions))
    for repetition in range(repetitions):  # all in turn, so that they share what disturbs
        for place, run in enumerate(alive):
            start = perf_counter()
            run.advance(steps)
            cost[place, repetition] = (perf_counter() - start) / steps * 1e6
    alone = cost[1 : len(maps) + 1]
    first = np.concatenate([alone[:1], cost[len(maps) + 1 :]])
    return Costs([f"{name} N{n}" for name, n in maps], cost[0], alone, first)


def _with_maps(agent, chosen):
    """The agent with these of its maps only, (name of the node, N) each; without any, it has a map of one cell."""
    of_node = {node.name: [n for name, n in chosen if name == node.name] for node in agent.nodes}
    nodes = [replace(node, resolutions=of_node[node.name]) for node in agent.nodes if of_node[node.name]]
    desires = [each for each in agent.desires if of_node[each.target]]
    return replace(agent, nodes=nodes or [Node("none", PLACE_CELL, [1])], desires=desires)


def _of_runs(live_one, agent, runs):
    with ThreadPoolExecutor(min(usable_threads(agent), runs)) as cores:
        return np.array(list(cores.map(live_one, range(runs))))
