"""Trials of paper B's agents, for claims that rewards alone cannot decide.

They measure the distance to a desired place that moves, how far agents roam, and the computing time of a step.
"""

from dataclasses import replace
from time import perf_counter
from typing import NamedTuple

import numpy as np

from companion.paper_b.trials import BEFORE, of_runs
from neorl import Condition, Desire, Node, Place, Policy, Run
from neorl.core.modality import PLACE_CELL
from neorl.experiments.bins import bin_steps

PLACES = (Place(0.3, 0.3), Place(0.65, 0.65))  # desired in turn, for the agent's position
MOVES, SECONDS_A_MOVE = 6, 30
TIMED = 20_000  # steps of an agent whose cost is measured


class Moved(NamedTuple):
    """Distances from a desired place that moves to and fro, in board widths."""

    condition: Condition
    distances: dict  # {"experienced": (runs, moves, samples), "ignorant": the same}
    seconds: np.ndarray  # from the move to each sample

    @property
    def means(self):
        """The mean distance after each move: {"experienced": (runs, moves), "ignorant": the same}."""
        return {group: each.mean(axis=2) for group, each in self.distances.items()}


class Costs(NamedTuple):
    """Microseconds per step on one core, each (repetitions,), of agents that all move identically."""

    condition: Condition  # of the agent with all maps
    labels: list  # of the maps
    none: np.ndarray  # without any map
    alone: np.ndarray  # (maps, repetitions), with one map
    first: np.ndarray  # (maps, repetitions), with this map and all before it

    @property
    def measured(self):
        """Median cost of the agents, as maps are added one by one, (maps,)."""
        return np.median(self.first, axis=1)

    @property
    def predicted(self):
        """Cost of these agents if the separate costs of their maps add up, (maps,)."""
        base = np.median(self.none)
        return base + np.cumsum(np.median(self.alone, axis=1) - base)


def desiring(agent, place):
    """An agent that desires a place alone, with each of its nodes."""
    return replace(agent, desires=[Desire(place, node.name, valence=1.0) for node in agent.nodes])


def distances(condition):
    """The distance of a condition's agents from a desired place that moves: `Moved`.

    Experienced agents have run for a quarter of the condition's steps among creeps before; ignorant ones are untrained.
    """
    agent, world, seed = condition.agent, condition.world, condition.seed
    desires = [desiring(agent, at) for at in PLACES]
    interval = bin_steps(world)
    samples = SECONDS_A_MOVE * world.fps // interval

    def near(before, k):
        run, found = Run(agent, world, seed, k), np.empty((MOVES, samples))
        run.advance(before)
        for move in range(MOVES):
            at = PLACES[move % len(PLACES)]
            run.change(desires[move % len(PLACES)])
            for sample in range(samples):
                run.advance(interval)
                found[move, sample] = np.linalg.norm(run.world_state.scene.position / world.size - at.coordinates)
        return found

    learned = {"experienced": round(BEFORE * condition.steps), "ignorant": 0}
    moved = {name: of_runs(lambda k: near(before, k), agent, world, condition.runs)
             for name, before in learned.items()}
    return Moved(condition, moved, (np.arange(samples) + 1) * interval / world.fps)


def roaming(revalued, seconds=100):
    """How far agents roam before a result's only change and at its end, in board widths: (2, runs, 2).

    It is the standard deviation of each coordinate of their positions.
    """
    world, ((turn, agent),) = revalued.world, revalued.changes
    path_steps = min(seconds * world.fps, turn, revalued.steps - turn)

    def of_run(k):
        run = Run(revalued.agent, world, revalued.seed, k)
        run.advance(turn - path_steps)
        before = run.record(path_steps)
        run.change(agent)
        run.advance(revalued.steps - turn - path_steps)
        return [path.positions[1:].std(axis=0) / world.size for path in (before, run.record(path_steps))]

    return of_runs(of_run, revalued.agent, world, revalued.runs).swapaxes(0, 1)


def measure_costs(condition):
    """Measure the cost of a condition's agent as its maps are added one by one, as often as it has runs: `Costs`.

    Its nodes get a gain of 0 and do not explore, so it evaluates and learns everything but draws every action.
    """
    agent, steps, repetitions = condition.agent, condition.steps, condition.runs
    both = replace(agent, nodes=[replace(node, gain=0.0) for node in agent.nodes], policy=Policy(0.0, "random"))
    maps = [(node.name, n) for node in both.nodes for n in node.resolutions]
    sets = [(), *((each,) for each in maps), *(maps[:k] for k in range(2, len(maps) + 1))]
    timed = [Run(_with_maps(both, chosen), condition.world, condition.seed) for chosen in sets]
    cost = np.empty((len(sets), repetitions))
    for repetition in range(repetitions):  # in turns, so that disturbances affect all alike
        for place, run in enumerate(timed):
            start = perf_counter()
            run.advance(steps)
            cost[place, repetition] = (perf_counter() - start) / steps * 1e6
    alone = cost[1 : len(maps) + 1]
    first = np.concatenate([alone[:1], cost[len(maps) + 1 :]])
    return Costs(condition, [f"{name} N{n}" for name, n in maps], cost[0], alone, first)


def _with_maps(agent, chosen):
    """The agent with only these of its maps, (name of the node, N) each, or a map of one cell if there are none."""
    of_node = {node.name: [n for name, n in chosen if name == node.name] for node in agent.nodes}
    nodes = [replace(node, resolutions=of_node[node.name]) for node in agent.nodes if of_node[node.name]]
    desires = [each for each in agent.desires if of_node[each.target]]
    return replace(agent, nodes=nodes or [Node("none", PLACE_CELL, [1])], desires=desires)
