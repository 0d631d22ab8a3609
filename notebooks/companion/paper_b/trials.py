"""Trials of paper B's agents, for claims that rewards alone cannot decide.

They measure the distance to a desired place that moves, the time spent in a cell of a map, how far agents roam, the
size of values, what a map of object vectors has learned, the computing time of a step, and whether maps keep their
values when others join. Agents and worlds are those of the page.
"""

from dataclasses import replace
from time import perf_counter
from typing import NamedTuple

import numpy as np

from companion.shared.runs import each_run
from neorl.agents.agent import Desire, Node, Place
from neorl.agents.rules import Policy
from neorl.core.modality import PLACE_CELL
from neorl.experiments.condition import Condition
from neorl.experiments.run import Run, bin_steps
from neorl.experiments.simulation import simulate, usable_threads

PLACES = (Place(0.3, 0.3), Place(0.65, 0.65))  # desired in turn, for the agent's position
MOVES, SECONDS_A_MOVE = 6, 30
LIVED = 0.25  # share of a run that agents live before they are measured


class Moved(NamedTuple):
    """Distances from a desired place that moves to and fro, in board widths."""

    condition: Condition
    distances: dict  # {"experienced": (runs, moves, samples), "ignorant": the same}
    seconds: np.ndarray  # from the move to each sample


class Stays(NamedTuple):
    """Mean times that agents stay in a cell of each map."""

    condition: Condition
    seconds: np.ndarray  # (runs, maps)


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
    """An agent of place cells, with a place as its only desire."""
    return replace(agent, desires=[Desire(place, "PC", valence=1.0)])


def distances(condition):
    """The distance of a condition's agents from a desired place that moves: `Moved`.

    Experienced agents have run for a quarter of the condition's steps among creeps before; ignorant ones are untrained.
    """
    agent, world, seed = condition.agent, condition.world, condition.seed
    desires = [desiring(agent, at) for at in PLACES]
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
                found[move, sample] = np.linalg.norm(run.world_state.scene.position / world.size - at.coordinates)
        return found

    lived = {"experienced": round(LIVED * condition.steps), "ignorant": 0}
    moved = {name: _of_runs(lambda k: near(before, k), agent, world, condition.runs)
             for name, before in lived.items()}
    return Moved(condition, moved, (np.arange(samples) + 1) * interval / world.fps)


def live_with_moving_desire(agent, world, steps, runs, seed=0):
    """The first two moves of experienced agents, as the `Result` of a condition that can be replayed."""
    desires = [desiring(agent, at) for at in PLACES]
    lived, move = steps // 4, SECONDS_A_MOVE * world.fps
    return simulate(agent, world, steps=lived + 2 * move, runs=runs, seed=seed, cache=True,
                    changes=[(lived, desires[0]), (lived + move, desires[1])])


def mean_stays(condition):
    """How long a condition's agents stay in a cell of each map of place cells: `Stays`.

    They run for a quarter of its steps first and are then measured for as long, at most 15,000 steps. A board's reset,
    which puts an agent elsewhere, does not count as a change of cell; without any change, a stay is the time measured.
    """
    agent, world = condition.agent, condition.world
    lived = round(LIVED * condition.steps)
    path_steps = max(1, min(lived, 15_000))

    def of_run(k):
        run = Run(agent, world, condition.seed, k)
        run.advance(lived)
        path = run.record(path_steps)
        moved = ~np.isin(path.steps[:-1], path.ends)
        changes = [((np.diff(each.encode(path.positions / world.size)) != 0) & moved).sum() for each in agent.maps]
        return path_steps / world.fps / np.maximum(changes, 1)

    return Stays(condition, _of_runs(of_run, agent, world, condition.runs))


def roaming(revalued, seconds=100):
    """How far agents roam before a result's only change and at its end, in board widths: (2, runs).

    It is the root mean square distance of an agent from its mean position.
    """
    world, ((turn, agent),) = revalued.world, revalued.changes
    path_steps = min(seconds * world.fps, turn, revalued.steps - turn)

    def of_run(k):
        run = Run(revalued.agent, world, revalued.seed, k)
        run.advance(turn - path_steps)
        before = run.record(path_steps)
        run.change(agent)
        run.advance(revalued.steps - turn - path_steps)
        return [np.sqrt(path.positions[1:].var(axis=0).sum()) / world.size
                for path in (before, run.record(path_steps))]

    return _of_runs(of_run, revalued.agent, world, revalued.runs).T


def mean_values(agent, world, steps, runs, seed=0):
    """Mean values of agents with both modalities after `steps` steps: {node: (runs,)}.

    For a map it is the value of the best action, averaged over states and over the goals that the node can be asked
    for: any other cell of a map of places; of a map of object vectors the contact, from any other cell, or any other
    cell if the state is the self. Maps count by their weights, those of one cell as 0; gains are left out.
    """
    def of_nodes(k):
        run = Run(agent, world, seed, k)
        run.advance(steps)
        nodes, weight, means = run.parameters.nodes, run.parameters.maps.weight, best_values(run)
        return [np.dot(weight[begin:end], means[begin:end])
                for begin, end in zip(nodes.first_map[:-1], nodes.first_map[1:])]

    return dict(zip((node.name for node in agent.nodes), _of_runs(of_nodes, agent, world, runs).T))


def best_values(run):
    """The mean value of the best action in each map of a `Run`, (maps,), over the states and goals of `mean_values`.

    It is 0 for a map of one cell, which has no other to go to.
    """
    def best(m, each):
        if each.modality.follows == "position":
            return run.q(m).max(axis=1)[~np.eye(each.cells, dtype=bool)]
        return np.delete(values_for_objects(run, m).max(axis=1), run.parameters.maps.contact[m])

    return np.array([best(m, each).mean() if each.cells > 1 else 0.0 for m, each in enumerate(run.agent.maps)])


def values_for_objects(run, index):
    """The values of the actions for an object in each cell of a map of object vectors, (cells, actions).

    The object's cell is the goal if the state is the self; otherwise it is the state, and the goal is the contact.
    """
    q = run.q(index)
    return q[0].T if len(q) == 1 else q[:, :, run.parameters.maps.contact[index]]


def learn(agents, world, steps, runs, seed=0):
    """Let agents learn for some steps, {name: `Agent`}: {name: [`Run`, …]}."""
    def learned(agent, k):
        run = Run(agent, world, seed, k)
        run.advance(steps)
        return run

    return {name: each_run(lambda k, agent=agent: learned(agent, k), runs, usable_threads(agent, world))
            for name, agent in agents.items()}


def size_and_cost(learned, steps, repetitions=5):
    """The first `Run` of each kind in `learned`, after its use elsewhere: {name: (values, microseconds per step)}.

    steps: of each of the repetitions, whose median is given; they take turns, so that disturbances affect all alike.
    """
    runs = {name: each[0] for name, each in learned.items()}
    cost = {name: [] for name in runs}
    for _ in range(repetitions):
        for name, run in runs.items():
            start = perf_counter()
            run.advance(steps)
            cost[name].append((perf_counter() - start) / steps * 1e6)
    return {name: (sum(run.q(m).size for m in range(len(run.agent.maps))), float(np.median(cost[name])))
            for name, run in runs.items()}


def measure_costs(condition):
    """Measure the cost of a condition's agent as its maps are added one by one, as often as it has runs: `Costs`.

    Its nodes get a gain of 0 and do not explore, so it evaluates and learns everything but draws every action.
    """
    agent, steps, repetitions = condition.agent, condition.steps, condition.runs
    both = replace(agent, nodes=[replace(node, gain=0.0) for node in agent.nodes], policy=Policy(0.0, "random"))
    maps = [(node.name, n) for node in both.nodes for n in node.resolutions]
    sets = [(), *((each,) for each in maps), *(maps[:k] for k in range(2, len(maps) + 1))]
    alive = [Run(_with_maps(both, chosen), condition.world, condition.seed) for chosen in sets]
    cost = np.empty((len(sets), repetitions))
    for repetition in range(repetitions):  # in turns, so that disturbances affect all alike
        for place, run in enumerate(alive):
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


def _of_runs(live_one, agent, world, runs):
    return np.array(each_run(live_one, runs, usable_threads(agent, world)))
