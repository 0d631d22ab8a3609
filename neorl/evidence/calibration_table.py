"""The table of readings that a calibration has run: what each chose and what came out, kept exactly.

A row holds a reading, the seed, runs and steps that it lived with, and the statistics of the groups of conditions that
it has been run in; the others are missing. So any row can be computed again, to the last digit. Numbers that were
chosen stand in full, statistics with 5 significant digits, which is also how they are kept before they are written.
"""

import csv
import io
from ast import literal_eval
from dataclasses import dataclass, field, fields, replace
from importlib import resources

import numpy as np

from neorl import checks
from neorl.evidence.calibration_targets import GROUPS, TARGETS, Measure, distance, held, measure, tested
from neorl.evidence.reading import Reading, conditions as all_conditions
from neorl.experiments.sweeping import sweep

SHIPPED = resources.files("neorl.evidence") / "calibration.csv"
OWN = ("wave", "seed", "runs", "steps")


@dataclass(frozen=True)
class Row:
    """One reading that has been run.

    wave: in which it was chosen, 0 for the design. seed, runs: of all its conditions. steps: at most, see
    `reading.conditions`. statistics: {name of the target: `Measure`}, of the groups it has been run in.
    """

    wave: int
    seed: int
    runs: int
    steps: int
    reading: Reading
    statistics: dict = field(default_factory=dict)

    @property
    def groups(self):
        """The groups that it has been run in: a tuple of names."""
        return tuple(name for name, group in GROUPS.items() if all(each in self.statistics for each in group.targets))

    @property
    def complete(self):
        """Whether it has been run in all groups."""
        return len(self.statistics) == len(TARGETS)

    @property
    def distance(self):
        """How far it is from the targets that were measured, see `calibration_targets.distance`."""
        return distance(self.statistics)

    @property
    def held(self):
        """The claims that hold: a frozenset of names."""
        return held(self.statistics)

    @property
    def tested(self):
        """The claims that were measured: a frozenset of names."""
        return tested(self.statistics)


def conditions(row, group):
    """The conditions of a row in a group: {key: `Condition`}."""
    found = all_conditions(row.reading, row.steps, row.runs, row.seed)
    return {key: found[key] for key in GROUPS[group].keys}


def run(rows, group, executor=None, progress=False):
    """The rows with the statistics of a group, for which all their conditions are computed by `sweep`: a list."""
    wanted = [conditions(row, group) for row in rows]
    results = sweep([each for of_row in wanted for each in of_row.values()], executor, progress)
    return [replace(row, statistics=row.statistics | measure(group, {key: next(results) for key in of_row}))
            for row, of_row in zip(rows, wanted)]


def lives(row, groups=tuple(GROUPS), executor=None, progress=False):
    """What a row's reading lived in groups: {key of the condition: `Result`}."""
    wanted = {key: each for group in groups for key, each in conditions(row, group).items()}
    return dict(zip(wanted, sweep(list(wanted.values()), executor, progress)))


def measured(row, life):
    """The row with the statistics of what `lives` gave, of all groups that it has every condition of."""
    groups = [name for name, group in GROUPS.items() if all(key in life for key in group.keys)]
    return replace(row, statistics={name: each for group in groups for name, each in measure(group, life).items()})


def rerun(table, n, seed=0, groups=tuple(GROUPS), executor=None):
    """Compute n rows of a table again: [(row as it stands, row as it comes out), …], which should be equal.

    They are drawn without replacement. groups: names; a row is compared in those of them that it has been run in.
    Raises ValueError if n is not an integer from 1 to the number of rows.
    """
    chosen = np.random.default_rng(seed).choice(len(table), checks.integer("n", n, 1, len(table)), replace=False)
    rows = [table[i] for i in sorted(chosen)]
    shared = [tuple(name for name in row.groups if name in groups) for row in rows]
    kept = [replace(row, statistics={name: row.statistics[name] for group in common for name in GROUPS[group].targets})
            for row, common in zip(rows, shared)]
    again = [replace(row, statistics={}) for row in rows]
    for group in GROUPS:
        of_group = [i for i, common in enumerate(shared) if group in common]
        for i, row in zip(of_group, run([again[i] for i in of_group], group, executor)):
            again[i] = row
    return list(zip(kept, again))


def nearest(table):
    """The complete rows by their distance, the nearest first; of rows with the same reading the one with most runs.

    Raises ValueError if no row is complete.
    """
    by_reading = {}
    for row in table:
        if row.complete and (row.reading not in by_reading or by_reading[row.reading].runs < row.runs):
            by_reading[row.reading] = row
    if not by_reading:
        raise ValueError(f"table has {len(table)} rows, none of them with all groups measured")
    return sorted(by_reading.values(), key=lambda row: row.distance)


def write_table(table, path):
    """Write rows to a file of comma-separated values, one line each after a line of names."""
    content = io.StringIO()
    writer = csv.writer(content, lineterminator="\n")
    choices = [each.name for each in fields(Reading)]
    writer.writerow([*OWN, *choices, *TARGETS, *(f"error of {name}" for name in TARGETS)])
    for row in table:
        measured = [row.statistics.get(name, ("", "")) for name in TARGETS]
        writer.writerow([*(getattr(row, name) for name in OWN),
                         *(_written(getattr(row.reading, name)) for name in choices),
                         *(value for value, _ in measured), *(error for _, error in measured)])
    path.write_text(content.getvalue(), encoding="utf-8")


def read_table(path=SHIPPED):
    """The rows of a file that `write_table` has written: a list of `Row`. By default the one of this package.

    Raises ValueError if its columns are not those of this version.
    """
    kinds = {each.name: type(each.default) for each in fields(Reading)}
    expected = {*OWN, *kinds, *TARGETS, *(f"error of {name}" for name in TARGETS)}
    lines = csv.DictReader(io.StringIO(path.read_text(encoding="utf-8")))
    if set(lines.fieldnames or ()) != expected:
        differing = sorted(expected ^ set(lines.fieldnames or ()))
        raise ValueError(f"{path} has other columns than this version has: {', '.join(differing)}")
    table = []
    for line in lines:
        reading = Reading(**{name: line[name] if kind is str else literal_eval(line[name])
                             for name, kind in kinds.items()})
        statistics = {name: Measure(float(line[name]), float(line[f"error of {name}"]))
                      for name in TARGETS if line[name]}
        table.append(Row(*(int(line[name]) for name in OWN), reading, statistics))
    return table


def _written(value):
    return value if isinstance(value, str) else repr(value)
