"""Desires as the wires of a network: which ones make it up, where they land, and which are refused."""

from dataclasses import replace
from textwrap import wrap

import numpy as np

from lib.shared.wording import table
from neorl.evidence.reading import networks
from neorl.evidence.statistics import estimate
from neorl.experiments.run import Run
from neorl.worlds.waterworld import WaterWorld

LOOKS = 500  # samples of each run, in its second half
WELL_INSIDE = 0.2  # board widths from the middle
FAR = 0.1  # board widths from the agent
PATIENCE = 5_000  # steps
LINE = 66  # characters


def make_up(network, desires, reading):
    """Whether desires are those of a network, if those between nodes have the scale and the sign of a reading."""
    passed = {"scale": reading.scale, "signed": reading.vectors == "signed"}
    desires = [replace(desire, **passed) if network.comes_from_node(desire) else desire for desire in desires]
    return replace(network, desires=desires) == network


def moment_of_desire(network, world, steps, seed=0):
    """A `Run` at a moment when the agent is well inside the board and a node's desire lands far from it.

    It takes ``steps`` steps, and then at most `PATIENCE` more until such a moment.
    """
    run = Run(network, world, seed)
    run.advance(steps)
    while run.step < steps + PATIENCE and not (_is_inside(run) and _reach(run) > FAR):
        run.advance(1)
    return run


def _is_inside(run):
    return np.abs(run.world_state.scene.position / run.world.size - 0.5).max() < WELL_INSIDE


def _reach(run):
    """How far from the agent the desires between its nodes land, in board widths: the farthest one."""
    return np.hypot(*_landed(run).T).max(initial=0.0)


def _landed(run):
    """Where desires that one node has of another land, from the agent, in board widths: float64 (desires, 2)."""
    passed = [run.agent.comes_from_node(desire) and desire.source != desire.target for desire in run.agent.desires]
    return run.state.desires.target[passed, :2]


def landings(run):
    """Where the desires between the nodes of a run's agent land, and their valences, as a Markdown table."""
    rows = ["| Desire | Lands at, from the agent, in board widths | Valence |", "|---|---|---|"]
    for desire, (east, south, valence) in zip(run.agent.desires, run.state.desires.target):
        if run.agent.comes_from_node(desire):
            row = f"{desire.source} to {desire.target}, {' and '.join(desire.of)} creeps"
            rows.append(f"| {row} | ({east:z.3f}, {south:z.3f}) | {valence:+g} |".replace("-", "−"))
    return "\n".join(rows)


def distances(readings, steps, runs, seed=0):
    """How far from the agent desires between nodes land in the second half of runs, and how often in its own cell.

    readings: {name: Reading}. Returns {(name, network): (board widths, share)}, float64 (runs,) each: the median of the
    farthest desire, and the share of `LOOKS` moments at which all are in the cell of distance 0 of the finest map.
    """
    return {(name, network): np.array([_distances(Run(agent, WaterWorld(), seed, k), steps) for k in range(runs)]).T
            for name, reading in readings.items() for network, agent in networks(reading).items()}


def _distances(run, steps):
    finest, landed = run.agent.nodes[-1].maps[-1], []
    run.advance(steps // 2)
    for _ in range(LOOKS):
        run.advance(max(1, steps // 2 // LOOKS))
        landed.append(_landed(run))
    at_agent = finest.encode(landed) == finest.encode([0.0, 0.0])
    return np.median(np.hypot(*np.moveaxis(landed, -1, 0)).max(axis=1)), at_agent.all(axis=1).mean()


def distance_table(found):
    """Results of `distances`, as a Markdown table."""
    return table(["Reading", "Network", "Desires land at, in board widths", "In the agent's own cell, % of the time"],
                 [[*names, estimate(np.mean, widths), estimate(np.mean, 100 * share)]
                  for names, (widths, share) in found.items()])


def refusal(network, desire):
    """Why a network cannot have a further desire, in short lines; "" if it can."""
    try:
        replace(network, desires=[*network.desires, desire])
    except ValueError as error:
        return "\n".join(wrap(str(error), LINE))
    return ""
