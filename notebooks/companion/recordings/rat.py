"""How many ways agents find that watched a rat: the program behind `rat.csv`, at more ways than the page takes.

``python -m companion.recordings.rat rat.csv`` computes it in some minutes.
"""

import csv
import sys
from pathlib import Path

import numpy as np

from companion.recordings import pilots, ways

WAYS, SEED = 300, 1_000
RESOLUTIONS = 9, 14
FIELDS = "watched", "ways", "arrived", "times"


def rows():
    """A row for each pilot: what it watched, its ways, how many arrived, the median time of these."""
    path, missing = ways.rat(10)
    half, missing_there = ways.rat(5)
    agents = {"nothing": (path[:1], ()), "5 minutes": (half, missing_there), "10 minutes": (path, missing)}
    rivals = {name: pilots.towards_thing(pilots.pupil(seen, RESOLUTIONS, ends=ends))
              for name, (seen, ends) in agents.items()}
    rivals["graph, 10 minutes"] = pilots.by_graph(path, max(RESOLUTIONS), missing)
    for name, pilot in rivals.items():
        tour = ways.tour(pilot, ways.box(), WAYS, SEED)
        yield name, WAYS, int(tour.arrived.sum()), round(float(np.median(tour.times[tour.arrived])), 3)


def main(path):
    """Write the table."""
    with Path(path).open("w", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows([FIELDS, *rows()])


if __name__ == "__main__":
    main(*sys.argv[1:])
