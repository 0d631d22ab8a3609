"""The search for maps that need no luck with the walls, by the rule of `companion.recordings.choosing`.

``python -m companion.recordings.search DATA search.csv`` computes all of it, and goes on where it was interrupted.
"""

import csv
import functools
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np

from companion.recordings import benchmark, mazes
from companion.recordings.choosing import (CANDIDATES, COMPARED, FRESH, LOST, MAPS, PLAIN, ROOM, TRIED, Row, chosen,
                                           read)
from companion.recordings.pilots import towards_thing


def is_prime(number):
    """Whether a number is a prime."""
    return number > 1 and all(number % factor for factor in range(2, int(number**0.5) + 1))


def box_of(name, maps, offset):
    """The `benchmark.Box` of some maps over a maze, at an offset."""
    side = mazes.UNIT * benchmark.SQUARES[name.split("-")[1]] + ROOM
    corner = -mazes.UNIT / 2 - np.random.default_rng(offset).uniform(0, ROOM, 2)
    if maps == PLAIN[0]:
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
    return benchmark.watched(recording, box), box


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


def main(folder, path):
    """Compute all rows, the comparison first."""
    if not Path(path).exists():
        Path(path).write_text(",".join(Row._fields) + "\n")
    compute(folder, path, [(name, offset, *candidate) for offset in TRIED for name in mazes.SIZES
                           if name.split("-")[1] in COMPARED for candidate in CANDIDATES])
    finalists = dict.fromkeys((chosen(read(path)), PLAIN))
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
