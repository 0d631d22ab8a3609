"""How much the claims depend on what the text leaves open, from the table of readings that were run at full length.

1. The *design* of the table has readings drawn evenly within the text, which no result selected. The share of them in
   which a claim's means agree with the thesis tells robust claims from fragile ones.
2. *Setbacks* are the book's reading with one choice at a time set back to the letter. A claim *flips* if it agrees in
   one of the two alone, and a number that decides so differs by more than two standard errors.
3. The *total effect* of a choice is the share of a number's variance over evenly drawn readings that is gone once the
   choice is known together with all others, and not without it (Homma and Saltelli 1996), as the emulator predicts it.
"""

from functools import cache
from typing import NamedTuple

import numpy as np
import scipy

from companion.study import calibration_table
from companion.study.calibration_table import Row, best, claims_together, read_table
from companion.study.calibration_targets import CLAIMS, GROUPS, TARGETS
from companion.study.emulator import Emulator, reading_at
from companion.thesis.priors import WITHIN
from companion.thesis.reading import LENGTHS, TO_THE_LETTER, Reading

IN_FULL = 48  # of the readings of the design: the first, which were run in every group
STEPS = max(LENGTHS.values())  # of a run at most
POINTS = 256  # of the estimate of total effects, a power of two
EXPLAINED = 0.1  # the least R² on evenly drawn readings at which an emulator counts
MATTERS = 0.1  # the least total effect of a choice that matters
CLEAR = 2  # standard errors


class Findings(NamedTuple):
    """What the page of claims says from a table of readings."""

    table: list
    calibrated: Row  # the best reading
    letter: Row | None
    flips: dict  # see `flips`
    apart: list  # see `Together.apart`


def findings(table):
    """The `Findings` of a table of readings."""
    return Findings(table, best(table), literal(table), flips(table), claims_together(table).apart)


@cache
def shipped():
    """The `Findings` of the table in the repository."""
    return findings(read_table())


def evenly(table):
    """How often numbers agree with the thesis in rows of the design: {claim: {"agrees", "measured"}}, counts of rows.

    Rows that were run in more groups than most, since results had selected them, do not count.
    """
    found = {claim: drawn(table, claim) for claim in CLAIMS}
    return {claim: {"agrees": sum(claim in row.agreeing for row in rows), "measured": len(rows)}
            for claim, rows in found.items()}


def drawn(table, claim):
    """The rows of the design in which a claim was measured, a list."""
    design = [row for row in table if row.wave == 0]
    rows = design if all(claim in row.tested for row in design) else design[:IN_FULL]
    return [row for row in rows if claim in row.tested]


def literal(table):
    """The row of the reading to the letter, or None."""
    return next((row for row in table if row.reading == TO_THE_LETTER and row.complete), None)


def setbacks(table, reading=Reading()):
    """The complete rows of a reading with one choice set back to the letter: {choice: Row}, the last of each choice."""
    of = _departing(reading)
    return {of[row.reading]: row for row in table if row.complete and row.reading in of}


def set_back(table, runs):
    """Run the reading to the letter, and the default with each choice that departs from it set back, in every group.

    Returns the longer table. Readings that it has already are left out; the rows share a seed, since they vary one.
    """
    known = {row.reading for row in table if row.complete}
    wave = 1 + max((row.wave for row in table), default=0)
    rows = [Row(wave, len(table), runs, STEPS, reading) for reading in (TO_THE_LETTER, *_departing(Reading()))
            if reading not in known]
    for group in GROUPS:
        rows = calibration_table.run(rows, group)
    return [*table, *rows]


def _departing(reading):
    """A reading with each choice that departs from the letter set back to it: {reading: choice}."""
    return {reading.varied(**{name: TO_THE_LETTER.choices[name]}): name for name in WITHIN
            if reading.choices[name] != TO_THE_LETTER.choices[name]}


class Flips(NamedTuple):
    """The claims that agree no longer, and those that agree only now, once a choice is set back: tuples of names."""

    lost: tuple
    gained: tuple


def flips(table):
    """What setting back each choice of the best reading does: {choice: `Flips`}, those with most flips first."""
    here = best(table)
    found = {name: Flips(*(_clear(here, row, claims) for claims in (here.agreeing - row.agreeing,
                                                                    row.agreeing - here.agreeing)))
             for name, row in setbacks(table, here.reading).items()}
    return dict(sorted(found.items(), key=lambda item: -sum(map(len, item[1]))))


def _clear(one, other, claims):
    """Those of some claims of which a number that agrees in one row alone differs clearly, a sorted tuple."""
    def apart(name):
        (value, error), (also, spread) = one.statistics[name], other.statistics[name]
        return (TARGETS[name].holds(value) != TARGETS[name].holds(also)
                and abs(value - also) > CLEAR * np.hypot(error, spread))

    return tuple(sorted({TARGETS[name].claim for name in TARGETS if TARGETS[name].claim in claims and apart(name)}))


def total_effects(table, points=POINTS):
    """The total effect of each choice on each claim: {claim: {choice: effect}}, that on the number it affects most.

    A number of which the emulator explains less than `EXPLAINED` of the variance does not count.
    """
    emulator = Emulator(table)
    explained = [name for name, share in emulator.explained.items() if share >= EXPLAINED]

    def predicted(shares):
        means = emulator.predict([reading_at(each) for each in shares.T])
        return np.array([means[name][0] for name in explained])

    spread = scipy.stats.sobol_indices(func=predicted, n=points, dists=[scipy.stats.uniform()] * len(WITHIN), rng=0)
    found = {claim: {} for claim in CLAIMS}
    for name, effects in zip(explained, spread.total_order):
        of_claim = found[TARGETS[name].claim]
        for choice, effect in zip(WITHIN, effects):
            of_claim[choice] = max(of_claim.get(choice, 0.0), float(effect))
    return found


def matters(effects, choice):
    """The claims for which a choice matters, those on which it has most effect first: a list of names."""
    found = {claim: of_claim.get(choice, 0.0) for claim, of_claim in effects.items()}
    return sorted((claim for claim in found if found[claim] >= MATTERS), key=found.get, reverse=True)
