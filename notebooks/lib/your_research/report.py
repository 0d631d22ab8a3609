"""Sentences and tables of the page "In your research"."""

import numpy as np


def last_fifth(results, unit="reward per second"):
    """A table of rewards in the last fifth of runs, mean and standard deviation: {name: `neorl.Result`}."""
    rows = [f"| agent | {unit} in the last fifth, mean ± standard deviation over runs |", "|---|---|"]
    for name, result in results.items():
        rate = result.rate(0.8)
        rows.append(f"| {name} | {rate.mean():.3f} ± {rate.std():.3f} |")
    return "\n".join(rows)


def transfer(found, steps):
    """A sentence on the points that agents earn with and without others' values: [(with, without), …] by run."""
    taught, new = np.median(found, axis=0)
    better = sum(one > other for one, other in found)
    return (f"In {steps:,} steps, agents that began with the values of another earned {taught:.0f} points (median over "
            f"runs), and agents that began without earned {new:.0f}; the former earned more in {better} of "
            f"{len(found)} runs.")


def same_bits(name, one, other):
    """A sentence on whether two arrays are the same to the last bit."""
    verdict = "the same to the last bit" if np.array_equal(one, other) else "not the same"
    return f"{name}: {verdict}."


def in_short(found, steps, one, other, away):
    """The page's results in a few sentences. Arguments as in `transfer`, `same_bits` and `distances`."""
    resumed = same_bits("A run that was saved and loaded, compared with the same run without a break", one, other)
    return (f"{transfer(found, steps)} {resumed} In another simulator, an agent steers an animal by the firing of the "
            f"animal's neurons. {distances(away)}")


def distances(by_name):
    """A sentence on how far animals were from the object in the last fifth of their time: {name: float64 (steps,)}."""
    parts = [f"{name} {np.mean(each[-len(each) // 5:]):.2f}\u00a0m" for name, each in by_name.items()]
    return f"Mean distance from the object in the last fifth of the time, in one run each: {', '.join(parts)}."
