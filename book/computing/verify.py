"""Recompute a random sample of the runs behind the figures, and compare bit by bit: ``make verify`` runs this.

The sample is drawn from the conditions that earlier builds have cached, as far as they were computed with the present
source, and a module defines their worlds and kernels, which have not changed since. Each of its runs is recomputed
alone, and its rewards and hits in every bin of 0.2 s must equal those cached.
"""

import argparse
import random
import secrets
import sys
import time

import numpy as np

from neorl.common.array_files import open_arrays
from neorl.common.files import cache_folder
from neorl.experiments import store
from neorl.experiments.bins import new_bins
from neorl.experiments.result import condition_of
from neorl.experiments.simulation import finished_run


def main():
    chosen = parse_arguments()
    conditions = conditions_kept()
    everything = [(condition, k) for condition in conditions for k in range(condition.runs)]
    if not everything:
        sys.exit(f"{cache_folder()} holds no condition that was computed with the present source: make book first")
    others = len({each.path.name.partition("-")[0] for each in store.kept() if each.kind == "runs"}) - len(conditions)
    sample = random.Random(chosen.seed).sample(everything, min(chosen.sample, len(everything)))
    print(f"{len(sample)} of {len(everything)} runs of {len(conditions)} conditions in {cache_folder()}, "
          f"seed {chosen.seed}")
    if others:
        print(f"{others} more are left out: their kernels or worlds have changed since, or neorl, or no module has "
              "them")
    began, bins, differing = time.monotonic(), 0, []
    for condition, k in sample:
        difference, compared = compare(condition, k)
        bins += compared
        if difference:
            differing.append(condition)
            print(f"run {k} of {condition}, {condition.key}: {difference}", flush=True)
    again = f"make verify SAMPLE={chosen.sample} SEED={chosen.seed}"
    if differing:
        sys.exit(f"{len(differing)} of {len(sample)} runs are not as kept; {again} compares the same ones again")
    steps = sum(condition.steps for condition, _ in sample)
    print(f"each was recomputed alone, {steps:,} steps in all: the rewards and hits of {bins:,} bins of 0.2 s "
          f"are the same to the last bit ({time.monotonic() - began:.0f} s)")


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--sample", type=int, default=20, help="how many runs (default 20)")
    parser.add_argument("--seed", type=int, default=secrets.randbelow(10**6), help="of the sample (by default random)")
    chosen = parser.parse_args()
    if chosen.sample < 1:
        parser.error(f"--sample must be an integer of at least 1, but is {chosen.sample}")
    return chosen


def conditions_kept():
    """Every complete `Condition` on disk that was computed with the present source and can be restored: a list."""
    found = {}
    for each in store.kept():
        key = each.path.name.partition("-")[0]
        if each.kind == "runs" and key not in found:
            try:
                with open_arrays(each.path, "runs") as file:
                    condition = condition_of(file.about)
            except (OSError, ValueError):  # damaged, of another version, or with a kernel that no module defines
                continue
            if condition.key == key and store.load(condition):  # else a source or a kernel has changed
                found[key] = condition
    return list(found.values())


def compare(condition, k):
    """Recompute a run: its difference from the cached one, as text or None, and its number of bins."""
    result = store.load(condition)
    rewards, hits = recomputed(condition, k)
    same = (bits(result.rewards[k]) == bits(rewards)) & np.all(result.hits[k] == hits, axis=-1)
    if same.all():
        return None, same.size
    first = int(np.argmin(same))
    return (f"{np.count_nonzero(~same)} of {same.size} bins differ, the first from {result.edges[first]:g} s on: kept "
            f"are {result.rewards[k, first]!r} and {result.hits[k, first].tolist()}, recomputed "
            f"{rewards[first]!r} and {hits[first].tolist()}"), same.size


def recomputed(condition, k):
    """The rewards and hits in each bin of a run, computed alone: float32 (bins,) and int (bins, kinds)."""
    rewards, hits = new_bins(condition.world, 1, condition.steps)
    finished_run(condition, k, rewards[0], hits[0])
    return rewards[0], hits[0]


def bits(rewards):
    return rewards.view(np.uint32)


if __name__ == "__main__":
    main()
