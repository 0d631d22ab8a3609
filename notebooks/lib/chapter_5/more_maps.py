"""Final reward of agents with increasing numbers of maps, of either modality and of both: a demonstration.

1. Maps are added from the coarsest on, up to all six of paper B.
2. Agents of both modalities have as many maps in each.
3. Results are {modality: [Result for each of `COUNTS`]}.
"""

import numpy as np

from neorl.agents import papers
from neorl.evidence.statistics import difference, estimate
from neorl.evidence.verdict import FINAL
from neorl.experiments.sweeping import simulate_once
from neorl.worlds.waterworld import WaterWorld

COUNTS = (1, 2, 4, 6)


def live(reading, steps, runs, seed=0):
    """The results under a `Reading`. steps, runs, seed: as `neorl.simulate` takes them."""
    both = {"place_gain": reading.place_gain, **reading.agents}
    makers = {"place cells": (papers.place_cells, reading.agents),
              "object-vector cells": (papers.object_vector_cells, reading.agents), "both": (papers.multimodal, both)}
    world = WaterWorld(fps=reading.fps, contact=reading.contact)
    return {name: [simulate_once(make(papers.PRIMES[:count], **choices), world, steps=steps, runs=runs, seed=seed)
                   for count in COUNTS] for name, (make, choices) in makers.items()}


def final_rewards(results):
    """Reward per second in the last fifth of a run: {modality: [Estimate for each of `COUNTS`]}."""
    return {name: [estimate(np.mean, result.rate(*FINAL)) for result in of_counts]
            for name, of_counts in results.items()}


def in_words(results):
    """Gain from more maps, from one to six and from four to six, in Markdown."""
    final = {name: [result.rate(*FINAL) for result in of_counts] for name, of_counts in results.items()}
    in_all = {name: estimate(difference, rates[-1], rates[0]) for name, rates in final.items()}
    at_last = {name: estimate(difference, rates[-1], rates[-2]) for name, rates in final.items()}
    up, still = ([name for name, gain in gains.items() if gain.low > 0] for gains in (in_all, at_last))
    always = len(up) == len(final)
    said = [f"From one map to six the gain is {', '.join(f'{gain} with {name}' for name, gain in in_all.items())}.",
            "Six maps earn more than one in every case." if always else
            f"The interval is above zero with {' and '.join(up) or 'none of them'}."]
    if still:
        said.append(f"From four to six the gain is still above zero with {' and '.join(still)}.")
    else:
        said.append("From four to six no interval is above zero any more"
                    + (": ability scales, and it levels off." if always else "."))
    return " ".join(said)
