"""Whether verdicts of 100 runs hold in ten: claims judged again by random draws of the runs behind the record.

A claim *flips* in a draw if it is reproduced where all runs contradict it, or the other way round. More than a
twentieth of flips for any claim is too many: then this script ends with 1. Runs come from the cache, or are computed.
It judges what `companion.thesis.reading.judge` does, under the default reading.

Run it as ``python book/draws.py``, from the root of a clone.
"""

import argparse
import sys
from collections import Counter
from dataclasses import replace

import numpy as np

from companion.thesis.reading import CONTROLS, LENGTHS, Reading, conditions, judge
from companion.thesis.verdict import RUNS_FOR_A_VERDICT, VERDICTS
from neorl.experiments.result import Result
from neorl.experiments.simulation import sweep

RUNS, DRAWS, MOST_FLIPS = 100, 200, 0.05
FLIPS = {"reproduced": "contradicted", "contradicted": "reproduced"}


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--draws", type=int, default=DRAWS, help=f"draws of runs ({DRAWS})")
    parser.add_argument("--runs", type=int, default=RUNS, help=f"runs of each condition to draw from ({RUNS})")
    chosen = parser.parse_args()
    wanted = conditions(Reading(), max(LENGTHS.values()), chosen.runs)
    results = dict(zip(wanted, sweep([*wanted.values()])))
    whole = {name: claim.verdict for name, claim in judge(results).items()}
    found = drawn(results, chosen.draws, np.random.default_rng(0))
    most = 0.0
    for name, verdict in whole.items():
        counts = Counter(each[name] for each in found)
        flips = counts[FLIPS.get(verdict)] / chosen.draws
        most = max(most, flips)
        print(f"{name:4} {verdict:13} flips {flips:6.1%}   "
              + ", ".join(f"{counts[each]} {each}" for each in VERDICTS if counts[each]))
    sys.exit(most > MOST_FLIPS)


def drawn(results, draws, rng):
    """The verdicts of each of some draws of ten runs of each condition: a list of {name of a claim: verdict}."""
    return [{name: claim.verdict for name, claim in judge(
        {key: some(result, RUNS_FOR_A_VERDICT * (CONTROLS if key[0] == "brownian" else 1), rng)
         for key, result in results.items()}).items()} for _ in range(draws)]


def some(result, runs, rng):
    """A `Result` of some runs of another, drawn at random."""
    kept = np.sort(rng.choice(result.runs, runs, replace=False))
    return Result(replace(result.condition, runs=runs), result.rewards[kept], result.hits[kept])


if __name__ == "__main__":
    main()
