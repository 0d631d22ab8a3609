"""Results of a calibration: the claims that hold together, the reading for which most do, and how the search went on.

A claim holds in a row if the means over the row's few runs lie in the intervals of all the claim's targets. So a claim
may hold in a row by luck; that it holds in none is the stronger finding. A row is *complete* if run in all groups.
"""

import math
from itertools import combinations
from typing import NamedTuple

import numpy as np
import scipy

from companion.study.calibration_table import leading, nearest
from companion.study.calibration_targets import CLAIMS
from companion.thesis.reading import Reading

CONFIRMED = 100  # runs of each condition
RARE = 0.01  # the chance at which a pair of claims pulls apart


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
