"""The table of readings that the search has run, the best of them, and the claims that hold together.

1. A row holds a reading, the seed, runs and steps it was run with, and the statistics of the groups of conditions in
   which it has been run; it is *complete* if run in all. So any row can be recomputed to the last digit. Chosen numbers
   are stored in full, statistics with 5 significant digits, in memory as on disk.
2. A claim holds in a row if the means over the row's few runs lie in the intervals of all the claim's targets. So a
   claim may hold in a row by luck; that it holds in none is the stronger finding.
"""

import csv
import io
import math
from ast import literal_eval
from dataclasses import dataclass, field, replace
from itertools import combinations
from pathlib import Path
from typing import NamedTuple

import numpy as np
import scipy

from companion.study.calibration_targets import CLAIMS, GROUPS, TARGETS, Measure, distance, measure
from companion.thesis.reading import Reading, conditions as all_conditions
from neorl.experiments.simulation import sweep

SHIPPED = Path(__file__).with_name("calibration.csv")
OWN = ("wave", "seed", "runs", "steps")
CONFIRMED = 100  # runs of each condition
RARE = 0.01  # the chance at which a pair of claims pulls apart


@dataclass(frozen=True)
class Row:
    """One reading that has been run."""

    wave: int  # in which it was chosen, 0 for the design
    seed: int
    runs: int  # of each condition
    steps: int  # of a run at most, see `reading.conditions`
    reading: Reading
    statistics: dict = field(default_factory=dict)  # {target: `Measure`}, of the groups in which it has been run

    @property
    def groups(self):
        """The groups in which it has been run: a tuple of names."""
        return tuple(name for name, group in GROUPS.items() if all(each in self.statistics for each in group.targets))

    @property
    def complete(self):
        """Whether it has been run in all groups."""
        return len(self.statistics) == len(TARGETS)

    @property
    def distance(self):
        """Its distance from the targets that were measured, see `calibration_targets.distance`."""
        return distance(self.statistics)

    @property
    def tested(self):
        """The claims whose targets are all measured: a frozenset of names."""
        return frozenset(CLAIMS) - {target.claim for name, target in TARGETS.items() if name not in self.statistics}

    @property
    def agreeing(self):
        """The tested claims whose targets all agree with the thesis: a frozenset of names."""
        return self.tested - {TARGETS[name].claim for name, found in self.statistics.items()
                              if not TARGETS[name].holds(found.value)}


def conditions(row, group):
    """The conditions of a row in a group: {key: `Condition`}."""
    found = all_conditions(row.reading, row.steps, row.runs, row.seed)
    return {key: found[key] for key in GROUPS[group].keys}


def run(rows, group):
    """Run the conditions of rows in a group by `sweep`, and return the rows with its statistics: a list."""
    wanted = [conditions(row, group) for row in rows]
    results = sweep([each for of_row in wanted for each in of_row.values()], progress=False)
    return [replace(row, statistics=row.statistics | measure(group, {key: next(results) for key in of_row}))
            for row, of_row in zip(rows, wanted)]


def measured(row, results):
    """The row with the statistics of results, {key of the condition: `Result`}, for each group that is complete."""
    groups = [name for name, group in GROUPS.items() if all(key in results for key in group.keys)]
    return replace(row, statistics={name: each for group in groups for name, each in measure(group, results).items()})


def nearest(table):
    """The complete rows, the nearest first; those of the same reading are `pooled`. Raises ValueError for none."""
    by_reading = {}
    for row in table:
        if row.complete:
            by_reading.setdefault(row.reading, []).append(row)
    if not by_reading:
        raise ValueError(f"table has {len(table)} rows, none of them with all groups measured")
    return sorted(map(pooled, by_reading.values()), key=lambda row: row.distance)


def pooled(rows):
    """Complete rows of the same reading in one, with the means of those that have most runs and the sum of their runs.

    The others were run before the reading was chosen to be confirmed, and had to be lucky for that.
    """
    most = max(row.runs for row in rows)
    rows = [row for row in rows if row.runs == most]
    found = {name: np.array([row.statistics[name] for row in rows]).T for name in TARGETS}
    return replace(rows[-1], runs=most * len(rows), statistics={
        name: Measure(values.mean(), np.hypot.reduce(errors) / len(rows)) for name, (values, errors) in found.items()})


def leading(table):
    """The complete rows, those for which most claims hold first: the nearest reading does not reproduce most."""
    return sorted(nearest(table), key=lambda row: -len(row.agreeing))


def best(table):
    """The row of `equals` with the reading of the book, so that agents keep their runs, or else the nearest."""
    rows = equals(table)
    return next((row for row in rows if row.reading == Reading()), rows[0])


def confirmed(table, runs=CONFIRMED):
    """The complete rows of as many runs or more, those for which most claims hold first, the nearest among equals."""
    return [row for row in leading(table) if row.runs >= runs]


def equals(table):
    """The rows for which most claims hold among those with the most runs, the nearest first: see `leading`."""
    found = confirmed(table, max(row.runs for row in nearest(table)))
    return [row for row in found if len(row.agreeing) == len(found[0].agreeing)]


def progress(table):
    """The smallest distance of a complete row up to each wave: {wave: distance}, infinite while there is none."""
    least, found = math.inf, {}
    for wave in sorted({row.wave for row in table}):
        least = min([least, *(row.distance for row in table if row.wave == wave and row.complete)])
        found[wave] = least
    return found


class Together(NamedTuple):
    """The numbers of rows in which claims hold together: (claims, claims)."""

    claims: tuple[str, ...]
    rows: np.ndarray  # in which both were measured
    both: np.ndarray  # in which both hold
    expected: np.ndarray  # in which both would hold if they were independent

    @property
    def pairs(self):
        """Pairs of claims: (name, name, rows in which both hold, expected), the least first."""
        pairs = [(self.claims[i], self.claims[j], int(self.both[i, j]), float(self.expected[i, j]))
                 for i, j in combinations(range(len(self.claims)), 2)]
        return sorted(pairs, key=lambda pair: (pair[2] + 1) / (pair[3] + 1))

    @property
    def apart(self):
        """Those of `pairs` that hold together in so few rows by chance in one case of a hundred (Poisson)."""
        return [pair for pair in self.pairs if scipy.stats.poisson.cdf(*pair[2:]) < RARE]


def claims_together(table):
    """Count the rows in which pairs of claims hold together."""
    tested = np.array([[name in row.tested for name in CLAIMS] for row in table], float)
    held = np.array([[name in row.agreeing for name in CLAIMS] for row in table], float)
    rows, both = tested.T @ tested, held.T @ held
    alone = held.T @ tested  # rows with both measured in which the first holds
    expected = np.divide(alone * alone.T, rows, out=np.zeros(rows.shape), where=rows > 0)
    return Together(CLAIMS, rows.astype(int), both.astype(int), expected)


def write_table(table, path):
    """Write rows to a file of comma-separated values, one line each below a header."""
    content = io.StringIO()
    writer = csv.writer(content, lineterminator="\n")
    writer.writerow([*OWN, *Reading().choices, *TARGETS, *(f"error of {name}" for name in TARGETS)])
    for row in table:
        measured = [row.statistics.get(name, ("", "")) for name in TARGETS]
        writer.writerow([*(getattr(row, name) for name in OWN),
                         *row.reading.choices.values(),
                         *(value for value, _ in measured), *(error for _, error in measured)])
    path.write_text(content.getvalue(), encoding="utf-8")


def read_table(path=SHIPPED):
    """Read the rows of a file written by `write_table`, or raise ValueError."""
    kinds = {name: type(value) for name, value in Reading().choices.items()}
    expected = {*OWN, *kinds, *TARGETS, *(f"error of {name}" for name in TARGETS)}
    lines = csv.DictReader(io.StringIO(path.read_text(encoding="utf-8")))
    if set(lines.fieldnames or ()) != expected:
        differing = sorted(expected ^ set(lines.fieldnames or ()))
        raise ValueError(f"{path} has other columns than this version has: {', '.join(differing)}")
    table = []
    for line in lines:
        reading = Reading().varied(**{name: line[name] if kind is str else literal_eval(line[name])
                             for name, kind in kinds.items()})
        statistics = {name: Measure(float(line[name]), float(line[f"error of {name}"]))
                      for name in TARGETS if line[name]}
        table.append(Row(*(int(line[name]) for name in OWN), reading, statistics))
    return table
