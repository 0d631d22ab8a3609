"""Trials of paper B's agents, for what rewards alone cannot decide.

They measure the time spent in a cell of a map, the size of values, and what a map of object vectors has learned.
"""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from companion.shared.runs import each_run
from neorl import Condition, Policy, Run
from neorl.experiments.simulation import usable_threads

BEFORE = 0.25  # share of a run that agents learn before they are measured


class Stays(NamedTuple):
    """Mean times that agents stay in a cell of each map."""

    condition: Condition
    seconds: np.ndarray  # (runs, maps)
    without: dict  # the same of motion without values, {name: (runs, maps)}


def mean_stays(condition):
    """How long a condition's agents stay in a cell of each map of place cells: `Stays`.

    They run for a quarter of its steps first and are then measured for as long, at most 15,000 steps. A board's reset,
    which puts an agent elsewhere, does not count as a change of cell; without any change, a stay is the time measured.
    Beside them stand Brownian motion and agents that have learned nothing, in the same cells.
    """
    agent = condition.agent
    without = {"Brownian motion": replace(agent, policy=Policy(1.0, "random")),
               "agents that have learned nothing": replace(agent, learning=replace(agent.learning, learning_rate=0.0))}
    return Stays(condition, _stays(condition),
                 {name: _stays(replace(condition, agent=each)) for name, each in without.items()})


def _stays(condition):
    agent, world = condition.agent, condition.world
    before = round(BEFORE * condition.steps)
    path_steps = max(1, min(before, 15_000))

    def of_run(k):
        run = Run(agent, world, condition.seed, k)
        run.advance(before)
        path = run.record(path_steps)
        moved = ~np.isin(path.steps[:-1], path.ends)
        changes = [((np.diff(each.encode(path.positions / world.size)) != 0) & moved).sum() for each in agent.maps]
        return path_steps / world.fps / np.maximum(changes, 1)

    return of_runs(of_run, agent, world, condition.runs)


def mean_values(agent, world, steps, runs, seed=0):
    """Mean values of agents with both modalities after `steps` steps: {node: (runs,)}.

    For a map it is the value of the best action, averaged over states and over the goals that the node can be asked
    for: any other cell of a map of places; of a map of object vectors the contact, from any other cell, or any other
    cell if the state is the self. Maps count by their weights, those of one cell as 0; gains are left out.
    """
    def of_nodes(k):
        run = Run(agent, world, seed, k)
        run.advance(steps)
        nodes, weight, means = run.state.nodes, run.state.maps.weight, best_values(run)
        return [np.dot(weight[begin:end], means[begin:end])
                for begin, end in zip(nodes.first_map, nodes.end_map)]

    return dict(zip((node.name for node in agent.nodes), of_runs(of_nodes, agent, world, runs).T))


def best_values(run):
    """The mean value of the best action in each map of a `Run`, (maps,), over the states and goals of `mean_values`.

    It is 0 for a map of one cell, which has no other to go to.
    """
    def best(m, each):
        if each.modality.follows == "position":
            return run.q(m).max(axis=1)[~np.eye(each.cells, dtype=bool)]
        return np.delete(values_for_objects(run, m).max(axis=1), run.state.maps.contact[m])

    return np.array([best(m, each).mean() if each.cells > 1 else 0.0 for m, each in enumerate(run.agent.maps)])


def values_for_objects(run, index):
    """The values of the actions for an object in each cell of a map of object vectors, (cells, actions).

    The object's cell is the goal if the state is the self; otherwise it is the state, and the goal is the contact.
    """
    q = run.q(index)
    return q[0].T if len(q) == 1 else q[:, :, run.state.maps.contact[index]]


def learn(agents, world, steps, runs, seed=0):
    """Let agents learn for some steps, {name: `Agent`}: {name: [`Run`, …]}."""
    def learned(agent, k):
        run = Run(agent, world, seed, k)
        run.advance(steps)
        return run

    return {name: each_run(lambda k, agent=agent: learned(agent, k), runs, usable_threads(agent, world))
            for name, agent in agents.items()}


def of_runs(measure, agent, world, runs):
    """What measure(k) finds of each run k of an agent, (runs, ...)."""
    return np.array(each_run(measure, runs, usable_threads(agent, world)))
