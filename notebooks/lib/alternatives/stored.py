"""Stored tables of runs that take too long for a page: those of deep learners, and long ones of all others.

A table of a search has a row for each setting tried, with its reward per second in the last third. A table of runs has
a row for each run, with its processor seconds (NaN if it was not timed), kilobytes, and reward in each minute of 3,000
steps. The package has ``deep_search.csv`` and ``deep_runs.csv`` (`lib.alternatives.deep_runs`),
``search.csv`` (`lib.alternatives.search`) and ``long_runs.csv`` (`lib.alternatives.long_runs`).
"""

import csv
from pathlib import Path

import numpy as np

METHODS = ("DQN", "QR-DQN", "PPO")
MINUTE = 3_000  # steps
SEARCH_FIELDS = ("method", "number", "rate")
RUN_FIELDS = ("method", "creeps", "steps", "run", "seconds", "kilobytes", "rewards")
FOLDER = Path(__file__).parent


def read_search(path):
    """The rows of a table of a search: [{"method": str, "number": int, "rate": float}]."""
    with open(path, newline="") as file:
        return [{"method": row["method"], "number": int(row["number"]), "rate": float(row["rate"])}
                for row in csv.DictReader(file)]


def chosen(rows):
    """The number of each method's best setting, the first of equal ones: {method: number}."""
    best = {}
    for row in rows:
        if row["method"] not in best or row["rate"] > best[row["method"]]["rate"]:
            best[row["method"]] = row
    return {method: row["number"] for method, row in best.items()}


def read_runs(path):
    """The rows of a table of runs: numbers for all but the method, and "rewards" as float64 (minutes,)."""
    with open(path, newline="") as file:
        return [{"method": row["method"], **{name: int(row[name]) for name in ("creeps", "steps", "run")},
                 **{name: float(row[name]) for name in ("seconds", "kilobytes")},
                 "rewards": np.array(row["rewards"].split(), float)} for row in csv.DictReader(file)]


def append(path, fields, row):
    """Append a row to a table, which is created with a header of `fields` if it does not exist."""
    new = not Path(path).exists()
    with open(path, "a", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows([fields, row] if new else [row])


def row_of_run(method, creeps, steps, run, seconds, kilobytes, rewards):
    """A row for `append`. rewards: of each minute, whole numbers in WaterWorld without an end reward."""
    return method, creeps, steps, run, f"{seconds:.3g}", f"{kilobytes:.4g}", " ".join(f"{each:.0f}" for each in rewards)


def finished(path):
    """The runs in a table: {(method, creeps, steps, run)}."""
    rows = read_runs(path) if Path(path).exists() else ()
    return {(row["method"], row["creeps"], row["steps"], row["run"]) for row in rows}
