"""Counts of the page "Bring your own world", and their sentences and tables."""

import numpy as np


def per_thousand(finds, steps, points=20):
    """How often something was found per thousand steps: (where stretches of the run end, float64 (1, points)).

    finds: the steps on which it was found. steps: of the run.
    """
    edges = np.linspace(0, steps, points + 1)
    counts, _ = np.histogram(finds, edges)
    return edges[1:], 1_000 * counts[None] / np.diff(edges)


def rates(result, points=20):
    """Finds per thousand steps in a `neorl.Result` with a reward of 1 for each: float64 (runs, points)."""
    shares = np.linspace(0, 1, points + 1)
    return np.stack([1_000 * result.rate(begin, end) / result.world.fps
                     for begin, end in zip(shares[:-1], shares[1:])], axis=1)


def trials(name, finds, steps):
    """A sentence on how many steps it took to find something, in the first and the last tenth of a run."""
    early, late = (np.mean([low <= find < low + steps / 10 for find in finds]) * len(finds) for low in (0, 0.9 * steps))
    return (f"{name} was found {len(finds)} times in {steps:,} steps: {early:.0f} in the first tenth of the run and "
            f"{late:.0f} in the last.")


def speeds(python_seconds, kernel_seconds, steps, kernel_steps):
    """A sentence on the cost of a step in either form."""
    return (f"A step of the loop took {1e6 * python_seconds / steps:.0f} microseconds. As kernels, on all cores, it "
            f"took {1e6 * kernel_seconds / kernel_steps:.2g} microseconds.")


def in_short(finds, python_seconds, kernel_seconds, steps, runs):
    """What a world in either form costs, and what an agent learns in it: of a loop and of runs of the same steps."""
    return ("An agent learns to find a lily pad in a pond of a few lines of Python. "
            f"{trials('The pad', finds, steps)} {speeds(python_seconds, kernel_seconds, steps, steps * runs)}")


def table(results):
    """Finds per thousand steps in the last fifth of the runs, mean and standard deviation: {name: `Result`}."""
    rows = ["| agent | finds per thousand steps, mean ± standard deviation over runs |", "|---|---|"]
    for name, result in results.items():
        last = 1_000 * result.rate(0.8) / result.world.fps
        rows.append(f"| {name} | {last.mean():.1f} ± {last.std():.1f} |")
    return "\n".join(rows)
