"""Counts, sentences and tables of the page "Bring your own world"."""

import numpy as np


def per_thousand(finds, steps, points=20):
    """Finds per thousand steps: (the ends of stretches of the run, float64 (1, points)).

    finds: the steps at which something was found. steps: of the run.
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
    """A sentence on how often something was found, in all and in the first and the last tenth of a run."""
    early, late = (np.mean([low <= find < low + steps / 10 for find in finds]) * len(finds) for low in (0, 0.9 * steps))
    return (f"{name} was found {len(finds)} times in {steps:,} steps: {early:.0f} in the first tenth of the run and "
            f"{late:.0f} in the last.")


def speeds(python_seconds, kernel_seconds, steps, kernel_steps):
    """A sentence on the cost of a step, in Python and as kernels."""
    return (f"A step of the Python loop took {1e6 * python_seconds / steps:.0f} microseconds. As kernels, on all "
            f"cores, it took {1e6 * kernel_seconds / kernel_steps:.2g} microseconds.")


def in_short(finds, python_seconds, kernel_seconds, steps, runs):
    """What an agent learns in a world, and what a step costs: from a Python loop and from runs of as many steps."""
    return ("An agent learns to find a lily pad in a pond of a few lines of Python. "
            f"{trials('The pad', finds, steps)} {speeds(python_seconds, kernel_seconds, steps, steps * runs)}")


def table(results):
    """Finds per thousand steps in the last fifth of the runs, mean and standard deviation: {name: `Result`}."""
    rows = ["| agent | finds per thousand steps in the last fifth, mean ± standard deviation over runs |", "|---|---|"]
    for name, result in results.items():
        last = 1_000 * result.rate(0.8) / result.world.fps
        unbroken = name.replace(" = ", "\u00a0=\u00a0")
        rows.append(f"| {unbroken} | {last.mean():.1f} ± {last.std():.1f} |")
    return "\n".join(rows)
