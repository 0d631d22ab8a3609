"""Maps that need no luck with the walls: a search for them on two mazes, and what was chosen on all.

1. A candidate has maps, a weighting of these, and what moves the point where all values are 0: the noise "alone", or
   the last push "as before" with more noise. Maps are given by the sizes of their cells in units; each divides the box,
   which is `ROOM` wider than the maze, into the nearest prime number of cells, so that borders of maps do not coincide.
   The pair of 2 units and 1 unit is the agent in line; its numbers are no primes.
2. An *offset* moves the box by a random vector, the same for all candidates. The candidates are compared on medium and
   large alone, at `TRIED` offsets, with data seed 0 and ten episodes for each goal. That with the greatest *least*
   success over sets and offsets is chosen; of those within `EQUAL` percent of it, that with the fewest maps, and then
   the first in the order of `CANDIDATES`.
3. The chosen one, and the agent in line beside it, are then run on all eight sets at `FRESH` other offsets.

This was fixed before giant or teleport were looked at. ``python -m companion.recordings.search DATA search.csv``
computes all of it, and goes on where it was interrupted.
"""

import csv
import functools
import sys
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

import numpy as np

from companion.recordings import benchmark, mazes
from companion.recordings.pilots import pupil, towards_thing

MAPS = {"2 + 1": (2.0, 1.0), "2.4 + 1.7 + 1.1": (2.4, 1.7, 1.1), "2.8 + 2.1 + 1.5 + 1": (2.8, 2.1, 1.5, 1.0)}
WEIGHTINGS = "cells", "equal"
LOST = "alone", "as before"
CANDIDATES = [(maps, weighting, lost) for maps in MAPS for weighting in WEIGHTINGS for lost in LOST]
IN_LINE = CANDIDATES[0]
ROOM = 3.0  # units, by which the box is wider than the maze; the greatest offset
TRIED, FRESH = range(4), range(100, 105)  # seeds of offsets
EQUAL = 2.0  # percent
COMPARED = [name for name in mazes.SIZES if "medium" in name or "large" in name]


class Row(NamedTuple):
    """What became of a candidate at an offset."""

    name: str  # of the data set
    offset: int  # its seed
    maps: str
    weighting: str
    lost: str
    successes: str


def is_prime(number):
    """Whether a number is a prime."""
    return number > 1 and all(number % factor for factor in range(2, int(number**0.5) + 1))


def box_of(name, maps, offset):
    """The `benchmark.Box` of some maps over a maze, at an offset."""
    side = mazes.UNIT * benchmark.SQUARES[name.split("-")[1]] + ROOM
    corner = -mazes.UNIT / 2 - np.random.default_rng(offset).uniform(0, ROOM, 2)
    if maps == IN_LINE[0]:
        coarse = int(side // benchmark.COARSE) + 1
        return benchmark.Box(tuple(corner), coarse * benchmark.COARSE, (coarse, 2 * coarse))
    primes = np.array([number for number in range(2, 2 * int(side)) if is_prime(number)])
    return benchmark.Box(tuple(corner), side, tuple(int(primes[np.abs(primes - side / size).argmin()])
                                                    for size in MAPS[maps]))


def carrying_on(pilot):
    """A pilot that goes on as before, with some noise, where another knows no way."""
    def to(goal):
        push, before = pilot(goal), [np.zeros(2)]
        rng = np.random.default_rng(0)

        def pushed(place):
            ahead = push(place)
            if not ahead.any():
                ahead = np.clip(before[0] + benchmark.NOISE * rng.normal(size=2), -1.0, 1.0)
            before[0] = ahead
            return ahead
        return pushed
    return to


@functools.lru_cache(maxsize=1)
def learner_of(folder, name, maps, offset):
    """The `pupil` of the first data seed at an offset, and its box."""
    recording, box = mazes.load(folder, name, 0), box_of(name, maps, offset)
    return pupil(box.within(recording.positions), box.resolutions, ends=recording.ends[:-1],
                 actions=recording.actions[:-1]), box


def row_of(folder, name, offset, maps, weighting, lost):
    """Compute a `Row`."""
    learner, box = learner_of(folder, name, maps, offset)
    (node,) = learner.agent.nodes
    learner.change(replace(learner.agent, nodes=[replace(node, weighting=weighting)]))  # keeps all values
    pilot = towards_thing(learner)
    if lost == LOST[1]:
        pilot = carrying_on(pilot)
    successes, _ = benchmark.solved(pilot, box, name, benchmark.FEWER, offset)
    return Row(name, offset, maps, weighting, lost, " ".join(map(str, successes)))


def least(rows, candidate, names, offsets):
    """The least success of a candidate in percent over data sets and offsets."""
    return min(2.0 * sum(map(int, row.successes.split())) for row in rows
               if row[2:5] == candidate and row.name in names and row.offset in offsets)


def chosen(rows):
    """The candidate that the rule chooses."""
    levels = {candidate: least(rows, candidate, COMPARED, TRIED) for candidate in CANDIDATES}
    equal = [candidate for candidate in CANDIDATES if levels[candidate] >= max(levels.values()) - EQUAL]
    return min(equal, key=lambda candidate: len(MAPS[candidate[0]]))


def read(path):
    """The `Row`s of a table."""
    with Path(path).open(newline="") as file:
        return [Row(row["name"], int(row["offset"]), row["maps"], row["weighting"], row["lost"], row["successes"])
                for row in csv.DictReader(file)]


def main(folder, path):
    """Compute all rows, the comparison first."""
    if not Path(path).exists():
        Path(path).write_text(",".join(Row._fields) + "\n")
    compute(folder, path, [(name, offset, *candidate) for offset in TRIED for name in COMPARED
                           for candidate in CANDIDATES])
    finalists = dict.fromkeys((chosen(read(path)), IN_LINE))
    compute(folder, path, [(name, offset, *candidate) for offset in FRESH for name in mazes.SIZES
                           for candidate in finalists])


def compute(folder, path, jobs):
    """Compute the rows of some jobs that a table lacks."""
    known = {row[:5] for row in read(path)}
    for job in jobs:
        if job not in known:
            with Path(path).open("a", newline="") as file:
                csv.writer(file, lineterminator="\n").writerow(row_of(folder, *job))


if __name__ == "__main__":
    main(*sys.argv[1:])
