"""How often intervals of the rules hold: claims judged again by draws of recorded runs.

The runs behind the record stand for all possible runs, whose numbers are then known. Runs are drawn from them with
replacement, as many as a page or the record has, and judged. The table has for each claim how many intervals decide its
verdict, and in how many of the draws all of them contain their numbers: 95 % or more, if they do what they say.
``python book/computing/intervals.py`` prints it.
"""

import argparse
from dataclasses import replace

import numpy as np
from companion.thesis.reading import READINGS, judge

from computing.record import RUNS, lived
from neorl.experiments.result import Result


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--draws", type=int, default=200, help="draws of runs (200)")
    parser.add_argument("--runs", type=int, nargs="+", default=[10, 100], help="runs of each condition in a draw")
    chosen = parser.parse_args()
    results = lived(READINGS["calibrated"], RUNS["claims"])
    known, rng = judge(results), np.random.default_rng(0)
    found = {runs: [hold(known, judge({key: drawn(each, runs, rng) for key, each in results.items()}))
                    for _ in range(chosen.draws)] for runs in chosen.runs}
    print("claim  intervals  " + "  ".join(f"{runs:4} runs" for runs in chosen.runs))
    for name, claim in known.items():
        shares = "  ".join(f"{np.mean([each[name] for each in of_draws]):9.1%}" for of_draws in found.values())
        print(f"{name:5}  {claim.together:9}  {shares}", flush=True)


def drawn(result, runs, rng):
    """A `Result` of some runs of another, drawn at random with replacement."""
    kept = rng.integers(result.runs, size=runs)
    return Result(replace(result.condition, runs=runs), result.rewards[kept], result.hits[kept])


def hold(known, judged):
    """Whether all intervals that decide a claim contain the numbers that are known: {name: bool}."""
    return {name: all(low <= known[name].numbers[what][0].value <= high
                      for what, ((_, low, high), bounds, _) in claim.numbers.items()
                      if bounds and what in known[name].numbers) for name, claim in judged.items()}


if __name__ == "__main__":
    main()
