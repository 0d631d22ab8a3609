"""What the page "In your research" reports of its runs, in words and tables."""

import numpy as np


def last_fifth(results, unit="reward per second"):
    """A table of what runs earn in their last fifth, mean and standard deviation: {name: `neorl.Result`}."""
    rows = [f"| agent | {unit} |", "|---|---|"]
    for name, result in results.items():
        rate = result.rate(0.8)
        rows.append(f"| {name} | {rate.mean():.3f} ± {rate.std():.3f} |")
    return "\n".join(rows)


def transfer(taught, new, steps):
    """A sentence on what an agent earns with and without what another has learned: rewards of as many steps each."""
    return (f"In {steps:,} steps at the new place, the agent with the old values found the platform {taught:.0f} times "
            f"and one without {new:.0f} times.")


def same_bits(name, one, other):
    """A sentence on whether two arrays are the same to the last bit."""
    verdict = "the same to the last bit" if np.array_equal(one, other) else "not the same"
    return f"{name}: {verdict}."


def distances(by_name):
    """A sentence on how far animals were from the object in the last fifth of their time: {name: float64 (steps,)}."""
    parts = [f"{name} {np.mean(each[-len(each) // 5:]):.2f} m" for name, each in by_name.items()]
    return f"Mean distance from the object in the last fifth of the time: {', '.join(parts)}."
