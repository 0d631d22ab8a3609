"""How agents that watched the data sets of OGBench's point mazes reach its goals: the program behind `benchmark.csv`.

1. An agent has maps of place cells over a square box, in line with the walls or not (`Box`). It watches a data set
   eight times, and then learns no more. It follows its desire vector, its largest component 1, with noise of standard
   deviation .3, in OGBench's own environment, to the benchmark's five goals, until success or the limit of steps.
2. Where an agent or the control knows no way, the noise alone moves it.
3. Rows of the *table* have the benchmark's 50 episodes for each goal. Rows of the *offsets* and *ablations* have 10,
   and data seed 0. An ablation changes one choice of the agent out of line; offsets move the box, both ways at once.
4. The control has no values: a graph of the moves between the cells of the finest map, fewest moves first.

``python -m companion.recordings.mazes DATA 8`` generates the data sets; ``python -m companion.recordings.benchmark DATA
benchmark.csv`` computes the rows for which it finds data, and goes on where it was interrupted; at its end it writes
``paths.csv`` beside them. What is committed was recorded with OGBench 1.2.2 and MuJoCo 3.14.0.
"""

import csv
import sys
import time
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

import numpy as np

from companion.recordings import mazes
from companion.recordings.pilots import LEARNING, by_graph, pupil, towards_thing

NOISE = 0.3  # standard deviation, of a push of 1
GOALS = 5  # of each maze
OFFICIAL, FEWER = 50, 10  # episodes for each goal
DATA_SEEDS = 8
SQUARES = {"medium": 6, "large": 10, "giant": 14, "teleport": 10}  # inside the outer walls, along the longer side
OUT_OF_LINE = {"medium": (11, 23), "large": (19, 41), "giant": (25, 51), "teleport": (19, 41)}
DRAWN, THINNED = "pointmaze-giant-navigate-v0", 4  # the maze of `paths.csv`, and steps of which it has one
COARSE, FINE = 2.0, 1.0  # units, of cells in line with the walls
OFFSETS = [k / 4 for k in range(8)]  # units, of the box; after `COARSE` all cells lie as before
ABLATIONS = {  # what is changed of the agent out of line: fields of its rules, of itself, and how it is steered
    "none": ({}, {}, "vector"),
    "best of the four actions": ({}, {}, "best"),
    "vector not scaled": ({}, {}, "unscaled"),
    "no bootstrap": ({"bootstrap": False}, {}, "vector"),
    "credit for the last action": ({"credit": "last"}, {}, "vector"),
    "memory of 10 cells": ({"memory": 10.0}, {}, "vector"),
    "discount .99": ({"discount": 0.99}, {}, "vector"),
    "learning rate .1": ({"learning_rate": 0.1}, {}, "vector"),
    "own cell counts": ({}, {"own_cell": "counts"}, "vector"),
}


class Box(NamedTuple):
    """A square that maps divide: its corner and its side, in the maze's units, and the maps' resolutions."""

    corner: tuple
    side: float
    resolutions: tuple

    def within(self, places):
        """Places of the maze in the unit square."""
        return (np.asarray(places, float) - self.corner) / self.side


class Row(NamedTuple):
    """What became of one pilot: its successes among so many episodes for each goal, and the seconds of learning."""

    part: str
    name: str  # of the data set
    seed: int  # of the data
    pilot: str
    resolutions: str
    offset: float
    episodes: int
    successes: str
    steps: int
    seconds: float


def in_line(name, offset=None):
    """The `Box` of cells of two sizes in line with a maze's walls; with an offset, a cell wider and moved by it."""
    width = mazes.UNIT * SQUARES[name.split("-")[1]]
    side = width if offset is None else width + COARSE
    corner = -mazes.UNIT / 2 - (offset or 0.0)
    return Box((corner, corner), side, (int(side / COARSE), int(side / FINE)))


def out_of_line(name):
    """The `Box` of cells whose borders do not meet the walls."""
    return in_line(name)._replace(resolutions=OUT_OF_LINE[name.split("-")[1]])


def watched(recording, box, **rules):
    """The `pupil` of a recording in a box."""
    return pupil(box.within(recording.positions), box.resolutions, ends=recording.ends[:-1],
                 actions=recording.actions[:-1], **rules)


def solved(pilot, box, name, episodes, seed, paths=None):
    """Successes for each goal, (goals,), and steps in all, of a pilot in OGBench's environment.

    paths: a list that takes each episode's path, (steps + 1, 2), and its goal, in the maze's units.
    """
    np.random.seed([seed, 1])  # OGBench draws from NumPy's global stream
    env, rng = mazes.environment(name), np.random.default_rng(seed)
    env.action_space.seed(seed)
    successes, steps = np.zeros(GOALS, int), 0
    for task in range(GOALS):
        for episode in range(episodes):
            first = seed if task == episode == 0 else None
            place, info = env.reset(seed=first, options={"task_id": task + 1})
            push, path, done = pilot(tuple(box.within(info["goal"]))), [place], False
            while not done:
                action = np.clip(push(box.within(place)) + NOISE * rng.normal(size=2), -1.0, 1.0)
                place, _, terminated, truncated, info = env.step(action)
                path.append(place)
                done = terminated or truncated
            successes[task] += int(info["success"])
            steps += len(path) - 1
            if paths is not None:
                paths.append((np.array(path), env.unwrapped.cur_goal_xy))
    return successes, steps


def plan():
    """What is computed, in this order: the part, data set, data seed, pilot, offset and episodes of each row."""
    for seed in range(DATA_SEEDS):
        for name in mazes.SIZES:
            for pilot in ("in line", "out of line", "graph, in line", "graph, out of line"):
                yield "table", name, seed, pilot, 0.0, OFFICIAL
        if seed == 1:  # after two data seeds, so that an interrupted table has what it needs
            yield from scans()


def scans():
    """The rows of offsets and ablations."""
    walled = [name for name in mazes.SIZES if "teleport" not in name]
    for name in walled:
        for offset in OFFSETS:
            for pilot in ("in line", "graph, in line"):
                yield "offsets", name, 0, pilot, offset, FEWER
    for name in walled:
        for ablation in ABLATIONS:
            yield "ablations", name, 0, ablation, 0.0, FEWER


def row_of(folder, part, name, seed, pilot, offset, episodes):
    """Compute a `Row`."""
    recording = mazes.load(folder, name, seed)
    box = out_of_line(name) if part == "ablations" or "out" in pilot else in_line(
        name, offset if part == "offsets" else None)
    begun = time.process_time()
    if "graph" in pilot:
        to = by_graph(box.within(recording.positions), max(box.resolutions), recording.ends[:-1])
    else:
        learning, rules, steering = ABLATIONS.get(pilot, ABLATIONS["none"])
        to = towards_thing(watched(recording, box, learning=replace(LEARNING, **learning), **rules), steering)
    seconds = time.process_time() - begun
    successes, steps = solved(to, box, name, episodes, seed)
    return Row(part, name, seed, pilot, " ".join(map(str, box.resolutions)), offset, episodes,
               " ".join(map(str, successes)), steps, round(seconds, 2))


def write_paths(folder, path):
    """Write the walls of a maze, and one way to each goal of an agent in line with them."""
    recording, box, walked = mazes.load(folder, DRAWN, 0), in_line(DRAWN), []
    solved(towards_thing(watched(recording, box)), box, DRAWN, 1, 0, walked)
    maze = mazes.environment(DRAWN).unwrapped
    rows = [("wall", 0, *maze.ij_to_xy(square)) for square in np.argwhere(maze.maze_map == 1).tolist()]
    for number, (way, goal) in enumerate(walked):
        thinned = [*way[:-1:THINNED], way[-1]]
        rows += [("way", number, *place) for place in np.round(thinned, 2).tolist()]
        rows.append(("goal", number, *np.round(goal, 2).tolist()))
    with Path(path).open("w", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows([("kind", "number", "x", "y"), *rows])


def main(folder, path):
    """Compute all rows whose data sets are in a folder, and write them to a table."""
    path, known = Path(path), set()
    if path.exists():
        with path.open(newline="") as file:
            known = {(row["part"], row["name"], int(row["seed"]), row["pilot"], float(row["offset"]))
                     for row in csv.DictReader(file)}
    else:
        path.write_text(",".join(Row._fields) + "\n")
    still = mazes.Recording(np.zeros((2, 2)), np.zeros((2, 2)), np.zeros(2, bool))
    watched(still, in_line("pointmaze-medium"))  # compiles, which is no learning
    for job in plan():
        if job[:5] not in known and (Path(folder) / f"{job[1]}-{job[2]}.npz").exists():
            with path.open("a", newline="") as file:
                csv.writer(file, lineterminator="\n").writerow(row_of(folder, *job))


if __name__ == "__main__":
    main(*sys.argv[1:3])
    write_paths(sys.argv[1], Path(sys.argv[2]).with_name("paths.csv"))
