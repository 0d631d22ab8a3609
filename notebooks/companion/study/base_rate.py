"""How many claims about agents a reading drawn at random within the text agrees with: the base rate of agreement.

1. A *draw* is a reading at one point of a Sobol sequence through the priors (`companion.thesis.priors.WITHIN`). Beside
   the draws stand *replicates* of the calibrated reading and of the one to the letter, with other seeds. All have two
   runs of each condition at the papers' lengths, so that chance adds to and takes from all of them alike.
2. Such few runs give no verdict. A claim *agrees* if the value of every number that its rule asks for lies within its
   bounds, whatever the interval, unless the claim is not testable.
3. Of paper A's single maps the three are run that do not take most of the time.

``python -m companion.study.base_rate base_rate.csv`` makes the stored table, and resumes when rerun. Finished runs are
cached, so that a table that is begun anew under other rules takes seconds a row.
"""

import csv
import sys
from pathlib import Path
from typing import NamedTuple

import numpy as np
import scipy

from companion.study.emulator import reading_at
from companion.thesis import claims
from companion.thesis.measures import exact
from companion.thesis.priors import WITHIN
from companion.thesis.reading import LAYERS, LENGTHS, READINGS, conditions, judge
from companion.thesis.statements import AGENTS
from neorl.experiments.simulation import sweep

SHIPPED = Path(__file__).with_name("base_rate.csv")
DRAWS, REPLICATES = 30, 5
POINTS = 128  # of the sequence, a power of two, whose first are drawn
RUNS, SEED = 2, 77_000  # of each condition; the seed of the sequence, and of the runs of row 0
DRAWN = "drawn"
GROUPS = ("layers", "single", "modal", "pace", "networks", "resolutions")
SINGLE = (10, 30, 50)
LEFT_OUT = tuple(("single", n) for n in (70, 90))


class Row(NamedTuple):
    """One reading that has been judged."""

    kind: str  # `DRAWN`, or a name in `READINGS`
    number: int
    agrees: dict  # {claim: bool}, of the claims that were judged


def plan():
    """The kind and the number of every row, in the order of computation."""
    return [(kind, number) for number in range(DRAWS) for kind in (DRAWN, *READINGS)
            if kind == DRAWN or number < REPLICATES]


def reading_of(kind, number):
    """The reading of a row."""
    if kind != DRAWN:
        return READINGS[kind]
    return reading_at(scipy.stats.qmc.Sobol(len(WITHIN), rng=SEED).random(POINTS)[number])


def row_of(kind, number, groups=GROUPS):
    """Run and judge one reading on the claims for which some groups of conditions suffice: a `Row`."""
    wanted = conditions(reading_of(kind, number), LENGTHS["B"], RUNS, SEED + number, groups)
    wanted = {key: condition for key, condition in wanted.items() if key not in LEFT_OUT}
    results = dict(zip(wanted, sweep(wanted.values(), progress=False)))
    judged = judge(results)
    if {"layers", "single"} <= {*groups}:
        brownian, together = results["brownian", 8], results["layers"]
        alone, single = {n: results["layer", n] for n in LAYERS}, {n: results["single", n] for n in SINGLE}
        found = [*claims.judge_single_layer(single, brownian), claims.judge_margin(alone | single, brownian),
                 claims.judge_several(alone, single, together, brownian)]
        judged |= {claim.name: claim for claim in found}
    return Row(kind, number, {name: agrees(judged[name]) for name in AGENTS if name in judged})


def agrees(claim):
    """Whether the values of all numbers that a claim's rule asks for lie within their bounds, and it can be tested."""
    asked = [bounds.decide(exact(found.value)) for found, bounds, role in claim.numbers.values() if role == "asked"]
    return claim.outcome != "not testable" and all(asked)


def read(path=SHIPPED):
    """The rows of a stored table, a list."""
    with open(path, newline="") as file:
        return [Row(line.pop("kind"), int(line.pop("number")),
                    {name: bool(int(agreed)) for name, agreed in line.items() if agreed})
                for line in csv.DictReader(file)]


def agreeing(rows, names=AGENTS):
    """How many claims rows agree with, of those that all have: ({kind: int (rows,)}, number of these claims).

    names: of the claims that count.
    """
    common = [name for name in names if all(name in row.agrees for row in rows)]
    return {kind: np.array([sum(row.agrees[name] for name in common) for row in rows if row.kind == kind])
            for kind in (DRAWN, *READINGS)}, len(common)


def main(path):
    """Append the rows of the plan that the table at `path` does not have."""
    new = not Path(path).exists()
    done = set() if new else {row[:2] for row in read(path)}
    with open(path, "a", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        if new:
            writer.writerow(["kind", "number", *AGENTS])
        for kind, number in plan():
            if (kind, number) not in done:
                found = row_of(kind, number).agrees
                writer.writerow([kind, number, *(int(found[name]) if name in found else "" for name in AGENTS)])
                file.flush()


if __name__ == "__main__":
    main(*sys.argv[1:])
