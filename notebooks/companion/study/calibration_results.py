"""Results of a calibration: the choices that remain, the claims that hold together, the reading nearest to the thesis.

A claim holds in a row if the means over the row's few runs lie in the intervals of all the claim's targets. So a claim
may hold in a row by luck; that it holds in none is the stronger finding. A row is *complete* if run in all groups.
"""

import math
from itertools import combinations
from typing import NamedTuple

import numpy as np
import scipy

from companion.shared.priors import WITHIN
from companion.study.calibration import IN_FULL, Emulator, reading_at
from companion.study.calibration_table import leading, nearest
from companion.study.calibration_targets import CLAIMS, TARGETS, distance
from companion.study.multiverse import binned
from companion.thesis.reading import Reading

NEAREST = 25  # rows that stand for the posterior where none agrees with all targets
DRAWS = 10_000
INTERVALS = 6  # of equal probability, into which the prior of a number is cut
CONFIRMED = 100  # runs of each condition
LEAST_EXPECTED = 3.0  # rows: if two independent claims hold together in this many on average, none is rare (5 %)


class Posterior(NamedTuple):
    """The readings that remain, and their weights, which add up to 1."""

    readings: list
    weights: np.ndarray  # (readings,)

    @property
    def effective(self):
        """The effective sample size: how many readings of equal weight would be as informative (Kish 1965)."""
        return float(1 / np.sum(self.weights**2))


def accepted(table):
    """The complete rows that agree with all targets; if none does, the 25 nearest."""
    complete = nearest(table)
    return [row for row in complete if row.distance == 0] or complete[:NEAREST]


def posterior(table, draws=DRAWS, seed=0):
    """Fresh draws from the priors, weighted by how well the emulator expects them to agree with all targets.

    The weights are exp(−½ Σ distance²) over targets, with the emulator's own uncertainty.
    """
    rng = np.random.default_rng(seed)
    readings = [reading_at(shares) for shares in rng.random((draws, len(WITHIN)))]
    each = np.array(list(Emulator(table, seed).implausibility(readings).values()))
    logs = -0.5 * np.sum(each**2, axis=0)
    weights = np.exp(logs - logs.max())
    return Posterior(readings, weights / weights.sum())


def equally(rows):
    """A `Posterior` of the readings of rows, with equal weights."""
    return Posterior([row.reading for row in rows], np.full(len(rows), 1 / len(rows)))


class Marginal(NamedTuple):
    """The distribution of one choice over its levels, or over intervals of its numbers, before and after."""

    levels: tuple[str, ...]
    prior: np.ndarray  # (levels,)
    posterior: np.ndarray  # (levels,)

    @property
    def information(self):
        """The information gained from prior to posterior, in bits (Kullback and Leibler 1951)."""
        return float(scipy.stats.entropy(self.posterior, self.prior, base=2))


def marginal(name, remaining):
    """The `Marginal` of a choice of `priors.WITHIN` in a `Posterior`."""
    levels, prior, places = binned(name, remaining.readings, INTERVALS)
    return Marginal(levels, prior, np.bincount(places, remaining.weights, len(levels)))


def most_informative(remaining, n):
    """The n choices on which the posterior gains most information, the most informative first: a list of names."""
    said = {name: marginal(name, remaining).information for name in WITHIN}
    return sorted(said, key=said.get, reverse=True)[:n]


class Together(NamedTuple):
    """The numbers of rows in which claims hold together: (claims, claims)."""

    claims: tuple[str, ...]
    rows: np.ndarray  # in which both were measured
    both: np.ndarray  # in which both hold
    expected: np.ndarray  # in which both would hold if they were independent
    sets: list  # of (claims that hold together, complete rows in which they do), the largest first

    @property
    def pairs(self):
        """Pairs of claims: (name, name, rows in which both hold, expected), the least first."""
        pairs = [(self.claims[i], self.claims[j], int(self.both[i, j]), float(self.expected[i, j]))
                 for i, j in combinations(range(len(self.claims)), 2)]
        return sorted(pairs, key=lambda pair: (pair[2] + 1) / (pair[3] + 1))

    @property
    def never(self):
        """The pairs that never hold together, though expected in three rows or more: a list of (name, name)."""
        return [pair[:2] for pair in self.pairs if pair[2] == 0 and pair[3] >= LEAST_EXPECTED]


def claims_together(table):
    """Count the rows in which pairs and sets of claims hold together."""
    tested = np.array([[name in row.tested for name in CLAIMS] for row in table], float)
    held = np.array([[name in row.agreeing for name in CLAIMS] for row in table], float)
    rows, both = tested.T @ tested, held.T @ held
    alone = held.T @ tested  # rows with both measured in which the first holds
    expected = np.divide(alone * alone.T, rows, out=np.zeros(rows.shape), where=rows > 0)
    found = [row.agreeing for row in nearest(table)]
    largest = [each for each in set(found) if not any(each < other for other in found)]
    sets = [(tuple(sorted(each)), sum(each <= other for other in found)) for each in largest]
    sets.sort(key=lambda entry: (-len(entry[0]), -entry[1], entry[0]))
    return Together(CLAIMS, rows.astype(int), both.astype(int), expected, sets)


def evenly(table):
    """How often numbers agree with the thesis in rows of the design, where results selected none.

    Returns {claim: {"agrees", "measured"}}, counts of rows.
    """
    design = [row for row in table if row.wave == 0]
    found = {}
    for claim in CLAIMS:
        rows = design if all(claim in row.tested for row in design) else design[:IN_FULL]
        measured = [row for row in rows if claim in row.tested]
        found[claim] = {"agrees": sum(claim in row.agreeing for row in measured), "measured": len(measured)}
    return found


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


def giving(table):
    """The gain from giving up each claim: {claim: (smallest distance to the targets of the others, its Row)}."""
    complete, found = nearest(table), {}
    for claim in CLAIMS:
        def without(row, claim=claim):
            return distance({name: each for name, each in row.statistics.items() if TARGETS[name].claim != claim})
        near = min(complete, key=without)
        found[claim] = without(near), near
    return found


class Conflict(NamedTuple):
    """A target that a row misses, and of those that it meets the one with which it goes together least."""

    missed: str
    met: str
    both: int  # rows that meet both
    expected: float  # rows that would if the two were independent
    found: np.ndarray  # the values of all rows, (rows, 2), those of the missed target first


def conflicts(table, row):
    """What meeting each target that a row misses would cost: a list of `Conflict`, in the order of the targets.

    The most telling pair has the least both / expected, in rows with both measured.
    """
    meets = {name: target.holds(row.statistics[name].value) for name, target in TARGETS.items()}
    return [min((_conflict(table, missed, met) for met in meets if meets[met]),
                key=lambda each: (each.both + 1) / (each.expected + 1))
            for missed in meets if not meets[missed] and any(meets.values())]


def _conflict(table, *names):
    found = np.array([[row.statistics[name].value for name in names] for row in table
                      if all(name in row.statistics for name in names)]).reshape(-1, 2)
    held = np.array([[TARGETS[name].holds(value) for value in found[:, i]] for i, name in enumerate(names)], bool)
    return Conflict(*names, int(held.all(axis=0).sum()), float(np.prod(held.sum(axis=1)) / max(len(found), 1)), found)


def progress(table):
    """The smallest distance of a complete row up to each wave: {wave: distance}, infinite while there is none."""
    least, found = math.inf, {}
    for wave in sorted({row.wave for row in table}):
        least = min([least, *(row.distance for row in table if row.wave == wave and row.complete)])
        found[wave] = least
    return found
